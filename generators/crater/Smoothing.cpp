#include "generators/crater/Smoothing.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace teren {

/// A step spreads a sample with variance 2/8 [samples^2] along each axis where the weight is 1.
int Smoothing::stepsFor(double samples) noexcept {
  assert(0.0 <= samples && samples <= kMostSamples);
  return std::max(1, -static_cast<int>(std::floor(-4.0 * samples * samples)));
}

Smoothing::Smoothing(const DeformRegion& region, double east, double north, double radius, int steps)
    : east_(east), north_(north), radius_(radius), spacing_(region.spacing), steps_(steps) {
  assert(radius > 0.0 && 1 <= steps && steps <= kMostSteps);
  covered_ = region.within(east, north, reach(radius, spacing_));
  row_ = covered_.row;
  here_.resize(static_cast<std::size_t>(covered_.columns) + 2);
  south_.resize(here_.size());
}

double Smoothing::share(int twiceX, int twiceY) const noexcept {
  const double x = (0.5 * twiceX * spacing_ - east_) / radius_;
  const double y = (0.5 * twiceY * spacing_ - north_) / radius_;
  const double left = std::max(0.0, 1.0 - (x * x + y * y));
  return 0.125 * (left * left);
}

/// Bound by arithmetic: some 30 operations a sample.
bool Smoothing::row(DeformGrid& grid) {
  if (covered_.isEmpty()) {  // so small that it lies between samples
    --steps_;
    return true;
  }
  const auto keep = [&](std::vector<double>& row, int y) {
    for (int x = 0; x < covered_.columns + 2; ++x)
      row[static_cast<std::size_t>(x)] = grid(covered_.column - 1 + x, y);
  };
  if (row_ == covered_.row) keep(south_, row_ - 1);
  keep(here_, row_);
  for (int x = 0; x < covered_.columns; ++x) {
    const std::size_t k = static_cast<std::size_t>(x) + 1;
    const int twiceX = 2 * (covered_.column + x), twiceY = 2 * row_;
    const double height = here_[k];
    const double west = share(twiceX - 1, twiceY) * (here_[k - 1] - height);
    const double east = share(twiceX + 1, twiceY) * (here_[k + 1] - height);
    const double south = share(twiceX, twiceY - 1) * (south_[k] - height);
    const double north = share(twiceX, twiceY + 1) * (grid(covered_.column + x, row_ + 1) - height);
    const double change = (west + east) + (south + north);
    if (change != 0.0) grid.set(covered_.column + x, row_, height + change);
  }
  std::swap(here_, south_);
  if (++row_ < covered_.row + covered_.rows) return false;
  row_ = covered_.row;
  --steps_;
  return true;
}

}  // namespace teren
