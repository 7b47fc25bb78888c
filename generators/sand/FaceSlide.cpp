#include "generators/sand/FaceSlide.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace teren {
namespace {

/// Rising of the three corners before rounding [ticks].
using RealMove = std::array<double, 3>;

/// The gradient times twice the area [ticks steps], exact.
struct ScaledGradient {
  WideInteger x = 0, y = 0;
};

ScaledGradient gradientOf(const Face& face) noexcept {
  const std::int64_t h1 = face[1].height - face[0].height, h2 = face[2].height - face[0].height;
  const std::int64_t x1 = face[1].place.x - face[0].place.x, y1 = face[1].place.y - face[0].place.y;
  const std::int64_t x2 = face[2].place.x - face[0].place.x, y2 = face[2].place.y - face[0].place.y;
  return {static_cast<WideInteger>(h1) * y2 - static_cast<WideInteger>(h2) * y1,
          static_cast<WideInteger>(h2) * x1 - static_cast<WideInteger>(h1) * x2};
}

double areaOf(const Face& face) noexcept {
  return static_cast<double>(orientation(face[0].place, face[1].place, face[2].place));
}

/// Heights above the first corner minus their weighted mean.
RealMove deviationsOf(const Face& face) noexcept {
  const std::int64_t h1 = face[1].height - face[0].height, h2 = face[2].height - face[0].height;
  const WideInteger weights = static_cast<WideInteger>(face[0].weight) + face[1].weight + face[2].weight;
  const WideInteger moment =
      static_cast<WideInteger>(face[1].weight) * h1 + static_cast<WideInteger>(face[2].weight) * h2;
  const double mean = asDouble(moment) / asDouble(weights);
  return {-mean, static_cast<double>(h1) - mean, static_cast<double>(h2) - mean};
}

bool canFall(const FaceCorner& corner) noexcept {
  return corner.loose > kBareTicks;
}

/// A corner that should rise by as much [ticks] does not fall when the move is rounded.
constexpr double kSurelyRises = 2.0;

/// The cosine of the angle between a slope and what an exchange can do about it, below which it does nothing.
constexpr double kLeastGain = 1e-6;

/// The deepest fall of a corner [ticks]: a tick remains, which rounding may take.
double deepestFall(const FaceCorner& corner) noexcept {
  return static_cast<double>(corner.loose - 2);
}

/// The part of a move, at most all of it, in which no corner falls deeper than it may.
double allowedPart(const Face& face, const RealMove& move) noexcept {
  double part = 1.0;
  for (std::size_t i = 0; i < 3; ++i) {
    if (move[i] < 0.0 && -move[i] * part > deepestFall(face[i])) part = deepestFall(face[i]) / -move[i];
  }
  return part;
}

/// Rounds to ticks; the heaviest corner takes what balances the volume and the ledger.
FaceMove rounded(const Face& face, const RealMove& move, const VolumeLedger& ledger) noexcept {
  std::size_t heaviest = move[0] != 0.0 ? 0 : 1;
  for (std::size_t i = 1; i < 3; ++i) {
    if (move[i] != 0.0 && face[i].weight > face[heaviest].weight) heaviest = i;
  }
  FaceMove ticks{};
  SixfoldVolume others = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    if (i == heaviest) continue;
    ticks[i] = static_cast<std::int64_t>(std::floor(move[i] + 0.5));
    others += static_cast<WideInteger>(face[i].weight) * ticks[i];
  }
  ticks[heaviest] = ledger.balance(others, face[heaviest].weight);
  return ticks;
}

/// The move of all three corners that makes the slope repose.rest.
RealMove contraction(const Face& face, double slope, double rest) noexcept {
  const RealMove deviation = deviationsOf(face);
  const double shrinks = 1.0 - rest / slope;
  return {-shrinks * deviation[0], -shrinks * deviation[1], -shrinks * deviation[2]};
}

