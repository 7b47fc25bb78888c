#include "apps/fly/FrameGraph.h"

#include <limits>

#include <gtest/gtest.h>

#include "tests/support/AllocationCount.h"

namespace teren {
namespace {

TEST(FrameGraph, KeepsTheLatestFramesInTheirOrder) {
  FrameGraph graph;
  EXPECT_EQ(graph.count(), 0U);
  EXPECT_EQ(graph.figures().p99, 0.0);
  graph.add(10.0, 1.0);
  graph.add(20.0, 2.0);
  ASSERT_EQ(graph.count(), 2U);
  EXPECT_EQ(graph.at(0).whole, 10.0F);
  EXPECT_EQ(graph.at(1).engine, 2.0F);
  constexpr auto kMore = static_cast<int>(FrameGraph::kFrames);
  for (int frame = 0; frame < kMore; ++frame) graph.add(100.0 + frame, 5.0);
  ASSERT_EQ(graph.count(), FrameGraph::kFrames);
  EXPECT_EQ(graph.at(0).whole, 100.0F) << "the first two are gone";
  EXPECT_EQ(graph.at(FrameGraph::kFrames - 1).whole, 99.0F + kMore);
}

TEST(FrameGraph, TellsPercentilesByNearestRankAndTheEnginesShare) {
  FrameGraph graph;
  for (int frame = 200; frame > 0; --frame) graph.add(frame, 0.25 * frame);
  const FrameGraph::Figures figures = graph.figures();
  EXPECT_EQ(figures.p50, 100.0);
  EXPECT_EQ(figures.p99, 198.0);
  EXPECT_NEAR(figures.engineShare, 0.25, 1e-6);
}

TEST(FrameGraph, TakesNothingImpossible) {
  FrameGraph graph;
  graph.add(std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity());
  graph.add(-3.0, -1.0);
  graph.add(4.0, 9.0);
  EXPECT_EQ(graph.at(0).whole, 0.0F);
  EXPECT_EQ(graph.at(0).engine, 0.0F);
  EXPECT_EQ(graph.at(1).whole, 0.0F);
  EXPECT_EQ(graph.at(2).engine, 4.0F);
}

TEST(FrameGraph, HasAScaleThatItsFramesFitInto) {
  EXPECT_EQ(FrameGraph::scale(0.0), 20.0);
  EXPECT_EQ(FrameGraph::scale(19.0), 20.0);
  EXPECT_EQ(FrameGraph::scale(33.0), 50.0);
  EXPECT_EQ(FrameGraph::scale(450.0), 500.0);
  EXPECT_EQ(FrameGraph::scale(1e9), 2000.0);
}

TEST(FrameGraph, AllocatesNothing) {
  FrameGraph graph;
  const auto before = test::allocationCount();
  double sum = 0.0;
  for (int frame = 0; frame < 1000; ++frame) {
    graph.add(frame, 1.0);
    sum += graph.figures().p50;
  }
  EXPECT_EQ(test::allocationCount(), before);
  EXPECT_GT(sum, 0.0);
}

}  // namespace
}  // namespace teren
