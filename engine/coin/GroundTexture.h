// The noise that keeps ground and water from looking painted: four channels of smooth random values.
#pragma once

#include <cstdint>
#include <vector>

namespace teren {

/// RGBA texels, 8 bits a channel, of a kGroundTextureSide square that repeats without an edge: each channel
/// is a sum of octaves of value noise with mean one half. The same on every machine. O(side^2), about 10 ms.
std::vector<std::uint8_t> groundTexture();
inline constexpr int kGroundTextureSide = 128;

}  // namespace teren
