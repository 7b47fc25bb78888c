// A process that digs, and is killed.
#pragma once

#include <array>
#include <csignal>
#include <cstdint>
#include <functional>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

namespace teren::test {

/// Runs `dig` in a process of its own and kills it, some microseconds after it has told so many numbers
/// through the pipe that it is given. The last number that it told, or `untold`.
inline std::uint64_t lastToldBeforeDeath(const std::function<void(int pipe)>& dig, std::uint64_t numbers,
                                         std::uint64_t microseconds, std::uint64_t untold) {
  std::array<int, 2> ends{};
  EXPECT_EQ(pipe(ends.data()), 0);
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    dig(ends[1]);
    _exit(0);
  }
  close(ends[1]);
  std::uint64_t last = untold, told = 0;
  const auto listen = [&] {
    if (read(ends[0], &told, sizeof told) != sizeof told) return false;
    last = told;
    return true;
  };
  for (; numbers > 0 && listen(); --numbers) continue;
  usleep(static_cast<useconds_t>(microseconds));
  kill(child, SIGKILL);
  while (listen()) continue;
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status)) << "it ended by itself with " << WEXITSTATUS(status);
  return last;
}

}  // namespace teren::test
