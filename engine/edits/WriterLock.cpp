#include "edits/WriterLock.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace teren {

namespace {

/// Whether the name still leads to the file that was opened: who held the lock before may have removed it.
bool isStillThere(int descriptor, const std::string& name) {
  struct stat opened {
  }, named{};
  return fstat(descriptor, &opened) == 0 && stat(name.c_str(), &named) == 0 &&
         opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
}

}  // namespace

WriterLock::WriterLock(const std::filesystem::path& journal) : name_(journal.string() + "-lock") {
  for (;;) {
    descriptor_ = open(name_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (descriptor_ < 0) {
      problem_ = std::strerror(errno);
      return;
    }
    if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
      outcome_ = errno == EWOULDBLOCK ? Outcome::heldByAnother : Outcome::impossible;
      problem_ = std::strerror(errno);
      close(std::exchange(descriptor_, -1));
      return;
    }
    if (isStillThere(descriptor_, name_)) break;
    close(std::exchange(descriptor_, -1));
  }
  outcome_ = Outcome::taken;
}

WriterLock::~WriterLock() {
  if (descriptor_ < 0) return;
  unlink(name_.c_str());
  close(descriptor_);
}

}  // namespace teren
