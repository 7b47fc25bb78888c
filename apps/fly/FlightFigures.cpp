#include "apps/fly/FlightFigures.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace teren {
namespace {

template <class... Numbers>
std::string text(const char* format, Numbers... numbers) {
  std::array<char, 96> buffer{};
  std::snprintf(buffer.data(), buffer.size(), format, numbers...);
  return buffer.data();
}

// A long double holds 64 bits and more, so this keeps tenths of a metre out to the end of a world of 64 m
// patches.
std::string metres(std::int64_t patch, double share, double pitch) {
  return groupedNumber(static_cast<long double>(patch) * pitch + static_cast<long double>(share) * pitch, 1);
}

std::string compass(double heading) {
  constexpr std::array<const char*, 8> kNames{"N", "NE", "E", "SE", "S", "SW", "W", "NW"};
  const double degrees = heading * 180.0 / std::numbers::pi;
  const int whole = static_cast<int>(std::lround(degrees)) % 360;
  const auto name = static_cast<std::size_t>(std::lround(degrees / 45.0)) % kNames.size();
  return text("%03d° %s", whole, kNames[name]);
}

std::string megabytes(std::size_t bytes) {
  return text("%.1f MB", static_cast<double>(bytes) / 1e6);
}

}  // namespace

std::string groupedNumber(long double value, int decimals) {
  std::string digits = text("%.*Lf", decimals, value);
  const std::size_t first = digits[0] == '-' ? 1 : 0;
  const std::size_t point = digits.find('.');
  for (std::size_t place = point == std::string::npos ? digits.size() : point; place > first + 3;
       place -= 3) {
    digits.insert(place - 3, " ");
  }
  return digits;
}

std::vector<DisplayLine> flightLines(const FlightFigures& figures) {
  const Position& at = figures.position;
  const double pitch = figures.pitch;
  return {
      {"east", metres(at.i, at.u, pitch) + " m"},
      {"north", metres(at.j, at.v, pitch) + " m"},
      {"patch", text("(%lld, %lld) + (%.2f, %.2f) m", static_cast<long long>(at.i),
                     static_cast<long long>(at.j), at.u * pitch, at.v * pitch)},
      {"height", groupedNumber(figures.height, 1) + " m"},
      {"above ground",
       figures.heightAboveGround ? groupedNumber(*figures.heightAboveGround, 1) + " m" : "unknown"},
      {"speed", text("%.1f m/s  (%.0f km/h)", figures.speed, 3.6 * figures.speed)},
      {"heading", compass(figures.heading)},
  };
}

std::vector<DisplayLine> costLines(const CostFigures& figures) {
  return {
      {"frame", text("%.1f ms", figures.frameMilliseconds)},
      {"engine", text("%.2f ms", figures.engineMilliseconds)},
      {"nodes", groupedNumber(static_cast<long double>(figures.nodes), 0) +
                    (figures.pending > 0 ? text("  (+ %zu to come)", figures.pending) : "")},
      {"triangles", groupedNumber(static_cast<long double>(figures.triangles), 0)},
      {"pixel error", text("%.1f px  (p99 %.1f)", figures.pixelError.max, figures.pixelError.p99)},
      {"memory", megabytes(figures.bytes)},
  };
}

}  // namespace teren
