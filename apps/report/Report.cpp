#include "apps/report/Report.h"

#include <array>
#include <ctime>
#include <memory>
#include <optional>
#include <utility>

#include "teren/World.h"

#include "apps/report/BlendingTable.h"
#include "apps/report/DetailTable.h"
#include "apps/report/GeneratorTable.h"
#include "apps/report/NodeMeshTable.h"
#include "apps/report/Page.h"
#include "apps/report/SchedulingTable.h"
#include "apps/report/TriangleTable.h"

namespace teren {
namespace {

constexpr std::array<const char*, 2> kBlended{"fault", "spectral"};
constexpr std::array kPixelErrors{0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0};  // [px]
constexpr std::array kBudgets{0.25, 0.5, 1.0, 2.0, 4.0, 8.0};                  // [ms]

constexpr const char* kFramesHint =
    "Frames are drawn by programs with a window; this report draws none. Have them measured with "
    "teren-fly --pixel-error PX --view-distance 20000 --seconds 9 --stats FILE.json, and hand the files to "
    "teren report --frames FILE.json, once for each.";

std::string today() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  std::array<char, 32> text{};
  gmtime_r(&now, &utc);
  std::strftime(text.data(), text.size(), "%Y-%m-%d", &utc);
  return text.data();
}

std::vector<std::string> factsOf(const Effort& effort) {
  return {"Measured " + today() + " on " + machineText() + ".",
          std::string(effort.quick ? "This is the quick report (--quick): everything in it is measured, with "
                                     "fewer samples than the full one. "
                                   : "") +
              "Times are processor time of the thread that does the work, " +
              std::to_string(effort.repetitions) +
              " repetitions each; of each, median, 99th percentile (by nearest rank) and spread "
              "(interquartile range over median). Other columns say how often they were sampled. Formulas: "
              "doc/accuracy.md."};
}

}  // namespace

Result<MeasuredReport> measureReport(const PluginRegistry& registry, const DefaultsInCode& defaults,
                                     const Table& frames, const Effort& effort, const BeginPart& beginPart,
                                     const GoOn& goOn) {
  MeasuredReport report;
  beginPart("blending");
  Result<BlendingFigures> blending = measureBlending(registry, kBlended, effort, goOn);
  if (!blending) return blending.error();
  beginPart("generators");
  Result<Table> generators = measureGenerators(registry, effort, goOn);
  if (!generators) return generators.error();
  Result<std::shared_ptr<const World>> world = World::create(WorldDescription::standard(), registry);
  if (!world) return world.error();
  beginPart("triangles");
  Result<Table> triangles = measureTriangles(**world, effort, goOn);
  if (!triangles) return triangles.error();
  beginPart("node meshes");
  Result<Table> nodeMeshes = measureNodeMeshes(
      **world, std::array{defaults.pixelError, defaults.flyingPixelError}, defaults.budget, effort, goOn);
  if (!nodeMeshes) return nodeMeshes.error();
  beginPart("level of detail");
  if (const Result<void> ready = calibrate(*world, goOn); !ready) return ready.error();
  Result<Table> detail = measureDetail(*world, kPixelErrors, effort, goOn);
  if (!detail) return detail.error();
  beginPart("scheduling");
  Result<Table> scheduling = measureScheduling(*world, kBudgets, effort, goOn);
  if (!scheduling) return scheduling.error();
  if (const std::optional<std::string> failure = (*world)->failure()) return Error{*failure};

  report.defaults = justify(defaults, blending->table, *detail, frames, *scheduling);
  std::vector<Plot> plots = plotsOfBlending(*blending);
  report.parts.push_back({std::move(blending->table), {}});
  report.parts.push_back({std::move(blending->places), std::move(plots)});
  for (auto& [table, plotsOf] : {std::pair{&*generators, &plotsOfGenerators},
                                 {&*detail, &plotsOfDetail},
                                 {&*scheduling, &plotsOfScheduling},
                                 {&*triangles, &plotsOfTriangles},
                                 {&*nodeMeshes, &plotsOfNodeMeshes}}) {
    plots = plotsOf(*table);
    report.parts.push_back({std::move(*table), std::move(plots)});
  }
  return report;
}

std::vector<ReportFile> filesOf(const MeasuredReport& report, const Table& frames, const Effort& effort) {
  std::vector<ReportFile> files;
  Page page{"Teren: speed beside error", factsOf(effort), {}, report.defaults};
  std::optional<std::string> undrawn;
  for (const ReportPart& part : report.parts) {
    PageSection section{part.table.title(), part.table.doc(), &part.table, {}};
    files.push_back({part.table.name() + ".csv", csvOf(part.table)});
    for (const Plot& plot : part.plots) {
      if (undrawn || scriptOf(plot).empty()) continue;
      Result<std::string> document = drawn(plot);
      if (!document) {
        undrawn = document.error().message;
        continue;
      }
      section.pictures.push_back(inlineSvg(*document, plot.name));
      files.push_back({plot.name + ".svg", *std::move(document)});
    }
    page.sections.push_back(std::move(section));
    if (part.table.name() != "detail") continue;
    const bool given = !frames.rows().empty();
    page.sections.push_back(
        {frames.title(), given ? frames.doc() : kFramesHint, given ? &frames : nullptr, {}});
    if (given) files.push_back({frames.name() + ".csv", csvOf(frames)});
  }
  if (undrawn) page.facts.push_back("There are no plots here, because " + *undrawn + ".");
  files.push_back({"index.html", htmlOf(page)});
  return files;
}

}  // namespace teren
