// Finest grounds of known shape, and how far they are from a point, in long double and without any
// cleverness.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "teren/Hash.h"
#include "teren/Object.h"

#include "stream/GroundSweep.h"

namespace teren {

/// Patches with `intervals` squares a side, their heights a function of the sample's column and row.
class PatchGround final : public FinestGround {
 public:
  using Shape = std::function<double(std::int64_t column, std::int64_t row)>;

  PatchGround(double pitch, int intervals, Shape shape)
      : pitch_(pitch), intervals_(intervals), shape_(std::move(shape)) {}

  void add(std::int64_t i, std::int64_t j) {
    auto heights = std::make_shared<HeightMap>(intervals_ + 1, intervals_ + 1);
    for (int row = 0; row <= intervals_; ++row) {
      for (int column = 0; column <= intervals_; ++column) {
        (*heights)(column, row) = static_cast<float>(shape_(i * intervals_ + column, j * intervals_ + row));
      }
    }
    patches_[{i, j}] = std::move(heights);
  }
  void addAround(std::int64_t radius) {
    for (std::int64_t j = -radius; j < radius; ++j) {
      for (std::int64_t i = -radius; i < radius; ++i) add(i, j);
    }
  }

  NodeHeights patch(std::int64_t i, std::int64_t j) const override {
    const auto found = patches_.find({i, j});
    return found == patches_.end() ? nullptr : found->second;
  }
  std::vector<NodeKey> patches() const override {
    std::vector<NodeKey> keys;
    for (const auto& [place, heights] : patches_) keys.push_back({0, place.first, place.second});
    return keys;
  }

  double pitch() const { return pitch_; }
  double spacing() const { return pitch_ / intervals_; }

  /// [m] From a point, metres from patch (0, 0), to the nearest of the triangles within `reach`; the height
  /// of the point above the triangle over or under it goes to `above` (unchanged where there is none).
  long double distance(long double x, long double y, long double z, long double reach,
                       long double* above = nullptr) const;

 private:
  double pitch_;
  int intervals_;
  Shape shape_;
  std::map<std::pair<std::int64_t, std::int64_t>, std::shared_ptr<const HeightMap>> patches_;
};

using Point = std::array<long double, 3>;

inline Point minus(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline long double times(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline long double length(const Point& a) {
  return std::sqrt(times(a, a));
}

inline long double distanceToSegment(const Point& p, const Point& a, const Point& b) {
  const Point side = minus(b, a), away = minus(p, a);
  const long double share = std::clamp(times(away, side) / times(side, side), 0.0L, 1.0L);
  return length(minus(away, {share * side[0], share * side[1], share * side[2]}));
}

inline long double distanceToTriangle(const Point& p, const Point& a, const Point& b, const Point& c) {
  const Point ab = minus(b, a), ac = minus(c, a), away = minus(p, a);
  const long double d00 = times(ab, ab), d01 = times(ab, ac), d11 = times(ac, ac);
  const long double d20 = times(away, ab), d21 = times(away, ac), whole = d00 * d11 - d01 * d01;
  const long double v = (d11 * d20 - d01 * d21) / whole, w = (d00 * d21 - d01 * d20) / whole;
  if (v >= 0.0L && w >= 0.0L && v + w <= 1.0L) {
    return length(minus(away, {v * ab[0] + w * ac[0], v * ab[1] + w * ac[1], v * ab[2] + w * ac[2]}));
  }
  return std::min({distanceToSegment(p, a, b), distanceToSegment(p, b, c), distanceToSegment(p, c, a)});
}

inline long double PatchGround::distance(long double x, long double y, long double z, long double reach,
                                         long double* above) const {
  const long double side = spacing();
  long double nearest = std::numeric_limits<long double>::infinity();
  const auto square = [side](long double at) { return static_cast<std::int64_t>(std::floor(at / side)); };
  for (std::int64_t row = square(y - reach); row <= square(y + reach); ++row) {
    for (std::int64_t column = square(x - reach); column <= square(x + reach); ++column) {
      const auto patchOf = [this](std::int64_t sample) {
        return sample >= 0 ? sample / intervals_ : -((-sample + intervals_ - 1) / intervals_);
      };
      const std::int64_t i = patchOf(column), j = patchOf(row);
      const NodeHeights heights = patch(i, j);
      if (!heights) continue;
      const auto corner = [&](int right, int up) {
        const int sampleX = static_cast<int>(column - i * intervals_) + right;
        const int sampleY = static_cast<int>(row - j * intervals_) + up;
        return Point{(column + right) * side, (row + up) * side,
                     static_cast<long double>((*heights)(sampleX, sampleY))};
      };
      const Point southWest = corner(0, 0), southEast = corner(1, 0), northEast = corner(1, 1),
                  northWest = corner(0, 1), p{x, y, z};
      nearest = std::min({nearest, distanceToTriangle(p, southWest, southEast, northEast),
                          distanceToTriangle(p, southWest, northEast, northWest)});
      const long double u = x / side - column, v = y / side - row;
      if (above && u >= 0 && u <= 1 && v >= 0 && v <= 1) {
        const long double ground =
            u >= v ? southWest[2] + u * (southEast[2] - southWest[2]) + v * (northEast[2] - southEast[2])
                   : southWest[2] + u * (northEast[2] - northWest[2]) + v * (northWest[2] - southWest[2]);
        *above = z - ground;
      }
    }
  }
  return nearest;
}

/// Random numbers of a test, from one seed.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : seed_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(hashWith(seed_, ++count_) >> 11) * 0x1p-53);
  }
  int whole(int low, int high) {
    return low + static_cast<int>(hashWith(seed_, ++count_) % (high - low + 1));
  }

 private:
  std::uint64_t seed_, count_ = 0;
};

}  // namespace teren
