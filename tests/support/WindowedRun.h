// Runs a program with a window as a person would, and keeps what it said.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <sys/wait.h>

namespace teren::test {

struct Outcome {
  int exitCode = -1;  ///< -1 where a signal ended the program
  std::string output, errors;
};

inline std::string contents(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Runs a shell's words on a display with software GL and waits for their end; `folder` takes what they say,
/// and is the user's data folder to them.
/// Without the leak sanitizer: Qt unloads the GL driver before it looks, so it cannot tell whose the driver's
/// leaks are.
inline Outcome runOnDisplay(const std::string& display, const std::string& words,
                            const std::filesystem::path& folder) {
  const std::filesystem::path output = folder / "output", errors = folder / "errors";
  const std::string command =
      "env -u WAYLAND_DISPLAY -u XDG_RUNTIME_DIR ASAN_OPTIONS=detect_leaks=0 LIBGL_ALWAYS_SOFTWARE=1 "
      "XDG_DATA_HOME=" +
      folder.string() + " DISPLAY=" + display + " " + words + " >" + output.string() + " 2>" +
      errors.string() + " </dev/null";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contents(output), contents(errors)};
}

}  // namespace teren::test
