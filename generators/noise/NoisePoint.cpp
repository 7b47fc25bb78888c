// The field at one point in double, with its slopes: what samples are compared with.
#include <cmath>

#include "generators/noise/Noise.h"
#include "generators/noise/NoiseConstants.h"
#include "generators/noise/NoiseLattice.h"

namespace teren {
namespace {

/// A height and its slopes along two axes; operators as derivatives demand.
struct Jet {
  double value = 0.0, east = 0.0, north = 0.0;
};
Jet operator+(const Jet& a, const Jet& b) noexcept {
  return {a.value + b.value, a.east + b.east, a.north + b.north};
}
Jet operator*(const Jet& a, const Jet& b) noexcept {
  return {a.value * b.value, a.east * b.value + a.value * b.east, a.north * b.value + a.value * b.north};
}
Jet operator*(double factor, const Jet& a) noexcept {
  return {factor * a.value, factor * a.east, factor * a.north};
}
Jet size(const Jet& a) noexcept {
  return a.value < 0.0 ? -1.0 * a : a;
}

/// A cell, and the offset from its corner in cells of the lattice's own axes.
struct PlaceInCell {
  std::uint64_t cellX, cellY;
  double x, y;
};

class Octave {
 public:
  Octave(NoiseKind kind, const NoiseLattice& lattice, const PlaceInCell& place) noexcept
      : kind_(kind),
        place_(place),
        keysX_(axisKeysFrom(place.cellX, lattice.seedX)),
        keysY_(axisKeysFrom(place.cellY, lattice.seedY)) {}

  /// Noise, and its slopes along east and north in cells.
  Jet noise() const noexcept { return kind_ == NoiseKind::perlin ? perlin() : simplex(); }

 private:
  /// A corner's gradient times the offset (x, y) from it.
  Jet corner(int east, int north, double x, double y) const noexcept {
    const int direction = cornerGradient(axisHash(place_.cellX + static_cast<unsigned>(east), keysX_),
                                         axisHash(place_.cellY + static_cast<unsigned>(north), keysY_));
    const NoiseGradients& gradients = noiseGradients(kind_);
    const double gradientEast = gradients.east[direction], gradientNorth = gradients.north[direction];
    return {gradientEast * x + gradientNorth * y, gradientEast, gradientNorth};
  }

  Jet perlin() const noexcept {
    const auto weight = [](double t) { return t * t * t * (t * (t * 6.0 - 15.0) + 10.0); };
    const auto slope = [](double t) { return 30.0 * t * t * (t - 1.0) * (t - 1.0); };
    const double x = place_.x, y = place_.y;
    const Jet eastern{weight(x), slope(x), 0.0}, western{1.0 - weight(x), -slope(x), 0.0};
    const Jet northern{weight(y), 0.0, slope(y)}, southern{1.0 - weight(y), 0.0, -slope(y)};
    return southern * (western * corner(0, 0, x, y) + eastern * corner(1, 0, x - 1.0, y)) +
           northern * (western * corner(0, 1, x, y - 1.0) + eastern * corner(1, 1, x - 1.0, y - 1.0));
  }

  Jet simplex() const noexcept {
    const int east = place_.x > place_.y ? 1 : 0;
    return kernel(0, 0) + kernel(east, 1 - east) + kernel(1, 1);
  }

  Jet kernel(int east, int north) const noexcept {
    const double skewedX = place_.x - east, skewedY = place_.y - north;
    const double x = skewedX - (skewedX + skewedY) * kUnskewExact;
    const double y = skewedY - (skewedX + skewedY) * kUnskewExact;
    const Jet t{0.5 - x * x - y * y, -2.0 * x, -2.0 * y};
    if (t.value <= 0.0) return {};
    return t * t * (t * t) * corner(east, north, x, y);
  }

  NoiseKind kind_;
  PlaceInCell place_;
  AxisKeys keysX_, keysY_;
};

/// One lattice coordinate, moved by so many cells.
void moved(WideWord coordinate, double cells, std::uint64_t& cell, double& offset) noexcept {
  const double part = static_cast<double>(static_cast<std::uint64_t>(coordinate)) * 0x1p-64;
  const double whole = std::floor(part + cells);
  cell = cellOf(coordinate) + static_cast<std::uint64_t>(static_cast<std::int64_t>(whole));
  offset = part + (cells - whole);
}

/// The noise of octave `number`, its slopes in 1/m, at the request's origin moved by (east, north) [m], whose
/// own slopes are dimensionless.
Jet octaveAt(const Noise& noise, const FieldRequest& request, int number, const Jet& east, const Jet& north) {
  const NoiseSettings& settings = noise.settings();
  const double frequency = number < kMostNoiseOctaves ? noise.plan().frequency(number) : settings.frequency;
  const NoiseLattice lattice(settings.kind, frequency * request.pitch, request.seed, number);
  const WideWord x = noisePosition(request.i, request.u), y = noisePosition(request.j, request.v);
  const double cells = warpedCells(settings, frequency, request.pitch);
  const bool simplex = settings.kind == NoiseKind::simplex;
  const double straight = simplex ? cells * (1.0 + kSkew) : cells, across = simplex ? cells * kSkew : 0.0;
  PlaceInCell place{};
  moved(x * lattice.straight + y * lattice.across + lattice.phaseX,
        east.value * straight + north.value * across, place.cellX, place.x);
  moved(x * lattice.across + y * lattice.straight + lattice.phaseY,
        east.value * across + north.value * straight, place.cellY, place.y);
  const Jet jet = Octave(settings.kind, lattice, place).noise();
  return {jet.value, cells * (jet.east * (1.0 + east.east) + jet.north * north.east),
          cells * (jet.east * east.north + jet.north * (1.0 + north.north))};
}

}  // namespace

NoisePoint Noise::pointAt(const FieldRequest& request) const noexcept {
  Jet east, north;
  if (settings_.warp > 0.0) {
    const double metres = settings_.warp / std::sqrt(noiseConstants(settings_.kind).variance);
    east = metres * octaveAt(*this, request, kMostNoiseOctaves, {}, {});
    north = metres * octaveAt(*this, request, kMostNoiseOctaves + 1, {}, {});
  }
  Jet sum{plan_.constant(settings_.octaves), 0.0, 0.0}, before{plan_.before(), 0.0, 0.0};
  for (int n = 0; n < settings_.octaves; ++n) {
    const Jet noise = octaveAt(*this, request, n, east, north);
    if (settings_.fractal == NoiseFractal::fbm) {
      sum = sum + plan_.amplitude(n) * noise;
    } else if (settings_.fractal == NoiseFractal::billow) {
      sum = sum + plan_.amplitude(n) * size(noise);
    } else {
      const Jet distance = Jet{1.0, 0.0, 0.0} + -1.0 * size(noise);
      const Jet ridge = distance * distance;
      sum = sum + plan_.amplitude(n) * (ridge * before);
      before = ridge;
    }
  }
  return {sum.value, sum.east, sum.north};
}

}  // namespace teren
