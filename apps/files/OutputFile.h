// A file that appears whole or not at all: it is written under a temporary name beside its own and renamed
// at the end.
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "teren/Result.h"

namespace teren {

class OutputFile {
 public:
  /// Makes the temporary file. Refuses a name that is taken by anything but a regular file (renaming would
  /// replace a device or a pipe), a name with a zero byte, and a folder that cannot be written. A link is
  /// followed: its target is what is replaced.
  static Result<OutputFile> create(const std::filesystem::path& file);

  OutputFile(OutputFile&& other) noexcept = default;
  OutputFile& operator=(OutputFile&&) = delete;
  /// Removes the temporary file if it was not committed.
  ~OutputFile();

  std::FILE* stream() const noexcept { return stream_.get(); }

  /// Writes what is buffered to the disk and gives the file its name. Nothing may be written after it.
  Result<void> commit();

 private:
  struct Close {
    void operator()(std::FILE* file) const noexcept { std::fclose(file); }
  };
  OutputFile(std::filesystem::path file, std::string temporary, std::FILE* stream)
      : file_(std::move(file)), temporary_(std::move(temporary)), stream_(stream) {}

  std::filesystem::path file_;
  std::string temporary_;  // empty once moved from or committed
  std::unique_ptr<std::FILE, Close> stream_;
};

}  // namespace teren
