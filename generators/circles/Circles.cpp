#include "generators/circles/Circles.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <vector>

#include "teren/Hash.h"

namespace teren {
namespace {

/// Rows that are made at once: so many stay in the first-level cache, and share the search through the discs.
constexpr int kBand = 8;
constexpr int kDiscsPerUnit = 64;      // a unit of drawing: about 1 us
constexpr int kSamplesPerUnit = 4096;  // a unit of adding: about 3 us
constexpr int kSearchCost = 4;         // of looking whether a disc touches a band, in samples

constexpr double kPi = 3.141592653589793;
/// Mean over a disc of the squared profile and of the profile: cos^4 and cos^2 of pi / 2 times the distance.
constexpr double kMeanSquare = 3.0 / 8.0 - 2.0 / (kPi * kPi);
constexpr double kMean = 0.5 - 2.0 / (kPi * kPi);

/// Mean of r^power over radii uniform from `smallest` to 1.
double meanPower(double smallest, int power) noexcept {
  double sum = 1.0;
  for (int n = 0; n < power; ++n) sum = sum * smallest + 1.0;
  return sum / (power + 1);
}

/// Samples that are made side by side; a row of sums is a multiple of it wide, so that no loop has a rest.
constexpr int kLane = 8;

/// Adds a disc to `lanes` times kLane sums, the first of them `east` units from its centre, one every `step`.
/// Bound by arithmetic, 14 operations a sample, which compilers do four samples at a time.
void addRow(const Disc disc, float row, float east, float step, int lanes, float* sums) noexcept {
  for (int n = 0; n < lanes * kLane; ++n) sums[n] += disc.alongRow(east + static_cast<float>(n) * step, row);
}

/// One map of 2^a + 1 samples a side, or its centre alone, in bands of rows from south to north.
class CirclesTask final : public SlicedTask {
 public:
  CirclesTask(const Circles& circles, std::uint64_t seed, HeightView out)
      : circles_(circles),
        random_(seed),
        out_(out),
        step_(out.columns() == 1 ? 1 : kCircleUnits / (out.columns() - 1)),
        origin_(out.columns() == 1 ? kCircleUnits / 2 : 0),
        stride_((out.columns() + kLane - 1) / kLane * kLane),
        sums_(static_cast<std::size_t>(kBand) * static_cast<std::size_t>(stride_)) {
    discs_.reserve(static_cast<std::size_t>(circles.discs()));
  }

  bool step(const Slice& slice) override {
    do {
      if (drawn_ < circles_.discs()) {
        drawDiscs();
      } else {
        addDiscs();
      }
      if (band_ >= out_.rows()) return true;
    } while (!slice.over());
    return false;
  }

 private:
  void drawDiscs() {
    const int end = std::min(circles_.discs(), drawn_ + kDiscsPerUnit);
    for (; drawn_ < end; ++drawn_) {
      const Disc disc = circles_.draw(random_);
      if (disc.touchesMap()) discs_.push_back(disc);
    }
  }

  /// Adds some discs to the band. What is left of a disc's rows waits for the next unit: at a side of 2049 a
  /// band of one disc is 16,000 samples.
  void addDiscs() {
    const int end = std::min(out_.rows(), band_ + kBand);
    for (int work = 0; next_ < discs_.size() && work < kSamplesPerUnit; work += kSearchCost) {
      const Disc& disc = discs_[next_];
      const double reach = disc.reach();
      const double south = disc.y - reach, north = disc.y + reach;
      if (south <= place(end - 1) && north >= place(band_)) {
        for (; row_ < end && work < kSamplesPerUnit; ++row_) work += addRowOf(disc, row_);
        if (row_ < end) return;
        row_ = band_;
      }
      ++next_;
    }
    if (next_ < discs_.size()) return;
    for (int row = band_; row < end; ++row) std::copy_n(sumsOf(row), out_.columns(), out_.row(row));
    std::fill(sums_.begin(), sums_.end(), 0.0f);
    next_ = 0;
    band_ = row_ = end;
  }

  /// Returns how many samples it has changed.
  int addRowOf(const Disc& disc, int row) {
    const std::int32_t north = place(row) - disc.y;
    const double reach = disc.reach();
    const double halfSquare = reach * reach - static_cast<double>(north) * north;
    if (halfSquare < 0.0) return 1;
    const double half = std::sqrt(halfSquare);
    const double east = disc.x - origin_;
    const int first = std::max(0, static_cast<int>((east - half) * samplesPerUnit_)) / kLane;
    const int last = std::min(out_.columns() - 1, static_cast<int>((east + half) * samplesPerUnit_)) / kLane;
    if (last < first) return 1;
    addRow(disc, disc.atRow(static_cast<float>(north)), static_cast<float>(place(first * kLane) - disc.x),
           static_cast<float>(step_), last - first + 1, sumsOf(row) + first * kLane);
    return (last - first + 1) * kLane;
  }

