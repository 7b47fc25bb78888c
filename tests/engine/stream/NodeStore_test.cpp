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
    for (const NodeKey& key : {west_, east_, north_}) store_.insert(key, level(1.0F));
  }
  std::vector<JoinTask::Joined> build(const std::vector<NodeKey>& batch) {
    JoinTask task(store_, batch);
    while (!task.step(Slice::until(Slice::Clock::time_point::min()))) {
    }
    return std::move(task.joined());
  }
  bool draw(const JoinTask::Joined& joined) { return store_.draw(joined.node, joined.pieces); }

  NodeStore store_{1.0, kIntervals};
  const NodeKey west_{0, 0, 0}, east_{0, 1, 0}, north_{0, 0, 1};
};

TEST_F(NodeStoreTest, DrawsABatchInItsOrderWithTheSeamsBetweenItsNodes) {
  const auto joined = build({west_, east_, north_});
  ASSERT_EQ(joined.size(), 3U);
  EXPECT_EQ(joined[0].pieces.size(), 1U);
  EXPECT_EQ(joined[1].pieces.size(), 2U);
  EXPECT_EQ(joined[2].pieces.size(), 2U);
  for (const auto& one : joined) EXPECT_TRUE(draw(one));
  EXPECT_EQ(store_.drawnCount(), 3U);
  EXPECT_EQ(store_.snapshot()->meshes().size(), 5U);
}

TEST_F(NodeStoreTest, RefusesPiecesBuiltForAnotherDrawnSet) {
  ASSERT_TRUE(draw(build({west_})[0]));
  const auto joined = build({east_});
  store_.undraw(west_);  // the seam that was built has lost its western node
  EXPECT_FALSE(draw(joined[0]));
  EXPECT_FALSE(store_.isDrawn(east_));
  const auto again = build({east_});
  ASSERT_TRUE(draw(build({north_})[0]));  // no neighbour of it, so nothing has changed
  EXPECT_TRUE(draw(again[0]));
  const auto late = build({west_});
  store_.undraw(east_);
  EXPECT_FALSE(draw(late[0]));
  ASSERT_TRUE(draw(build({east_})[0]));
  EXPECT_TRUE(draw(build({west_})[0]));
  EXPECT_EQ(store_.snapshot()->meshes().size(), 5U);
}

TEST_F(NodeStoreTest, GivesMeshesIncreasingIdsInTheOrderTheyAreDrawn) {
  const auto first = build({west_}), second = build({north_});
  ASSERT_TRUE(draw(build({east_})[0]));
  EXPECT_FALSE(draw(first[0]));  // built before the east was drawn
  ASSERT_TRUE(draw(second[0]));
  const auto scene = store_.snapshot();
  const auto meshes = scene->meshes();
  EXPECT_TRUE(std::is_sorted(meshes.begin(), meshes.end(),
                             [](const auto& a, const auto& b) { return a->id < b->id; }));
}

TEST_F(NodeStoreTest, CountsNoMoreThanItSaysANodeCosts) {
  const std::size_t held = store_.bytes();
  EXPECT_LE(held, 3 * store_.heldBytes());
  std::size_t before = held;
  for (const NodeKey& key : {west_, east_, north_}) {
    ASSERT_TRUE(draw(build({key})[0]));
    const std::size_t indices = 200 * sizeof(std::uint32_t) * kIntervals;
    EXPECT_LE(store_.bytes() - before, store_.piecesBytes() + indices);
    before = store_.bytes();
  }
  for (const NodeKey& key : {west_, east_, north_}) store_.erase(key);
  EXPECT_EQ(store_.meshBytes(), 0U);
  EXPECT_TRUE(store_.nodes().empty());
}

}  // namespace
}  // namespace teren
