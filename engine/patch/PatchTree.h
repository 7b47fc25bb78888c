// The patch tree: quadtree of nodes over an unbounded plane, with nothing in it but what was asked for.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <memory>
#include <utility>

#include "patch/NodeKey.h"

namespace teren {

/// What a look-up does where the tree has no data for the key.
enum class LookUp {
  create,          ///< makes a place for data there, growing new roots as needed
  nearestCoarser,  ///< the data of the closest ancestor that has any
  none,            ///< nothing
};

/// Data of type T (default-constructible; empty when `!data`, such as a shared_ptr) by node. A node may hold
/// data of its level or only lead to finer ones. Aligned nodes on either side of a world axis share no
/// ancestor, so there is one root a quadrant of the plane; each starts as one node and, asked for a node
/// outside itself, grows roots of twice the side. Look-ups cost O(root level - level). Not thread-safe.
template <class T>
class PatchTree {
 public:
  /// The place for data at `key` (create), the data found (nearestCoarser: then `found`, if given, is the key
  /// it belongs to), or nullptr. Pointers last until that node is erased.
  T* find(const NodeKey& key, LookUp strategy, NodeKey* found = nullptr);
  const T* find(const NodeKey& key, LookUp strategy, NodeKey* found = nullptr) const {
    assert(strategy != LookUp::create);
    return const_cast<PatchTree*>(this)->find(key, strategy, found);
  }

  /// Empties the node and drops branches that lead nowhere. Nothing happens where there is no data.
  void erase(const NodeKey& key);

  /// Calls visit(key, data) for every node with data, parents before children.
  template <class Visit>
  void forEach(Visit&& visit) const {
    for (const Root& root : roots_) {
      if (root.node) forEachBelow(*root.node, root.key, visit);
    }
  }

  /// Calls visit(key, data) for every node with data, of whatever level, whose square and that of `key` have
  /// a point in common, be it only a corner; `key` itself and what overlaps it included. Costs O(depth) for
  /// each.
  template <class Visit>
  void forEachTouching(const NodeKey& key, Visit&& visit) const {
    for (const Root& root : roots_) {
      if (root.node) forEachTouchingBelow(*root.node, root.key, key, visit);
    }
  }

  /// Calls visit(key, data) for every node with data for which mayHold(key) is true, and which lies in none
  /// for which it is false; parents before children.
  template <class MayHold, class Visit>
  void forEachWhere(MayHold&& mayHold, Visit&& visit) const {
    for (const Root& root : roots_) {
      if (root.node) forEachWhereBelow(*root.node, root.key, mayHold, visit);
    }
  }

  /// Whether a node inside `key`, or itself, has data.
  bool hasIn(const NodeKey& key) const noexcept { return branchAt(key).node != nullptr; }
  /// Calls visit(key, data) for every node with data inside `key`, itself included, parents before children,
  /// until it returns false.
  template <class Visit>
  void forEachIn(const NodeKey& key, Visit&& visit) const {
    const Branch branch = branchAt(key);
    if (branch.node) forEachInBelow(*branch.node, branch.key, visit);
  }

  /// Level of the root of the quadrant `key` lies in, -1 where there is none.
  int rootLevel(const NodeKey& key) const noexcept {
    const Root& root = roots_[quadrant(key)];
    return root.node ? root.key.level : -1;
  }
  std::size_t nodeCount() const noexcept { return count_; }
  std::size_t bytes() const noexcept { return count_ * sizeof(Node); }

 private:
  struct Node {
    T data{};
    std::array<std::unique_ptr<Node>, 4> children;
  };
  struct Root {
    NodeKey key;
    std::unique_ptr<Node> node;
  };

  struct Branch {
    const Node* node;
    NodeKey key;
  };

  static std::size_t quadrant(const NodeKey& key) noexcept {
    return (key.i < 0 ? 1U : 0U) + (key.j < 0 ? 2U : 0U);
  }
  /// Which child of its ancestor at `level` + 1 contains `key`.
  static std::size_t childAt(const NodeKey& key, int level) noexcept {
    const NodeKey step = key.ancestor(level);
    return static_cast<std::size_t>((step.i & 1) | ((step.j & 1) << 1));
  }
  std::unique_ptr<Node> makeNode() {
    ++count_;
    return std::make_unique<Node>();
  }
  void growRoot(Root& root, const NodeKey& key);
  bool eraseBelow(std::unique_ptr<Node>& node, int level, const NodeKey& key);

