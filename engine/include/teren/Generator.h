// Plugin kind 1: a generator invents base maps. It is an immutable value made from checked parameters;
// a changed parameter makes a new generator.
#pragma once

#include <cstdint>
#include <memory>

#include "teren/HeightMap.h"
#include "teren/Parameter.h"
#include "teren/Slice.h"

namespace teren {

/// Which base map is wanted, and how fine.
struct MapRequest {
  std::int64_t i = 0, j = 0;  ///< lattice point, in the layer's lattice
  std::uint64_t seed = 0;     ///< of this map alone, already hashed from world, layer and lattice point
  int samples = 65;  ///< side at this level, 2^k + 1; 1 (the centre) where the stride exceeds half the side
  int level = 0;     ///< stride 2^level through the finest map
  double spacing = 2.0;  ///< [m] between samples at this level

  /// Intervals along a side of the finest map, a power of two: finest side minus one. A request for the
  /// centre alone (samples = 1) does not know it, so it carries `finestIntervals` explicitly.
  int finestIntervals = 64;  ///< at least 2
};

/// What a generator promises of its maps, in metres. At every sample of every map the mean over all seeds
/// is `mean` and the standard deviation over all seeds is about `deviation`; samples outside [min, max]
/// mean a broken generator and are rejected. Bounds are never used for bounding boxes, which are measured.
struct HeightRange {
  double mean = 0.0, deviation = 0.0, min = 0.0, max = 0.0;
};

struct Traits {
  /// Maps above level 0 differ from the subsampled finest map. Without it, a map at level L must equal every
  /// 2^L-th sample of the same map at level 0, bit for bit.
  bool approximate = false;
  /// One field over the whole plane, sampled where it is wanted, instead of maps to be blended: the generator
  /// is a ContinuousGenerator.
  bool continuous = false;
};

/// The making of one base map, in slices; `step` returns true once the map is complete.
using GenerationTask = SlicedTask;

/// A source of base maps. Const and thread-safe: `begin` may be called from any thread, and any number of
/// its tasks may run at once. A concrete class also has
///   static std::span<const Parameter> parameters() noexcept;   // its table
///   explicit Class(const Values&);                             // values already checked against the table
/// and a whole useful plugin fits in about 40 lines.
class Generator {
 public:
  virtual ~Generator() = default;

  virtual Traits traits() const { return {}; }
  virtual HeightRange range() const = 0;

  /// Root mean square [m] over a finest map and over seeds of: the finest map minus the triangles through
  /// its level-L samples. `samples` is the side of the finest map and `spacing` [m] the distance of its
  /// samples, which those ignore whose maps stretch with the lattice. 0 at level 0.
  virtual double residual(int level, int samples, double spacing) const = 0;

  /// Begins the map `request` asks for; `out` (request.samples square) must outlive the task and is complete
  /// when its step has returned true. A pure function of the generator's values and the request.
  virtual std::unique_ptr<GenerationTask> begin(const MapRequest& request, HeightView out) const = 0;
};

}  // namespace teren
