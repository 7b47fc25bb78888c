// A program that dies at any moment loses no edit that was acknowledged.
#include <cstdlib>
#include <string>
#include <unistd.h>

#include <gtest/gtest.h>

#include "teren/EditJournal.h"
#include "teren/Hash.h"

#include "tests/engine/edits/KilledChild.h"
#include "tests/engine/plugin/ScratchFolder.h"

namespace teren {
namespace {

constexpr std::uint64_t kWorld = 99;

Edit numbered(std::uint64_t number) {
  return {"bowl", static_cast<double>(number), 0.25, 0.0, 2.0, 0.5, number, number % 5, {}};
}

constexpr std::uint64_t kMostUnderWay = 16;

/// Digs without end, never far ahead of what is acknowledged, and tells each acknowledgement through the
/// pipe.
[[noreturn]] void dig(const std::filesystem::path& file, int pipe) {
  Result<std::unique_ptr<EditJournal>> journal = EditJournal::open(file, kWorld);
  if (!journal) _exit(1);
  std::uint64_t told = 0;
  for (std::uint64_t number = (*journal)->found().edits.size() + 1;;) {
    if (number <= (*journal)->acknowledged() + kMostUnderWay) (*journal)->append(numbered(number++));
    const std::uint64_t acknowledged = (*journal)->acknowledged();
    if (acknowledged == told) continue;
    told = acknowledged;
    if (write(pipe, &told, sizeof told) != sizeof told) _exit(2);
  }
}

TEST(EditJournalDeath, LosesNothingThatWasAcknowledgedAndNothingIsThereByHalf) {
  const ScratchFolder folder;
  const auto file = folder / "land.edits";
  const int deaths = std::getenv("TEREN_FULL") != nullptr ? 200 : 20;
  RandomSequence random(20261122);
  std::uint64_t before = 0;
  for (int death = 0; death < deaths; ++death) {
    // Every third time, while the file is being begun or opened; else after a few acknowledgements.
    const std::uint64_t wait = death % 3 == 0 ? 0 : random.nextBits(4) + 1;
    const std::uint64_t acknowledged =
        test::lastToldBeforeDeath([&](int pipe) { dig(file, pipe); }, wait, random.nextBits(13), 0);
    if (HasFailure()) return;
    if (!std::filesystem::exists(file)) continue;  // it had not come so far
    const auto record = EditJournal::read(file, kWorld);
    ASSERT_TRUE(record) << record.error().message;
    ASSERT_FALSE(record->damage) << record->damage->message;
    ASSERT_GE(record->history.edits.size(), acknowledged) << "death " << death;
    ASSERT_GE(record->history.edits.size(), before);
    for (std::size_t k = 0; k < record->history.edits.size(); ++k)
      ASSERT_EQ(record->history.edits[k], numbered(k + 1));
    before = record->history.edits.size();
  }
  EXPECT_GT(before, static_cast<std::uint64_t>(deaths) / 2);
  EXPECT_TRUE(EditJournal::open(file, kWorld));
}

}  // namespace
}  // namespace teren
