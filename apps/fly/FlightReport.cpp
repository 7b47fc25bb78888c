#include "apps/fly/FlightReport.h"

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

std::string flightReport(const FrameStatistics& frameTimes, const Flight& flight, std::size_t bytes) {
  const EngineFigures figures = flight.engine().figures();
  nlohmann::ordered_json report;
  report["frames"] = frameTimes.count();
  report["frame_ms"] = object(frameTimes.percentiles());
  report["engine_us"] = object(flight.engineTimes().percentiles());
  report["triangles"] = figures.triangles;
  report["nodes"] = figures.nodes;
  report["bytes"] = bytes;
  return report.dump(2) + "\n";
}

}  // namespace teren