  float* sumsOf(int row) { return sums_.data() + static_cast<std::ptrdiff_t>(row - band_) * stride_; }
  std::int32_t place(int sample) const { return origin_ + sample * step_; }

  const Circles circles_;
  RandomSequence random_;
  HeightView out_;
  std::int32_t step_, origin_;           // [units]
  double samplesPerUnit_ = 1.0 / step_;  // exact
  int stride_;
  std::vector<float> sums_;  // of the band's rows; 0 between bands
  std::vector<Disc> discs_;  // those that touch the map, as drawn
  int drawn_ = 0;
  int band_ = 0;          // its first row
  std::size_t next_ = 0;  // disc to be added to the band,
  int row_ = 0;           // from this row on
};

}  // namespace

Circles::Circles(int discs, double deviation, double radius, double smallest)
    : discs_(discs),
      deviation_(deviation),
      radius_(radius),
      largest_(radius * (kCircleUnits / 2)),
      smallest_(smallest),
      margin_(static_cast<std::int32_t>(largest_) + 2),
      extent_(kCircleUnits + 2 * margin_) {
  assert(1 <= discs && discs <= kMaxDiscs);
  assert(std::isfinite(deviation) && deviation >= 0.0);
  assert(kMinRadius <= radius && radius <= kMaxRadius);
  assert(kMinSmallest <= smallest && smallest <= 1.0);
  const double share = largest_ / extent_;
  unit_ = deviation / std::sqrt(discs * kMeanSquare * kPi * share * share * meanPower(smallest, 4));
}

double Circles::roundingBound() const noexcept {
  return discs_ * unit_ * (kDiscProfileError + 0x1p-23 + discs_ * 0x1p-24);
}

HeightRange Circles::range() const noexcept {
  const double largest = discs_ * unit_ + roundingBound();
  return {.mean = 0.0, .deviation = deviation_, .min = -largest, .max = largest};
}

/// Discs are independent, so the squared residual is the sum of theirs, and each of a disc of radius r
/// depends on x, the level's spacing in radii, alone. For small x it is that of the profile's curvature, 0.98
/// x^4 of the disc's part of the variance; for large x the samples miss most discs, and those that are met
/// become pyramids: then it is 3/2, the disc's square and the pyramid's. Between, x^4 / (1 + 1.6 x^2 + 2/3
/// x^4) is within 12 % of what numerical integration gives for x = 1/32 ... 16. Averaged over the radii,
/// weighted with their parts of the variance (r^4).
double Circles::residual(int level, int samples) const noexcept {
  assert(level >= 0 && samples >= 1);
  if (level == 0) return 0.0;
  const int intervals = level < 31 ? (samples - 1) >> level : 0;
  if (intervals < 2) {
    // Twice the variance, less what a height and the centre's share: of a disc, the squared mean.
    const double shared = kPi * radius_ * radius_ * kMean * kMean / kMeanSquare * meanPower(smallest_, 6) /
                          meanPower(smallest_, 4) / 4.0;
    return deviation_ * std::sqrt(2.0 * std::max(0.0, 1.0 - shared));
  }
  const double spacing = 2.0 / intervals / radius_;  // in largest radii
  constexpr int kRadii = 16;
  double squares = 0.0, weights = 0.0;
  for (int n = 0; n < kRadii; ++n) {
    const double radius = smallest_ + (1.0 - smallest_) * (n + 0.5) / kRadii;
    const double x2 = spacing * spacing / (radius * radius);
    const double weight = radius * radius * radius * radius;
    squares += weight * x2 * x2 / (1.0 + 1.6 * x2 + x2 * x2 / 1.5);
    weights += weight;
  }
  return deviation_ * std::sqrt(squares / weights);
}

std::unique_ptr<SlicedTask> Circles::begin(const MapRequest& request, HeightView out) const {
  assert(out.columns() == request.samples && out.rows() == request.samples);
  assert(request.samples == 1 || std::has_single_bit(static_cast<unsigned>(request.samples - 1)));
  assert(request.samples - 1 <= kCircleUnits);
  return std::make_unique<CirclesTask>(*this, request.seed, out);
}

}  // namespace teren
