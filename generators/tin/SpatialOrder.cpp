#include "generators/tin/SpatialOrder.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

namespace teren {

std::uint32_t hilbertPlace(LatticePoint p, int bits) noexcept {
  const int drop = bits - 16;
  auto x = static_cast<std::uint32_t>(drop >= 0 ? p.x >> drop : p.x << -drop);
  auto y = static_cast<std::uint32_t>(drop >= 0 ? p.y >> drop : p.y << -drop);
  std::uint32_t place = 0;
  for (int level = 15; level >= 0; --level) {
    const std::uint32_t rx = (x >> level) & 1U;
    const std::uint32_t ry = (y >> level) & 1U;
    place = (place << 2) | ((3U * rx) ^ ry);
    // The quarter's own curve: mirrored on the diagonal, in the last quarter on the other one.
    const std::uint32_t mirror = (ry == 0 && rx == 1) ? 0xffffU : 0U;
    x ^= mirror;
    y ^= mirror;
    if (ry == 0) std::swap(x, y);
  }
  return place;
}

std::vector<std::uint32_t> hilbertOrder(std::span<const LatticePoint> points) {
  std::int32_t largest = 1;
  for (const LatticePoint p : points) largest = std::max({largest, p.x, p.y});
  const int bits = std::bit_width(static_cast<std::uint32_t>(largest));

  std::vector<std::uint64_t> from(points.size());
  std::vector<std::uint64_t> to(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    from[i] = (static_cast<std::uint64_t>(hilbertPlace(points[i], bits)) << 32) | i;
  }
  constexpr int kDigit = 11;
  for (int shift = 32; shift < 64; shift += kDigit) {
    std::array<std::size_t, (1 << kDigit) + 1> start{};
    for (const std::uint64_t word : from) ++start[((word >> shift) & ((1U << kDigit) - 1)) + 1];
    for (std::size_t digit = 1; digit < start.size(); ++digit) start[digit] += start[digit - 1];
    for (const std::uint64_t word : from) to[start[(word >> shift) & ((1U << kDigit) - 1)]++] = word;
    std::swap(from, to);
  }
  std::vector<std::uint32_t> order(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) order[i] = static_cast<std::uint32_t>(from[i]);
  return order;
}

}  // namespace teren
