// A shared library in this process: loaded from its file, or from a copy that nobody else can change.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include "teren/Result.h"

namespace teren {

/// Owns what dlopen opened, with RTLD_NOW | RTLD_LOCAL; its end unloads the library, unless it was told to
/// keep it. The sentence of an error does not repeat the file's name.
class LoadedLibrary {
 public:
  /// Maps the file. Whoever overwrites it in place changes the running code. A file of a name that is loaded
  /// already is not read again.
  static Result<LoadedLibrary> map(const std::filesystem::path& file);

  /// Loads these bytes of a file from a memory file of their own; `name` is what /proc/self/maps shows. Each
  /// call makes a library of its own, also from equal bytes, unless they hold unique symbols (see
  /// makeUniqueSymbolsWeak).
  static Result<LoadedLibrary> copy(std::string_view bytes, const std::string& name);

  LoadedLibrary(LoadedLibrary&& other) noexcept
      : handle_(std::exchange(other.handle_, nullptr)), memoryFile_(std::exchange(other.memoryFile_, -1)) {}
  LoadedLibrary& operator=(LoadedLibrary&& other) noexcept {
    std::swap(handle_, other.handle_);
    std::swap(memoryFile_, other.memoryFile_);
    return *this;
  }
  ~LoadedLibrary();

  /// The library stays loaded until the process ends. A copy's memory and its file descriptor stay with it.
  void keep() noexcept { handle_ = nullptr, memoryFile_ = -1; }

  /// nullptr where it exports no such symbol.
  void* symbol(const char* name) const noexcept;

 private:
  LoadedLibrary(void* handle, int memoryFile) noexcept : handle_(handle), memoryFile_(memoryFile) {}

  void* handle_;
  int memoryFile_;  // -1: none
};

}  // namespace teren
