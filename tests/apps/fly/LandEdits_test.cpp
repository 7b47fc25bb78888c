#include "apps/fly/LandEdits.h"

#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "teren/PluginRegistry.h"

#include "apps/fly/ToolBelt.h"
#include "tests/engine/plugin/ScratchFolder.h"

namespace teren {
namespace {

/// Edits of a plain, kept in a folder; each is opened as a program does it.
class LandsEdits : public testing::Test {
 protected:
  std::unique_ptr<LandEdits> open() {
    return std::make_unique<LandEdits>(
        world_, deformersOf(PluginRegistry::standard()),
        [this](const World&) -> Result<std::filesystem::path> { return folder_ / "land.edits"; });
  }
  /// Lets all that was asked be done; how many edits count then.
  std::size_t countOf(LandEdits& edits) {
    while (edits.unfinished() > 0) {
      if (!edits.handTo(*engine_)) std::this_thread::yield();
    }
    return edits.edits();
  }
  static Edit hole(double east) {
    return craterEdit(Position::fromMetres(east, 0.0, 64.0).value(), 64.0, 10.0, 2.0, 0.0, 0.0);
  }

  const ScratchFolder folder_;
  const std::shared_ptr<const World> world_ =
      World::create(
          WorldDescription::fromJson(R"({ "layers": [ { "generator": "constant" } ] })", "the test's")
              .value(),
          *PluginRegistry::standard())
          .value();
  const std::unique_ptr<Engine> engine_ = Engine::create(world_, {.view = {0, 1}}).value();
};

TEST_F(LandsEdits, AreTakenBackAndBroughtBackByStrokes) {
  const auto edits = open();
  for (int stamp = 0; stamp < 3; ++stamp) edits->press(hole(10.0 * stamp), 7);
  for (int stamp = 0; stamp < 4; ++stamp) edits->press(hole(10.0 * stamp), 8);
  edits->press(hole(50.0));
  edits->press(hole(60.0));
  ASSERT_EQ(countOf(*edits), 9U);
  for (const std::size_t left : {8U, 7U, 3U, 0U}) {
    EXPECT_TRUE(edits->undo());
    EXPECT_EQ(countOf(*edits), left);
  }
  EXPECT_FALSE(edits->undo());
  for (const std::size_t left : {3U, 7U, 8U, 9U}) {
    EXPECT_TRUE(edits->redo());
    EXPECT_EQ(countOf(*edits), left);
  }
  EXPECT_FALSE(edits->redo());
}

TEST_F(LandsEdits, BeginAnotherStrokeAfterAnUndoWhileTheKeyIsHeld) {
  const auto edits = open();
  for (int stamp = 0; stamp < 3; ++stamp) edits->press(hole(10.0 * stamp), 1);
  for (int stamp = 0; stamp < 3; ++stamp) edits->press(hole(10.0 * stamp), 2);
  EXPECT_TRUE(edits->undo());
  EXPECT_TRUE(edits->undo());
  for (int stamp = 0; stamp < 5; ++stamp) edits->press(hole(10.0 * stamp), 2);
  ASSERT_EQ(countOf(*edits), 5U);
  EXPECT_FALSE(edits->redo()) << "something was dug since";
  EXPECT_TRUE(edits->undo());
  EXPECT_EQ(countOf(*edits), 0U) << "marks of strokes that are gone divide none";
}

TEST_F(LandsEdits, OfAnEarlierFlightAreTakenBackOneByOne) {
  {
    const auto edits = open();
    for (int stamp = 0; stamp < 3; ++stamp) edits->press(hole(10.0 * stamp), 1);
    ASSERT_EQ(countOf(*edits), 3U);
  }
  const auto edits = open();
  for (int stamp = 0; stamp < 4; ++stamp) edits->press(hole(10.0 * stamp), 1);
  ASSERT_EQ(countOf(*edits), 7U);
  for (const std::size_t left : {3U, 2U, 1U}) {
    EXPECT_TRUE(edits->undo());
    EXPECT_EQ(countOf(*edits), left);
  }
  for (const std::size_t left : {2U, 3U, 7U}) {
    EXPECT_TRUE(edits->redo());
    EXPECT_EQ(countOf(*edits), left);
  }
}

TEST_F(LandsEdits, SayWhatIsWrongOnceAStroke) {
  const auto edits = open();
  Edit bad = hole(0.0);
  bad.size = -1.0;
  std::size_t said = 0;
  const auto press = [&](std::optional<std::uint64_t> stroke) {
    edits->press(bad, stroke);
    said += edits->takeMessages().size();
  };
  for (int stamp = 0; stamp < 5; ++stamp) press({});
  EXPECT_EQ(said, 1U);
  for (int stamp = 0; stamp < 5; ++stamp) press(3);
  EXPECT_EQ(said, 2U) << "whoever tries again is told again";
}

}  // namespace
}  // namespace teren
