#include <functional>
#include <set>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "teren/World.h"

namespace teren {
namespace {

WorldDescription described() {
  const Result<WorldDescription> description = WorldDescription::fromJson(
      R"({"seed": 7, "layers": [{"generator": "fault", "parameters": {"faults": 40}, "filters": [{"filter": "band"}]},
          {"generator": "spectral", "pitch": 1024}]})",
      "test");
  EXPECT_TRUE(description);
  return *description;
}

std::uint64_t hashOf(const WorldDescription& description) {
  const auto world = World::create(description, *PluginRegistry::standard());
  EXPECT_TRUE(world) << (world ? "" : world.error().message);
  return world ? (*world)->descriptionHash() : 0;
}

TEST(DescriptionHash, IsTheSameHoweverAWorldIsDescribed) {
  const std::uint64_t hash = hashOf(described());
  const auto stays = [&](const std::function<void(WorldDescription&)>& change) {
    WorldDescription other = described();
    change(other);
    return hashOf(other) == hash;
  };
  EXPECT_TRUE(stays([](WorldDescription&) {}));
  EXPECT_TRUE(stays([](WorldDescription& world) { world.layers[0].name = "fault"; }));
  EXPECT_TRUE(stays([](WorldDescription& world) { world.layers[0].parameters[0].second = 40.0; }));
  const PluginInfo* const band = PluginRegistry::standard()->find("band");
  ASSERT_NE(band, nullptr);
  const Values values = Values::defaults(band->parameters);
  EXPECT_TRUE(stays([&](WorldDescription& world) {
    world.layers[0].filters[0].parameters.assign(values.entries().begin(), values.entries().end());
  }));
}

TEST(DescriptionHash, IsAnotherForEveryChangeThatMakesAnotherWorld) {
  std::set<std::uint64_t> hashes = {hashOf(described())};
  std::size_t changes = 0;
  const auto changed = [&](const std::function<void(WorldDescription&)>& change) {
    WorldDescription other = described();
    change(other);
    hashes.insert(hashOf(other));
    EXPECT_EQ(hashes.size(), ++changes + 1) << "change " << changes;
  };
  changed([](WorldDescription& world) { world.seed = 8; });
  changed([](WorldDescription& world) {
    world.pitch *= 2.0;
    for (LayerDescription& layer : world.layers) layer.pitch *= 2.0;
  });
  changed([](WorldDescription& world) { world.samples = 33; });
  changed([](WorldDescription& world) { world.layers.pop_back(); });
  changed([](WorldDescription& world) { std::swap(world.layers[0], world.layers[1]); });
  changed([](WorldDescription& world) { world.layers[0].name = "other"; });
  changed([](WorldDescription& world) {
    world.layers[0].generator = "circles", world.layers[0].parameters.clear();
  });
  changed([](WorldDescription& world) { world.layers[0].parameters[0].second = std::int64_t{41}; });
  changed([](WorldDescription& world) { world.layers[1].pitch = 2048.0; });
  changed([](WorldDescription& world) { world.layers[1].samples = 33; });
  changed([](WorldDescription& world) { world.layers[1].blend = BlendKernel::linear; });
  changed([](WorldDescription& world) { world.layers[1].preserveVariance = false; });
  changed([](WorldDescription& world) { world.layers[0].filters.clear(); });
  changed([](WorldDescription& world) { world.layers[0].filters.push_back({"band", {}}); });
  changed([](WorldDescription& world) { world.layers[0].filters[0].parameters = {{"k", 0.5}}; });
}

}  // namespace
}  // namespace teren
