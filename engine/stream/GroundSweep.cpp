#include "stream/GroundSweep.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "teren/HeightMap.h"

#include "stream/GridWalk.h"
#include "stream/NodeStore.h"

namespace teren {
namespace {

/// Ways that cross more patches than this look at those held instead.
constexpr double kPatchesMarched = 256.0;

struct Cells {
  double first = 0.0, last = -1.0;
};

/// The cells of a lattice that a coordinate, a reach wide to both sides, comes over during a span.
Cells cellsOver(double from, double to, const Span& span, double reach, double cell) {
  const double a = from + span.begin * (to - from), b = from + span.end * (to - from);
  return {std::floor((std::min(a, b) - reach) / cell), std::floor((std::max(a, b) + reach) / cell)};
}

struct Square {
  std::array<Vector3, 4> corners;  // south-west, south-east, north-east, north-west
  Span span;                       // when the ball may be near it
};

/// Finds the squares near a ball's way.
class March {
 public:
  March(const FinestGround& ground, double pitch, const Position& origin, const MovingBall& ball)
      : ground_(ground), pitch_(pitch), origin_(origin), ball_(ball) {
    const Vector3 way = ball.to - ball.from;
    // A little more than the radius, so that rounding leaves no square out.
    reach_ = ball.radius * (1.0 + 1e-9) + 2.0 * sweepError(std::sqrt(dot(way, way)));
  }

  /// Calls visit(square) for each square that is held, roughly along the way.
  template <class Visit>
  void overSquares(const Visit& visit) const {
    const double crossed =
        (std::fabs(ball_.to.x - ball_.from.x) + std::fabs(ball_.to.y - ball_.from.y)) / pitch_;
    if (crossed > kPatchesMarched) {
      for (const NodeKey& key : ground_.patches()) overPatch(key.i, key.j, visit);
      return;
    }
    const Cells rows = cellsOver(ball_.from.y, ball_.to.y, {}, reach_, pitch_);
    for (double row = rows.first; row <= rows.last; row += 1.0) {
      const Span span = spanWithin(ball_.from.y, ball_.to.y - ball_.from.y, row * pitch_ - reach_,
                                   (row + 1.0) * pitch_ + reach_, {});
      if (span.empty()) continue;
      const Cells columns = cellsOver(ball_.from.x, ball_.to.x, span, reach_, pitch_);
      for (double column = columns.first; column <= columns.last; column += 1.0) {
        overPatch(origin_.i + static_cast<std::int64_t>(column), origin_.j + static_cast<std::int64_t>(row),
                  visit);
      }
    }
  }

 private:
  template <class Visit>
  void overPatch(std::int64_t i, std::int64_t j, const Visit& visit) const {
    const double west = static_cast<double>(i - origin_.i) * pitch_;
    const double south = static_cast<double>(j - origin_.j) * pitch_;
    Span span =
        spanWithin(ball_.from.x, ball_.to.x - ball_.from.x, west - reach_, west + pitch_ + reach_, {});
    span = spanWithin(ball_.from.y, ball_.to.y - ball_.from.y, south - reach_, south + pitch_ + reach_, span);
    if (span.empty()) return;
    const NodeHeights heights = ground_.patch(i, j);
    if (!heights) return;
    const ConstHeightView view = std::as_const(*heights).view();
    const int n = view.columns() - 1;
    const double side = pitch_ / n;
    const auto [bottom, top] = range(ball_.from.y - south, ball_.to.y - south, span, side, n);
    for (int row = bottom; row <= top; ++row) {
      const double edge = south + row * side;
      const Span inRow =
          spanWithin(ball_.from.y, ball_.to.y - ball_.from.y, edge - reach_, edge + side + reach_, span);
      if (inRow.empty()) continue;
      const auto [left, right] = range(ball_.from.x - west, ball_.to.x - west, inRow, side, n);
      for (int column = left; column <= right; ++column) {
        const auto corner = [&](int x, int y) {
          return Vector3{west + x * side, south + y * side, static_cast<double>(view(x, y))};
        };
        visit(Square{{corner(column, row), corner(column + 1, row), corner(column + 1, row + 1),
                      corner(column, row + 1)},
                     inRow});
      }
    }
  }

