#include "teren/GroundEditor.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <limits>
#include <mutex>
#include <sqlite3.h>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Bake.h"
#include "teren/EditJournal.h"
#include "teren/HeightMap.h"
#include "teren/HeightMapOperations.h"

#include "tests/engine/edits/CountedBowls.h"
#include "tests/engine/edits/TestDeformers.h"
#include "tests/engine/stream/FaultWorld.h"

namespace teren {
namespace {

using namespace std::chrono_literals;

class GroundEditorTest : public testing::Test {
 protected:
  GroundEditorTest()
      : world(test::faultWorld(3, 17, {64.0}, 20)),
        folder(std::filesystem::path(testing::TempDir()) /
               ("editor-" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()))),
        file(folder / "land.edits") {
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
  }
  ~GroundEditorTest() override { std::filesystem::remove_all(folder); }

  std::unique_ptr<GroundEditor> open(const std::optional<std::filesystem::path>& journal) const {
    auto opened = GroundEditor::open(world, testDeformer, journal);
    EXPECT_TRUE(opened.ok()) << (opened.ok() ? "" : opened.error().message);
    return opened.ok() ? *std::move(opened) : nullptr;
  }
  static Edit bowl(double x, double y) { return {"bowl", x, y, 0.0, 20.0, 3.0, 7, 0, {}}; }

  /// What is handed out once nothing is left to be applied.
  static EditedGround::Snapshot shownBy(GroundEditor& editor) {
    EditedGround::Snapshot shown;
    for (int turn = 0; turn < 60'000; ++turn) {
      if (std::optional<EditedGround::Snapshot> news = editor.take()) {
        shown.edits = std::move(news->edits);
        shown.changed.insert(shown.changed.end(), news->changed.begin(), news->changed.end());
      }
      if (editor.unfinished() == 0) return shown;
      std::this_thread::sleep_for(1ms);
    }
    ADD_FAILURE() << "it is never done";
    return shown;
  }
  /// The ground, drawn with edits.
  HeightMap heightsOf(const GroundEdits& edits) const {
    HeightMap map = *bake(*world, {-8, -8, 16, 16, 0}, {});
    edits.overlay(0, -8 * world->intervals(), -8 * world->intervals(), map.view());
    return map;
  }
  HeightMap heightsOf(const EditedGround::Snapshot& shown) const {
    EXPECT_TRUE(shown.edits) << "nothing is shown";
    return shown.edits ? heightsOf(*shown.edits) : HeightMap(1, 1);
  }
  /// Of a list, as anybody gets it.
  HeightMap heightsOf(const std::vector<Edit>& edits) const {
    auto ground = editedGround(world, testDeformer, edits);
    EXPECT_TRUE(ground.ok());
    return heightsOf(*(*ground)->snapshot().edits);
  }
  static bool areEqual(const HeightMap& a, const HeightMap& b) {
    return std::equal(a.samples().begin(), a.samples().end(), b.samples().begin(), b.samples().end());
  }

