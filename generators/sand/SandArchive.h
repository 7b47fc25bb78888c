// A whole sandbox as bytes, to be kept in a file and gone on with later as if nothing had happened.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "teren/Result.h"

#include "generators/sand/Sandbox.h"

namespace teren {

/// The format: "TERENSND", version (u32), number of sections (u32), the sizes of the sections (u64 each),
/// the sections (SandState.h), a checksum of all that (u64). Little endian. About 82 bytes for each vertex
/// there has been room for.
///
/// A sandbox archived at any time between two calls, slides half done included, and its copy become the same
/// bit for bit under the same calls. Scratch memory and lists of what changed are not archived. Boxes must
/// have a step of 1e-12 ... 1e6 m and lie within 1e12 m, settings must not be negative: others are refused
/// when they are read. O(n).
std::vector<std::byte> archived(const Sandbox& sandbox);

/// The sandbox that was archived. Any other bytes are refused with one sentence that can follow a file's
/// name: of another kind, of a newer version, cut short, damaged (the checksum), and such as were made to do
/// harm (every promise of every part is proved, SandState::sandboxOf). Nothing is allocated that the bytes
/// there do not fill. O(n), about 1 us a vertex.
Result<Sandbox> restored(std::span<const std::byte> bytes);

}  // namespace teren
