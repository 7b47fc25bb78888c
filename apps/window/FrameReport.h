// What --stats writes: how long frames and updates took, and what there was to draw.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>

#include "teren/Engine.h"
#include "teren/PixelError.h"

#include "apps/window/FrameStatistics.h"

namespace teren {

/// What there is at the end, by name.
using ReportedCounts = std::initializer_list<std::pair<const char*, std::size_t>>;

/// {"frames", "frame_ms": {"p50", "p99", "max"}, "engine_us": {the same}, counts...} as JSON text.
std::string frameReport(const FrameStatistics& frameMilliseconds, const FrameStatistics& engineMicroseconds,
                        ReportedCounts counts);

/// The same with "triangles", "nodes", "bytes" and "pixel_error": {"p99", "max"}, as they are at the end.
/// `bytes` are the engine's and the graphics buffers'; a program that draws the level-0 surface itself has no
/// pixel error. With detail by error what was wanted, too: "detail": {"pixel_error", "distance", "lines"};
/// and of edited land how many edits there are: "edits".
std::string frameReport(const FrameStatistics& frameMilliseconds, const FrameStatistics& engineMicroseconds,
                        const EngineFigures& figures, std::size_t bytes, const PixelError& pixelError = {},
                        const std::optional<DetailSettings>& detail = std::nullopt, std::size_t edits = 0);

}  // namespace teren
