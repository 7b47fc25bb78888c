#include "teren/StepLimit.h"

#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Hash.h"
#include "teren/PluginRegistry.h"

#include "tests/support/SlicedWork.h"

namespace teren {
namespace {

using Entries = std::vector<Values::Entry>;

/// Everything a plugin counts - faults, discs, passes - at the most it takes.
Entries dearest(const PluginInfo& info) {
  Entries entries;
  for (const Parameter& parameter : info.parameters) {
    if (parameter.type != ParameterType::integer) continue;
    entries.emplace_back(std::string(parameter.name), static_cast<std::int64_t>(parameter.max));
  }
  if (info.id == "matrix") {
    std::string rows;
    for (int row = 0; row < 31; ++row) {
      if (row > 0) rows += ";";
      for (int column = 0; column < 31; ++column) rows += " 1";
    }
    entries.emplace_back("matrix", rows);
  }
  return entries;
}

/// The steps of one map in slices that are over before they begin.
int stepsOf(const PluginInfo& info, const Entries& entries, int samples) {
  const auto registry = PluginRegistry::standard();
  HeightMap map(samples, samples);
  RandomSequence heights(6);
  for (int row = 0; row < samples; ++row) {
    for (int column = 0; column < samples; ++column)
      map(column, row) = static_cast<float>(heights.nextBits(7));
  }
  const MapRequest request{.seed = 5, .samples = samples, .level = samples == 1 ? 6 : 0};
  if (info.kind == PluginKind::filter) {
    const auto filter = registry->makeFilter(info.id, entries);
    if (!filter) ADD_FAILURE() << filter.error().message;
    return filter ? test::finish(*(*filter)->begin(request, map.view()), test::shortestSlice()) : 0;
  }
  const auto generator = registry->makeGenerator(info.id, entries);
  if (!generator) ADD_FAILURE() << generator.error().message;
  return generator ? test::finish(*(*generator)->begin(request, map.view()), test::shortestSlice()) : 0;
}

TEST(StepLimit, IsTenTimesWhatAnyPluginNeedsAtItsDearestInTheShortestSlices) {
  for (const PluginInfo& info : PluginRegistry::standard()->plugins()) {
    if (info.kind == PluginKind::deformer) continue;  // counts steps of its own
    for (const int samples : {1, 3, 5, 17, 65}) {
      const int steps = stepsOf(info, dearest(info), samples);
      EXPECT_LE(10 * std::int64_t{steps}, stepLimit(samples, samples)) << info.id << ", " << samples;
    }
  }
}

TEST(StepLimit, GrowsWithTheMapAndStaysWhereATaskThatIsNeverDoneIsSoonFoundOut) {
  EXPECT_EQ(stepLimit(1, 1), 32768);
  EXPECT_EQ(stepLimit(3, 3), 32768);
  EXPECT_EQ(stepLimit(65, 65), 936'000);
  EXPECT_EQ(stepLimit(1025, 1025), 77'736'000);
  EXPECT_EQ(stepLimit(5, 33), stepLimit(33, 5)) << "whichever way a task goes";
  EXPECT_EQ(stepLimit(5, 33), 10240 * 33 + 64 * 5 * 33);
}

}  // namespace
}  // namespace teren