  std::shared_ptr<const World> world;
  std::filesystem::path folder, file;
};

TEST_F(GroundEditorTest, MakesOfWhatIsPressedWhatTheSameListGivesAnywhere) {
  HeightMap shown(1, 1);
  {
    const auto editor = open(file);
    EXPECT_EQ(editor->unfinished(), 0U);
    EXPECT_FALSE(editor->take());
    for (int k = 0; k < 5; ++k) ASSERT_TRUE(editor->press(bowl(10.0 * k, -7.0 * k)).ok());
    shown = heightsOf(shownBy(*editor));
    EXPECT_EQ(editor->edits(), 5U);
    EXPECT_TRUE(editor->takeMessages().empty());
  }
  const auto kept = EditJournal::read(file, world->descriptionHash());
  ASSERT_TRUE(kept.ok());
  ASSERT_EQ(kept->history.edits.size(), 5U);
  EXPECT_EQ(kept->history.edits[1].steps, std::uint64_t{BowlSurface::kSteps})
      << "what it took to come to rest";
  EXPECT_TRUE(areEqual(shown, heightsOf(kept->history.edits)));
  const auto again = open(file);
  EXPECT_TRUE(areEqual(heightsOf(shownBy(*again)), shown)) << "after a restart";
}

/// Where an editor's thread can be made to wait.
class Gate {
 public:
  void close() { open(0); }
  /// For so many passes.
  void open(int passes = std::numeric_limits<int>::max()) {
    const std::lock_guard lock(mutex_);
    left_ = passes;
    waits_ = false;
    changed_.notify_all();
  }
  void pass() {
    std::unique_lock lock(mutex_);
    while (left_ == 0) {
      waits_ = true;
      changed_.notify_all();
      changed_.wait(lock);
    }
    --left_;
  }
  void awaitSomebody() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return waits_; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  int left_ = std::numeric_limits<int>::max();
  bool waits_ = false;
};

/// Passed for each edit that is applied.
DeformerSource gated(Gate& gate, const DeformerSource& source) {
  return [&gate, source](std::string_view id) {
    gate.pass();
    return source(id);
  };
}

TEST_F(GroundEditorTest, ShowsWhatIsDoneBeforeAllIsDone) {
  Gate gate;
  const auto opened = GroundEditor::open(world, gated(gate, testDeformer), file);
  ASSERT_TRUE(opened.ok());
  GroundEditor& editor = **opened;
  gate.close();
  for (int k = 0; k < 200; ++k) ASSERT_TRUE(editor.press(bowl(10.0 * (k % 20), 0.0)).ok());
  gate.awaitSomebody();
  gate.open(101);
  gate.awaitSomebody();
  ASSERT_TRUE(editor.take());
  EXPECT_LT(editor.unfinished(), 150U) << "of which a hundred wait";
  gate.open();
  shownBy(editor);
  EXPECT_EQ(editor.edits(), 200U);
}

TEST_F(GroundEditorTest, RefusesWhatIsPressedWhereTooManyWait) {
  Gate gate;
  const auto opened = GroundEditor::open(world, gated(gate, testDeformer), file);
  ASSERT_TRUE(opened.ok());
  GroundEditor& editor = **opened;
  gate.close();
  Edit edit = bowl(0.0, 0.0);
  ASSERT_TRUE(editor.press(edit).ok());
  edit.kind = "no-such";
  std::size_t waiting = 1;
  while (waiting <= GroundEditor::kMostWaiting && editor.press(edit).ok()) ++waiting;
  EXPECT_EQ(waiting, GroundEditor::kMostWaiting);
  const Result<void> refused = editor.press(edit);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().message, "4096 presses and more are still to be applied, so this one is not");
  editor.undo();  // does not grow what there is
  gate.open();
  shownBy(editor);
  EXPECT_TRUE(editor.press(bowl(0.0, 0.0)).ok());
}

TEST_F(GroundEditorTest, TakesSeveralEditsBackAsOne) {
  constexpr int kTogether = static_cast<int>(EditedGround::kMostEditsTogether);
  BowlCounts counts;
  Gate gate;
  HeightMap shown(1, 1);
  {
    const auto opened = GroundEditor::open(world, gated(gate, countedBowls(counts)), file);
    ASSERT_TRUE(opened.ok());
    GroundEditor& editor = **opened;
    for (int k = 0; k < 3 * kTogether + 3; ++k) {
      ASSERT_TRUE(editor.press(bowl(20.0 * (k % 7), 0.0)).ok());
    }
    shownBy(editor);
    gate.close();
    ASSERT_TRUE(editor.press(bowl(5.0, 0.0)).ok());
    gate.awaitSomebody();
    const int before = counts.applied;
    for (int k = 0; k < 30; ++k) editor.undo();
    for (int k = 0; k < 10; ++k) editor.redo();
    gate.open();
    shown = heightsOf(shownBy(editor));
    EXPECT_LE(counts.applied - before, 1 + kTogether);
    EXPECT_EQ(editor.canRedo(), 20U);
    for (int k = 0; k < 30; ++k) editor.undo();
    for (int k = 0; k < 30; ++k) editor.redo();
  }
  const auto kept = EditJournal::read(file, world->descriptionHash());
  ASSERT_TRUE(kept.ok());
  EXPECT_EQ(kept->history.undone.size(), 20U) << "what nobody waited for to be shown";
  EXPECT_TRUE(areEqual(heightsOf(kept->history.edits), shown));
  const auto again = open(file);
  EXPECT_TRUE(areEqual(heightsOf(shownBy(*again)), shown));
}

