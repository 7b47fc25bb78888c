#include "teren/GroundEditor.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>

#include "teren/EditJournal.h"
#include "teren/Quote.h"

#include "edits/GroundCheckpoint.h"

namespace teren {

namespace {

/// What is done before something of it is shown, of presses; and how long that may take, or a little more.
constexpr int kMostPressesTogether = 16;
constexpr std::chrono::milliseconds kBeforeShowing(50);

/// How long a deformer works before it is asked whether it goes on.
constexpr std::chrono::milliseconds kSlice(5);

/// What was asked of an editor.
struct Wish {
  enum class Kind { press, undo, redo };
  Kind kind = Kind::press;
  Edit edit;
};

/// How many edits there are to take back and to bring back.
struct Counts {
  std::size_t edits = 0, undone = 0;

  void follow(Wish::Kind kind) noexcept {
    if (kind == Wish::Kind::press) {
      ++edits;
      undone = 0;
    } else if (kind == Wish::Kind::undo && edits > 0) {
      --edits;
      ++undone;
    } else if (kind == Wish::Kind::redo && undone > 0) {
      ++edits;
      --undone;
    }
  }
};

}  // namespace

/// What both threads share is under the mutex; the rest is the editing thread's.
class GroundEditor::Work {
 public:
  /// `later` is the journal's file where it is begun with the first edit.
  Work(std::shared_ptr<const World> world, DeformerSource deformers, std::unique_ptr<EditJournal> journal,
       std::optional<std::filesystem::path> later)
      : world_(std::move(world)),
        deformers_(std::move(deformers)),
        journal_(std::move(journal)),
        later_(std::move(later)) {
    if (journal_) {
      history_ = journal_->found();
      kept_ = begins_ = journal_->record().checkpoint;
      if (journal_->record().withoutCheckpoint) tell(journal_->record().withoutCheckpoint->message);
      tellOfJournal();
    }
    isDue_ = isFirst_ = !history_.edits.empty();
    counts_ = {history_.edits.size(), history_.undone.size()};
    thread_ = std::thread([this] { run(); });
  }
  ~Work() {
    {
      const std::lock_guard lock(mutex_);
      ends_ = true;
    }
    wake_.notify_one();
    thread_.join();
  }
  Work(const Work&) = delete;
  Work& operator=(const Work&) = delete;

  /// False: too many wait already.
  bool ask(Wish wish) {
    {
      const std::lock_guard lock(mutex_);
      if (wish.kind == Wish::Kind::press && wishes_.size() >= kMostWaiting) return false;
      wishes_.push_back(std::move(wish));
    }
    wake_.notify_one();
    return true;
  }
  void setWorld(std::shared_ptr<const World> world) {
    {
      const std::lock_guard lock(mutex_);
      world_ = std::move(world);
      isDue_ = true;
      latest_.reset();
    }
    wake_.notify_one();
  }
  std::optional<EditedGround::Snapshot> take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(latest_, std::nullopt);
  }
  std::size_t unfinished() const {
    const std::lock_guard lock(mutex_);
    return wishes_.size() + done_ + (isDue_ || isMaking_ ? std::max<std::size_t>(counts_.edits, 1) : 0) +
           (latest_ ? 1 : 0);
  }
  std::size_t edits() const {
    const std::lock_guard lock(mutex_);
    return counts_.edits;
  }
  Counts expected() const {
    const std::lock_guard lock(mutex_);
    Counts counts = counts_;
    for (const Wish& wish : wishes_) counts.follow(wish.kind);
    return counts;
  }
  std::vector<std::string> takeMessages() {
    const std::lock_guard lock(mutex_);
    return std::exchange(messages_, {});
  }

 private:
  void run() {
    while (waitFor()) {
      settle();
      const auto begun = std::chrono::steady_clock::now();
      for (int presses = 0; presses < kMostPressesTogether;) {
        const std::optional<Wish> wish = next();
        if (!wish || !fulfil(*wish)) break;
        count();
        if (wish->kind == Wish::Kind::press) ++presses;
        // What is behind has nothing to be shown yet.
        if (!isBehind_ && std::chrono::steady_clock::now() - begun > kBeforeShowing) break;
      }
      settle();
      if (journal_) {
        // Whether they are in the file or, as is told then, in memory only, they are acknowledged now.
        [[maybe_unused]] const Result<void> written = journal_->flush();
        tellOfJournal();
      }
      show();
    }
    keepGround();
  }

  /// True: there are wishes, or a world, to work at. At the end all wishes are fulfilled first.
  bool waitFor() {
    std::unique_lock lock(mutex_);
    wake_.wait(lock, [this] { return ends_ || isDue_ || !wishes_.empty(); });
    if (isGivenUp()) return false;
    if (std::exchange(isDue_, false)) {
      if (!isFirst_ || world_ != current_) begins_.reset();  // another world's ground may be other ground
      isMaking_ = true;
      ground_.reset();
      isUnusable_ = false;
      isBehind_ = true;
      current_ = world_;
    }
    return true;
  }
  /// Under the lock: whether it ends and nothing more is to be done.
  bool isGivenUp() const { return ends_ && (wishes_.empty() || isFirst_); }

