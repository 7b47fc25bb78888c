// First come, first served, in one array.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace teren {

/// What waits lies side by side, as in a std::vector. What has been served leaves room at the front, which is
/// closed when it is half of the array: serving moves each element once at most in the mean.
template <class T>
class FrontQueue {
 public:
  std::size_t size() const noexcept { return all_.size() - served_; }
  const T* data() const noexcept { return all_.data() + served_; }
  const T* begin() const noexcept { return data(); }
  const T* end() const noexcept { return data() + size(); }
  T& operator[](std::size_t i) noexcept { return all_[served_ + i]; }

  void push_back(const T& value) { all_.push_back(value); }
  /// Elements that come with it are T{}.
  void resize(std::size_t size) { all_.resize(served_ + size); }
  /// Takes the first ones away; there are so many.
  void serve(std::size_t count) {
    served_ += count;
    if (2 * served_ < all_.size()) return;
    std::move(all_.begin() + static_cast<std::ptrdiff_t>(served_), all_.end(), all_.begin());
    all_.resize(size());
    served_ = 0;
  }
  std::size_t bytes() const noexcept { return all_.capacity() * sizeof(T); }

 private:
  std::vector<T> all_;
  std::size_t served_ = 0;  // of them, at the front
};

}  // namespace teren