TEST_F(GroundEditorTest, ShowsAllAgainForTheWorldInHand) {
  Gate gate;
  const auto opened = GroundEditor::open(world, gated(gate, testDeformer), file);
  ASSERT_TRUE(opened.ok());
  GroundEditor& editor = **opened;
  ASSERT_TRUE(editor.press(bowl(0.0, 0.0)).ok());
  shownBy(editor);
  gate.close();
  ASSERT_TRUE(editor.press(bowl(300.0, 0.0)).ok());
  gate.awaitSomebody();
  editor.setWorld(world);  // for another engine, say
  gate.open();
  const EditedGround::Snapshot shown = shownBy(editor);
  EXPECT_TRUE(std::any_of(shown.changed.begin(), shown.changed.end(), [](const SampleBox& box) {
    return box.touches({0, 0, 0, 0});
  })) << "what was pressed before";
  EXPECT_EQ(editor.edits(), 2U);
}

TEST_F(GroundEditorTest, TakesWhatIsDrawnBackAlsoWhereItCouldNotBeAppliedMeanwhile) {
  std::atomic<bool> refuses = false;
  const auto source = [&](std::string_view id) { return testDeformer(refuses ? "refuses" : id); };
  const auto opened = GroundEditor::open(world, source, file);
  ASSERT_TRUE(opened.ok());
  GroundEditor& editor = **opened;
  for (const double x : {0.0, 50.0}) ASSERT_TRUE(editor.press(bowl(x, 0.0)).ok());
  shownBy(editor);
  refuses = true;
  editor.undo();
  EXPECT_FALSE(shownBy(editor).edits);
  EXPECT_EQ(editor.takeMessages().size(), 1U);
  refuses = false;
  editor.undo();
  const EditedGround::Snapshot shown = shownBy(editor);
  ASSERT_TRUE(shown.edits);
  EXPECT_FALSE(shown.changed.empty());
  EXPECT_TRUE(areEqual(heightsOf(shown), heightsOf(std::vector<Edit>{})));
}

/// Holds the right to write a journal, as another program could.
class ForeignWriter {
 public:
  explicit ForeignWriter(const std::filesystem::path& file) {
    EXPECT_EQ(sqlite3_open(file.c_str(), &database_), SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(database_, "BEGIN IMMEDIATE", nullptr, nullptr, nullptr), SQLITE_OK);
  }
  ~ForeignWriter() { sqlite3_close(database_); }
  ForeignWriter(const ForeignWriter&) = delete;
  ForeignWriter& operator=(const ForeignWriter&) = delete;

 private:
  sqlite3* database_ = nullptr;
};

TEST_F(GroundEditorTest, ShowsNothingThatTheJournalHasNotAcknowledged) {
  const auto editor = open(file);
  ASSERT_TRUE(editor->press(bowl(0.0, 0.0)).ok());
  shownBy(*editor);
  bool isTold = false;
  const auto expectNothingYet = [&](std::size_t edits) {
    for (int turn = 0; turn < 300; ++turn, std::this_thread::sleep_for(1ms)) {
      const bool isShown = editor->take().has_value();
      // After SQLite's patience it is told that edits are in memory only; that is an acknowledgement, too.
      isTold = !editor->takeMessages().empty();
      if (isTold) return;
      ASSERT_FALSE(isShown);
      ASSERT_GT(editor->unfinished(), 0U);
    }
    EXPECT_EQ(EditJournal::read(file, world->descriptionHash())->history.edits.size(), edits);
  };
  {
    const ForeignWriter writer(file);
    ASSERT_TRUE(editor->press(bowl(3.0, 0.0)).ok());
    expectNothingYet(1);
  }
  shownBy(*editor);
  {
    const ForeignWriter writer(file);
    editor->undo();
    expectNothingYet(2);
  }
  EXPECT_TRUE(shownBy(*editor).edits || isTold) << "and then it is";
  EXPECT_EQ(EditJournal::read(file, world->descriptionHash())->history.edits.size(), 1U);
}

