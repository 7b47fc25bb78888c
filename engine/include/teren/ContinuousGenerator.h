// A generator whose landscape is one field over the whole plane, noise or elevation data: its samples are
// drawn as they are, without maps and without blending.
#pragma once

#include <cassert>
#include <cstdint>
#include <memory>

#include "teren/Generator.h"

namespace teren {

/// Which samples of a continuous field are wanted, and how fine. Sample (c, r) lies (u + c spacing / pitch,
/// v + r spacing / pitch) pitches north-east of the origin: where u and v are multiples of spacing / pitch,
/// as on the engine's grids, that is exact in double.
struct FieldRequest {
  std::int64_t i = 0, j = 0;  ///< lattice point of the origin, in the layer's lattice; any value, modulo 2^64
  double u = 0.0, v = 0.0;    ///< [pitches] offset of the first sample from it, in [0, 1)
  std::uint64_t seed = 0;     ///< of the layer, the same everywhere
  double pitch = 64.0;        ///< [m] of the layer's lattice
  double spacing = 2.0;       ///< [m] between samples, the pitch times a power of two, 2^-20 or more
  int columns = 1, rows = 1;  ///< >= 1
  /// 0: the field itself, nothing left out. Above: detail below the Nyquist limit of `spacing` (waves
  /// shorter than two samples) may be left out.
  int level = 0;
};

/// A landscape layer that needs no blending. Const and thread-safe like any Generator. Where filters follow
/// it, or a tool wants base maps, its maps are pieces of the field.
class ContinuousGenerator : public Generator {
 public:
  /// Coarse maps leave detail out, so they are not the fine ones, sampled.
  Traits traits() const override { return {.approximate = true, .continuous = true}; }

  /// Begins the rectangle `request` asks for; `out` (request.columns x request.rows) must outlive the task
  /// and is complete when its step has returned true. A sample is a pure function of the generator's values,
  /// seed, pitch, spacing, level and its position, at level 0 without the spacing: the same bits whatever
  /// rectangle asks for it and from whichever lattice point it is counted.
  virtual std::unique_ptr<GenerationTask> beginField(const FieldRequest& request, HeightView out) const = 0;

  /// A bound [m], anywhere and for any seed, on |field - triangles through its samples `spacing` [m] apart|,
  /// the rounding of samples to float left out. Finite and >= 0.
  virtual double fieldError(double spacing) const = 0;

  /// The field over the map's square, with the map's own seed.
  std::unique_ptr<GenerationTask> begin(const MapRequest& request, HeightView out) const final {
    return beginField(fieldOf(request), out);
  }

 private:
  /// A map is centred on its lattice point and two pitches wide.
  static FieldRequest fieldOf(const MapRequest& map) noexcept {
    assert(map.finestIntervals >= 2 && map.level >= 0 && map.level < 63);
    const auto before = [](std::int64_t point) {
      return static_cast<std::int64_t>(static_cast<std::uint64_t>(point) - 1);
    };
    const bool centre = map.samples == 1;
    const double finest = map.spacing / static_cast<double>(std::int64_t{1} << map.level);
    return {.i = centre ? map.i : before(map.i),
            .j = centre ? map.j : before(map.j),
            .seed = map.seed,
            .pitch = finest * (map.finestIntervals / 2),
            .spacing = map.spacing,
            .columns = map.samples,
            .rows = map.samples,
            .level = map.level};
  }
};

/// The generator, if it is continuous; null where its traits say otherwise or it has no field to ask for.
inline const ContinuousGenerator* asContinuous(const Generator& generator) {
  return generator.traits().continuous ? dynamic_cast<const ContinuousGenerator*>(&generator) : nullptr;
}

}  // namespace teren
