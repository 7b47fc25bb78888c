// The whole report: everything measured, and the files it becomes.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "teren/PluginRegistry.h"
#include "teren/Result.h"

#include "apps/report/Defaults.h"
#include "apps/report/Effort.h"
#include "apps/report/Plot.h"
#include "apps/report/Table.h"

namespace teren {

struct ReportPart {
  Table table;
  std::vector<Plot> plots;
};

struct MeasuredReport {
  std::vector<ReportPart>
      parts;  ///< blending, its places, generators, detail, scheduling, triangles, node meshes
  std::vector<Justification> defaults;
};

/// Called before each part, with its name.
using BeginPart = std::function<void(const std::string& name)>;

/// Of all generators of the registry and the world shipped with Teren; `frames` may be without rows. Errors:
/// "interrupted", or what cannot be made.
Result<MeasuredReport> measureReport(const PluginRegistry& registry, const DefaultsInCode& defaults,
                                     const Table& frames, const Effort& effort, const BeginPart& beginPart,
                                     const GoOn& goOn);

struct ReportFile {
  std::string name, bytes;
};

/// NAME.csv of each table, NAME.svg of each plot, and index.html. `frames` may be without rows. Where gnuplot
/// does not do its part there are no pictures, and the page says so.
std::vector<ReportFile> filesOf(const MeasuredReport& report, const Table& frames, const Effort& effort);

}  // namespace teren
