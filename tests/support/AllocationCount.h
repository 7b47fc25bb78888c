// Counts allocations, in a program that links apps/check/AllocationCount.cpp.
#pragma once

#include "apps/check/AllocationCount.h"

namespace teren::test {

using check::allocatedBytes;
using check::allocationCount;

}  // namespace teren::test
