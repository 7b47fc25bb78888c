#include "apps/check/AllocationCount.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <malloc.h>
#include <new>

namespace {
thread_local long count = 0;
}

namespace teren::check {
long allocationCount() noexcept {
  return count;
}
}  // namespace teren::check

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)

// The sanitizer's own operators check more than ours could; it tells of every allocation.
extern "C" std::size_t __sanitizer_get_current_allocated_bytes();
extern "C" int __sanitizer_install_malloc_and_free_hooks(void (*allocated)(const volatile void*, std::size_t),
                                                         void (*freed)(const volatile void*));
namespace {
[[maybe_unused]] const int installed = __sanitizer_install_malloc_and_free_hooks(
    [](const volatile void*, std::size_t) { ++count; }, [](const volatile void*) {});
}

std::size_t teren::check::allocatedBytes() noexcept {
  return __sanitizer_get_current_allocated_bytes();
}

#else

namespace {

std::atomic<std::size_t> bytes = 0;

void* counted(void* memory) {
  if (memory == nullptr) throw std::bad_alloc();
  ++count;
  bytes.fetch_add(malloc_usable_size(memory), std::memory_order_relaxed);
  return memory;
}

void giveBack(void* memory) noexcept {
  bytes.fetch_sub(malloc_usable_size(memory), std::memory_order_relaxed);
  std::free(memory);
}

}  // namespace

std::size_t teren::check::allocatedBytes() noexcept {
  return bytes.load(std::memory_order_relaxed);
}

// The array and nothrow forms call these. Modules that are loaded later find them, too.
void* operator new(std::size_t size) {
  return counted(std::malloc(size == 0 ? 1 : size));
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  const auto unit = static_cast<std::size_t>(alignment);
  return counted(std::aligned_alloc(unit, (std::max<std::size_t>(size, 1) + unit - 1) / unit * unit));
}
void operator delete(void* memory) noexcept {
  giveBack(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  giveBack(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  giveBack(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  giveBack(memory);
}

#endif