TEST_F(GroundEditorTest, TellsWhatIsRefusedAndGoesOnAsIfItHadNotBeenPressed) {
  const auto editor = open(file);
  EXPECT_FALSE(editor->press({"bowl", std::nan(""), 0.0, 0.0, 1.0, 1.0, 0, 0, {}}).ok());
  const std::vector<Edit> good{bowl(0.0, 0.0), bowl(30.0, 0.0)};
  ASSERT_TRUE(editor->press(good[0]).ok());
  for (const char* kind : {"no-such", "refuses", "throws", "not-finite"}) {
    Edit edit = bowl(5.0, 5.0);
    edit.kind = kind;
    ASSERT_TRUE(editor->press(edit).ok()) << kind;
  }
  ASSERT_TRUE(editor->press(good[1]).ok());
  const HeightMap shown = heightsOf(shownBy(*editor));
  EXPECT_EQ(editor->takeMessages().size(), 4U);
  EXPECT_EQ(editor->edits(), 2U);
  const auto kept = EditJournal::read(file, world->descriptionHash());
  ASSERT_TRUE(kept.ok());
  EXPECT_EQ(kept->history.edits.size(), 2U);
  EXPECT_TRUE(areEqual(shown, heightsOf(kept->history.edits)));
}

TEST_F(GroundEditorTest, AppliesAllEditsToAnotherWorldOfTheSameDescription) {
  const auto editor = open(std::nullopt);
  ASSERT_TRUE(editor->press(bowl(0.0, 0.0)).ok());
  const HeightMap shown = heightsOf(shownBy(*editor));
  editor->setWorld(test::faultWorld(3, 17, {64.0}, 20));
  EXPECT_GT(editor->unfinished(), 0U);
  ASSERT_TRUE(editor->press(bowl(10.0, 0.0)).ok());
  const EditedGround::Snapshot other = shownBy(*editor);
  ASSERT_TRUE(other.edits);
  EXPECT_FALSE(other.changed.empty());
  const HeightMap both = heightsOf(*other.edits);
  EXPECT_FALSE(areEqual(both, shown));
  Edit second = bowl(10.0, 0.0);
  second.steps = BowlSurface::kSteps;
  EXPECT_TRUE(areEqual(both, heightsOf(std::vector<Edit>{bowl(0.0, 0.0), second})));
}

TEST_F(GroundEditorTest, GivesUpAJournalThatItsDeformersRefuseAndLeavesItAlone) {
  {
    const auto journal = EditJournal::open(file, world->descriptionHash());
    ASSERT_TRUE(journal.ok());
    Edit edit = bowl(0.0, 0.0);
    (*journal)->append(edit);
    edit.kind = "refuses";
    (*journal)->append(edit);
  }
  {
    const auto editor = open(file);
    ASSERT_TRUE(editor->press(bowl(0.0, 0.0)).ok());
    EXPECT_FALSE(shownBy(*editor).edits);
    const std::vector<std::string> messages = editor->takeMessages();
    ASSERT_EQ(messages.size(), 2U);
    EXPECT_NE(messages[0].find("edit 2"), std::string::npos) << messages[0];
  }
  const auto kept = EditJournal::read(file, world->descriptionHash());
  ASSERT_TRUE(kept.ok());
  EXPECT_EQ(kept->history.edits.size(), 2U);
}

TEST_F(GroundEditorTest, TakesEditsBackAndBringsThemBackToTheSameBits) {
  const auto editor = open(file);
  std::vector<HeightMap> grounds;
  EditedGround::Snapshot first;
  for (int k = 0; k < 6; ++k) {
    ASSERT_TRUE(editor->press(bowl(9.0 * k, 30.0 - 14.0 * k)).ok());
    EXPECT_EQ(editor->canUndo(), static_cast<std::size_t>(k) + 1);
    grounds.push_back(heightsOf(shownBy(*editor)));
  }
  // What is drawn goes over from ground to ground in the boxes it is told, like the engine's nodes.
  HeightMap drawn = grounds.back();
  const auto follow = [&] {
    const EditedGround::Snapshot shown = shownBy(*editor);
    const std::int64_t corner = -8 * world->intervals();
    HeightMap over = drawn;
    shown.edits->overlay(0, corner, corner, over.view());
    for (const SampleBox& box : shown.changed) {
      for (std::int64_t y = box.south; y <= box.north; ++y) {
        for (std::int64_t x = box.west; x <= box.east; ++x) {
          const auto column = static_cast<int>(x - corner), row = static_cast<int>(y - corner);
          drawn(column, row) = over(column, row);
        }
      }
    }
  };
  for (int k = 4; k >= 2; --k) {
    editor->undo();
    EXPECT_EQ(editor->canRedo(), static_cast<std::size_t>(5 - k));
    follow();
    EXPECT_TRUE(areEqual(drawn, grounds[static_cast<std::size_t>(k)])) << k;
  }
  EXPECT_EQ(editor->edits(), 3U);
  editor->redo();
  follow();
  EXPECT_TRUE(areEqual(drawn, grounds[3]));
  editor->undo();
  editor->undo();
  editor->undo();
  editor->undo();
  follow();
  EXPECT_TRUE(areEqual(drawn, heightsOf(std::vector<Edit>{}))) << "the world's own";
  EXPECT_EQ(editor->canUndo(), 0U);
  EXPECT_EQ(editor->canRedo(), 6U);
  editor->undo();
  for (int k = 0; k < 4; ++k) editor->redo();
  follow();
  EXPECT_TRUE(areEqual(drawn, grounds[3]));
  ASSERT_TRUE(editor->press(bowl(-20.0, -20.0)).ok());
  EXPECT_EQ(editor->canRedo(), 0U);
  editor->redo();
  follow();
  EXPECT_EQ(editor->edits(), 5U);
  const auto kept = EditJournal::read(file, world->descriptionHash());
  ASSERT_TRUE(kept.ok());
  EXPECT_EQ(kept->history.edits.size(), 5U);
  EXPECT_TRUE(areEqual(drawn, heightsOf(kept->history.edits))) << "as the list gives it anywhere";
  EXPECT_TRUE(editor->takeMessages().empty());
}

