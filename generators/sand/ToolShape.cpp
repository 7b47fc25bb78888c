#include "generators/sand/ToolShape.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "generators/numbers/Turn.h"

namespace teren {
namespace {

constexpr double kWallPart = 0.05;  // of the size

double turn(const ToolPoint& a, const ToolPoint& b, const ToolPoint& c) noexcept {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

double distance(const ToolPoint& a, const ToolPoint& b) noexcept {
  return std::sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y));
}

bool isBetween(const ToolPoint& a, const ToolPoint& b, const ToolPoint& p) noexcept {
  return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
         p.y <= std::max(a.y, b.y);
}

/// The closed segments a b and c d have a point in common.
bool meet(const ToolPoint& a, const ToolPoint& b, const ToolPoint& c, const ToolPoint& d) noexcept {
  const double ofC = turn(a, b, c), ofD = turn(a, b, d), ofA = turn(c, d, a), ofB = turn(c, d, b);
  if (((ofC > 0.0) != (ofD > 0.0)) && ((ofA > 0.0) != (ofB > 0.0)) && ofC * ofD != 0.0 && ofA * ofB != 0.0) {
    return true;
  }
  return (ofC == 0.0 && isBetween(a, b, c)) || (ofD == 0.0 && isBetween(a, b, d)) ||
         (ofA == 0.0 && isBetween(c, d, a)) || (ofB == 0.0 && isBetween(c, d, b));
}

bool isSimple(const ToolOutline& outline) noexcept {
  const std::size_t n = outline.size();
  for (std::size_t i = 0; i < n; ++i) {
    const ToolPoint &a = outline[i], &b = outline[(i + 1) % n], &after = outline[(i + 2) % n];
    if (a == b || (turn(a, b, after) == 0.0 && isBetween(a, b, after))) return false;
    for (std::size_t j = i + 2; j < n; ++j) {
      if ((j + 1) % n != i && meet(a, b, outline[j], outline[(j + 1) % n])) return false;
    }
  }
  return true;
}

double doubledArea(const ToolOutline& outline) noexcept {
  double sum = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const ToolPoint &a = outline[i], &b = outline[(i + 1) % outline.size()];
    sum += (a.x - outline[0].x) * (b.y - outline[0].y) - (a.y - outline[0].y) * (b.x - outline[0].x);
  }
  return sum;
}

double sizeOf(const ToolOutline& outline) noexcept {
  double reach = 0.0;
  for (const ToolPoint& p : outline) reach = std::max(reach, distance(p, outline[0]));
  return 0.5 * reach;
}

/// The outline moved inwards by `wall` on every side.
ToolOutline inset(const ToolOutline& outline, double wall) {
  ToolOutline inner;
  const std::size_t n = outline.size();
  for (std::size_t i = 0; i < n; ++i) {
    const ToolPoint &a = outline[(i + n - 1) % n], &b = outline[i], &c = outline[(i + 1) % n];
    const double ab = distance(a, b), bc = distance(b, c);
    const ToolPoint in{-(b.y - a.y) / ab, (b.x - a.x) / ab}, out{-(c.y - b.y) / bc, (c.x - b.x) / bc};
    const double part = wall / (1.0 + in.x * out.x + in.y * out.y);
    inner.push_back({b.x + part * (in.x + out.x), b.y + part * (in.y + out.y)});
  }
  return inner;
}

bool isInside(const ToolOutline& outer, const ToolOutline& inner) noexcept {
  for (std::size_t i = 0; i < inner.size(); ++i) {
    for (std::size_t j = 0; j < outer.size(); ++j) {
      if (meet(inner[i], inner[(i + 1) % inner.size()], outer[j], outer[(j + 1) % outer.size()]))
        return false;
    }
  }
  return doubledArea(inner) > 0.0 && doubledArea(inner) < doubledArea(outer);
}

std::optional<Error> refusal(const char* what, double value, double least, double most) {
  if (value >= least && value <= most) return std::nullopt;
  return Error{std::string("a tool's ") + what + " must be between " + std::to_string(least) + " and " +
               std::to_string(most) + " m, not " + std::to_string(value)};
}

std::optional<Error> refusal(const char* what, double size, double depth) {
  if (auto error = refusal(what, size, 1e-6, 1e6)) return error;
  return refusal("depth", depth, 1e-9, 1e4);
}

/// A part whose outline is checked, with one inner outline.
Result<ToolPart> partOf(ToolOutline outline, const ToolDepth& depth) {
  if (!isSimple(outline)) return Error{"a tool's outline must not cross or touch itself"};
  if (doubledArea(outline) < 0.0) std::reverse(outline.begin(), outline.end());
  const double wall = kWallPart * sizeOf(outline);
  ToolOutline inner = inset(outline, wall);
  if (!isSimple(inner) || !isInside(outline, inner)) {
    return Error{"a tool's outline is too narrow somewhere: there is no room for its walls"};
  }
  return ToolPart{std::move(outline), {std::move(inner)}, depth, wall};
}

