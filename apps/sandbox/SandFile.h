// Sand in files: saved and loaded whole, and exported for other programs.
#pragma once

#include <cstddef>
#include <string>

#include "teren/Result.h"

#include "generators/sand/Sandbox.h"

namespace teren {

/// Larger files are no sand: room for some ten million vertices.
inline constexpr std::size_t kMostSandBytes = std::size_t{1} << 30;

/// Writes the sandbox as SandArchive.h says. The file appears whole or not at all; what was there before
/// stays where it cannot be written (OutputFile.h). Errors name the file.
Result<void> saveSand(const std::string& file, const Sandbox& sandbox);

/// The sandbox that was saved, which goes on as the saved one would have. Errors name the file: it cannot be
/// read, or what it holds is refused (SandArchive.h).
Result<Sandbox> loadSand(const std::string& file);

/// Writes the surface as an .obj file: vertices in the sandbox's metres, east, north and up, in the order of
/// their ids, each with its normal, the mean of its faces' weighted by their areas, to four decimals; then
/// the triangles, counter-clockwise as seen from above. Numbers have as many digits as give the same doubles
/// back. As careful with the file as saveSand(). O(n); memory: 4 bytes a vertex.
Result<void> exportObj(const std::string& file, const Sandbox& sandbox);

}  // namespace teren
