#include "apps/options/ViewOptions.h"

#include <algorithm>
#include <string>

#include "apps/options/CommandLine.h"

namespace teren {

DetailSettings flyingDetail(const World& world) noexcept {
  DetailSettings detail = kFlyingDetail;
  detail.distance = std::min(detail.distance, ViewSettings{world.topLevel(), kFlyingNodes}.reach(world));
  return detail;
}

const CLI::Option* addViewDistance(CLI::App& application, const std::string& doc) {
  return application.add_option("--view-distance", doc)->type_name("M");
}

const CLI::Option* addPixelError(CLI::App& application, const std::string& doc) {
  const std::string whole =
      "pixels that the land may be off by on the screen, 0.1 to 100: finer near by, coarser far away " + doc;
  return application.add_option("--pixel-error", whole)->type_name("PX");
}

Result<ViewSettings> viewWithin(const CLI::Option& pixelError, const CLI::Option& viewDistance,
                                const DetailSettings& otherwise) {
  DetailSettings detail = otherwise;
  if (pixelError.count() > 0) {
    const Result<double> pixels = numberArgument(pixelError.get_name(), argument(pixelError),
                                                 DetailSettings::kLeastError, DetailSettings::kMostError);
    if (!pixels) return pixels.error();
    detail.pixelError = *pixels;
  }
  if (viewDistance.count() > 0) {
    const Result<double> distance =
        numberArgument(viewDistance.get_name(), argument(viewDistance), 1.0, DetailSettings::kMostDistance);
    if (!distance) return distance.error();
    detail.distance = *distance;
  }
  ViewSettings view;
  view.detail = detail;
  return view;
}

Result<ViewSettings> viewReaching(const CLI::Option& viewDistance, const ViewSettings& view,
                                  const World& world) {
  if (viewDistance.count() == 0) return view;
  const double farthest = ViewSettings{view.level, ViewSettings::kMostRadius}.reach(world);
  const Result<double> distance =
      numberArgument(viewDistance.get_name(), argument(viewDistance), 1.0, farthest);
  if (!distance) return Error{distance.error().message + " at level " + std::to_string(view.level)};
  return ViewSettings{view.level, ViewSettings::radiusFor(*distance, view.level, world)};
}

}  // namespace teren
