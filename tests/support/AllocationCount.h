// Counts the allocations of the thread that asks, in a program that links AllocationCount.cpp.
#pragma once

namespace teren::test {

/// How often operator new was called by this thread so far.
long allocationCount() noexcept;

}  // namespace teren::test
