// Plugin kind 2: a filter changes one base map in place, in slices.
#pragma once

#include <memory>

#include "teren/Generator.h"

namespace teren {

/// A change of base maps. Const and thread-safe like a Generator, and made like one. A layer with filters
/// is approximate: above level 0 its filters run on the coarse map.
class Filter {
 public:
  virtual ~Filter() = default;

  /// What the range of a map becomes. Where the new deviation depends on more than the range tells, this is
  /// an upper bound.
  virtual HeightRange range(const HeightRange& before) const = 0;

  /// What a residual (Generator::residual) becomes; an upper bound where it is not known better.
  virtual double residual(double before, int level) const = 0;

  /// Begins filtering `inOut`, a complete base map; it must outlive the task. A pure function of the
  /// filter's values, the request and the heights.
  virtual std::unique_ptr<SlicedTask> begin(const MapRequest& request, HeightView inOut) const = 0;
};

}  // namespace teren
