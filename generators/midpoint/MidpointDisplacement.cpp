#include "generators/midpoint/MidpointDisplacement.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "generators/midpoint/MidpointNumbers.h"
#include "generators/numbers/PowerOfTwo.h"

namespace teren {
namespace {

/// The heights of a map's corners, in the order of MidpointSettings::corners.
std::array<float, 4> cornersOf(const MidpointPlan& plan, MidpointSource source, std::uint64_t seed) noexcept {
  const std::uint64_t key = midpointRowKey(seed, -1, 0);
  std::array<float, 4> corners{};
  for (int n = 0; n < 4; ++n) {
    const double number = midpointNumber(source, Gaussian::table(), midpointWord(key, n));
    corners[static_cast<std::size_t>(n)] = static_cast<float>(plan.cornerMove * number);
  }
  return corners;
}

/// Calls `work` with a function that makes numbers of words, so that a row's loop has no switch inside.
template <class Work>
void withSource(MidpointSource source, const Gaussian& gaussian, const Work& work) {
  switch (source) {
    case MidpointSource::randR:
      return work([&](std::uint64_t word) { return midpointNumber(MidpointSource::randR, gaussian, word); });
    case MidpointSource::randN:
      return work([&](std::uint64_t word) { return midpointNumber(MidpointSource::randN, gaussian, word); });
    case MidpointSource::randG:
      return work([&](std::uint64_t word) { return gaussian(word); });
  }
}

/// One map of 2^k + 1 samples a side. A unit is a row of new points: of a stage first all rows of centres,
/// then all rows of edge points. Bound by the arithmetic of hashing and of looking up Gaussian numbers.
class MapTask final : public SlicedTask {
 public:
  MapTask(const MidpointSettings& settings, const MidpointPlan& plan, std::uint64_t seed,
          HeightView out) noexcept
      : settings_(settings),
        stages_(plan.stages.data()),
        gaussian_(Gaussian::table()),
        seed_(seed),
        out_(out),
        stageCount_(std::countr_zero(static_cast<unsigned>(out.columns() - 1))) {
    const std::array<float, 4> corners = cornersOf(plan, settings.centre, seed);
    const int last = out.columns() - 1;
    for (int n = 0; n < 4; ++n) out_(n % 2 * last, n / 2 * last) = corners[static_cast<std::size_t>(n)];
  }

  bool step(const Slice& slice) override {
    do {
      if (stage_ == stageCount_) return true;
      unit();
    } while (!slice.over());
    return stage_ == stageCount_;
  }

 private:
  /// Makes the next row of points.
  void unit() noexcept {
    const int squares = 1 << stage_;
    if (row_ < squares) {
      centres(2 * row_ + 1);
    } else if (const int edgeRow = row_ - squares; edgeRow % 2 == 0) {
      edgesWestToEast(edgeRow);
    } else {
      edgesSouthToNorth(edgeRow);
    }
    if (++row_ == 3 * squares + 1) {
      row_ = 0;
      ++stage_;
    }
  }

  const MidpointStage& stage() const noexcept { return stages_[stage_]; }
  /// Samples between two points of the stage's new lattice.
  std::ptrdiff_t half() const noexcept { return (out_.columns() - 1) >> (stage_ + 1); }
  float* latticeRow(int row) const noexcept { return out_.row(row * static_cast<int>(half())); }
  std::uint64_t key(int row) const noexcept { return midpointRowKey(seed_, stage_, row); }

  void centres(int row) noexcept {
    const std::ptrdiff_t h = half();
    const float* const south = latticeRow(row - 1);
    const float* const north = latticeRow(row + 1);
    float* const heights = latticeRow(row);
    const auto [southWest, southEast, northWest, northEast] = stage().centre;
    const double move = stage().centreMove;
    withSource(settings_.centre, gaussian_, [&, key = key(row), last = 2 << stage_](const auto& number) {
      for (int column = 1; column < last; column += 2) {
        const std::ptrdiff_t west = (column - 1) * h, east = (column + 1) * h;
        heights[column * h] =
            static_cast<float>(southWest * south[west] + southEast * south[east] + northWest * north[west] +
                               northEast * north[east] + move * number(midpointWord(key, column)));
      }
    });
  }

