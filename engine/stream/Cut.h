// A cut through the quadtree of nodes, and all that is above it: what a view wants to be drawn and held.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "patch/NodeKey.h"
#include "stream/NodeTable.h"

namespace teren {

/// Roots of one level and, of each, itself or its four children, or theirs in turn. Everything lies in arrays
/// that keep their room from one cut to the next, so a cut like the one before allocates nothing. Not
/// thread-safe.
class Cut {
 public:
  using Index = NodeTable::Value;
  static constexpr Index kNone = NodeTable::kNone;

  struct Node {
    NodeKey key;
    Index parent = kNone;
    Index children = kNone;  ///< the first of four; none: a leaf, to be drawn
    Index before = kNone;    ///< the same node in the cut before
    Index place = kNone;     ///< in byUrgency()
    float urgency = 0.0F;    ///< how many times the error wanted is seen until the node is there
    float own = 0.0F;        ///< the same of its children, where it has some
    std::uint8_t marks = 0;  ///< of whoever follows the cut; 0 at first
    bool isLeaf() const noexcept { return children == kNone; }
  };

  void clear(int rootLevel);
  /// Of the root level, and none twice.
  Index addRoot(const NodeKey& key);
  bool hasRoot(const NodeKey& key) const { return roots_.contains(key); }
  /// Gives a leaf four children.
  void divide(Index leaf);

  /// Goes on putting the nodes into byUrgency(), some 4 ns each five times over, `most` of them at once; true
  /// once that is done: then every node comes after the one above it if it is no more urgent. None may be
  /// added meanwhile.
  bool sortSome(std::size_t most);
  /// The most urgent first; of equally urgent ones, first the one that was added first.
  std::span<const Index> byUrgency() const noexcept { return order_; }

  std::size_t size() const noexcept { return nodes_.size(); }
  std::size_t leaves() const noexcept { return leaves_; }
  /// Parents before children.
  const Node& operator[](Index index) const { return nodes_[static_cast<std::size_t>(index)]; }
  Node& operator[](Index index) { return nodes_[static_cast<std::size_t>(index)]; }
  int rootLevel() const noexcept { return rootLevel_; }

  /// O(root level - level), like the next; kNone where the key is not of the cut or above it.
  Index find(const NodeKey& key) const;
  /// The node that contains this one and is nearest to it.
  Index nearest(const NodeKey& key) const;

  std::size_t bytes() const noexcept;

 private:
  struct Entry {
    std::uint32_t key;  // ascending where urgencies descend
    Index index;
  };
  enum class Sorting { counting, low, middle, high, placing };
  static constexpr unsigned kBits = 11;  // of the key, sorted by at a time
  static constexpr std::size_t kDigits = std::size_t{1} << kBits, kPasses = 3;
  static std::size_t digit(std::uint32_t key, std::size_t pass) noexcept {
    return (key >> (kBits * pass)) & (kDigits - 1);
  }
  void count(std::size_t from, std::size_t to);
  void endCounting();
  void scatter(std::size_t from, std::size_t to);
  void place(std::size_t from, std::size_t to);

  int rootLevel_ = 0;
  std::vector<Node> nodes_;
  std::size_t leaves_ = 0;
  NodeTable roots_;
  std::vector<Entry> entries_, sorted_;
  std::vector<Index> order_;
  Sorting sorting_ = Sorting::counting;
  std::size_t next_ = 0;
  std::array<std::array<std::uint32_t, kDigits>, kPasses> starts_{};  // of each digit, by pass
};

}  // namespace teren
