#include "stream/Refinement.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "stream/JoinTask.h"
#include "stream/Selection.h"
#include "tests/engine/stream/PatchGround.h"

namespace teren {
namespace {

constexpr int kIntervals = 2;

Selection::Ground ground() {
  Selection::Ground ground{64.0, 0.0, 0.0, {0.0}};
  for (int level = 1; level <= 6; ++level) ground.errors.push_back(0.5 * std::exp2(level));
  return ground;
}

/// A drawn set on its way to what a viewer wants, its heights arriving in random order. As in a Streamer, one
/// change at a time is on its way to the drawn set, and the viewer looks elsewhere, heights arrive and others
/// are dropped meanwhile.
class Way {
 public:
  explicit Way(std::uint64_t seed) : dice_(seed) {}

  void lookFrom(double east, double north) {
    const Viewer viewer{
        *Position::fromMetres(east, north, 64.0), 20.0, {.pixelError = 4.0, .distance = 1500.0}};
    selection_.choose({&viewer, 1}, 1.0);
    refinement_.turnTo(selection_.chosen());
    while (
        !refinement_.turnStep(Slice::until(Slice::Clock::now()))) {  // what happens meanwhile is not missed
      arrive();
      step();
    }
    selection_.keep();
    dropUnwanted();
  }
  /// One node comes, and whatever is possible is done; false once everything is there and drawn.
  bool goOn(bool arrives = true) {
    const bool arrived = arrives && arrive();
    bool changed = false;
    while (joining_ || refinement_.mayChange()) {
      changed = step() || changed;
      if (joining_ && dice_.whole(0, 3) == 0) break;
    }
    dropUnwanted();
    EXPECT_EQ(refinement_.missing(), missing());
    return changed || arrived;
  }
  /// Changes that were ready, and what they were made from was there no more.
  int refused() const { return refused_; }

  template <class Choice>
  void arriveAll(const Choice& isChosen) {
    for (const Cut::Index index : cut().byUrgency()) {
      const NodeKey key = cut()[index].key;
      if (isChosen(key) && !store_.heights(key)) arrive(key);
    }
  }

  const Cut& cut() const { return selection_.kept(); }
  Refinement& refinement() { return refinement_; }
  const NodeStore& store() const { return store_; }
  std::vector<NodeKey> drawn() const {
    std::vector<NodeKey> keys;
    store_.forEachDrawn([&](const NodeKey& key) { keys.push_back(key); });
    return keys;
  }

 private:
  std::size_t missing() const {
    std::size_t count = 0;
    for (const Cut::Index index : cut().byUrgency()) {
      const Cut::Node& node = cut()[index];
      const bool isThere =
          node.isLeaf() ? store_.isDrawn(node.key) : static_cast<bool>(store_.heights(node.key));
      count += isThere ? 0U : 1U;
    }
    return count;
  }
  bool arrive() {
    const Cut& cut = selection_.kept();
    std::vector<NodeKey> absent;
    for (const Cut::Index index : cut.byUrgency()) {
      if (!store_.heights(cut[index].key)) absent.push_back(cut[index].key);
    }
    if (absent.empty()) return false;
    const auto which = static_cast<std::size_t>(dice_.whole(0, static_cast<int>(absent.size()) - 1));
    arrive(absent[which]);
    return true;
  }
  void arrive(const NodeKey& key) {
    store_.insert(key, std::make_shared<const HeightMap>(kIntervals + 1, kIntervals + 1));
    refinement_.noteHeld(key);
  }
  bool step() {
    if (joining_) {
      draw(*std::exchange(joining_, nullptr));
      return true;
    }
    const DrawnChange change = refinement_.next(static_cast<std::size_t>(dice_.whole(1, 3)));
    if (change.add.empty() && change.remove.empty()) return false;
    if (dice_.whole(0, 9) == 0) {
      refinement_.again(change);
      return true;
    }
    joining_ = std::make_unique<JoinTask>(store_, change);
    return true;
  }
  void dropUnwanted() {
    while (const std::optional<NodeKey> key = refinement_.takeUnwanted()) {
      if (!store_.isDrawn(*key) && !refinement_.isWanted(*key)) store_.erase(*key);
    }
  }
  /// The ground that was drawn and is still within the roots must be drawn afterwards, and none twice.
  void draw(JoinTask& task) {
    const std::vector<NodeKey> before = drawn();
    while (!task.step(Slice::unlimited())) {
    }
    if (!store_.apply(task.change(), task.pieces())) {
      const auto isGone = [&](const NodeKey& key) { return !store_.heights(key); };
      ASSERT_TRUE(std::any_of(task.change().add.begin(), task.change().add.end(), isGone));
      refinement_.again(task.change());
      ++refused_;
      return;
    }
    refinement_.noteChange(task.change());
    const std::vector<NodeKey> after = drawn();
    for (const NodeKey& key : after) {
      ASSERT_EQ(store_.drawnIn(key).size(), 1U);
      if (key.level < 12) {
        const auto over = store_.drawnOver(key.parent());
        ASSERT_FALSE(over.has_value());
      }
    }
    for (const NodeKey& key : before) {
      if (selection_.kept().nearest(key) == Cut::kNone) continue;
      double area = 0.0;
      for (const NodeKey& part : store_.drawnIn(key)) area += std::exp2(2 * part.level);
      ASSERT_TRUE(store_.drawnOver(key) || area == std::exp2(2 * key.level)) << "a hole";
    }
  }

