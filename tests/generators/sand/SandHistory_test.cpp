#include "generators/sand/SandHistory.h"

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "generators/sand/SandArchive.h"
#include "tests/generators/sand/RandomGame.h"

namespace teren {
namespace {

using Bytes = std::vector<std::byte>;
constexpr std::size_t kAmple = std::size_t{1} << 30;

/// Several drags and what follows.
void act(RandomGame& game, int operations) {
  static const std::vector<ToolShape> tools = toolbox();
  for (int n = 0; n < operations; ++n) game.play(tools);
}

TEST(SandHistory, GoesBackAndForthThroughEveryActionToTheLastBit) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    RandomGame game(seed);
    SandHistory history(kAmple);
    std::vector<Bytes> states;
    for (int action = 0; action < 12; ++action) {
      history.note(game.sandbox());
      states.push_back(archived(game.sandbox()));
      act(game, 8);
    }
    states.push_back(archived(game.sandbox()));
    // Empty actions are none.
    states.erase(std::unique(states.begin(), states.end()), states.end());
    for (int turn = 0; turn < 2; ++turn) {
      for (std::size_t n = states.size() - 1; n-- > 0;) {
        ASSERT_TRUE(history.undo(game.sandbox())) << n;
        ASSERT_EQ(archived(game.sandbox()), states[n]) << "back to " << n << ", seed " << seed;
      }
      ASSERT_FALSE(history.undo(game.sandbox()));
      ASSERT_EQ(archived(game.sandbox()), states.front());
      for (std::size_t n = 1; n < states.size(); ++n) {
        ASSERT_TRUE(history.redo(game.sandbox())) << n;
        ASSERT_EQ(archived(game.sandbox()), states[n]) << "forth to " << n << ", seed " << seed;
      }
      ASSERT_FALSE(history.redo(game.sandbox()));
      ASSERT_EQ(archived(game.sandbox()), states.back());
    }
    EXPECT_EQ(game.fault(), "");
  }
}

TEST(SandHistory, GoesOnAfterAnUndoAsItDidThen) {
  for (std::uint64_t seed = 11; seed <= 16; ++seed) {
    RandomGame game(seed);
    SandHistory history(kAmple);
    act(game, 20);
    history.note(game.sandbox());
    const RandomGame then = game;
    act(game, 15);
    RandomGame again = then;
    again.sandbox() = game.sandbox();
    ASSERT_TRUE(history.undo(again.sandbox()));
    RandomGame original = then;
    for (int n = 0; n < 40; ++n) {
      act(original, 1);
      act(again, 1);
      ASSERT_EQ(archived(again.sandbox()), archived(original.sandbox())) << n << ", seed " << seed;
    }
  }
}

/// A sandbox of level ground in which tools are pressed one after the other.
class Drags {
 public:
  explicit Drags(int vertices)
      : sandbox_(scatteredSand(vertices, 71, 5.0, [](double, double) { return 0.0; }), {}) {}

  Sandbox& sandbox() { return sandbox_; }
  Bytes bytes() const { return archived(sandbox_); }
  void stamp(double x, double y) { ASSERT_TRUE(sandbox_.stamp(*ToolShape::disc(0.05, 0.05), {x, y})); }

 private:
  Sandbox sandbox_;
};

TEST(SandHistory, ForgetsSlidesThatGoOnAfterAnUndoUntilSomethingIsDone) {
  Drags sand(400);
  SandHistory history(kAmple);
  history.note(sand.sandbox());
  sand.stamp(0.3, 0.3);
  sand.sandbox().slide(200);
  history.note(sand.sandbox());
  const Bytes second = sand.bytes();
  sand.stamp(0.7, 0.7);
  const Bytes third = sand.bytes();
  ASSERT_TRUE(history.undo(sand.sandbox()));
  ASSERT_EQ(sand.bytes(), second);
  sand.sandbox().slide(300);  // of the first action, by itself
  const Bytes slid = sand.bytes();
  ASSERT_NE(slid, second);
  ASSERT_TRUE(history.redo(sand.sandbox()));
  EXPECT_EQ(sand.bytes(), third);
  ASSERT_TRUE(history.undo(sand.sandbox()));
  sand.sandbox().slide(300);
  ASSERT_EQ(sand.bytes(), slid);
  history.note(sand.sandbox());
  EXPECT_FALSE(history.redo(sand.sandbox())) << "another future has begun";
  sand.stamp(0.5, 0.2);
  const Bytes other = sand.bytes();
  ASSERT_TRUE(history.undo(sand.sandbox()));
  EXPECT_EQ(sand.bytes(), slid) << "where the last action began";
  ASSERT_TRUE(history.undo(sand.sandbox())) << "one action, not the slides alone";
  EXPECT_EQ(sand.sandbox().slides().count().steps, 0U);
  EXPECT_FALSE(history.undo(sand.sandbox()));
  ASSERT_TRUE(history.redo(sand.sandbox()));
  EXPECT_EQ(sand.bytes(), slid);
  ASSERT_TRUE(history.redo(sand.sandbox()));
  EXPECT_EQ(sand.bytes(), other);
}

