// Reads whole files of a person's, with a limit.
#pragma once

#include <cstddef>
#include <string>

#include "teren/Result.h"

namespace teren {

/// The bytes of a file, at most `most`. Reads with the limit and not by the size the file claims, so one
/// without an end is no trap. Errors name the file: it is not there, or a folder, a pipe, a device or larger
/// than `most`, or cannot be read.
Result<std::string> readFile(const std::string& file, std::size_t most);

}  // namespace teren
