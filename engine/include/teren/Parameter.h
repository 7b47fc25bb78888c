// Parameter tables: a plugin describes its parameters once, and the command line, the world file, the Qt
// panel, the .iv fields and the documents all read the same table.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "teren/Result.h"

namespace teren {

enum class ParameterType { real, integer, boolean, choice, text };

/// A parameter's value; which alternative follows from the parameter's type (choice and text are strings).
using ParameterValue = std::variant<double, std::int64_t, bool, std::string>;

/// One row of a parameter table. All texts must outlive the plugin (string literals do).
struct Parameter {
  std::string_view name;
  ParameterType type = ParameterType::real;
  double defaultNumber = 0.0;      ///< real, integer and boolean (0 or 1)
  double min = 0.0, max = 0.0;     ///< inclusive range of real and integer; max: the most bytes of a text
  std::string_view defaultChoice;  ///< choice and text
  std::span<const std::string_view> choices;
  std::string_view unit;  ///< "m", "1/m", "degree"; empty for pure numbers
  std::string_view doc;   ///< one line

  static constexpr Parameter real(std::string_view name, double defaultValue, double min, double max,
                                  std::string_view unit, std::string_view doc) {
    return {name, ParameterType::real, defaultValue, min, max, {}, {}, unit, doc};
  }
  /// Integers are limited to +-2^53, so that a double holds each of them exactly.
  static constexpr Parameter integer(std::string_view name, std::int64_t defaultValue, std::int64_t min,
                                     std::int64_t max, std::string_view unit, std::string_view doc) {
    return {name,
            ParameterType::integer,
            static_cast<double>(defaultValue),
            static_cast<double>(min),
            static_cast<double>(max),
            {},
            {},
            unit,
            doc};
  }
  static constexpr Parameter boolean(std::string_view name, bool defaultValue, std::string_view doc) {
    return {name, ParameterType::boolean, defaultValue ? 1.0 : 0.0, 0.0, 1.0, {}, {}, {}, doc};
  }
  static constexpr Parameter choice(std::string_view name, std::string_view defaultValue,
                                    std::span<const std::string_view> choices, std::string_view doc) {
    return {name, ParameterType::choice, 0.0, 0.0, 0.0, defaultValue, choices, {}, doc};
  }

  /// For what no number can say, a list for instance; the plugin reads it. At most maxBytes (1 ... 65536)
  /// without control characters.
  static constexpr Parameter text(std::string_view name, std::string_view defaultText, std::size_t maxBytes,
                                  std::string_view doc) {
    return {name, ParameterType::text, 0.0, 0.0, static_cast<double>(maxBytes), defaultText, {}, {}, doc};
  }

  ParameterValue defaultValue() const;
};

/// Checked values of one parameter table: every parameter of the table has one, of the right type and inside
/// its range. Asking for a name that is not in the table, or by the wrong type, is a broken contract
/// (assert).
class Values {
 public:
  using Entry = std::pair<std::string, ParameterValue>;

  /// The defaults of a table.
  static Values defaults(std::span<const Parameter> table);

  /// The defaults, overridden by `entries`; refuses unknown names, repeated names, wrong types, non-finite
  /// numbers, values outside the range, and texts that are too long or hold control characters. A
  /// whole-numbered real is accepted for an integer parameter and any integer for a real one. `owner` names
  /// the plugin in the message.
  static Result<Values> check(std::span<const Parameter> table, std::span<const Entry> entries,
                              std::string_view owner);

  // Defined here because plugins, which link no engine, call them.
  double real(std::string_view name) const { return get<double>(name); }
  std::int64_t integer(std::string_view name) const { return get<std::int64_t>(name); }
  bool boolean(std::string_view name) const { return get<bool>(name); }
  const std::string& choice(std::string_view name) const { return get<std::string>(name); }
  const std::string& text(std::string_view name) const { return get<std::string>(name); }

  std::span<const Entry> entries() const noexcept { return entries_; }

 private:
  template <class T>
  const T& get(std::string_view name) const {
    const auto entry = std::find_if(entries_.begin(), entries_.end(),
                                    [name](const Entry& candidate) { return candidate.first == name; });
    assert(entry != entries_.end() && std::holds_alternative<T>(entry->second));
    return *std::get_if<T>(&entry->second);
  }

  std::vector<Entry> entries_;  // in the order of the table
};

/// Reads "name=value" as typed by a person. The type is the table's where the name is known to it; otherwise
/// the value is kept as text, and Values::check reports the unknown name.
Result<Values::Entry> parseAssignment(std::span<const Parameter> table, std::string_view text);

/// The whole text as a finite decimal number, locale-independent ("-.5", "+2" and "1e3" are numbers).
Result<double> parseNumber(std::string_view text);

/// A number as the shortest decimal text that reads back as the same double.
std::string numberText(double value);

}  // namespace teren
