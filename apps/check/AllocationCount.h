// Counts allocations, in a program that links this library.
#pragma once

#include <cstddef>

namespace teren::check {

/// How often this thread called operator new so far, in any of its forms; under a sanitizer, how often it
/// allocated at all. Counting costs some nanoseconds a call. Without a sanitizer, memory that is got from
/// malloc itself is not seen.
long allocationCount() noexcept;

/// [bytes] What all threads got from operator new (under a sanitizer: at all) and have not given back,
/// exactly; what malloc keeps ready for later is not among it.
std::size_t allocatedBytes() noexcept;

}  // namespace teren::check
