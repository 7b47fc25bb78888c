#include "apps/files/InputFile.h"

#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <system_error>

#include "teren/Quote.h"

namespace teren {

Result<std::string> readFile(const std::string& file, std::size_t most) {
  std::error_code problem;
  // A zero byte ends a name for the system, which would open another file.
  if (file.find('\0') != std::string::npos || !std::filesystem::is_regular_file(file, problem)) {
    return Error{inQuotes(file) + " is not a file that can be read"};
  }
  const Error tooLarge{inQuotes(file) + " is larger than " + std::to_string(most / 1024) + " KiB"};
  // What a file claims is at least a reason to refuse it before reading.
  if (std::filesystem::file_size(file, problem) > most && !problem) return tooLarge;
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(std::fopen(file.c_str(), "rb"), &std::fclose);
  std::string bytes;
  std::array<char, std::size_t{1} << 16> piece;
  bool more = stream != nullptr;
  while (more && bytes.size() <= most) {
    const std::size_t read = std::fread(piece.data(), 1, piece.size(), stream.get());
    bytes.append(piece.data(), read);
    more = read > 0;
  }
  if (stream == nullptr || std::ferror(stream.get()) != 0) return Error{inQuotes(file) + " cannot be read"};
  if (bytes.size() > most) return tooLarge;
  return bytes;
}

}  // namespace teren
