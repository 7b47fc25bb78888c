// A look at a module's file before the dynamic loader maps it: the loader trusts the sizes an ELF header
// states, so a file cut short would end the whole process (SIGBUS) instead of giving an error.
#pragma once

#include <filesystem>

#include "teren/Result.h"

namespace teren {

/// Refuses what is not a regular file, not a shared object for this machine, shorter than its headers say,
/// or built with a sanitizer this process does not run with (whose library would end the process).
/// Reads only headers; costs a few system calls.
Result<void> checkSharedObject(const std::filesystem::path& file);

}  // namespace teren
