// What the engine holds of the surface: finished nodes in the patch tree, and of those the drawn set with its
// seams and corner pieces - always one watertight surface (laws 2 and 5).
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "teren/Position.h"
#include "teren/Scene.h"

#include "patch/BorderTask.h"
#include "patch/MeshTask.h"
#include "patch/NodeKey.h"
#include "patch/PatchTree.h"
#include "patch/PieceTask.h"

namespace teren {

/// What a piece is called.
struct PieceName {
  NodeKey key;  ///< of its south-west node; of a border its own node
  Piece piece = Piece::interior;
  friend bool operator==(const PieceName&, const PieceName&) = default;
};

struct PieceNameHash {
  std::size_t operator()(const PieceName& name) const noexcept {
    return NodeKeyHash{}(name.key) * 8 + static_cast<std::size_t>(name.piece);
  }
};

/// A piece and the nodes it is made of: 1, 2 or 4 of one level in MeshTask's order; of a border its node,
/// then all that touch it, by level and key.
struct PiecePlan {
  PieceName name;
  std::vector<NodeKey> nodes;
  friend bool operator==(const PiecePlan&, const PiecePlan&) = default;
};

/// A piece on its way to the drawn set, which gives its mesh an id.
struct BuiltPiece {
  PiecePlan plan;
  std::shared_ptr<Mesh> mesh;
};

using NodeSet = std::unordered_set<NodeKey, NodeKeyHash>;

/// Nodes that leave the drawn set and nodes that come instead, all at once. Afterwards as before no two
/// overlap.
struct DrawnChange {
  std::vector<NodeKey> remove, add;
};

/// What a change asks for.
struct ChangePlan {
  std::vector<PiecePlan> build;  ///< pieces that there are not yet, or that join other nodes than before
  std::vector<PieceName> drop;   ///< pieces that go
  std::size_t bytes = 0;         ///< of the meshes to be built, at most
};

/// Not thread-safe. Any levels may be drawn side by side.
class NodeStore {
 public:
  /// `spacing` [m] of level 0, `intervals` n; whether nodes come with coarser samples, for heldBytes().
  NodeStore(double spacing, int intervals, bool withCoarser = false)
      : spacing_(spacing), intervals_(intervals), withCoarser_(withCoarser) {}

  NodeHeights heights(const NodeKey& key) const;
  /// Looks through the heights for their bend (NodeGap.h): 2 ns a sample.
  void insert(const NodeKey& key, NodeHeights heights);
  /// Forgets the heights of a node that is not drawn.
  void erase(const NodeKey& key);
  std::vector<NodeKey> nodes() const;

  bool isDrawn(const NodeKey& key) const { return drawn_.find(key, LookUp::none) != nullptr; }
  /// The drawn node that contains this one; empty where there is none.
  std::optional<NodeKey> drawnOver(const NodeKey& key) const;
  /// The drawn nodes inside this one, itself included.
  std::vector<NodeKey> drawnIn(const NodeKey& key) const;
  /// Whether any node inside this one is drawn, or itself.
  bool isDrawnIn(const NodeKey& key) const noexcept { return drawn_.hasIn(key); }
  /// Calls visit(key) for the drawn nodes inside this one, itself included, until it returns false.
  template <class Visit>
  void forEachDrawnIn(const NodeKey& key, Visit&& visit) const {
    drawn_.forEachIn(key, [&](const NodeKey& inner, const NodeHeights&) { return visit(inner); });
  }
  /// Calls visit(key) for all drawn nodes whose squares touch that of `key`, or lie in it, or over it.
  template <class Visit>
  void forEachDrawnTouching(const NodeKey& key, Visit&& visit) const {
    drawn_.forEachTouching(key, [&](const NodeKey& other, const NodeHeights&) { visit(other); });
  }
  std::size_t drawnCount() const noexcept { return drawnCount_; }
  /// Calls visit(key) for every drawn node, in an order that depends on the set alone.
  template <class Visit>
  void forEachDrawn(Visit&& visit) const {
    drawn_.forEach([&](const NodeKey& key, const NodeHeights&) { visit(key); });
  }

  /// What must be built before a change: what it adds must be held and not drawn, what it removes drawn.
  /// Costs about 2 us for each node it names and each that touches one.
  ChangePlan plan(const DrawnChange& change) const;
  /// A task that builds a piece; its nodes must be held.
  std::unique_ptr<PieceTask> makePiece(const PiecePlan& plan);
  /// Makes the change, with all its pieces, at once. False, and nothing happens, where the pieces are not
  /// exactly what plan(change) asks for, or its nodes are no longer as it needs them: the drawn set has
  /// changed since.
  bool apply(const DrawnChange& change, std::span<const BuiltPiece> pieces);

  /// [m] The triangles of the node of this level at a valid position; empty where it is not
  /// held.
  std::optional<double> height(const Position& position, int level) const;

  /// Grows with every change of the drawn set.
  std::uint64_t serial() const noexcept { return serial_; }
  std::shared_ptr<const Scene> snapshot(const Morph& morph = {}) const;
  /// Of everything held, the store's own bookkeeping included (estimated).
  std::size_t bytes() const noexcept;
  std::size_t meshBytes() const noexcept { return meshBytes_; }
  std::size_t triangles() const noexcept { return triangles_; }  ///< drawn
  /// What a node adds to bytes() at most: its heights alone, or drawn among nodes of its level, with all its
  /// pieces.
  std::size_t heldBytes() const noexcept;
  std::size_t drawnBytes() const noexcept { return heldBytes() + piecesBytes(); }
  /// Of its pieces: an interior, two seams, a corner piece.
  std::size_t piecesBytes() const noexcept;
  /// Of a border towards nodes a level finer on all sides.
  std::size_t borderBytes() const;
  /// How many nodes of each level are drawn, from level 0 on.
  const std::vector<std::size_t>& drawnAtLevel() const noexcept { return drawnAtLevel_; }

 private:
  struct Drawn {
    std::uint64_t id = 0;
    std::size_t bytes = 0;
    std::vector<NodeKey> nodes;  // of a border
  };
  struct Surroundings;

  /// Of a piece, besides its mesh.
  static std::size_t bookkeeping(const PieceName& name) noexcept;
  static std::size_t bytesOf(const PieceName& name, const Mesh& mesh) noexcept;
  std::size_t plannedBytes(const PiecePlan& plan) const;
  std::vector<PiecePlan> piecesOwnedBy(const NodeKey& node, const Surroundings& after) const;
  bool isPossible(const DrawnChange& change) const;
  void dropPiece(const PieceName& name);
  void noteError(const PiecePlan& plan, Mesh& mesh) const;

  double spacing_;
  int intervals_;
  bool withCoarser_;
  PatchTree<NodeHeights> tree_;
  std::unordered_map<NodeKey, float, NodeKeyHash> bends_;  // [m] of the nodes held
  std::size_t heightBytes_ = 0, meshBytes_ = 0, bookkeepingBytes_ = 0;
  std::size_t triangles_ = 0;
  PatchTree<NodeHeights> drawn_;
  std::size_t drawnCount_ = 0;
  std::vector<std::size_t> drawnAtLevel_;
  std::unordered_map<PieceName, Drawn, PieceNameHash> pieces_;
  std::map<std::uint64_t, std::shared_ptr<const Mesh>> meshes_;  // by id
  GridIndices indices_;
  std::uint64_t nextId_ = 1, serial_ = 0;
};

}  // namespace teren
