#include "coin/FieldWorld.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "teren/Parameter.h"
#include "teren/PluginRegistry.h"
#include "teren/Quote.h"
#include "teren/World.h"

namespace teren {
namespace {

Result<std::uint64_t> parseSeed(const std::string& text) {
  std::uint64_t seed = 0;
  const char* end = text.data() + text.size();
  const std::from_chars_result read = std::from_chars(text.data(), end, seed);
  if (read.ec == std::errc() && read.ptr == end) return seed;
  return Error{"seed is " + inQuotes(text) + ", expected a whole number from 0 to " +
               std::to_string(std::numeric_limits<std::uint64_t>::max()) + " or nothing"};
}

Result<WorldDescription> ofGenerator(const TerrainFields& fields, const PluginRegistry& registry) {
  const PluginInfo* plugin = registry.find(fields.generator);
  if (plugin == nullptr || plugin->kind != PluginKind::generator) {
    return Error{"generator: " + registry.makeGenerator(fields.generator, {}).error().message};
  }
  LayerDescription layer;
  layer.generator = fields.generator;
  for (const std::string& text : fields.parameters) {
    Result<Values::Entry> entry = parseAssignment(plugin->parameters, text);
    if (!entry) return Error{"parameters: " + entry.error().message};
    layer.parameters.push_back(std::move(entry).value());
  }
  WorldDescription description;
  description.layers.push_back(std::move(layer));
  return description;
}

Result<WorldDescription> describe(const TerrainFields& fields, const PluginRegistry& registry) {
  if (!fields.generator.empty()) {
    if (fields.world.empty()) return ofGenerator(fields, registry);
    return Error{"world is " + inQuotes(fields.world) + " and generator is " + inQuotes(fields.generator) +
                 ", expected one of them at most"};
  }
  if (!fields.parameters.empty()) {
    return Error{"parameters has " + inQuotes(fields.parameters.front()) + " but generator is empty"};
  }
  if (!fields.world.empty()) return WorldDescription::fromFile(fields.world);
  return WorldDescription::standard();
}

/// Of fields whose pixelError is not 0.
Result<ViewSettings> checkDetail(const TerrainFields& fields) {
  const double pixels = static_cast<double>(fields.pixelError);
  const auto least = static_cast<float>(DetailSettings::kLeastError);  // as it is written in a file
  if (!(fields.pixelError >= least && pixels <= DetailSettings::kMostError)) {
    return Error{"pixelError is " + numberText(pixels) + ", expected 0 or " +
                 numberText(DetailSettings::kLeastError) + " to " + numberText(DetailSettings::kMostError)};
  }
  const double distance = static_cast<double>(fields.viewDistance);
  if (!(distance > 0.0 && distance <= DetailSettings::kMostDistance)) {
    return Error{"viewDistance is " + numberText(distance) + " m, expected more than 0 and at most " +
                 numberText(DetailSettings::kMostDistance) + " m"};
  }
  ViewSettings view;
  view.detail =
      DetailSettings{.pixelError = std::max(pixels, DetailSettings::kLeastError), .distance = distance};
  return view;
}

Result<ViewSettings> checkView(const TerrainFields& fields, const World& world) {
  if (fields.pixelError != 0.0F) return checkDetail(fields);
  if (fields.viewLevel < 0 || fields.viewLevel > world.topLevel()) {
    return Error{"viewLevel is " + std::to_string(fields.viewLevel) + ", expected 0 to " +
                 std::to_string(world.topLevel()) + ", the world's top level"};
  }
  const double farthest = ViewSettings{fields.viewLevel, ViewSettings::kMostRadius}.reach(world);
  const double distance = static_cast<double>(fields.viewDistance);
  if (!(distance > 0.0 && distance <= farthest)) {
    return Error{"viewDistance is " + numberText(distance) + " m, expected more than 0 and at most " +
                 numberText(farthest) + " m at level " + std::to_string(fields.viewLevel)};
  }
  return ViewSettings{fields.viewLevel, ViewSettings::radiusFor(distance, fields.viewLevel, world)};
}

}  // namespace

Result<std::unique_ptr<Engine>> makeEngine(const TerrainFields& fields) {
  const std::shared_ptr<const PluginRegistry> registry = PluginRegistry::standard();
  Result<WorldDescription> description = describe(fields, *registry);
  if (!description) return description.error();
  if (!fields.seed.empty()) {
    const Result<std::uint64_t> seed = parseSeed(fields.seed);
    if (!seed) return seed.error();
    description->seed = seed.value();
  }
  const Result<std::shared_ptr<const World>> world = World::create(*description, *registry);
  if (!world) return world.error();
  const Result<ViewSettings> view = checkView(fields, *world.value());
  if (!view) return view.error();
  return Engine::create(world.value(), {.view = view.value()});
}

}  // namespace teren