  Dice dice_;
  Selection selection_{ground()};
  NodeStore store_{1.0, kIntervals};
  Refinement refinement_{store_};
  std::unique_ptr<JoinTask> joining_;
  int refused_ = 0;
};

bool isReached(const Way& way) {
  std::size_t drawn = 0;
  way.store().forEachDrawn([&](const NodeKey& key) {
    const Cut::Index index = way.cut().find(key);
    drawn += index != Cut::kNone && way.cut()[index].isLeaf() ? 1U : 0U;
  });
  return drawn == way.cut().leaves() && way.store().drawnCount() == drawn &&
         way.store().nodes().size() == way.cut().size();  // all that is held is wanted
}

TEST(Refinement, ReachesTheCutWhateverComesFirstWithoutAHoleOnTheWay) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(seed);
    Way way(seed);
    way.lookFrom(100.0, 100.0);
    while (way.goOn() && !testing::Test::HasFatalFailure()) {
    }
    ASSERT_TRUE(isReached(way));
    ASSERT_GT(way.cut().leaves(), 100U);
  }
}

TEST(Refinement, ThinksAgainOfNodesThatHadToWaitForACoarserOneBesideThem) {
  Way first(1);
  first.lookFrom(100.0, 100.0);
  int tried = 0;
  for (const Cut::Index index : first.cut().byUrgency()) {
    if (first.cut()[index].isLeaf() || ++tried % 5 != 0) continue;
    Way way(1);
    way.lookFrom(100.0, 100.0);
    const NodeKey late = first.cut()[index].key;
    way.arriveAll([&](const NodeKey& key) { return key == late || !isIn(key, late); });
    while (way.goOn(false)) {
    }
    way.arriveAll([](const NodeKey&) { return true; });
    while (way.goOn(false)) {
    }
    ASSERT_TRUE(isReached(way));
  }
  EXPECT_GT(tried, 20);
}

TEST(Refinement, FollowsAViewerWhoNeverWaitsForIt) {
  Dice dice(11);
  Way way(7);
  double east = 0.0, north = 0.0;
  for (int step = 0; step < 150; ++step) {
    const bool leaps = step % 50 == 49;
    east += leaps ? 1200.0 : dice.between(0.0, 60.0);
    north += dice.between(-40.0, 40.0);
    way.lookFrom(east, north);
    for (int k = 0; k < 8; ++k) way.goOn();
    ASSERT_FALSE(testing::Test::HasFatalFailure());
  }
  while (way.goOn() && !testing::Test::HasFatalFailure()) {
  }
  EXPECT_TRUE(isReached(way));
}

TEST(Refinement, ThinksAgainOfChangesWhoseNodesWereDroppedWhileTheyWereMade) {
  Dice dice(12);
  Way way(9);
  for (int step = 0; step < 200;
       ++step) {  // to and fro, so that what is on its way is unwanted again and again
    way.lookFrom(dice.between(0.0, 2500.0), dice.between(0.0, 2500.0));
    for (int k = 0; k < 30; ++k) way.goOn();
    ASSERT_FALSE(testing::Test::HasFatalFailure());
  }
  while (way.goOn() && !testing::Test::HasFatalFailure()) {
  }
  EXPECT_TRUE(isReached(way));
  EXPECT_GT(way.refused(), 0);
}

TEST(Refinement, TakesNoMoreRoomForChangesRefusedAgainAndAgain) {
  Way way(5);
  way.lookFrom(0.0, 0.0);
  while (way.goOn()) {
  }
  way.lookFrom(20'000.0, 0.0);  // all that is drawn has to leave
  const DrawnChange first = way.refinement().next(1);
  ASSERT_FALSE(first.remove.empty());
  way.refinement().again(first);
  const std::size_t bytes = way.refinement().bytes();
  for (int refusal = 0; refusal < 1000; ++refusal) {
    const DrawnChange change = way.refinement().next(1);
    ASSERT_EQ(change.remove, first.remove);
    way.refinement().again(change);
  }
  EXPECT_EQ(way.refinement().bytes(), bytes);
}

TEST(Refinement, OfACutThatIsDrawnIsNothing) {
  Way way(3);
  way.lookFrom(0.0, 0.0);
  while (way.goOn()) {
  }
  const DrawnChange none = way.refinement().next(4);
  EXPECT_TRUE(none.add.empty() && none.remove.empty());
}

}  // namespace
}  // namespace teren
