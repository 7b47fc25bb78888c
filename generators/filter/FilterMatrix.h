// The matrix of a matrix filter: an odd square of weights, as a person writes it, checked for use.
#pragma once

#include <string_view>
#include <utility>
#include <vector>

#include "teren/Result.h"

namespace teren {

/// What a sample becomes: the weighted sum of the samples around it, divided by the sum of the weights used.
/// Elements are written as on paper: rows from north to south, each from west to east; the middle one weighs
/// the sample itself. Where a map ends, only the elements that have a sample are used, and the division is by
/// their sum (thesis A, 2005). There the elements must sum to 1; here any sum that is not nearly zero does.
class FilterMatrix {
 public:
  static constexpr int kMaxSide = 31;
  static constexpr double kMaxElement = 1e6;
  /// How much larger than the size of their sum the sum of the sizes of the used elements may be.
  static constexpr double kMaxGain = 100.0;
  static constexpr double kMinSum = 1e-9;  ///< of the elements used

  /// Refuses other than side * side elements, even sides, sides beyond kMaxSide, elements that are not finite
  /// or larger than kMaxElement, and a matrix of which the used elements - all, or at a rim a rectangle of
  /// them that holds the middle - sum to less than kMinSum or so nearly to zero that the gain is beyond
  /// kMaxGain. O(side^4).
  static Result<FilterMatrix> make(int side, std::vector<double> elements);

  /// Reads rows separated by ';' of numbers separated by spaces or commas: "1 2 1; 2 4 2; 1 2 1".
  static Result<FilterMatrix> parse(std::string_view text);

  int side() const noexcept { return side_; }
  int radius() const noexcept { return side_ / 2; }
  /// Row 0 is the northern one, column 0 the western one.
  double operator()(int row, int column) const noexcept { return elements_[row * side_ + column]; }
  const double* row(int row) const noexcept { return elements_.data() + row * side_; }

  /// The largest gain of any used part: the sum of the elements' sizes by the size of their sum. 1 where no
  /// element is negative, more for matrices that sharpen.
  double gain() const noexcept { return gain_; }
  /// Mean of the squared distance [samples^2] between a sample and those that weigh in it, and its share by
  /// the shift of their centre, both weighted by the elements' sizes.
  double squaredReach() const noexcept { return squaredReach_; }
  double squaredShift() const noexcept { return squaredShift_; }

 private:
  FilterMatrix(int side, std::vector<double> elements) : side_(side), elements_(std::move(elements)) {}
  Result<void> measureGain();
  void measureReach();

  int side_;
  std::vector<double> elements_;
  double gain_ = 1.0, squaredReach_ = 0.0, squaredShift_ = 0.0;
};

}  // namespace teren
