// Which nodes a view to the horizon wants: a cut through the quadtree by the error a person would see.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "teren/Engine.h"
#include "teren/GroundEdits.h"
#include "teren/Position.h"
#include "teren/Slice.h"

#include "patch/NodeKey.h"
#include "stream/Cut.h"

namespace teren {

/// An eye that land is drawn around.
struct Viewer {
  Position position;
  double height = 0.0;  ///< [m] above zero
  DetailSettings detail;
  double east = 0.0, north = 0.0, up = 0.0;  ///< [m] how far it will have moved in a while

  friend bool operator==(const Viewer&, const Viewer&) = default;
};

/// Chooses the coarsest nodes within every viewer's distance whose error, seen from there, is at most the
/// pixel error wanted (DetailThreshold.h): error [m] * pixels of a metre / distance [m] to the node's box
/// (its square, and the ground's range of heights), or kNearestGround where that is nearer. Nodes that touch,
/// be it in a corner, are of levels at most one apart. The cut covers whole roots: the nodes of the root
/// level within a viewer's distance, or an eighth farther if they were there before. A node stays split until
/// its error is a fifth below the one wanted. What a viewer will see on its way counts like what it sees, so
/// that nodes are there when they are needed.
///
/// In slices: the cut kept last stays as it is until the next is kept. The same viewers after the same ones
/// before give the same cut, whatever the slices. Not thread-safe. About 60 ns a node chosen
/// (bench-selection), and no allocation but for a cut larger than any before.
class Selection {
 public:
  /// What is known of a world.
  struct Ground {
    double pitch = 64.0;           ///< [m]
    double low = 0.0, high = 0.0;  ///< [m] heights
    std::vector<double> errors;  ///< [m] of nodes by level, from level 0 (the finest drawn) to the top level
    int coarsest = std::numeric_limits<int>::max();  ///< level that roots may have; the top level at most
  };
  explicit Selection(Ground ground);

  std::span<const double> errors() const noexcept { return ground_.errors; }
  /// As many as before. What is split now is not kept split by the next choice: what is chosen once all
  /// errors are known does not depend on what was known when.
  void setErrors(std::span<const double> errors) {
    ground_.errors.assign(errors.begin(), errors.end());
    roughNodes_.clear();
    forgets_ = true;
  }
  /// A node that is known to be rougher than others of its level.
  struct RoughNode {
    double error = 0.0;  ///< [m]
    double rim = 0.0;    ///< [m] how far its seams reach into the nodes beside it
  };
  /// At once: a choice under way is partly made without it, so choose again.
  void setError(const NodeKey& key, const RoughNode& node) { roughNodes_.insert_or_assign(key, node); }
  /// It is held no more, so nothing is drawn in its place by it; likewise.
  void forgetError(const NodeKey& key) { roughNodes_.erase(key); }

  /// [m] Between which the ground lies, as far as is known; from the next choice on.
  void setHeights(double low, double high) noexcept {
    ground_.low = low;
    ground_.high = high;
  }
  /// What edits add to the errors of nodes; null: nothing.
  void setEdits(std::shared_ptr<const GroundEdits> edits) { edits_ = std::move(edits); }

  /// Begins to choose, and forgets what was chosen but not kept. `tolerance` >= 1 multiplies every pixel
  /// error, where memory is short. More than `most` leaves beside the roots are not chosen.
  void begin(std::span<const Viewer> viewers, double tolerance,
             std::size_t most = std::numeric_limits<std::size_t>::max());
  /// Goes on; true once it has ended.
  bool step(const Slice& slice);
  /// Of one that has ended: false where there were more leaves than allowed, and nothing is chosen.
  bool hasChosen() const noexcept { return stage_ == Stage::chosen; }
  /// All at once; hasChosen().
  bool choose(std::span<const Viewer> viewers, double tolerance,
              std::size_t most = std::numeric_limits<std::size_t>::max());
  /// What was chosen last is what is split now, for the choices to come.
  void keep();

  /// Chosen last, kept or not; and what was kept last.
  const Cut& chosen() const noexcept { return cuts_[chosen_]; }
  Cut& chosen() noexcept { return cuts_[chosen_]; }
  const Cut& kept() const noexcept { return cuts_[kept_]; }
  Cut& kept() noexcept { return cuts_[kept_]; }

  /// Roots are of one level: the coarsest whose side is at most half the farthest viewer's distance, and
  /// never finer than before. Among roots the nearest are the most urgent, and go before all else.
  static int rootLevelFor(double distance, double pitch, int topLevel) noexcept;
  /// [m / m] How much farther away than new ones roots stay.
  static constexpr double kRootsStay = 1.125;

  /// [px / px] The largest error a viewer sees of this node, now or on its way, in terms of what it wants; 0
  /// where no viewer's distance reaches it.
  double seen(const NodeKey& key) const;

  std::size_t bytes() const noexcept;

 private:
  enum class Stage { chosen, refused, rooting, splitting, balancing, weighing, sorting };
  /// A viewer, as nodes are compared with it.
  struct Eye {
    Viewer viewer;
    double pixels = 0.0;  // of a metre one metre away, in terms of what is wanted
    double squaredDistance = 0.0;
    bool moves = false;
  };

  RoughNode roughness(const NodeKey& key) const {
    const auto own = roughNodes_.find(key);
    RoughNode node = own != roughNodes_.end()
                         ? own->second
                         : RoughNode{ground_.errors[static_cast<std::size_t>(key.level)], 0.0};
    if (edits_ && key.level > 0) node.error += edits_->moved(key.level, key.i, key.j);
    return node;
  }
  double side(int level) const noexcept { return sides_[static_cast<std::size_t>(level)]; }
  /// [m^2] across the ground, `share` of its way from where the viewer is now.
  double squaredAcross(const Eye& eye, const NodeKey& key, double share) const noexcept;
  /// Of an error of 1 m.
  double seenBy(const Eye& eye, const NodeKey& key, double share, double rim) const noexcept;
  double shareOfWay(const Eye& eye, const NodeKey& key) const noexcept;
  float rootUrgency(const NodeKey& root) const;
  bool divide(Cut::Index index, float urgency);
  void stepUnits();
  void findSomeRoots();
  void takeRoot(const Eye& eye, const NodeKey& key);
  void splitSome();
  void balanceSome();
  void balanceAround(Cut::Index index);
  void makeDivided(const NodeKey& key, float urgency);
  void weighSome();

  Ground ground_;
  std::unordered_map<NodeKey, RoughNode, NodeKeyHash> roughNodes_;  // few
  std::shared_ptr<const GroundEdits> edits_;
  std::vector<double> sides_;  // [m] by level
  std::vector<Eye> eyes_;
  double tolerance_ = 1.0;
  int rootLevel_ = 0;
  std::array<Cut, 2> cuts_;
  std::size_t chosen_ = 0, kept_ = 1;
  Stage stage_ = Stage::chosen;
  bool forgets_ = false;  // what is split now
  std::size_t next_ = 0;  // eye, node, split node of level_, node of the stage
  std::int64_t row_ = 0;  // of the eye's roots
  int level_ = 0;
  std::vector<std::vector<Cut::Index>> split_;  // by level, in the order they were split
  std::size_t left_ = 0;                        // nodes that may still be split
};

}  // namespace teren