TEST_F(GroundEditorTest, TakesBackWhatWasDoneBeforeARestart) {
  HeightMap two(1, 1), three(1, 1);
  {
    const auto editor = open(file);
    for (int k = 0; k < 2; ++k) ASSERT_TRUE(editor->press(bowl(9.0 * k, 0.0)).ok());
    two = heightsOf(shownBy(*editor));
    for (int k = 2; k < 4; ++k) {
      ASSERT_TRUE(editor->press(bowl(9.0 * k, 0.0)).ok());
      if (k == 2) three = heightsOf(shownBy(*editor));
    }
    editor->undo();
    editor->undo();
    EXPECT_TRUE(areEqual(heightsOf(shownBy(*editor)), two));
  }
  {
    const auto editor = open(file);
    EXPECT_EQ(editor->canUndo(), 2U);
    EXPECT_EQ(editor->canRedo(), 2U);
    EXPECT_TRUE(areEqual(heightsOf(shownBy(*editor)), two));
    editor->redo();
    EXPECT_TRUE(areEqual(heightsOf(shownBy(*editor)), three));
  }
  const auto editor = open(file);
  EXPECT_EQ(editor->canUndo(), 3U);
  EXPECT_EQ(editor->canRedo(), 1U);
  editor->undo();
  EXPECT_TRUE(areEqual(heightsOf(shownBy(*editor)), two));
}

TEST_F(GroundEditorTest, BringsBackAnEditThatCameBeforeTheGroundWasAtRest) {
  std::vector<Edit> edits{bowl(0.0, 0.0), bowl(10.0, 0.0), bowl(5.0, 9.0)};
  edits[1].steps = 2;
  edits[2].steps = 1;
  {
    const auto journal = EditJournal::open(file, world->descriptionHash());
    ASSERT_TRUE(journal.ok());
    (*journal)->append(edits);
  }
  const auto editor = open(file);
  const HeightMap all = heightsOf(shownBy(*editor));
  editor->undo();
  EXPECT_TRUE(areEqual(heightsOf(shownBy(*editor)), heightsOf({edits[0], edits[1]})));
  editor->redo();
  EXPECT_TRUE(areEqual(heightsOf(shownBy(*editor)), all));
  EXPECT_TRUE(editor->takeMessages().empty());
}

TEST_F(GroundEditorTest, BeginsItsJournalWithTheFirstEditAndNotBefore) {
  const std::filesystem::path deep = folder / "not" / "yet" / "land.edits";
  {
    const auto editor = open(deep);
    editor->undo();
    shownBy(*editor);
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder));
  {
    const auto editor = open(deep);
    ASSERT_TRUE(editor->press({"no-such", 0.0, 0.0, 0.0, 1.0, 1.0, 0, 0, {}}).ok());
    shownBy(*editor);
    EXPECT_TRUE(std::filesystem::is_empty(folder)) << "nothing was applied";
    ASSERT_TRUE(editor->press(bowl(0.0, 0.0)).ok());
  }
  const auto kept = EditJournal::read(deep, world->descriptionHash());
  ASSERT_TRUE(kept.ok()) << kept.error().message;
  EXPECT_EQ(kept->history.edits.size(), 1U);
}

