// The sand a person begins with: how large a box, of how many vertices, how deep, how rough.
#pragma once

#include <span>

#include "teren/Parameter.h"

#include "generators/sand/Sandbox.h"

namespace teren {

/// A square box, its south-west corner at (0, 0).
struct SandGround {
  double side = 1.0;        // [m]
  int vertices = 10'000;    // at most; where places coincide there are fewer
  double depth = 1.0;       // [m] of loose sand; below it the ground is solid
  double roughness = 0.0;   // [m] between the lowest and the highest place of the rolling start, 0: level
  std::uint64_t seed = 42;  // of the places and the rolling

  /// The same as a table, from which panels, scripts and command lines are made: size, vertices, depth,
  /// roughness, seed.
  static std::span<const Parameter> parameters() noexcept;
  /// `values` of that table.
  static SandGround from(const Values& values);
};

/// Sand whose vertices lie evenly, but not in rows: a sequence of low discrepancy (Roberts 2018, "The
/// unreasonable effectiveness of quasirandom sequences"), each place moved a little by a hash. The same for
/// the same ground, on every machine. Its faces are still to be looked at by the slides. O(n).
Sandbox makeSand(const SandGround& ground);

}  // namespace teren
