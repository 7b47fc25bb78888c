// A table of the report: columns with units and meanings, and rows; one model for the CSV file and the page.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace teren {

struct Column {
  std::string name;
  std::string unit;  ///< empty: a pure number or a text
  std::string doc;   ///< one sentence
};

/// A text, a number, or nothing, where there is nothing to be measured.
using Cell = std::variant<std::monostate, std::string, double>;

class Table {
 public:
  /// `name` is the file's, without its ending; `title` and `doc` (a paragraph) are for the page.
  Table(std::string name, std::string title, std::string doc, std::vector<Column> columns)
      : name_(std::move(name)),
        title_(std::move(title)),
        doc_(std::move(doc)),
        columns_(std::move(columns)) {}

  const std::string& name() const noexcept { return name_; }
  const std::string& title() const noexcept { return title_; }
  const std::string& doc() const noexcept { return doc_; }
  const std::vector<Column>& columns() const noexcept { return columns_; }
  const std::vector<std::vector<Cell>>& rows() const noexcept { return rows_; }

  /// As many cells as columns (assert).
  void add(std::vector<Cell> row);

  /// Cells by the names of their columns, which must be there (assert); a number that is not there is 0.
  double number(std::size_t row, std::string_view column) const;
  std::string text(std::size_t row, std::string_view column) const;

 private:
  std::size_t indexOf(std::string_view column) const;

  std::string name_, title_, doc_;
  std::vector<Column> columns_;
  std::vector<std::vector<Cell>> rows_;
};

/// `digits` significant digits at most, never more than needed: "0.25", "1e-12"; of larger numbers, below
/// 1e15, all before the point.
std::string rounded(double number, int digits);

/// Comma-separated (RFC 4180), lines ended by \n; the first line is "name [unit]" of each column; numbers
/// have nine digits.
std::string csvOf(const Table& table);

/// Characters that mean something in HTML, as text and in attributes, replaced by what stands for them.
std::string escapedForHtml(std::string_view text);

/// The table and the list of what its columns mean.
std::string htmlOf(const Table& table);

}  // namespace teren