TEST_F(GroundEditorTest, KeepsEditsInMemoryWhereAnotherProgramWritesTheJournal) {
  HeightMap one(1, 1);
  const auto writer = open(file);
  ASSERT_TRUE(writer->press(bowl(0.0, 0.0)).ok());
  one = heightsOf(shownBy(*writer));
  {
    const auto editor = open(file);
    EXPECT_EQ(editor->takeMessages(),
              std::vector<std::string>{"cannot write \"" + file.string() +
                                       "\": another program is writing it; edits are kept in memory only"});
    EXPECT_TRUE(areEqual(heightsOf(shownBy(*editor)), one)) << "what is there is shown";
    ASSERT_TRUE(editor->press(bowl(10.0, 0.0)).ok());
    const HeightMap two = heightsOf(shownBy(*editor));
    EXPECT_FALSE(areEqual(two, one));
    editor->undo();
    EXPECT_TRUE(areEqual(heightsOf(shownBy(*editor)), one));
    editor->redo();
    EXPECT_TRUE(areEqual(heightsOf(shownBy(*editor)), two));
    EXPECT_TRUE(editor->takeMessages().empty()) << "once is enough";
  }
  const auto kept = EditJournal::read(file, world->descriptionHash());
  ASSERT_TRUE(kept.ok());
  EXPECT_EQ(kept->history.edits.size(), 1U);
}

TEST_F(GroundEditorTest, KeepsEditsInMemoryWhereAnotherProgramBeginsTheJournalMeanwhile) {
  const auto late = open(file);
  const auto writer = open(file);
  ASSERT_TRUE(writer->press(bowl(0.0, 0.0)).ok());
  shownBy(*writer);
  ASSERT_TRUE(late->press(bowl(50.0, 0.0)).ok());
  EXPECT_TRUE(shownBy(*late).edits);
  EXPECT_EQ(late->takeMessages().size(), 1U);
  EXPECT_EQ(late->edits(), 1U);
  const auto kept = EditJournal::read(file, world->descriptionHash());
  ASSERT_TRUE(kept.ok());
  ASSERT_EQ(kept->history.edits.size(), 1U);
  EXPECT_EQ(kept->history.edits[0].x, 0.0);
}

TEST_F(GroundEditorTest, RefusesAJournalThatIsNotThisWorldsAndLeavesItAlone) {
  {
    const auto journal = EditJournal::open(file, 17);
    ASSERT_TRUE(journal.ok());
    (*journal)->append(bowl(0.0, 0.0));
  }
  const auto refused = GroundEditor::open(world, testDeformer, file);
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().message.find("has the edits of another world"), std::string::npos);
  EXPECT_TRUE(EditJournal::read(file, 17).ok());
  EXPECT_FALSE(GroundEditor::open(world, testDeformer, folder).ok()) << "a folder";
}

TEST_F(GroundEditorTest, RefusesEachEditOnceWhereThoseBeforeCannotBeAppliedUntilTheyAreUndone) {
  BowlCounts counts;
  bool refuses = true;
  {
    const auto journal = EditJournal::open(file, world->descriptionHash());
    ASSERT_TRUE(journal.ok());
    Edit edit = bowl(0.0, 0.0);
    (*journal)->append(edit);
    edit.kind = "refuses";
    (*journal)->append(edit);
  }
  const auto source = [&, bowls = countedBowls(counts)](std::string_view id) {
    return refuses && id == "refuses" ? testDeformer(id) : bowls(id);
  };
  {
    const auto opened = GroundEditor::open(world, source, file);
    ASSERT_TRUE(opened.ok());
    GroundEditor& editor = **opened;
    shownBy(editor);
    EXPECT_EQ(counts.applied, 1);
    for (int k = 0; k < 3; ++k) {
      ASSERT_TRUE(editor.press(bowl(9.0, 0.0)).ok());
      shownBy(editor);
    }
    EXPECT_EQ(counts.applied, 1) << "nothing is tried again in vain";
    EXPECT_EQ(editor.takeMessages().size(), 4U);
    editor.undo();
    ASSERT_TRUE(editor.press(bowl(9.0, 0.0)).ok());
    EXPECT_TRUE(shownBy(editor).edits);
    EXPECT_TRUE(editor.takeMessages().empty());
    EXPECT_EQ(editor.edits(), 2U);
    Edit refused = bowl(0.0, 0.0);
    refused.kind = "refuses";
    ASSERT_TRUE(editor.press(refused).ok());
    shownBy(editor);
    EXPECT_EQ(editor.takeMessages().size(), 1U);
  }
  EXPECT_EQ(EditJournal::read(file, world->descriptionHash())->history.edits.size(), 2U);
}

