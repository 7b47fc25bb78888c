// Threads for checks: what is thrown on one is thrown where they are waited for.
#pragma once

#include <exception>
#include <functional>
#include <span>
#include <thread>
#include <vector>

namespace teren::check {

/// Runs all pieces of work at once, each on a thread of its own, and waits for them; then throws what the
/// first that threw has thrown.
inline void runAtOnce(std::span<const std::function<void()>> work) {
  std::vector<std::exception_ptr> thrown(work.size());
  {
    std::vector<std::jthread> threads;
    for (std::size_t n = 0; n < work.size(); ++n) {
      threads.emplace_back([&, n] {
        try {
          work[n]();
        } catch (...) {
          thrown[n] = std::current_exception();
        }
      });
    }
  }
  for (const std::exception_ptr& exception : thrown) {
    if (exception) std::rethrow_exception(exception);
  }
}

/// One piece of work, on another thread.
inline void runElsewhere(const std::function<void()>& work) {
  runAtOnce(std::span(&work, 1));
}

}  // namespace teren::check
