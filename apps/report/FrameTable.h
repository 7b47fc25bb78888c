// What frames took in programs with a window, as their --stats wrote it.
#pragma once

#include <span>
#include <string>

#include "teren/Result.h"

#include "apps/report/Table.h"

namespace teren {

/// A row a file. Errors name the file: it cannot be read, is no JSON, or lacks a number.
Result<Table> readFrames(std::span<const std::string> files);

}  // namespace teren
