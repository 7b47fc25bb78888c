// Grounds of known shape for tests of what flies over them.
#pragma once

#include <functional>
#include <optional>

#include "teren/Object.h"

namespace teren {

/// The height as a function of metres east and north.
class FakeGround : public Ground {
 public:
  using Shape = std::function<std::optional<double>(double east, double north)>;
  explicit FakeGround(Shape shape) : shape_(std::move(shape)) {}

  std::optional<double> height(const Position& position) const override {
    return shape_(position.x(pitch()), position.y(pitch()));
  }
  double pitch() const noexcept override { return 64.0; }

 private:
  Shape shape_;
};

inline FakeGround flatGround(double height) {
  return FakeGround([height](double, double) { return height; });
}

inline FakeGround unknownGround() {
  return FakeGround([](double, double) { return std::nullopt; });
}

}  // namespace teren
