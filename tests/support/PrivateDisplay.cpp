#include "tests/support/PrivateDisplay.h"

#include <array>
#include <csignal>
#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace teren {
namespace {

// The server writes the number of the display it found free, and a line's end, once it listens.
std::string readLine(int file) {
  std::string line;
  std::array<char, 1> byte{};
  while (read(file, byte.data(), 1) == 1 && byte[0] != '\n') line += byte[0];
  return line;
}

}  // namespace

PrivateDisplay::PrivateDisplay() {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) return;
  server_ = fork();
  if (server_ == 0) {
    close(ends[0]);
    prctl(PR_SET_PDEATHSIG, SIGTERM);  // also where the test crashes
    const int nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
    const std::string number = std::to_string(ends[1]);
    execlp("Xvfb", "Xvfb", "-displayfd", number.c_str(), "-screen", "0", "1280x720x24", "-nolisten", "tcp",
           static_cast<char*>(nullptr));
    _exit(127);
  }
  close(ends[1]);
  const std::string number = readLine(ends[0]);
  close(ends[0]);
  if (!number.empty()) name_ = ":" + number;
}

PrivateDisplay::~PrivateDisplay() {
  if (server_ <= 0) return;
  kill(server_, SIGTERM);
  waitpid(server_, nullptr, 0);
}

}  // namespace teren
