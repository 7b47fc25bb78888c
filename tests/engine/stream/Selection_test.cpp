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

/// The most urgent first.
std::vector<Cut::Node> nodesOf(const Selection& selection) {
  std::vector<Cut::Node> nodes;
  for (const Cut::Index index : selection.chosen().byUrgency()) nodes.push_back(selection.chosen()[index]);
  return nodes;
}

std::vector<NodeKey> leavesOf(const Selection& selection) {
  std::vector<NodeKey> leaves;
  for (const Cut::Node& node : nodesOf(selection)) {
    if (node.isLeaf()) leaves.push_back(node.key);
  }
  return leaves;
}

bool isRoot(const Cut::Node& node) {
  return node.parent == Cut::kNone;
}

bool isIn(const Selection& selection, const NodeKey& key) {
  return selection.chosen().find(key) != Cut::kNone;
}

using Name = std::tuple<int, std::int64_t, std::int64_t>;
std::set<Name> namesOf(const std::vector<NodeKey>& keys) {
  std::set<Name> names;
  for (const NodeKey& key : keys) names.insert({key.level, key.j, key.i});
  return names;
}

TEST(Selection, ShowsNobodyALargerErrorThanIsWantedButWhereItIsAtItsFinest) {
  Dice dice(1);
  Selection selection(roughGround());
  for (int trial = 0; trial < 50; ++trial) {
    const std::vector<Viewer> viewers{randomViewer(dice), randomViewer(dice)};
    selection.choose(viewers, 1.0);
    ASSERT_EQ(selection.chosen().leaves(), leavesOf(selection).size());
    for (const NodeKey& leaf : leavesOf(selection)) {
      ASSERT_TRUE(leaf.level == 0 || selection.seen(leaf) <= 1.0);
      ASSERT_TRUE(isIn(selection, leaf));
    }
  }
}

