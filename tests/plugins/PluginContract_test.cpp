// The contract of plugins, put to every plugin the registry finds, Teren's own and, through
// TEREN_PLUGIN_PATH, others; and what more Teren's own promise.
#include <algorithm>
#include <cstdlib>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "teren/PluginRegistry.h"

#include "apps/check/Ensemble.h"
#include "apps/check/MapComparison.h"
#include "apps/check/MapMaker.h"
#include "apps/check/Property.h"
#include "apps/check/Subject.h"

namespace teren {
namespace {

using check::Effort;
using check::Ensemble;
using check::MapMaker;
using check::Property;
using check::Setting;
using check::Subject;

const PluginRegistry& registry() {
  return *PluginRegistry::standard();
}

/// Settings to try besides those that a plugin's table names.
std::vector<Setting> typicalSettings(const PluginInfo& info) {
  std::vector<Setting> settings;
  if (info.id == "spectral") {
    settings.push_back({{"rule", std::string("published")}});
    settings.push_back({{"hurst", 0.2}, {"harmonics", std::int64_t{128}}});
    settings.push_back({{"time", 2.5}, {"windEast", 4.0}, {"windNorth", 13.0}});
  }
  if (info.id == "matrix") {
    settings.push_back({{"passes", std::int64_t{2}}});
    settings.push_back(
        {{"m11", 0.0}, {"m13", 0.0}, {"m22", 2.0}, {"m12", -0.25}, {"m32", -0.25}});  // sharpens
    settings.push_back({{"matrix", std::string("0 1 2 1 0; 1 4 6 4 1; 2 6 9 6 2; 1 4 6 4 1; 0 1 2 1 0")}});
    settings.push_back({{"matrix", std::string("0 0 1; 0 2 0; 0.25 0 0")}, {"passes", std::int64_t{2}}});
  }
  if (info.id == "thermal") {
    settings.push_back({{"talus", 5.0}, {"passes", std::int64_t{5}}});
    settings.push_back({{"talus", 0.0}, {"passes", std::int64_t{3}}});
  }
  if (info.id == "noise") {
    settings.push_back({{"kind", std::string("simplex")}, {"frequency", 0.02}});
    settings.push_back({{"fractal", std::string("ridged")}, {"hurst", 0.5}, {"warp", 50.0}});
    settings.push_back(
        {{"fractal", std::string("billow")}, {"frequency", 0.05}, {"octaves", std::int64_t{3}}});
    settings.push_back({{"frequency", 1e-3}, {"lacunarity", 3.0}, {"warp", 500.0}});
  }
  if (info.id == "crater") {
    settings.push_back({{"irregularity", 0.25}, {"rim", 1.0}});
    settings.push_back({{"irregularity", 0.0}, {"rim", 0.0}});
  }
  if (info.id == "sand") {
    settings.push_back({{"tool", std::string("wedge")}, {"push", true}, {"direction", 210.0}});
    settings.push_back({{"tool", std::string("rake")}, {"repose", 20.0}, {"push", true}});
  }
  if (info.id == "midpoint") {
    for (double hurst : {0.2, 0.5}) settings.push_back({{"hurst", hurst}});
    settings.push_back({{"m11", 0.75}, {"m22", std::string("randN")}, {"m23", std::string("randR")}});
  }
  return settings;
}

Subject subject(const std::string& id) {
  return {PluginRegistry::standard(), id, typicalSettings(*registry().find(id))};
}

/// Of all kinds but deformers, which make no maps.
std::vector<std::string> everyId() {
  std::vector<std::string> ids;
  for (const PluginInfo& plugin : registry().plugins()) {
    if (plugin.kind != PluginKind::deformer) ids.push_back(plugin.id);
  }
  return ids;
}

/// Every plugin with every property that is demanded of its kind.
std::vector<std::tuple<std::string, std::string>> everyDemand() {
  std::vector<std::tuple<std::string, std::string>> demands;
  for (const PluginInfo& plugin : registry().plugins()) {
    for (const Property* property : check::contract(plugin.kind)) {
      demands.emplace_back(plugin.id, property->name());
    }
  }
  return demands;
}

/// Test names may hold letters, digits and '_' only.
std::string testName(std::string name) {
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

/// TEREN_FULL=1: as thoroughly as `teren check` does.
Effort effort() {
  return std::getenv("TEREN_FULL") == nullptr ? Effort::quick() : Effort::full();
}

class PluginContract : public testing::TestWithParam<std::tuple<std::string, std::string>> {};

TEST_P(PluginContract, Holds) {
  const auto& [id, name] = GetParam();
  const Property* const property = check::findProperty(registry().find(id)->kind, name);
  const check::Finding finding = property->check(subject(id), effort());
  EXPECT_TRUE(finding.holds) << finding.text;
  RecordProperty("figures", finding.text);
}

INSTANTIATE_TEST_SUITE_P(Every, PluginContract, testing::ValuesIn(everyDemand()), [](const auto& test) {
  return testName(std::get<0>(test.param) + "_" + std::get<1>(test.param));
});

class OwnPlugin : public testing::TestWithParam<std::string> {};

TEST_P(OwnPlugin, CutsItsWorkIntoManySteps) {
  std::int64_t steps = 0;
  subject(GetParam()).maker({}).make(check::requestOf(1, 257), check::shortestSlice(), &steps);
  EXPECT_GE(steps, 16);
}

/// Generators whose deviation varies over the map, as their documents say: only its root mean square over the
/// map's area is what they promise.
bool isUneven(const PluginInfo& info) {
  return info.id == "slope";
}

TEST_P(OwnPlugin, DeviatesAsPromisedAtEverySample) {
  const PluginInfo& info = *registry().find(GetParam());
  std::vector<Setting> settings = typicalSettings(info);
  settings.insert(settings.begin(), Setting());
  for (const Setting& setting : settings) {
    SCOPED_TRACE(check::textOf(setting));
    const MapMaker maker = subject(GetParam()).maker(setting);
    Ensemble ensemble(maker);
    while (ensemble.seeds() < 2000) ensemble.add();
    const double promised = ensemble.promised().deviation;
    for (int y = 0; y < Ensemble::kSamples; ++y) {
      for (int x = 0; x < Ensemble::kSamples && !isUneven(info); ++x) {
        EXPECT_LE(ensemble.deviationAt(x, y), 1.12 * promised) << x << ", " << y;
        if (maker.filters()) {
          EXPECT_GT(ensemble.deviationAt(x, y), 0.0) << x << ", " << y;
        } else {
          EXPECT_GE(ensemble.deviationAt(x, y), 0.88 * promised) << x << ", " << y;
        }
      }
    }
  }
}

TEST_P(OwnPlugin, IsInAFileOfItsName) {
  EXPECT_EQ(registry().find(GetParam())->file.filename(), "teren-" + GetParam() + ".so");
}

INSTANTIATE_TEST_SUITE_P(Every, OwnPlugin, testing::ValuesIn(everyId()),
                         [](const auto& test) { return testName(test.param); });

TEST(Plugins, TakeMatricesOfAnyOddSideAndRefuseOthersWithASentence) {
  const Subject matrix = subject("matrix");
  EXPECT_EQ(matrix.refusal({{"matrix", std::string("1 1 1; 1 1 1; 1 1 1")}}), "");
  const std::pair<Setting, const char*> cases[] = {
      {{{"matrix", std::string("1 1 1; 1 1; 1 1 1")}}, "row 2 of its matrix has 2 elements, expected 3"},
      {{{"matrix", std::string("1 1; 1 1")}}, "2 rows, expected an odd number from 1 to 31"},
      {{{"m22", -0.75}}, "elements of its matrix sum to 0, too near to zero"},
      {{{"m22", -0.25}}, "leaves 3 x 1 of them, too near to zero"},
      {{{"m12", -0.1}, {"m22", 0.5}, {"passes", std::int64_t{100}}},
       "more than a million times in 100 passes"},
  };
  for (const auto& [entries, sentence] : cases) {
    EXPECT_NE(matrix.refusal(entries).find(sentence), std::string::npos) << matrix.refusal(entries);
    EXPECT_NE(matrix.refusal(entries).find("plugin \"matrix\" refuses its parameters: "), std::string::npos);
  }
}

TEST(Plugins, AreAllFoundAndNoneIsRefused) {
  for (const char* id : {"band", "circles", "constant", "crater", "fault", "matrix", "midpoint", "noise",
                         "sand", "slope", "spectral", "steps", "thermal"})
    EXPECT_NE(registry().find(id), nullptr) << id;
  for (const RefusedModule& module : registry().refused())
    ADD_FAILURE() << module.file << ": " << module.reason;
}

}  // namespace
}  // namespace teren