  std::pair<int, int> range(double from, double to, const Span& span, double side, int n) const {
    const Cells cells = cellsOver(from, to, span, reach_, side);
    return {static_cast<int>(std::clamp(cells.first, 0.0, n - 1.0)),
            static_cast<int>(std::clamp(cells.last, -1.0, n - 1.0))};
  }

  const FinestGround& ground_;
  double pitch_;
  const Position& origin_;
  const MovingBall& ball_;
  double reach_ = 0.0;
};

double highest(const Square& square) {
  const auto& c = square.corners;
  return std::max(std::max(c[0].z, c[1].z), std::max(c[2].z, c[3].z));
}

double lowest(const Square& square) {
  const auto& c = square.corners;
  return std::min(std::min(c[0].z, c[1].z), std::min(c[2].z, c[3].z));
}

/// The first touch with a square's two triangles, from above.
void sweepSquare(const MovingBall& ball, const Square& square, std::optional<Touch>& best) {
  const auto& [southWest, southEast, northEast, northWest] = square.corners;
  const auto fromAbove = [&best](const std::optional<Touch>& touch) {
    if (touch && touch->normal.z > 0.0) takeEarlier(best, touch);
  };
  fromAbove(sweepFace(ball, southWest, southEast, northEast));
  fromAbove(sweepFace(ball, southWest, northEast, northWest));
  fromAbove(sweepSegment(ball, southWest, northEast));
  for (std::size_t k = 0; k < 4; ++k) {
    fromAbove(sweepSegment(ball, square.corners[k], square.corners[(k + 1) % 4]));
    fromAbove(sweepPoint(ball, square.corners[k]));
  }
}

MovingBall withLeastRadius(MovingBall ball) {
  const Vector3 way = ball.to - ball.from;
  ball.radius = std::max(ball.radius, sweepError(std::sqrt(dot(way, way))));
  return ball;
}

}  // namespace

NodeHeights StoredGround::patch(std::int64_t i, std::int64_t j) const {
  return nodes_.heights({0, i, j});
}

std::vector<NodeKey> StoredGround::patches() const {
  std::vector<NodeKey> keys = nodes_.nodes();
  std::erase_if(keys, [](const NodeKey& key) { return key.level != 0; });
  return keys;
}

std::optional<Touch> GroundSweep::sweep(const Position& origin, const MovingBall& asked) const {
  const MovingBall ball = withLeastRadius(asked);
  const double rise = ball.to.z - ball.from.z;
  std::optional<Touch> best;
  March(ground_, pitch_, origin, ball).overSquares([&](const Square& square) {
    if (best && square.span.begin > best->time) return;
    const double low = ball.from.z + std::min(square.span.begin * rise, square.span.end * rise);
    if (low - ball.radius <= highest(square) + sweepError(std::fabs(rise))) sweepSquare(ball, square, best);
  });
  return best;
}

std::optional<GroundSweep::Rest> GroundSweep::rest(const Position& origin, double x, double y,
                                                   double radius) const {
  MovingBall ball{{x, y, 0.0}, {x, y, 0.0}, std::max(radius, sweepError(0.0))};
  double top = -std::numeric_limits<double>::infinity(), bottom = -top;
  const March march(ground_, pitch_, origin, ball);  // twice over the squares, so that they need no room
  march.overSquares([&](const Square& square) {
    top = std::max(top, highest(square));
    bottom = std::min(bottom, lowest(square));
  });
  if (top < bottom) return std::nullopt;
  ball.from.z = top + ball.radius + 1.0;
  ball.to.z = bottom - ball.radius - 1.0;
  ball = withLeastRadius(ball);
  std::optional<Touch> touch;
  march.overSquares([&](const Square& square) { sweepSquare(ball, square, touch); });
  if (!touch) return std::nullopt;
  return Rest{ball.at(touch->time).z, touch->normal};
}

}  // namespace teren
