#include "edits/JournalFile.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <memory>
#include <string_view>
#include <system_error>
#include <unistd.h>
#include <utility>
#include <vector>

#include "teren/Hash.h"
#include "teren/Quote.h"

namespace teren {

namespace {

constexpr std::int64_t kApplication = 0x54456472;  // "TEdr"

/// The tables, by name; SQLite keeps the words as they are, so they can be compared.
struct Table {
  std::string_view name, statement;
};
constexpr std::array kTables = {
    Table{"checkpoint",
          "CREATE TABLE checkpoint (edits INTEGER NOT NULL, list INTEGER NOT NULL, bytes INTEGER NOT NULL, "
          "checksum INTEGER NOT NULL)"},
    Table{"entry",
          "CREATE TABLE entry (number INTEGER PRIMARY KEY, text TEXT NOT NULL, checksum INTEGER NOT NULL)"},
    Table{"journal",
          "CREATE TABLE journal (world INTEGER NOT NULL, entries INTEGER NOT NULL, checksum INTEGER NOT "
          "NULL)"},
    Table{"piece", "CREATE TABLE piece (number INTEGER PRIMARY KEY, bytes BLOB NOT NULL)"}};

// SQLite's whole numbers are signed.
std::int64_t kept(std::uint64_t word) {
  return std::bit_cast<std::int64_t>(word);
}
std::uint64_t word(std::int64_t number) {
  return std::bit_cast<std::uint64_t>(number);
}

std::string hexText(std::uint64_t hash) {
  std::array<char, 16> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), hash, 16).ptr;
  std::string text(digits.data(), end);
  return std::string(16 - text.size(), '0') + text;
}

/// Ends what was begun, whatever happens.
class Transaction {
 public:
  explicit Transaction(Database& database) : database_(database) {}
  ~Transaction() {
    if (database_.inTransaction()) (void)database_.execute("ROLLBACK");
  }
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  Result<void> begin(const char* statement) { return database_.execute(statement); }
  Result<void> commit() { return database_.execute("COMMIT"); }

 private:
  Database& database_;
};

/// Whether the tables are a journal's, to the letter, and nothing else is there that a statement could meet.
Result<bool> hasTables(Database& database) {
  Result<Statement> schema = database.prepare("SELECT name, sql FROM sqlite_schema ORDER BY name");
  if (!schema) return schema.error();
  std::size_t found = 0;
  for (;;) {
    const Result<bool> row = schema->step();
    if (!row) return row.error();
    if (!*row) return found == kTables.size();
    const bool fits = found < kTables.size() && schema->text(0) == kTables[found].name &&
                      schema->text(1) == kTables[found].statement;
    if (!fits) return false;
    ++found;
  }
}

struct Head {
  bool isNew = false;
  std::uint64_t world = 0;
  JournalEnd end;
};

/// What kind of file it is. SQLite's own complaints come as they are.
Result<Head> readHead(Database& database) {
  const Result<std::int64_t> application = database.number("PRAGMA application_id");
  if (!application) return application.error();
  const Result<std::int64_t> version = database.number("PRAGMA user_version");
  if (!version) return version.error();
  const Result<std::int64_t> objects = database.number("SELECT count(*) FROM sqlite_schema");
  if (!objects) return objects.error();
  if (*application == 0 && *version == 0 && *objects == 0) return Head{true, 0, {}};
  if (*application != kApplication) return Error{"it is a database of another program"};
  if (*version != EditJournal::kVersion) {
    return Error{"it is of version " + std::to_string(*version) + ", expected " +
                 std::to_string(EditJournal::kVersion) +
                 (*version > EditJournal::kVersion ? "; a newer Teren has made it" : "")};
  }
  const Result<bool> tables = hasTables(database);
  if (!tables) return tables.error();
  if (!*tables) return Error{"its tables are not those of an edit journal"};
  Result<Statement> head = database.prepare("SELECT world, entries, checksum FROM journal");
  if (!head) return head.error();
  const Result<bool> row = head->step();
  if (!row) return row.error();
  if (!*row || !head->isWhole(0) || !head->isWhole(1) || !head->isWhole(2) || head->whole(1) < 0) {
    return Error{"it does not say how many entries it has"};
  }
  return Head{false, word(head->whole(0)), {word(head->whole(1)), word(head->whole(2))}};
}