ToolOutline squareAt(double x, double y, double half) {
  return {{x - half, y - half}, {x + half, y - half}, {x + half, y + half}, {x - half, y + half}};
}

ToolOutline circle(double radius, int points) {
  ToolOutline outline;
  for (int n = 0; n < points; ++n) {
    const SineCosine turn = sineCosineOfTurn(static_cast<double>(n) / points);
    outline.push_back({radius * turn.cosine, radius * turn.sine});
  }
  return outline;
}

}  // namespace

double ToolDepth::at(const ToolPoint& p) const noexcept {
  const double plane = middle + slope * p.x;
  if (ball == 0.0) return plane;
  const double below = ball * ball - p.x * p.x - p.y * p.y;
  return plane - ball + (below > 0.0 ? std::sqrt(below) : 0.0);
}

ToolShape::ToolShape(std::vector<ToolPart> parts, double depth) : parts_(std::move(parts)), depth_(depth) {
  for (const ToolPart& part : parts_) {
    for (const ToolPoint& p : part.outer) reach_ = std::max(reach_, distance(p, {}));
  }
}

Result<ToolShape> ToolShape::polygon(std::span<const ToolPoint> outline, double depth) {
  if (outline.size() < 3 || outline.size() > kMostPoints) {
    return Error{"a tool's outline must have 3 to " + std::to_string(kMostPoints) + " points, not " +
                 std::to_string(outline.size())};
  }
  for (const ToolPoint& p : outline) {
    if (!(std::fabs(p.x) <= 1e6 && std::fabs(p.y) <= 1e6)) {
      return Error{"a tool's outline must consist of numbers between -1000000 and 1000000 m"};
    }
  }
  ToolOutline points(outline.begin(), outline.end());
  if (auto error = refusal("size", sizeOf(points), depth)) return *error;
  Result<ToolPart> part = partOf(std::move(points), {depth, 0.0, 0.0});
  if (!part) return part.error();
  return ToolShape({*std::move(part)}, depth);
}

Result<ToolShape> ToolShape::disc(double radius, double depth, int points) {
  if (auto error = refusal("radius", radius, depth)) return *error;
  if (points < 3 || points > static_cast<int>(kMostPoints)) {
    return Error{"a round tool must have 3 to " + std::to_string(kMostPoints) + " points, not " +
                 std::to_string(points)};
  }
  return polygon(circle(radius, points), depth);
}

Result<ToolShape> ToolShape::square(double side, double depth) {
  if (auto error = refusal("side", side, depth)) return *error;
  return polygon(squareAt(0.0, 0.0, 0.5 * side), depth);
}

Result<ToolShape> ToolShape::rake(double width, double depth, int teeth) {
  if (auto error = refusal("width", width, depth)) return *error;
  if (teeth < 1 || teeth > 32) {
    return Error{"a rake must have 1 to 32 teeth, not " + std::to_string(teeth)};
  }
  const double tooth = width / (2 * teeth - 1);
  std::vector<ToolPart> parts;
  for (int n = 0; n < teeth; ++n) {
    Result<ToolPart> part =
        partOf(squareAt(0.0, 2 * n * tooth - 0.5 * (width - tooth), 0.5 * tooth), {depth, 0.0, 0.0});
    if (!part) return part.error();
    parts.push_back(*std::move(part));
  }
  return ToolShape(std::move(parts), depth);
}

Result<ToolShape> ToolShape::wedge(double side, double depth) {
  if (auto error = refusal("side", side, depth)) return *error;
  Result<ToolPart> part = partOf(squareAt(0.0, 0.0, 0.5 * side), {0.5 * depth, depth / side, 0.0});
  if (!part) return part.error();
  return ToolShape({*std::move(part)}, depth);
}

Result<ToolShape> ToolShape::ball(double radius, double depth) {
  if (auto error = refusal("radius", radius, depth)) return *error;
  if (depth > radius) return Error{"a ball reaches down by its radius at most"};
  const double contact = std::sqrt(depth * (2.0 * radius - depth));
  Result<ToolPart> part = partOf(circle(contact, 16), {depth, 0.0, radius});
  if (!part) return part.error();
  part->inner.push_back(circle(0.75 * contact, 12));
  part->inner.push_back(circle(0.4 * contact, 8));
  part->inner.push_back({{0.0, 0.0}});
  return ToolShape({*std::move(part)}, depth);
}

}  // namespace teren
