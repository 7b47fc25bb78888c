#include "teren/Parameter.h"

#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <system_error>

#include "teren/Quote.h"

#include "plugin/TableCheck.h"

namespace teren {
namespace {

/// Up to here a double holds every integer.
constexpr std::int64_t kLargestInteger = std::int64_t{1} << 53;
constexpr std::size_t kListBytes = 400;  // of the names a sentence offers

const Parameter* findParameter(std::span<const Parameter> table, std::string_view name) {
  const auto found =
      std::find_if(table.begin(), table.end(), [name](const Parameter& row) { return row.name == name; });
  return found == table.end() ? nullptr : &*found;
}

std::string valueText(const ParameterValue& value) {
  if (const auto* number = std::get_if<double>(&value)) return numberText(*number);
  if (const auto* integer = std::get_if<std::int64_t>(&value)) return std::to_string(*integer);
  if (const auto* boolean = std::get_if<bool>(&value)) return *boolean ? "true" : "false";
  return inQuotes(*std::get_if<std::string>(&value));
}

std::string expectation(const Parameter& row) {
  const std::string range = " from " + numberText(row.min) + " to " + numberText(row.max) +
                            (row.unit.empty() ? "" : " " + std::string(row.unit));
  switch (row.type) {
    case ParameterType::real:
      return "a number" + range;
    case ParameterType::integer:
      return "a whole number" + range;
    case ParameterType::boolean:
      return "true or false";
    case ParameterType::text:
      return "a text of at most " + numberText(row.max) + " bytes without control characters";
    case ParameterType::choice:
      break;
  }
  std::string list;
  for (std::size_t k = 0; k < row.choices.size(); ++k) {
    list += (k == 0 ? "" : ", ") + std::string(row.choices[k]);
  }
  return "one of " + shortened(list, kListBytes);
}

/// The value in the row's own type and inside its range, or nothing.
std::optional<ParameterValue> realValue(const Parameter& row, const ParameterValue& value) {
  double number = 0.0;
  if (const auto* integer = std::get_if<std::int64_t>(&value)) {
    number = static_cast<double>(*integer);
  } else if (const auto* real = std::get_if<double>(&value)) {
    number = *real;
  } else {
    return std::nullopt;
  }
  if (!(row.min <= number && number <= row.max)) return std::nullopt;  // NaN fails both
  return number;
}

std::optional<ParameterValue> integerValue(const Parameter& row, const ParameterValue& value) {
  std::int64_t number = 0;
  if (const auto* integer = std::get_if<std::int64_t>(&value)) {
    number = *integer;
  } else if (const auto* real = std::get_if<double>(&value)) {
    const bool whole = std::floor(*real) == *real && std::fabs(*real) <= static_cast<double>(kLargestInteger);
    if (!whole) return std::nullopt;
    number = static_cast<std::int64_t>(*real);
  } else {
    return std::nullopt;
  }
  if (number < -kLargestInteger || number > kLargestInteger) return std::nullopt;
  const auto asReal = static_cast<double>(number);
  if (!(row.min <= asReal && asReal <= row.max)) return std::nullopt;
  return number;
}

std::optional<ParameterValue> textValue(const Parameter& row, const ParameterValue& value) {
  const auto* text = std::get_if<std::string>(&value);
  if (text == nullptr || !isPlainText(*text, row.max)) return std::nullopt;
  return value;
}

std::optional<ParameterValue> checkedValue(const Parameter& row, const ParameterValue& value) {
  switch (row.type) {
    case ParameterType::real:
      return realValue(row, value);
    case ParameterType::integer:
      return integerValue(row, value);
    case ParameterType::boolean:
      if (!std::holds_alternative<bool>(value)) return std::nullopt;
      return value;
    case ParameterType::text:
      return textValue(row, value);
    case ParameterType::choice:
      break;
  }
  const auto* choice = std::get_if<std::string>(&value);
  if (choice == nullptr) return std::nullopt;
  if (std::find(row.choices.begin(), row.choices.end(), *choice) == row.choices.end()) return std::nullopt;
  return value;
}

Error unknownParameter(std::span<const Parameter> table, std::string_view name, std::string_view owner) {
  std::string message = shortened(owner) + " has no parameter " + inQuotes(name);
  if (table.empty()) return {message + "; it has none at all"};
  std::string list;
  for (std::size_t k = 0; k < table.size(); ++k) list += (k == 0 ? "" : ", ") + std::string(table[k].name);
  return {message + "; it has " + shortened(list, kListBytes)};
}

/// A typed text as the value the row wants, as far as its form tells; ranges are Values::check's affair.
std::optional<ParameterValue> parseValue(const Parameter& row, std::string_view text) {
  if (row.type == ParameterType::choice || row.type == ParameterType::text) return std::string(text);
  if (row.type == ParameterType::boolean) {
    if (text == "true" || text == "1") return true;
    if (text == "false" || text == "0") return false;
    return std::nullopt;
  }
  if (row.type == ParameterType::integer) {
    const std::string_view digits = text.starts_with('+') ? text.substr(1) : text;
    std::int64_t integer = 0;
    const auto end = digits.data() + digits.size();
    const auto read = std::from_chars(digits.data(), end, integer);
    if (read.ec == std::errc() && read.ptr == end && !text.starts_with("+-")) return integer;
  }
  const Result<double> number = parseNumber(text);
  if (!number) return std::nullopt;
  return number.value();
}

}  // namespace

ParameterValue Parameter::defaultValue() const {
  switch (type) {
    case ParameterType::real:
      return defaultNumber;
    case ParameterType::integer:
      return static_cast<std::int64_t>(defaultNumber);
    case ParameterType::boolean:
      return defaultNumber != 0.0;
    case ParameterType::text:
    case ParameterType::choice:
      break;
  }
  return std::string(defaultChoice);
}

Values Values::defaults(std::span<const Parameter> table) {
  Values values;
  values.entries_.reserve(table.size());
  for (const Parameter& row : table) values.entries_.emplace_back(std::string(row.name), row.defaultValue());
  return values;
}

Result<Values> Values::check(std::span<const Parameter> table, std::span<const Entry> entries,
                             std::string_view owner) {
  Values values = defaults(table);
  std::vector<bool> given(table.size(), false);
  for (const auto& [name, value] : entries) {
    const Parameter* row = findParameter(table, name);
    if (row == nullptr) return unknownParameter(table, name, owner);
    const auto index = static_cast<std::size_t>(row - table.data());
    if (given[index])
      return Error{"parameter " + inQuotes(name) + " of " + shortened(owner) + " is given twice"};
    given[index] = true;
    std::optional<ParameterValue> checked = checkedValue(*row, value);
    if (!checked) {
      return Error{"parameter " + inQuotes(name) + " of " + shortened(owner) + " is " + valueText(value) +
                   " but must be " + expectation(*row)};
    }
    values.entries_[index].second = *std::move(checked);
  }
  return values;
}

Result<Values::Entry> parseAssignment(std::span<const Parameter> table, std::string_view text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos || equals == 0) {
    return Error{"expected name=value, not " + inQuotes(text)};
  }
  const std::string_view name = text.substr(0, equals);
  const std::string_view valuePart = text.substr(equals + 1);
  const Parameter* row = findParameter(table, name);
  if (row == nullptr) return Values::Entry(std::string(name), std::string(valuePart));
  std::optional<ParameterValue> value = parseValue(*row, valuePart);
  if (!value) {
    return Error{"parameter " + inQuotes(name) + " is " + inQuotes(valuePart) + " but must be " +
                 expectation(*row)};
  }
  return Values::Entry(std::string(name), *std::move(value));
}

Result<double> parseNumber(std::string_view text) {
  // std::from_chars knows no leading '+', but "+-2" must not become a number by removing it.
  const bool plus = text.starts_with('+') && !text.starts_with("+-");
  const std::string_view digits = plus ? text.substr(1) : text;
  double number = 0.0;
  const auto end = digits.data() + digits.size();
  const auto read = std::from_chars(digits.data(), end, number);
  const bool whole = read.ptr == end && !digits.empty();
  if (whole && read.ec == std::errc::result_out_of_range) {
    return Error{inQuotes(text) + " is a number too large or too small for double precision"};
  }
  if (!whole || read.ec != std::errc() || !std::isfinite(number)) {
    return Error{inQuotes(text) + " is not a finite decimal number"};
  }
  return number;
}

std::string numberText(double value) {
  std::array<char, 32> buffer{};
  const auto written = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return std::string(buffer.data(), written.ptr);
}

}  // namespace teren