  void edgesWestToEast(int row) noexcept {
    const int last = 2 << stage_;
    if (row == 0) return rimWestToEast(row, latticeRow(1), settings_.south, stage().rimMoves[0]);
    if (row == last) return rimWestToEast(row, latticeRow(last - 1), settings_.north, stage().rimMoves[2]);
    const std::ptrdiff_t h = half();
    const float* const south = latticeRow(row - 1);
    const float* const north = latticeRow(row + 1);
    float* const heights = latticeRow(row);
    const double ends = stage().ends, first = stage().firstCentre, second = stage().secondCentre;
    withSource(settings_.north, gaussian_, [&, key = key(row), move = stage().moves[2]](const auto& number) {
      for (int column = 1; column < last; column += 2) {
        const std::ptrdiff_t at = column * h;
        heights[at] = static_cast<float>(
            ends * (static_cast<double>(heights[at - h]) + static_cast<double>(heights[at + h])) +
            first * south[at] + second * north[at] + move * number(midpointWord(key, column)));
      }
    });
  }

  void rimWestToEast(int row, const float* centres, MidpointSource source, double move) noexcept {
    const std::ptrdiff_t h = half();
    float* const heights = latticeRow(row);
    withSource(source, gaussian_, [&, key = key(row), last = 2 << stage_](const auto& number) {
      for (int column = 1; column < last; column += 2) {
        const std::ptrdiff_t at = column * h;
        heights[at] = rimHeight(heights[at - h], heights[at + h], centres[at],
                                move * number(midpointWord(key, column)));
      }
    });
  }

  void edgesSouthToNorth(int row) noexcept {
    const std::ptrdiff_t h = half();
    const float* const south = latticeRow(row - 1);
    const float* const north = latticeRow(row + 1);
    float* const heights = latticeRow(row);
    const int last = 2 << stage_;
    const std::uint64_t key = this->key(row);
    const double ends = stage().ends, first = stage().firstCentre, second = stage().secondCentre;
    withSource(settings_.east, gaussian_, [&, move = stage().moves[3]](const auto& number) {
      for (int column = 2; column < last; column += 2) {
        const std::ptrdiff_t at = column * h;
        heights[at] = static_cast<float>(
            ends * (static_cast<double>(south[at]) + static_cast<double>(north[at])) +
            first * heights[at - h] + second * heights[at + h] + move * number(midpointWord(key, column)));
      }
    });
    heights[0] =
        rimHeight(south[0], north[0], heights[h],
                  stage().rimMoves[1] * midpointNumber(settings_.west, gaussian_, midpointWord(key, 0)));
    const std::ptrdiff_t rim = last * h;
    heights[rim] =
        rimHeight(south[rim], north[rim], heights[rim - h],
                  stage().rimMoves[3] * midpointNumber(settings_.east, gaussian_, midpointWord(key, last)));
  }

  float rimHeight(double end, double otherEnd, double centre, double displacement) const noexcept {
    return static_cast<float>(stage().rimEnds * (end + otherEnd) + stage().rimCentre * centre + displacement);
  }

  const MidpointSettings& settings_;
  const MidpointStage* stages_;
  const Gaussian& gaussian_;
  std::uint64_t seed_;
  HeightView out_;
  int stageCount_;  // of this level
  int stage_ = 0;
  int row_ = 0;  // within the stage: rows of centres, then rows of edge points
};

/// A map that is its centre alone.
class CentreTask final : public SlicedTask {
 public:
  CentreTask(const MidpointSettings& settings, const MidpointPlan& plan, std::uint64_t seed,
             HeightView out) noexcept
      : settings_(settings), plan_(plan), seed_(seed), out_(out) {}