TEST(SandHistory, HasNothingToUndoBeforeANoteOrWhereNothingChanged) {
  Drags sand(100);
  SandHistory history(kAmple);
  EXPECT_FALSE(history.undo(sand.sandbox()));
  EXPECT_FALSE(history.redo(sand.sandbox()));
  history.note(sand.sandbox());
  history.note(sand.sandbox());
  EXPECT_EQ(history.actions(), 0U);
  EXPECT_FALSE(history.undo(sand.sandbox()));
  sand.stamp(0.4, 0.4);
  history.note(sand.sandbox());
  EXPECT_EQ(history.actions(), 1U);
}

TEST(SandHistory, DropsTheOldestActionsBeyondItsBytes) {
  Drags measured(3'000);
  SandHistory ample(kAmple);
  const auto play = [](Drags& sand, SandHistory& history) {
    std::vector<Bytes> states;
    for (int n = 0; n < 12; ++n) {
      history.note(sand.sandbox());
      states.push_back(sand.bytes());
      sand.stamp(0.1 + 0.07 * n, 0.5);
      sand.sandbox().iterate(2'000);
    }
    history.note(sand.sandbox());
    return states;
  };
  play(measured, ample);
  const std::size_t image = measured.bytes().size();
  const std::size_t each = (ample.bytes() - image) / 12;
  EXPECT_LT(each, image / 3) << "an action holds what it touched";
  EXPECT_EQ(ample.actions(), 12U);

  Drags sand(3'000);
  SandHistory history(5 * each);
  const std::vector<Bytes> states = play(sand, history);
  EXPECT_LE(history.bytes(), 5 * each + 2 * image);
  EXPECT_GE(history.actions(), 3U);
  EXPECT_LE(history.actions(), 7U);
  std::size_t undone = 0;  // what is undone may take more bytes, so that an older action goes
  for (; history.undo(sand.sandbox()); ++undone) ASSERT_EQ(sand.bytes(), states[states.size() - 1 - undone]);
  EXPECT_GE(undone, 3U);

  Drags none(3'000);
  SandHistory tiny(100);
  play(none, tiny);
  EXPECT_EQ(tiny.actions(), 0U);
  const Bytes before = none.bytes();
  EXPECT_FALSE(tiny.undo(none.sandbox()));
  EXPECT_EQ(none.bytes(), before);
}

/// Whoever follows the lists of what changed has the right copy after undo and redo, and looked at less than
/// everything.
TEST(SandHistory, TellsWhoeverDrawsWhatAnUndoChanged) {
  Drags sand(5'000);
  std::map<VertexId, std::int64_t> heights;
  std::map<TriangleId, std::array<VertexId, 3>> triangles;
  const auto lookAtVertex = [&](VertexId v) {
    heights.erase(v);
    if (sand.sandbox().surface().mesh().isVertex(v)) heights[v] = sand.sandbox().surface().height(v);
  };
  const auto lookAtTriangle = [&](TriangleId t) {
    triangles.erase(t);
    if (sand.sandbox().surface().mesh().isTriangle(t))
      triangles[t] = sand.sandbox().surface().mesh().corners(t);
  };
  const auto lookAtAll = [&] {
    heights.clear();
    triangles.clear();
    const Triangulation& mesh = sand.sandbox().surface().mesh();
    for (VertexId v = 0; v < mesh.vertexSlots(); ++v) lookAtVertex(v);
    for (TriangleId t = 0; t < mesh.triangleSlots(); ++t) lookAtTriangle(t);
  };
  const auto follow = [&] {
    for (const VertexId v : sand.sandbox().changedVertices().ids()) lookAtVertex(v);
    for (const TriangleId t : sand.sandbox().changedTriangles().ids()) lookAtTriangle(t);
    EXPECT_LT(sand.sandbox().changedVertices().ids().size(), 2'500U);
    EXPECT_GT(sand.sandbox().changedVertices().ids().size(), 50U);
    sand.sandbox().forgetChanges();
    const auto followed = heights;
    const auto followedTriangles = triangles;
    lookAtAll();
    EXPECT_EQ(followed, heights);
    EXPECT_EQ(followedTriangles, triangles);
  };
  lookAtAll();
  SandHistory history(kAmple);
  history.note(sand.sandbox());
  for (const double x : {0.2, 0.25, 0.3}) {
    sand.stamp(x, 0.5);
    sand.sandbox().iterate(1'000);
  }
  follow();
  const VertexId slots = sand.sandbox().surface().mesh().vertexSlots();
  ASSERT_TRUE(history.undo(sand.sandbox()));
  ASSERT_LT(sand.sandbox().surface().mesh().vertexSlots(), slots) << "slots that are no more are told too";
  follow();
  ASSERT_TRUE(history.redo(sand.sandbox()));
  follow();
}

}  // namespace
}  // namespace teren
