// The whole report in little, part after part.
#include "apps/report/Report.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "teren/PluginRegistry.h"

#include "apps/report/FrameTable.h"

namespace teren {
namespace {

/// Of everything the least that there are figures of.
Effort least() {
  Effort effort = Effort::ofAMinute();
  effort.repetitions = 3;
  effort.blendingPatches = 4;
  effort.creasePlaces = 1;
  effort.residualMaps = 2;
  effort.groundIntervals = 128;
  return effort;
}

/// Before what measures the whole world shipped: that takes long.
TEST(Report, MeasuresPartAfterPartUntilItIsAskedToStop) {
  const Result<Table> frames = readFrames({});
  ASSERT_TRUE(frames);
  std::vector<std::string> begun;
  const Result<MeasuredReport> report = measureReport(
      *PluginRegistry::standard(), {}, *frames, least(),
      [&](const std::string& name) { begun.push_back(name); },
      [&] { return begun.back() != "level of detail"; });
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().message, "interrupted");
  EXPECT_EQ(begun, (std::vector<std::string>{"blending", "generators", "triangles", "node meshes",
                                             "level of detail"}));
}

}  // namespace
}  // namespace teren
