#include "stream/Refinement.h"

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

namespace teren {

namespace {

std::array<NodeKey, 4> childrenOf(const NodeKey& key) noexcept {
  std::array<NodeKey, 4> children;
  for (int child = 0; child < 4; ++child) {
    children[static_cast<std::size_t>(child)] = key.child(child);
  }
  return children;
}

/// The drawn nodes of the first old root that the selection has no root for.
std::vector<NodeKey> outside(const NodeStore& nodes, const Selection& wanted) {
  std::vector<NodeKey> keys;
  NodeKey root;
  nodes.forEachDrawn([&](const NodeKey& key) {
    const int level = std::max(key.level, wanted.rootLevel());
    const NodeKey own = key.ancestor(level);
    if (wanted.isRoot(own) || (!keys.empty() && own != root)) return;
    root = own;
    keys.push_back(key);
  });
  return keys;
}

bool canSplit(const NodeStore& nodes, const NodeKey& key) {
  const std::array<NodeKey, 4> children = childrenOf(key);
  if (!std::all_of(children.begin(), children.end(),
                   [&](const NodeKey& child) { return nodes.heights(child); })) {
    return false;
  }
  const std::vector<NodeKey> around = nodes.drawnAround(key);
  return std::all_of(around.begin(), around.end(),
                     [&](const NodeKey& other) { return other.level <= key.level; });
}

bool isInAny(const NodeKey& key, const std::vector<NodeKey>& nodes) {
  return std::any_of(nodes.begin(), nodes.end(), [&](const NodeKey& node) { return isIn(key, node); });
}

}  // namespace

DrawnChange nextChange(const NodeStore& nodes, const Selection& wanted, std::size_t most) {
  DrawnChange change{outside(nodes, wanted), {}};
  if (!change.remove.empty()) return change;
  std::size_t steps = 0;
  for (const SelectedNode& node : wanted.nodes()) {
    if (!node.isLeaf || nodes.isDrawn(node.key) || !nodes.heights(node.key)) continue;
    const std::vector<NodeKey> finer = nodes.drawnIn(node.key);
    if (finer.empty()) continue;
    change.remove.insert(change.remove.end(), finer.begin(), finer.end());
    change.add.push_back(node.key);
    if (++steps == most) break;
  }
  if (steps > 0) return change;
  for (const SelectedNode& node : wanted.nodes()) {
    const std::optional<NodeKey> drawn = nodes.drawnOver(node.key);
    if (!drawn && nodes.heights(node.key) && nodes.drawnIn(node.key).empty() &&
        !isInAny(node.key, change.add)) {
      change.add.push_back(node.key);
    } else if (!node.isLeaf && drawn == node.key && canSplit(nodes, node.key)) {
      const std::array<NodeKey, 4> children = childrenOf(node.key);
      change.remove.push_back(node.key);
      change.add.insert(change.add.end(), children.begin(), children.end());
    } else {
      continue;
    }
    if (++steps == most) break;
  }
  return change;
}

}  // namespace teren
