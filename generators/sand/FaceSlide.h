// How one steep triangle of loose material comes to rest: the only place where sliding changes heights.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "generators/sand/Repose.h"
#include "generators/sand/Ticks.h"
#include "generators/sand/VolumeLedger.h"

namespace teren {

/// A corner of a face. Its weight, twice the area of all triangles around it [steps^2], is what a tick of its
/// height adds to the sixfold volume; it is at least twice the face's own area.
struct FaceCorner {
  LatticePoint place;
  std::int64_t height = 0;  // of the surface [ticks]
  std::int64_t loose = 0;   // of that, thickness of loose material [ticks], >= 0
  std::int64_t weight = 0;  // > 0
  bool isFixed = false;     // bears nothing loose, and nothing may be laid on it
};

/// Corners counter-clockwise, not collinear.
using Face = std::array<FaceCorner, 3>;
/// By how much each corner rises [ticks].
using FaceMove = std::array<std::int64_t, 3>;

/// The tangent of the steepest way down a face, from exact integers, so slivers are as good as any; `step` is
/// the lattice's [m]. Relative error below 1e-14.
double slopeOf(const Face& face, double step) noexcept;

/// Something loose at another corner lies higher than a fixed one: if that gave way, the face, being steep,
/// would slide onto it.
bool leansOn(const Face& face, std::size_t fixed) noexcept;

/// All three corners bear loose material: only such a face is promised to come to rest.
constexpr bool isLoose(const Face& face) noexcept {
  return face[0].loose > kBareTicks && face[1].loose > kBareTicks && face[2].loose > kBareTicks;
}

/// The move that brings a face steeper than repose.start towards repose.rest; nothing where it is less steep,
/// or nothing can move.
///
/// The deviations of the heights from their weighted mean shrink by rest / slope, which makes the slope rest
/// and keeps the volume. No corner falls by as much as its loose thickness: the move is cut short where one
/// would. Where a corner that should fall is bare, or one is fixed, the other two exchange: the higher gives
/// to the lower, never beyond equal heights, as far as the slope needs or, where it does not reach rest,
/// falls.
///
/// Rounded to ticks, the heaviest corner balances the ledger; the move is to be entered there. A move always
/// lowers sum(weight (height - mean)^2) over the face, strictly, and is not made where ticks are too coarse
/// for that (faces narrower than about 2^-26 m); so no sequence of moves comes back to where it was.
std::optional<FaceMove> slideFace(const Face& face, const Repose& repose, double step,
                                  const VolumeLedger& ledger) noexcept;

/// What a move changes in the sixfold volume, exactly.
constexpr SixfoldVolume volumeOf(const Face& face, const FaceMove& move) noexcept {
  SixfoldVolume sum = 0;
  for (std::size_t i = 0; i < 3; ++i) sum += static_cast<WideInteger>(face[i].weight) * move[i];
  return sum;
}

/// What a move changes in sum(weight (height - mean)^2) over the face [ticks^2 steps^2], mean being that
/// before the move: negative in every move that slideFace makes.
double energyChange(const Face& face, const FaceMove& move) noexcept;

}  // namespace teren
