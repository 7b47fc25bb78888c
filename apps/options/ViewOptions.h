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

/// What teren-fly begins with: detail by error, as fine as two processors without a graphics card draw 30
/// times a second at 1280 x 720. There the median frame of a flight takes 38 ms at 8 px, 34.7 at 16, 30.8 at
/// 24 and 30.3 at 32 (doc/accuracy.md). `teren report --frames` judges it by the frames of the machine at
/// hand; programs that embed an engine begin with DetailSettings' own, by another rule.
inline constexpr DetailSettings kFlyingDetail{.pixelError = 24.0, .distance = 20'000.0};

/// The same for a world: not farther than so many of its coarsest nodes, since land without coarse layers
/// cannot become coarser far away.
inline constexpr int kFlyingNodes = 8;
DetailSettings flyingDetail(const World& world) noexcept;

/// How far the land is drawn where only its pixel error is said.
inline constexpr double kDetailDistance = 10'000.0;  // [m]

/// --view-distance and --pixel-error, which belong to an application or subcommand. `doc` says what goes
/// without it.
const CLI::Option* addViewDistance(CLI::App& application, const std::string& doc);
const CLI::Option* addPixelError(
    CLI::App& application,
    const std::string& doc = "[none; with it 10000 m of land unless --view-distance says otherwise]");

/// After parsing: detail by error, with what was typed in place of what is in `otherwise`. Errors as below.
Result<ViewSettings> viewWithin(const CLI::Option& pixelError, const CLI::Option& viewDistance,
                                const DetailSettings& otherwise = {.distance = kDetailDistance});

/// After parsing: the view with the smallest radius at its level that reaches the distance typed; `view`
/// itself where none was. Errors are of the kind kWrongInput: no number, or farther than the level reaches.
Result<ViewSettings> viewReaching(const CLI::Option& viewDistance, const ViewSettings& view,
                                  const World& world);

}  // namespace teren
