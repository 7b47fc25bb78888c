#include "apps/fly/LandColours.h"

#include <algorithm>
#include <array>

#include "teren/Parameter.h"

#include "apps/fly/FlightFigures.h"

namespace teren {
namespace {

SbColor mix(const SbColor& from, const SbColor& to, double share) {
  const auto part = static_cast<float>(share);
  return {from[0] + (to[0] - from[0]) * part, from[1] + (to[1] - from[1]) * part,
          from[2] + (to[2] - from[2]) * part};
}

}  // namespace

LandColours after(LandColours colours) noexcept {
  switch (colours) {
    case LandColours::natural:
      return LandColours::levels;
    case LandColours::levels:
      return LandColours::errors;
    default:
      return LandColours::natural;
  }
}

SbColor levelColour(int level) noexcept {
  static const std::array<SbColor, 10> kColours{SbColor(0.88F, 0.20F, 0.20F), SbColor(0.98F, 0.60F, 0.15F),
                                                SbColor(0.98F, 0.90F, 0.30F), SbColor(0.40F, 0.75F, 0.25F),
                                                SbColor(0.12F, 0.62F, 0.60F), SbColor(0.22F, 0.45F, 0.88F),
                                                SbColor(0.50F, 0.28F, 0.75F), SbColor(0.90F, 0.45F, 0.78F),
                                                SbColor(0.60F, 0.42F, 0.26F), SbColor(0.78F, 0.78F, 0.78F)};
  return kColours[static_cast<std::size_t>(std::max(level, 0)) % kColours.size()];
}

SbColor errorColour(double share) noexcept {
  if (share <= 1.0) return mix({0.05F, 0.42F, 0.25F}, {0.60F, 0.82F, 0.22F}, std::max(share, 0.0));
  const double more = share < 2.0 ? share - 1.0 : 1.0;  // NaN is as bad as can be
  return mix({1.0F, 0.50F, 0.12F}, {0.85F, 0.03F, 0.05F}, more);
}

std::vector<LegendLine> levelLegend(std::span<const std::size_t> nodesAtLevel) {
  std::vector<LegendLine> lines;
  for (std::size_t level = 0; level < nodesAtLevel.size(); ++level) {
    if (nodesAtLevel[level] == 0) continue;
    lines.push_back({levelColour(static_cast<int>(level)),
                     "level " + std::to_string(level) + ":  " +
                         groupedNumber(static_cast<long double>(nodesAtLevel[level]), 0) +
                         (nodesAtLevel[level] == 1 ? " node" : " nodes")});
  }
  return lines;
}

std::vector<LegendLine> errorLegend(double wanted) {
  const auto pixels = [wanted](double share) { return numberText(share * wanted) + " px"; };
  return {{errorColour(0.0), "0 px off"},
          {errorColour(0.5), pixels(0.5)},
          {errorColour(1.0), pixels(1.0) + ", as wanted"},
          {errorColour(1.0 + 1e-9), "more"},
          {errorColour(2.0), pixels(2.0) + " and more"}};
}

}  // namespace teren
