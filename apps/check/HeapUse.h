// How much memory the program has in use.
#pragma once

#include <cstddef>

namespace teren::check {

/// [bytes] Allocated and not freed, by all threads and in any way. What malloc keeps ready for later counts
/// as far as it is a thread's own: up to 231 KiB (7 pieces of each of 64 sizes).
std::size_t heapBytes() noexcept;

}  // namespace teren::check
