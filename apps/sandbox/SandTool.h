// The tools a person can take: what to choose and how large, and the shape that comes of it.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "teren/Parameter.h"
#include "teren/Result.h"

#include "generators/sand/ToolShape.h"

namespace teren {

/// A tool by its parameters, for panels and scripts.
struct SandTool {
  /// tool (round, square, rake, wedge, ball, polygon), size [m] across, depth [m], teeth of a rake, corners
  /// of a round one, outline of a polygon: "X,Y X,Y ..." in sizes from its middle, x the way it is pushed.
  static std::span<const Parameter> parameters() noexcept;

  /// `values` of that table. Errors: ToolShape's, or an outline that is no list of points.
  static Result<ToolShape> shape(const Values& values);
};

/// "X,Y X,Y ..." as points; at most ToolShape::kMostPoints.
Result<std::vector<ToolPoint>> parseOutline(std::string_view text);

/// The outline that a file holds: points as above, between any white space; '#' begins a comment. At most
/// 64 KiB. Errors name the file.
Result<std::string> readOutline(const std::string& file);

}  // namespace teren
