#include "stream/GroundRenewal.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "patch/ErrorCalibration.h"
#include "tests/engine/stream/FaultWorld.h"
#include "world/NodeErrors.h"

namespace teren {
namespace {

class Raised final : public GroundEdits {
 public:
  Raised(float height, double moved, std::size_t bytes = 0) : height_(height), moved_(moved), bytes_(bytes) {}
  void overlay(int, std::int64_t, std::int64_t, HeightView grid) const override {
    for (int y = 0; y < grid.rows(); ++y) std::fill_n(grid.row(y), grid.columns(), height_);
  }
  double moved(int, std::int64_t, std::int64_t) const override { return moved_; }
  std::size_t bytes() const noexcept override { return bytes_; }

 private:
  float height_;
  double moved_;
  std::size_t bytes_;
};

class GroundRenewalTest : public testing::Test {
 protected:
  GroundRenewalTest() : world(test::faultWorld(1, 9, {1024.0, 64.0}, 4)) {}
  HeightMap flat(int side) const {
    HeightMap heights(side, side);
    for (int y = 0; y < side; ++y) std::fill_n(heights.view().row(y), side, 1.0F);
    return heights;
  }
  void insert(const NodeKey& key) {
    const int n = world->intervals();
    nodes.insert(key, renewal.edited(key, flat(n + 1), flat(n / 2 + 3)), 0.0F);
    renewal.noteInserted(key);
  }
  void draw(std::vector<NodeKey> keys) {
    JoinTask task(nodes, {{}, std::move(keys)});
    while (!task.step(Slice::unlimited())) {
    }
    ASSERT_TRUE(nodes.apply(task.change(), task.pieces()));
  }
  void set(float height, double moved, const SampleBox& box) {
    renewal.setEdits(std::make_shared<const Raised>(height, moved), {&box, 1});
  }
  /// Until a decision is needed; how many steps.
  int go() {
    int steps = 0;
    while (renewal.step()) ++steps;
    return steps;
  }
  void build() {
    go();
    renewal.plan();
    go();
    renewal.make();
    go();
    auto task = renewal.takeTask();
    if (!task) return;
    while (!task->step(Slice::unlimited())) {
    }
    renewal.takeBuilt(std::move(task));
  }
  float heightOf(const NodeKey& key) const { return nodes.heights(key)->samples().front(); }

