// A program that dies at any moment loses nothing that its editor has handed out.
#include <algorithm>
#include <cstdlib>
#include <string>
#include <unistd.h>

#include <gtest/gtest.h>

#include "teren/EditJournal.h"
#include "teren/GroundEditor.h"
#include "teren/Hash.h"

#include "tests/engine/edits/KilledChild.h"
#include "tests/engine/edits/TestDeformers.h"
#include "tests/engine/plugin/ScratchFolder.h"
#include "tests/engine/stream/FaultWorld.h"

namespace teren {
namespace {

std::shared_ptr<const World> world() {
  static const std::shared_ptr<const World> made = test::faultWorld(3, 17, {64.0}, 20);
  return made;
}

Edit numbered(std::uint64_t number) {
  return {"bowl", static_cast<double>(number % 50) * 4.0, 0.25, 0.0, 9.0, 0.5, number, 0, {}};
}

enum class Deed { press, undo, redo };

/// What becomes of a history, entry by entry.
Deed nextDeed(std::uint64_t number, const EditHistory& history) {
  if (number % 5 >= 3 && !history.edits.empty()) return Deed::undo;
  if (number % 5 == 0 && !history.undone.empty()) return Deed::redo;
  return Deed::press;
}

void follow(std::uint64_t number, EditHistory& history) {
  const Deed deed = nextDeed(number, history);
  if (deed == Deed::press) history.press(numbered(number));
  if (deed == Deed::undo) history.undo();
  if (deed == Deed::redo) history.redo();
}

/// Digs without end, up to four deeds ahead of what is shown, and tells each number that was shown through
/// the pipe.
[[noreturn]] void dig(const std::filesystem::path& file, int pipe, EditHistory history,
                      std::uint64_t number) {
  const auto editor = GroundEditor::open(world(), testDeformer, file);
  if (!editor) _exit(1);
  const auto show = [&] {
    while ((*editor)->unfinished() > 0) (*editor)->take();
    if (write(pipe, &number, sizeof number) != sizeof number) _exit(2);
  };
  for (show();;) {
    for (std::uint64_t ahead = number % 4 + 1; ahead > 0; --ahead) {
      const Deed deed = nextDeed(++number, history);
      if (deed == Deed::press && !(*editor)->press(numbered(number))) _exit(3);
      if (deed == Deed::undo) (*editor)->undo();
      if (deed == Deed::redo) (*editor)->redo();
      follow(number, history);
    }
    show();
    if (!(*editor)->takeMessages().empty()) _exit(4);
  }
}

bool haveSameSeeds(const std::vector<Edit>& edits, const std::vector<Edit>& others) {
  return std::equal(edits.begin(), edits.end(), others.begin(), others.end(),
                    [](const Edit& edit, const Edit& other) { return edit.seed == other.seed; });
}

TEST(GroundEditorDeath, LosesNothingThatWasHandedOutAndNothingIsThereByHalf) {
  const ScratchFolder folder;
  const auto file = folder / "land.edits";
  world();
  const int deaths = std::getenv("TEREN_FULL") != nullptr ? 200 : 20;
  RandomSequence random(20261123);
  EditHistory history;
  std::uint64_t number = 0;
  for (int death = 0; death < deaths; ++death) {
    // Every fourth time, while the journal is being begun, opened or applied again.
    const std::uint64_t wait = death % 4 == 0 ? 0 : random.nextBits(4) + 1;
    const std::uint64_t shown = test::lastToldBeforeDeath([&](int pipe) { dig(file, pipe, history, number); },
                                                          wait, random.nextBits(13), number);
    if (HasFailure()) return;
    if (!std::filesystem::exists(file)) continue;  // it had not come so far
    const auto record = EditJournal::read(file, world()->descriptionHash());
    ASSERT_TRUE(record) << record.error().message;
    ASSERT_FALSE(record->damage) << record->damage->message;
    ASSERT_GE(record->entries, shown) << "death " << death;
    while (number < record->entries) follow(++number, history);
    ASSERT_EQ(number, record->entries);
    ASSERT_TRUE(haveSameSeeds(record->history.edits, history.edits)) << "death " << death;
    ASSERT_TRUE(haveSameSeeds(record->history.undone, history.undone)) << "death " << death;
  }
  EXPECT_GT(number, static_cast<std::uint64_t>(deaths));
  const auto record = EditJournal::read(file, world()->descriptionHash());
  ASSERT_TRUE(record);
  const auto ground = editedGround(world(), testDeformer, record->history.edits);
  EXPECT_TRUE(ground) << ground.error().message;
}

}  // namespace
}  // namespace teren
