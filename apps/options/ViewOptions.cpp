#include "apps/options/ViewOptions.h"

#include <string>

#include "apps/options/CommandLine.h"

namespace teren {

const CLI::Option* addViewDistance(CLI::App& application, const std::string& doc) {
  return application.add_option("--view-distance", doc)->type_name("M");
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
