#include "stream/NodeStore.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <tuple>
#include <utility>

#include "teren/HeightSampling.h"

#include "patch/CoarserSurface.h"
#include "patch/NodeGap.h"

namespace teren {

namespace {

// The containers' own nodes and the blocks that count references, as allocated (estimated).
constexpr std::size_t kBytesPerPiece = 600;     // in two maps, a scene, and two queries of scenes
constexpr std::size_t kBytesPerBorder = 4096;   // and of its triangles in these
constexpr std::size_t kTreeBytesPerNode = 160;  // leaf, control block, its share of the branches
constexpr std::size_t kBendBytes = 56;          // in its map

constexpr std::array<Piece, 5> kPieces{Piece::interior, Piece::eastSeam, Piece::northSeam, Piece::cornerPiece,
                                       Piece::border};

bool byLevelAndKey(const NodeKey& a, const NodeKey& b) noexcept {
  return std::tie(a.level, a.j, a.i) < std::tie(b.level, b.j, b.i);
}

}  // namespace

NodeHeights NodeStore::heights(const NodeKey& key) const {
  const NodeHeights* found = tree_.find(key, LookUp::none);
  return found ? *found : nullptr;
}

void NodeStore::insert(const NodeKey& key, NodeHeights heights) {
  assert(heights && heights->columns() == intervals_ + 1);
  NodeHeights& place = *tree_.find(key, LookUp::create);
  assert(!place);
  heightBytes_ += heights.bytes();
  bends_.emplace(key, static_cast<float>(largestBend(heights->view())));
  place = std::move(heights);
}

void NodeStore::erase(const NodeKey& key) {
  assert(!isDrawn(key));
  const NodeHeights held = heights(key);
  if (!held) return;
  heightBytes_ -= held.bytes();
  tree_.erase(key);
  bends_.erase(key);
}

std::vector<NodeKey> NodeStore::nodes() const {
  std::vector<NodeKey> keys;
  tree_.forEach([&](const NodeKey& key, const NodeHeights&) { keys.push_back(key); });
  return keys;
}

// ---- The drawn set

/// The drawn set as it will be.
struct NodeStore::Surroundings {
  const PatchTree<NodeHeights>& drawn;
  NodeSet removed;
  std::vector<NodeKey> added;

