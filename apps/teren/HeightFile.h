// The formats `teren bake` writes, and the hash it prints.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <optional>

#include "teren/HeightMap.h"
#include "teren/Result.h"

namespace teren {

enum class HeightFormat {
  r32,  ///< little-endian float32, rows from south to north, each from west to east
  png,  ///< 16-bit grey, north row first, 0 ... 65535 = lowest ... highest height (all 0 where they are
        ///< equal)
};

/// The format a file's name asks for; the sentence says which there are.
Result<HeightFormat> heightFormat(const std::filesystem::path& file);

/// FNV-1a 64 of the .r32 bytes, so the same whatever the format; -0 counts as 0. About 1 s per GiB.
std::uint64_t heightHash(ConstHeightView heights) noexcept;

/// Asked before each row; false stops the writing.
using GoOn = std::function<bool()>;

/// Writes the rows; heights must be finite, at least one sample. Errors: the disk's, or "interrupted" where
/// goOn returned false. What was written by then is no whole file.
Result<void> writeHeights(ConstHeightView heights, HeightFormat format, std::FILE* stream, const GoOn& goOn);

}  // namespace teren
