// How an edit journal lies in its database: its tables, its checksums, and all that may be wrong with them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "teren/EditJournal.h"

#include "edits/Database.h"
#include "edits/GroundCheckpoint.h"

namespace teren {

/// What an entry that is no edit says.
inline constexpr std::string_view kUndoEntry = "undo", kRedoEntry = "redo";

/// Where a journal ends: what the next entry's number and checksum follow from.
struct JournalEnd {
  std::uint64_t entries = 0;
  std::uint64_t checksum = 0;

  /// Before the first entry of a world's journal.
  static JournalEnd ofNone(std::uint64_t worldHash) noexcept;
  JournalEnd followedBy(std::string_view text) const noexcept;
};

struct JournalContent {
  EditRecord record;
  JournalEnd end;
  bool isNew = false;  ///< an empty database: nothing has been written yet
};

/// "NAME is not an edit journal that can be read: WHY".
Error notAJournal(const std::string& name, const std::string& why);

/// Opens a journal that is there, on read-only media too. Errors are for
/// notAJournal.
Result<Database> openJournal(const std::filesystem::path& file);

/// Reads and checks everything, at one moment. `name` is the file's, for sentences.
Result<JournalContent> readJournal(Database& database, const std::string& name, std::uint64_t worldHash);

/// Makes an empty database a journal, in one transaction.
Result<void> beginJournal(Database& database, std::uint64_t worldHash);

/// Exchanges the checkpoint for another one, or none, in one transaction.
Result<void> keepCheckpoint(Database& database, const GroundCheckpoint* checkpoint);

/// Exchanges the entries for the fewest that say the same, and the checkpoint, in one transaction; then gives
/// the room that is free back. Where the journal ends then.
Result<JournalEnd> compactJournal(Database& database, std::uint64_t worldHash, const EditHistory& history,
                                  const GroundCheckpoint* checkpoint);

/// Adds entries, in one transaction: all or none. Where the journal ends then.
Result<JournalEnd> appendEntries(Database& database, const JournalEnd& end,
                                 std::span<const std::string> texts);

}  // namespace teren