  /// All that lies inside `key`: its node, or the root if that does; none where nothing has data there.
  Branch branchAt(const NodeKey& key) const noexcept {
    const Root& root = roots_[quadrant(key)];
    if (!root.node || isIn(root.key, key)) return {root.node.get(), root.key};
    if (!isIn(key, root.key)) return {nullptr, key};
    const Node* node = root.node.get();
    for (int level = root.key.level; node && level > key.level; --level) {
      node = node->children[childAt(key, level - 1)].get();
    }
    return {node, key};
  }

  template <class Visit>
  static bool forEachInBelow(const Node& node, const NodeKey& key, Visit& visit) {
    if (node.data && !visit(key, node.data)) return false;
    for (std::size_t child = 0; child < 4; ++child) {
      const auto& branch = node.children[child];
      if (branch && !forEachInBelow(*branch, key.child(static_cast<int>(child)), visit)) return false;
    }
    return true;
  }

  template <class MayHold, class Visit>
  static void forEachWhereBelow(const Node& node, const NodeKey& key, MayHold& mayHold, Visit& visit) {
    if (!mayHold(key)) return;
    if (node.data) visit(key, node.data);
    for (std::size_t child = 0; child < 4; ++child) {
      const auto& branch = node.children[child];
      if (branch) forEachWhereBelow(*branch, key.child(static_cast<int>(child)), mayHold, visit);
    }
  }

  template <class Visit>
  static void forEachTouchingBelow(const Node& node, const NodeKey& at, const NodeKey& key, Visit& visit) {
    if (!touch(at, key)) return;
    if (node.data) visit(at, node.data);
    for (std::size_t child = 0; child < 4; ++child) {
      if (node.children[child])
        forEachTouchingBelow(*node.children[child], at.child(static_cast<int>(child)), key, visit);
    }
  }

  template <class Visit>
  static void forEachBelow(const Node& node, const NodeKey& key, Visit& visit) {
    if (node.data) visit(key, node.data);
    for (std::size_t child = 0; child < 4; ++child) {
      if (!node.children[child]) continue;
      forEachBelow(*node.children[child], key.child(static_cast<int>(child)), visit);
    }
  }

  std::array<Root, 4> roots_;
  std::size_t count_ = 0;
};

template <class T>
void PatchTree<T>::growRoot(Root& root, const NodeKey& key) {
  if (!root.node) {
    root.key = key;
    root.node = makeNode();
  }
  while (root.key.level < key.level || key.ancestor(root.key.level) != root.key) {
    std::unique_ptr<Node> above = makeNode();
    above->children[childAt(root.key, root.key.level)] = std::move(root.node);
    root.node = std::move(above);
    root.key = root.key.parent();
  }
}

template <class T>
T* PatchTree<T>::find(const NodeKey& key, LookUp strategy, NodeKey* found) {
  Root& root = roots_[quadrant(key)];
  if (strategy == LookUp::create) growRoot(root, key);
  if (!root.node || root.key.level < key.level || key.ancestor(root.key.level) != root.key) return nullptr;
  Node* node = root.node.get();
  T* nearest = node->data ? &node->data : nullptr;
  int nearestLevel = root.key.level;
  int level = root.key.level;
  while (level > key.level) {
    std::unique_ptr<Node>& child = node->children[childAt(key, level - 1)];
    if (!child && strategy != LookUp::create) break;
    if (!child) child = makeNode();
    node = child.get();
    --level;
    if (node->data) {
      nearest = &node->data;
      nearestLevel = level;
    }
  }
  if (strategy == LookUp::create) return &node->data;
  if (!nearest || (strategy == LookUp::none && nearestLevel != key.level)) return nullptr;
  if (found) *found = key.ancestor(nearestLevel);
  return nearest;
}

template <class T>
bool PatchTree<T>::eraseBelow(std::unique_ptr<Node>& node, int level, const NodeKey& key) {
  if (level == key.level) {
    node->data = T{};
  } else {
    std::unique_ptr<Node>& child = node->children[childAt(key, level - 1)];
    if (!child || !eraseBelow(child, level - 1, key)) return false;
  }
  for (const auto& child : node->children) {
    if (child) return false;
  }
  if (node->data) return false;
  node.reset();
  --count_;
  return true;
}

template <class T>
void PatchTree<T>::erase(const NodeKey& key) {
  Root& root = roots_[quadrant(key)];
  if (!root.node || root.key.level < key.level || key.ancestor(root.key.level) != root.key) return;
  eraseBelow(root.node, root.key.level, key);
}

}  // namespace teren
