#include "coin/GroundTexture.h"

#include <algorithm>
#include <cstddef>

#include "teren/Hash.h"

namespace teren {
namespace {

constexpr int kChannels = 4;
constexpr int kFirstCells = 4;  // cells along a side in the first octave
constexpr int kOctaves = 6;
constexpr float kFirstAmplitude = 0.55F;
constexpr float kNextAmplitude = 0.7F;  // times the one before

/// One octave of one channel: random values in [-1, 1] at the corners of cells, smooth between them.
class ValueNoise {
 public:
  ValueNoise(int channel, int cells) : cells_(cells), texels_(kGroundTextureSide / cells) {
    RandomSequence random(hashWith(static_cast<std::uint64_t>(channel), static_cast<std::uint64_t>(cells)));
    values_.resize(static_cast<std::size_t>(cells) * static_cast<std::size_t>(cells));
    for (float& value : values_) value = static_cast<float>(random.nextBits(24)) * 0x1p-23F - 1.0F;
  }

  float at(int column, int row) const {
    const int x = column / texels_;
    const int y = row / texels_;
    const float u = smoothStep(column % texels_);
    const float v = smoothStep(row % texels_);
    const float south = corner(x, y) * (1.0F - u) + corner(x + 1, y) * u;
    const float north = corner(x, y + 1) * (1.0F - u) + corner(x + 1, y + 1) * u;
    return south * (1.0F - v) + north * v;
  }

 private:
  float corner(int x, int y) const {
    return values_[static_cast<std::size_t>((y % cells_) * cells_ + x % cells_)];
  }
  float smoothStep(int texel) const {
    const float t = static_cast<float>(texel) / static_cast<float>(texels_);
    return t * t * (3.0F - 2.0F * t);
  }

  int cells_;
  int texels_;  // along a cell's side
  std::vector<float> values_;
};

}  // namespace

std::vector<std::uint8_t> groundTexture() {
  constexpr std::size_t kTexels = std::size_t{kGroundTextureSide} * kGroundTextureSide;
  std::vector<float> sums(kTexels * kChannels, 0.0F);
  float amplitude = kFirstAmplitude;
  for (int octave = 0; octave < kOctaves; ++octave, amplitude *= kNextAmplitude) {
    for (int channel = 0; channel < kChannels; ++channel) {
      const ValueNoise noise(channel, kFirstCells << octave);
      for (std::size_t texel = 0; texel < kTexels; ++texel) {
        const auto column = static_cast<int>(texel % kGroundTextureSide);
        const auto row = static_cast<int>(texel / kGroundTextureSide);
        sums[texel * kChannels + static_cast<std::size_t>(channel)] += amplitude * noise.at(column, row);
      }
    }
  }
  std::vector<std::uint8_t> texels;
  texels.reserve(sums.size());
  for (const float sum : sums) {
    texels.push_back(static_cast<std::uint8_t>(127.5F + 127.5F * std::clamp(sum, -1.0F, 1.0F)));
  }
  return texels;
}

}  // namespace teren