/// The entries as far as they are good; what is wrong with the first that is not, in the sentence's words.
struct Prefix {
  EditHistory history;
  JournalEnd end;
  std::optional<std::string> wrong;
};

Prefix readEntries(Database& database, std::uint64_t worldHash) {
  Prefix good{{}, JournalEnd::ofNone(worldHash), std::nullopt};
  const auto stop = [&](const std::string& what) {
    good.wrong = what;
    return std::move(good);
  };
  Result<Statement> rows = database.prepare("SELECT number, text, checksum FROM entry ORDER BY number");
  if (!rows) return stop("cannot be read (" + rows.error().message + ")");
  for (;;) {
    const Result<bool> row = rows->step();
    if (!row) return stop("cannot be read (" + row.error().message + ")");
    if (!*row) return good;
    if (word(rows->whole(0)) != good.end.entries + 1) return stop("is missing");
    if (good.end.entries == kMostEdits) return stop("is one more than there may be");
    if (!rows->isText(1) || !rows->isWhole(2)) return stop("is no text with a checksum");
    const std::string_view text = rows->text(1);
    const JournalEnd end = good.end.followedBy(text);
    if (word(rows->whole(2)) != end.checksum) return stop("does not fit its checksum");
    if (text == kUndoEntry) {
      if (!good.history.undo()) return stop("takes an edit back where there is none");
    } else if (text == kRedoEntry) {
      if (!good.history.redo()) return stop("brings an edit back where none was taken back");
    } else {
      Result<Edit> edit = parseEdit(text);
      if (!edit) return stop("is no edit: " + edit.error().message);
      good.history.press(*std::move(edit));
    }
    good.end = end;
  }
}

constexpr std::size_t kPieceBytes = std::size_t{1} << 18;  // of a checkpoint, in a row
constexpr std::int64_t kMostCheckpointBytes = std::int64_t{1} << 32;

std::uint64_t checksumOf(const EditListMark& mark, std::string_view text) {
  return hashWith(hashWith(hashText(text), mark.edits), mark.checksum);
}

/// None where there is none; refuses one that is not what was written.
Result<std::shared_ptr<const GroundCheckpoint>> readCheckpoint(Database& database) {
  Result<Statement> head = database.prepare("SELECT edits, list, bytes, checksum FROM checkpoint");
  if (!head) return head.error();
  const Result<bool> row = head->step();
  if (!row) return row.error();
  if (!*row) return std::shared_ptr<const GroundCheckpoint>();
  for (int column = 0; column < 4; ++column) {
    if (!head->isWhole(column)) return Error{"it does not say what it is of"};
  }
  const EditListMark mark{word(head->whole(0)), word(head->whole(1))};
  const std::int64_t bytes = head->whole(2);
  if (bytes < 0 || bytes > kMostCheckpointBytes) return Error{"it does not say how large it is"};
  std::string text;
  Result<Statement> pieces = database.prepare("SELECT bytes FROM piece ORDER BY number");
  if (!pieces) return pieces.error();
  for (;;) {
    const Result<bool> piece = pieces->step();
    if (!piece) return piece.error();
    if (!*piece) break;
    if (pieces->isBytes(0)) text += pieces->bytes(0);
    if (text.size() > static_cast<std::size_t>(bytes)) break;
  }
  if (text.size() != static_cast<std::size_t>(bytes)) return Error{"it is not whole"};
  if (checksumOf(mark, text) != word(head->whole(3))) return Error{"it does not fit its checksum"};
  Result<GroundCheckpoint> checkpoint = GroundCheckpoint::read(mark, text);
  if (!checkpoint) return checkpoint.error();
  return std::shared_ptr<const GroundCheckpoint>(
      std::make_shared<const GroundCheckpoint>(*std::move(checkpoint)));
}

/// Within a transaction.
Result<void> writeCheckpoint(Database& database, const GroundCheckpoint* checkpoint) {
  if (Result<void> gone = database.execute("DELETE FROM checkpoint; DELETE FROM piece"); !gone) return gone;
  if (checkpoint == nullptr || checkpoint->bytes() > GroundCheckpoint::kMostBytes) return {};
  const std::string text = checkpoint->text();
  Result<Statement> piece = database.prepare("INSERT INTO piece VALUES (?1, ?2)");
  if (!piece) return piece.error();
  for (std::size_t at = 0, number = 1; at < text.size(); at += kPieceBytes, ++number) {
    piece->bind(1, kept(number));
    piece->bindBytes(2, std::string_view(text).substr(at, kPieceBytes));
    if (const Result<bool> done = piece->step(); !done) return done.error();
    piece->reset();
  }
  Result<Statement> head = database.prepare("INSERT INTO checkpoint VALUES (?1, ?2, ?3, ?4)");
  if (!head) return head.error();
  head->bind(1, kept(checkpoint->mark().edits));
  head->bind(2, kept(checkpoint->mark().checksum));
  head->bind(3, kept(text.size()));
  head->bind(4, kept(checksumOf(checkpoint->mark(), text)));
  if (const Result<bool> done = head->step(); !done) return done.error();
  return {};
}

