#include "teren/EditJournal.h"

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sqlite3.h>
#include <string>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Hash.h"

#include "edits/GroundCheckpoint.h"
#include "edits/JournalFile.h"
#include "tests/engine/plugin/ScratchFolder.h"

namespace teren {
namespace {

constexpr std::uint64_t kWorld = 0x8000'0000'1234'5678U;

Edit numbered(std::uint64_t number) {
  Edit edit{"bowl", static_cast<double>(number) * 0.5, -3.25,      0.0, 2.0,
            0.5,    number * 0x9e37'79b9'7f4a'7c15U,   number % 7, {}};
  if (number % 3 == 0) edit.parameters = {{"note", std::string("\"") + std::to_string(number) + "\\ é"}};
  return edit;
}

std::vector<Edit> numberedUpTo(std::uint64_t count) {
  std::vector<Edit> edits;
  for (std::uint64_t number = 1; number <= count; ++number) edits.push_back(numbered(number));
  return edits;
}

std::unique_ptr<EditJournal> opened(const std::filesystem::path& file, std::uint64_t world = kWorld) {
  Result<std::unique_ptr<EditJournal>> journal = EditJournal::open(file, world);
  EXPECT_TRUE(journal) << (journal ? "" : journal.error().message);
  return journal ? *std::move(journal) : nullptr;
}

/// Appends edits after those that are there, up to `count`, and closes.
void write(const std::filesystem::path& file, std::uint64_t count) {
  const auto journal = opened(file);
  for (std::uint64_t number = journal->found().edits.size() + 1; number <= count; ++number) {
    EXPECT_EQ(journal->append(numbered(number)), number);
  }
  const Result<void> flushed = journal->flush();
  EXPECT_TRUE(flushed) << (flushed ? "" : flushed.error().message);
  EXPECT_EQ(journal->acknowledged(), count);
}

std::string complaint(const std::filesystem::path& file, std::uint64_t world = kWorld) {
  const auto read = EditJournal::read(file, world);
  if (!read) return read.error().message;
  return read->damage ? read->damage->message : "none";
}

std::string complaintOfOpening(const std::filesystem::path& file, std::uint64_t world = kWorld) {
  const auto journal = EditJournal::open(file, world);
  return journal ? "none" : journal.error().message;
}

void expectRead(const std::filesystem::path& file, std::uint64_t count) {
  const auto read = EditJournal::read(file, kWorld);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_FALSE(read->damage) << read->damage->message;
  EXPECT_EQ(read->history.edits, numberedUpTo(count));
}

void sql(const std::filesystem::path& file, const std::string& statements) {
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(file.c_str(), &database), SQLITE_OK);
  EXPECT_EQ(sqlite3_exec(database, statements.c_str(), nullptr, nullptr, nullptr), SQLITE_OK)
      << sqlite3_errmsg(database);
  sqlite3_close(database);
}

/// Runs it in a process of its own, where it may give up rights; what it returns is the answer.
int inAnotherProcess(const std::function<int()>& work) {
  const pid_t child = fork();
  if (child == 0) _exit(work());
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// No file of this process may have more bytes, as on a disk that is full; until freeDisk().
void fillDisk(std::uintmax_t bytes) {
  signal(SIGXFSZ, SIG_IGN);
  const rlimit full = {static_cast<rlim_t>(bytes), RLIM_INFINITY};
  setrlimit(RLIMIT_FSIZE, &full);
}

void freeDisk() {
  const rlimit free = {RLIM_INFINITY, RLIM_INFINITY};
  setrlimit(RLIMIT_FSIZE, &free);
}

std::vector<std::string> namesIn(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

TEST(EditJournal, KeepsEveryEditInOrderAcrossOpenings) {
  const ScratchFolder folder;
  const auto file = folder / "land.edits";
  write(file, 0);
  expectRead(file, 0);
  write(file, 5);
  write(file, 1000);
  expectRead(file, 1000);
  EXPECT_EQ(opened(file)->found().edits.size(), 1000U);
  // Nothing else is left lying about.
  EXPECT_EQ(namesIn(folder.path()), std::vector<std::string>{"land.edits"});
}

TEST(EditJournal, IsReadByManyWhileOneWrites) {
  const ScratchFolder folder;
  const auto file = folder / "land.edits";
  const auto journal = opened(file);
  for (std::uint64_t number = 1; number <= 300; ++number) {
    journal->append(numbered(number));
    if (number % 50 != 0) continue;
    ASSERT_TRUE(journal->flush());
    expectRead(file, number);
    expectRead(file, number);
  }
}

TEST(EditJournal, KeepsItsLogThroughReadingByTheProgramThatWritesIt) {
  const ScratchFolder folder;
  const auto file = folder / "land.edits";
  const int answer = inAnotherProcess([&] {
    const auto journal = opened(file);
    journal->append(numbered(1));
    if (!journal->flush() || !EditJournal::read(file, kWorld)) return 4;
    // Who ends as the last to have it open would write the log back and remove it.
    if (inAnotherProcess([&] { return EditJournal::read(file, kWorld) ? 0 : 3; }) != 0) return 5;
    journal->append(numbered(2));
    if (!journal->flush()) return 6;
    _exit(0);  // dies with the journal open
  });
  ASSERT_EQ(answer, 0);
  expectRead(file, 2);
}

TEST(EditJournal, IsWrittenByOneAtATime) {
  const ScratchFolder folder;
  const auto file = folder / "land.edits";
  std::filesystem::create_symlink(file, folder / "other-name");
  {
    const auto journal = opened(file);
    for (const auto& name : {file, folder / "other-name"}) {
      EXPECT_EQ(complaintOfOpening(name),
                "\"" + name.string() + "\" is being written by another program, which must end first");
    }
    const int answer = inAnotherProcess([&] { return EditJournal::open(file, kWorld) ? 0 : 3; });
    EXPECT_EQ(answer, 3);
    journal->append(numbered(1));
  }
  write(file, 2);
  expectRead(file, 2);
}

TEST(EditJournal, AcknowledgesWithoutBeingWaitedFor) {
  const ScratchFolder folder;
  const auto journal = opened(folder / "land.edits");
  const std::uint64_t last = journal->append(numbered(1));
  for (int tries = 0; tries < 60'000 && journal->acknowledged() < last; ++tries) usleep(1000);
  EXPECT_EQ(journal->acknowledged(), last);
  expectRead(folder / "land.edits", 1);
}

TEST(EditJournal, OfAnotherWorldOrVersionOrProgramIsRefusedAndLeftAsItIs) {
  const ScratchFolder folder;
  const auto good = folder / "land.edits";
  write(good, 50);
  const auto refused = [&](const std::filesystem::path& file, const std::string& sentence,
                           std::uint64_t world) {
    const std::string before = fileBytes(file);
    EXPECT_EQ(complaint(file, world), sentence);
    EXPECT_EQ(complaintOfOpening(file, world), sentence);
    EXPECT_EQ(fileBytes(file), before);
    EXPECT_EQ(sentence.find('\n'), std::string::npos);
  };
  const auto changed = [&](const std::string& name, const std::string& statements) {
    std::filesystem::copy_file(good, folder / name);
    sql(folder / name, statements);
    return folder / name;
  };
  const auto notOne = [](const std::filesystem::path& file, const std::string& why) {
    return "\"" + file.string() + "\" is not an edit journal that can be read: " + why;
  };
  refused(good,
          "\"" + good.string() +
              "\" has the edits of another world (its hash is 8000000012345678), expected "
              "0000000000000017",
          0x17);
  auto file = changed("future", "PRAGMA user_version = 4");
  refused(file, notOne(file, "it is of version 4, expected 3; a newer Teren has made it"), kWorld);
  file = changed("past", "PRAGMA user_version = 0");
  refused(file, notOne(file, "it is of version 0, expected 3"), kWorld);
  file = changed("other", "PRAGMA application_id = 7");
  refused(file, notOne(file, "it is a database of another program"), kWorld);
  file =
      changed("trap",
              "DROP TABLE entry; CREATE VIEW entry AS WITH RECURSIVE n(number) AS (SELECT 1 UNION ALL SELECT "
              "number + 1 FROM n) SELECT number, '' AS text, 0 AS checksum FROM n");
  refused(file, notOne(file, "its tables are not those of an edit journal"), kWorld);
  file = changed("trigger", "CREATE TRIGGER t AFTER INSERT ON entry BEGIN DELETE FROM entry; END");
  refused(file, notOne(file, "its tables are not those of an edit journal"), kWorld);
  file = changed("headless", "DELETE FROM journal");
  refused(file, notOne(file, "it does not say how many entries it has"), kWorld);
  folder.write("text", "stamp crater 1 2 3 4 5 6 7\n" + std::string(5000, '#'));
  refused(folder / "text", notOne(folder / "text", "file is not a database"), kWorld);
  folder.write("short", "stamp crater 1 2 3 4 5 6 7\n");
  refused(folder / "short", notOne(folder / "short", "file is not a database"), kWorld);
  folder.write("noise", std::string(8192, '\x5a'));
  refused(folder / "noise", notOne(folder / "noise", "file is not a database"), kWorld);
}

TEST(EditJournal, ThatIsNoFileIsRefused) {
  const ScratchFolder folder;
  for (const std::filesystem::path& file :
       {folder.path(), std::filesystem::path("/dev/null"), std::filesystem::path(),
        std::filesystem::path(std::string("a\0b", 3))}) {
    EXPECT_NE(complaint(file).find("is not a file, expected an edit journal"), std::string::npos)
        << complaint(file);
    EXPECT_EQ(complaintOfOpening(file), complaint(file));
  }
  EXPECT_EQ(complaint(folder / "none"),
            "\"" + (folder / "none").string() + "\" is not there, expected an edit journal");
  EXPECT_TRUE(namesIn(folder.path()).empty());
}

TEST(EditJournal, TellsLostChangedAndExchangedEditsAndGivesTheGoodOnesBefore) {
  const ScratchFolder folder;
  const auto good = folder / "land.edits";
  write(good, 200);
  int cases = 0;
  const auto damaged = [&](const std::string& statements, std::size_t goodOnes, const std::string& what) {
    const auto file = folder / ("damaged-" + std::to_string(++cases));
    std::filesystem::copy_file(good, file);
    sql(file, statements);
    const std::string before = fileBytes(file);
    const auto read = EditJournal::read(file, kWorld);
    ASSERT_TRUE(read) << read.error().message;
    ASSERT_TRUE(read->damage) << statements;
    EXPECT_EQ(read->damage->message, "\"" + file.string() + "\" is damaged: " + what + "; " +
                                         std::to_string(goodOnes) + " entries from the first on are good");
    EXPECT_EQ(read->history.edits, numberedUpTo(goodOnes));
    EXPECT_EQ(complaintOfOpening(file), read->damage->message);
    EXPECT_EQ(fileBytes(file), before);
  };
  damaged("DELETE FROM entry WHERE number = 17", 16, "entry 17 of 200 is missing");
  damaged("DELETE FROM entry WHERE number > 190", 190, "entry 191 of 200 is missing");
  damaged("DELETE FROM entry", 0, "entry 1 of 200 is missing");
  damaged("UPDATE entry SET text = replace(text, '0.5', '0.6') WHERE number = 40", 39,
          "entry 40 of 200 does not fit its checksum");
  damaged("UPDATE entry SET checksum = checksum + 1 WHERE number = 1", 0,
          "entry 1 of 200 does not fit its checksum");
  damaged("UPDATE entry SET text = (SELECT text FROM entry WHERE number = 60) WHERE number = 50", 49,
          "entry 50 of 200 does not fit its checksum");
  damaged("UPDATE entry SET number = -number WHERE number = 5", 0, "entry 1 of 200 is missing");
  damaged("UPDATE journal SET entries = 199", 200, "entry 200 of 199 is not counted");
  damaged("UPDATE journal SET entries = 201", 200, "entry 201 of 201 is missing");
  damaged("UPDATE journal SET checksum = 0", 200, "entry 200 of 200 does not fit the last checksum");
  damaged("UPDATE entry SET text = CAST(text AS BLOB) WHERE number = 9", 8,
          "entry 9 of 200 is no text with a checksum");
}

TEST(EditJournal, KeepsWhatWasUndoneAndRedone) {
  const ScratchFolder folder;
  const auto file = folder / "land.edits";
  write(file, 5);
  EditHistory expected{numberedUpTo(5), {}};
  const auto expectHistory = [&] {
    const auto read = EditJournal::read(file, kWorld);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_FALSE(read->damage);
    EXPECT_EQ(read->history, expected);
  };
  {
    const auto journal = opened(file);
    for (int k = 0; k < 3; ++k) journal->appendUndo(), expected.undo();
    EXPECT_EQ(journal->appendRedo(), 9U);
    expected.redo();
    ASSERT_TRUE(journal->flush());
    expectHistory();
  }
  EXPECT_EQ(expected.edits.size(), 3U);
  EXPECT_EQ(expected.undone.size(), 2U);
  {
    const auto journal = opened(file);
    EXPECT_EQ(journal->found(), expected);
    journal->append(numbered(17));
    expected.press(numbered(17));
  }
  expectHistory();
  EXPECT_TRUE(expected.undone.empty());
}

TEST(EditJournal, TellsWhatIsTakenBackWhereNothingIs) {
  const ScratchFolder folder;
  for (const bool undoes : {true, false}) {
    const auto file = folder / (undoes ? "undo" : "redo");
    write(file, 2);
    {
      const auto journal = opened(file);
      for (int k = 0; k < (undoes ? 3 : 1); ++k) undoes ? journal->appendUndo() : journal->appendRedo();
    }
    EXPECT_EQ(complaint(file), "\"" + file.string() + "\" is damaged: entry " +
                                   (undoes ? "5 of 5 takes an edit back where there is none; 4"
                                           : "3 of 3 brings an edit back where none was taken back; 2") +
                                   " entries from the first on are good");
  }
}

/// Of some thousand samples, in several rows, and some of the patches loose here and there.
std::shared_ptr<const GroundCheckpoint> someGround(std::uint64_t seed = 1, int patches = 40) {
  GroundOverrides overrides(32);
  RandomSequence random(seed);
  for (int k = 0; k < patches; ++k) {
    GroundOverrides::Patch& patch = overrides.add({k / 7, k % 7});
    for (int place = 0; place < 1024; ++place) {
      if (random.nextBits(2) == 0) continue;
      patch.now(place % 32, place / 32) = static_cast<float>(random.nextBits(10));
      patch.own(place % 32, place / 32) = -1.5F;
    }
  }
  LooseLayer loose(32);
  for (int k = 0; k < patches; k += 2) {
    HeightMap depths(32, 32);
    for (int place = 0; place < 1024; ++place)
      depths(place % 32, place / 32) = static_cast<float>(random.nextBits(2));
    loose.add({k / 7, k % 7}, std::move(depths));
  }
  return std::make_shared<const GroundCheckpoint>(EditListMark{128, 77}, EndedSurfaces{3, -0.25, 1.5},
                                                  overrides.share(), std::move(loose));
}

TEST(EditJournal, KeepsGroundBesideItsEdits) {
  const ScratchFolder folder;
  const auto file = folder / "land.edits";
  write(file, 130);
  EXPECT_FALSE(opened(file)->record().checkpoint);
  const auto first = someGround(1), second = someGround(2, 90);
  for (const auto& ground : {first, second}) {
    {
      const auto journal = opened(file);
      journal->append(numbered(journal->record().entries + 1));
      journal->keep(ground);
    }
    const auto read = EditJournal::read(file, kWorld);
    ASSERT_TRUE(read) << read.error().message;
    ASSERT_TRUE(read->checkpoint);
    EXPECT_EQ(read->checkpoint->mark(), ground->mark());
    EXPECT_EQ(read->checkpoint->text(), ground->text());
  }
  EXPECT_GT(second->text().size(), std::size_t{1} << 18) << "more than one row";
  expectRead(file, 132);
}

TEST(EditJournal, IgnoresGroundThatIsNotWhatWasWrittenWithOneSentence) {
  const ScratchFolder folder;
  const auto good = folder / "land.edits";
  write(good, 130);
  opened(good)->keep(someGround(2, 90));
  int cases = 0;
  const auto ignored = [&](const std::string& statements, const std::string& why) {
    const auto file = folder / ("bad-" + std::to_string(++cases));
    std::filesystem::copy_file(good, file);
    sql(file, statements);
    const auto read = EditJournal::read(file, kWorld);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_FALSE(read->damage);
    EXPECT_FALSE(read->checkpoint);
    ASSERT_TRUE(read->withoutCheckpoint) << statements;
    EXPECT_EQ(read->withoutCheckpoint->message, "the ground that \"" + file.string() +
                                                    "\" keeps is ignored: " + why +
                                                    "; its edits are applied again");
    expectRead(file, 130);
    EXPECT_EQ(complaintOfOpening(file), "none");
  };
  ignored("DELETE FROM piece WHERE number = 2", "it is not whole");
  ignored("DELETE FROM piece", "it is not whole");
  ignored("INSERT INTO piece VALUES (17, x'00')", "it is not whole");
  ignored("UPDATE piece SET bytes = CAST('text' AS TEXT) WHERE number = 1", "it is not whole");
  ignored("UPDATE checkpoint SET bytes = bytes - 1", "it is not whole");
  ignored("UPDATE checkpoint SET bytes = -1", "it does not say how large it is");
  ignored("UPDATE checkpoint SET bytes = 1 << 60", "it does not say how large it is");
  ignored("UPDATE checkpoint SET edits = 256", "it does not fit its checksum");
  ignored("UPDATE checkpoint SET list = 5", "it does not fit its checksum");
  ignored("UPDATE checkpoint SET checksum = 'x'", "it does not say what it is of");
  ignored("UPDATE piece SET bytes = x'01' || substr(bytes, 2) WHERE number = 1", "it is not whole");
  ignored("UPDATE piece SET bytes = CAST(x'01' || substr(bytes, 2) AS BLOB) WHERE number = 1",
          "it does not fit its checksum");
}

TEST(EditJournal, TakesNoGroundThatCouldNotHaveBeenWritten) {
  const auto good = someGround(1, 3);
  const std::string text = good->text();
  ASSERT_TRUE(GroundCheckpoint::read(good->mark(), text).ok());
  EXPECT_EQ(GroundCheckpoint::read(good->mark(), text)->text(), text);
  const auto refused = [&](std::size_t at, std::string_view bytes) {
    std::string other = text;
    other.replace(at, bytes.size(), bytes);
    return !GroundCheckpoint::read(good->mark(), other).ok();
  };
  using namespace std::string_view_literals;
  EXPECT_TRUE(refused(0, "\x21"sv)) << "no power of two";
  EXPECT_TRUE(refused(0, "\0\0\0\x40"sv)) << "a patch beyond all memory";
  EXPECT_TRUE(refused(12, "\0\0\0\0\0\0\xf0\x7f"sv)) << "infinite volume";
  EXPECT_TRUE(refused(20, "\0\0\0\0\0\0\xf0\xbf"sv)) << "a size below 0";
  EXPECT_TRUE(refused(52, "\xff\xff\xff\xff"sv)) << "more samples than there are";
  EXPECT_TRUE(refused(56, "\0\x04\0\0"sv)) << "a sample beyond its patch";
  EXPECT_TRUE(refused(60, "\0\0\xc0\x7f"sv)) << "NaN";
  EXPECT_TRUE(refused(64, "\0\0\x80\x7f"sv)) << "infinity";
  EXPECT_TRUE(refused(36, "\x09"sv)) << "patches out of order";
  EXPECT_TRUE(refused(28, "\x07"sv)) << "more patches than there are";
  EXPECT_TRUE(refused(text.size() - 4, "\0\0\x80\xbf"sv)) << "less than nothing is loose";
  EXPECT_TRUE(refused(text.size() - 4, "\0\0\x80\x7f"sv)) << "infinitely much is";
  EXPECT_TRUE(refused(text.size() - 8, "\0\x04\0\0"sv)) << "beyond its patch";
  EXPECT_TRUE(refused(0, "\0\4"sv)) << "a patch of no world";
  // Patches of a sample each, of the largest side, as many as wanted, changed or loose.
  const auto sparse = [](std::uint32_t changed, std::uint32_t loose) {
    const auto number = [](std::uint32_t n) {
      return std::string{static_cast<char>(n), static_cast<char>(n >> 8)};
    };
    std::string all =
        std::string("\0\2\0\0"sv) + std::string(24, '\0') + number(changed) + std::string(6, '\0');
    for (const auto& [count, bytes] : {std::pair(changed, 32), std::pair(loose, 28)}) {
      for (std::uint32_t k = 0; k < count; ++k) {
        std::string patch(static_cast<std::size_t>(bytes), '\0');
        patch.replace(8, 2, number(k));
        patch[16] = 1;
        patch[27] = 0x40;
        all += patch;
      }
    }
    return all;
  };
  const auto isRead = [&](const std::string& bytes) {
    return GroundCheckpoint::read(good->mark(), bytes).ok();
  };
  EXPECT_FALSE(isRead(sparse(1100, 0)));
  EXPECT_FALSE(isRead(sparse(1000, 200))) << "of both together";
  EXPECT_FALSE(isRead(sparse(0, 2100)));
  EXPECT_TRUE(isRead(sparse(3, 0)));
  EXPECT_TRUE(isRead(sparse(1, 1)));
  for (const std::size_t at : {std::size_t{36 + 14}, std::size_t{36 + 32 + 14}}) {
    std::string beyond = sparse(1, 1);
    beyond[at] = 0x11;
    EXPECT_FALSE(isRead(beyond)) << "beyond the world";
  }
  for (std::size_t size = 0; size < text.size(); size += 13) {
    const auto cut = GroundCheckpoint::read(good->mark(), std::string_view(text).substr(0, size));
    EXPECT_TRUE(!cut || cut->text().size() == size) << size;
  }
  RandomSequence random(3);
  for (int round = 0; round < 3000; ++round) {
    std::string flipped = text;
    flipped[random.next() % text.size()] ^= static_cast<char>(1 << random.nextBits(3));
    const auto read = GroundCheckpoint::read(good->mark(), flipped);
    EXPECT_TRUE(!read || read->text().size() <= text.size());
  }
}

TEST(EditJournal, SaysTheSameInLessRoomAfterItWasCompacted) {
  const ScratchFolder folder;
  const auto file = folder / "land.edits";
  write(file, 0);
  EditHistory expected;
  {
    const auto journal = opened(file);
    for (std::uint64_t k = 1; k <= 3000; ++k) {
      journal->append(numbered(k));
      expected.press(numbered(k));
      if (k % 10 != 0) journal->appendUndo(), expected.undo();
    }
    for (int k = 0; k < 3; ++k) journal->appendUndo(), expected.undo();
    ASSERT_TRUE(journal->flush());
  }
  ASSERT_EQ(expected.edits.size(), 297U);
  ASSERT_EQ(expected.undone.size(), 3U);
  const auto before = std::filesystem::file_size(file);
  const auto ground = someGround();
  {
    const auto journal = opened(file);
    EXPECT_EQ(journal->found(), expected);
    const Result<void> compacted = journal->compact(ground);
    ASSERT_TRUE(compacted) << compacted.error().message;
    EXPECT_EQ(journal->record().entries, 303U);
    // It goes on from there.
    EXPECT_EQ(journal->appendRedo(), 304U);
    expected.redo();
  }
  const auto read = EditJournal::read(file, kWorld);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_FALSE(read->damage) << read->damage->message;
  EXPECT_EQ(read->history, expected);
  EXPECT_EQ(read->entries, 304U);
  ASSERT_TRUE(read->checkpoint);
  EXPECT_EQ(read->checkpoint->text(), ground->text());
  EXPECT_LT(std::filesystem::file_size(file), before / 2 + ground->text().size());
  EXPECT_EQ(namesIn(folder.path()), std::vector<std::string>{"land.edits"});
}

TEST(EditJournal, IsNotCompactedWithWhatWasAppendedSinceItWasOpened) {
  const ScratchFolder folder;
  const auto file = folder / "land.edits";
  write(file, 3);
  {
    const auto journal = opened(file);
    journal->append(numbered(4));
    const Result<void> refused = journal->compact(nullptr);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().message,
              "cannot write \"" + file.string() + "\": entries were appended since it was opened");
  }
  expectRead(file, 4);
}

TEST(EditJournal, HasNoMoreEntriesThanCanBeRead) {
  const ScratchFolder folder;
  Result<Database> database = Database::open(folder / "land.edits", true);
  ASSERT_TRUE(database);
  ASSERT_TRUE(beginJournal(*database, kWorld));
  const std::vector<std::string> one(1, editText(numbered(1))), two(2, editText(numbered(1)));
  const auto refused = appendEntries(*database, {kMostEdits - 1, 0}, two);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message,
            "it would have more than 10000000 entries (teren edits compact leaves out what undo made void)");
  const auto appended = appendEntries(*database, {kMostEdits - 1, 0}, one);
  ASSERT_TRUE(appended);
  EXPECT_EQ(appended->entries, kMostEdits);
}

TEST(EditJournal, IsWholeBesideAReaderAndOnAFullDiskWhileItIsCompacted) {
  const ScratchFolder folder;
  const auto file = folder / "land.edits";
  write(file, 3000);
  const int answer = inAnotherProcess([&] {
    const auto journal = EditJournal::open(file, kWorld);
    if (!journal) return 1;
    fillDisk(4096);
    if ((*journal)->compact(nullptr)) return 2;
    const auto read = EditJournal::read(file, kWorld);
    if (!read || read->damage || read->history.edits != numberedUpTo(3000)) return 3;
    freeDisk();
    (*journal)->append(numbered(3001));
    return (*journal)->flush() ? 0 : 4;
  });
  EXPECT_EQ(answer, 0);
  expectRead(file, 3001);
}

TEST(EditJournal, CutAnywhereGivesNothingButEditsThatWereThere) {
  const ScratchFolder folder;
  write(folder / "land.edits", 400);
  opened(folder / "land.edits")->keep(someGround());
  const std::string bytes = fileBytes(folder / "land.edits");
  const std::vector<Edit> all = numberedUpTo(400);
  std::size_t refusals = 0, tried = 0;
  for (std::size_t size = 1; size < bytes.size(); size += 509) {
    folder.write("cut", bytes.substr(0, size));
    const auto read = EditJournal::read(folder / "cut", kWorld);
    ++tried;
    const bool isRefused = !read || read->damage;
    // What was cut off may be of the ground that it keeps alone.
    ASSERT_TRUE(isRefused || (read->withoutCheckpoint && read->history.edits == all)) << size;
    refusals += isRefused ? 1 : 0;
    EXPECT_TRUE(!read || std::equal(read->history.edits.begin(), read->history.edits.end(), all.begin()))
        << size;
    EXPECT_EQ(complaintOfOpening(folder / "cut") != "none", isRefused);
    EXPECT_EQ(fileBytes(folder / "cut"), bytes.substr(0, size));
  }
  EXPECT_GT(refusals, tried * 9 / 10);
}

TEST(EditJournal, WithAnyBitFlippedGivesAllEditsOrSaysWhatIsWrong) {
  const ScratchFolder folder;
  write(folder / "land.edits", 120);
  opened(folder / "land.edits")->keep(someGround(1, 2));
  const std::string bytes = fileBytes(folder / "land.edits");
  const std::vector<Edit> all = numberedUpTo(120);
  RandomSequence random(11);
  const int rounds = std::getenv("TEREN_FULL") != nullptr ? 4000 : 500;
  int noticed = 0;
  for (int round = 0; round < rounds; ++round) {
    std::string flipped = bytes;
    flipped[random.next() % bytes.size()] ^= static_cast<char>(1 << random.nextBits(3));
    folder.write("flipped", flipped);
    const auto read = EditJournal::read(folder / "flipped", kWorld);
    noticed += read && !read->damage && read->withoutCheckpoint ? 1 : 0;
    if (!read || read->damage) {
      ++noticed;
      const std::string sentence = read ? read->damage->message : read.error().message;
      EXPECT_EQ(sentence.find('\n'), std::string::npos);
      EXPECT_EQ(fileBytes(folder / "flipped"), flipped);
    }
    if (!read) continue;
    ASSERT_LE(read->history.edits.size(), all.size());
    EXPECT_TRUE(std::equal(read->history.edits.begin(), read->history.edits.end(), all.begin()));
    EXPECT_TRUE(read->damage || read->history.edits.size() == all.size()) << "round " << round;
    std::filesystem::remove(folder / "flipped-wal");
    std::filesystem::remove(folder / "flipped-shm");
  }
  EXPECT_GT(noticed, rounds / 4);
}

TEST(EditJournal, GoesOnInMemoryWhereTheDiskIsFullAndWritesAllOnceThereIsRoom) {
  const ScratchFolder folder;
  const auto file = folder / "land.edits";
  write(file, 10);
  const int answer = inAnotherProcess([&] {
    const auto journal = EditJournal::open(file, kWorld);
    if (!journal) return 1;
    fillDisk(std::filesystem::file_size(file) + 40'000);
    for (std::uint64_t number = 11; number <= 5000; ++number) {
      (*journal)->append(numbered(number));
      if (number % 100 == 0) (void)(*journal)->flush();
    }
    const Result<void> flushed = (*journal)->flush();
    if (flushed || (*journal)->acknowledged() != 5000) return 2;
    const auto message = (*journal)->takeMessage();
    if (!message || message->find("edits are kept in memory only") == std::string::npos) return 3;
    if (message->find('\n') != std::string::npos || (*journal)->takeMessage()) return 4;
    // What is there meanwhile is good, and a part of the list.
    const auto read = EditJournal::read(file, kWorld);
    if (!read || read->damage || read->history.edits.size() < 10 || read->history.edits.size() >= 5000)
      return 5;
    if (read->history.edits != numberedUpTo(read->history.edits.size())) return 6;
    freeDisk();
    if (!(*journal)->flush()) return 7;
    const std::string again = "\"" + file.string() + "\" can be written again, and has all edits";
    if ((*journal)->takeMessage() != again || (*journal)->takeMessage()) return 8;
    (*journal)->append(numbered(5001));
    if (!(*journal)->flush() || (*journal)->takeMessage()) return 9;
    // Full once more, which is told once more.
    fillDisk(std::filesystem::file_size(file));
    for (std::uint64_t number = 5002; number <= 12'000; ++number) (*journal)->append(numbered(number));
    if ((*journal)->flush() || !(*journal)->takeMessage()) return 10;
    freeDisk();
    return (*journal)->flush() ? 0 : 11;
  });
  EXPECT_EQ(answer, 0);
  expectRead(file, 12'000);
}

TEST(EditJournal, ForgetsWhatItIsToldToAbandonAndGoesOn) {
  const ScratchFolder folder;
  const auto file = folder / "land.edits";
  write(file, 10);
  const int answer = inAnotherProcess([&] {
    const auto journal = EditJournal::open(file, kWorld);
    if (!journal) return 1;
    fillDisk(std::filesystem::file_size(file) + 40'000);
    (*journal)->append(std::vector<Edit>(5000, numbered(1)));
    if ((*journal)->flush()) return 2;
    const std::string why = (*journal)->abandon().message;
    if (why.find("cannot write \"" + file.string() + "\": ") != 0) return 3;
    freeDisk();
    (*journal)->append(numbered(11));
    return (*journal)->flush() ? 0 : 4;
  });
  EXPECT_EQ(answer, 0);
  expectRead(file, 11);
}

TEST(EditJournal, GoesOnInMemoryOnMediaThatAreReadOnly) {
  const ScratchFolder folder;
  const auto file = folder / "land.edits";
  write(file, 10);
  chmod(file.c_str(), 0444);
  chmod(folder.path().c_str(), 0555);
  const std::string before = fileBytes(file);
  const int answer = inAnotherProcess([&] {
    if (getuid() == 0 && (setgid(65534) != 0 || setuid(65534) != 0))
      return 1;  // to whom nothing is forbidden
    const auto read = EditJournal::read(file, kWorld);
    if (!read || read->damage || read->history.edits != numberedUpTo(10)) return 2;
    for (const auto& name : {file, folder / "new.edits"}) {
      const auto journal = EditJournal::open(name, kWorld);
      if (!journal) return 3;
      if ((*journal)->found().edits.size() != (name == file ? 10U : 0U)) return 4;
      const std::uint64_t last = (*journal)->append(numbered((*journal)->found().edits.size() + 1));
      if ((*journal)->flush() || (*journal)->acknowledged() != last) return 5;
      const auto message = (*journal)->takeMessage();
      const std::string expected =
          "cannot write \"" + name.string() + "\": Permission denied; edits are kept in memory only";
      if (message != expected || (*journal)->takeMessage()) return 6;
    }
    return 0;
  });
  chmod(folder.path().c_str(), 0755);
  EXPECT_EQ(answer, 0);
  EXPECT_EQ(fileBytes(file), before);
  EXPECT_EQ(namesIn(folder.path()), std::vector<std::string>{"land.edits"});
}

}  // namespace
}  // namespace teren
