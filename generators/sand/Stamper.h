// Pressing a tool into sand: outlines become constrained edges, what was there goes, and is heaped up beside.
#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "teren/Result.h"

#include "generators/sand/ChangeList.h"
#include "generators/sand/SandSurface.h"
#include "generators/sand/ToolShape.h"

namespace teren {

/// Where a tool is pressed in. All in metres, in the frame's coordinates.
struct StampPlace {
  double x = 0.0;
  double y = 0.0;
  double height = 0.0;      // of the tool's zero; its underside lies ToolDepth below
  double directionX = 0.0;  // the way it is pushed, a vector of length 1; 0, 0: straight down
  double directionY = 0.0;
};

struct StampSettings {
  double fit = 0.01;        // [m] the outer outline follows the ground as near; nearer costs vertices
  double loosening = 0.02;  // [m] solid ground that is cut becomes loose as deep as this
  double bermWidth = 0.6;   // of the tool's reach: how far around it material is heaped up
};

/// What the parts of a stamp cost [s of the thread's processor time]. Nothing that is computed depends on it.
struct StampTimes {
  double insertion = 0.0;    // locating and inserting the vertices of outlines
  double constraints = 0.0;  // enforcing outlines, dissolving older ones inside
  double removal = 0.0;      // finding what lies inside, lowering and removing it
  double berm = 0.0;
};

/// What one stamp did.
struct StampReport {
  int contour = 0;         // vertices on its outlines
  int removed = 0;         // vertices inside that had become redundant
  double displaced = 0.0;  // [m^3] taken from under the tool, and heaped up
  StampTimes times;
};

/// Follows the published method (thesis of Pilsen 2009): the outer outline is divided until it fits the
/// ground and enforced, with heights from the ground; then the inner ones, at the tool's underside, where
/// that is below the ground: a tool digs and never fills. Constraints of older stamps inside are dissolved. A
/// vertex inside goes unless it is deeper than the tool, or next to one that is.
///
/// Different from it: the removed volume is not approximated. It is what the surface owes afterwards, and a
/// berm of exactly that volume rises on the rim and within bermWidth around it: all around a tool that comes
/// straight down, otherwise most ahead, less beside, nothing behind.
///
/// A tool may reach beyond the box: it is cut off at the border, as if there were a wall, and what it pushes
/// stays inside, all around it where next to nothing lies ahead. Outlines that run along the border within
/// half the thickness of the tool's walls are put on it.
///
/// What is cut becomes loose; slides are up to the caller. Cost: that of the insertions, edges and removals
/// it takes, none of which depends on the size of the mesh. One thread; keeps its scratch memory.
class Stamper {
 public:
  explicit Stamper(const StampSettings& settings) noexcept : settings_(settings) {}

  /// Refused, and nothing changes, where a number is not finite, the direction's length is neither 0 nor 1,
  /// the tool's underside lies beyond the box, the tool covers all of it, its walls are thinner, straight
  /// across, than 8 lattice steps, or the surface has no room for more vertices.
  Result<StampReport> stamp(SandSurface& surface, const ToolShape& tool, const StampPlace& place);

  /// Another one's last stamp has left its outlines here, too, on vertices that are `taken` by now; its
  /// constraints have ids from nextId() on.
  void take(const Stamper& other, std::span<const VertexId> taken);
  /// The constraints of the next stamp will have this id or higher ones.
  std::uint32_t nextId() const noexcept { return nextId_; }
  /// The vertices on the last stamp's outer outlines, and those left within.
  std::span<const VertexId> rim() const noexcept { return allRims_.ids(); }
  std::span<const VertexId> inside() const noexcept { return allInside_.ids(); }
  std::size_t bytes() const noexcept;

 private:
  friend class SandState;  // archives

  /// An outline's vertices and edges carry this id or the next: outer, inner.
  struct Ids {
    std::uint32_t outer = 0, inner = 0;
  };

  Result<void> check(const SandSurface& surface, const ToolShape& tool, const StampPlace& place) const;
  void press(SandSurface& surface, const ToolPart& part, const StampPlace& place, StampReport& report);
  void enforceOuter(SandSurface& surface, const ToolPart& part, const StampPlace& place, std::uint32_t id,
                    StampTimes& times);
  void enforceInner(SandSurface& surface, const ToolPart& part, const StampPlace& place, std::uint32_t id,
                    StampTimes& times);
  void fit(SandSurface& surface, LatticePoint a, LatticePoint b, int halvings);
  void enforce(SandSurface& surface, bool closed, std::uint32_t id, StampTimes& times);
  void flood(const SandSurface& surface, const Ids& ids);
  void dissolveInside(SandSurface& surface, const Ids& ids);
  void dig(SandSurface& surface, const ToolPart& part, const StampPlace& place, StampReport& report);
  void heapUp(SandSurface& surface, const ToolShape& tool, const StampPlace& place);
  void charge(double& part) noexcept;
  double collectBerm(const SandSurface& surface, const ToolShape& tool, const StampPlace& place,
                     bool directed);

  StampSettings settings_;
  std::uint32_t nextId_ = 1;
  VertexId near_ = 0;                   // where the last insertion was
  std::chrono::nanoseconds charged_{};  // all processor time until then belongs to a part

  std::vector<LatticePoint> outline_;
  std::vector<LatticePoint> bottom_;  // points of the first inner outline
  std::vector<VertexId> chain_;
  std::vector<std::pair<VertexId, VertexId>> edges_;
  ChangeList insideTriangles_, insideVertices_, rim_, forced_;
  ChangeList allRims_, allInside_;  // of all parts
  ChangeList around_;
  std::vector<double> share_;
  VertexId heaviest_ = kNoVertex;  // of those with a share
};

/// How the stamps of a drag are spaced: the way in a sixtieth of a second, but between an eighth and a half
/// of the tool's reach, so that a slow tool leaves no more traces than it needs and a fast one no gaps [m].
double stampSpacing(double speed, const ToolShape& tool) noexcept;

/// A drag from one place to another: stamps at equal distances of at most `spacing` > 0, the last at the end,
/// the first one spacing after the start; heights in between; directions along the way. Nothing where both
/// are one place. At most 2^16 stamps.
std::vector<StampPlace> stampsAlong(const StampPlace& from, const StampPlace& to, double spacing);

}  // namespace teren