  /// Sliced; given up where nobody will see what comes of it, and nothing is lost with it.
  EditWork work() {
    return {kSlice, [this] {
              const std::lock_guard lock(mutex_);
              const auto isPress = [](const Wish& wish) { return wish.kind == Wish::Kind::press; };
              const bool isForNobody =
                  ends_ && (isFirst_ || std::none_of(wishes_.begin(), wishes_.end(), isPress));
              return !isForNobody && !isDue_;
            }};
  }

  /// The wish stays counted until it is shown what came of it.
  std::optional<Wish> next() {
    const std::lock_guard lock(mutex_);
    if (wishes_.empty()) return std::nullopt;
    return wishes_.front();
  }
  /// Of the wish that was fulfilled.
  void count() {
    const std::lock_guard lock(mutex_);
    counts_ = {history_.edits.size(), history_.undone.size()};
    wishes_.pop_front();
    ++done_;
  }

  /// False where that was interrupted, and nothing has come of it.
  bool fulfil(const Wish& wish) {
    switch (wish.kind) {
      case Wish::Kind::press:
        return press(wish.edit);
      case Wish::Kind::undo:
        undo();
        return true;
      case Wish::Kind::redo:
        return redo();
    }
    return true;
  }

  /// The ground becomes that of the edits that count, at rest. False where that was interrupted, or where
  /// they cannot be applied any more, which is told once.
  bool settle() {
    if (!isBehind_ || isUnusable_) return !isBehind_;
    const EditWork work = this->work();
    if (!work.goesOn()) return false;
    if (!ground_) ground_ = std::make_unique<EditedGround>(current_, deformers_);
    Result<void> done;
    if (const auto begins = std::exchange(begins_, nullptr)) {
      if (const Result<bool> adopted = ground_->adopt(begins, history_.edits, work); !adopted) {
        done = adopted.error();
      }
    }
    if (done) done = ground_->replay(history_.edits, work);
    if (done) done = ground_->rest(work);
    if (!done && !work.goesOn()) return false;
    isBehind_ = isUnusable_ = !done;
    if (!done) tell("the edits that are kept cannot be applied any more: " + done.error().message);
    if (isFirst_) keepGround();  // nobody should wait for that twice, even if this program dies
    const std::lock_guard lock(mutex_);
    isFirst_ = false;
    return !isBehind_;
  }

  /// So that the next program need not apply all edits again.
  void keepGround() {
    if (!journal_ || !ground_ || current_->failure()) return;
    {
      const std::lock_guard lock(mutex_);
      if (isDue_) return;
    }
    std::shared_ptr<const GroundCheckpoint> latest = ground_->checkpoint(history_.edits.size());
    if (!latest || latest == kept_) return;
    kept_ = latest;
    journal_->keep(std::move(latest));
  }

  /// Before that many edits are no more: no ground of theirs is to be found beside others.
  void forgetGroundOf(std::size_t edits) {
    if (!journal_ || !kept_ || kept_->mark().edits < edits) return;
    kept_.reset();
    journal_->keep(nullptr);
    [[maybe_unused]] const Result<void> written = journal_->flush();  // what cannot be is told later
  }

  bool press(Edit edit) {
    if (!settle()) {
      if (isUnusable_) tell("nothing is applied, as an edit before cannot be any more");
      return isUnusable_;
    }
    edit.steps = ground_->stepsSinceEdit();
    const Applied applied = applyAndRest(edit);
    if (applied != Applied::all) return applied == Applied::nothing;
    if (EditJournal* const journal = begunJournal()) journal->append(edit);
    history_.press(std::move(edit));
    return true;
  }

  /// The ground follows once no other undo or redo comes.
  void undo() {
    if (history_.edits.empty()) return;
    forgetGroundOf(history_.edits.size());
    history_.undo();
    if (EditJournal* const journal = begunJournal()) journal->appendUndo();
    isBehind_ = true;
    isUnusable_ = false;
  }

  bool redo() {
    if (history_.undone.empty()) return true;
    const Edit& edit = history_.undone.back();
    // An edit of a list that was written by hand may have come before the ground was at rest.
    if (isBehind_ || edit.steps < ground_->stepsSinceEdit()) {
      isBehind_ = true;
    } else if (const Applied applied = applyAndRest(edit); applied != Applied::all) {
      return applied == Applied::nothing;
    }
    if (EditJournal* const journal = begunJournal()) journal->appendRedo();
    history_.redo();
    return true;
  }

