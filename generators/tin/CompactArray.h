// An array that grows by an eighth and, where the C library can move pages, without being copied.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <new>
#include <type_traits>
#include <utility>

namespace teren {

/// Like std::vector for plain data, with at most an eighth (and 64) of its elements unused after growing:
/// std::vector may waste as much as it holds. Large blocks grow through realloc, which on Linux moves the
/// pages' addresses, not their content, so growing a big array causes no hiccup.
template <class T>
class CompactArray {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  CompactArray() = default;
  CompactArray(const CompactArray& other) {
    reserve(other.size_);
    if (other.size_ > 0) std::memcpy(static_cast<void*>(data_), other.data_, other.size_ * sizeof(T));
    size_ = other.size_;
  }
  CompactArray(CompactArray&& other) noexcept { swap(other); }
  CompactArray& operator=(CompactArray other) noexcept {
    swap(other);
    return *this;
  }
  ~CompactArray() { std::free(data_); }

  T& operator[](std::size_t i) noexcept {
    assert(i < size_);
    return data_[i];
  }
  const T& operator[](std::size_t i) const noexcept {
    assert(i < size_);
    return data_[i];
  }
  const T* data() const noexcept { return data_; }
  std::size_t size() const noexcept { return size_; }
  std::size_t bytes() const noexcept { return capacity_ * sizeof(T); }

  void push_back(const T& value) {
    const T copy = value;  // it may lie in here
    if (size_ == capacity_) reserve(size_ + size_ / 8 + 64);
    data_[size_++] = copy;
  }
  /// Makes room for `wanted` elements, exactly.
  void reserve(std::size_t wanted) {
    if (wanted <= capacity_) return;
    void* grown = std::realloc(static_cast<void*>(data_), wanted * sizeof(T));
    if (grown == nullptr) throw std::bad_alloc();
    data_ = static_cast<T*>(grown);
    capacity_ = wanted;
  }
  void resize(std::size_t wanted, const T& filler) {
    reserve(wanted);
    for (std::size_t i = size_; i < wanted; ++i) data_[i] = filler;
    size_ = wanted;
  }

 private:
  void swap(CompactArray& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    std::swap(capacity_, other.capacity_);
  }

  T* data_ = nullptr;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
};

}  // namespace teren
