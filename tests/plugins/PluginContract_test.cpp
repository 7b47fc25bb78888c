// One contract for every plugin the registry finds, Teren's own and, through TEREN_PLUGIN_PATH, others.
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Hash.h"
#include "teren/PluginRegistry.h"

#include "tests/support/SlicedWork.h"

namespace teren {
namespace {

using test::finish;
using test::sameBits;
using Entries = std::vector<Values::Entry>;

const PluginRegistry& registry() {
  return *PluginRegistry::standard();
}

constexpr double kSpacing = 2.0;  // [m] between the samples of every finest map here

/// Makes maps with a plugin: a generator makes them anew, a filter changes faults of the map's own seed.
class MapMaker {
 public:
  MapMaker(const PluginInfo& info, const Entries& entries) : filters_(info.kind == PluginKind::filter) {
    generator_ =
        registry().makeGenerator(filters_ ? "fault" : info.id, filters_ ? Entries() : entries).value();
    if (filters_) filter_ = registry().makeFilter(info.id, entries).value();
  }

  bool filters() const { return filters_; }
  bool exactLevels() const { return !filters_ && !generator_->traits().approximate; }
  HeightRange sourceRange() const { return generator_->range(); }
  HeightRange range() const { return filters_ ? filter_->range(sourceRange()) : sourceRange(); }
  double residual(int level, int samples) const {
    const double before = generator_->residual(level, samples, kSpacing);
    return filters_ ? filter_->residual(before, level) : before;
  }

  /// The plugin's own task; for a filter `map` already holds what it is to change.
  std::unique_ptr<SlicedTask> begin(const MapRequest& request, HeightView map) const {
    if (!filters_) return generator_->begin(request, map);
    finish(*generator_->begin(request, map));
    return filter_->begin(request, map);
  }

  HeightMap make(const MapRequest& request, const Slice& slice = Slice::unlimited()) const {
    HeightMap map(request.samples, request.samples);
    finish(*begin(request, map.view()), slice);
    return map;
  }

