#include "coin/GroundTexture.h"

#include <algorithm>
#include <cstddef>

#include "teren/Hash.h"

namespace teren {
namespace {

constexpr int kChannels = 4;
constexpr int kFirstCells = 4;  // cells along a side in the first octave
constexpr int kOctaves = 5;

/// In [-1, 1], at a node of the lattice of an octave; wraps around.
double lattice(int channel, int cells, int x, int y) {
  std::uint64_t hash = hashWith(static_cast<std::uint64_t>(channel), static_cast<std::uint64_t>(cells));
  hash = hashWith(hash, static_cast<std::uint64_t>(x % cells));
  hash = hashWith(hash, static_cast<std::uint64_t>(y % cells));
  return static_cast<double>(hash >> 11U) * 0x1p-52 - 1.0;
}

double smoothStep(double t) {
  return t * t * (3.0 - 2.0 * t);
}

double valueNoise(int channel, int cells, int column, int row) {
  const int texels = kGroundTextureSide / cells;
  const int x = column / texels;
  const int y = row / texels;
  const double u = smoothStep(static_cast<double>(column % texels) / texels);
  const double v = smoothStep(static_cast<double>(row % texels) / texels);
  const double south = lattice(channel, cells, x, y) * (1.0 - u) + lattice(channel, cells, x + 1, y) * u;
  const double north =
      lattice(channel, cells, x, y + 1) * (1.0 - u) + lattice(channel, cells, x + 1, y + 1) * u;
  return south * (1.0 - v) + north * v;
}

std::uint8_t texel(int channel, int column, int row) {
  double sum = 0.0;
  double amplitude = 0.55;
  for (int octave = 0; octave < kOctaves; ++octave) {
    sum += amplitude * valueNoise(channel, kFirstCells << octave, column, row);
    amplitude *= 0.7;
  }
  return static_cast<std::uint8_t>(127.5 + 127.5 * std::clamp(sum, -1.0, 1.0));
}

}  // namespace

std::vector<std::uint8_t> groundTexture() {
  std::vector<std::uint8_t> texels;
  texels.reserve(std::size_t{kGroundTextureSide} * kGroundTextureSide * kChannels);
  for (int row = 0; row < kGroundTextureSide; ++row) {
    for (int column = 0; column < kGroundTextureSide; ++column) {
      for (int channel = 0; channel < kChannels; ++channel) texels.push_back(texel(channel, column, row));
    }
  }
  return texels;
}

}  // namespace teren
