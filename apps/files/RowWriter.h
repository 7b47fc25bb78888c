// Nets of triangles as text, row by row: the numbers' spelling and the questions between the rows.
#pragma once

#include <cstddef>
#include <cstdio>
#include <functional>
#include <string>
#include <string_view>

#include "teren/Result.h"

namespace teren {

/// Asked before each row of text, with how many of them are written; false stops the writing.
using RowProgress = std::function<bool(std::size_t done, std::size_t wanted)>;

/// Text on its way to a stream. Memory: one row. Errors: the disk's, or "interrupted".
class RowWriter {
 public:
  /// `rows` in all; the stream and the question must outlive it.
  RowWriter(std::FILE* stream, const RowProgress& progress, std::size_t rows)
      : stream_(stream), progress_(progress), wanted_(rows) {}

  RowWriter& operator<<(std::string_view text) {
    text_ += text;
    return *this;
  }
  RowWriter& operator<<(std::size_t number);
  /// The fewest digits that give the same number back (-0 as 0); never an exponent, which not every reader
  /// knows. Finite.
  RowWriter& shortest(float number);
  RowWriter& shortest(double number);
  /// With four decimals, as normals need.
  RowWriter& rounded(double number);

  /// Writes what was appended since the last call.
  Result<void> flush();

  /// `count` rows, each appended by `row(index)` and written.
  template <class Count, class Row>
  Result<void> rows(Count count, const Row& row) {
    for (Count index = 0; index < count; ++index) {
      if (!progress_(done_++, wanted_)) return Error{"interrupted"};
      row(index);
      if (Result<void> written = flush(); !written) return written;
    }
    return {};
  }

 private:
  template <class... Arguments>
  RowWriter& append(Arguments... number);

  std::FILE* stream_;
  const RowProgress& progress_;
  std::size_t done_ = 0, wanted_;
  std::string text_;
};

}  // namespace teren