/// How much `from` must give to `to` [ticks steps^2, both heights change by it over their weights]. Along
/// that exchange the square of the slope is a parabola a q^2 + 2 b q + c; nothing where it only rises, or the
/// slope is within kLeastGain^2 of the least there is.
double exchanged(const Face& face, std::size_t from, std::size_t to, double step, double rest) noexcept {
  Face unit = face;  // its gradient is what a unit of exchange adds, times both weights
  for (FaceCorner& corner : unit) corner.height = 0;
  const double heavier = static_cast<double>(std::max(face[from].weight, face[to].weight));
  const double perFrom = -heavier / static_cast<double>(face[from].weight);
  const double perTo = heavier / static_cast<double>(face[to].weight);
  const std::size_t other = 3 - from - to;
  const LatticePoint f = face[from].place, t = face[to].place, o = face[other].place;
  const double sign = (from + 1) % 3 == to ? 1.0 : -1.0;
  // A corner raised by 1 adds to the scaled gradient the side opposite it, turned by a right angle.
  const double ax = sign * (perFrom * (t.y - o.y) + perTo * (o.y - f.y));
  const double ay = sign * (perFrom * (o.x - t.x) + perTo * (f.x - o.x));
  const ScaledGradient gradient = gradientOf(face);
  const double gx = asDouble(gradient.x), gy = asDouble(gradient.y);
  const double wanted = rest * areaOf(face) * step * kTicksPerMetre;
  const double a = ax * ax + ay * ay;
  const double b = ax * gx + ay * gy;
  const double steepness = gx * gx + gy * gy;
  const double c = steepness - wanted * wanted;
  if (!(a > 0.0) || c <= 0.0 || -b <= kLeastGain * std::sqrt(a * steepness)) return 0.0;
  const double root = b * b - a * c;
  const double q = root > 0.0 ? c / (std::sqrt(root) - b) : -b / a;
  return q * heavier;
}

/// The move in which `fixed` stays and the higher of the other two gives to the lower.
RealMove exchange(const Face& face, std::size_t fixed, double step, double rest) noexcept {
  std::size_t from = (fixed + 1) % 3, to = (fixed + 2) % 3;
  if (face[from].height < face[to].height) std::swap(from, to);
  RealMove move{};
  if (!canFall(face[from])) return move;
  const double weightFrom = static_cast<double>(face[from].weight);
  const double weightTo = static_cast<double>(face[to].weight);
  const double apart = static_cast<double>(face[from].height - face[to].height);
  const double levels = apart / (1.0 / weightFrom + 1.0 / weightTo);  // makes both equally high
  const double given = std::min(exchanged(face, from, to, step, rest), levels);
  move[from] = -given / weightFrom;
  move[to] = given / weightTo;
  return move;
}

}  // namespace

double slopeOf(const Face& face, double step) noexcept {
  const ScaledGradient gradient = gradientOf(face);
  const double x = asDouble(gradient.x), y = asDouble(gradient.y);
  return std::sqrt(x * x + y * y) / areaOf(face) * (kMetresPerTick / step);
}

bool leansOn(const Face& face, std::size_t fixed) noexcept {
  return std::ranges::any_of(face, [&](const FaceCorner& corner) {
    return !corner.isFixed && canFall(corner) && corner.height > face[fixed].height;
  });
}

double energyChange(const Face& face, const FaceMove& move) noexcept {
  const RealMove deviation = deviationsOf(face);
  double sum = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double rises = static_cast<double>(move[i]);
    sum += static_cast<double>(face[i].weight) * rises * (2.0 * deviation[i] + rises);
  }
  return sum;
}

std::optional<FaceMove> slideFace(const Face& face, const Repose& repose, double step,
                                  const VolumeLedger& ledger) noexcept {
  const double slope = slopeOf(face, step);
  if (!(slope > repose.start)) return std::nullopt;
  if (face[0].isFixed + face[1].isFixed + face[2].isFixed > 1) return std::nullopt;
  RealMove move = contraction(face, slope, repose.rest);
  std::size_t held = 3;  // the fixed corner, or the highest bare one that should fall, or might when rounded
  for (std::size_t i = 0; i < 3; ++i) {
    if (face[i].isFixed) {
      held = i;
      break;
    }
    const bool holds = move[i] < kSurelyRises && !canFall(face[i]);
    if (holds && (held == 3 || face[i].height > face[held].height)) held = i;
  }
  if (held != 3) move = exchange(face, held, step, repose.rest);
  if (move == RealMove{}) return std::nullopt;
  const double part = allowedPart(face, move);
  for (double& rise : move) rise *= part;
  const FaceMove ticks = rounded(face, move, ledger);
  for (std::size_t i = 0; i < 3; ++i) assert(ticks[i] >= 0 || -ticks[i] <= face[i].loose);
  if (!(energyChange(face, ticks) < 0.0)) return std::nullopt;
  return ticks;
}

}  // namespace teren
