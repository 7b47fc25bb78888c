// A continuous generator that keeps its contract: random numbers on the lattice, bilinear between.
#pragma once

#include "tests/apps/check/modules/Sound.h"

namespace sound {

class Field : public teren::ContinuousGenerator {
 public:
  static std::span<const teren::Parameter> parameters() noexcept {
    static constexpr teren::Parameter table[] = {
        teren::Parameter::real("height", 3.0, 1.0, 10.0, "m", "Largest height")};
    return table;
  }
  explicit Field(const teren::Values& values) : height_(values.real("height")) {}

  // Over a cell, a number's weight has the mean square 2 / 3 along each axis.
  teren::HeightRange range() const override {
    return {0.0, height_ / std::sqrt(3.0) * 2.0 / 3.0, -height_, height_};
  }
  // Triangles miss a square whose corners twist by T by T / sqrt 90 in the root mean square, by T / 4 at
  // most; the four numbers of a cell, to which samples divide it, twist by 2 h / sqrt 3, by 4 h at most.
  double residual(int level, int samples, double) const override {
    const double part = 2.0 * std::ldexp(1.0, level) / (samples - 1);
    return level == 0 ? 0.0 : part * part * 2.0 * height_ / std::sqrt(3.0 * 90.0);
  }
  double fieldError(double spacing) const override {
    const double part = spacing / 64.0;
    return part <= 1.0 ? part * part * height_ : 2.0 * height_;
  }
  std::unique_ptr<teren::GenerationTask> beginField(const teren::FieldRequest& request,
                                                    teren::HeightView out) const override {
    return teren::makeRowTask(out, [this, request, out](int row) {
      for (int column = 0; column < out.columns(); ++column) out(column, row) = height(request, column, row);
    });
  }

 protected:
  float height(const teren::FieldRequest& request, int column, int row) const {
    const double east = request.u + column * (request.spacing / request.pitch);
    const double north = request.v + row * (request.spacing / request.pitch);
    const double u = east - std::floor(east), v = north - std::floor(north);
    const auto at = [&](int x, int y) {
      return number(request.seed, sum(request.i, std::floor(east) + x),
                    sum(request.j, std::floor(north) + y));
    };
    const double south = (1.0 - u) * at(0, 0) + u * at(1, 0), beyond = (1.0 - u) * at(0, 1) + u * at(1, 1);
    return static_cast<float>(height_ * ((1.0 - v) * south + v * beyond));
  }

 private:
  static std::int64_t sum(std::int64_t point, double whole) {  // modulo 2^64
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(point) +
                                     static_cast<std::uint64_t>(static_cast<std::int64_t>(whole)));
  }
  double height_;
};

}  // namespace sound
