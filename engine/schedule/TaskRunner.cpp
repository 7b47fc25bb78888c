#include "schedule/TaskRunner.h"

#include <algorithm>
#include <cassert>

namespace teren {

TaskRunner::TaskRunner(int workers) {
  assert(workers >= 0);
  threads_.reserve(static_cast<std::size_t>(workers));
  for (int worker = 0; worker < workers; ++worker) threads_.emplace_back([this] { work(); });
}

TaskRunner::~TaskRunner() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  queued_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

TaskRunner::Ticket TaskRunner::submit(std::unique_ptr<SlicedTask> task, std::int64_t urgency) {
  assert(task);
  Ticket ticket = 0;
  {
    const std::lock_guard lock(mutex_);
    ticket = next_++;
    queue_.emplace(Place{urgency, ticket}, std::move(task));
    urgencies_.emplace(ticket, urgency);
  }
  queued_.notify_one();
  return ticket;
}

void TaskRunner::cancel(Ticket ticket) {
  std::unique_ptr<SlicedTask> dropped;  // destroyed after the lock is released
  const std::lock_guard lock(mutex_);
  if (const auto waiting = urgencies_.find(ticket); waiting != urgencies_.end()) {
    const auto place = queue_.find(Place{waiting->second, ticket});
    dropped = std::move(place->second);
    queue_.erase(place);
    urgencies_.erase(waiting);
  } else if (const auto running = running_.find(ticket); running != running_.end()) {
    running->second = true;
  } else {
    const auto done = std::find_if(finished_.begin(), finished_.end(),
                                   [&](const Finished& finished) { return finished.ticket == ticket; });
    if (done == finished_.end()) return;
    dropped = std::move(done->task);
    finished_.erase(done);
  }
}

TaskRunner::Taken TaskRunner::takeFirst() {
  const auto first = queue_.begin();
  Taken taken{first->first, std::move(first->second)};
  queue_.erase(first);
  urgencies_.erase(taken.place.second);
  running_.emplace(taken.place.second, false);
  return taken;
}

bool TaskRunner::goesOn(const Place& place) const {
  return !ending_ && !running_.at(place.second) && (queue_.empty() || place < queue_.begin()->first);
}

void TaskRunner::putAway(Taken&& taken, bool done, std::unique_ptr<SlicedTask>& dropped) {
  const Ticket ticket = taken.place.second;
  const bool cancelled = running_.at(ticket);
  running_.erase(ticket);
  if (cancelled) {
    dropped = std::move(taken.task);
  } else if (done) {
    finished_.push_back({ticket, std::move(taken.task)});
  } else {
    urgencies_.emplace(ticket, taken.place.first);
    queue_.emplace(taken.place, std::move(taken.task));
  }
}

void TaskRunner::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    queued_.wait(lock, [this] { return ending_ || !queue_.empty(); });
    if (ending_) return;
    Taken taken = takeFirst();
    bool done = false;
    do {
      lock.unlock();
      done = taken.task->step(Slice::lasting(kWorkerSlice));
      lock.lock();
    } while (!done && goesOn(taken.place));
    std::unique_ptr<SlicedTask> dropped;
    putAway(std::move(taken), done, dropped);
    finishedOne_.notify_one();
    if (!dropped) continue;
    lock.unlock();  // a task's destructor may be long: maps to free
    dropped.reset();
    lock.lock();
  }
}

bool TaskRunner::stepHere(SliceMeter& meter) {
  Taken taken;
  {
    const std::lock_guard lock(mutex_);
    if (queue_.empty()) return false;
    taken = takeFirst();
  }
  const bool done = meter.step(*taken.task);
  std::unique_ptr<SlicedTask> dropped;
  const std::lock_guard lock(mutex_);
  putAway(std::move(taken), done, dropped);
  assert(!dropped);  // cancel is called by this thread only
  return true;
}

std::vector<TaskRunner::Finished> TaskRunner::takeFinished() {
  const std::lock_guard lock(mutex_);
  return std::exchange(finished_, {});
}

std::size_t TaskRunner::pending() const {
  const std::lock_guard lock(mutex_);
  return unfinishedOnes() + finished_.size();
}

std::size_t TaskRunner::unfinished() const {
  const std::lock_guard lock(mutex_);
  return unfinishedOnes();
}

std::size_t TaskRunner::unfinishedOnes() const {
  const auto cancelled =
      std::count_if(running_.begin(), running_.end(), [](const auto& running) { return running.second; });
  return queue_.size() + running_.size() - static_cast<std::size_t>(cancelled);
}

void TaskRunner::waitForFinished(std::chrono::milliseconds most) {
  std::unique_lock lock(mutex_);
  finishedOne_.wait_for(lock, most, [this] {
    return !finished_.empty() || threads_.empty() || (queue_.empty() && running_.empty());
  });
}

}  // namespace teren