TEST(Selection, IsNowhereFinerThanSomeoneWantsOrBalanceDemands) {
  Selection selection(roughGround());
  selection.choose(std::vector{viewerAt(10.0, 20.0, 50.0)}, 1.0);
  const std::set<Name> leaves = namesOf(leavesOf(selection));
  std::size_t forced = 0;
  for (const Cut::Node& node : nodesOf(selection)) {
    if (!node.isLeaf() && selection.seen(node.key) <= 1.0) ++forced;
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
    for (const Cut::Node& node : nodesOf(selection)) {
      const double side = std::exp2(node.key.level);
      if (node.isLeaf()) area += side * side;
      if (isRoot(node)) roots += side * side;
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
  EXPECT_EQ(selection.chosen().rootLevel(), 3);
  for (const Cut::Node& node : nodesOf(selection)) ASSERT_LE(node.key.level, 3);
}

TEST(Selection, WantsTheNearestRootsFirst) {
  Selection::Ground ground = roughGround();
  ground.coarsest = 3;
  Selection selection(ground);
  const Viewer viewer = viewerAt(10.0, 20.0, 50.0, 64.0, 20'000.0);
  ASSERT_TRUE(selection.choose(std::vector{viewer}, 1.0));
  double farthest = 0.0;
  std::size_t roots = 0;
  for (const Cut::Node& node : nodesOf(selection)) {
    if (!isRoot(node)) continue;
    const Offset corner = offset(viewer.position, {node.key.i * 8, node.key.j * 8, 0.0, 0.0}, 64.0);
    const double east = std::max({corner.east, -corner.east - 512.0, 0.0});
    const double north = std::max({corner.north, -corner.north - 512.0, 0.0});
    const double away = std::hypot(east, north);
    EXPECT_GE(away, farthest - 0.01);  // urgencies are floats
    farthest = std::max(farthest, away);
    ++roots;
  }
  EXPECT_GT(roots, 1000U);
}

TEST(Selection, GivesUpWhereThereAreMoreNodesThanMayBe) {
  Selection selection(roughGround());
  const std::vector<Viewer> viewers{viewerAt(10.0, 20.0, 50.0)};
  ASSERT_TRUE(selection.choose(viewers, 1.0));
  const std::size_t leaves = selection.chosen().leaves();
  EXPECT_FALSE(selection.choose(viewers, 1.0, leaves / 4));
  EXPECT_TRUE(selection.chosen().size() == 0U);
  EXPECT_TRUE(selection.choose(viewers, 1.0, leaves + 3));
  EXPECT_EQ(selection.chosen().leaves(), leaves);
}

TEST(Selection, ListsTheMostUrgentFirstAndNothingBeforeWhatIsAboveIt) {
  Selection selection(roughGround());
  selection.choose(std::vector{viewerAt(0.0, 0.0, 100.0), viewerAt(9000.0, 0.0, 100.0)}, 1.0);
  std::set<Name> before;
  double urgency = INFINITY;
  for (const Cut::Node& node : nodesOf(selection)) {
    ASSERT_LE(node.urgency, urgency);
    urgency = node.urgency;
    const NodeKey above = node.key.parent();
    ASSERT_TRUE(isRoot(node) || before.contains({above.level, above.j, above.i}));
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
  EXPECT_TRUE(isIn(both, nodeAt(other.position, both.chosen().rootLevel())));
  EXPECT_FALSE(isIn(both, nodeAt(*Position::fromMetres(25'000.0, 0.0, 64.0), both.chosen().rootLevel())));
}

TEST(Selection, HalfTheErrorTakesTwoToSixTimesTheNodes) {
  Selection fine(roughGround()), coarse(roughGround());
  fine.choose(std::vector{viewerAt(0.0, 0.0, 100.0, 1.0, 20'000.0)}, 1.0);
  coarse.choose(std::vector{viewerAt(0.0, 0.0, 100.0, 2.0, 20'000.0)}, 1.0);
  const double ratio =
      static_cast<double>(fine.chosen().leaves()) / static_cast<double>(coarse.chosen().leaves());
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
    EXPECT_GE(moved.chosen().leaves(), fresh.chosen().leaves());
  }
  EXPECT_GE(kept, 5);
  selection.choose(std::vector{viewerAt(1e6, 0.0, 100.0)}, 1.0);
  selection.keep();
  EXPECT_EQ(nodesAt(selection, 0.0), there);  // what was left long ago is forgotten
}

bool isSame(const Cut::Node& a, const Cut::Node& b) {
  return a.key == b.key && a.isLeaf() == b.isLeaf() && a.urgency == b.urgency;
}

TEST(Selection, IsTheSameInWhateverSlices) {
  Selection whole(roughGround()), sliced(roughGround());
  for (int step = 0; step < 20; ++step) {
    const Viewer viewer = viewerAt(200.0 * step, 0.0, 100.0);
    whole.choose({&viewer, 1}, 1.0);
    sliced.begin({&viewer, 1}, 1.0);
    int slices = 1;
    while (!sliced.step(Slice::until(Slice::Clock::now()))) ++slices;
    ASSERT_GT(slices, 10);
    const std::vector<Cut::Node> ofA = nodesOf(whole), ofB = nodesOf(sliced);
    ASSERT_TRUE(std::equal(ofA.begin(), ofA.end(), ofB.begin(), ofB.end(), isSame));
    whole.keep();
    sliced.keep();
  }
}

TEST(Selection, TakesARowOfRootsOrAFewNodesBetweenTwoLooksAtTheClock) {
  Selection::Ground ground = roughGround();
  ground.coarsest = 3;
  Selection selection(ground);
  const Viewer viewer = viewerAt(0.0, 0.0, 100.0, 64.0, 20'000.0);
  selection.begin({&viewer, 1}, 1.0);
  std::size_t slices = 1;
  while (!selection.step(Slice::until(Slice::Clock::time_point::min()))) ++slices;
  const std::size_t nodes = selection.chosen().size();
  EXPECT_GT(nodes, 4000U);
  // 89 rows; split and weighed 32 at a time; in order in five passes of 256.
  EXPECT_GE(slices, 89U + 2U * nodes / 32U + 5U * nodes / 256U);
}

TEST(Selection, SplitsANodeEarlierThatIsKnownToBeRougherThanItsLevel) {
  Selection selection(roughGround());
  const std::vector<Viewer> viewers{viewerAt(0.0, 0.0, 100.0)};
  selection.choose(viewers, 1.0);
  const std::vector<NodeKey> leaves = leavesOf(selection);
  const auto coarse =
      std::find_if(leaves.begin(), leaves.end(), [](const NodeKey& leaf) { return leaf.level == 4; });
  ASSERT_NE(coarse, leaves.end());
  const NodeKey rough = *coarse;
  const double seen = selection.seen(rough), error = selection.errors()[4];
  ASSERT_LE(seen, 1.0);
  selection.setError(rough, {error / seen * 1.001, 0.0});
  selection.choose(viewers, 1.0);
  EXPECT_FALSE(selection.chosen()[selection.chosen().find(rough)].isLeaf());
  selection.setError(rough, {error, 1e6});
  selection.choose(viewers, 1.0);
  EXPECT_FALSE(selection.chosen()[selection.chosen().find(rough)].isLeaf()) << "its seams are beside the eye";
  selection.forgetError(rough);
  selection.choose(viewers, 1.0);
  EXPECT_EQ(namesOf(leavesOf(selection)), namesOf(leaves));
}

TEST(Selection, SeesGroundAboveAllThatWasKnownAsNear) {
  Selection selection(roughGround());
  const std::vector<Viewer> over{viewerAt(0.0, 0.0, 1000.0)};
  selection.choose(over, 1.0);
  const std::size_t before = selection.chosen().leaves();
  selection.setHeights(-100.0, 950.0);
  selection.choose(over, 1.0);
  EXPECT_GT(selection.chosen().leaves(), before);
  for (const NodeKey& leaf : leavesOf(selection)) ASSERT_TRUE(leaf.level == 0 || selection.seen(leaf) <= 1.0);
}

TEST(Selection, KeepsWhatWasKeptUntilTheNextIs) {
  Selection selection(roughGround());
  selection.choose(std::vector{viewerAt(0.0, 0.0, 100.0)}, 1.0);
  selection.keep();
  const std::size_t kept = selection.kept().size();
  selection.choose(std::vector{viewerAt(0.0, 0.0, 100.0, 0.5)}, 1.0);
  EXPECT_EQ(selection.kept().size(), kept);
  EXPECT_GT(selection.chosen().size(), kept);
}

TEST(Selection, KeepsRootsALittleLongerThanItWouldTakeThem) {
  const auto roots = [](const Selection& selection) {
    std::size_t count = 0;
    for (const Cut::Node& node : nodesOf(selection)) count += isRoot(node) ? 1U : 0U;
    return count;
  };
  Selection selection(roughGround()), fresh(roughGround());
  selection.choose(std::vector{viewerAt(0.0, 0.0, 100.0)}, 1.0);
  selection.keep();
  const std::size_t before = roots(selection);
  selection.choose(std::vector{viewerAt(900.0, 0.0, 100.0)}, 1.0);
  selection.keep();
  const std::size_t both = roots(selection);
  EXPECT_GT(both, before);  // what came is there, and so is what was
  selection.choose(std::vector{viewerAt(0.0, 0.0, 100.0)}, 1.0);
  EXPECT_EQ(roots(selection), both);
  fresh.choose(std::vector{viewerAt(0.0, 0.0, 100.0)}, 1.0);
  EXPECT_EQ(roots(fresh), before);
  selection.keep();
  selection.choose(std::vector{viewerAt(1e6, 0.0, 100.0)}, 1.0);
  EXPECT_LE(roots(selection), 2 * before);
}

TEST(Selection, WantsWhatAViewerWillSeeSoonLikeWhatItSees) {
  Selection resting(roughGround()), flying(roughGround()), there(roughGround());
  Viewer viewer = viewerAt(0.0, 0.0, 100.0);
  resting.choose({&viewer, 1}, 1.0);
  viewer.east = 600.0;
  flying.choose({&viewer, 1}, 1.0);
  const Viewer later = viewerAt(600.0, 0.0, 100.0);
  there.choose({&later, 1}, 1.0);
  for (const NodeKey& leaf : leavesOf(flying)) {
    ASSERT_TRUE(leaf.level == 0 || resting.seen(leaf) <= 1.0);
    ASSERT_TRUE(leaf.level == 0 || there.seen(leaf) <= 1.0);
  }
  EXPECT_GT(flying.chosen().leaves(), resting.chosen().leaves());
  EXPECT_LT(flying.chosen().leaves(), 2 * resting.chosen().leaves());
}

TEST(Selection, ForgetsWhatIsSplitWhenMoreIsKnownOfErrors) {
  Selection selection(roughGround()), fresh(roughGround());
  const std::vector<Viewer> here{viewerAt(0.0, 0.0, 100.0)}, near{viewerAt(100.0, 0.0, 100.0)};
  selection.choose(near, 1.0);
  selection.keep();
  const std::vector<double> errors(selection.errors().begin(), selection.errors().end());
  selection.setErrors(errors);
  selection.choose(here, 1.0);
  fresh.choose(here, 1.0);
  EXPECT_EQ(namesOf(leavesOf(selection)), namesOf(leavesOf(fresh)));
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
    const std::vector<Cut::Node> ofA = nodesOf(a), ofB = nodesOf(b);
    ASSERT_TRUE(std::equal(ofA.begin(), ofA.end(), ofB.begin(), ofB.end(), isSame));
  }
}

TEST(Selection, EndsWithTheWorld) {
  Selection selection(roughGround());
  const Viewer viewer{{kMaxPatch - 1, -kMaxPatch, 0.5, 0.5}, 100.0, {.distance = 5000.0}};
  selection.choose(std::vector{viewer}, 1.0);
  for (const Cut::Node& node : nodesOf(selection)) {
    EXPECT_LT(node.key.i << node.key.level, kMaxPatch);
    EXPECT_GE(node.key.j << node.key.level, -kMaxPatch);
  }
}

}  // namespace
}  // namespace teren
