// Runs the built `teren` and keeps what it said.
#pragma once

#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <string>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

#include <gtest/gtest.h>

#include "tests/engine/plugin/ScratchFolder.h"

namespace teren {

using Arguments = std::vector<std::string>;

struct Answer {
  int exitCode = -1;  ///< -1 where a signal ended the program
  std::string output;
  std::string complaint;          ///< standard error
  std::vector<std::string> left;  ///< names of the files it left in its current folder
};

/// A started program; `finish` must be called once.
class Program {
 public:
  struct Settings {
    std::string output;                  ///< a file for standard output instead of what Answer::output keeps
    rlim_t largestFile = RLIM_INFINITY;  ///< [bytes]
    std::vector<int> closed;             ///< descriptors it finds closed
    std::string plugins = TEREN_TEST_MODULES "/good:" TEREN_TEST_MODULES "/broken";  ///< its search path
  };

  explicit Program(const Arguments& arguments) : Program(arguments, Settings()) {}
  Program(const Arguments& arguments, const Settings& settings) {
    std::vector<std::string> texts = {TEREN_PROGRAM};
    texts.insert(texts.end(), arguments.begin(), arguments.end());
    std::vector<char*> pointers;
    for (std::string& text : texts) pointers.push_back(text.data());
    pointers.push_back(nullptr);
    const std::string outputFile = settings.output.empty() ? (folder_ / "out").string() : settings.output;
    const std::string complaintFile = folder_ / "err";
    process_ = fork();
    if (process_ != 0) return;
    const int output = open(outputFile.c_str(), O_WRONLY | O_CREAT, 0600);
    const int complaint = open(complaintFile.c_str(), O_WRONLY | O_CREAT, 0600);
    dup2(output, STDOUT_FILENO);
    dup2(complaint, STDERR_FILENO);
    setenv("TEREN_PLUGIN_PATH", settings.plugins.c_str(), 1);
    const rlimit limit = {settings.largestFile, settings.largestFile};
    setrlimit(RLIMIT_FSIZE, &limit);
    for (const int descriptor : settings.closed) close(descriptor);
    // Whatever it writes by mistake goes with the folder.
    if (chdir(folder_.path().c_str()) != 0) _exit(127);
    execv(TEREN_PROGRAM, pointers.data());
    _exit(127);
  }

  /// The one it runs in.
  const std::filesystem::path& folder() const { return folder_.path(); }

  void signal(int number) const { kill(process_, number); }

  /// Waits until the program has taken this signal into its own hands.
  bool waitUntilItCatches(int number) const {
    const std::string status = "/proc/" + std::to_string(process_) + "/status";
    for (int tries = 0; tries < 6000; ++tries) {
      const std::string text = fileBytes(status);
      const std::size_t caught = text.find("SigCgt:");
      if (caught == std::string::npos) return false;
      const auto mask = std::stoull(text.substr(caught + 7), nullptr, 16);
      if ((mask >> static_cast<unsigned>(number - 1) & 1U) != 0) return true;
      usleep(10'000);
    }
    return false;
  }

  Answer finish() {
    int status = 0;
    waitpid(process_, &status, 0);
    Answer answer{WIFEXITED(status) ? WEXITSTATUS(status) : -1,
                  fileBytes(folder_ / "out"),
                  fileBytes(folder_ / "err"),
                  {}};
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
      const std::string name = entry.path().filename();
      if (name != "out" && name != "err") answer.left.push_back(name);
    }
    return answer;
  }

 private:
  ScratchFolder folder_;
  pid_t process_ = -1;
};

inline Answer teren(const Arguments& arguments) {
  return Program(arguments).finish();
}

/// One line on standard error that begins with the program's name and is short enough to read.
inline bool isOneSentence(const std::string& complaint) {
  return complaint.starts_with("teren: ") && complaint.size() > 15 && complaint.size() < 1500 &&
         complaint.find('\n') == complaint.size() - 1 && complaint[complaint.size() - 2] != '.';
}

inline std::vector<std::string> namesIn(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    names.push_back(entry.path().filename());
  return names;
}

}  // namespace teren
