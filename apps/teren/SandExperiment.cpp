#include "apps/teren/SandExperiment.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <vector>

#include "teren/ProcessorTime.h"

#include "apps/teren/SandGrid.h"
#include "generators/sand/LevelSand.h"
#include "generators/sand/Sandbox.h"

namespace teren {
namespace {

constexpr double kSandDepth = 1.0;       // [m]
constexpr std::uint64_t kSlice = 2'000;  // steps of slides, a millisecond or two

/// [s] of the thread's processor time.
double now() {
  return std::chrono::duration<double>(threadProcessorTime()).count();
}

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

std::vector<StampPlace> wayOf(const SandExperiment& experiment) {
  const double margin = 1.05 * experiment.radius;
  const double end = margin + (1.0 - 2.0 * margin) * experiment.trace / 100.0;
  return stampsAlong({margin, margin}, {end, end}, 0.5 * experiment.radius);
}

Error interruption() {
  return Error{"interrupted"};
}

/// Slides, a slice at a time, so that an interruption need not wait; false where one came.
template <class Sliding>
bool slideInSlices(std::uint64_t steps, const std::function<bool()>& interrupted, const Sliding& slide) {
  while (steps > 0) {
    if (interrupted()) return false;
    const std::uint64_t slice = std::min(steps, kSlice);
    if (slide(slice)) return true;
    steps -= slice;
  }
  return true;
}

void add(const StampTimes& more, StampTimes& sum) {
  sum.insertion += more.insertion;
  sum.constraints += more.constraints;
  sum.removal += more.removal;
  sum.berm += more.berm;
}

/// What is to be known of the sandbox when all stamps are made.
void describe(const Sandbox& sandbox, SixfoldVolume before, SandResult& result) {
  const SandSurface& surface = sandbox.surface();
  result.vertices = surface.mesh().vertexCount();
  result.triangles = surface.mesh().triangleCount();
  result.constraints = surface.mesh().constraintCount();
  result.removedByCleanUp = sandbox.cleanUp().count().removed;
  result.divided = sandbox.slides().count().splits;
  result.slideSteps = sandbox.slides().count().steps;
  result.sweeps = sandbox.slides().count().sweeps;
  result.atRest = sandbox.slides().atRest();
  const double step = surface.step();
  result.moved = asDouble(surface.volumeMoved()) * kMetresPerTick * step * step / 6.0;
  result.drift = surface.volumeMoved() > 0
                     ? std::fabs(asDouble(surface.volume() - before)) / asDouble(surface.volumeMoved())
                     : 0.0;
  result.bytes = sandbox.bytes();
}

Result<void> runMesh(const SandExperiment& experiment, const ToolShape& tool, SandResult& result,
                     const std::function<bool()>& interrupted) {
  SandSettings settings;
  settings.dryAngle = experiment.repose;
  const auto spare = static_cast<std::size_t>(experiment.vertices - 4) / 64 + 1024;
  Sandbox sandbox(levelSand(experiment.vertices, kSandDepth, spare), settings);
  const SixfoldVolume before = sandbox.surface().volume();
  result.mostVertices = sandbox.surface().mesh().vertexCount();
  std::vector<double> times;
  for (const StampPlace& place : wayOf(experiment)) {
    const double begin = now();
    const Result<StampReport> report = sandbox.stamp(tool, place);
    if (!report) return report.error();
    const double stamped = now();
    const auto slide = [&](std::uint64_t steps) { return sandbox.slide(steps); };
    if (!slideInSlices(experiment.steps, interrupted, slide)) return interruption();
    const double slid = now();
    result.mostVertices = std::max(result.mostVertices, sandbox.surface().mesh().vertexCount());
    sandbox.clean();
    const double cleaned = now();
    sandbox.forgetChanges();
    add(report->times, result.stampTimes);
    result.slideTime += slid - stamped;
    result.cleanTime += cleaned - slid;
    result.removedByTool += static_cast<std::uint64_t>(report->removed);
    times.push_back(cleaned - begin);
    if (interrupted()) return interruption();
  }
  result.stamps = static_cast<int>(times.size());
  result.medianIteration = median(std::move(times));
  describe(sandbox, before, result);
  return {};
}

Result<void> runGrid(const SandExperiment& experiment, const ToolShape& tool, SandResult& result,
                     const std::function<bool()>& interrupted) {
  const ToolPart& part = tool.parts().front();
  const ToolPoint out = part.outer.front(), in = part.inner.front().front();
  const double wall = std::sqrt((out.x - in.x) * (out.x - in.x) + (out.y - in.y) * (out.y - in.y));
  const double finest = std::min(wall, 1.0 / std::sqrt(static_cast<double>(experiment.vertices)));
  SandGrid grid(static_cast<int>(std::floor(1.0 / finest)) + 1, kSandDepth);
  const Repose repose = reposeOf(experiment.repose);
  std::vector<double> times;
  for (const StampPlace& place : wayOf(experiment)) {
    const double begin = now();
    grid.stamp(place.x, place.y, experiment.radius, -experiment.depth, 0.6 * experiment.radius);
    const auto slide = [&](std::uint64_t steps) { return grid.slide(repose, steps); };
    if (!slideInSlices(experiment.steps, interrupted, slide)) return interruption();
    times.push_back(now() - begin);
    result.gridTime += times.back();
  }
  result.gridSide = grid.side();
  result.gridMedianIteration = median(std::move(times));
  result.gridBytes = grid.bytes();
  return {};
}

/// With columns as sandTable() names them.
std::string tableLine(const SandExperiment& experiment, const SandResult& result) {
  const auto perVertex = [&](std::size_t vertices) {
    return static_cast<double>(result.bytes) / static_cast<double>(vertices);
  };
  const auto count = [](std::uint64_t number) { return static_cast<unsigned long long>(number); };
  const StampTimes& times = result.stampTimes;
  std::array<char, 640> line{};
  std::snprintf(line.data(), line.size(),
                "%d,%g,%d,%.3f,%.3f,%.3f,%.3f,%.3f,%.3f,%.4f,%zu,%zu,%zu,%zu,%llu,%llu,%llu,%llu,%llu,%d,"
                "%.9g,%.3g,%zu,%.1f,%.1f,%d,%.3f,%.4f,%zu,%.2f",
                experiment.vertices, experiment.trace, result.stamps, 1e3 * times.insertion,
                1e3 * times.constraints, 1e3 * times.removal, 1e3 * times.berm, 1e3 * result.slideTime,
                1e3 * result.cleanTime, 1e3 * result.medianIteration, result.mostVertices, result.vertices,
                result.triangles, result.constraints, count(result.removedByTool),
                count(result.removedByCleanUp), count(result.divided), count(result.slideSteps),
                count(result.sweeps), result.atRest ? 1 : 0, result.moved, result.drift, result.bytes,
                perVertex(result.mostVertices), perVertex(result.vertices), result.gridSide,
                1e3 * result.gridTime, 1e3 * result.gridMedianIteration, result.gridBytes,
                static_cast<double>(result.gridBytes) / static_cast<double>(result.bytes));
  return line.data();
}

}  // namespace

Result<SandResult> runSandExperiment(const SandExperiment& experiment,
                                     const std::function<bool()>& interrupted) {
  const Result<ToolShape> tool = ToolShape::disc(experiment.radius, experiment.depth, experiment.points);
  if (!tool) return tool.error();
  SandResult result;
  if (const Result<void> ran = runMesh(experiment, *tool, result, interrupted); !ran) return ran.error();
  if (!experiment.grid) return result;
  if (const Result<void> ran = runGrid(experiment, *tool, result, interrupted); !ran) return ran.error();
  return result;
}

std::string sandTable(std::span<const SandRun> runs) {
  std::string table =
      "vertices,trace_percent,stamps,insertion_ms,constraint_ms,removal_ms,berm_ms,slide_ms,clean_up_ms,"
      "iteration_median_ms,vertices_most,vertices_after,triangles_after,constraints_after,removed_by_tool,"
      "removed_by_clean_up,divided,slide_steps,sweeps,at_rest,moved_m3,drift,bytes,bytes_per_vertex_most,"
      "bytes_per_vertex_after,grid_side,grid_ms,grid_iteration_median_ms,grid_bytes,grid_bytes_per_byte\n";
  for (const SandRun& run : runs) table += tableLine(run.experiment, run.result) + "\n";
  return table;
}

}  // namespace teren
