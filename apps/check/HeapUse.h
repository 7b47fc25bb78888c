// How much memory the program has in use.
#pragma once

#include <cstddef>

namespace teren::check {

/// [bytes] Allocated and not freed, by all threads; what malloc keeps ready for later does not count, but for
/// a few KiB a thread.
std::size_t heapBytes() noexcept;

}  // namespace teren::check
