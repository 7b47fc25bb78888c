#include "stream/NodeStore.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "teren/HeightSampling.h"

namespace teren {

namespace {

// The containers' own nodes and the blocks that count references, as allocated (estimated).
constexpr std::size_t kBytesPerDrawnNode = 64;
constexpr std::size_t kBytesPerPiece = 224;     // in two maps and a scene
constexpr std::size_t kTreeBytesPerNode = 160;  // leaf, control block, its share of the branches

}  // namespace

std::vector<NodeKey> nodesOf(const PieceName& name) {
  const NodeKey& key = name.key;
  switch (name.piece) {
    case Piece::interior:
      return {key};
    case Piece::eastSeam:
      return {key, key.neighbour(1, 0)};
    case Piece::northSeam:
      return {key, key.neighbour(0, 1)};
    case Piece::cornerPiece:
      break;
  }
  return {key, key.neighbour(1, 0), key.neighbour(0, 1), key.neighbour(1, 1)};
}

std::array<PieceName, 9> piecesOf(const NodeKey& node) {
  return {{{node, Piece::interior},
           {node, Piece::eastSeam},
           {node.neighbour(-1, 0), Piece::eastSeam},
           {node, Piece::northSeam},
           {node.neighbour(0, -1), Piece::northSeam},
           {node, Piece::cornerPiece},
           {node.neighbour(-1, 0), Piece::cornerPiece},
           {node.neighbour(0, -1), Piece::cornerPiece},
           {node.neighbour(-1, -1), Piece::cornerPiece}}};
}

NodeHeights NodeStore::heights(const NodeKey& key) const {
  const NodeHeights* found = tree_.find(key, LookUp::none);
  return found ? *found : nullptr;
}

void NodeStore::insert(const NodeKey& key, NodeHeights heights) {
  assert(heights && heights->columns() == intervals_ + 1);
  NodeHeights& place = *tree_.find(key, LookUp::create);
  assert(!place);
  heightBytes_ += heights->bytes() + sizeof(HeightMap);
  place = std::move(heights);
}

void NodeStore::erase(const NodeKey& key) {
  const NodeHeights held = heights(key);
  if (!held) return;
  heightBytes_ -= held->bytes() + sizeof(HeightMap);
  tree_.erase(key);
  undraw(key);
}

void NodeStore::undraw(const NodeKey& key) {
  if (drawn_.erase(key) == 0) return;
  for (const PieceName& name : piecesOf(key)) {
    const auto piece = pieces_.find(name);
    if (piece == pieces_.end()) continue;
    meshBytes_ -= meshes_.at(piece->second)->bytes();
    meshes_.erase(piece->second);
    pieces_.erase(piece);
  }
  ++serial_;
}

std::vector<NodeKey> NodeStore::nodes() const {
  std::vector<NodeKey> keys;
  tree_.forEach([&](const NodeKey& key, const NodeHeights&) { keys.push_back(key); });
  return keys;
}

std::vector<PieceName> NodeStore::piecesToDraw(const NodeKey& node, const NodeSet& before) const {
  std::vector<PieceName> wanted;
  for (const PieceName& name : piecesOf(node)) {
    const std::vector<NodeKey> nodes = nodesOf(name);
    const bool complete = std::all_of(nodes.begin(), nodes.end(), [&](const NodeKey& key) {
      return key == node || drawn_.contains(key) || before.contains(key);
    });
    if (complete) wanted.push_back(name);
  }
  return wanted;
}

std::unique_ptr<MeshTask> NodeStore::makePiece(const PieceName& name) {
  NodeBlock block{name.key, {}};
  for (const NodeKey& key : nodesOf(name)) {
    const auto place = static_cast<std::size_t>((key.i - name.key.i) + 2 * (key.j - name.key.j));
    block.nodes[place] = heights(key);
    assert(block.nodes[place]);
  }
  const double spacing = spacing_ * static_cast<double>(std::int64_t{1} << name.key.level);
  return std::make_unique<MeshTask>(std::move(block), name.piece, spacing, indices_);
}

bool NodeStore::draw(const NodeKey& node, std::span<const BuiltPiece> pieces) {
  assert(!drawn_.contains(node) && heights(node));
  const std::vector<PieceName> wanted = piecesToDraw(node);
  const auto isFor = [](const BuiltPiece& built, const PieceName& name) { return built.name == name; };
  if (!std::equal(pieces.begin(), pieces.end(), wanted.begin(), wanted.end(), isFor)) return false;
  drawn_.insert(node);
  for (const BuiltPiece& built : pieces) {
    assert(!pieces_.contains(built.name));
    built.mesh->id = nextId_++;
    pieces_.emplace(built.name, built.mesh->id);
    meshes_.emplace_hint(meshes_.end(), built.mesh->id, built.mesh);
    meshBytes_ += built.mesh->bytes();
  }
  ++serial_;
  return true;
}

std::optional<double> NodeStore::height(const Position& position, int level) const {
  const NodeKey key = nodeAt(position, level);
  const NodeHeights held = heights(key);
  if (!held) return std::nullopt;
  const double patches = static_cast<double>(std::int64_t{1} << level);
  const double scale = intervals_ / patches;
  const double x = (static_cast<double>(position.i - (key.i << level)) + position.u) * scale;
  const double y = (static_cast<double>(position.j - (key.j << level)) + position.v) * scale;
  return triangleHeight(std::as_const(*held).view(), x, y);
}

std::shared_ptr<const Scene> NodeStore::snapshot() const {
  std::vector<std::shared_ptr<const Mesh>> meshes;
  meshes.reserve(meshes_.size());
  for (const auto& [id, mesh] : meshes_) {
    if (!mesh->indices->empty()) meshes.push_back(mesh);  // with n = 2 all but the corner pieces are empty
  }
  return std::make_shared<const Scene>(serial_, spacing_, std::move(meshes));
}

std::size_t NodeStore::bytes() const noexcept {
  return heightBytes_ + meshBytes_ + tree_.bytes() + indices_.bytes() + drawn_.size() * kBytesPerDrawnNode +
         pieces_.size() * kBytesPerPiece;
}

std::size_t NodeStore::heldBytes() const noexcept {
  const auto side = static_cast<std::size_t>(intervals_ + 1);
  return side * side * sizeof(float) + sizeof(HeightMap) + kTreeBytesPerNode;
}

std::size_t NodeStore::piecesBytes() const noexcept {
  return pieceBytes(Piece::interior, intervals_) + pieceBytes(Piece::eastSeam, intervals_) +
         pieceBytes(Piece::northSeam, intervals_) + pieceBytes(Piece::cornerPiece, intervals_) +
         kBytesPerDrawnNode + 4 * kBytesPerPiece;
}

}  // namespace teren
