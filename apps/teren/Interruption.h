// Ctrl-C (and the polite kill) as a question that long work asks, so that it can stop cleanly.
#pragma once

namespace teren {

/// While one lives, SIGINT, SIGTERM and SIGHUP only set a flag, and a file that grows beyond its limit is an
/// error of the write (EFBIG) instead of the end. At most one at a time.
class Interruption {
 public:
  Interruption();
  /// Gives the signals back their former meaning.
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  /// True once one of them has come.
  bool came() const noexcept;
};

}  // namespace teren
