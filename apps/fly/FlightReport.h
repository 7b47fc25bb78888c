// What --stats writes.
#pragma once

#include <string>

#include "apps/fly/Flight.h"
#include "apps/fly/FrameStatistics.h"

namespace teren {

/// {"frames", "frame_ms": {"p50", "p99", "max"}, "engine_us": {the same}, "triangles", "nodes", "bytes"} as
/// JSON text; the last three as they are at the end of the flight.
std::string flightReport(const FrameStatistics& frameTimes, const Flight& flight, std::size_t bytes);

}  // namespace teren
