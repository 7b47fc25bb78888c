// Joins finished nodes to the drawn set: their meshes, and the seams and corner pieces to what is drawn.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "teren/Slice.h"

#include "patch/MeshTask.h"
#include "stream/NodeStore.h"

namespace teren {

/// Builds all pieces of a batch of nodes, on any thread. It holds what it reads; what it built is drawn by
/// NodeStore::draw, node by node in the batch's order, unless the drawn set has changed meanwhile.
class JoinTask final : public SlicedTask {
 public:
  struct Joined {
    NodeKey node;
    std::vector<BuiltPiece> pieces;
  };

  /// `batch`: nodes held and not drawn, in the order in which they will be drawn.
  JoinTask(NodeStore& nodes, std::span<const NodeKey> batch);
  bool step(const Slice& slice) override;

  /// Complete once step has returned true.
  std::vector<Joined>& joined() noexcept { return joined_; }

 private:
  std::vector<Joined> joined_;
  std::vector<std::unique_ptr<MeshTask>> tasks_;  // all pieces of all nodes, in order
  std::size_t node_ = 0, piece_ = 0, task_ = 0;
};

}  // namespace teren
