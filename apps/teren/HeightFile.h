// The formats `teren bake` writes, and the hash it prints.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>

#include "teren/HeightMap.h"
#include "teren/Result.h"

#include "apps/teren/MeshFile.h"

namespace teren {

enum class HeightFormat {
  r32,  ///< little-endian float32, rows from south to north, each from west to east
  png,  ///< 16-bit grey, north row first, 0 ... 65535 = lowest ... highest height (all 0 where they are
        ///< equal)
  obj,  ///< triangles, see writeObj
  iv,   ///< triangles, see writeInventor
};

/// The format a file's name asks for; the sentence says which there are.
Result<HeightFormat> heightFormat(const std::filesystem::path& file);

/// FNV-1a 64 of the .r32 bytes, so the same whatever the format; -0 counts as 0. About 1 s per GiB.
std::uint64_t heightHash(ConstHeightView heights) noexcept;

/// Writes the rows; heights must be finite, at least 2 x 2 samples. `place` matters to triangles only.
/// Errors: the disk's, or "interrupted" where progress returned false. What was written by then is no whole
/// file.
Result<void> writeHeights(ConstHeightView heights, HeightFormat format, const GroundPlace& place,
                          std::FILE* stream, const RowProgress& progress);

}  // namespace teren
