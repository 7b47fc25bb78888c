// How steep loose material can lie: the angle of repose, what moisture adds, and when a face starts to slide.
#pragma once

namespace teren {

/// Dry sand lies at 30 degrees (thesis of Pilsen 2009).
inline constexpr double kDryRepose = 30.0;  // [degree]
/// Damp sand, as castles are made of, lies steeper by as much.
inline constexpr double kMoistureGain = 15.0;  // [degree]
/// A face slides where it is steeper than the angle of repose by this.
inline constexpr double kSlideThreshold = 0.05;  // [degree]
/// It comes to rest below the angle by this: real sand, once it moves, stops a degree or two below the slope
/// that it stood at. So one face's slide rarely starts its neighbours', nothing oscillates, and sand comes to
/// rest in little more than half the steps that the angle itself would take.
inline constexpr double kRestBelow = 0.5;  // [degree]
/// Long edges are divided where a face is steeper by this. What lies between slides little, and would be
/// divided for nothing: a clean-up would take the vertex away, and so on for ever.
inline constexpr double kDivideThreshold = 2.0;  // [degree]
/// What is promised: once all is at rest no loose face is steeper than the angle of repose by more than this.
inline constexpr double kReposeTolerance = 0.1;  // [degree]

/// The slopes at which loose material comes to rest, starts to slide, and divides long edges; as tangents.
struct Repose {
  double rest = 0.0;
  double start = 0.0;
  double divide = 0.0;
  friend bool operator==(const Repose&, const Repose&) = default;
};

/// Angle of repose [degree], 1 ... 60, of dry material; moisture from 0 (dry) to 1 (damp). Moisture adds
/// kMoistureGain times itself: a straight line between the two states that one can build with. Material
/// beyond, soaked and flowing, is not described. Anything outside these ranges is the nearest inside; NaN is
/// dry sand.
Repose reposeOf(double dryAngle = kDryRepose, double moisture = 0.0) noexcept;

}  // namespace teren
