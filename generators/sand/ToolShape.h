// What a tool looks like from below: outlines that meet the ground and how deep the tool reaches inside them.
#pragma once

#include <span>
#include <vector>

#include "teren/Result.h"

namespace teren {

/// A point of a tool [m], from its middle; x is the way it is pushed, y to the left of it.
struct ToolPoint {
  double x = 0.0;
  double y = 0.0;
  friend bool operator==(const ToolPoint&, const ToolPoint&) = default;
};
using ToolOutline = std::vector<ToolPoint>;

/// How far the underside lies below the tool's zero [m]: a plane, from which a ball's rounding is taken.
struct ToolDepth {
  double middle = 0.0;  // [m] at the middle
  double slope = 0.0;   // [m/m], along x
  double ball = 0.0;    // [m] radius; 0: not round
  double at(const ToolPoint& p) const noexcept;
};

/// One closed outline (O), counter-clockwise, where the tool meets the ground, and inside it outlines (I)
/// that force the underside. An inner outline of one point is that point.
struct ToolPart {
  ToolOutline outer;
  std::vector<ToolOutline> inner;
  ToolDepth depth;
  double wall = 0.0;  // [m] thickness, straight across, between the outer outline and the first inner one
};

/// One or several parts that do not touch each other. Immutable. The first inner outline lies `wall` inside
/// the outer one, so that the surface stays a function: by default a twentieth of the size.
///
/// Every size is in metres and must be in [1e-6, 1e6], every depth in (0, 1e4]; anything else, an outline
/// that crosses or touches itself, has fewer than 3 or more than kMostPoints points, or is too narrow for its
/// wall is refused with one sentence.
class ToolShape {
 public:
  static constexpr std::size_t kMostPoints = 256;

  /// Any simple polygon, in either direction, with a level underside.
  static Result<ToolShape> polygon(std::span<const ToolPoint> outline, double depth);
  /// A disc as a regular polygon of `points` corners, 3 ... kMostPoints.
  static Result<ToolShape> disc(double radius, double depth, int points = 12);
  static Result<ToolShape> square(double side, double depth);
  /// `teeth` (1 ... 32) squares side by side across the way, their gaps as wide as they are.
  static Result<ToolShape> rake(double width, double depth, int teeth);
  /// A square whose underside falls from nothing behind to `depth` in front.
  static Result<ToolShape> wedge(double side, double depth);
  /// A ball of this radius that reaches `depth` down, at most its radius.
  static Result<ToolShape> ball(double radius, double depth);

  std::span<const ToolPart> parts() const noexcept { return parts_; }
  /// No point is farther from the middle [m].
  double reach() const noexcept { return reach_; }
  /// The largest depth [m].
  double depth() const noexcept { return depth_; }

 private:
  explicit ToolShape(std::vector<ToolPart> parts, double depth);

  std::vector<ToolPart> parts_;
  double reach_ = 0.0;
  double depth_ = 0.0;
};

}  // namespace teren
