// How the programs that fly say how far the land shall be there.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "teren/Engine.h"
#include "teren/Result.h"

namespace teren {

/// What the programs begin with. One level coarser than the engine's own default: farther for fewer
/// triangles, and from the height of flight the shading hides the difference. A radius of 6 costs about a
/// fifth more of a frame.
inline constexpr ViewSettings kFlyingView{.level = 3, .radius = 5};

/// How far the land is drawn where only its pixel error is said.
inline constexpr double kDetailDistance = 10'000.0;  // [m]

/// --view-distance and --pixel-error, which belong to an application or subcommand.
const CLI::Option* addViewDistance(CLI::App& application, const std::string& doc);
const CLI::Option* addPixelError(CLI::App& application);

/// After parsing, where --pixel-error was given: detail by error, as far as the distance typed. Errors as
/// below.
Result<ViewSettings> viewWithin(const CLI::Option& pixelError, const CLI::Option& viewDistance);

/// After parsing: the view with the smallest radius at its level that reaches the distance typed; `view`
/// itself where none was. Errors are of the kind kWrongInput: no number, or farther than the level reaches.
Result<ViewSettings> viewReaching(const CLI::Option& viewDistance, const ViewSettings& view,
                                  const World& world);

}  // namespace teren