  std::shared_ptr<const World> world;
  NodeStore nodes{world->spacing(0), world->intervals(), true};
  GroundRenewal renewal{*world, nodes};
};

TEST_F(GroundRenewalTest, FindsAllThatSeesChangedSamplesAlsoBesideItsSquare) {
  const std::int64_t n = world->intervals();
  for (int level = 0; level <= std::min(3, world->topLevel()); ++level) {
    insert({level, 0, 0});
    insert({level, 1, 0});
    insert({level, -1, -1});
  }
  // Beyond the east side of the nodes (0, 0), as far as the coarser samples around a level-3 node reach.
  const std::int64_t east = (n << 3) + (2 << 3);
  set(5.0F, 1.0, {east, 3, east, 3});
  renewal.begin();
  go();
  EXPECT_TRUE(nodes.isComing({3, 0, 0}));
  EXPECT_TRUE(nodes.isComing({3, 1, 0}));
  EXPECT_FALSE(nodes.isComing({3, -1, -1}));
  EXPECT_FALSE(nodes.isComing({0, 0, 0}));
  EXPECT_FALSE(nodes.isComing({2, 0, 0}));
}

TEST_F(GroundRenewalTest, GoesOnByOneNodeOrOnePieceAtATime) {
  const std::int64_t n = world->intervals();
  std::vector<NodeKey> keys;
  for (std::int64_t j = 0; j < 12; ++j) {
    for (std::int64_t i = 0; i < 12; ++i) keys.push_back({0, i, j});
  }
  for (const NodeKey& key : keys) insert(key);
  draw(keys);
  const std::size_t pieces = nodes.snapshot()->meshes().size();
  set(5.0F, 1.0, {0, 0, 12 * n, 12 * n});
  renewal.begin();
  EXPECT_GE(go(), 12 * 12);
  EXPECT_EQ(heightOf(keys[5]), 1.0F);
  renewal.plan();
  EXPECT_GE(go(), 12 * 12);
  renewal.make();
  EXPECT_EQ(go(), static_cast<int>(pieces));
  auto task = renewal.takeTask();
  ASSERT_TRUE(task);
  while (!task->step(Slice::unlimited())) {
  }
  const std::uint64_t serial = nodes.serial();
  renewal.takeBuilt(std::move(task));
  int exchanges = 0;
  while (heightOf(keys[5]) == 1.0F) {
    ASSERT_EQ(nodes.serial(), serial);
    ASSERT_EQ(*nodes.drawnHeight({3, 3, 0.5, 0.5}), 1.0) << "nothing is shown before all is there";
    ASSERT_TRUE(renewal.step());
    ++exchanges;
  }
  EXPECT_EQ(exchanges, static_cast<int>(pieces) + 1);
  EXPECT_GT(nodes.serial(), serial);
  for (const NodeKey& key : keys) {
    EXPECT_EQ(heightOf(key), 5.0F);
    EXPECT_EQ(*nodes.drawnHeight({key.i, key.j, 0.5, 0.5}), 5.0);
  }
  EXPECT_GE(go(), static_cast<int>(pieces) + 12 * 12);
  EXPECT_FALSE(renewal.isUnderWay());
  for (const NodeKey& key : keys) EXPECT_EQ(heightOf(key), 5.0F);
  const auto scene = nodes.snapshot();
  for (const auto& mesh : scene->meshes()) EXPECT_EQ(mesh->minHeight, 5.0F);
}

TEST_F(GroundRenewalTest, RenewsWhatHasComeOrIsDrawnNoMoreSinceItWasFound) {
  const std::int64_t n = world->intervals();
  const NodeKey west{0, 0, 0}, east{0, 1, 0}, late{0, 0, 1}, later{0, 1, 1};
  insert(west);
  insert(east);
  draw({west, east});
  set(5.0F, 1.0, {0, 0, 2 * n, 2 * n});
  renewal.begin();
  go();
  ASSERT_TRUE(nodes.apply({{east}, {}}, {}));  // still held
  insert(late);
  EXPECT_EQ(heightOf(late), 1.0F) << "as all the others yet";
  go();
  renewal.plan();
  go();
  renewal.make();
  go();
  auto task = renewal.takeTask();
  insert(later);
  go();
  while (!task->step(Slice::unlimited())) {
  }
  renewal.takeBuilt(std::move(task));
  go();
  for (const NodeKey& key : {west, east, late, later}) EXPECT_EQ(heightOf(key), 5.0F);
}

TEST_F(GroundRenewalTest, LooksAtVerticesAgainOnceErrorsOfLevelsAreKnown) {
  const NodeKey key{1, 0, 0};
  insert(key);
  const double estimate = world->nodeErrors().estimate(1);
  const double moved = 0.1 * estimate;  // not seen beside what the level misses anyhow
  set(5.0F, moved, {0, 0, 4, 4});
  renewal.begin();
  build();
  go();
  ASSERT_NE(nodes.heights(key).coarser(), nullptr);
  ErrorCalibration calibration(*world);
  while (!calibration.step(Slice::unlimited())) {
  }
  ASSERT_LT(world->nodeErrors().estimate(1), 0.7 * estimate);
  renewal.lookAgain();
  ASSERT_TRUE(renewal.isWaiting());
  renewal.begin();
  build();
  go();
  EXPECT_EQ(nodes.heights(key).coarser(), nullptr);
  EXPECT_EQ(heightOf(key), 5.0F);
}

TEST_F(GroundRenewalTest, CountsWhatEditsTakeUntilTheyAreShownNoMore) {
  const SampleBox box{0, 0, 4, 4};
  for (const std::size_t bytes : {1000U, 10U}) {
    renewal.setEdits(std::make_shared<const Raised>(5.0F, 1.0, bytes), {&box, 1});
    EXPECT_EQ(renewal.bytes(), 1000U);
    renewal.begin();
    EXPECT_EQ(renewal.bytes(), 1000U);
    build();
    go();
    EXPECT_EQ(renewal.bytes(), bytes);
  }
}

TEST_F(GroundRenewalTest, LetsVerticesGoToTheCoarserSurfaceAgainOnceEditsAreTakenBack) {
  const NodeKey key{1, 0, 0};
  insert(key);
  ASSERT_NE(nodes.heights(key).coarser(), nullptr);
  const SampleBox box{0, 0, 4, 4};
  for (const bool isDeep : {true, false}) {
    set(isDeep ? -500.0F : 1.0F, isDeep ? 500.0 : 1e-30, box);
    renewal.begin();
    build();
    go();
    EXPECT_EQ(nodes.heights(key).coarser() == nullptr, isDeep);
  }
  EXPECT_EQ(nodes.heights(key).coarser()->samples().front(), 1.0F);
}

}  // namespace
}  // namespace teren
