#include "stream/Selection.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "tests/engine/stream/PatchGround.h"

namespace teren {
namespace {

constexpr int kTop = 9;

/// Errors double from level to level, as those of rough ground do about: 0.5 m at level 1.
Selection::Ground roughGround() {
  Selection::Ground ground{64.0, -100.0, 300.0, {0.0}};
  for (int level = 1; level <= kTop; ++level) ground.errors.push_back(0.25 * std::exp2(level));
  return ground;
}

Viewer viewerAt(double east, double north, double height, double pixelError = 2.0, double distance = 8000.0) {
  return {*Position::fromMetres(east, north, 64.0), height, {.pixelError = pixelError, .distance = distance}};
}

Viewer randomViewer(Dice& dice) {
  return viewerAt(dice.between(-1e5, 1e5), dice.between(-1e5, 1e5), dice.between(-50.0, 3000.0),
                  dice.between(0.5, 8.0), dice.between(500.0, 20'000.0));
}

std::vector<NodeKey> leavesOf(const Selection& selection) {
  std::vector<NodeKey> leaves;
  for (const SelectedNode& node : selection.nodes()) {
    if (node.isLeaf) leaves.push_back(node.key);
  }
  return leaves;
}

using Name = std::tuple<int, std::int64_t, std::int64_t>;
std::set<Name> namesOf(const std::vector<NodeKey>& keys) {
  std::set<Name> names;
  for (const NodeKey& key : keys) names.insert({key.level, key.j, key.i});
  return names;
}

TEST(PixelsPerMetre, AreThoseOfAPinholeCamera) {
  // 90 degrees over 1000 lines: a metre one metre away fills half of them.
  EXPECT_NEAR(pixelsPerMetre({.lines = 1000.0, .fieldOfView = std::acos(-1.0) / 2.0}), 500.0, 1e-9);
}

TEST(Selection, ShowsNobodyALargerErrorThanIsWantedButWhereItIsAtItsFinest) {
  Dice dice(1);
  Selection selection(roughGround());
  for (int trial = 0; trial < 50; ++trial) {
    const std::vector<Viewer> viewers{randomViewer(dice), randomViewer(dice)};
    selection.choose(viewers, 1.0);
    ASSERT_EQ(selection.leaves(), leavesOf(selection).size());
    for (const NodeKey& leaf : leavesOf(selection)) {
      ASSERT_TRUE(leaf.level == 0 || selection.seen(leaf) <= 1.0);
      ASSERT_TRUE(selection.isLeaf(leaf) && selection.contains(leaf));
    }
  }
}

TEST(Selection, IsNowhereFinerThanSomeoneWantsOrBalanceDemands) {
  Selection selection(roughGround());
  selection.choose(std::vector{viewerAt(10.0, 20.0, 50.0)}, 1.0);
  const std::set<Name> leaves = namesOf(leavesOf(selection));
  std::size_t forced = 0;
  for (const SelectedNode& node : selection.nodes()) {
    if (!node.isLeaf && selection.seen(node.key) <= 1.0) ++forced;
  }
  EXPECT_LT(forced, leaves.size() / 8);
}

TEST(Selection, CoversItsRootsOnceWithNeighboursAtMostOneLevelApart) {
  Dice dice(2);
  Selection selection(roughGround());
  for (int trial = 0; trial < 20; ++trial) {
    selection.choose(std::vector{randomViewer(dice)}, 1.0);
    const std::vector<NodeKey> leaves = leavesOf(selection);
    double area = 0.0, roots = 0.0;
    for (const SelectedNode& node : selection.nodes()) {
      const double side = std::exp2(node.key.level);
      if (node.isLeaf) area += side * side;
      if (selection.isRoot(node.key)) roots += side * side;
    }
    ASSERT_EQ(area, roots);
    for (const NodeKey& a : leaves) {
      for (const NodeKey& b : leaves) {
        ASSERT_TRUE(!touch(a, b) || std::abs(a.level - b.level) <= 1);
      }
    }
  }
}

TEST(Selection, HasNoCoarserRootsThanMayLieBesideTheFinest) {
  Selection::Ground ground = roughGround();
  ground.coarsest = 3;
  Selection selection(ground);
  ASSERT_TRUE(selection.choose(std::vector{viewerAt(10.0, 20.0, 50.0, 8.0, 20'000.0)}, 1.0));
  EXPECT_EQ(selection.rootLevel(), 3);
  for (const SelectedNode& node : selection.nodes()) ASSERT_LE(node.key.level, 3);
}

TEST(Selection, WantsTheNearestRootsFirst) {
  Selection::Ground ground = roughGround();
  ground.coarsest = 3;
  Selection selection(ground);
  const Viewer viewer = viewerAt(10.0, 20.0, 50.0, 64.0, 20'000.0);
  ASSERT_TRUE(selection.choose(std::vector{viewer}, 1.0));
  double farthest = 0.0;
  std::size_t roots = 0;
  for (const SelectedNode& node : selection.nodes()) {
    if (!selection.isRoot(node.key)) continue;
    const Offset corner = offset(viewer.position, {node.key.i * 8, node.key.j * 8, 0.0, 0.0}, 64.0);
    const double east = std::max({corner.east, -corner.east - 512.0, 0.0});
    const double north = std::max({corner.north, -corner.north - 512.0, 0.0});
    const double away = std::hypot(east, north);
    EXPECT_GE(away, farthest - 1e-6);
    farthest = std::max(farthest, away);
    ++roots;
  }
  EXPECT_GT(roots, 1000U);
}

TEST(Selection, GivesUpWhereThereAreMoreNodesThanMayBe) {
  Selection selection(roughGround());
  const std::vector<Viewer> viewers{viewerAt(10.0, 20.0, 50.0)};
  ASSERT_TRUE(selection.choose(viewers, 1.0));
  const std::size_t leaves = selection.leaves();
  EXPECT_FALSE(selection.choose(viewers, 1.0, leaves / 4));
  EXPECT_TRUE(selection.nodes().empty());
  EXPECT_TRUE(selection.choose(viewers, 1.0, leaves + 3));
  EXPECT_EQ(selection.leaves(), leaves);
}

TEST(Selection, ListsTheMostUrgentFirstAndNothingBeforeWhatIsAboveIt) {
  Selection selection(roughGround());
  selection.choose(std::vector{viewerAt(0.0, 0.0, 100.0), viewerAt(9000.0, 0.0, 100.0)}, 1.0);
  std::set<Name> before;
  double urgency = INFINITY;
  for (const SelectedNode& node : selection.nodes()) {
    ASSERT_LE(node.urgency, urgency);
    urgency = node.urgency;
    const NodeKey above = node.key.parent();
    ASSERT_TRUE(selection.isRoot(node.key) || before.contains({above.level, above.j, above.i}));
    before.insert({node.key.level, node.key.j, node.key.i});
  }
}

TEST(Selection, GivesEachViewerItsOwnErrorAndDistance) {
  Selection both(roughGround()), sharp(roughGround()), coarse(roughGround());
  const Viewer one = viewerAt(0.0, 0.0, 50.0, 0.5, 2000.0),
               other = viewerAt(50'000.0, 0.0, 50.0, 8.0, 4000.0);
  both.choose(std::vector{one, other}, 1.0);
  sharp.choose(std::vector{one}, 1.0);
  coarse.choose(std::vector{other}, 1.0);
  const auto finest = [](const std::vector<NodeKey>& leaves, std::int64_t fromPatch, std::int64_t toPatch) {
    int level = kTop;
    for (const NodeKey& leaf : leaves) {
      const std::int64_t patch = leaf.i << leaf.level;
      if (patch >= fromPatch && patch < toPatch) level = std::min(level, leaf.level);
    }
    return level;
  };
  EXPECT_EQ(finest(leavesOf(both), -64, 64), 0);
  EXPECT_GE(finest(leavesOf(both), 730, 760), 3);  // a mile from the other
  EXPECT_LE(finest(leavesOf(both), 20, 31), 2);    // as far from the one
  EXPECT_GT(leavesOf(sharp).size(), leavesOf(coarse).size());
  EXPECT_TRUE(both.contains(nodeAt(other.position, both.rootLevel())));
  EXPECT_FALSE(both.contains(nodeAt(*Position::fromMetres(25'000.0, 0.0, 64.0), both.rootLevel())));
}

TEST(Selection, HalfTheErrorTakesTwoToSixTimesTheNodes) {
  Selection fine(roughGround()), coarse(roughGround());
  fine.choose(std::vector{viewerAt(0.0, 0.0, 100.0, 1.0, 20'000.0)}, 1.0);
  coarse.choose(std::vector{viewerAt(0.0, 0.0, 100.0, 2.0, 20'000.0)}, 1.0);
  const double ratio = static_cast<double>(fine.leaves()) / static_cast<double>(coarse.leaves());
  EXPECT_GT(ratio, 2.0);
  EXPECT_LT(ratio, 6.0);
}

TEST(Selection, ATolerancePassesForSoManyTimesThePixelError) {
  Selection tolerant(roughGround()), coarse(roughGround());
  tolerant.choose(std::vector{viewerAt(0.0, 0.0, 100.0, 1.0)}, 4.0);
  coarse.choose(std::vector{viewerAt(0.0, 0.0, 100.0, 4.0)}, 1.0);
  EXPECT_EQ(namesOf(leavesOf(tolerant)), namesOf(leavesOf(coarse)));
}

TEST(Selection, KeepsWhatIsSplitUntilItsErrorIsAFifthSmaller) {
  Selection selection(roughGround()), fresh(roughGround());
  const auto nodesAt = [](Selection& some, double east) {
    some.choose(std::vector{viewerAt(east, 0.0, 100.0)}, 1.0);
    return namesOf(leavesOf(some));
  };
  const auto there = nodesAt(selection, 0.0);
  selection.keep();
  const auto fro = nodesAt(selection, 30.0);
  selection.keep();
  const auto back = nodesAt(selection, 0.0);
  EXPECT_EQ(fro, back);  // to and fro changes nothing any more
  EXPECT_GE(back.size(), there.size());
  int kept = 0;
  for (double east = 30.0; east <= 300.0; east += 30.0) {
    Selection moved(roughGround());
    nodesAt(moved, 0.0);
    moved.keep();
    if (nodesAt(moved, east) != nodesAt(fresh, east)) ++kept;
    EXPECT_GE(moved.leaves(), fresh.leaves());
  }
  EXPECT_GE(kept, 5);
  selection.choose(std::vector{viewerAt(1e6, 0.0, 100.0)}, 1.0);
  selection.keep();
  EXPECT_EQ(nodesAt(selection, 0.0), there);  // what was left long ago is forgotten
}

TEST(Selection, IsTheSameForTheSameViewers) {
  Dice dice(3);
  Selection a(roughGround()), b(roughGround());
  for (int step = 0; step < 50; ++step) {
    const Viewer viewer = viewerAt(200.0 * step, dice.between(0.0, 100.0), 100.0);
    for (Selection* selection : {&a, &b}) {
      selection->choose(std::vector{viewer}, 1.0);
      selection->keep();
    }
    ASSERT_TRUE(std::equal(a.nodes().begin(), a.nodes().end(), b.nodes().begin(), b.nodes().end(),
                           [](const SelectedNode& x, const SelectedNode& y) {
                             return x.key == y.key && x.isLeaf == y.isLeaf && x.urgency == y.urgency;
                           }));
  }
}

TEST(Selection, EndsWithTheWorld) {
  Selection selection(roughGround());
  const Viewer viewer{{kMaxPatch - 1, -kMaxPatch, 0.5, 0.5}, 100.0, {.distance = 5000.0}};
  selection.choose(std::vector{viewer}, 1.0);
  for (const SelectedNode& node : selection.nodes()) {
    EXPECT_LT(node.key.i << node.key.level, kMaxPatch);
    EXPECT_GE(node.key.j << node.key.level, -kMaxPatch);
  }
}

}  // namespace
}  // namespace teren