  /// All but `key` that touch it.
  std::vector<NodeKey> around(const NodeKey& key) const {
    std::vector<NodeKey> keys;
    drawn.forEachTouching(key, [&](const NodeKey& other, const NodeHeights&) {
      if (other != key && !removed.contains(other)) keys.push_back(other);
    });
    for (const NodeKey& other : added) {
      if (other != key && touch(other, key)) keys.push_back(other);
    }
    std::sort(keys.begin(), keys.end(), byLevelAndKey);
    return keys;
  }
};

std::optional<NodeKey> NodeStore::drawnOver(const NodeKey& key) const {
  NodeKey found;
  if (!drawn_.find(key, LookUp::nearestCoarser, &found)) return std::nullopt;
  return found;
}

std::vector<NodeKey> NodeStore::drawnIn(const NodeKey& key) const {
  std::vector<NodeKey> keys;
  forEachDrawnIn(key, [&](const NodeKey& inner) {
    keys.push_back(inner);
    return true;
  });
  return keys;
}

std::vector<PiecePlan> NodeStore::piecesOwnedBy(const NodeKey& node, const Surroundings& after) const {
  const std::vector<NodeKey> around = after.around(node);
  const auto isThere = [&](const NodeKey& key) {
    return std::find(around.begin(), around.end(), key) != around.end();
  };
  const NodeKey east = node.neighbour(1, 0), north = node.neighbour(0, 1), beyond = node.neighbour(1, 1);
  std::vector<PiecePlan> pieces{{{node, Piece::interior}, {node}}};
  if (isThere(east)) pieces.push_back({{node, Piece::eastSeam}, {node, east}});
  if (isThere(north)) pieces.push_back({{node, Piece::northSeam}, {node, north}});
  if (isThere(east) && isThere(north) && isThere(beyond)) {
    pieces.push_back({{node, Piece::cornerPiece}, {node, east, north, beyond}});
  }
  if (!BorderPlan(node, around, intervals_).empty()) {
    PiecePlan& border = pieces.emplace_back(PiecePlan{{node, Piece::border}, {node}});
    border.nodes.insert(border.nodes.end(), around.begin(), around.end());
  }
  return pieces;
}

std::size_t NodeStore::plannedBytes(const PiecePlan& plan) const {
  if (plan.name.piece != Piece::border) return pieceBytes(plan.name.piece, intervals_);
  return BorderPlan(plan.name.key, {plan.nodes.begin() + 1, plan.nodes.end()}, intervals_).bytes();
}

ChangePlan NodeStore::plan(const DrawnChange& change) const {
  const Surroundings after{drawn_, {change.remove.begin(), change.remove.end()}, change.add};
  std::vector<NodeKey> affected = change.add;
  NodeSet seen(change.add.begin(), change.add.end());
  for (const std::vector<NodeKey>* keys : {&change.add, &change.remove}) {
    for (const NodeKey& key : *keys) {
      for (const NodeKey& other : after.around(key)) {
        if (seen.insert(other).second) affected.push_back(other);
      }
    }
  }
  ChangePlan result;
  std::unordered_set<PieceName, PieceNameHash> kept;
  for (const NodeKey& node : affected) {
    for (PiecePlan& piece : piecesOwnedBy(node, after)) {
      const auto old = pieces_.find(piece.name);
      if (old != pieces_.end() && (old->second.nodes.empty() || old->second.nodes == piece.nodes)) {
        kept.insert(piece.name);
      } else {
        result.bytes += plannedBytes(piece) + bookkeeping(piece.name);
        result.build.push_back(std::move(piece));
      }
    }
  }
  affected.insert(affected.end(), change.remove.begin(), change.remove.end());
  for (const NodeKey& node : affected) {
    for (const Piece piece : kPieces) {
      const PieceName name{node, piece};
      if (pieces_.contains(name) && !kept.contains(name)) result.drop.push_back(name);
    }
  }
  return result;
}

std::unique_ptr<PieceTask> NodeStore::makePiece(const PiecePlan& plan) {
  const auto held = [&](const NodeKey& key) {
    NodeHeights found = heights(key);
    assert(found);
    return found;
  };
  if (plan.name.piece == Piece::border) {
    std::vector<HeldNode> nodes;
    nodes.reserve(plan.nodes.size());
    for (const NodeKey& key : plan.nodes) nodes.push_back({key, held(key)});
    return std::make_unique<BorderTask>(std::move(nodes), spacing_);
  }
  NodeBlock block{plan.name.key, {}};
  for (const NodeKey& key : plan.nodes) {
    const auto place = static_cast<std::size_t>((key.i - plan.name.key.i) + 2 * (key.j - plan.name.key.j));
    block.nodes[place] = held(key);
  }
  const double spacing = spacing_ * static_cast<double>(std::int64_t{1} << plan.name.key.level);
  return std::make_unique<MeshTask>(std::move(block), plan.name.piece, spacing, indices_);
}

bool NodeStore::isPossible(const DrawnChange& change) const {
  return std::all_of(change.remove.begin(), change.remove.end(),
                     [&](const NodeKey& key) { return isDrawn(key); }) &&
         std::all_of(change.add.begin(), change.add.end(),
                     [&](const NodeKey& key) { return !isDrawn(key) && static_cast<bool>(heights(key)); });
}

bool NodeStore::apply(const DrawnChange& change, std::span<const BuiltPiece> pieces) {
  if (!isPossible(change)) return false;
  const ChangePlan wanted = plan(change);
  const auto isFor = [](const BuiltPiece& built, const PiecePlan& piece) { return built.plan == piece; };
  if (!std::equal(pieces.begin(), pieces.end(), wanted.build.begin(), wanted.build.end(), isFor))
    return false;
  for (const PieceName& name : wanted.drop) dropPiece(name);
  for (const NodeKey& key : change.remove) drawn_.erase(key);
  for (const NodeKey& key : change.add) *drawn_.find(key, LookUp::create) = heights(key);
  drawnCount_ += change.add.size();
  drawnCount_ -= change.remove.size();
  for (const NodeKey& key : change.remove) --drawnAtLevel_[static_cast<std::size_t>(key.level)];
  for (const NodeKey& key : change.add) {
    const auto level = static_cast<std::size_t>(key.level);
    if (drawnAtLevel_.size() <= level) drawnAtLevel_.resize(level + 1);
    ++drawnAtLevel_[level];
  }
  for (const BuiltPiece& built : pieces) {
    const std::uint64_t id = nextId_++;
    built.mesh->id = id;
    noteError(built.plan, *built.mesh);
    const std::size_t bytes = bytesOf(built.plan.name, *built.mesh);
    const bool isBorder = built.plan.name.piece == Piece::border;
    pieces_.emplace(built.plan.name, Drawn{id, bytes, isBorder ? built.plan.nodes : std::vector<NodeKey>{}});
    meshes_.emplace_hint(meshes_.end(), id, built.mesh);
    meshBytes_ += bytes;
    triangles_ += built.mesh->indices->size() / 3;
    bookkeepingBytes_ += bookkeeping(built.plan.name);
  }
  ++serial_;
  return true;
}

/// A border lies within its own node, the first; all others join nodes of one level.
void NodeStore::noteError(const PiecePlan& plan, Mesh& mesh) const {
  mesh.nodeLevel = plan.name.key.level;
  const std::size_t count = plan.name.piece == Piece::border ? 1 : plan.nodes.size();
  for (std::size_t k = 0; k < count; ++k) mesh.bend = std::max(mesh.bend, bends_.at(plan.nodes[k]));
}

void NodeStore::dropPiece(const PieceName& name) {
  const auto piece = pieces_.find(name);
  meshBytes_ -= piece->second.bytes;
  bookkeepingBytes_ -= bookkeeping(name);
  const auto mesh = meshes_.find(piece->second.id);
  triangles_ -= mesh->second->indices->size() / 3;
  meshes_.erase(mesh);
  pieces_.erase(piece);
}

std::size_t NodeStore::bookkeeping(const PieceName& name) noexcept {
  return kBytesPerPiece + (name.piece == Piece::border ? kBytesPerBorder : 0);
}

std::size_t NodeStore::bytesOf(const PieceName& name, const Mesh& mesh) noexcept {
  // The index lists of borders are their own; those of all other pieces are shared, and counted once.
  return mesh.bytes() +
         (name.piece == Piece::border ? mesh.indices->capacity() * sizeof(TriangleIndices::value_type) : 0);
}

// ---- Heights

std::optional<double> NodeStore::height(const Position& position, int level) const {
  const NodeKey key = nodeAt(position, level);
  const NodeHeights held = heights(key);
  if (!held) return std::nullopt;
  const double scale = intervals_ / static_cast<double>(std::int64_t{1} << level);
  const double x = (static_cast<double>(position.i - (key.i << level)) + position.u) * scale;
  const double y = (static_cast<double>(position.j - (key.j << level)) + position.v) * scale;
  return triangleHeight(std::as_const(*held).view(), x, y);
}

std::shared_ptr<const Scene> NodeStore::snapshot(const Morph& morph) const {
  std::vector<std::shared_ptr<const Mesh>> meshes;
  meshes.reserve(meshes_.size());
  for (const auto& [id, mesh] : meshes_) {
    if (!mesh->indices->empty()) meshes.push_back(mesh);  // with n = 2 all but the corner pieces are empty
  }
  return std::make_shared<const Scene>(serial_, spacing_, std::move(meshes), morph);
}

std::size_t NodeStore::bytes() const noexcept {
  return heightBytes_ + meshBytes_ + tree_.bytes() + drawn_.bytes() + indices_.bytes() +
         bends_.size() * kBendBytes + bookkeepingBytes_;
}

std::size_t NodeStore::heldBytes() const noexcept {
  const auto grid = [](int side) {
    return static_cast<std::size_t>(side) * static_cast<std::size_t>(side) * sizeof(float) +
           sizeof(HeightMap);
  };
  return grid(intervals_ + 1) + (withCoarser_ ? grid(CoarserSurface::side(intervals_)) : 0) +
         kTreeBytesPerNode + kBendBytes;
}

std::size_t NodeStore::piecesBytes() const noexcept {
  return pieceBytes(Piece::interior, intervals_) + pieceBytes(Piece::eastSeam, intervals_) +
         pieceBytes(Piece::northSeam, intervals_) + pieceBytes(Piece::cornerPiece, intervals_) +
         kTreeBytesPerNode + 4 * kBytesPerPiece;
}

std::size_t NodeStore::borderBytes() const {
  std::vector<NodeKey> around;
  for (std::int64_t j = -1; j <= 2; ++j) {
    for (std::int64_t i = -1; i <= 2; ++i) {
      if (i == -1 || i == 2 || j == -1 || j == 2) around.push_back({0, i, j});
    }
  }
  return BorderPlan({1, 0, 0}, around, intervals_).bytes() + kBytesPerPiece + kBytesPerBorder;
}

}  // namespace teren
