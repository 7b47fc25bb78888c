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

/// A text a message or a person can be shown as it is. A null pointer with a length is a text nobody may
/// read, so it is refused before anything looks at the first letter.
bool isLine(std::string_view text, std::size_t bytes) {
  if (text.data() == nullptr) return text.empty();
  return text.size() <= bytes && shortened(text, bytes) == text;
}

/// Of texts that isLine has accepted.
bool isName(std::string_view name) {
  if (name.empty() || !isLetter(name.front())) return false;
  return std::all_of(name.begin(), name.end(),
                     [](char c) { return isLetter(c) || ('0' <= c && c <= '9') || c == '-' || c == '_'; });
}

bool isWholeAndExact(double value) {
  return std::floor(value) == value && std::fabs(value) <= 0x1p53;
}

std::string notALine(std::size_t bytes) {
  return "is not one line of readable text of at most " + std::to_string(bytes) + " bytes";
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
  if (row.choices.data() == nullptr || row.choices.empty()) {
    return Error{"parameter " + inQuotes(row.name) + " has no choices"};
  }
  if (row.choices.size() > kMostChoices) {
    return Error{"parameter " + inQuotes(row.name) + " has " + std::to_string(row.choices.size()) +
                 " choices, at most " + std::to_string(kMostChoices) + " are allowed"};
  }
  const bool lines = isLine(row.defaultChoice, kNameBytes) &&
                     std::all_of(row.choices.begin(), row.choices.end(),
                                 [](std::string_view choice) { return isLine(choice, kNameBytes); });
  if (!lines) return Error{"a choice of parameter " + inQuotes(row.name) + " " + notALine(kNameBytes)};
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

Result<void> checkText(const Parameter& row) {
  if (!(isWholeAndExact(row.max) && row.max >= 1.0 && row.max <= kMostTextBytes)) {
    return Error{"the text of parameter " + inQuotes(row.name) + " may have " + numberText(row.max) +
                 " bytes, expected 1 to " + numberText(kMostTextBytes)};
  }
  if (row.defaultChoice.data() == nullptr && !row.defaultChoice.empty()) {
    return Error{"the default of parameter " + inQuotes(row.name) + " is a text at no address"};
  }
  if (!isPlainText(row.defaultChoice, row.max)) {
    return Error{"the default " + inQuotes(row.defaultChoice) + " of parameter " + inQuotes(row.name) +
                 " has more than " + numberText(row.max) + " bytes or a control character"};
  }
  return {};
}

Result<void> checkRow(const Parameter& row, std::size_t number) {
  const std::string place = " of row " + std::to_string(number) + " of the table ";
  if (!isLine(row.name, kNameBytes)) return Error{"the name" + place + notALine(kNameBytes)};
  if (!isLine(row.unit, kNameBytes)) return Error{"the unit" + place + notALine(kNameBytes)};
  if (!isLine(row.doc, kDocBytes)) return Error{"the documentation" + place + notALine(kDocBytes)};
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
    case ParameterType::text:
      return checkText(row);
  }
  return Error{"parameter " + inQuotes(row.name) + " has the unknown type " +
               std::to_string(static_cast<int>(row.type))};
}

}  // namespace

bool isPlainText(std::string_view text, double maxBytes) noexcept {
  return static_cast<double>(text.size()) <= maxBytes && std::none_of(text.begin(), text.end(), [](char c) {
           return static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
         });
}

Result<void> checkTable(std::span<const Parameter> table) {
  if (table.size() > kMostParameters) {
    return Error{"the table has " + std::to_string(table.size()) + " parameters, at most " +
                 std::to_string(kMostParameters) + " are allowed"};
  }
  if (table.data() == nullptr && !table.empty()) {
    return Error{"the table has " + std::to_string(table.size()) + " parameters at no address"};
  }
  for (std::size_t k = 0; k < table.size(); ++k) {
    if (Result<void> row = checkRow(table[k], k + 1); !row) return row;
    const bool repeated =
        std::any_of(table.begin(), table.begin() + static_cast<std::ptrdiff_t>(k),
                    [&](const Parameter& earlier) { return earlier.name == table[k].name; });
    if (repeated) return Error{"parameter " + inQuotes(table[k].name) + " is in the table twice"};
  }
  return {};
}

}  // namespace teren
