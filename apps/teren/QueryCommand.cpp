// teren query WORLD X Y [X Y]... [--json]: heights, normals and error bounds at points.
#include <algorithm>
#include <cstddef>
#include <iostream>
#include <span>
#include <utility>
#include <vector>

#include "teren/Parameter.h"
#include "teren/Quote.h"

#include "apps/options/EditOptions.h"
#include "apps/options/WorldOptions.h"
#include "apps/teren/Command.h"
#include "apps/teren/EditedWorld.h"
#include "apps/teren/Interruption.h"
#include "apps/teren/JsonOutput.h"

namespace teren {
namespace {

constexpr int kMostArguments = 1 << 24;
/// Points asked before the next look whether a plugin has failed.
constexpr std::size_t kAtOnce = 1024;

struct TypedPoint {
  double x = 0.0, y = 0.0;
  Position position;
};

Result<std::vector<TypedPoint>> readPoints(const std::vector<std::string>& texts, double pitch) {
  if (texts.size() % 2 != 0) {
    return Error{"X and Y come in pairs, but the last X is " + inQuotes(texts.back()) + " and has no Y"};
  }
  std::vector<TypedPoint> points;
  for (std::size_t k = 0; k < texts.size(); k += 2) {
    const Result<double> x = parseNumber(texts[k]);
    if (!x) return Error{"X: " + x.error().message};
    const Result<double> y = parseNumber(texts[k + 1]);
    if (!y) return Error{"Y: " + y.error().message};
    const Result<Position> position = Position::fromMetres(x.value(), y.value(), pitch);
    if (!position) return position.error();
    points.push_back({x.value(), y.value(), position.value()});
  }
  return points;
}

OrderedJson asJson(const TypedPoint& point, const SurfacePoint& surface) {
  return {{"x", point.x},
          {"y", point.y},
          {"height", surface.height},
          {"drawn", surface.drawn},
          {"normal", {surface.normal[0], surface.normal[1], surface.normal[2]}},
          {"error", surface.error}};
}

std::string asText(const TypedPoint& point, const SurfacePoint& surface) {
  return "(" + numberText(point.x) + ", " + numberText(point.y) + "): height " + numberText(surface.height) +
         " m, drawn " + numberText(surface.drawn) + " m, at most " + numberText(surface.error) +
         " m apart, normal (" + numberText(surface.normal[0]) + ", " + numberText(surface.normal[1]) + ", " +
         numberText(surface.normal[2]) + ")";
}

class QueryCommand final : public Command {
 public:
  explicit QueryCommand(CLI::App& parent)
      : Command(parent, "query", "tell height, normal and error bound at points of the landscape"),
        world_(application()),
        edits_(application(), "[none]"),
        points_(application()
                    .add_option("POINTS", "X Y [X Y]...: metres east and north of the world's zero")
                    ->expected(2, kMostArguments)
                    ->allow_extra_args()
                    ->required()),
        json_(addJson()) {}

  ExitCode run() override {
    const std::shared_ptr<const PluginRegistry> registry = PluginRegistry::standard();
    const Result<std::shared_ptr<const World>> world = world_.create(*registry);
    if (!world) return fail(kWrongInput, world.error().message);
    const Result<std::vector<TypedPoint>> points = readPoints(points_->results(), (*world)->pitch());
    if (!points) return fail(kWrongInput, points.error().message);
    const Interruption interruption;
    const auto edited = groundOfOptions(edits_, *world, registry, interruption);
    if (interruption.came()) return fail(kWorkFailed, "interrupted, there is no answer");
    if (const auto code = failWith(**world, "there is no answer")) return *code;
    if (!edited) return fail(kWrongInput, edited.error().message);
    std::vector<Position> positions;
    for (const TypedPoint& point : points.value()) positions.push_back(point.position);
    std::vector<SurfacePoint> surfaces(positions.size());
    for (std::size_t first = 0; first < positions.size(); first += kAtOnce) {
      const std::size_t count = std::min(kAtOnce, positions.size() - first);
      const auto places = std::span(positions).subspan(first, count);
      const auto answers = std::span(surfaces).subspan(first, count);
      if (*edited != nullptr) {
        (*edited)->query(places, answers);
      } else {
        (*world)->query(places, answers);
      }
      if (interruption.came()) return fail(kWorkFailed, "interrupted, there is no answer");
      if (const auto code = failWith(**world, "there is no answer")) return *code;
    }
    answer(points.value(), surfaces);
    complainAbout(**world);
    return kSuccess;
  }

 private:
  void answer(const std::vector<TypedPoint>& points, const std::vector<SurfacePoint>& surfaces) const {
    OrderedJson list = OrderedJson::array();
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (json_->count() > 0) {
        list.push_back(asJson(points[k], surfaces[k]));
      } else {
        std::cout << asText(points[k], surfaces[k]) << '\n';
      }
    }
    if (json_->count() > 0) printJson({{"points", std::move(list)}});
  }

  WorldOptions world_;
  EditOptions edits_;
  const CLI::Option* points_;
  const CLI::Option* json_;
};

}  // namespace

std::unique_ptr<Command> makeQueryCommand(CLI::App& parent) {
  return std::make_unique<QueryCommand>(parent);
}

}  // namespace teren
