// The edits of a world in a file that outlives the program, a crash of it included.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "teren/Edit.h"
#include "teren/Result.h"

namespace teren {

class GroundCheckpoint;

/// What a journal holds; where it is damaged the longest part before the damage that is proved good, and in
/// one sentence what is wrong with the rest.
struct EditRecord {
  EditHistory history;
  std::uint64_t entries = 0;  ///< edits, undos and redos that made it
  /// The ground after some of the edits (EditedGround::adopt), where the journal has it.
  std::shared_ptr<const GroundCheckpoint> checkpoint;
  /// Why there is none, in one sentence, where what the journal has is not what was written.
  std::optional<Error> withoutCheckpoint;
  std::optional<Error> damage;
};

/// An SQLite database (write-ahead log, synchronous = NORMAL) of one world's edits, and of what was undone
/// and redone: entries, one after the other. One program writes it at a time, any number read it meanwhile. A
/// thread of its own writes, everything that has come since it last wrote in one transaction, so nobody waits
/// for a disk.
///
/// What survives: the death of the program (kill -9) loses no entry that was acknowledged, and never half a
/// one. A power cut may lose the latest ones, and keeps all before them. Every entry carries a checksum over
/// itself and all before it, and the journal their number, so lost, changed and exchanged ones are found.
/// What cannot be written (a full disk, media that are read-only, more than kMostEdits entries) is told once,
/// goes on in memory, and is tried again with later entries; that it is written then is told, too. What the
/// file holds stays good. A file with anything wrong is refused and
/// left as it is.
///
/// `worldHash` is the world's descriptionHash(). All member functions from one thread at a time.
class EditJournal {
 public:
  /// Of the file's form; another one is refused by its number.
  static constexpr std::int64_t kVersion = 3;

  /// What becomes of a journal that another program is writing: it is refused, or read, and what is appended
  /// is kept in memory.
  enum class Shared { refused, inMemory };

  /// Opens for writing; a file that is not there is begun. Refuses: no edit journal, one of another world or
  /// version, one that is damaged, one that another program is writing (unless `shared`), names that are no
  /// regular file's.
  static Result<std::unique_ptr<EditJournal>> open(const std::filesystem::path& file, std::uint64_t worldHash,
                                                   Shared shared = Shared::refused);
  /// Reads without changing what the journal says, also while another program writes: the entries up to one
  /// moment. Refuses likewise, but a damaged journal, and one that is not there. About 2 us an edit.
  static Result<EditRecord> read(const std::filesystem::path& file, std::uint64_t worldHash);

  /// Writes what is still to be written, and ends.
  ~EditJournal();
  EditJournal(const EditJournal&) = delete;
  EditJournal& operator=(const EditJournal&) = delete;

  /// What was there when it was opened.
  const EditHistory& found() const noexcept { return found_.history; }
  const EditRecord& record() const noexcept { return found_; }

  /// Hands an edit to the thread that writes, and returns its number in the journal, from 1. `edit` has
  /// passed checkEdit (assert). Microseconds; waits for nothing.
  std::uint64_t append(const Edit& edit) { return append(std::span(&edit, 1)); }
  /// The same of several, which come into the file all together or not at all; the last one's number.
  std::uint64_t append(std::span<const Edit> edits);
  /// The same of an entry that takes the latest edit back, and of one that lets the latest that was taken
  /// back count again; there is one (the caller's to know).
  std::uint64_t appendUndo();
  std::uint64_t appendRedo();
  /// Keeps ground beside the edits that made it, or none where it is null, instead of what was kept before,
  /// so that who reads the journal need not apply them again; one too large to be read is none. Written after
  /// all that was appended; where that cannot be done, the edits still say everything.
  void keep(std::shared_ptr<const GroundCheckpoint> checkpoint);
  /// Leaves out what undo made void, and gives the room back, with ground to be kept (or null). Refuses where
  /// something was appended. What the journal says stays the same, and it is whole at every moment: all is
  /// done in one transaction. Waits.
  Result<void> compact(std::shared_ptr<const GroundCheckpoint> checkpoint);
  /// All entries up to this number may be shown: they are in the file, or it was told that they cannot be.
  std::uint64_t acknowledged() const noexcept;
  /// Waits until all entries are acknowledged; refuses where not all of them are in the file.
  Result<void> flush();
  /// Forgets what is not in the file after a flush that was refused, so that it never will be; says why not.
  Error abandon();
  /// Why edits are kept in memory only, or that they are in the file again; one sentence, once.
  std::optional<std::string> takeMessage();

 private:
  class Writer;
  EditJournal(std::uint64_t worldHash, EditRecord found, std::unique_ptr<Writer> writer);

  std::uint64_t worldHash_;
  EditRecord found_;
  std::unique_ptr<Writer> writer_;
};

}  // namespace teren
