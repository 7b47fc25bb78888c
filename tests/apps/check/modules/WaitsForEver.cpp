// Waits while it is loaded, longer than anybody asks for, with a child of its own that does the same; their
// numbers stand in a file.
#include <cstdio>
#include <unistd.h>

#include "tests/apps/check/modules/Sound.h"

namespace {

[[noreturn]] void waitForEver() {
  alarm(200);  // where the test fails, nothing shall stay behind
  for (;;) pause();
}

[[maybe_unused]] const int never = [] {
  const pid_t child = fork();
  if (child == 0) waitForEver();
  if (std::FILE* file = std::fopen("processes.part", "w")) {
    std::fprintf(file, "%d %d\n", getpid(), child);
    std::fclose(file);
    std::rename("processes.part", "processes");
  }
  waitForEver();
  return 0;
}();

class Waits final : public sound::Noise {
 public:
  using Noise::Noise;
};

}  // namespace

SOUND_PLUGIN(Waits, "waits-for-ever")