/// Within a transaction.
Result<JournalEnd> writeEntries(Database& database, const JournalEnd& end,
                                std::span<const std::string> texts) {
  Result<Statement> insert = database.prepare("INSERT INTO entry VALUES (?1, ?2, ?3)");
  if (!insert) return insert.error();
  JournalEnd reached = end;
  for (const std::string& text : texts) {
    reached = reached.followedBy(text);
    insert->bind(1, kept(reached.entries));
    insert->bind(2, text);
    insert->bind(3, kept(reached.checksum));
    if (const Result<bool> done = insert->step(); !done) return done.error();
    insert->reset();
  }
  Result<Statement> head = database.prepare("UPDATE journal SET entries = ?1, checksum = ?2");
  if (!head) return head.error();
  head->bind(1, kept(reached.entries));
  head->bind(2, kept(reached.checksum));
  if (const Result<bool> done = head->step(); !done) return done.error();
  return reached;
}

/// Not opened to look: closing it again would let go of the locks of all connections that this program has to
/// it (POSIX), and who comes next would take the log from under a writer.
bool hasAPage(const std::filesystem::path& file) {
  constexpr std::uintmax_t kSmallestPage = 512;
  std::error_code problem;
  return std::filesystem::file_size(file, problem) >= kSmallestPage && !problem;
}

bool isEmptyOrAbsent(const std::filesystem::path& file) {
  std::error_code problem;
  const auto size = std::filesystem::file_size(file, problem);
  return problem || size == 0;
}

}  // namespace

JournalEnd JournalEnd::ofNone(std::uint64_t worldHash) noexcept {
  return {0, hashWith(hashText("teren edit journal 2"), worldHash)};
}

JournalEnd JournalEnd::followedBy(std::string_view text) const noexcept {
  return {entries + 1, hashWith(hashWith(checksum, entries + 1), hashText(text))};
}

Error notAJournal(const std::string& name, const std::string& why) {
  return {inQuotes(name) + " is not an edit journal that can be read: " + why};
}

Result<Database> openJournal(const std::filesystem::path& file) {
  // What is shorter than a page SQLite would take for an empty database, and write over it.
  if (!isEmptyOrAbsent(file) && !hasAPage(file)) return Error{"file is not a database"};
  Result<Database> database = Database::open(file, false);
  if (database && database->number("SELECT count(*) FROM sqlite_schema")) return database;
  // Beside a file that nothing can be written to, SQLite cannot share a log: there must be none.
  const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
  if (access(folder.c_str(), W_OK) == 0) return database;
  if (isEmptyOrAbsent(file.string() + "-wal")) return Database::openUnchanging(file);
  return Error{"nothing can be written beside it, and its latest edits are still in " +
               inQuotes(file.filename().string() + "-wal") + ": copy both"};
}

