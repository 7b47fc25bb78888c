#include "generators/filter/FilterMatrix.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <system_error>
#include <utility>

namespace teren {
namespace {

/// Sums over rectangles of a square of numbers, each from four stored sums.
class RectangleSums {
 public:
  template <class Value>
  RectangleSums(int side, Value value)
      : across_(side + 1), sums_(static_cast<std::size_t>(across_) * static_cast<std::size_t>(across_)) {
    for (int row = 0; row < side; ++row) {
      for (int column = 0; column < side; ++column) {
        at(row + 1, column + 1) =
            at(row, column + 1) + at(row + 1, column) - at(row, column) + value(row, column);
      }
    }
  }
  /// Over rows row0 ... row1 - 1 and columns column0 ... column1 - 1.
  double sum(int row0, int row1, int column0, int column1) const {
    return at(row1, column1) - at(row0, column1) - at(row1, column0) + at(row0, column0);
  }

 private:
  double at(int row, int column) const { return sums_[static_cast<std::size_t>(row * across_ + column)]; }
  double& at(int row, int column) { return sums_[static_cast<std::size_t>(row * across_ + column)]; }

  int across_;
  std::vector<double> sums_;
};

std::string text(double number) {
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, number, std::chars_format::general, 6).ptr;
  return {digits, end};
}

std::string sizeText(int rows, int columns) {
  return std::to_string(rows) + " x " + std::to_string(columns);
}

bool isSeparator(char c) {
  return c == ' ' || c == ',';
}

/// Appends the numbers of one row.
Result<int> parseRow(std::string_view row, std::vector<double>& elements) {
  int count = 0;
  const char* at = row.data();
  const char* const end = row.data() + row.size();
  for (;; ++count) {
    at = std::find_if_not(at, end, isSeparator);
    if (at == end) return count;
    const char* const wordEnd = std::find_if(at, end, isSeparator);
    if (*at == '+' && at + 1 != wordEnd && at[1] != '-') ++at;  // from_chars knows no leading '+'
    double element = 0.0;
    const auto read = std::from_chars(at, wordEnd, element);
    if (read.ec != std::errc() || read.ptr != wordEnd) {
      constexpr std::ptrdiff_t kShown = 20;
      return Error{"\"" + std::string(at, std::min(wordEnd, at + kShown)) +
                   "\" in its matrix is not a number"};
    }
    elements.push_back(element);
    at = wordEnd;
  }
}

}  // namespace

Result<FilterMatrix> FilterMatrix::make(int side, std::vector<double> elements) {
  if (side < 1 || side > kMaxSide || side % 2 == 0) {
    return Error{"its matrix has " + std::to_string(side) + " rows, expected an odd number from 1 to " +
                 std::to_string(kMaxSide)};
  }
  if (elements.size() != static_cast<std::size_t>(side) * static_cast<std::size_t>(side)) {
    return Error{"its matrix has " + std::to_string(elements.size()) + " elements, expected " +
                 sizeText(side, side)};
  }
  for (const double element : elements) {
    if (!(std::fabs(element) <= kMaxElement)) {
      return Error{"the element " + text(element) + " of its matrix is not a number from " +
                   text(-kMaxElement) + " to " + text(kMaxElement)};
    }
  }
  FilterMatrix matrix(side, std::move(elements));
  if (const Result<void> sound = matrix.measureGain(); !sound) return sound.error();
  matrix.measureReach();
  return matrix;
}

Result<FilterMatrix> FilterMatrix::parse(std::string_view rows) {
  std::vector<double> elements;
  int rowCount = 0, columns = 0;
  for (bool more = true; more;) {
    const std::size_t end = rows.find(';');
    more = end != std::string_view::npos;
    const Result<int> count = parseRow(rows.substr(0, end), elements);
    if (!count) return count.error();
    if (++rowCount == 1) columns = *count;
    if (*count != columns) {
      return Error{"row " + std::to_string(rowCount) + " of its matrix has " + std::to_string(*count) +
                   " elements, expected " + std::to_string(columns) + " as in the first"};
    }
    if (more) rows.remove_prefix(end + 1);
  }
  if (rowCount != columns) {
    return Error{"its matrix has " + sizeText(rowCount, columns) + " elements, expected a square"};
  }
  return make(rowCount, std::move(elements));
}

/// Every rectangle that holds the middle is the part used somewhere on some map.
Result<void> FilterMatrix::measureGain() {
  const FilterMatrix& self = *this;
  const RectangleSums sums(side_, self);
  const RectangleSums sizes(side_, [&](int row, int column) { return std::fabs(self(row, column)); });
  const int middle = radius();
  for (int row0 = 0; row0 <= middle; ++row0) {
    for (int row1 = side_; row1 > middle; --row1) {
      for (int column0 = 0; column0 <= middle; ++column0) {
        for (int column1 = side_; column1 > middle; --column1) {
          const double sum = std::fabs(sums.sum(row0, row1, column0, column1));
          const double size = sizes.sum(row0, row1, column0, column1);
          if (!(sum >= kMinSum && size <= kMaxGain * sum)) {
            const bool all = row1 - row0 == side_ && column1 - column0 == side_;
            return Error{
                "the elements of its matrix sum to " + text(sums.sum(row0, row1, column0, column1)) +
                (all ? ""
                     : " where a map's rim leaves " + sizeText(row1 - row0, column1 - column0) + " of them") +
                ", too near to zero to divide by"};
          }
          gain_ = std::max(gain_, size / sum);
        }
      }
    }
  }
  return {};
}

void FilterMatrix::measureReach() {
  double sizes = 0.0, east = 0.0, north = 0.0, squares = 0.0;
  for (int row = 0; row < side_; ++row) {
    for (int column = 0; column < side_; ++column) {
      const double size = std::fabs((*this)(row, column));
      const double x = column - radius(), y = radius() - row;
      sizes += size;
      east += size * x;
      north += size * y;
      squares += size * (x * x + y * y);
    }
  }
  squaredReach_ = squares / sizes;
  squaredShift_ = (east * east + north * north) / (sizes * sizes);
}

}  // namespace teren
