#include "apps/window/FrameReport.h"

#include <cmath>

#include <nlohmann/json.hpp>

namespace teren {
namespace {

nlohmann::ordered_json object(const Percentiles& percentiles) {
  const auto rounded = [](double value) { return std::round(value * 1e3) / 1e3; };
  return {{"p50", rounded(percentiles.p50)},
          {"p99", rounded(percentiles.p99)},
          {"max", rounded(percentiles.max)}};
}

}  // namespace

std::string frameReport(const FrameStatistics& frameMilliseconds, const FrameStatistics& engineMicroseconds,
                        ReportedCounts counts) {
  nlohmann::ordered_json report;
  report["frames"] = frameMilliseconds.count();
  report["frame_ms"] = object(frameMilliseconds.percentiles());
  report["engine_us"] = object(engineMicroseconds.percentiles());
  for (const auto& [name, count] : counts) report[name] = count;
  return report.dump(2) + "\n";
}

std::string frameReport(const FrameStatistics& frameMilliseconds, const FrameStatistics& engineMicroseconds,
                        const EngineFigures& figures, std::size_t bytes) {
  return frameReport(frameMilliseconds, engineMicroseconds,
                     {{"triangles", figures.triangles}, {"nodes", figures.nodes}, {"bytes", bytes}});
}

}  // namespace teren
