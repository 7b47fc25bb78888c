// What --stats writes: how long frames and updates took, and what there was to draw.
#pragma once

#include <cstddef>
#include <string>

#include "teren/Engine.h"

#include "apps/window/FrameStatistics.h"

namespace teren {

/// {"frames", "frame_ms": {"p50", "p99", "max"}, "engine_us": {the same}, "triangles", "nodes", "bytes"} as
/// JSON text; the last three as they are at the end. `bytes` are the engine's and the graphics buffers'.
std::string frameReport(const FrameStatistics& frameMilliseconds, const FrameStatistics& engineMicroseconds,
                        const EngineFigures& figures, std::size_t bytes);

}  // namespace teren
