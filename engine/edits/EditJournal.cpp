#include "teren/EditJournal.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <iterator>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>

#include "teren/Quote.h"

#include "edits/JournalFile.h"
#include "edits/WriterLock.h"

namespace teren {

namespace {

/// How long a file that could not be written is left alone, unless somebody waits.
constexpr std::chrono::seconds kBeforeAnotherTry(1);

/// A file of no kind that could be a journal: a folder, a device, a name the system would cut short.
std::optional<Error> wrongFile(const std::filesystem::path& file) {
  std::error_code problem;
  const bool cutShort = file.native().find('\0') != std::string::npos;
  const std::filesystem::file_status status = std::filesystem::status(file, problem);
  const bool other = std::filesystem::exists(status) && !std::filesystem::is_regular_file(status);
  if (!cutShort && !other && !file.empty()) return std::nullopt;
  return Error{inQuotes(file.string()) + " is not a file, expected an edit journal"};
}

/// The file's name, links followed, so that all who mean one file lock one name.
std::filesystem::path target(const std::filesystem::path& file) {
  std::error_code problem;
  std::filesystem::path followed = std::filesystem::weakly_canonical(file, problem);
  return problem ? file : followed;
}

Error cannotWrite(const std::string& name, const std::string& why) {
  return {"cannot write " + inQuotes(name) + ": " + why};
}

Error inMemoryOnly(const std::string& name, const std::string& why) {
  return {cannotWrite(name, why).message + "; edits are kept in memory only"};
}

std::string inFileAgain(const std::string& name) {
  return inQuotes(name) + " can be written again, and has all edits";
}

}  // namespace

/// The thread that writes, and what it shares with the journal's.
class EditJournal::Writer {
 public:
  /// Without a database nothing is written; `whyNot` is the system's words.
  Writer(std::string name, WriterLock lock, std::optional<Database> database, const JournalEnd& end,
         const std::string& whyNot)
      : name_(std::move(name)),
        lock_(std::move(lock)),
        database_(std::move(database)),
        end_(end),
        given_(end.entries),
        acknowledged_(end.entries),
        failed_(!database_),
        lastProblem_(whyNot) {
    if (failed_) message_ = inMemoryOnly(name_, whyNot);
    thread_ = std::thread([this] { work(); });
  }

  ~Writer() {
    {
      const std::lock_guard guard(mutex_);
      closing_ = true;
    }
    wake_.notify_one();
    thread_.join();
    if (database_) database_->tidyUp();
  }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  std::uint64_t append(std::vector<std::string> texts) {
    const std::lock_guard guard(mutex_);
    given_ += texts.size();
    std::move(texts.begin(), texts.end(), std::back_inserter(queue_));
    wake_.notify_one();
    return given_;
  }

  /// To be done by the thread that writes, once all before is written; without a database, never.
  using Job = std::function<Result<void>(Database&, JournalEnd&)>;
  void doLater(Job job) {
    const std::lock_guard guard(mutex_);
    jobs_.push_back(std::move(job));
    wake_.notify_one();
  }

  std::uint64_t acknowledged() const noexcept { return acknowledged_.load(std::memory_order_acquire); }

  Result<void> flush() {
    std::unique_lock lock(mutex_);
    waitedFor_ = true;
    wake_.notify_one();
    written_.wait(lock, [this] { return !waitedFor_; });
    if (unsaved_ == 0) return {};
    return inMemoryOnly(name_, lastProblem_);
  }

  /// Waits.
  Result<void> doNow(Job job) {
    doLater(std::move(job));
    if (Result<void> flushed = flush(); !flushed) return abandon();
    const std::lock_guard guard(mutex_);
    if (failed_) return cannotWrite(name_, lastProblem_);
    if (!done_) return cannotWrite(name_, done_.error().message);
    return {};
  }

  Error abandon() {
    std::unique_lock lock(mutex_);
    abandons_ = waitedFor_ = true;
    wake_.notify_one();
    written_.wait(lock, [this] { return !waitedFor_; });
    return cannotWrite(name_, lastProblem_);
  }

