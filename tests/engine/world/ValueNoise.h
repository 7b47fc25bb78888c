// The simplest continuous field there is, for the tests of layers and worlds: random heights at the points of
// an integer lattice, smoothly joined, in two octaves; the finer one is left out where samples are too far
// apart.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>

#include "teren/ContinuousGenerator.h"
#include "teren/Hash.h"
#include "teren/RowTask.h"

namespace teren {

/// The first octave has cells of the smallest side pitch / 2^k that is not below `cell`, which must not be
/// above the pitch; the second octave has cells of an eighth of that side and a quarter of the height.
class ValueNoise : public ContinuousGenerator {
 public:
  static std::span<const Parameter> parameters() noexcept {
    static constexpr std::array table = {
        Parameter::real("mean", 0.0, -1e6, 1e6, "m", "mean height"),
        Parameter::real("height", 10.0, 0.0, 1e6, "m", "largest height of the first octave above the mean"),
        Parameter::real("cell", 64.0, 1.0, 1e6, "m", "least side of the first octave's cells")};
    return table;
  }

  ValueNoise(double mean, double height, double cell) : mean_(mean), height_(height), cell_(cell) {}
  explicit ValueNoise(const Values& values)
      : ValueNoise(values.real("mean"), values.real("height"), values.real("cell")) {}

  HeightRange range() const override {
    const double reach =
        1.25 * height_ + 1e-6 * std::fabs(mean_);  // a float's rounding may lead a little beyond
    return {mean_, 0.3 * height_, mean_ - reach, mean_ + reach};
  }
  double residual(int level, int, double) const override { return level == 0 ? 0.0 : height_; }

  /// h^2 / 8 (|f_xx| + 2 |f_xy| + |f_yy|), of each octave, with the quintic's largest derivatives of 15/8 and
  /// 10 / sqrt 3 and heights of neighbours that differ by at most 2.
  double fieldError(double spacing) const override {
    constexpr double kBent = 2.0 * 5.773502691896258, kTwisted = 4.0 * 1.875 * 1.875;
    const auto octave = [spacing](double height, double side) {
      const double steps = spacing / side;
      return height * std::min(2.0, steps * steps / 8.0 * (2.0 * kBent + 2.0 * kTwisted));
    };
    return octave(height_, cell_) + octave(0.25 * height_, cell_ / 8.0);
  }

  std::unique_ptr<GenerationTask> beginField(const FieldRequest& request, HeightView out) const override {
    return makeRowTask(out, [this, request, out](int row) {
      for (int column = 0; column < out.columns(); ++column) out(column, row) = sample(request, column, row);
    });
  }

  float sample(const FieldRequest& request, int column, int row) const {
    int bits = 0;
    while (request.pitch / static_cast<double>(std::int64_t{2} << bits) >= cell_) ++bits;
    const double side = request.pitch / static_cast<double>(std::int64_t{1} << bits);
    double height = octave(request, column, row, bits);
    const bool tooFine = request.level > 0 && side / 8.0 < 2.0 * request.spacing;
    if (!tooFine) height += 0.25 * octave(request, column, row, bits + 3);
    return static_cast<float>(mean_ + height_ * height);
  }

 private:
  struct Place {
    std::uint64_t cell = 0;
    double across = 0.0;
  };
  /// `pitches` from the lattice point `from`, in cells of which 2^bits lie along a pitch.
  static Place place(std::int64_t from, double pitches, int bits) {
    const double cells = pitches * static_cast<double>(std::int64_t{1} << bits);
    const double whole = std::floor(cells);
    return {(static_cast<std::uint64_t>(from) << bits) + static_cast<std::uint64_t>(whole), cells - whole};
  }
  static double octave(const FieldRequest& request, int column, int row, int bits) {
    const double step = request.spacing / request.pitch;
    const Place x = place(request.i, request.u + column * step, bits);
    const Place y = place(request.j, request.v + row * step, bits);
    const auto corner = [&](std::uint64_t dx, std::uint64_t dy) {
      const std::uint64_t of = hashWith(request.seed, static_cast<std::uint64_t>(bits));
      const std::uint64_t hash = hashWith(hashWith(of, x.cell + dx), y.cell + dy);
      return static_cast<double>(hash >> 11) * 0x1p-52 - 1.0;  // [-1, 1)
    };
    const auto smooth = [](double t) { return t * t * t * (10.0 + t * (6.0 * t - 15.0)); };
    const double u = smooth(x.across), v = smooth(y.across);
    const double south = corner(0, 0) + u * (corner(1, 0) - corner(0, 0));
    const double north = corner(0, 1) + u * (corner(1, 1) - corner(0, 1));
    return south + v * (north - south);
  }

  double mean_, height_, cell_;
};

}  // namespace teren