TEST_F(GroundEditorTest, TriesAgainInANewWorldWhatTheOneBeforeRefused) {
  bool refuses = true;
  {
    const auto journal = EditJournal::open(file, world->descriptionHash());
    ASSERT_TRUE(journal.ok());
    (*journal)->append(bowl(0.0, 0.0));
  }
  std::mutex mutex;
  const auto source = [&](std::string_view id) {
    const std::lock_guard lock(mutex);
    return testDeformer(refuses ? "refuses" : id);
  };
  const auto opened = GroundEditor::open(world, source, file);
  ASSERT_TRUE(opened.ok());
  EXPECT_FALSE(shownBy(**opened).edits);
  EXPECT_EQ((*opened)->takeMessages().size(), 1U);
  {
    const std::lock_guard lock(mutex);
    refuses = false;
  }
  (*opened)->setWorld(test::faultWorld(3, 17, {64.0}, 20));
  EXPECT_TRUE(shownBy(**opened).edits);
  EXPECT_TRUE((*opened)->takeMessages().empty());
}

TEST_F(GroundEditorTest, KeepsWhatWasPressedWhenItEndsWhileAWorldIsNew) {
  std::atomic<bool> isSlow = false;
  {
    const auto source = [&](std::string_view id) {
      if (isSlow) std::this_thread::sleep_for(1ms);  // asked for each edit
      return testDeformer(id);
    };
    const auto opened = GroundEditor::open(world, source, file);
    ASSERT_TRUE(opened.ok());
    GroundEditor& editor = **opened;
    for (int k = 0; k < 300; ++k) ASSERT_TRUE(editor.press(bowl(100.0 * k, 0.0)).ok());
    shownBy(editor);
    isSlow = true;
    editor.setWorld(test::faultWorld(3, 17, {64.0}, 20));
    ASSERT_TRUE(editor.press(bowl(0.0, 50.0)).ok());
    editor.undo();
    editor.undo();
    ASSERT_TRUE(editor.press(bowl(0.0, 90.0)).ok());
  }
  const auto kept = EditJournal::read(file, world->descriptionHash());
  ASSERT_TRUE(kept.ok());
  ASSERT_EQ(kept->history.edits.size(), 300U);
  EXPECT_EQ(kept->history.edits.back().y, 90.0);
}

TEST_F(GroundEditorTest, EndsAtOnceWhileItAppliesALongJournal) {
  constexpr int kMany = 20'000;
  {
    const auto journal = EditJournal::open(file, world->descriptionHash());
    ASSERT_TRUE(journal.ok());
    (*journal)->append(std::vector<Edit>(kMany, bowl(0.0, 0.0)));
  }
  BowlCounts counts;
  {
    const auto source = [bowls = countedBowls(counts)](std::string_view id) {
      std::this_thread::sleep_for(1ms);  // asked for each edit
      return bowls(id);
    };
    const auto opened = GroundEditor::open(world, source, file);
    ASSERT_TRUE(opened.ok());
    while (counts.applied == 0) std::this_thread::yield();
    ASSERT_TRUE((*opened)->press(bowl(0.0, 0.0)).ok());
    EXPECT_GT((*opened)->unfinished(), 1U);
  }
  EXPECT_LT(counts.applied, kMany);
  EXPECT_EQ(EditJournal::read(file, world->descriptionHash())->history.edits.size(), std::size_t{kMany})
      << "what was pressed on ground that nobody has seen";
}

