#include "apps/window/FrameReport.h"

#include <cmath>

#include <nlohmann/json.hpp>

namespace teren {
namespace {

double rounded(double value) {
  return std::round(value * 1e3) / 1e3;
}

nlohmann::ordered_json object(const Percentiles& percentiles) {
  return {{"p50", rounded(percentiles.p50)},
          {"p99", rounded(percentiles.p99)},
          {"max", rounded(percentiles.max)}};
}

nlohmann::ordered_json report(const FrameStatistics& frameMilliseconds,
                              const FrameStatistics& engineMicroseconds, ReportedCounts counts) {
  nlohmann::ordered_json report;
  report["frames"] = frameMilliseconds.count();
  report["frame_ms"] = object(frameMilliseconds.percentiles());
  report["engine_us"] = object(engineMicroseconds.percentiles());
  for (const auto& [name, count] : counts) report[name] = count;
  return report;
}

std::string text(const nlohmann::ordered_json& report) {
  return report.dump(2) + "\n";
}

}  // namespace

std::string frameReport(const FrameStatistics& frameMilliseconds, const FrameStatistics& engineMicroseconds,
                        ReportedCounts counts) {
  return text(report(frameMilliseconds, engineMicroseconds, counts));
}

std::string frameReport(const FrameStatistics& frameMilliseconds, const FrameStatistics& engineMicroseconds,
                        const EngineFigures& figures, std::size_t bytes, const PixelError& pixelError,
                        const std::optional<DetailSettings>& detail, std::size_t edits) {
  nlohmann::ordered_json all =
      report(frameMilliseconds, engineMicroseconds,
             {{"triangles", figures.triangles}, {"nodes", figures.nodes}, {"bytes", bytes}});
  all["pixel_error"] = {{"p99", rounded(pixelError.p99)}, {"max", rounded(pixelError.max)}};
  if (detail) {
    all["detail"] = {{"pixel_error", rounded(detail->pixelError)},
                     {"distance", rounded(detail->distance)},
                     {"lines", rounded(detail->lines)}};
  }
  if (edits > 0) all["edits"] = edits;
  return text(all);
}

}  // namespace teren
