#include "plugin/TableCheck.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "teren/Quote.h"

namespace teren {
namespace {

bool isLetter(char c) {
  return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z');
}

bool isName(std::string_view name) {
  if (name.empty() || !isLetter(name.front())) return false;
  return std::all_of(name.begin(), name.end(),
                     [](char c) { return isLetter(c) || ('0' <= c && c <= '9') || c == '-' || c == '_'; });
}

bool isWholeAndExact(double value) {
  return std::floor(value) == value && std::fabs(value) <= 0x1p53;
}

Result<void> checkNumber(const Parameter& row) {
  const std::string range = "the range " + numberText(row.min) + " to " + numberText(row.max);
  const std::string owner = " of parameter " + inQuotes(row.name);
  if (!std::isfinite(row.min) || !std::isfinite(row.max) || row.min > row.max) {
    return Error{range + owner + " is empty or not finite"};
  }
  if (!(row.min <= row.defaultNumber && row.defaultNumber <= row.max)) {
    return Error{"the default " + numberText(row.defaultNumber) + owner + " is outside " + range};
  }
  if (row.type == ParameterType::real) return {};
  for (const double value : {row.min, row.max, row.defaultNumber}) {
    if (!isWholeAndExact(value)) {
      return Error{numberText(value) + " in the row" + owner + " is not a whole number within +-2^53"};
    }
  }
  return {};
}

Result<void> checkChoice(const Parameter& row) {
  if (row.choices.empty()) return Error{"parameter " + inQuotes(row.name) + " has no choices"};
  for (std::size_t k = 0; k < row.choices.size(); ++k) {
    const auto first = std::find(row.choices.begin(), row.choices.end(), row.choices[k]);
    if (row.choices[k].empty() || first != row.choices.begin() + static_cast<std::ptrdiff_t>(k)) {
      return Error{"the choice " + inQuotes(row.choices[k]) + " of parameter " + inQuotes(row.name) +
                   " is empty or there twice"};
    }
  }
  if (std::find(row.choices.begin(), row.choices.end(), row.defaultChoice) == row.choices.end()) {
    return Error{"the default " + inQuotes(row.defaultChoice) + " of parameter " + inQuotes(row.name) +
                 " is not one of its choices"};
  }
  return {};
}

Result<void> checkRow(const Parameter& row) {
  if (!isName(row.name)) {
    return Error{"the parameter name " + inQuotes(row.name) +
                 " is not made of letters, digits, '-' and '_', a letter first"};
  }
  switch (row.type) {
    case ParameterType::real:
    case ParameterType::integer:
    case ParameterType::boolean:
      return checkNumber(row);
    case ParameterType::choice:
      return checkChoice(row);
  }
  return Error{"parameter " + inQuotes(row.name) + " has the unknown type " +
               std::to_string(static_cast<int>(row.type))};
}

}  // namespace

Result<void> checkTable(std::span<const Parameter> table) {
  if (table.size() > kMostParameters) {
    return Error{"the table has " + std::to_string(table.size()) + " parameters, at most " +
                 std::to_string(kMostParameters) + " are allowed"};
  }
  for (std::size_t k = 0; k < table.size(); ++k) {
    if (Result<void> row = checkRow(table[k]); !row) return row;
    const bool repeated =
        std::any_of(table.begin(), table.begin() + static_cast<std::ptrdiff_t>(k),
                    [&](const Parameter& earlier) { return earlier.name == table[k].name; });
    if (repeated) return Error{"parameter " + inQuotes(table[k].name) + " is in the table twice"};
  }
  return {};
}

}  // namespace teren