TEST_F(GroundEditorTest, BeginsWithTheGroundThatItsJournalKeeps) {
  constexpr int kMany = 3 * static_cast<int>(EditedGround::kMostEditsTogether) + 5;
  HeightMap before(1, 1);
  {
    const auto editor = open(file);
    for (int k = 0; k < kMany; ++k) ASSERT_TRUE(editor->press(bowl(20.0 * (k % 7), 0.0)).ok());
    before = heightsOf(shownBy(*editor));
  }
  BowlCounts counts;
  {
    const auto again = GroundEditor::open(world, countedBowls(counts), file);
    ASSERT_TRUE(again.ok());
    EXPECT_TRUE(areEqual(heightsOf(shownBy(**again)), before));
    EXPECT_EQ(counts.applied, 5);
    EXPECT_TRUE((*again)->takeMessages().empty());
    for (int k = 0; k < 10; ++k) (*again)->undo();  // past what is kept
    shownBy(**again);
    const int sofar = counts.applied;
    (*again)->setWorld(test::faultWorld(3, 17, {64.0}, 20));
    EXPECT_TRUE(shownBy(**again).edits);
    EXPECT_EQ(counts.applied - sofar, kMany - 10) << "whose generators may have changed";
    EXPECT_TRUE((*again)->takeMessages().empty());
    ASSERT_TRUE((*again)->press(bowl(50.0, 0.0)).ok());
    before = heightsOf(shownBy(**again));
  }
  const auto last = open(file);
  EXPECT_TRUE(areEqual(heightsOf(shownBy(*last)), before));
  EXPECT_TRUE(last->takeMessages().empty());
  const auto other = GroundEditor::open(world, countedBowls(counts, "2"));
  ASSERT_TRUE(other.ok());
}

TEST_F(GroundEditorTest, KeepsTheGroundOfALongListOnceItIsAppliedForTheFirstTime) {
  {
    const auto journal = EditJournal::open(file, world->descriptionHash());
    ASSERT_TRUE(journal.ok());
    (*journal)->append(std::vector<Edit>(300, bowl(0.0, 0.0)));
  }
  const auto editor = open(file);
  shownBy(*editor);
  const auto kept = EditJournal::read(file, world->descriptionHash());
  ASSERT_TRUE(kept.ok());
  EXPECT_TRUE(kept->checkpoint) << "while it is still open";
}

TEST_F(GroundEditorTest, KeepsNoGroundOfEditsThatWereUndone) {
  {
    const auto editor = open(file);
    for (int k = 0; k < 130; ++k) ASSERT_TRUE(editor->press(bowl(20.0 * (k % 7), 0.0)).ok());
  }
  const auto editor = open(file);
  for (int k = 0; k < 3; ++k) editor->undo();
  for (int k = 0; k < 3; ++k) ASSERT_TRUE(editor->press(bowl(5.0, 5.0)).ok());
  shownBy(*editor);
  // As a program finds it that comes after this one has died.
  const auto kept = EditJournal::read(file, world->descriptionHash());
  ASSERT_TRUE(kept.ok());
  EXPECT_EQ(kept->history.edits.size(), 130U);
  EXPECT_FALSE(kept->checkpoint);
}

TEST_F(GroundEditorTest, PassesOverGroundThatItsJournalKeepsOfOtherVersions) {
  {
    const auto editor = open(file);
    for (int k = 0; k < 130; ++k) ASSERT_TRUE(editor->press(bowl(20.0 * (k % 7), 0.0)).ok());
  }
  BowlCounts counts;
  const auto editor = GroundEditor::open(world, countedBowls(counts, "2"), file);
  ASSERT_TRUE(editor.ok());
  shownBy(**editor);
  EXPECT_EQ(counts.applied, 130);
  EXPECT_TRUE((*editor)->takeMessages().empty()) << "nothing is wrong";
}

TEST_F(GroundEditorTest, TakesTheLatestEditsBackWithoutApplyingAllOthersAgain) {
  BowlCounts counts;
  const auto opened = GroundEditor::open(world, countedBowls(counts));
  ASSERT_TRUE(opened.ok());
  constexpr int kTogether = static_cast<int>(EditedGround::kMostEditsTogether);
  for (int k = 0; k < 5 * kTogether + 3; ++k) ASSERT_TRUE((*opened)->press(bowl(20.0 * (k % 7), 0.0)).ok());
  shownBy(**opened);
  const int before = counts.applied;
  (*opened)->undo();
  shownBy(**opened);
  EXPECT_EQ(counts.applied - before, 2);
  for (int k = 0; k < 3; ++k) (*opened)->undo();
  shownBy(**opened);
  EXPECT_LE(counts.applied - before, 4 + kTogether);
}

}  // namespace
}  // namespace teren
