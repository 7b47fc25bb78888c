#include "apps/fly/Steps.h"

#include <algorithm>
#include <array>

namespace teren {
namespace {

constexpr std::array kDistances{1e3,  1.5e3, 2e3,  3e3,  4e3,  5e3,  6e3,  8e3,  10e3, 12e3,
                                15e3, 20e3,  25e3, 30e3, 40e3, 50e3, 60e3, 80e3, 100e3};
constexpr std::array kPixelErrors{0.25, 0.35, 0.5,  0.7,  1.0,  1.4,  2.0,  2.8, 4.0,
                                  5.6,  8.0,  11.0, 16.0, 22.0, 32.0, 45.0, 64.0};
constexpr std::array kToolSizes{3.0,  4.0,  6.0,  8.0,  10.0, 12.0,  16.0,
                                20.0, 30.0, 40.0, 60.0, 80.0, 120.0, 200.0};
constexpr std::array kToolDepths{0.25, 0.5, 1.0, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 16.0, 25.0, 50.0};

}  // namespace

Steps Steps::distances() noexcept {
  return Steps(kDistances);
}

Steps Steps::pixelErrors() noexcept {
  return Steps(kPixelErrors);
}

double Steps::at(int index) const noexcept {
  return values_[static_cast<std::size_t>(std::clamp(index, 0, count() - 1))];
}

Steps Steps::toolSizes() noexcept {
  return Steps(kToolSizes);
}

Steps Steps::toolDepths() noexcept {
  return Steps(kToolDepths);
}

int Steps::nearest(double value) const noexcept {
  int index = 0;
  while (index + 1 < count() && at(index) * at(index + 1) < value * value) ++index;
  return index;
}

double Steps::next(double value, int direction) const noexcept {
  if (direction > 0) {
    const auto above = std::upper_bound(values_.begin(), values_.end(), value);
    return above == values_.end() ? std::max(value, values_.back()) : *above;
  }
  const auto here = std::lower_bound(values_.begin(), values_.end(), value);
  return here == values_.begin() ? std::min(value, values_.front()) : *(here - 1);
}

}  // namespace teren