  std::optional<std::string> takeMessage() {
    const std::lock_guard guard(mutex_);
    std::optional<Error> taken = std::exchange(message_, std::nullopt);
    if (!taken) return std::nullopt;
    return taken->message;
  }

 private:
  void work() {
    std::unique_lock lock(mutex_);
    for (;;) {
      wake_.wait(lock, [this] { return hasWork() || waitedFor_ || closing_; });
      if (!hasWork() && !waitedFor_ && closing_ && backlog_.empty()) return;
      const bool last = closing_, urgent = waitedFor_ || closing_;
      for (std::string& text : queue_) backlog_.push_back(std::move(text));
      queue_.clear();
      if (std::exchange(abandons_, false)) backlog_.clear();
      std::uint64_t reached = given_;
      const std::vector<Job> jobs = std::exchange(jobs_, {});
      lock.unlock();
      const bool isWaiting = !backlog_.empty();
      const std::optional<Error> problem = save(urgent || !jobs.empty());
      std::optional<Result<void>> done;
      for (const Job& job : jobs) {
        if (database_ && !problem) done = job(*database_, end_);
      }
      lock.lock();
      if (done) done_ = *done;
      if (done && *done && queue_.empty()) reached = given_ = end_.entries;  // there may be fewer now
      note(problem, reached, isWaiting && !problem);
      if (last && !hasWork()) return;
    }
  }

  /// Under the lock.
  bool hasWork() const { return !queue_.empty() || !jobs_.empty(); }

  /// Writes all that is to be written, if it is time to try.
  std::optional<Error> save(bool urgent) {
    if (backlog_.empty()) return std::nullopt;
    if (!database_) return Error{lastProblem_};
    const auto now = std::chrono::steady_clock::now();
    if (!urgent && now < nextTry_) return Error{lastProblem_};
    const Result<JournalEnd> end = appendEntries(*database_, end_, backlog_);
    if (!end) {
      nextTry_ = std::chrono::steady_clock::now() + kBeforeAnotherTry;
      return end.error();
    }
    end_ = *end;
    backlog_.clear();
    return std::nullopt;
  }

  /// Under the lock.
  void note(const std::optional<Error>& problem, std::uint64_t reached, bool isSaved) {
    unsaved_ = backlog_.size();
    if (isSaved && std::exchange(failed_, false)) {
      // Who was not told yet that it failed need not know.
      message_ = message_ ? std::nullopt : std::optional(Error{inFileAgain(name_)});
    }
    if (problem) {
      lastProblem_ = problem->message;
      if (!failed_) message_ = inMemoryOnly(name_, lastProblem_);
      failed_ = true;
    }
    acknowledged_.store(reached, std::memory_order_release);
    if (!hasWork()) waitedFor_ = false;
    written_.notify_all();
  }