Result<JournalContent> readJournal(Database& database, const std::string& name, std::uint64_t worldHash) {
  Transaction transaction(database);
  if (const Result<void> begun = transaction.begin("PRAGMA cell_size_check = ON; BEGIN"); !begun) {
    return notAJournal(name, begun.error().message);
  }
  const Result<Head> head = readHead(database);
  if (!head) return notAJournal(name, head.error().message);
  if (head->isNew) return JournalContent{{}, JournalEnd::ofNone(worldHash), true};
  if (head->world != worldHash) {
    return Error{inQuotes(name) + " has the edits of another world (its hash is " + hexText(head->world) +
                 "), expected " + hexText(worldHash)};
  }
  Prefix good = readEntries(database, worldHash);
  const std::uint64_t count = good.end.entries;
  if (!good.wrong && count < head->end.entries) good.wrong = "is missing";
  if (!good.wrong && count > head->end.entries) good.wrong = "is not counted";
  if (!good.wrong && good.end.checksum != head->end.checksum) good.wrong = "does not fit the last checksum";
  JournalContent content;
  content.record.history = std::move(good.history);
  content.record.entries = count;
  content.end = good.end;
  Result<std::shared_ptr<const GroundCheckpoint>> checkpoint = readCheckpoint(database);
  if (checkpoint) {
    content.record.checkpoint = *std::move(checkpoint);
  } else {
    content.record.withoutCheckpoint =
        Error{"the ground that " + inQuotes(name) + " keeps is ignored: " + checkpoint.error().message +
              "; its edits are applied again"};
  }
  if (good.wrong) {
    // All are good by themselves: then it is the first that was not counted, or the last.
    const bool isCount = count > head->end.entries;
    const std::uint64_t first =
        isCount ? head->end.entries + 1 : std::min(count + 1, std::max(head->end.entries, std::uint64_t{1}));
    content.record.damage = Error{inQuotes(name) + " is damaged: entry " + std::to_string(first) + " of " +
                                  std::to_string(head->end.entries) + " " + *good.wrong + "; " +
                                  std::to_string(count) + " entries from the first on are good"};
  }
  return content;
}

Result<void> beginJournal(Database& database, std::uint64_t worldHash) {
  if (Result<void> set = database.execute("PRAGMA journal_mode = WAL; PRAGMA synchronous = NORMAL"); !set)
    return set;
  Transaction transaction(database);
  std::string statements = "BEGIN IMMEDIATE;";
  for (const Table& table : kTables) statements += std::string(table.statement) + ";";
  const JournalEnd none = JournalEnd::ofNone(worldHash);
  statements += "INSERT INTO journal VALUES (" + std::to_string(kept(worldHash)) + ", 0, " +
                std::to_string(kept(none.checksum)) + ");";
  statements += "PRAGMA application_id = " + std::to_string(kApplication) + ";";
  statements += "PRAGMA user_version = " + std::to_string(EditJournal::kVersion) + ";";
  if (Result<void> made = database.execute(statements.c_str()); !made) return made;
  return transaction.commit();
}

Result<JournalEnd> appendEntries(Database& database, const JournalEnd& end,
                                 std::span<const std::string> texts) {
  if (texts.size() > kMostEdits || end.entries > kMostEdits - texts.size()) {
    return Error{"it would have more than " + std::to_string(kMostEdits) +
                 " entries (teren edits compact leaves out what undo made void)"};
  }
  Transaction transaction(database);
  if (const Result<void> begun = transaction.begin("BEGIN IMMEDIATE"); !begun) return begun.error();
  Result<JournalEnd> reached = writeEntries(database, end, texts);
  if (!reached) return reached;
  if (const Result<void> committed = transaction.commit(); !committed) return committed.error();
  return reached;
}

Result<void> keepCheckpoint(Database& database, const GroundCheckpoint* checkpoint) {
  Transaction transaction(database);
  if (const Result<void> begun = transaction.begin("BEGIN IMMEDIATE"); !begun) return begun.error();
  if (const Result<void> written = writeCheckpoint(database, checkpoint); !written) return written.error();
  return transaction.commit();
}

Result<JournalEnd> compactJournal(Database& database, std::uint64_t worldHash, const EditHistory& history,
                                  const GroundCheckpoint* checkpoint) {
  std::vector<std::string> texts;
  for (const Edit& edit : history.edits) texts.push_back(editText(edit));
  // What can be redone comes and goes again.
  for (auto edit = history.undone.rbegin(); edit != history.undone.rend(); ++edit)
    texts.push_back(editText(*edit));
  texts.insert(texts.end(), history.undone.size(), std::string(kUndoEntry));
  Transaction transaction(database);
  const Result<void> begun = transaction.begin("BEGIN IMMEDIATE; DELETE FROM entry");
  if (!begun) return begun.error();
  Result<JournalEnd> reached = writeEntries(database, JournalEnd::ofNone(worldHash), texts);
  if (!reached) return reached;
  if (const Result<void> written = writeCheckpoint(database, checkpoint); !written) return written.error();
  if (const Result<void> committed = transaction.commit(); !committed) return committed.error();
  // That the room is not given back breaks no promise.
  (void)database.execute("VACUUM; PRAGMA wal_checkpoint(TRUNCATE)");
  return reached;
}

}  // namespace teren
