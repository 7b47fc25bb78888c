// teren plugins [--json]: what was found on the search path, and what was refused.
#include <iostream>

#include <nlohmann/json.hpp>

#include "apps/teren/Command.h"
#include "apps/teren/JsonOutput.h"

namespace teren {
namespace {

class PluginsCommand final : public Command {
 public:
  explicit PluginsCommand(CLI::App& parent)
      : Command(parent, "plugins", "list the plugins that were found, and the modules that were refused"),
        json_(addJson()) {}

  ExitCode run() override {
    const auto registry = PluginRegistry::standard();
    if (json_->count() > 0) {
      printJson(asJson(*registry));
    } else {
      printText(*registry);
    }
    return kSuccess;
  }

 private:
  static OrderedJson asJson(const PluginRegistry& registry) {
    OrderedJson answer = {{"plugins", OrderedJson::array()}, {"refused", OrderedJson::array()}};
    for (const PluginInfo& plugin : registry.plugins()) {
      answer["plugins"].push_back({{"id", plugin.id},
                                   {"kind", kindName(plugin.kind)},
                                   {"version", plugin.version},
                                   {"file", plugin.file.string()},
                                   {"doc", plugin.doc}});
    }
    for (const RefusedModule& module : registry.refused()) {
      answer["refused"].push_back({{"file", module.file.string()}, {"reason", module.reason}});
    }
    return answer;
  }

  static void printText(const PluginRegistry& registry) {
    if (registry.plugins().empty()) std::cout << "no plugins were found\n";
    for (const PluginInfo& plugin : registry.plugins()) {
      std::cout << plugin.id << " (" << kindName(plugin.kind) << ", version " << plugin.version
                << "): " << plugin.doc << "\n  " << plugin.file.string() << "\n";
    }
    for (const RefusedModule& module : registry.refused()) {
      std::cout << "refused: " << module.reason << "\n  " << module.file.string() << "\n";
    }
  }

  const CLI::Option* json_;
};

}  // namespace

std::unique_ptr<Command> makePluginsCommand(CLI::App& parent) {
  return std::make_unique<PluginsCommand>(parent);
}

}  // namespace teren
