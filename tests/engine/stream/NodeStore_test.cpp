#include "stream/NodeStore.h"

#include <algorithm>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "stream/JoinTask.h"

namespace teren {
namespace {

constexpr int kIntervals = 8;

NodeHeights level(float height) {
  auto heights = std::make_shared<HeightMap>(kIntervals + 1, kIntervals + 1);
  for (int row = 0; row <= kIntervals; ++row) std::fill_n(heights->view().row(row), kIntervals + 1, height);
  return heights;
}

class NodeStoreTest : public testing::Test {
 protected:
  NodeStoreTest() {
    for (const NodeKey& key : {west_, east_, north_, above_, far_}) store_.insert(key, level(1.0F));
  }
  std::unique_ptr<JoinTask> build(const DrawnChange& change) {
    auto task = std::make_unique<JoinTask>(store_, change);
    while (!task->step(Slice::until(Slice::Clock::time_point::min()))) {
    }
    return task;
  }
  bool apply(const JoinTask& task) { return store_.apply(task.change(), task.pieces()); }
  bool apply(const DrawnChange& change) { return apply(*build(change)); }

  NodeStore store_{1.0, kIntervals};
  const NodeKey west_{0, 0, 0}, east_{0, 1, 0}, north_{0, 0, 1};
  const NodeKey above_{1, 0, 0}, far_{1, 1, 0};  // above the three, and east of that
};

TEST_F(NodeStoreTest, DrawsNodesWithTheSeamsBetweenThemAtOnce) {
  const auto joined = build({{}, {west_, east_, north_}});
  EXPECT_EQ(joined->pieces().size(), 5U);
  EXPECT_TRUE(apply(*joined));
  EXPECT_EQ(store_.drawnCount(), 3U);
  EXPECT_EQ(store_.snapshot()->meshes().size(), 5U);
}

TEST_F(NodeStoreTest, RefusesPiecesBuiltForAnotherDrawnSet) {
  ASSERT_TRUE(apply({{}, {west_}}));
  const auto joined = build({{}, {east_}});
  ASSERT_TRUE(apply({{west_}, {}}));  // the seam that was built has lost its western node
  EXPECT_FALSE(apply(*joined));
  EXPECT_FALSE(store_.isDrawn(east_));
  const auto again = build({{}, {east_}});
  ASSERT_TRUE(apply({{}, {north_}}));
  EXPECT_TRUE(apply(*again));  // they meet in a corner only, where two more nodes are missing
  const auto late = build({{}, {west_}});
  ASSERT_TRUE(apply({{east_}, {}}));
  EXPECT_FALSE(apply(*late));
  ASSERT_TRUE(apply({{}, {east_}}));
  EXPECT_TRUE(apply({{}, {west_}}));
  EXPECT_EQ(store_.snapshot()->meshes().size(), 5U);
}

TEST_F(NodeStoreTest, RefusesNodesThatHaveComeGoneOrLostTheirHeights) {
  const auto first = build({{}, {west_}}), second = build({{}, {west_}});
  ASSERT_TRUE(apply(*first));
  EXPECT_FALSE(apply(*second));
  const auto parting = build({{west_}, {}}), partingAgain = build({{west_}, {}});
  ASSERT_TRUE(apply(*parting));
  EXPECT_FALSE(apply(*partingAgain));
  const auto late = build({{}, {east_}});
  store_.erase(east_);
  EXPECT_FALSE(apply(*late));
}

TEST_F(NodeStoreTest, ExchangesANodeForFinerOnesTogetherWithItsNeighboursBorders) {
  const NodeKey last{0, 1, 1};
  store_.insert(last, level(1.0F));
  ASSERT_TRUE(apply({{}, {above_, far_}}));
  const std::size_t before = store_.meshBytes();
  EXPECT_EQ(store_.snapshot()->meshes().size(), 3U);
  const DrawnChange refine{{above_}, {west_, east_, north_, last}};
  const auto borders = [&](const NodeKey& node) {
    const ChangePlan plan = store_.plan(refine);
    return std::count_if(plan.build.begin(), plan.build.end(), [&](const PiecePlan& piece) {
      return piece.name == PieceName{node, Piece::border};
    });
  };
  EXPECT_EQ(borders(far_), 1);
  EXPECT_EQ(borders(east_), 1);
  EXPECT_EQ(borders(west_), 0);
  ASSERT_TRUE(apply(refine));
  EXPECT_EQ(store_.drawnOver(west_), west_);
  EXPECT_EQ(store_.drawnIn(above_).size(), 4U);
  std::vector<NodeKey> touching;
  store_.forEachDrawnTouching(above_, [&](const NodeKey& key) {
    if (!isIn(key, above_)) touching.push_back(key);
  });
  EXPECT_EQ(touching, std::vector{far_});
  ASSERT_TRUE(apply({{west_, east_, north_, last}, {above_}}));
  EXPECT_EQ(store_.meshBytes(), before);
  EXPECT_EQ(store_.snapshot()->meshes().size(), 3U);
}

TEST_F(NodeStoreTest, GivesMeshesIncreasingIdsInTheOrderTheyAreDrawn) {
  const auto first = build({{}, {west_}}), second = build({{}, {north_}});
  ASSERT_TRUE(apply({{}, {east_}}));
  EXPECT_FALSE(apply(*first));  // built before the east was drawn
  ASSERT_TRUE(apply(*second));
  const auto scene = store_.snapshot();
  const auto meshes = scene->meshes();
  EXPECT_TRUE(std::is_sorted(meshes.begin(), meshes.end(),
                             [](const auto& a, const auto& b) { return a->id < b->id; }));
}

TEST_F(NodeStoreTest, CountsWhatWasDroppedAsLongAsASnapshotMayHaveIt) {
  ASSERT_TRUE(apply({{}, {west_, east_}}));
  std::shared_ptr<const Scene> scene = store_.snapshot();
  const std::size_t drawn = store_.bytes(), meshes = store_.meshBytes();
  ASSERT_TRUE(apply({{west_, east_}, {}}));
  EXPECT_EQ(store_.meshBytes(), 0U);
  EXPECT_GE(store_.bytes() + drawn / 4, drawn) << "the last snapshot has it";
  EXPECT_FALSE(store_.letGoOfOldSnapshots());
  scene = store_.snapshot();
  EXPECT_GE(store_.bytes() + drawn / 4, drawn) << "the one before may be held";
  EXPECT_TRUE(store_.letGoOfOldSnapshots());
  EXPECT_LE(store_.bytes() + meshes, drawn);
}

TEST_F(NodeStoreTest, CountsNoMoreThanItSaysANodeAndAChangeCost) {
  const std::size_t held = store_.bytes();
  EXPECT_LE(held, 5 * store_.heldBytes());
  std::size_t before = held;
  for (const NodeKey& key : {west_, east_, north_}) {
    ASSERT_TRUE(apply({{}, {key}}));
    store_.snapshot();
    store_.letGoOfOldSnapshots();
    const std::size_t indices = 200 * sizeof(std::uint32_t) * kIntervals;
    EXPECT_LE(store_.bytes() - before, store_.piecesBytes() + indices);
    before = store_.bytes();
  }
  const auto beside = build({{}, {far_}});
  const std::size_t meshes = store_.meshBytes();
  ASSERT_TRUE(apply(*beside));
  EXPECT_LE(store_.meshBytes() - meshes, beside->bytes());
  ASSERT_TRUE(apply({{far_}, {}}));
  for (const NodeKey& key : {west_, east_, north_}) {
    ASSERT_TRUE(apply({{key}, {}}));
    store_.erase(key);
  }
  EXPECT_EQ(store_.meshBytes(), 0U);
  EXPECT_EQ(store_.nodes().size(), 2U);
}

}  // namespace
}  // namespace teren
