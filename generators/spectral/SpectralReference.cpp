#include "generators/spectral/SpectralReference.h"

#include <algorithm>

#include "generators/numbers/Turn.h"

namespace teren {
namespace {

/// Adds every wave to every sample. A table of one turn in `side` parts holds each angle exactly.
template <class Real, class Sample>
void addWaves(const SpectralSynthesis& synthesis, const MapRequest& request, Sample&& sample) {
  const int side = request.samples - 1;
  const SpectralHarmonics harmonics = synthesis.harmonicsOf(request);
  const int largest = harmonics.largest();
  const Real scale = synthesis.scaleOf(request);
  std::vector<Real> cosines, sines;
  for (int n = 0; n < side; ++n) {
    const SineCosine turn = sineCosineOfTurn(static_cast<double>(n) / side);
    cosines.push_back(static_cast<Real>(turn.cosine));
    sines.push_back(static_cast<Real>(turn.sine));
  }
  std::vector<Harmonic> row(static_cast<std::size_t>(2 * largest + 1));
  for (int l = 0; l <= largest; ++l) {
    harmonics.row(l, row.data());
    for (int k = -largest; k <= largest; ++k) {
      const Real re = scale * static_cast<Real>(row[static_cast<std::size_t>(largest + k)].re);
      const Real im = scale * static_cast<Real>(row[static_cast<std::size_t>(largest + k)].im);
      if (re == 0 && im == 0) continue;
      const int mask = side - 1;
      for (int y = 0; y <= side; ++y) {
        for (int x = 0; x <= side; ++x) {
          const int n = (k * x + l * y) & mask;
          sample(x, y) += re * cosines[n] - im * sines[n];
        }
      }
    }
  }
}

}  // namespace

std::vector<double> spectralReference(const SpectralSynthesis& synthesis, const MapRequest& request) {
  const auto samples = static_cast<std::size_t>(request.samples);
  std::vector<double> heights(samples * samples);
  addWaves<double>(synthesis, request, [&](int x, int y) -> double& {
    return heights[static_cast<std::size_t>(y) * samples + static_cast<std::size_t>(x)];
  });
  return heights;
}

void spectralDirectSum(const SpectralSynthesis& synthesis, const MapRequest& request, HeightView out) {
  for (int row = 0; row < out.rows(); ++row) std::fill_n(out.row(row), out.columns(), 0.0f);
  addWaves<float>(synthesis, request, [&](int x, int y) -> float& { return out.row(y)[x]; });
}

}  // namespace teren
