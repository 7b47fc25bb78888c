// The colours in which the land shows what it is made of: the levels of its nodes, or how wrong it is.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <Inventor/SbColor.h>

namespace teren {

enum class LandColours { natural, levels, errors };

/// The next way of colouring, in a circle.
LandColours after(LandColours colours) noexcept;

/// Of a node's level; neighbouring levels look nothing alike, and after ten the colours come again.
SbColor levelColour(int level) noexcept;

/// Of a pixel error divided by the one wanted: greens up to 1, at once orange beyond, red from 2 on. What is
/// not finite is red.
SbColor errorColour(double share) noexcept;

/// A line of a legend.
struct LegendLine {
  SbColor colour;
  std::string says;

  friend bool operator==(const LegendLine&, const LegendLine&) = default;
};

/// A line for each level of which there are nodes.
std::vector<LegendLine> levelLegend(std::span<const std::size_t> nodesAtLevel);
/// For the pixel error wanted [px].
std::vector<LegendLine> errorLegend(double wanted);

}  // namespace teren
