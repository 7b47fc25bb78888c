// One line on a terminal that tells how far long work has come, and nothing where there is no terminal.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace teren {

class ProgressLine {
 public:
  /// `what` is counted, say "nodes".
  explicit ProgressLine(std::string what);
  /// Wipes the line.
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// Writes at most ten times a second; otherwise costs a look at the clock.
  void show(std::size_t done, std::size_t wanted);

 private:
  std::string what_;
  bool terminal_;
  bool shown_ = false;
  std::chrono::steady_clock::time_point next_;
};

}  // namespace teren
