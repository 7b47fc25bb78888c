#include "apps/report/Table.h"

#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <utility>

namespace teren {
namespace {

constexpr int kFileDigits = 9, kPageDigits = 4;

std::string heading(const Column& column) {
  return column.unit.empty() ? column.name : column.name + " [" + column.unit + "]";
}

std::string textOf(const Cell& cell, int digits) {
  if (const auto* number = std::get_if<double>(&cell)) return rounded(*number, digits);
  const auto* text = std::get_if<std::string>(&cell);
  return text == nullptr ? std::string() : *text;
}

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string all = "\"";
  for (const char c : text) all += c == '"' ? std::string("\"\"") : std::string(1, c);
  return all + "\"";
}

}  // namespace

void Table::add(std::vector<Cell> row) {
  assert(row.size() == columns_.size());
  rows_.push_back(std::move(row));
}

std::size_t Table::indexOf(std::string_view column) const {
  std::size_t index = 0;
  while (index < columns_.size() && columns_[index].name != column) ++index;
  assert(index < columns_.size());
  return index;
}

double Table::number(std::size_t row, std::string_view column) const {
  const auto* number = std::get_if<double>(&rows_.at(row).at(indexOf(column)));
  return number == nullptr ? 0.0 : *number;
}

std::string Table::text(std::size_t row, std::string_view column) const {
  return textOf(rows_.at(row).at(indexOf(column)), kPageDigits);
}

std::string rounded(double number, int digits) {
  std::array<char, 64> text{};
  const double kept = number == 0.0 ? 0.0 : number;  // -0 as 0
  // No exponent where the number is a whole one that people read as such.
  const bool isLarge = std::fabs(kept) >= std::pow(10.0, digits) - 0.5 && std::fabs(kept) < 1e15;
  char* const first = text.data();
  char* const last = first + text.size();
  const auto end = isLarge ? std::to_chars(first, last, kept, std::chars_format::fixed, 0)
                           : std::to_chars(first, last, kept, std::chars_format::general, digits);
  return {first, end.ptr};
}

std::string csvOf(const Table& table) {
  std::string text;
  const auto line = [&text](std::size_t cells, const auto& cell) {
    for (std::size_t k = 0; k < cells; ++k) text += (k == 0 ? "" : ",") + quoted(cell(k));
    text += '\n';
  };
  line(table.columns().size(), [&](std::size_t k) { return heading(table.columns()[k]); });
  for (const auto& row : table.rows()) {
    line(row.size(), [&](std::size_t k) { return textOf(row[k], kFileDigits); });
  }
  return text;
}

std::string escapedForHtml(std::string_view text) {
  std::string all;
  for (const char c : text) {
    switch (c) {
      case '&':
        all += "&amp;";
        break;
      case '<':
        all += "&lt;";
        break;
      case '>':
        all += "&gt;";
        break;
      case '"':
        all += "&quot;";
        break;
      case '\'':
        all += "&#39;";
        break;
      default:
        all += c;
    }
  }
  return all;
}

std::string htmlOf(const Table& table) {
  std::string html = "<div class=\"wide\"><table>\n<thead><tr>";
  for (const Column& column : table.columns()) {
    html += "<th title=\"" + escapedForHtml(column.doc) + "\">" + escapedForHtml(column.name);
    if (!column.unit.empty()) html += "<br><small>" + escapedForHtml(column.unit) + "</small>";
    html += "</th>";
  }
  html += "</tr></thead>\n<tbody>\n";
  for (const auto& row : table.rows()) {
    html += "<tr>";
    for (const Cell& cell : row) {
      const bool isText = std::holds_alternative<std::string>(cell);
      html += (isText ? "<td class=\"text\">" : "<td>") + escapedForHtml(textOf(cell, kPageDigits)) + "</td>";
    }
    html += "</tr>\n";
  }
  html += "</tbody></table></div>\n<details><summary>What the columns mean</summary><dl>\n";
  for (const Column& column : table.columns()) {
    html += "<dt>" + escapedForHtml(heading(column)) + "</dt><dd>" + escapedForHtml(column.doc) + "</dd>\n";
  }
  return html + "</dl></details>\n";
}

}  // namespace teren