 private:
  bool filters_;
  std::shared_ptr<const Generator> generator_;
  std::shared_ptr<const Filter> filter_;
};

/// Request number n of a layer whose finest maps have `samples` samples a side.
MapRequest request(int n, int samples, int level = 0) {
  const int intervals = (samples - 1) >> level;
  const std::int64_t i = 3 * n - 7, j = (std::int64_t{1} << 40) - n;
  return {.i = i,
          .j = j,
          .seed = mapSeed(42, "contract", i, j),
          .samples = intervals < 2 ? 1 : intervals + 1,
          .level = level,
          .spacing = kSpacing * static_cast<double>(std::int64_t{1} << level),
          .finestIntervals = std::max(2, samples - 1)};
}

/// Settings that change what a plugin does, for the laws that are measured: the defaults, and more where a
/// plugin's rows of the table say too little.
std::vector<Entries> typicalSettings(const PluginInfo& info) {
  std::vector<Entries> settings{{}};
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
  if (info.id == "midpoint") {
    for (double hurst : {0.2, 0.5}) settings.push_back({{"hurst", hurst}});
    settings.push_back({{"m11", 0.75}, {"m22", std::string("randN")}, {"m23", std::string("randR")}});
  }
  return settings;
}

/// The typical ones; then every number at its least and at its greatest, every choice and both truths, one at
/// a time.
std::vector<Entries> settingsOf(const PluginInfo& info) {
  std::vector<Entries> settings = typicalSettings(info);
  for (const Parameter& parameter : info.parameters) {
    const std::string name(parameter.name);
    switch (parameter.type) {
      case ParameterType::real:
        settings.push_back({{name, parameter.min}});
        settings.push_back({{name, parameter.max}});
        break;
      case ParameterType::integer:
        settings.push_back({{name, static_cast<std::int64_t>(parameter.min)}});
        settings.push_back({{name, static_cast<std::int64_t>(parameter.max)}});
        break;
      case ParameterType::boolean:
        settings.push_back({{name, false}});
        settings.push_back({{name, true}});
        break;
      case ParameterType::choice:
        for (std::string_view choice : parameter.choices) settings.push_back({{name, std::string(choice)}});
        break;
      case ParameterType::text:
        break;  // only its plugin knows which texts it takes
    }
  }
  return settings;
}

std::string describe(const Values::Entry& entry) {
  const auto& [name, value] = entry;
  if (const auto* real = std::get_if<double>(&value)) return name + " = " + numberText(*real);
  if (const auto* integer = std::get_if<std::int64_t>(&value)) return name + " = " + std::to_string(*integer);
  if (const auto* text = std::get_if<std::string>(&value)) return name + " = " + *text;
  return name + (std::get<bool>(value) ? " = true" : " = false");
}

std::string describe(const Entries& entries) {
  if (entries.empty()) return "defaults";
  std::string all;
  for (const Values::Entry& entry : entries) all += (all.empty() ? "" : ", ") + describe(entry);
  return all;
}

class PluginContract : public testing::TestWithParam<std::string> {
 protected:
  const PluginInfo& info() const { return *registry().find(GetParam()); }
  MapMaker maker(const Entries& entries = {}) const { return MapMaker(info(), entries); }
};

TEST_P(PluginContract, SlicingChangesNoBit) {
  for (const Entries& entries : settingsOf(info())) {
    const MapMaker maker = this->maker(entries);
    for (int samples : {1, 3, 33}) {
      const HeightMap whole = maker.make(request(1, samples));
      EXPECT_TRUE(sameBits(maker.make(request(1, samples), test::shortestSlice()).view(), whole.view()))
          << describe(entries) << ", " << samples << " samples";
    }
  }
  const MapMaker maker = this->maker();
  const HeightMap whole = maker.make(request(2, 257));
  RandomSequence random(2);
  HeightMap map(257, 257);
  const auto task = maker.begin(request(2, 257), map.view());
  while (!task->step(Slice::lasting(std::chrono::microseconds(random.nextBits(6))))) {
  }
  EXPECT_TRUE(sameBits(map.view(), whole.view()));
}

TEST_P(PluginContract, WorkIsCutIntoManySteps) {
  HeightMap map(257, 257);
  EXPECT_GE(finish(*maker().begin(request(1, 257), map.view()), test::shortestSlice()), 16);
}

TEST_P(PluginContract, OrderAndInterleavingChangeNoBit) {
  const MapMaker maker = this->maker();
  constexpr int count = 8;
  std::vector<HeightMap> expected;
  for (int n = 0; n < count; ++n) expected.push_back(maker.make(request(n, 33)));
  for (int n = count; n-- > 0;) {
    EXPECT_TRUE(sameBits(this->maker().make(request(n, 33)).view(), expected[n].view()))
        << "backwards, " << n;
  }

  std::vector<HeightMap> maps(count, HeightMap(33, 33));
  std::vector<std::unique_ptr<SlicedTask>> tasks;
  for (int n = 0; n < count; ++n) tasks.push_back(maker.begin(request(n, 33), maps[n].view()));
  for (bool busy = true; busy;) {
    busy = false;
    for (auto& task : tasks) {
      if (task == nullptr) continue;
      if (task->step(test::shortestSlice())) task.reset();
      busy = true;
    }
  }
  for (int n = 0; n < count; ++n)
    EXPECT_TRUE(sameBits(maps[n].view(), expected[n].view())) << "interleaved, " << n;
}

TEST_P(PluginContract, ThreadsChangeNoBit) {
  const MapMaker maker = this->maker();
  constexpr int count = 64;
  std::vector<HeightMap> maps(count);
  {
    std::vector<std::jthread> threads;
    for (int first = 0; first < 4; ++first) {
      threads.emplace_back([&maker, &maps, first] {
        for (int n = first; n < count; n += 4)
          maps[n] = maker.make(request(n / 2, 65), test::shortestSlice());
      });
    }
  }
  for (int n = 0; n < count; ++n) {
    EXPECT_TRUE(sameBits(maps[n].view(), maker.make(request(n / 2, 65)).view())) << n;
  }
}

TEST_P(PluginContract, EveryLevelIsTheSubsampledFinestMapUnlessApproximate) {
  if (!maker().exactLevels()) GTEST_SKIP() << "approximate";
  for (const Entries& entries : settingsOf(info())) {
    const MapMaker maker = this->maker(entries);
    for (int n = 0; n < 3; ++n) {
      const HeightMap finest = maker.make(request(n, 65));
      for (int level = 0; level <= 7; ++level) {
        EXPECT_TRUE(
            sameBits(maker.make(request(n, 65, level)).view(), test::subsampled(finest, level).view()))
            << describe(entries) << ", level " << level;
      }
    }
  }
}

TEST_P(PluginContract, HeightsAreFiniteAndInsideTheRange) {
  for (const Entries& entries : settingsOf(info())) {
    const MapMaker maker = this->maker(entries);
    const HeightRange range = maker.range();
    ASSERT_TRUE(std::isfinite(range.min) && std::isfinite(range.max)) << describe(entries);
    EXPECT_LE(range.min, range.mean);
    EXPECT_LE(range.mean, range.max);
    EXPECT_GE(range.deviation, 0.0);
    for (int n = 0; n < 8; ++n) {
      const HeightMap map = maker.make(request(n, 33));
      for (float height : map.samples()) {
        ASSERT_TRUE(std::isfinite(height)) << describe(entries);
        ASSERT_GE(height, range.min) << describe(entries);
        ASSERT_LE(height, range.max) << describe(entries);
      }
    }
  }
}

TEST_P(PluginContract, EverySeedMakesAMap) {
  const MapMaker maker = this->maker();
  constexpr std::int64_t least = std::numeric_limits<std::int64_t>::min();
  for (std::uint64_t seed : {std::uint64_t{0}, ~std::uint64_t{0}, std::uint64_t{1} << 63}) {
    for (int samples : {1, 3, 65}) {
      MapRequest hostile = request(0, samples);
      hostile.seed = seed;
      hostile.i = least;
      hostile.j = ~least;
      const HeightMap map = maker.make(hostile);
      for (float height : map.samples()) ASSERT_TRUE(std::isfinite(height)) << seed;
    }
  }
}

/// Generators whose deviation varies over the map, as their documents say: only its root mean square over the
/// map's area is what they promise.
bool isUneven(const PluginInfo& info) {
  return info.id == "slope";
}

/// Root mean square over the area of a square map, samples on its rim counting half.
double overArea(const std::vector<double>& squares, int samples) {
  double sum = 0.0;
  const auto weight = [samples](int n) { return n == 0 || n == samples - 1 ? 0.5 : 1.0; };
  for (int row = 0; row < samples; ++row) {
    for (int column = 0; column < samples; ++column)
      sum += weight(row) * weight(column) * squares[static_cast<std::size_t>(row * samples + column)];
  }
  return std::sqrt(sum) / (samples - 1);
}

TEST_P(PluginContract, MeanAndDeviationAreAsPromisedAtEverySample) {
  constexpr int seeds = 4000, samples = 9;
  for (const Entries& entries : typicalSettings(info())) {
    SCOPED_TRACE(describe(entries));
    const MapMaker maker = this->maker(entries);
    const HeightRange range = maker.range();
    std::vector<double> sums(samples * samples), squares(samples * samples);
    for (int n = 0; n < seeds; ++n) {
      const HeightMap map = maker.make(request(n, samples));
      for (std::size_t sample = 0; sample < sums.size(); ++sample) {
        const double above = map.samples()[sample] - range.mean;
        sums[sample] += above;
        squares[sample] += above * above / seeds;
      }
    }
    if (isUneven(info())) {
      EXPECT_NEAR(overArea(squares, samples), range.deviation, 0.1 * range.deviation);
    }
    for (std::size_t sample = 0; sample < sums.size(); ++sample) {
      const double deviation = std::sqrt(squares[sample]);
      EXPECT_LE(std::fabs(sums[sample] / seeds),
                5.0 * (isUneven(info()) ? deviation : range.deviation) / std::sqrt(seeds))
          << sample;
      if (isUneven(info())) continue;
      EXPECT_LE(deviation, 1.1 * range.deviation) << sample;
      if (maker.filters()) {
        EXPECT_GT(deviation, 0.0) << sample;
      } else {
        EXPECT_GE(deviation, 0.9 * range.deviation) << sample;
      }
    }
  }
}

TEST_P(PluginContract, ResidualIsWhatLevelsGetWrong) {
  constexpr int seeds = 20, samples = 129;
  for (const Entries& entries : typicalSettings(info())) {
    SCOPED_TRACE(describe(entries));
    const MapMaker maker = this->maker(entries);
    EXPECT_EQ(maker.residual(0, samples), 0.0);
    for (int level = 1; level <= 5; ++level) {
      double square = 0.0;
      for (int n = 0; n < seeds; ++n) {
        square += test::squaredError(maker.make(request(n, samples)), maker.make(request(n, samples, level)),
                                     level);
      }
      const double measured = std::sqrt(square / seeds);
      const double promised = maker.residual(level, samples);
      EXPECT_LE(measured, (maker.filters() ? 1.1 : 1.5) * promised) << "level " << level;
      // A filter promises an upper bound; it should not be an idle one.
      EXPECT_GE(measured, promised / (maker.filters() ? 3.5 : 1.5)) << "level " << level;
    }
  }
}

TEST_P(PluginContract, ATaskMayBeGivenUpAfterAnyStep) {
  const MapMaker maker = this->maker();
  const HeightMap expected = maker.make(request(3, 33));
  bool done = false;
  for (int steps = 0; !done; ++steps) {
    HeightMap map(33, 33);
    {
      const auto task = maker.begin(request(3, 33), map.view());
      for (int n = 0; n < steps && !done; ++n) done = task->step(test::shortestSlice());
    }
    EXPECT_TRUE(sameBits(maker.make(request(3, 33)).view(), expected.view())) << "given up after " << steps;
  }
}

TEST_P(PluginContract, NothingIsWrittenBesideTheMap) {
  constexpr float mark = -12345.5f;
  const MapMaker maker = this->maker();
  for (int samples : {1, 3, 33}) {
    HeightMap whole(samples + 5, samples + 4);
    for (int row = 0; row < whole.rows(); ++row) std::fill_n(whole.view().row(row), whole.columns(), mark);
    const HeightView part = whole.view().part(2, 3, samples, samples);
    finish(*maker.begin(request(4, samples), part));
    EXPECT_TRUE(sameBits(part, maker.make(request(4, samples)).view()));
    for (int row = 0; row < samples; ++row) std::fill_n(part.row(row), samples, mark);
    for (float height : whole.samples()) ASSERT_EQ(height, mark);
  }
}

/// The message with which the plugin refuses the entries; empty where it takes them.
std::string refusal(const PluginInfo& info, const Entries& entries) {
  if (info.kind == PluginKind::filter) {
    const auto filter = registry().makeFilter(info.id, entries);
    return filter ? "" : filter.error().message;
  }
  const auto generator = registry().makeGenerator(info.id, entries);
  return generator ? "" : generator.error().message;
}

/// Values no parameter like this may take.
std::vector<ParameterValue> hostileValues(const Parameter& parameter) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::vector<ParameterValue> values{std::numeric_limits<double>::quiet_NaN(), infinity, -infinity};
  if (parameter.type == ParameterType::real || parameter.type == ParameterType::integer) {
    values.insert(values.end(),
                  {std::nextafter(parameter.max, infinity), std::nextafter(parameter.min, -infinity),
                   std::string("many"), true, std::numeric_limits<std::int64_t>::max(),
                   std::numeric_limits<std::int64_t>::min()});
  }
  if (parameter.type == ParameterType::integer) values.push_back(parameter.min + 0.5);
  if (parameter.type == ParameterType::boolean) values.push_back(std::string("true"));
  if (parameter.type == ParameterType::choice) values.push_back(std::string("no such choice"));
  if (parameter.type == ParameterType::text) {
    values.insert(values.end(), {std::string(static_cast<std::size_t>(parameter.max) + 1, ' '),
                                 std::string("line\nline"), true, std::int64_t{1}});
  }
  return values;
}

TEST_P(PluginContract, HostileParametersAreRefusedByName) {
  for (const Entries& entries : settingsOf(info())) EXPECT_EQ(refusal(info(), entries), "");
  EXPECT_NE(refusal(info(), {{"no such parameter", 1.0}}).find("no such parameter"), std::string::npos);
  for (const Parameter& parameter : info().parameters) {
    const std::string name(parameter.name);
    for (const ParameterValue& value : hostileValues(parameter)) {
      EXPECT_NE(refusal(info(), {{name, value}}).find(name), std::string::npos)
          << name << ", alternative " << value.index();
    }
    const ParameterValue usual = parameter.defaultValue();
    EXPECT_NE(refusal(info(), {{name, usual}, {name, usual}}).find(name), std::string::npos) << "given twice";
  }
}

TEST_P(PluginContract, TheTableSaysWhatEverythingIs) {
  EXPECT_FALSE(info().version.empty());
  EXPECT_FALSE(info().doc.empty());
  EXPECT_EQ(info().file.filename(), "teren-" + GetParam() + ".so");
  for (const Parameter& parameter : info().parameters) EXPECT_FALSE(parameter.doc.empty()) << parameter.name;
}

std::vector<std::string> everyId() {
  std::vector<std::string> ids;
  for (const PluginInfo& plugin : registry().plugins()) ids.push_back(plugin.id);
  return ids;
}

/// Test names may hold letters, digits and '_' only.
std::string testName(const testing::TestParamInfo<std::string>& plugin) {
  std::string name = plugin.param;
  for (char& letter : name) {
    if (letter == '-') letter = '_';
  }
  return name;
}

INSTANTIATE_TEST_SUITE_P(Every, PluginContract, testing::ValuesIn(everyId()), testName);

TEST(Plugins, TakeMatricesOfAnyOddSideAndRefuseOthersWithASentence) {
  const PluginInfo& matrix = *registry().find("matrix");
  EXPECT_EQ(refusal(matrix, {{"matrix", std::string("1 1 1; 1 1 1; 1 1 1")}}), "");
  const std::pair<Entries, const char*> cases[] = {
      {{{"matrix", std::string("1 1 1; 1 1; 1 1 1")}}, "row 2 of its matrix has 2 elements, expected 3"},
      {{{"matrix", std::string("1 1; 1 1")}}, "2 rows, expected an odd number from 1 to 31"},
      {{{"m22", -0.75}}, "elements of its matrix sum to 0, too near to zero"},
      {{{"m22", -0.25}}, "leaves 3 x 1 of them, too near to zero"},
      {{{"m12", -0.1}, {"m22", 0.5}, {"passes", std::int64_t{100}}},
       "more than a million times in 100 passes"},
  };
  for (const auto& [entries, sentence] : cases) {
    EXPECT_NE(refusal(matrix, entries).find(sentence), std::string::npos) << refusal(matrix, entries);
    EXPECT_NE(refusal(matrix, entries).find("plugin \"matrix\" refuses its parameters: "), std::string::npos);
  }
}

TEST(Plugins, AreAllFoundAndNoneIsRefused) {
  for (const char* id : {"band", "circles", "constant", "fault", "matrix", "midpoint", "slope", "spectral",
                         "steps", "thermal"})
    EXPECT_NE(registry().find(id), nullptr) << id;
  for (const RefusedModule& module : registry().refused())
    ADD_FAILURE() << module.file << ": " << module.reason;
}

}  // namespace
}  // namespace teren
