// The surface's height at places that are no lattice points.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "generators/tin/Triangulation.h"

namespace teren {
namespace {

constexpr int kFineBits = 24;  // a place is taken to the nearest 2^-24 of a step

/// A place in 2^-24 steps.
struct FinePoint {
  std::int64_t x;
  std::int64_t y;
};

FinePoint fine(LatticePoint p) noexcept {
  return {static_cast<std::int64_t>(p.x) << kFineBits, static_cast<std::int64_t>(p.y) << kFineBits};
}

/// Twice the area of a, b, p: exact, for |b - a| <= 2^28 and coordinates of p up to 2^52.
WideInteger orientation(LatticePoint a, LatticePoint b, FinePoint p) noexcept {
  const FinePoint from = fine(a);
  return static_cast<WideInteger>(b.x - a.x) * (p.y - from.y) -
         static_cast<WideInteger>(b.y - a.y) * (p.x - from.x);
}

}  // namespace

std::optional<double> Triangulation::heightAt(double x, double y, TriangleId hint) const noexcept {
  const std::optional<LatticePoint> nearest = frame_.snap(x, y);
  if (!nearest) return std::nullopt;
  const double scale = 1 << kFineBits;
  const FinePoint p{static_cast<std::int64_t>(std::floor((x - frame_.x) / frame_.step * scale + 0.5)),
                    static_cast<std::int64_t>(std::floor((y - frame_.y) / frame_.step * scale + 0.5))};
  TriangleId t = locate(*nearest, hint).triangle;
  std::array<WideInteger, 3> area{};  // opposite each corner
  for (std::uint32_t choice = 1;; choice = choice * 1664525U + 1013904223U) {
    int over =
        -1;  // a side that has p beyond it; where there are two, now one and now the other (see walk())
    for (int i = 0; i < 3; ++i) {
      area[i] = orientation(point(corners(t)[following(i)]), point(corners(t)[preceding(i)]), p);
      if (area[i] < 0 && (over < 0 || (choice >> 31) != 0)) over = i;
    }
    if (over < 0) break;
    t = mesh_.triangle(t).link[over].triangle();
  }

  const std::array<VertexId, 3>& corner = corners(t);
  for (int i = 0; i < 3; ++i) {
    if (area[following(i)] == 0 && area[preceding(i)] == 0) return heights_[corner[i]];
  }
  for (int i = 0; i < 3; ++i) {
    if (area[i] != 0) continue;
    const VertexId a = std::min(corner[following(i)], corner[preceding(i)]);  // the same from both sides
    const VertexId b = std::max(corner[following(i)], corner[preceding(i)]);
    const FinePoint from = fine(point(a)), to = fine(point(b));
    const bool eastward = std::abs(to.x - from.x) >= std::abs(to.y - from.y);
    const double part = eastward ? static_cast<double>(p.x - from.x) / static_cast<double>(to.x - from.x)
                                 : static_cast<double>(p.y - from.y) / static_cast<double>(to.y - from.y);
    return heights_[a] + part * (heights_[b] - heights_[a]);
  }
  const auto whole = static_cast<double>(area[0] + area[1] + area[2]);
  const double partB = static_cast<double>(area[1]) / whole;
  const double partC = static_cast<double>(area[2]) / whole;
  const double base = heights_[corner[0]];
  return base + (partB * (heights_[corner[1]] - base) + partC * (heights_[corner[2]] - base));
}

}  // namespace teren
