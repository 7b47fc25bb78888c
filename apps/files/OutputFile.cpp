#include "apps/files/OutputFile.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

#include "teren/Quote.h"

namespace teren {
namespace {

Error cannotWrite(const std::filesystem::path& file, const std::string& why) {
  return {"cannot write " + inQuotes(file.string()) + ": " + why};
}

/// What a file made in the ordinary way would be allowed; mkstemp's are for the owner alone.
mode_t ordinaryMode() {
  const mode_t mask = umask(0);
  umask(mask);
  return 0666 & ~mask;
}

}  // namespace

Result<OutputFile> OutputFile::create(const std::filesystem::path& file) {
  // A zero byte ends a name for the system, which would write another file.
  if (file.native().find('\0') != std::string::npos) return cannotWrite(file, "its name holds a zero byte");
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(file, error);
  std::filesystem::path target = file;
  if (std::filesystem::exists(status)) {
    if (!std::filesystem::is_regular_file(status)) return cannotWrite(file, "it is not a regular file");
    target = std::filesystem::canonical(file, error);
    if (error) return cannotWrite(file, error.message());
  }
  std::string temporary = target.string() + ".part-XXXXXX";
  const int descriptor = mkstemp(temporary.data());
  if (descriptor < 0) return cannotWrite(file, std::strerror(errno));
  fchmod(descriptor, ordinaryMode());
  std::FILE* stream = fdopen(descriptor, "wb");
  if (stream == nullptr) {
    const int reason = errno;
    close(descriptor);
    unlink(temporary.c_str());
    return cannotWrite(file, std::strerror(reason));
  }
  return OutputFile(target, std::move(temporary), stream);
}

OutputFile::~OutputFile() {
  if (!temporary_.empty()) unlink(temporary_.c_str());
}

Result<void> OutputFile::commit() {
  const bool earlier = std::ferror(stream_.get()) != 0;
  const bool flushed = std::fflush(stream_.get()) == 0 && fsync(fileno(stream_.get())) == 0;
  const int reason = errno;
  if (earlier || !flushed)
    return cannotWrite(file_, flushed ? "an earlier write failed" : std::strerror(reason));
  if (std::rename(temporary_.c_str(), file_.c_str()) != 0) return cannotWrite(file_, std::strerror(errno));
  temporary_.clear();
  return {};
}

}  // namespace teren
