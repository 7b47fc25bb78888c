// What the engine holds of the surface: finished nodes in the patch tree, and of those the drawn set with its
// seams and corner pieces - always one watertight surface (laws 2 and 5).
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "teren/Position.h"
#include "teren/Scene.h"

#include "patch/MeshTask.h"
#include "patch/NodeKey.h"
#include "patch/PatchTree.h"

namespace teren {

/// A piece to be built and what it will be called.
struct PieceName {
  NodeKey key;  ///< of its south-west node
  Piece piece = Piece::interior;
  friend bool operator==(const PieceName&, const PieceName&) = default;
};

struct PieceNameHash {
  std::size_t operator()(const PieceName& name) const noexcept {
    return NodeKeyHash{}(name.key) * 4 + static_cast<std::size_t>(name.piece);
  }
};

/// The nodes a piece joins: 1, 2 or 4.
std::vector<NodeKey> nodesOf(const PieceName& name);
/// The nine pieces a node takes part in: its interior, four seams, four corner pieces.
std::array<PieceName, 9> piecesOf(const NodeKey& node);

/// A piece on its way to the drawn set, which gives its mesh an id.
struct BuiltPiece {
  PieceName name;
  std::shared_ptr<Mesh> mesh;
};

using NodeSet = std::unordered_set<NodeKey, NodeKeyHash>;

/// Not thread-safe.
class NodeStore {
 public:
  /// `spacing` [m] of level 0, `intervals` n.
  NodeStore(double spacing, int intervals) : spacing_(spacing), intervals_(intervals) {}

  NodeHeights heights(const NodeKey& key) const;
  void insert(const NodeKey& key, NodeHeights heights);
  /// Forgets a node: its heights, and its pieces if it is drawn.
  void erase(const NodeKey& key);
  /// Takes a node out of the drawn set, with its pieces; its heights stay.
  void undraw(const NodeKey& key);
  std::vector<NodeKey> nodes() const;

  bool isDrawn(const NodeKey& key) const { return drawn_.contains(key); }
  std::size_t drawnCount() const noexcept { return drawn_.size(); }
  /// The pieces that must be there before `node` may be drawn: its own, and the seams and corner pieces all
  /// of whose other nodes are drawn already, or will be before it: `before`.
  std::vector<PieceName> piecesToDraw(const NodeKey& node, const NodeSet& before = {}) const;
  /// A task that builds a piece; its nodes must be held.
  std::unique_ptr<MeshTask> makePiece(const PieceName& name);
  /// Draws `node`, which is held and not drawn, with all its pieces, at once. False, and nothing happens,
  /// where they are not exactly piecesToDraw(node): the drawn set has changed since they were chosen.
  bool draw(const NodeKey& node, std::span<const BuiltPiece> pieces);

  /// [m] The triangles of the node of this level at a valid position; empty where it is not
  /// held.
  std::optional<double> height(const Position& position, int level) const;

  /// Grows with every change of the drawn set.
  std::uint64_t serial() const noexcept { return serial_; }
  std::shared_ptr<const Scene> snapshot() const;
  /// Of everything held, the store's own bookkeeping included (estimated).
  std::size_t bytes() const noexcept;
  std::size_t meshBytes() const noexcept { return meshBytes_; }
  /// What a node adds to bytes() at most: its heights alone, or drawn, with all its pieces.
  std::size_t heldBytes() const noexcept;
  std::size_t drawnBytes() const noexcept { return heldBytes() + piecesBytes(); }
  /// Of its pieces: an interior, two seams, a corner piece.
  std::size_t piecesBytes() const noexcept;

 private:
  double spacing_;
  int intervals_;
  PatchTree<NodeHeights> tree_;
  std::size_t heightBytes_ = 0, meshBytes_ = 0;
  NodeSet drawn_;
  std::unordered_map<PieceName, std::uint64_t, PieceNameHash> pieces_;  // to mesh ids
  std::map<std::uint64_t, std::shared_ptr<const Mesh>> meshes_;         // by id
  GridIndices indices_;
  std::uint64_t nextId_ = 1, serial_ = 0;
};

}  // namespace teren