  const std::string name_;
  WriterLock lock_;
  // The thread's own:
  std::optional<Database> database_;
  JournalEnd end_;
  std::vector<std::string> backlog_;  // what is not in the file yet
  std::chrono::steady_clock::time_point nextTry_{};
  // Shared, under the lock:
  std::mutex mutex_;
  std::condition_variable wake_, written_;
  std::vector<std::string> queue_;
  std::vector<Job> jobs_;
  Result<void> done_;  // the latest job
  std::uint64_t given_;
  std::size_t unsaved_ = 0;
  bool closing_ = false, waitedFor_ = false, abandons_ = false;
  std::atomic<std::uint64_t> acknowledged_;
  bool failed_;
  std::optional<Error> message_;
  std::string lastProblem_;
  std::thread thread_;
};

Result<std::unique_ptr<EditJournal>> EditJournal::open(const std::filesystem::path& named,
                                                       std::uint64_t worldHash, Shared shared) {
  if (const auto wrong = wrongFile(named)) return *wrong;
  const std::filesystem::path file = target(named);
  const std::string name = named.string();
  WriterLock lock(file);
  if (lock.outcome() == WriterLock::Outcome::heldByAnother && shared == Shared::refused) {
    return Error{inQuotes(name) + " is being written by another program, which must end first"};
  }
  const auto inMemory = [&](EditRecord found, const JournalEnd& end, std::string why) {
    auto writer = std::make_unique<Writer>(name, std::move(lock), std::nullopt, end, why);
    return std::unique_ptr<EditJournal>(new EditJournal(worldHash, std::move(found), std::move(writer)));
  };
  std::error_code problem;
  const bool isThere = std::filesystem::exists(file, problem);
  const bool writable = lock.outcome() == WriterLock::Outcome::taken;
  const std::string whyNot =
      lock.outcome() == WriterLock::Outcome::heldByAnother ? "another program is writing it" : lock.problem();
  if (!isThere && !writable) return inMemory({}, JournalEnd::ofNone(worldHash), whyNot);
  Result<Database> database = isThere ? openJournal(file) : Database::open(file, true);
  if (!database && isThere) return notAJournal(name, database.error().message);
  if (!database) return inMemory({}, JournalEnd::ofNone(worldHash), database.error().message);
  Result<JournalContent> content = readJournal(*database, name, worldHash);
  if (!content) return content.error();
  if (content->record.damage) return *content->record.damage;
  if (!writable) return inMemory(std::move(content->record), content->end, whyNot);
  const Result<void> ready =
      content->isNew ? beginJournal(*database, worldHash)
                     : database->execute("PRAGMA journal_mode = WAL; PRAGMA synchronous = NORMAL");
  if (!ready) return inMemory(std::move(content->record), content->end, ready.error().message);
  auto writer = std::make_unique<Writer>(name, std::move(lock), *std::move(database), content->end, "");
  return std::unique_ptr<EditJournal>(
      new EditJournal(worldHash, std::move(content->record), std::move(writer)));
}

Result<EditRecord> EditJournal::read(const std::filesystem::path& file, std::uint64_t worldHash) {
  if (const auto wrong = wrongFile(file)) return *wrong;
  const std::string name = file.string();
  std::error_code problem;
  if (!std::filesystem::exists(file, problem)) {
    return Error{inQuotes(name) + " is not there, expected an edit journal"};
  }
  Result<Database> database = openJournal(target(file));
  if (!database) return notAJournal(name, database.error().message);
  Result<JournalContent> content = readJournal(*database, name, worldHash);
  if (!content) return content.error();
  if (!content->record.damage) database->tidyUp();
  return std::move(content->record);
}

EditJournal::EditJournal(std::uint64_t worldHash, EditRecord found, std::unique_ptr<Writer> writer)
    : worldHash_(worldHash), found_(std::move(found)), writer_(std::move(writer)) {}

EditJournal::~EditJournal() = default;

std::uint64_t EditJournal::append(std::span<const Edit> edits) {
  std::vector<std::string> texts;
  texts.reserve(edits.size());
  for (const Edit& edit : edits) {
    assert(checkEdit(edit).ok());
    texts.push_back(editText(edit));
  }
  return writer_->append(std::move(texts));
}

std::uint64_t EditJournal::appendUndo() {
  return writer_->append({std::string(kUndoEntry)});
}

std::uint64_t EditJournal::appendRedo() {
  return writer_->append({std::string(kRedoEntry)});
}

void EditJournal::keep(std::shared_ptr<const GroundCheckpoint> checkpoint) {
  writer_->doLater([checkpoint = std::move(checkpoint)](Database& database, JournalEnd&) {
    return keepCheckpoint(database, checkpoint.get());
  });
}

Result<void> EditJournal::compact(std::shared_ptr<const GroundCheckpoint> checkpoint) {
  return writer_->doNow(
      [this, checkpoint = std::move(checkpoint)](Database& database, JournalEnd& end) -> Result<void> {
        if (end.entries != found_.entries) return Error{"entries were appended since it was opened"};
        Result<JournalEnd> compacted = compactJournal(database, worldHash_, found_.history, checkpoint.get());
        if (!compacted) return compacted.error();
        end = *compacted;
        found_.entries = end.entries;
        return {};
      });
}

std::uint64_t EditJournal::acknowledged() const noexcept {
  return writer_->acknowledged();
}

Result<void> EditJournal::flush() {
  return writer_->flush();
}

Error EditJournal::abandon() {
  return writer_->abandon();
}

std::optional<std::string> EditJournal::takeMessage() {
  return writer_->takeMessage();
}

}  // namespace teren
