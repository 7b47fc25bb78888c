#include "apps/teren/CheckProcess.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>
#include <fcntl.h>
#include <optional>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "teren/Parameter.h"

namespace teren {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kWaiting = 10.0;  // how much longer than it may work a process may take
constexpr int kPollMilliseconds = 20;
constexpr std::size_t kMostSaid = std::size_t{1}
                                  << 20;  // [bytes] what goes beyond is dropped, and so no answer

/// Becomes the program; called between fork and exec.
[[noreturn]] void become(std::vector<char*>& arguments, int pipe) {
  setpgid(0, 0);                     // to be killed with its children
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // and not to outlive who asked
  fcntl(pipe, F_SETFD, 0);
  const int nothing = open("/dev/null", O_RDONLY);
  dup2(nothing, STDIN_FILENO);
  dup2(STDERR_FILENO, STDOUT_FILENO);
  execv("/proc/self/exe", arguments.data());
  _exit(127);
}

std::string howItEnded(int status) {
  if (WIFSIGNALED(status)) {
    const char* const name = strsignal(WTERMSIG(status));
    return "its process was ended by signal " + std::to_string(WTERMSIG(status)) + " (" +
           (name == nullptr ? "unknown" : name) + ")";
  }
  return "its process ended with code " + std::to_string(WEXITSTATUS(status));
}

/// A started process; killed when it is destroyed before its end.
class CheckProcess {
 public:
  CheckProcess(std::vector<std::string> arguments, CheckLimit limit) : limit_(limit), start_(Clock::now()) {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) return;
    arguments.insert(arguments.begin(), "teren");
    arguments.insert(arguments.end(), {"--answer", std::to_string(ends[1])});
    std::vector<char*> pointers;
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    process_ = fork();
    if (process_ == 0) become(pointers, ends[1]);
    close(ends[1]);
    pipe_ = ends[0];
    fcntl(pipe_, F_SETFL, O_NONBLOCK);
  }
  CheckProcess(const CheckProcess&) = delete;
  CheckProcess& operator=(const CheckProcess&) = delete;
  ~CheckProcess() {
    if (process_ > 0) {
      kill(process_, SIGKILL);  // it may not have its group yet
      kill(-process_, SIGKILL);
      waitpid(process_, nullptr, 0);
    }
    if (pipe_ >= 0) close(pipe_);
  }

  bool started() const { return process_ > 0; }
  const std::string& said() const { return said_; }

  /// Waits a moment; its status once it has ended.
  std::optional<int> wait() {
    pollfd waited{pipe_, POLLIN, 0};
    if (closed_) {
      poll(nullptr, 0, 1);
    } else {
      poll(&waited, 1, kPollMilliseconds);
    }
    read();
    int status = 0;
    if (waitpid(process_, &status, WNOHANG) != process_) return std::nullopt;
    kill(-process_, SIGKILL);  // whom it has left behind
    process_ = -1;
    read();
    return status;
  }

  /// Why it has to end now, if so.
  std::optional<std::string> overLimit() const {
    clockid_t clock{};
    timespec used{};
    if (clock_getcpuclockid(process_, &clock) == 0 && clock_gettime(clock, &used) == 0 &&
        std::chrono::seconds(used.tv_sec) + std::chrono::nanoseconds(used.tv_nsec) > limit_)
      return "it has used " + numberText(limit_.count()) + " s of processor time without an end";
    if (Clock::now() - start_ > kWaiting * limit_)
      return "it has waited for " + numberText(kWaiting * limit_.count()) + " s without an end";
    return std::nullopt;
  }

 private:
  void read() {
    std::array<char, 4096> bytes{};
    for (ssize_t count = 1; count > 0;) {
      count = ::read(pipe_, bytes.data(), bytes.size());
      if (count > 0 && said_.size() < kMostSaid) said_.append(bytes.data(), static_cast<std::size_t>(count));
      if (count == 0) closed_ = true;
    }
  }

  CheckLimit limit_;
  Clock::time_point start_;
  pid_t process_ = -1;
  int pipe_ = -1;
  bool closed_ = false;  // at its other end
  std::string said_;
};

}  // namespace

Result<std::string> runCheckProcess(std::vector<std::string> arguments, CheckLimit limit,
                                    const std::function<bool()>& goOn) {
  CheckProcess process(std::move(arguments), limit);
  if (!process.started()) return Error{std::string("no process can be started: ") + std::strerror(errno)};
  while (goOn()) {
    const std::optional<int> status = process.wait();
    if (status) {
      if (*status == 0) return process.said();
      return Error{howItEnded(*status) + (process.said().empty() ? "" : " after its work was done")};
    }
    if (const auto reason = process.overLimit()) return Error{*reason};
  }
  return Error{"interrupted"};
}

bool writeCheckAnswer(int pipe, const std::string& answer) {
  std::size_t written = 0;
  while (written < answer.size()) {
    const ssize_t count = write(pipe, answer.data() + written, answer.size() - written);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    written += static_cast<std::size_t>(count);
  }
  return true;
}

}  // namespace teren
