// How much of a long trial is done where: all of it with TEREN_FULL=1; and a fraction under a sanitizer,
// which makes everything many times slower and is there for what memory the code touches, not for what it
// computes.
#pragma once

#include <algorithm>
#include <cstdlib>

namespace teren::test {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

inline bool isFull() {
  return std::getenv("TEREN_FULL") != nullptr;
}

/// Of something that is done `usual` times, or `full` times in the long version.
inline int trials(int usual, int full) {
  if (isFull()) return full;
  return kSanitized ? std::min(usual, std::max(1, usual / 10)) : usual;
}

}  // namespace teren::test
