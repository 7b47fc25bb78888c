// How near vertices are drawn to the next coarser level's surface: by the error that may be seen, not by
// time.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "teren/Position.h"
#include "teren/SurfaceVertex.h"

namespace teren {

/// The eye whose distance vertices move with: the camera, or who else the detail of a picture was chosen for.
struct DetailEye {
  Position position = {};
  double height = 0.0;  ///< [m]

  friend bool operator==(const DetailEye&, const DetailEye&) = default;
};

/// Where a vertex is drawn lies between its own height and the coarser surface's, or beyond by at most this
/// share of the larger of the two: what rounding does.
inline constexpr float kMorphRounding = 0x1p-22F;

/// Where detail goes by error, a vertex of level L moves to the surface of level L + 1 as the eye goes away:
/// so a node and its four children look the same when they change places.
///
/// At a distance d a picture may be wrong by tolerance * d [m]. With E(L) the error of nodes of level L, a
/// vertex goes the share
///     t = u^2,   u = clamp((tolerance * d - F) / (E(L + 1) - F), 0, 1),   F = 1.25 E(L)
/// of its way (F halfway to E(L + 1) where that is less). Both surfaces' errors bound what lies between them,
/// and t E(L + 1) + (1 - t) E(L) <= tolerance * d wherever t > 0: what is moved is never worse than promised,
/// but over the few nodes (one in a thousand) that are rougher than E(L + 1) says: their children move as all
/// do. Where a node is split, E(L + 1) is reached and all its children have t = 1; where they merge, at 1.25
/// E(L + 1), it has t = 0. Both hold where the exchange is due; in a node's farther parts t of the node is
/// more, and that is the jump left: less than tolerance * d, and most of the time far less.
///
/// t follows from the vertex and the eye alone, so equal vertices move alike and nothing opens. All of it is
/// in floats, as the vertex shader has it.
class Morph {
 public:
  static constexpr std::size_t kLevels = SurfaceVertex::kFixed + 1;
  struct Range {
    float error = 0.0F;     ///< [m] F, where the way begins
    float perMetre = 0.0F;  ///< [1/m] 1 / (E(L + 1) - F); 0: no share of the way is gone
    friend bool operator==(const Range&, const Range&) = default;
  };

  /// Nothing moves.
  Morph() = default;
  /// `tolerance` [m of error for a metre of distance] >= 0: the pixel error wanted, divided by lensPixels().
  /// `errors` [m] of nodes by level. Vertices of the last level stay, as those of levels beyond kFixed do.
  Morph(double tolerance, std::span<const double> errors) noexcept;

  float tolerance() const noexcept { return tolerance_; }
  /// The same errors for another picture.
  Morph withTolerance(double tolerance) const noexcept {
    Morph other = *this;
    other.tolerance_ = static_cast<float>(tolerance);
    return other;
  }
  std::span<const Range, kLevels> ranges() const noexcept { return ranges_; }

  /// t of a vertex of a level at a distance [m]; `level` 0 ... kFixed.
  float share(int level, float distance) const noexcept {
    const Range& range = ranges_[static_cast<std::size_t>(level)];
    const float along = std::clamp((tolerance_ * distance - range.error) * range.perMetre, 0.0F, 1.0F);
    return along * along;
  }
  /// [m] Where a vertex is drawn whose own place, not moved, is so far [m] from the eye.
  float height(const SurfaceVertex& vertex, float distance) const noexcept {
    const float t = share(vertex.level(), distance);
    return vertex.height * (1.0F - t) + vertex.coarserHeight * t;
  }

  friend bool operator==(const Morph&, const Morph&) = default;

 private:
  float tolerance_ = 0.0F;
  std::array<Range, kLevels> ranges_{};
};

}  // namespace teren
