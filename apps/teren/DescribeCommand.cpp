// teren describe ID [--json]: one plugin and its parameter table.
#include <iostream>

#include "teren/Parameter.h"
#include "teren/Quote.h"

#include "apps/teren/Command.h"
#include "apps/teren/JsonOutput.h"

namespace teren {
namespace {

const char* typeText(ParameterType type) {
  switch (type) {
    case ParameterType::real:
      return "real";
    case ParameterType::integer:
      return "integer";
    case ParameterType::boolean:
      return "boolean";
    case ParameterType::text:
      return "text";
    case ParameterType::choice:
      break;
  }
  return "choice";
}

/// A bound in the parameter's own type, of a text its bytes; null where it has none.
OrderedJson boundJson(const Parameter& parameter, double bound) {
  if (parameter.type == ParameterType::real) return bound;
  if (parameter.type == ParameterType::integer || parameter.type == ParameterType::text)
    return static_cast<std::int64_t>(bound);
  return nullptr;
}

OrderedJson defaultJson(const Parameter& parameter) {
  return std::visit([](const auto& value) { return OrderedJson(value); }, parameter.defaultValue());
}

OrderedJson asJson(const Parameter& parameter) {
  OrderedJson row = {{"name", parameter.name},
                     {"type", typeText(parameter.type)},
                     {"default", defaultJson(parameter)},
                     {"min", boundJson(parameter, parameter.min)},
                     {"max", boundJson(parameter, parameter.max)},
                     {"unit", parameter.unit},
                     {"doc", parameter.doc}};
  if (parameter.type == ParameterType::choice) {
    row["choices"] = OrderedJson::array();
    for (const std::string_view choice : parameter.choices) row["choices"].push_back(choice);
  }
  return row;
}

std::string asText(const Parameter& parameter) {
  std::string line = std::string(parameter.name) + " (" + typeText(parameter.type);
  const std::string unit = parameter.unit.empty() ? "" : " " + std::string(parameter.unit);
  if (parameter.type == ParameterType::choice) {
    line += ":";
    for (const std::string_view choice : parameter.choices) line += " " + std::string(choice);
    line += "; default " + std::string(parameter.defaultChoice);
  } else if (parameter.type == ParameterType::text) {
    line +=
        " of at most " + numberText(parameter.max) + " bytes; default " + inQuotes(parameter.defaultChoice);
  } else if (parameter.type == ParameterType::boolean) {
    line += std::string("; default ") + (parameter.defaultNumber != 0.0 ? "true" : "false");
  } else {
    line += " from " + numberText(parameter.min) + " to " + numberText(parameter.max) + unit + "; default " +
            numberText(parameter.defaultNumber) + unit;
  }
  return line + "): " + std::string(parameter.doc);
}

class DescribeCommand final : public Command {
 public:
  explicit DescribeCommand(CLI::App& parent)
      : Command(parent, "describe", "tell a plugin's parameters: types, defaults, ranges, units"),
        id_(application().add_option("ID", "the plugin's id, as `teren plugins` lists it")->required()),
        json_(addJson()) {}

  ExitCode run() override {
    const auto registry = PluginRegistry::standard();
    const std::string id = argument(*id_);
    const PluginInfo* plugin = registry->find(id);
    if (plugin == nullptr) return fail(kWrongInput, unknownId(*registry, id));
    if (json_->count() > 0) {
      OrderedJson answer = {{"id", plugin->id},
                            {"kind", kindName(plugin->kind)},
                            {"version", plugin->version},
                            {"doc", plugin->doc},
                            {"parameters", OrderedJson::array()}};
      for (const Parameter& parameter : plugin->parameters) answer["parameters"].push_back(asJson(parameter));
      printJson(answer);
      return kSuccess;
    }
    std::cout << plugin->id << " (" << kindName(plugin->kind) << ", version " << plugin->version
              << "): " << plugin->doc << '\n';
    for (const Parameter& parameter : plugin->parameters) std::cout << "  " << asText(parameter) << '\n';
    return kSuccess;
  }

 private:
  static std::string unknownId(const PluginRegistry& registry, const std::string& id) {
    std::string sentence = "no plugin has the id " + inQuotes(id) + "; there are";
    if (registry.plugins().empty()) return sentence + " none";
    for (const PluginInfo& plugin : registry.plugins()) {
      sentence += (&plugin == registry.plugins().data() ? " " : ", ") + plugin.id;
    }
    return sentence;
  }

  const CLI::Option* id_;
  const CLI::Option* json_;
};

}  // namespace

std::unique_ptr<Command> makeDescribeCommand(CLI::App& parent) {
  return std::make_unique<DescribeCommand>(parent);
}

}  // namespace teren
