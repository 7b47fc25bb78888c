#include "apps/sandbox/SandSession.h"

#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "apps/sandbox/SandTool.h"
#include "generators/sand/Slides.h"

namespace teren {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

SandGround ground(double roughness = 0.0) {
  SandGround ground;
  ground.vertices = 1'000;
  ground.roughness = roughness;
  return ground;
}

Values toolOf(std::vector<Values::Entry> entries) {
  return Values::check(SandTool::parameters(), entries, "tool").value();
}

void rest(SandSession& session) {
  while (!session.idle()) session.work([] { return false; });
}

void drag(SandSession& session, const ToolPlace& from, const ToolPlace& to) {
  ASSERT_TRUE(session.press(from));
  ASSERT_TRUE(session.dragTo(to, 0.5));
  session.release();
}

std::uint64_t hashOf(const SandSession& session) {
  return hashOf(session.sandbox().surface());
}

/// Works until a beat has this number, or into the midst of the one before it.
void workTo(SandSession& session, std::uint64_t beat, bool intoIt) {
  const auto there = [&] {
    const std::uint64_t now = session.figures().beat;
    return intoIt ? now + 1 == beat && session.withinBeat() : now == beat && !session.withinBeat();
  };
  while (!there()) session.work([] { return true; });
}

TEST(SandSession, ComputesTheSameHoweverItsWorkIsSliced) {
  const auto played = [](int slices) {
    SandSession session(ground(0.2));
    drag(session, {0.2, 0.3, {}}, {0.7, 0.6, {}});
    for (int n = 0; !session.idle(); ++n) {
      session.work([&, count = 0]() mutable { return slices > 0 && ++count % slices == 0; });
    }
    return hashOf(session);
  };
  const std::uint64_t whole = played(0);
  EXPECT_EQ(played(1), whole);
  EXPECT_EQ(played(3), whole);
  EXPECT_EQ(played(7), whole);
}

TEST(SandSession, TakesWhatComesWithinABeatAtItsEnd) {
  const auto played = [](bool intoIt) {
    SandSession session(ground(0.3));
    drag(session, {0.3, 0.3, {}}, {0.5, 0.5, {}});
    workTo(session, 3, intoIt);
    session.setRepose(20.0, 0.0);
    workTo(session, 5, intoIt);
    session.finishBeat();
    const std::uint64_t beforeUndo = hashOf(session);
    EXPECT_TRUE(session.undo());
    workTo(session, 6, intoIt);
    session.setSlides(false);
    drag(session, {0.3, 0.6, {}}, {0.5, 0.4, {}});
    rest(session);
    return std::pair(beforeUndo, hashOf(session));
  };
  EXPECT_EQ(played(true), played(false));
}

TEST(SandSession, DigsAGrooveAlongADragAndHeapsSandBesideIt) {
  SandSession session(ground());
  session.setSlides(false);
  drag(session, {0.2, 0.5, {}}, {0.8, 0.5, {}});
  rest(session);
  for (double x = 0.2; x <= 0.8; x += 0.05) EXPECT_NEAR(session.groundHeight(x, 0.5), -0.03, 1e-6) << x;
  EXPECT_GT(session.groundHeight(0.5, 0.545), 0.001);
  EXPECT_EQ(session.groundHeight(0.5, 0.9), 0.0);
}

TEST(SandSession, HoldsTheToolAtTheHeightOfTheGroundWhereItWasPressedIn) {
  SandSession session(ground(0.4));
  session.setSlides(false);
  const double start = session.groundHeight(0.3, 0.3);
  drag(session, {0.3, 0.3, {}}, {0.7, 0.4, {}});
  rest(session);
  EXPECT_NEAR(session.groundHeight(0.3, 0.3), start - 0.03, 1e-6);
  EXPECT_LE(session.groundHeight(0.7, 0.4), start - 0.03 + 1e-6);
}

TEST(SandSession, TakesAHeightAtEveryPlaceOfADrag) {
  SandSession session(ground());
  session.setSlides(false);
  drag(session, {0.3, 0.5, 0.0}, {0.7, 0.5, -0.1});
  rest(session);
  EXPECT_NEAR(session.groundHeight(0.3, 0.5), -0.03, 0.01);
  EXPECT_NEAR(session.groundHeight(0.7, 0.5), -0.13, 1e-6);
}

TEST(SandSession, LetsSandSlideUntilNoneIsSteeperThanItCanLie) {
  SandSession session(ground());
  ASSERT_TRUE(session.setTool(toolOf({{"depth", 0.08}})));
  session.setSlides(false);
  drag(session, {0.3, 0.5, {}}, {0.7, 0.5, {}});
  rest(session);
  const double mostAtRest = reposeOf(30.0 + kReposeTolerance).start;
  EXPECT_GT(steepestLooseSlope(session.sandbox().surface()), 2.0 * mostAtRest);
  session.setSlides(true);
  EXPECT_FALSE(session.idle());
  rest(session);
  EXPECT_LE(steepestLooseSlope(session.sandbox().surface()), mostAtRest);
}

TEST(SandSession, UndoesAndRedoesWholeActionsToTheSameSurface) {
  SandSession session(ground());
  EXPECT_FALSE(session.undo());
  std::vector<std::uint64_t> hashes = {hashOf(session)};
  for (const double y : {0.3, 0.5, 0.7}) {
    drag(session, {0.2, y, {}}, {0.8, y, {}});
    rest(session);
    hashes.push_back(hashOf(session));
  }
  for (const std::size_t n : {2U, 1U, 0U}) {
    EXPECT_TRUE(session.undo());
    rest(session);
    EXPECT_EQ(hashOf(session), hashes[n]);
  }
  EXPECT_FALSE(session.undo());
  for (const std::size_t n : {1U, 2U, 3U}) {
    EXPECT_TRUE(session.redo());
    rest(session);
    EXPECT_EQ(hashOf(session), hashes[n]);
  }
  EXPECT_FALSE(session.redo());
  EXPECT_TRUE(session.sandbox().surface().validate());
}

TEST(SandSession, UndoTakesBackAnActionThatIsStillGoingOn) {
  SandSession session(ground());
  const std::uint64_t before = hashOf(session);
  drag(session, {0.2, 0.5, {}}, {0.8, 0.5, {}});
  workTo(session, 4, true);
  EXPECT_TRUE(session.undo());
  EXPECT_TRUE(session.idle());
  EXPECT_EQ(hashOf(session), before);
}

TEST(SandSession, UndoTakesBackFirstWhatOnlyWaits) {
  const auto played = [](bool withSecond) {
    SandSession session(ground());
    drag(session, {0.2, 0.5, {}}, {0.8, 0.5, {}});
    workTo(session, 2, false);
    if (withSecond) {
      drag(session, {0.2, 0.2, {}}, {0.8, 0.2, {}});
      EXPECT_TRUE(session.undo());
    }
    rest(session);
    return hashOf(session);
  };
  EXPECT_EQ(played(true), played(false));
}

TEST(SandSession, ChangesOfTheAngleInARowAreOneAction) {
  SandSession session(ground(0.5));
  rest(session);
  const std::uint64_t before = hashOf(session);
  for (const double angle : {25.0, 20.0, 15.0}) session.setRepose(angle, 0.1);
  rest(session);
  EXPECT_NE(hashOf(session), before);
  EXPECT_TRUE(session.undo());
  EXPECT_EQ(hashOf(session), before);
  EXPECT_EQ(session.repose(), 30.0);
  EXPECT_EQ(session.moisture(), 0.0);
  EXPECT_FALSE(session.undo());
}

TEST(SandSession, AChangeOfTheAngleDuringADragIsPartOfIt) {
  SandSession session(ground());
  const std::uint64_t before = hashOf(session);
  ASSERT_TRUE(session.press({0.2, 0.5, {}}));
  ASSERT_TRUE(session.dragTo({0.4, 0.5, {}}, 0.5));
  rest(session);
  session.setRepose(20.0, 0.0);
  ASSERT_TRUE(session.dragTo({0.6, 0.5, {}}, 0.5));
  workTo(session, session.figures().beat + 1, true);
  session.setRepose(25.0, 0.0);
  session.release();
  rest(session);
  const std::uint64_t after = hashOf(session);
  session.setRepose(10.0, 0.0);
  rest(session);
  EXPECT_TRUE(session.undo());
  EXPECT_EQ(hashOf(session), after) << "a change after the drag is an action of its own";
  EXPECT_TRUE(session.undo());
  EXPECT_EQ(hashOf(session), before);
  EXPECT_EQ(session.repose(), 30.0);
  EXPECT_FALSE(session.undo());
}

TEST(SandSession, AChangeOfTheAngleBeforeADragBeginsIsAnActionOfItsOwn) {
  SandSession session(ground());
  drag(session, {0.2, 0.5, {}}, {0.4, 0.5, {}});
  session.setRepose(20.0, 0.0);
  rest(session);
  EXPECT_TRUE(session.undo());
  EXPECT_EQ(session.repose(), 20.0);
  EXPECT_TRUE(session.undo());
  EXPECT_EQ(session.repose(), 30.0);
}

TEST(SandSession, RefusesPlacesBeyondTheSandOrThatAreNoNumbers) {
  SandSession session(ground());
  const std::uint64_t before = hashOf(session);
  for (const ToolPlace& place :
       {ToolPlace{-0.01, 0.5, {}}, ToolPlace{0.5, 1.01, {}}, ToolPlace{-1.0, 0.5, {}},
        ToolPlace{1e300, 0.5, {}}, ToolPlace{kNan, 0.5, {}}, ToolPlace{0.5, kNan, {}},
        ToolPlace{kInfinity, 0.5, {}}, ToolPlace{0.5, 0.5, kNan}, ToolPlace{0.5, 0.5, kInfinity},
        ToolPlace{0.5, 0.5, -1e5}}) {
    EXPECT_FALSE(session.press(place)) << place.x << " " << place.y;
  }
  ASSERT_TRUE(session.press({0.5, 0.5, {}}));
  EXPECT_FALSE(session.dragTo({1.5, 0.5, {}}, 0.1));
  EXPECT_TRUE(session.undo());
  ASSERT_TRUE(session.setTool(toolOf({{"size", 1.5}})));
  EXPECT_FALSE(session.press({0.5, 0.5, {}})) << "no room for it anywhere";
  rest(session);
  EXPECT_EQ(hashOf(session), before);
}

TEST(SandSession, RefusesDragsOfMoreStampsThanItWillKeep) {
  SandGround large = ground();
  large.side = 10.0;
  SandSession session(large);
  ASSERT_TRUE(session.setTool(toolOf({{"size", 0.01}, {"depth", 0.001}})));
  ASSERT_TRUE(session.press({1.0, 1.0, {}}));
  bool there = true;
  std::size_t most = 0;
  for (int n = 0; n < 500 && there; ++n) {
    const Result<void> dragged = session.dragTo({n % 2 == 0 ? 9.0 : 1.0, 1.0, {}}, 1000.0);
    there = static_cast<bool>(dragged);
    most = session.figures().waiting;
    if (!there) {
      EXPECT_NE(dragged.error().message.find("waiting"), std::string::npos);
    }
  }
  EXPECT_FALSE(there);
  EXPECT_LE(most, SandSession::kMostWaiting);
  EXPECT_GT(most, SandSession::kMostWaiting / 2);
}

TEST(SandSession, RefusesADragWhoseStampsWouldLieTooFarApart) {
  SandGround large = ground();
  large.side = 1000.0;
  SandSession session(large);
  ASSERT_TRUE(session.setTool(toolOf({{"size", 0.01}, {"depth", 0.001}})));
  ASSERT_TRUE(session.press({1.0, 1.0, {}}));
  const Result<void> dragged = session.dragTo({900.0, 1.0, {}}, 1000.0);
  ASSERT_FALSE(dragged);
  EXPECT_NE(dragged.error().message.find("65536"), std::string::npos) << dragged.error().message;
  EXPECT_EQ(session.figures().waiting, 1U);
  EXPECT_TRUE(session.dragTo({2.0, 1.0, {}}, 1000.0));
}

TEST(SandSession, DigsThroughTheBorder) {
  SandSession session(ground());
  const double before = session.groundHeight(1.0, 0.5);
  ASSERT_TRUE(session.press({0.7, 0.5, {}}));
  ASSERT_TRUE(session.dragTo({1.0, 0.5, {}}, 0.1));
  session.release();
  rest(session);
  EXPECT_LT(session.groundHeight(1.0, 0.5), before - 0.01);
  EXPECT_TRUE(session.takeMessages().empty());
  EXPECT_TRUE(session.sandbox().surface().validate());
}

TEST(SandSession, KeepsTheToolInTheHandWhereAnotherCannotBe) {
  SandSession session(ground());
  const Values before = session.toolValues();
  for (const std::vector<Values::Entry>& bad :
       {std::vector<Values::Entry>{{"tool", "ball"}, {"size", 0.1}, {"depth", 0.2}},
        {{"tool", "polygon"}, {"outline", ""}},
        {{"tool", "polygon"}, {"outline", "0,0 1,1"}},
        {{"tool", "polygon"}, {"outline", "0,0 1,1 1,0 0,1"}},
        {{"tool", "polygon"}, {"outline", "0,0 1,x 1,0"}},
        {{"tool", "polygon"}, {"outline", "nan,0 1,1 1,0"}}}) {
    const Result<void> taken = session.setTool(toolOf(bad));
    ASSERT_FALSE(taken);
    EXPECT_EQ(taken.error().message.find('\n'), std::string::npos);
    EXPECT_EQ(session.toolValues().choice("tool"), before.choice("tool"));
  }
}

TEST(SandSession, DigsWithEveryTool) {
  for (const std::string_view tool : SandTool::parameters().front().choices) {
    SandSession session(ground());
    ASSERT_TRUE(session.setTool(toolOf({{"tool", std::string(tool)}, {"size", 0.2}, {"depth", 0.04}})))
        << tool;
    drag(session, {0.4, 0.5, {}}, {0.5, 0.5, {}});
    rest(session);
    double lowest = 0.0, highest = 0.0;
    const Triangulation& mesh = session.sandbox().surface().mesh();
    for (VertexId v = 0; v < mesh.vertexSlots(); ++v) {
      if (!mesh.isVertex(v)) continue;
      lowest = std::min(lowest, mesh.height(v));
      highest = std::max(highest, mesh.height(v));
    }
    EXPECT_LT(lowest, -0.01) << tool;
    EXPECT_GT(highest, 0.001) << tool;
    EXPECT_TRUE(session.sandbox().surface().validate()) << tool;
    EXPECT_EQ(session.takeMessages().size(), 0U) << tool;
  }
}

TEST(SandSession, PutsSandThatComesInPlaceOfWhatIsThere) {
  SandSession session(ground());
  drag(session, {0.2, 0.5, {}}, {0.8, 0.5, {}});
  rest(session);
  SandGround other = ground(0.1);
  other.side = 3.0;
  session.bring([other]() -> Result<Sandbox> { return makeSand(other); });
  EXPECT_FALSE(session.idle());
  while (session.arriving()) session.work([] { return true; });
  EXPECT_EQ(session.sands(), 1U);
  EXPECT_NEAR(session.width(), 3.0, 1e-6);
  EXPECT_FALSE(session.undo());
  rest(session);
  SandSession same(other);
  rest(same);
  EXPECT_EQ(hashOf(session), hashOf(same));
}

TEST(SandSession, SaysWhySandDoesNotComeAndKeepsItsOwn) {
  SandSession session(ground());
  drag(session, {0.2, 0.5, {}}, {0.8, 0.5, {}});
  rest(session);
  const std::uint64_t before = hashOf(session);
  session.bring([]() -> Result<Sandbox> { return Error{"the file is no sand"}; });
  while (session.arriving()) session.work([] { return true; });
  EXPECT_EQ(session.takeMessages(), std::vector<std::string>{"the file is no sand"});
  EXPECT_EQ(session.takeMessages().size(), 0U);
  EXPECT_EQ(hashOf(session), before);
  EXPECT_TRUE(session.undo());
}

/// Makes sand when it is told to go on, or says that it was not told.
std::function<Result<Sandbox>()> whenTold(const std::atomic<bool>& told, const SandGround& made) {
  return [&told, made]() -> Result<Sandbox> {
    for (int n = 0; n < 500 && !told; ++n) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    if (!told) return Error{"not told"};
    return makeSand(made);
  };
}

TEST(SandSession, MakesSandThatIsAskedForWhileOtherSandComesAfterIt) {
  SandSession session(ground());
  SandGround last = ground();
  last.vertices = 300;
  std::atomic<bool> told = false;
  session.bring(whenTold(told, ground(0.1)));
  session.bring([]() -> Result<Sandbox> { return Error{"another one was asked for since"}; });
  session.bring([last]() -> Result<Sandbox> { return makeSand(last); });
  told = true;
  while (session.arriving()) session.work([] { return true; });
  EXPECT_EQ(session.takeMessages().size(), 0U);
  EXPECT_EQ(session.sands(), 2U);
  EXPECT_EQ(session.figures().vertices, 300U);
}

/// How far a published vertex may be from the surface's: heights are rounded to floats.
void expectPublished(SandSession& session) {
  const std::shared_ptr<const SandSnapshot> snapshot = session.publish();
  const Triangulation& mesh = session.sandbox().surface().mesh();
  ASSERT_EQ(snapshot->vertexCount(), mesh.vertexCount());
  ASSERT_EQ(snapshot->triangleCount(), mesh.triangleCount());
  for (VertexId v = 0; v < mesh.vertexSlots(); ++v) {
    ASSERT_EQ(snapshot->vertex(v).isThere(), mesh.isVertex(v));
    if (!mesh.isVertex(v)) continue;
    ASSERT_EQ(snapshot->vertex(v).place, mesh.point(v));
    ASSERT_EQ(snapshot->vertex(v).height, static_cast<float>(mesh.height(v)));
  }
  for (TriangleId t = 0; t < mesh.triangleSlots(); ++t) {
    ASSERT_EQ(snapshot->isTriangle(t), mesh.isTriangle(t));
    if (mesh.isTriangle(t)) {
      ASSERT_EQ(snapshot->corners(t), mesh.corners(t));
    }
  }
}

TEST(SandSession, PublishesWhatIsThereAfterEveryKindOfChange) {
  SandSession session(ground());
  expectPublished(session);
  drag(session, {0.2, 0.5, {}}, {0.8, 0.5, {}});
  workTo(session, 5, true);
  expectPublished(session);
  rest(session);
  expectPublished(session);
  ASSERT_TRUE(session.undo());
  expectPublished(session);
  ASSERT_TRUE(session.redo());
  expectPublished(session);
  session.bring([]() -> Result<Sandbox> { return makeSand(ground(0.3)); });
  ASSERT_TRUE(session.await());
  expectPublished(session);
}

TEST(SandGround, HasAsManyVerticesAsAskedFor) {
  for (const int vertices : {4, 5, 8, 9, 100, 1000, 30'000}) {
    SandGround some;
    some.vertices = vertices;
    const Sandbox sandbox = makeSand(some);
    EXPECT_LE(sandbox.surface().mesh().vertexCount(), static_cast<std::size_t>(vertices));
    EXPECT_GE(sandbox.surface().mesh().vertexCount(), static_cast<std::size_t>(vertices) * 99 / 100);
    EXPECT_TRUE(sandbox.surface().validate());
  }
}

TEST(SandGround, LiesEvenlyWithoutLongTriangles) {
  const Sandbox sandbox = makeSand(ground());
  const Triangulation& mesh = sandbox.surface().mesh();
  const double mean = 1.0 / std::sqrt(1'000.0);
  for (TriangleId t = 0; t < mesh.triangleSlots(); ++t) {
    if (!mesh.isTriangle(t)) continue;
    for (int i = 0; i < 3; ++i) {
      const LatticePoint a = mesh.point(mesh.corners(t)[i]), b = mesh.point(mesh.corners(t)[(i + 1) % 3]);
      const double x = (a.x - b.x) * mesh.frame().step, y = (a.y - b.y) * mesh.frame().step;
      EXPECT_LT(std::sqrt(x * x + y * y), 4.0 * mean);
    }
  }
}

TEST(SandGround, RollsBetweenZeroAndItsRoughness) {
  SandGround rough = ground(0.25);
  const Sandbox sandbox = makeSand(rough);
  double low = 1.0, high = -1.0;
  for (VertexId v = 0; v < sandbox.surface().mesh().vertexSlots(); ++v) {
    low = std::min(low, sandbox.surface().mesh().height(v));
    high = std::max(high, sandbox.surface().mesh().height(v));
  }
  EXPECT_GE(low, 0.0);
  EXPECT_LE(high, 0.25);
  EXPECT_GT(high - low, 0.1);
}

}  // namespace
}  // namespace teren
