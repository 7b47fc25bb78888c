#include "apps/check/Setting.h"

#include <cstdint>

#include "teren/Quote.h"

namespace teren::check {
namespace {

std::string valueText(const ParameterValue& value) {
  if (const auto* real = std::get_if<double>(&value)) return numberText(*real);
  if (const auto* integer = std::get_if<std::int64_t>(&value)) return std::to_string(*integer);
  if (const auto* text = std::get_if<std::string>(&value)) return inQuotes(*text);
  return std::get<bool>(value) ? "true" : "false";
}

std::vector<ParameterValue> extremesOf(const Parameter& parameter) {
  switch (parameter.type) {
    case ParameterType::real:
      return {parameter.min, parameter.max};
    case ParameterType::integer:
      return {static_cast<std::int64_t>(parameter.min), static_cast<std::int64_t>(parameter.max)};
    case ParameterType::boolean:
      return {false, true};
    case ParameterType::choice:
      break;
    case ParameterType::text:
      return {};
  }
  std::vector<ParameterValue> choices;
  for (const std::string_view choice : parameter.choices) choices.emplace_back(std::string(choice));
  return choices;
}

}  // namespace

std::vector<Setting> settingsOf(std::span<const Parameter> table) {
  std::vector<Setting> settings{{}};
  for (const Parameter& parameter : table) {
    for (const ParameterValue& value : extremesOf(parameter)) {
      if (value != parameter.defaultValue()) settings.push_back({{std::string(parameter.name), value}});
    }
  }
  return settings;
}

std::string textOf(const Setting& setting) {
  if (setting.empty()) return "defaults";
  std::string all;
  for (const auto& [name, value] : setting)
    all += (all.empty() ? "" : ", ") + name + " = " + valueText(value);
  return all;
}

}  // namespace teren::check
