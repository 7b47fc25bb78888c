// Joins finished nodes to the drawn set: their meshes, and the seams and corner pieces to what is drawn
// beside them.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "teren/Slice.h"

#include "patch/PieceTask.h"
#include "stream/NodeStore.h"

namespace teren {

/// Builds all pieces that a change of the drawn set needs, on any thread. It holds what it reads; what it
/// built is drawn by NodeStore::apply, unless the drawn set has changed meanwhile.
class JoinTask final : public SlicedTask {
 public:
  /// See NodeStore::plan.
  JoinTask(NodeStore& nodes, DrawnChange change);
  /// Builds what is added, for no change of the drawn set.
  JoinTask() = default;
  void add(PiecePlan plan, std::unique_ptr<PieceTask> task);
  bool step(const Slice& slice) override;

  const DrawnChange& change() const noexcept { return change_; }
  /// Complete once step has returned true.
  std::span<const BuiltPiece> pieces() const noexcept { return pieces_; }
  /// Once complete, the last of those that have not been taken.
  std::optional<BuiltPiece> takePiece();
  /// [bytes] of the pieces, at most.
  std::size_t bytes() const noexcept { return bytes_; }

 private:
  DrawnChange change_;
  std::size_t bytes_ = 0;
  std::vector<BuiltPiece> pieces_;
  std::vector<std::unique_ptr<PieceTask>> tasks_;  // of the pieces, in order
  std::size_t next_ = 0;
};

}  // namespace teren
