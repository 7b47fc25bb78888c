// The round numbers that a key or a slider chooses among.
#pragma once

#include <span>

namespace teren {

/// A table of values, rising. What is not in it, typed on a command line for instance, lies between two.
class Steps {
 public:
  /// [m] How far the land is drawn: 1 km to 100 km.
  static Steps distances() noexcept;
  /// [px] How far it may be off: 0.25 to 64.
  static Steps pixelErrors() noexcept;
  /// [m] How large a tool is, its radius: 3 to 200 m.
  static Steps toolSizes() noexcept;
  /// [m] How deep it goes: 0.25 to 50 m.
  static Steps toolDepths() noexcept;

  int count() const noexcept { return static_cast<int>(values_.size()); }
  /// 0 ... count() - 1; others are brought there.
  double at(int index) const noexcept;
  /// Of the value nearest by ratio to this one (> 0).
  int nearest(double value) const noexcept;
  /// The next one above (`direction` > 0) or below it; at the table's end, the end.
  double next(double value, int direction) const noexcept;

 private:
  explicit Steps(std::span<const double> values) noexcept : values_(values) {}
  std::span<const double> values_;
};

}  // namespace teren
