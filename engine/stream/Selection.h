// Which nodes a view to the horizon wants: a cut through the quadtree by the error a person would see.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "teren/Engine.h"
#include "teren/Position.h"

#include "patch/NodeKey.h"

namespace teren {

/// An eye that land is drawn around.
struct Viewer {
  Position position;
  double height = 0.0;  ///< [m] above zero
  DetailSettings detail;
};

/// [px] What a metre one metre away from an eye measures on its screen.
double pixelsPerMetre(const DetailSettings& detail) noexcept;

/// A node of the cut, or one above it.
struct SelectedNode {
  NodeKey key;
  bool isLeaf = false;   ///< of the cut: to be drawn; others are coarser, and to be held
  double urgency = 0.0;  ///< how many times the error wanted is seen until it is there, or what waits for it
};

/// Chooses the coarsest nodes within every viewer's distance whose error, seen from there, is at most the
/// pixel error wanted: error [m] * pixelsPerMetre / distance [m] to the node's box (its square, and the
/// world's range of heights: mean +- 3 deviations). Nodes that touch, be it in a corner, are of levels at
/// most one apart. The cut covers whole roots: the nodes of rootLevel() within a viewer's distance. A node
/// stays split until its error is a fifth below the one wanted, so that who flies to and fro does not make it
/// come and go. The same viewers after the same ones before give the same cut. Not thread-safe. Costs about 1
/// us a node chosen.
class Selection {
 public:
  /// What is known of a world.
  struct Ground {
    double pitch = 64.0;           ///< [m]
    double low = 0.0, high = 0.0;  ///< [m] heights
    std::vector<double> errors;  ///< [m] of nodes by level, from level 0 (the finest drawn) to the top level
    int coarsest = std::numeric_limits<int>::max();  ///< level that roots may have; the top level at most
  };
  explicit Selection(Ground ground) : ground_(std::move(ground)) {}

  const std::vector<double>& errors() const noexcept { return ground_.errors; }
  /// As many as before.
  void setErrors(std::vector<double> errors) { ground_.errors = std::move(errors); }

  /// `tolerance` >= 1 multiplies every pixel error, where memory is short. False as soon as there are more
  /// than `most` leaves beside the roots, and then nothing is chosen: so the cost is bounded.
  bool choose(std::span<const Viewer> viewers, double tolerance,
              std::size_t most = std::numeric_limits<std::size_t>::max());
  /// What was chosen last is what is split now, for the choices to come.
  void keep();

  /// The most urgent first, and every node after the one above it.
  std::span<const SelectedNode> nodes() const noexcept { return nodes_; }
  std::size_t leaves() const noexcept { return leaves_; }
  /// Roots are of one level: the coarsest whose side is at most half the farthest viewer's distance, and
  /// never finer than before. Among roots the nearest are the most urgent, and go before all else.
  int rootLevel() const noexcept { return rootLevel_; }
  static int rootLevelFor(double distance, double pitch, int topLevel) noexcept;
  bool isRoot(const NodeKey& key) const { return key.level == rootLevel_ && roots_.contains(key); }
  /// Whether a node is one of nodes(), and a leaf.
  bool isLeaf(const NodeKey& key) const;
  bool contains(const NodeKey& key) const;

  /// [px / px] The largest error a viewer sees of this node, in terms of what it wants; 0 where no viewer's
  /// distance reaches it.
  double seen(const NodeKey& key) const;

 private:
  using Splits = std::unordered_map<NodeKey, double, NodeKeyHash>;  // to urgencies

  double distance(const Viewer& viewer, const NodeKey& key) const;
  void findRoots();
  double rootUrgency(const NodeKey& root) const;
  bool split(const NodeKey& key, double tolerance);
  bool balance();
  void list(const NodeKey& key, double urgency);

  Ground ground_;
  std::vector<Viewer> viewers_;
  int rootLevel_ = 0;
  Splits roots_, before_;
  std::vector<Splits> splits_;  // by level
  std::vector<SelectedNode> nodes_;
  std::size_t leaves_ = 0;
  std::size_t left_ = 0;  // nodes that may still be split
};

}  // namespace teren
