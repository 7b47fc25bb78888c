// One program writes a journal at a time.
#pragma once

#include <filesystem>
#include <string>
#include <utility>

#include "teren/Result.h"

namespace teren {

/// A lock on a file of its own beside the journal, FILE-lock, which the system takes back when the program
/// ends, however it does. The file goes with the lock.
class WriterLock {
 public:
  enum class Outcome { taken, heldByAnother, impossible };

  WriterLock() = default;
  explicit WriterLock(const std::filesystem::path& journal);
  ~WriterLock();
  WriterLock(WriterLock&& other) noexcept
      : outcome_(std::exchange(other.outcome_, Outcome::impossible)),
        descriptor_(std::exchange(other.descriptor_, -1)),
        name_(std::move(other.name_)),
        problem_(std::move(other.problem_)) {}
  WriterLock& operator=(WriterLock&&) = delete;

  Outcome outcome() const noexcept { return outcome_; }
  /// The system's words where it is impossible: a folder that is read-only or not there.
  const std::string& problem() const noexcept { return problem_; }

 private:
  Outcome outcome_ = Outcome::impossible;
  int descriptor_ = -1;
  std::string name_, problem_;
};

}  // namespace teren
