#include "apps/report/Gnuplot.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <memory>
#include <spawn.h>
#include <sys/wait.h>

extern char** environ;

namespace teren {
namespace {

/// Starts gnuplot, which reads and writes these and complains to nobody; 0 or an errno, and how it ended.
int runGnuplot(std::FILE* script, std::FILE* picture, int& status) {
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, fileno(script), 0);
  posix_spawn_file_actions_adddup2(&files, fileno(picture), 1);
  posix_spawn_file_actions_addopen(&files, 2, "/dev/null", 1, 0);
  std::string name = "gnuplot";
  const std::array<char*, 2> arguments{name.data(), nullptr};
  pid_t process = 0;
  const int problem = posix_spawnp(&process, "gnuplot", &files, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  while (problem == 0 && waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return problem;
}

}  // namespace

Result<void> drawWithGnuplot(const std::string& script, std::FILE* picture) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> text(std::tmpfile(), &std::fclose);
  if (text == nullptr) return Error{std::string("no temporary file can be made: ") + std::strerror(errno)};
  const bool written = std::fwrite(script.data(), 1, script.size(), text.get()) == script.size();
  if (!written || std::fflush(text.get()) != 0) return Error{"the temporary file cannot be written"};
  std::rewind(text.get());
  int status = 0;
  if (const int problem = runGnuplot(text.get(), picture, status); problem != 0) {
    return Error{std::string("gnuplot cannot be started (") + std::strerror(problem) +
                 "), install it, say with apt install gnuplot-nox"};
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) return Error{"gnuplot has failed"};
  return {};
}

Result<void> findGnuplot() {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> nowhere(std::fopen("/dev/null", "r+"), &std::fclose);
  if (nowhere == nullptr) return Error{"/dev/null cannot be opened"};
  return drawWithGnuplot("", nowhere.get());
}

}  // namespace teren
