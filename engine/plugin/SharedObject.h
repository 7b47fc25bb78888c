// A look at a module's file before the dynamic loader maps it: the loader trusts the sizes an ELF header
// states, so a file cut short would end the whole process (SIGBUS) instead of giving an error.
#pragma once

#include <filesystem>
#include <span>

#include "teren/Result.h"

namespace teren {

/// Refuses what is not a regular file, not a shared object for this machine, shorter than its headers say,
/// or built with a sanitizer this process does not run with (whose library would end the process).
/// Reads only headers; costs a few system calls.
Result<void> checkSharedObject(const std::filesystem::path& file);

/// Of symbols that g++ marks as unique (statics of inline functions and templates that are not hidden) the
/// loader keeps one in the whole process, so that a second version of a library would use the first one's,
/// and neither could be unloaded. Rewrites them, in the bytes of a whole file, as ordinary symbols; returns
/// whether there were any. Bytes that are no shared object for this machine, or damaged, stay as they are.
bool makeUniqueSymbolsWeak(std::span<char> file) noexcept;

}  // namespace teren
