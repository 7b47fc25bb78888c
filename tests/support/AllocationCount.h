// Counts the allocations of the thread that asks, in a program that links apps/check/AllocationCount.cpp.
#pragma once

#include "apps/check/AllocationCount.h"

namespace teren::test {

using check::allocationCount;

}  // namespace teren::test
