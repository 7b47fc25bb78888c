// Sand to play with: stamps, slides and clean-up taken together, one iteration at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "teren/Result.h"

#include "generators/sand/CleanUp.h"
#include "generators/sand/Opening.h"
#include "generators/sand/SandSurface.h"
#include "generators/sand/Slides.h"
#include "generators/sand/Stamper.h"

namespace teren {

struct SandSettings {
  double dryAngle = kDryRepose;  // [degree] Repose.h
  double moisture = 0.0;         // 0 ... 1
  double longestEdge =
      0.02;  // [m] Slides; shorter looks better where sand slides on coarse ground, and costs vertices
  double flatness = 1e-4;  // [m] the clean-up's tolerance; higher keeps fewer vertices
  StampSettings stamp;
};

/// One iteration: any number of stamps, then slides, then clean-up; then whoever draws asks for changes().
/// What clean-up unsettles slides in the next iteration, which may divide edges that clean-up joined. So that
/// this ends, the vertices that clean-up may take after a push (a stamp, another angle of repose,
/// loosenAll()) are counted: as many as there were then, and half of what is left after each round that
/// unsettled sand at rest. A round looks at all that waited when it began, in however many calls. So any game
/// comes to rest in log2(vertices) + 2 iterations of unlimited steps; what is left to clean waits for the
/// next push.
///
/// What is computed depends on the calls and their numbers of steps alone, so it is the same on every
/// machine. Costs are bounded by what is touched, not by the mesh. One thread; whoever draws in another one
/// copies what changed.
class Sandbox {
 public:
  Sandbox(SandSurface surface, const SandSettings& settings);

  /// As given, with the angle and the moisture that setRepose() set last.
  const SandSettings& settings() const noexcept { return settings_; }
  const SandSurface& surface() const noexcept { return surface_; }
  const Slides& slides() const noexcept { return slides_; }
  const CleanUp& cleanUp() const noexcept { return cleanUp_; }
  /// Other sand from now on; all faces are looked at again, which is O(n).
  void setRepose(double dryAngle, double moisture);
  /// Other sand from now on, but what is at rest stays so until something moves it. O(1).
  void setReposeOfWhatMoves(double dryAngle, double moisture);
  /// Looks at all faces again, as a new sandbox whose ground may be steep needs. O(n).
  void loosenAll();

  /// Presses a tool in; Stamper::stamp.
  Result<StampReport> stamp(const ToolShape& tool, const StampPlace& place);
  /// Takes closed squares of a grid of ground, with what is loose of it, into a fenced box (Opening.h), and
  /// lets the clean-up have as many vertices more as came.
  void open(ConstHeightView ground, ConstHeightView loose, std::span<const Opening::Cell> cells);
  /// Lets what leaned on the fence slide where it is gone; Slides::forgetLeanedOn.
  void forgetLeanedOn() { slides_.forgetLeanedOn(surface_); }
  /// SandSurface::grow: nobody sees anything change.
  void grow(int west, int south, int columns, int rows) { surface_.grow(west, south, columns, rows); }
  /// Takes the sand of another box, at rest as this one is, into squares from (column, row) on; Merging.h.
  /// What waits to be cleaned up there waits here, for the next push. Nobody sees anything change.
  void take(const Sandbox& other, int column, int row);
  /// Pours loose sand on: a mound, paraboloid of revolution, on what lies there. All in metres, finite, the
  /// radius at least 32 steps and its disc in the box. What slides, slides later.
  void pour(double x, double y, double radius, double height);
  /// Lets steep faces slide, at most so many steps. True: all is at rest.
  bool slide(std::uint64_t steps);
  /// Slides::stop.
  void stopSliding() noexcept { slides_.stop(); }
  /// Removes flat vertices among those that have moved since the last clean-up; nothing where it has taken
  /// its share since the last push. At most so many of them.
  void clean(std::size_t most = SandSurface::kMostVertices);
  /// slide(steps) and clean(). True: all is at rest.
  bool iterate(std::uint64_t steps);
  /// clean() would look at something.
  bool hasToClean() const noexcept { return removable_ > 0 && cleanUp_.waiting() > 0; }
  bool isDone() const noexcept { return slides_.atRest() && !hasToClean(); }

  /// Slots of vertices and triangles that changed, came or went since the last forgetChanges(): what a copy
  /// of the surface, kept elsewhere, has to look at.
  const ChangeList& changedVertices() const noexcept { return changedVertices_; }
  const ChangeList& changedTriangles() const noexcept { return changedTriangles_; }
  void forgetChanges() noexcept;

  /// Every byte held, unused capacity included.
  std::size_t bytes() const noexcept;

 private:
  friend class SandState;  // archives

  enum class Phase { stamping, sliding, cleaning };
  void push() noexcept;
  void collectChanges(Phase phase);

  SandSettings settings_;
  SandSurface surface_;
  Slides slides_;
  CleanUp cleanUp_;
  Stamper stamper_;
  Opening opening_;
  std::uint32_t keptId_ = 0;   // constraints of the last stamp stay until the next
  std::size_t removable_ = 0;  // so many vertices clean-up may still take
  std::size_t round_ = 0;      // so many it still looks at in its round
  bool unsettled_ = false;     // sand at rest, in this round
  ChangeList changedVertices_;
  ChangeList changedTriangles_;
};

}  // namespace teren
