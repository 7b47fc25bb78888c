#include "stream/NodeStore.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <iterator>
#include <tuple>
#include <utility>

#include "teren/HeightSampling.h"

#include "height/Surface.h"
#include "patch/CoarserSurface.h"
#include "patch/NodeGap.h"
#include "stream/MeshHeight.h"

namespace teren {

namespace {

// The containers' own nodes and the blocks that count references, as allocated: measured on scenes of 1,000
// to 12,000 meshes, and held against the heap in tests/engine/stream/Detail_test.cpp.
constexpr std::size_t kInStore = 240, kBorderInStore = 300;   // of a piece, in its map and in pages
constexpr std::size_t kInQuery = 180, kBorderInQuery = 1900;  // in a SceneQuery; its triangles besides
constexpr std::size_t kQueries = 2;                           // of the latest snapshot and of one before
constexpr std::size_t kBytesPerPiece = kInStore + kQueries * kInQuery;
constexpr std::size_t kBytesPerBorder = kBorderInStore + kQueries * kBorderInQuery;  // and more
constexpr std::size_t kTreeBytesPerNode = 160;  // leaf, control block, its share of the branches
constexpr std::size_t kRoughnessBytes = 64;     // in its map

constexpr std::array<Piece, 5> kPieces{Piece::interior, Piece::eastSeam, Piece::northSeam, Piece::cornerPiece,
                                       Piece::border};

bool byLevelAndKey(const NodeKey& a, const NodeKey& b) noexcept {
  return std::tie(a.level, a.j, a.i) < std::tie(b.level, b.j, b.i);
}

}  // namespace

NodeHeights NodeStore::heights(const NodeKey& key) const {
  if (showsComing_) {
    const auto shown = coming_.find(key);
    if (shown != coming_.end()) return shown->second.heights;
  }
  const NodeHeights* found = tree_.find(key, LookUp::none);
  return found ? *found : nullptr;
}

void NodeStore::insert(const NodeKey& key, EditedNode node, float bend) {
  assert(node.heights && node.heights->columns() == intervals_ + 1);
  NodeHeights& place = *tree_.find(key, LookUp::create);
  assert(!place);
  heightBytes_ += node.heights.bytes();
  roughness_.insert(key, Roughness{bend, node.moved});
  noteRange(*node.heights);
  place = std::move(node.heights);
}

void NodeStore::insert(const NodeKey& key, NodeHeights heights) {
  const auto bend = static_cast<float>(largestBend(heights->view()));
  insert(key, {std::move(heights)}, bend);
}

void NodeStore::noteRange(const HeightMap& heights) {
  const auto [low, high] = std::ranges::minmax_element(heights.samples());
  lowest_ = std::min(lowest_, *low);
  highest_ = std::max(highest_, *high);
}

void NodeStore::erase(const NodeKey& key) {
  assert(!isDrawn(key) && exchanged_.empty() && !showsComing_);
  const NodeHeights held = heights(key);
  if (!held) return;
  if (const auto coming = coming_.find(key); coming != coming_.end()) {
    heightBytes_ -= coming->second.heights.bytes();
    coming_.erase(coming);
  }
  heightBytes_ -= held.bytes();
  tree_.erase(key);
  roughness_.erase(key);
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
  NodeSet seen(affected.begin(), affected.end());
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
      const Drawn* const old = pieces_.find(piece.name);
      if (old != nullptr && (old->nodes.empty() || old->nodes == piece.nodes)) {
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

std::unique_ptr<PieceTask> NodeStore::makePiece(const PiecePlan& plan, bool ofComing) {
  const auto held = [&](const NodeKey& key) {
    const auto coming = ofComing ? coming_.find(key) : coming_.end();
    NodeHeights found = coming != coming_.end() ? coming->second.heights : heights(key);
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
  assert(exchanged_.empty() && !showsComing_);
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
    noteError(built.plan, *built.mesh, false);
    const std::size_t bytes = bytesOf(built.plan.name, *built.mesh);
    const bool isBorder = built.plan.name.piece == Piece::border;
    pieces_.insert(built.plan.name,
                   Drawn{built.mesh, nullptr, bytes, isBorder ? built.plan.nodes : std::vector<NodeKey>{}});
    if (!built.mesh->indices->empty()) meshes_.add(built.mesh);  // with n = 2 only corner pieces have any
    meshBytes_ += bytes;
    triangles_ += built.mesh->indices->size() / 3;
    bookkeepingBytes_ += bookkeeping(built.plan.name);
  }
  ++serial_;
  return true;
}

/// A border lies within its own node, the first; all others join nodes of one level.
void NodeStore::noteError(const PiecePlan& plan, Mesh& mesh, bool ofComing) const {
  mesh.nodeLevel = plan.name.key.level;
  const std::size_t count = plan.name.piece == Piece::border ? 1 : plan.nodes.size();
  for (std::size_t k = 0; k < count; ++k) {
    const Roughness& roughness = *roughness_.find(plan.nodes[k]);
    const auto coming = ofComing ? coming_.find(plan.nodes[k]) : coming_.end();
    mesh.bend = std::max(mesh.bend, roughness.bend);
    mesh.moved = std::max(mesh.moved, coming != coming_.end() ? coming->second.moved : roughness.moved);
  }
}

void NodeStore::dropPiece(const PieceName& name) {
  const Drawn& piece = *pieces_.find(name);
  meshBytes_ -= piece.bytes;
  droppedBytes_ += piece.bytes;
  bookkeepingBytes_ -= bookkeeping(name);
  triangles_ -= piece.mesh->indices->size() / 3;
  if (!piece.mesh->indices->empty()) meshes_.remove(piece.mesh->id);
  pieces_.erase(name);
}

std::size_t NodeStore::bookkeeping(const PieceName& name) noexcept {
  return kBytesPerPiece + (name.piece == Piece::border ? kBytesPerBorder : 0);
}

std::size_t NodeStore::bytesOf(const PieceName& name, const Mesh& mesh) noexcept {
  // The index lists of borders are their own; those of all other pieces are shared, and counted once.
  return mesh.bytes() +
         (name.piece == Piece::border ? mesh.indices->capacity() * sizeof(TriangleIndices::value_type) : 0);
}

// ---- Other heights

/// A coarser sample beyond a node's corner is one of its own spacing twice.
SampleBox NodeStore::seenFrom(const NodeKey& key) const noexcept {
  const std::int64_t across = std::int64_t{intervals_} << key.level, beyond = std::int64_t{2} << key.level;
  return {key.i * across - beyond, key.j * across - beyond, (key.i + 1) * across + beyond,
          (key.j + 1) * across + beyond};
}

void NodeStore::come(const NodeKey& key, EditedNode node) {
  assert(tree_.find(key, LookUp::none) != nullptr && node.heights && exchanged_.empty() && !showsComing_);
  noteRange(*node.heights);
  heightBytes_ += node.heights.bytes();
  EditedNode& place = coming_[key];
  if (place.heights) heightBytes_ -= place.heights.bytes();
  place = std::move(node);
}

std::vector<NodeKey> NodeStore::drawnAround(const NodeKey& key) const {
  std::vector<NodeKey> keys;
  forEachDrawnTouching(key, [&](const NodeKey& other) { keys.push_back(other); });
  return keys;
}

std::size_t NodeStore::planComing(const NodeKey& key, std::vector<PiecePlan>& plans) const {
  std::size_t bytes = 0;
  for (PiecePlan& piece : piecesOwnedBy(key, {drawn_, {}, {}})) {
    if (std::none_of(piece.nodes.begin(), piece.nodes.end(),
                     [&](const NodeKey& node) { return isComing(node); })) {
      continue;
    }
    bytes += plannedBytes(piece);
    plans.push_back(std::move(piece));
  }
  return bytes;
}

void NodeStore::exchange(BuiltPiece piece) {
  assert(!showsComing_);
  Drawn& drawn = *pieces_.find(piece.plan.name);
  assert(!drawn.next && (drawn.nodes.empty() || drawn.nodes == piece.plan.nodes));
  piece.mesh->id = nextId_++;
  noteError(piece.plan, *piece.mesh, true);
  const std::size_t bytes = bytesOf(piece.plan.name, *piece.mesh);
  if (!drawn.mesh->indices->empty()) {  // of as many triangles
    meshes_.remove(drawn.mesh->id);
    meshes_.add(piece.mesh);
  }
  meshBytes_ += bytes;  // those before still count, until all is settled
  drawn.bytes = bytes;
  drawn.next = std::move(piece.mesh);
  exchanged_.push_back(piece.plan.name);
}

void NodeStore::showComing() {
  assert(!showsComing_);
  showsComing_ = true;
  if (!exchanged_.empty()) ++serial_;
}

bool NodeStore::settleOne() {
  assert(showsComing_);
  if (!exchanged_.empty()) {
    Drawn& drawn = *pieces_.find(exchanged_.back());
    const std::size_t bytes = bytesOf(exchanged_.back(), *drawn.mesh);
    meshBytes_ -= bytes;
    oldBytes_ += bytes;
    replaced_.push_back({std::exchange(drawn.mesh, std::move(drawn.next)), bytes});
    drawn.next = nullptr;
    exchanged_.pop_back();
  } else if (!coming_.empty()) {
    const auto settled = coming_.begin();
    const NodeKey key = settled->first;
    NodeHeights& place = *tree_.find(key, LookUp::create);
    heightBytes_ -= place.bytes();
    place = std::move(settled->second.heights);
    roughness_.find(key)->moved = settled->second.moved;
    if (NodeHeights* drawn = drawn_.find(key, LookUp::none)) *drawn = place;
    coming_.erase(settled);
  } else {
    return showsComing_ = false;
  }
  return true;
}

bool NodeStore::freeSome() {
  constexpr std::size_t kAtOnce = 4;
  for (std::size_t k = 0; k < kAtOnce; ++k) {
    if (free_.empty()) return k > 0;
    oldBytes_ -= free_.back().bytes;
    free_.pop_back();
  }
  return true;
}

bool NodeStore::letGoOfOldSnapshots() {
  if (free_.empty()) {
    free_.swap(replaced_);
  } else {
    free_.insert(free_.end(), std::make_move_iterator(replaced_.begin()),
                 std::make_move_iterator(replaced_.end()));
    replaced_.clear();
  }
  return std::exchange(keptBytes_, 0) > 0;
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

/// The mesh that a square of a drawn node belongs to where that is a grid: its interior, or a seam or a
/// corner piece between nodes of its level. nullptr: it belongs to the node's border.
const Mesh* NodeStore::regularMeshAt(const NodeKey& node, const NodePlace& place) const {
  const int last = intervals_ - 1;
  const bool west = place.column == 0, south = place.row == 0;
  const bool acrossColumns = west || place.column == last, acrossRows = south || place.row == last;
  const Piece piece = acrossColumns && acrossRows ? Piece::cornerPiece
                      : acrossColumns             ? Piece::eastSeam
                      : acrossRows                ? Piece::northSeam
                                                  : Piece::interior;
  const Drawn* const drawn = pieces_.find({node.neighbour(west ? -1 : 0, south ? -1 : 0), piece});
  return drawn == nullptr ? nullptr : shown(*drawn);
}

std::optional<double> NodeStore::drawnHeight(const Position& position, const SeenVertices* seen) const {
  NodeKey node;
  if (drawn_.find(nodeAt(position, 0), LookUp::nearestCoarser, &node) == nullptr) return std::nullopt;
  const double n = intervals_, x = position.u * n, y = position.v * n;  // exact: n is a power of two
  const double squareX = std::floor(x), squareY = std::floor(y);
  const std::int64_t column = position.i * intervals_ + static_cast<std::int64_t>(squareX);
  const std::int64_t row = position.j * intervals_ + static_cast<std::int64_t>(squareY);
  const std::int64_t east = column - (node.i << node.level) * intervals_;
  const std::int64_t north = row - (node.j << node.level) * intervals_;
  const std::int64_t beyond = (std::int64_t{1} << node.level) - 1;
  const double step = 1.0 / static_cast<double>(beyond + 1);
  const NodePlace place{static_cast<int>(east >> node.level), static_cast<int>(north >> node.level),
                        (static_cast<double>(east & beyond) + (x - squareX)) * step,
                        (static_cast<double>(north & beyond) + (y - squareY)) * step};
  if (const Mesh* const mesh = regularMeshAt(node, place)) {
    const std::int64_t across = std::int64_t{mesh->columns} + 1;
    const SurfaceVertex* const south = mesh->vertices.data() +
                                       ((row - mesh->originRow) >> node.level) * across +
                                       ((column - mesh->originColumn) >> node.level);
    const auto height = [&](const SurfaceVertex& vertex) {
      return static_cast<double>(heightOf(*mesh, vertex, seen));
    };
    const SurfaceVertex* const above = south + across;
    return sampleTriangle({height(south[0]), height(south[1]), height(above[0]), height(above[1])}, place.x,
                          place.y)
        .height;
  }
  const Drawn* const border = pieces_.find({node, Piece::border});
  return border ? meshHeight(*shown(*border), column, row, x - squareX, y - squareY, seen) : std::nullopt;
}

std::shared_ptr<const Scene> NodeStore::snapshot(const Morph& morph) {
  keptBytes_ += std::exchange(droppedBytes_, 0);
  return std::make_shared<const Scene>(serial_, spacing_, meshes_.snapshot(), morph);
}

std::size_t NodeStore::bytes() const noexcept {
  return heightBytes_ + meshBytes_ + droppedBytes_ + keptBytes_ + oldBytes_ + tree_.bytes() + drawn_.bytes() +
         indices_.bytes() + roughness_.size() * kRoughnessBytes + bookkeepingBytes_;
}

std::size_t NodeStore::heldBytes() const noexcept {
  const auto grid = [](int side) {
    return static_cast<std::size_t>(side) * static_cast<std::size_t>(side) * sizeof(float) +
           sizeof(HeightMap);
  };
  return grid(intervals_ + 1) + (withCoarser_ ? grid(CoarserSurface::side(intervals_)) : 0) +
         kTreeBytesPerNode + kRoughnessBytes;
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
