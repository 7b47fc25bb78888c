// The noise that keeps ground and water from looking painted: four channels of smooth random values.
#pragma once

#include <cstdint>
#include <vector>

namespace teren {

inline constexpr int kGroundTextureSide = 256;

/// RGBA texels, 8 bits a channel, of a kGroundTextureSide square that repeats without an edge: each channel
/// is a sum of octaves of value noise with mean one half. The same on every machine. About 10 ms.
std::vector<std::uint8_t> groundTexture();

}  // namespace teren
