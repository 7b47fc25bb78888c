#include "tests/support/AllocationCount.h"

#include <cstdlib>
#include <new>

namespace {
thread_local long count = 0;
}

namespace teren::test {
long allocationCount() noexcept {
  return count;
}
}  // namespace teren::test

// The array and nothrow forms call these.
void* operator new(std::size_t size) {
  ++count;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
