#include "apps/teren/SandPlots.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "teren/Parameter.h"

#include "apps/files/OutputFile.h"
#include "apps/report/Gnuplot.h"

namespace teren {
namespace {

/// A line of a plot: its name, and where its points come from.
struct Curve {
  const char* name;
  double (*value)(const SandResult&);
};

constexpr std::array kParts{
    Curve{"location and insertion", [](const SandResult& r) { return 1e3 * r.stampTimes.insertion; }},
    Curve{"constraints", [](const SandResult& r) { return 1e3 * r.stampTimes.constraints; }},
    Curve{"removal by the tool", [](const SandResult& r) { return 1e3 * r.stampTimes.removal; }},
    Curve{"berm", [](const SandResult& r) { return 1e3 * r.stampTimes.berm; }},
    Curve{"slides", [](const SandResult& r) { return 1e3 * r.slideTime; }},
    Curve{"clean-up", [](const SandResult& r) { return 1e3 * r.cleanTime; }},
    Curve{"regular grid, all", [](const SandResult& r) { return 1e3 * r.gridTime; }}};
constexpr std::array kMemory{
    Curve{"triangulation", [](const SandResult& r) { return static_cast<double>(r.bytes) / 1e6; }},
    Curve{"regular grid as fine",
          [](const SandResult& r) { return static_cast<double>(r.gridBytes) / 1e6; }}};

struct Axis {
  const char* label;
  bool logarithmic;
  double (*place)(const SandExperiment&);
};

constexpr Axis kVertices{"vertices of the mesh at first", true,
                         [](const SandExperiment& e) { return static_cast<double>(e.vertices); }};
constexpr Axis kTrace{"trace [% of the diagonal]", false, [](const SandExperiment& e) { return e.trace; }};

template <std::size_t N>
std::string scriptOf(const std::string& title, const Axis& axis, const char* unit,
                     const std::array<Curve, N>& curves, const std::vector<const SandRun*>& runs) {
  std::string script = "set terminal svg size 860,540 font 'sans,14' background 'white'\nset title '" +
                       title + "'\nset xlabel '" + axis.label + "'\nset ylabel '" + unit +
                       "'\nset key outside right\nset grid\nset logscale y\nset format y '%g'\n";
  if (axis.logarithmic) script += "set logscale x\nset format x '%.0f'\n";
  std::string data, lines;  // gnuplot's fifth colour is yellow, which nobody sees on white
  for (std::size_t n = 0; n < curves.size(); ++n) {
    std::string points;
    for (const SandRun* run : runs) {
      const double value = curves[n].value(run->result);
      if (value > 0.0) {
        points += numberText(axis.place(run->experiment)) + " " + numberText(value) + "\n";
      }
    }
    if (points.empty()) continue;
    const std::string name = "$curve" + std::to_string(n);
    data += name + " << EOD\n" + points + "EOD\n";
    lines += (lines.empty() ? "plot " : ", ") + name + " with linespoints pointtype 7 linewidth 2 linetype " +
             std::to_string(n < 4 ? n + 1 : n + 2) + " title '" + curves[n].name + "'";
  }
  return script + data + lines + "\n";
}

Result<void> write(const std::filesystem::path& file, const std::string& script) {
  Result<OutputFile> output = OutputFile::create(file);
  if (!output) return output.error();
  if (Result<void> drawn = drawWithGnuplot(script, output->stream()); !drawn) return drawn;
  return output->commit();
}

/// The runs whose `same` is the largest there is, in the order of `axis`.
std::vector<const SandRun*> chosen(std::span<const SandRun> runs, const Axis& same, const Axis& axis) {
  double most = 0.0;
  for (const SandRun& run : runs) most = std::max(most, same.place(run.experiment));
  std::vector<const SandRun*> those;
  for (const SandRun& run : runs) {
    if (same.place(run.experiment) == most) those.push_back(&run);
  }
  std::stable_sort(those.begin(), those.end(), [&axis](const SandRun* a, const SandRun* b) {
    return axis.place(a->experiment) < axis.place(b->experiment);
  });
  return those;
}

}  // namespace

Result<void> plotSand(const std::filesystem::path& folder, std::span<const SandRun> runs) {
  const std::vector<const SandRun*> sizes = chosen(runs, kTrace, kVertices);
  const std::vector<const SandRun*> traces = chosen(runs, kVertices, kTrace);
  const std::string trace = numberText(sizes.front()->experiment.trace);
  const std::string vertices = std::to_string(traces.front()->experiment.vertices);
  if (sizes.size() > 1) {
    const std::string time = scriptOf("A groove of " + trace + " % of the diagonal: time of each part",
                                      kVertices, "processor time [ms]", kParts, sizes);
    if (Result<void> drawn = write(folder / "time-by-vertices.svg", time); !drawn) return drawn;
    const std::string bytes = scriptOf("Memory after a groove of " + trace + " % of the diagonal", kVertices,
                                       "memory [MB]", kMemory, sizes);
    if (Result<void> drawn = write(folder / "bytes-by-vertices.svg", bytes); !drawn) return drawn;
  }
  if (traces.size() < 2) return {};
  const std::string time = scriptOf("Grooves in a mesh of " + vertices + " vertices: time of each part",
                                    kTrace, "processor time [ms]", kParts, traces);
  return write(folder / "time-by-trace.svg", time);
}

}  // namespace teren