  /// Of an edit: nothing where it is refused, and the ground follows; perhaps a part where that was
  /// interrupted, and the ground is to be made anew.
  enum class Applied { all, nothing, part };
  Applied applyAndRest(const Edit& edit) {
    const EditWork work = this->work();
    Result<void> done = ground_->apply(edit, work);
    if (done) done = ground_->rest(work);
    if (done) return Applied::all;
    // What a stamp that was refused on the way has left behind is not what the list gives.
    isBehind_ = !ground_->rest();
    if (isBehind_ && !work.goesOn()) return Applied::part;
    tell(done.error().message);
    return Applied::nothing;
  }

  EditJournal* begunJournal() {
    if (later_) {
      const std::filesystem::path file = *std::exchange(later_, std::nullopt);
      std::error_code ignored;  // what it means is said of the file
      std::filesystem::create_directories(file.parent_path(), ignored);
      auto journal = EditJournal::open(file, current_->descriptionHash(), EditJournal::Shared::inMemory);
      if (!journal) {
        tell(journal.error().message + "; edits are kept in memory only");
      } else if ((*journal)->found() != EditHistory()) {
        tell("another program has begun " + inQuotes(file.string()) +
             " meanwhile; edits are kept in memory only");
      } else {
        journal_ = *std::move(journal);
      }
    }
    return journal_.get();
  }

  void show() {
    std::optional<EditedGround::Snapshot> now;
    if (ground_ && !isBehind_) now = ground_->snapshot();
    const std::lock_guard lock(mutex_);
    done_ = 0;
    isMaking_ = false;
    if (isDue_ || !now || now->changed.empty()) return;
    if (latest_) now->changed.insert(now->changed.end(), latest_->changed.begin(), latest_->changed.end());
    latest_ = std::move(now);
  }

  void tell(std::string message) {
    const std::lock_guard lock(mutex_);
    messages_.push_back(std::move(message));
  }
  void tellOfJournal() {
    if (std::optional<std::string> message = journal_->takeMessage()) tell(*std::move(message));
  }

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::shared_ptr<const World> world_;
  bool isDue_ = false;     // the ground is to be made from all edits that count
  bool isMaking_ = false;  // and that is being done
  bool isFirst_ = false;   // and for the first time, from what the journal held
  bool ends_ = false;
  std::deque<Wish> wishes_;
  std::size_t done_ = 0;  // wishes that were fulfilled since something was shown
  Counts counts_;
  std::optional<EditedGround::Snapshot> latest_;
  std::vector<std::string> messages_;

  DeformerSource deformers_;
  std::unique_ptr<EditJournal> journal_;
  std::optional<std::filesystem::path> later_;
  std::shared_ptr<const GroundCheckpoint> kept_;    // in the journal
  std::shared_ptr<const GroundCheckpoint> begins_;  // what the first ground begins with
  EditHistory history_;
  std::shared_ptr<const World> current_ = world_;
  std::unique_ptr<EditedGround> ground_;
  bool isBehind_ = true;     // the ground is not that of the edits that count
  bool isUnusable_ = false;  // and cannot be, as they cannot be applied any more

  std::thread thread_;  // last: it uses all of these
};

GroundEditor::GroundEditor(std::unique_ptr<Work> work) : work_(std::move(work)) {}
GroundEditor::~GroundEditor() = default;

Result<std::unique_ptr<GroundEditor>> GroundEditor::open(
    std::shared_ptr<const World> world, DeformerSource deformers,
    const std::optional<std::filesystem::path>& journal) {
  std::unique_ptr<EditJournal> opened;
  std::error_code ignored;  // what cannot be looked at is not there, or will be refused
  const bool isThere = journal && std::filesystem::exists(*journal, ignored);
  if (isThere) {
    auto found = EditJournal::open(*journal, world->descriptionHash(), EditJournal::Shared::inMemory);
    if (!found) return found.error();
    opened = *std::move(found);
  }
  return std::unique_ptr<GroundEditor>(new GroundEditor(std::make_unique<Work>(
      std::move(world), std::move(deformers), std::move(opened), isThere ? std::nullopt : journal)));
}

Result<void> GroundEditor::press(const Edit& edit) {
  if (Result<void> checked = checkEdit(edit); !checked) return checked;
  if (work_->ask({Wish::Kind::press, edit})) return {};
  return Error{std::to_string(kMostWaiting) +
               " presses and more are still to be applied, so this one is not"};
}
void GroundEditor::undo() {
  work_->ask({Wish::Kind::undo, {}});
}
void GroundEditor::redo() {
  work_->ask({Wish::Kind::redo, {}});
}
std::size_t GroundEditor::canUndo() const {
  return work_->expected().edits;
}
std::size_t GroundEditor::canRedo() const {
  return work_->expected().undone;
}
void GroundEditor::setWorld(std::shared_ptr<const World> world) {
  work_->setWorld(std::move(world));
}
std::optional<EditedGround::Snapshot> GroundEditor::take() {
  return work_->take();
}
std::size_t GroundEditor::unfinished() const {
  return work_->unfinished();
}
std::size_t GroundEditor::edits() const {
  return work_->edits();
}
std::vector<std::string> GroundEditor::takeMessages() {
  return work_->takeMessages();
}

}  // namespace teren
