// Counts the allocations of the thread that asks, in a program that links this library.
#pragma once

namespace teren::check {

/// How often this thread called operator new so far, in any of its forms; under a sanitizer, how often it
/// allocated at all. Counting costs less than a nanosecond a call. Without a sanitizer, memory that is got
/// from malloc itself is not seen.
long allocationCount() noexcept;

}  // namespace teren::check
