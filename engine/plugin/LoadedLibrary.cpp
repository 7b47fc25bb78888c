#include "plugin/LoadedLibrary.h"

#include <csignal>
#include <cstddef>
#include <ctime>
#include <dlfcn.h>
#include <sys/mman.h>
#include <system_error>
#include <unistd.h>

#include "teren/Quote.h"

#include "plugin/SharedObject.h"

namespace teren {
namespace {

constexpr std::size_t kSentenceBytes = 400;  // of the loader's own words

/// A memory file by a name that the loader can open. The loader knows libraries by their names, so the file
/// stays open as long as the library is loaded, or a later one under the same number would be taken for it.
std::string pathOf(int memoryFile) {
  return "/proc/self/fd/" + std::to_string(memoryFile);
}

/// dlerror's sentence without the file's name in front, which is told beside it.
Error refusal(const std::string& file) {
  const char* text = dlerror();
  std::string_view message = text == nullptr ? std::string_view("unknown reason") : std::string_view(text);
  const std::string front = file + ": ";
  if (message.starts_with(front)) message.remove_prefix(front.size());
  return Error{"the loader refuses it: " + shortened(message, kSentenceBytes)};
}

void* open(const std::string& path) {
  return dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
}

/// Where a process may write no files of such a size (ulimit -f), writing one shall fail and not end the
/// process, which is what the signal SIGXFSZ does. Of this thread alone, as the signal is.
class FileSizeSignalHeld {
 public:
  FileSizeSignalHeld() {
    sigemptyset(&signal_);
    sigaddset(&signal_, SIGXFSZ);
    pthread_sigmask(SIG_BLOCK, &signal_, &before_);
  }
  ~FileSizeSignalHeld() {
    constexpr timespec kNoTime{};
    while (sigtimedwait(&signal_, nullptr, &kNoTime) == SIGXFSZ) {
    }
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  FileSizeSignalHeld(const FileSizeSignalHeld&) = delete;
  FileSizeSignalHeld& operator=(const FileSizeSignalHeld&) = delete;

 private:
  sigset_t signal_{}, before_{};
};

bool writeAll(int file, std::string_view bytes) {
  const FileSizeSignalHeld held;
  while (!bytes.empty()) {
    const ssize_t written = write(file, bytes.data(), bytes.size());
    if (written <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

}  // namespace

Result<LoadedLibrary> LoadedLibrary::map(const std::filesystem::path& file) {
  // A name with a slash, or the loader would search its own folders.
  std::error_code error;
  const std::filesystem::path whole = std::filesystem::absolute(file, error);
  if (error) return Error{"the current folder is gone"};
  void* const handle = open(whole.string());
  if (handle == nullptr) return refusal(whole.string());
  return LoadedLibrary(handle, -1);
}

Result<LoadedLibrary> LoadedLibrary::copy(std::string_view bytes, const std::string& name) {
  LoadedLibrary library(nullptr, memfd_create(name.c_str(), MFD_CLOEXEC));
  if (library.memoryFile_ < 0 || !writeAll(library.memoryFile_, bytes)) {
    return Error{"there is no room for a copy of it"};
  }
  const std::string path = pathOf(library.memoryFile_);
  if (Result<void> object = checkSharedObject(path); !object) return object.error();
  library.handle_ = open(path);
  if (library.handle_ == nullptr) return refusal(path);
  return library;
}

LoadedLibrary::~LoadedLibrary() {
  if (handle_ != nullptr) dlclose(handle_);
  if (memoryFile_ < 0) return;
  // Some libraries stay all the same (thread-local objects, -z nodelete).
  void* const stays = dlopen(pathOf(memoryFile_).c_str(), RTLD_NOW | RTLD_NOLOAD);
  if (stays != nullptr) {
    dlclose(stays);
  } else {
    close(memoryFile_);
  }
}

void* LoadedLibrary::symbol(const char* name) const noexcept {
  return dlsym(handle_, name);
}

}  // namespace teren
