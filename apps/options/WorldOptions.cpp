#include "apps/options/WorldOptions.h"

#include <string>
#include <utility>
#include <vector>

#include "teren/Parameter.h"
#include "teren/Quote.h"

#include "apps/options/CommandLine.h"

namespace teren {
namespace {

constexpr const char* kGroup = "World";

Result<std::vector<Values::Entry>> readAssignments(const CLI::Option& option, const PluginInfo& plugin) {
  std::vector<Values::Entry> entries;
  for (const std::string& text : option.results()) {
    Result<Values::Entry> entry = parseAssignment(plugin.parameters, text);
    if (!entry) return Error{"--set: " + entry.error().message};
    entries.push_back(std::move(entry).value());
  }
  const Result<Values> checked = Values::check(plugin.parameters, entries, plugin.id);
  if (!checked) return Error{"--set: " + checked.error().message};
  return entries;
}

Result<BlendKernel> readBlend(const std::string& text) {
  if (text == "linear") return BlendKernel::linear;
  if (text == "smooth") return BlendKernel::smooth;
  return Error{"--blend is " + inQuotes(text) + " but must be linear or smooth"};
}

}  // namespace

WorldOptions::WorldOptions(CLI::App& application)
    : world_(application.add_option("--world", "the world's description, a JSON file")
                 ->type_name("FILE")
                 ->group(kGroup)),
      generator_(application.add_option("--generator", "a world of one layer made by this plugin")
                     ->type_name("ID")
                     ->group(kGroup)),
      set_(application.add_option("--set", "a parameter of the generator; repeat for more")
               ->type_name("NAME=VALUE")
               ->take_all()
               ->allow_extra_args(false)
               ->group(kGroup)),
      pitch_(application.add_option("--pitch", "side of a patch in metres, with --generator [64]")
                 ->type_name("M")
                 ->group(kGroup)),
      samples_(application.add_option("--samples", "side of a base map, 2^k + 1, with --generator [65]")
                   ->type_name("W")
                   ->group(kGroup)),
      blend_(application.add_option("--blend", "linear or smooth, with --generator [smooth]")
                 ->type_name("KERNEL")
                 ->group(kGroup)),
      seed_(application.add_option("--seed", "another seed, 0 ... 2^64 - 1")->type_name("N")->group(kGroup)) {
}

Result<WorldDescription> WorldOptions::fromGenerator(const PluginRegistry& registry) const {
  const std::string id = argument(*generator_);
  const PluginInfo* plugin = registry.find(id);
  if (plugin == nullptr || plugin->kind != PluginKind::generator) {
    return Error{"--generator: " + registry.makeGenerator(id, {}).error().message};
  }
  WorldDescription description;
  LayerDescription layer;
  layer.generator = id;
  Result<std::vector<Values::Entry>> entries = readAssignments(*set_, *plugin);
  if (!entries) return entries.error();
  layer.parameters = std::move(entries).value();
  if (pitch_->count() > 0) {
    const Result<double> pitch = numberArgument("--pitch", argument(*pitch_), 0.001, 1e6);
    if (!pitch) return pitch.error();
    description.pitch = pitch.value();
  }
  if (samples_->count() > 0) {
    const Result<std::int64_t> samples = wholeArgument("--samples", argument(*samples_), 5, 1025);
    if (!samples) return samples.error();
    description.samples = static_cast<int>(samples.value());
  }
  if (blend_->count() > 0) {
    const Result<BlendKernel> blend = readBlend(argument(*blend_));
    if (!blend) return blend.error();
    layer.blend = blend.value();
  }
  layer.pitch = description.pitch;
  layer.samples = description.samples;
  description.layers.push_back(std::move(layer));
  return description;
}

Result<WorldDescription> WorldOptions::base(const PluginRegistry& registry) const {
  if (generator_->count() > 0) {
    if (world_->count() > 0) return Error{"--world and --generator exclude each other"};
    return fromGenerator(registry);
  }
  for (const CLI::Option* option : {set_, pitch_, samples_, blend_}) {
    if (option->count() > 0) return Error{option->get_name() + " goes only with --generator"};
  }
  if (world_->count() > 0) {
    if (argument(*world_).empty()) return Error{"--world is \"\" but must name a file"};
    return WorldDescription::fromFile(argument(*world_));
  }
  return WorldDescription::standard();
}

Result<WorldDescription> WorldOptions::resolve(const PluginRegistry& registry) const {
  Result<WorldDescription> description = base(registry);
  if (!description || seed_->count() == 0) return description;
  const Result<std::uint64_t> seed = seedArgument("--seed", argument(*seed_));
  if (!seed) return seed.error();
  description->seed = seed.value();
  return description;
}

std::optional<std::filesystem::path> WorldOptions::file() const {
  if (world_->count() == 0) return std::nullopt;
  return argument(*world_);
}

Result<std::shared_ptr<const World>> WorldOptions::create(const PluginRegistry& registry) const {
  const Result<WorldDescription> description = resolve(registry);
  if (!description) return description.error();
  return World::create(description.value(), registry);
}

}  // namespace teren
