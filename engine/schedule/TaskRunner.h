// Runs tasks, the most urgent first: on worker threads, or in slices on the caller's thread where there are
// none.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "teren/Slice.h"

#include "schedule/SliceMeter.h"

namespace teren {

/// A queue of tasks by urgency. Workers run a task in slices of kWorkerSlice; after each they look whether it
/// was cancelled, or whether a more urgent one waits (then it goes back to the queue, to be gone on with
/// later by any worker). Results come back to the caller in the order they were finished.
///
/// All member functions are for one thread, the owner's. None of them waits for a worker's step but the
/// destructor and waitForFinished.
class TaskRunner {
 public:
  using Ticket = std::uint64_t;  ///< names a task; increasing, never reused
  struct Finished {
    Ticket ticket;
    std::unique_ptr<SlicedTask> task;
  };

  static constexpr std::chrono::microseconds kWorkerSlice{1000};

  /// `workers` >= 0 threads.
  explicit TaskRunner(int workers);
  /// Cancels everything; waits for the steps under way.
  ~TaskRunner();
  TaskRunner(const TaskRunner&) = delete;
  TaskRunner& operator=(const TaskRunner&) = delete;

  int workers() const noexcept { return static_cast<int>(threads_.size()); }

  /// Smaller `urgency` runs first; ties in the order of submission.
  Ticket submit(std::unique_ptr<SlicedTask> task, std::int64_t urgency);
  /// The task is never handed out: it is destroyed at once, or after the step a worker is at. Tickets already
  /// handed out are ignored.
  void cancel(Ticket ticket);

  /// One step of the most urgent task on this thread, within a slice that `meter` has just allowed (see
  /// SliceMeter::mayStart). False where nothing waits. Meant for 0 workers; with more it helps them.
  bool stepHere(SliceMeter& meter);

  /// Everything finished since the last call, in that order.
  std::vector<Finished> takeFinished();
  /// Tasks submitted and neither cancelled nor taken.
  std::size_t pending() const;
  /// Those of them that are not finished.
  std::size_t unfinished() const;
  /// Waits until something is finished or the time is over; returns at once where no worker could finish
  /// anything.
  void waitForFinished(std::chrono::milliseconds most);

 private:
  using Place = std::pair<std::int64_t, Ticket>;  // in the queue: urgency, then age
  struct Taken {
    Place place;
    std::unique_ptr<SlicedTask> task;
  };

  void work();
  Taken takeFirst();                   // with mutex_ held
  bool goesOn(const Place&) const;     // after a step, with mutex_ held
  std::size_t unfinishedOnes() const;  // with mutex_ held
  void putAway(Taken&& taken, bool done, std::unique_ptr<SlicedTask>& dropped);

  mutable std::mutex mutex_;
  std::condition_variable queued_, finishedOne_;
  std::map<Place, std::unique_ptr<SlicedTask>> queue_;
  std::map<Ticket, std::int64_t> urgencies_;  // of tasks in the queue, to find them by ticket
  std::map<Ticket, bool> running_;            // whether they were cancelled
  std::vector<Finished> finished_;
  Ticket next_ = 1;
  bool ending_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace teren