  bool step(const Slice&) override {
    const auto corners = cornersOf(plan_, settings_.centre, seed_);
    const auto [southWest, southEast, northWest, northEast] = plan_.stages[0].centre;
    const double number =
        midpointNumber(settings_.centre, Gaussian::table(), midpointWord(midpointRowKey(seed_, 0, 1), 1));
    out_(0, 0) = static_cast<float>(southWest * corners[0] + southEast * corners[1] + northWest * corners[2] +
                                    northEast * corners[3] + plan_.stages[0].centreMove * number);
    return true;
  }

 private:
  const MidpointSettings& settings_;
  const MidpointPlan& plan_;
  std::uint64_t seed_;
  HeightView out_;
};

}  // namespace

MidpointDisplacement::MidpointDisplacement(const MidpointSettings& settings) : settings_(settings) {
  for (int stages = 1; stages <= kMostMidpointStages; ++stages) {
    plans_[static_cast<std::size_t>(stages) - 1] = midpointPlan(settings, stages);
  }
}

const MidpointPlan& MidpointDisplacement::plan(int stages) const noexcept {
  assert(1 <= stages && stages <= kMostMidpointStages);
  return plans_[static_cast<std::size_t>(stages) - 1];
}

int MidpointDisplacement::stagesOf(const MapRequest& request) noexcept {
  const unsigned intervals = request.samples > 1
                                 ? static_cast<unsigned>(request.samples - 1) << request.level
                                 : static_cast<unsigned>(std::max(2, request.finestIntervals));
  return std::max(1, std::countr_zero(intervals));
}

HeightRange MidpointDisplacement::range() const noexcept {
  double bound = 0.0;
  for (const MidpointPlan& plan : plans_) bound = std::max(bound, plan.bound);
  return {.mean = 0.0, .deviation = settings_.deviation, .min = -bound, .max = bound};
}

/// A level misses what each later stage adds to the triangles of the stage before. The plan knows the mean
/// square of that at the points the stage makes; between these points it is interpolated, which leaves
/// between 1/2 (points independent of each other) and all of it, and the last stage has no points between.
/// What different stages add is taken as uncorrelated; where the variance is the same
/// everywhere, the sum is never more than for independent heights, 1 + 1/2 times it.
double MidpointDisplacement::residual(int level, int samples) const noexcept {
  assert(level >= 0 && samples >= 1);
  if (level == 0) return 0.0;
  const MidpointPlan& plan = this->plan(std::max(1, std::countr_zero(static_cast<unsigned>(samples - 1))));
  const auto stages = static_cast<int>(plan.stages.size());
  if (level < stages) {
    constexpr double kInterpolated = 0.65;
    double square = plan.squaredErrors.back();
    for (int stage = stages - level; stage < stages - 1; ++stage) {
      square += kInterpolated * plan.squaredErrors[static_cast<std::size_t>(stage)];
    }
    const double variance = settings_.deviation * settings_.deviation;
    return std::sqrt(settings_.published ? square : std::min(square, 1.5 * variance));
  }
  constexpr double kLog2Nearer = -0.386;  // points are 0.765 times as far from the centre as edges' middles
  return std::sqrt(plan.aroundCentre * powerOfTwo(2.0 * settings_.hurst * kLog2Nearer));
}

std::unique_ptr<SlicedTask> MidpointDisplacement::begin(const MapRequest& request, HeightView out) const {
  assert(out.columns() == request.samples && out.rows() == request.samples);
  const MidpointPlan& plan = this->plan(stagesOf(request));
  if (request.samples == 1) return std::make_unique<CentreTask>(settings_, plan, request.seed, out);
  assert(std::has_single_bit(static_cast<unsigned>(request.samples - 1)));
  return std::make_unique<MapTask>(settings_, plan, request.seed, out);
}

}  // namespace teren
