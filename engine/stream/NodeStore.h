// What the engine holds of the surface: finished nodes in the patch tree, and of those the drawn set with its
// seams and corner pieces - always one watertight surface (laws 2 and 5).
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "teren/GroundEdits.h"
#include "teren/Position.h"
#include "teren/Scene.h"

#include "patch/BorderTask.h"
#include "patch/MeshTask.h"
#include "patch/NodeKey.h"
#include "patch/PatchTree.h"
#include "patch/PieceTask.h"
#include "stream/MeshPages.h"
#include "stream/SeenVertices.h"
#include "world/SteadyMap.h"

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

/// What edits make of a node.
struct EditedNode {
  NodeHeights heights;
  float moved = 0.0F;  ///< [m] by edits: Mesh::moved
};

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
  /// `bend` [m] is that of the world's own heights there (NodeGap.h), whatever edits there are or were. Looks
  /// through the heights for their range: 1 ns a sample.
  void insert(const NodeKey& key, EditedNode node, float bend);
  void insert(const NodeKey& key, NodeHeights heights);  ///< the world's own
  /// [m] Of a node held.
  float bend(const NodeKey& key) const { return roughness_.find(key)->bend; }
  /// [m] Of all heights that have ever been held; lowest > highest where there were none.
  float lowest() const noexcept { return lowest_; }
  float highest() const noexcept { return highest_; }
  /// Forgets the heights of a node that is not drawn.
  void erase(const NodeKey& key);
  std::vector<NodeKey> nodes() const;
  /// Calls visit(key) for all nodes held whose squares touch that of `key`, or lie in it, or over it.
  template <class Visit>
  void forEachTouching(const NodeKey& key, Visit&& visit) const {
    tree_.forEachTouching(key, [&](const NodeKey& other, const NodeHeights&) { visit(other); });
  }

  /// Calls visit(key, sees) for all nodes held that lie in one a level coarser whose heights, or the coarser
  /// samples around them, may be of these level-0 samples; and whether that is so of the node itself.
  /// `topLevel` of the world.
  template <class Visit>
  void forEachSeeing(const SampleBox& box, int topLevel, Visit&& visit) const {
    const auto mayLead = [&](const NodeKey& key) {
      return key.level > topLevel || seenFrom(key.parent()).touches(box);
    };
    tree_.forEachWhere(
        mayLead, [&](const NodeKey& key, const NodeHeights&) { visit(key, seenFrom(key).touches(box)); });
  }

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
  std::unique_ptr<PieceTask> makePiece(const PiecePlan& plan) { return makePiece(plan, showsComing_); }
  /// Makes the change, with all its pieces, at once. False, and nothing happens, where the pieces are not
  /// exactly what plan(change) asks for, or its nodes are no longer as it needs them: the drawn set has
  /// changed since.
  bool apply(const DrawnChange& change, std::span<const BuiltPiece> pieces);

  // Other heights for nodes held, drawn or not, all at once, in steps of a few microseconds each: heights
  // come; pieces are built of them; each piece is exchanged; all is shown; all is settled. From the first
  // exchange until all is settled nothing else may change what is held or drawn.

  /// Heights to come for a node held, in place of those that were to come.
  void come(const NodeKey& key, EditedNode node);
  bool isComing(const NodeKey& key) const { return coming_.contains(key); }
  /// The drawn nodes that touch a drawn one, itself included: those whose pieces may join it.
  std::vector<NodeKey> drawnAround(const NodeKey& key) const;
  /// Appends the pieces of this drawn node that are of heights to come, of itself or of others; returns the
  /// bytes of their meshes, at most.
  std::size_t planComing(const NodeKey& key, std::vector<PiecePlan>& plans) const;
  std::unique_ptr<PieceTask> makeComing(const PiecePlan& plan) { return makePiece(plan, true); }
  /// One that planComing() told of, of a drawn set that is still the same.
  void exchange(BuiltPiece piece);
  /// Some pieces have been exchanged but not all are shown: there is nothing to be published now.
  bool isExchanging() const noexcept { return !exchanged_.empty() && !showsComing_; }
  void showComing();
  /// False once all is settled.
  bool settleOne();
  /// Frees meshes that were exchanged and that no snapshot has any more, a few at a time; false where there
  /// are none.
  bool freeSome();
  bool hasToFree() const noexcept { return !free_.empty(); }

  /// [m] The triangles of the node of this level at a valid position; empty where it is not
  /// held.
  std::optional<double> height(const Position& position, int level) const;
  /// [m] The drawn triangles at a valid position: what SceneQuery::points says of a snapshot, bit for bit,
  /// and none has to be made; its vertices as `seen` (from the world's zero; nullptr: as they lie). Empty
  /// where nothing is drawn. O(levels + log(pieces)), and where levels meet O(triangles of one border).
  std::optional<double> drawnHeight(const Position& position, const SeenVertices* seen = nullptr) const;

  /// Grows with every change of the drawn set.
  std::uint64_t serial() const noexcept { return serial_; }
  /// Costs what has changed since the last one, and O(pages) (MeshPages.h).
  std::shared_ptr<const Scene> snapshot(const Morph& morph = {});
  /// The snapshots before the last one have been let go of, and what only they had. Whether that was
  /// anything.
  bool letGoOfOldSnapshots();
  /// Of everything held, the store's own bookkeeping included (estimated), and what has been dropped as long
  /// as snapshots may have it.
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
    std::shared_ptr<const Mesh> mesh;
    std::shared_ptr<const Mesh> next;  // of heights to come
    std::size_t bytes = 0;             // of the latest
    std::vector<NodeKey> nodes;        // of a border
  };
  struct Surroundings;
  /// A place in a node: its square, by column and row, and where in it, 0 ... 1.
  struct NodePlace {
    int column = 0, row = 0;
    double x = 0.0, y = 0.0;
  };

  /// Of a piece, besides its mesh.
  static std::size_t bookkeeping(const PieceName& name) noexcept;
  static std::size_t bytesOf(const PieceName& name, const Mesh& mesh) noexcept;
  std::size_t plannedBytes(const PiecePlan& plan) const;
  std::vector<PiecePlan> piecesOwnedBy(const NodeKey& node, const Surroundings& after) const;
  bool isPossible(const DrawnChange& change) const;
  void dropPiece(const PieceName& name);
  const Mesh* regularMeshAt(const NodeKey& node, const NodePlace& place) const;
  void noteError(const PiecePlan& plan, Mesh& mesh, bool ofComing) const;
  std::unique_ptr<PieceTask> makePiece(const PiecePlan& plan, bool ofComing);
  const Mesh* shown(const Drawn& drawn) const noexcept {
    return showsComing_ && drawn.next ? drawn.next.get() : drawn.mesh.get();
  }
  SampleBox seenFrom(const NodeKey& key) const noexcept;
  void noteRange(const HeightMap& heights);

  double spacing_;
  int intervals_;
  bool withCoarser_;
  PatchTree<NodeHeights> tree_;
  /// What is known of the errors of a node held.
  struct Roughness {
    float bend = 0.0F, moved = 0.0F;  // [m] as in Mesh
  };
  SteadyMap<NodeKey, Roughness, NodeKeyHash> roughness_;
  std::unordered_map<NodeKey, EditedNode, NodeKeyHash> coming_;
  bool showsComing_ = false;
  std::vector<PieceName> exchanged_;
  struct OldMesh {
    std::shared_ptr<const Mesh> mesh;
    std::size_t bytes = 0;
  };
  std::vector<OldMesh> replaced_, free_;  // some snapshot may have them; none has
  std::size_t oldBytes_ = 0;              // of both
  float lowest_ = std::numeric_limits<float>::infinity(), highest_ = -lowest_;
  std::size_t heightBytes_ = 0, meshBytes_ = 0, bookkeepingBytes_ = 0;
  std::size_t droppedBytes_ = 0;  // of meshes since the last snapshot
  std::size_t keptBytes_ = 0;     // of meshes dropped before, by snapshots not yet let go of
  std::size_t triangles_ = 0;
  PatchTree<NodeHeights> drawn_;
  std::size_t drawnCount_ = 0;
  std::vector<std::size_t> drawnAtLevel_;
  SteadyMap<PieceName, Drawn, PieceNameHash> pieces_;
  MeshPages meshes_;  // of pieces_, all that have triangles
  GridIndices indices_;
  std::uint64_t nextId_ = 1, serial_ = 0;
};

}  // namespace teren
