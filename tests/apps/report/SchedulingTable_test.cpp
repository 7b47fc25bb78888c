// What a short flight tells of budgets and workers.
#include "apps/report/SchedulingTable.h"

#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

namespace teren {
namespace {

TEST(SchedulingTable, HasARowForEachBudgetAndNumberOfWorkers) {
  WorldDescription description;
  description.layers.resize(1);
  description.layers[0].generator = "fault";
  const auto world = World::create(description, *PluginRegistry::standard());
  ASSERT_TRUE(world);
  Effort effort = Effort::ofAMinute();
  effort.schedulingDistance = 400.0;
  effort.schedulingPixelError = 16.0;
  effort.schedulingSeconds = 1.5;
  const std::vector<double> budgets{2.0, 8.0};
  const auto table = measureScheduling(*world, budgets, effort, [] { return true; });
  ASSERT_TRUE(table) << table.error().message;
  ASSERT_EQ(table->rows().size() % 2, 0U);
  for (std::size_t row = 0; row < table->rows().size(); ++row) {
    EXPECT_EQ(table->number(row, "budget"), budgets[row % 2]);
    EXPECT_EQ(table->number(row, "workers"), static_cast<double>(row / 2));
    EXPECT_EQ(table->number(row, "updates"), 90.0);
    EXPECT_NEAR(table->number(row, "nodes a second") * table->number(row, "time to fill"),
                std::round(table->number(row, "nodes a second") * table->number(row, "time to fill")), 1e-6)
        << "a number of nodes";
    EXPECT_GT(table->number(row, "work to fill"), 0.0);
    EXPECT_GE(table->number(row, "error p99"), table->number(row, "error median"));
    EXPECT_LE(table->number(row, "error reached"), 100.0);
    EXPECT_EQ(table->number(row, "looks"), 30.0) << "one an update, but in the first second";
  }
}

TEST(SchedulingTable, EndsWhenItIsAskedTo) {
  const auto world = World::create(WorldDescription::standard(), *PluginRegistry::standard());
  ASSERT_TRUE(world);
  int left = 50;
  const std::vector<double> budgets{1.0};
  const auto table = measureScheduling(*world, budgets, Effort::full(), [&] { return --left > 0; });
  ASSERT_FALSE(table);
  EXPECT_EQ(table.error().message, "interrupted");
}

}  // namespace
}  // namespace teren
