// teren check FILE.so [--property NAME] [--quick] [--limit S] [--json]: puts a module to the contract of
// plugins, each property in a process of its own.
#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <iostream>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "teren/PluginRegistry.h"
#include "teren/Quote.h"

#include "apps/check/Property.h"
#include "apps/check/Subject.h"
#include "apps/teren/CheckProcess.h"
#include "apps/teren/Command.h"
#include "apps/teren/Interruption.h"
#include "apps/teren/JsonOutput.h"
#include "apps/teren/ProgressLine.h"

namespace teren {
namespace {

using check::Effort;
using check::Property;

/// The first thing asked of a module: the engine's own checks at the door.
constexpr const char* kLoading = "loading";
constexpr const char* kLoadingDemand =
    "The engine takes the module: it is built for this one and describes itself well.";
constexpr std::array<const char*, 3> kFacts = {"id", "kind", "version"};  // of the module, told with it
constexpr double kUsualLimit = 60.0;                                      // [s]
constexpr std::size_t kNameColumn = 14;

class CheckCommand final : public Command {
 public:
  explicit CheckCommand(CLI::App& parent)
      : Command(parent, "check",
                "put a plugin's module to the contract of plugins, each property in a process of its own"),
        file_(application().add_option("FILE", "the module, teren-<id>.so")->required()),
        property_(application().add_option("--property", "this property alone")->type_name("NAME")),
        quick_(addFlag("--quick", "fewer seeds, and less time for settings that make it slow")),
        limit_(application()
                   .add_option("--limit",
                               "processor time for a property in seconds, and ten times as much to wait [60]")
                   ->type_name("S")),
        answer_(application().add_option("--answer", "")->group("")),
        json_(addJson()) {}

  ExitCode run() override {
    if (const auto wrong = wrongInput()) return fail(kWrongInput, *wrong);
    if (answer_->count() > 0) return answerAlone();
    const Interruption interruption;
    interruption_ = &interruption;
    std::vector<std::string> names = {kLoading};
    bool all = true;
    for (done_ = 0; done_ < names.size(); ++done_) {
      wanted_ = names.size();
      const OrderedJson answer = ask(names[done_]);
      if (interruption.came()) return fail(kWorkFailed, "interrupted, the check was not completed");
      const bool holds = answer["holds"];
      all = all && holds;
      const bool isLoaded = names[done_] == kLoading && holds;
      // What is demanded depends on what the module is, so it is known only now.
      if (isLoaded) kind_ = kindOf(answer.value("kind", ""));
      if (isLoaded && !isKnown(kind_)) return fail(kWrongInput, unknownProperty({kind_}));
      tell(answer);
      if (isLoaded) appendWanted(names);
    }
    tellEnd(all);
    return all ? kSuccess : kWorkFailed;
  }

 private:
  std::optional<std::string> wrongInput() {
    std::error_code error;
    if (!std::filesystem::exists(argument(*file_), error))
      return "there is no file " + inQuotes(argument(*file_));
    if (limit_->count() > 0) {
      const Result<double> seconds = numberArgument("--limit", argument(*limit_), 0.05, 86400.0);
      if (!seconds) return seconds.error().message;
      seconds_ = *seconds;
    }
    if (answer_->count() > 0 && property_->count() == 0) return "--answer needs --property";
    if (isKnown(PluginKind::generator) || isKnown(PluginKind::deformer)) return std::nullopt;
    return unknownProperty({PluginKind::generator, PluginKind::deformer});
  }

  static PluginKind kindOf(const std::string& name) {
    for (const PluginKind kind : {PluginKind::filter, PluginKind::deformer}) {
      if (name == kindName(kind)) return kind;
    }
    return PluginKind::generator;
  }

  /// Whether plugins of this kind have the property that is asked for, if one is.
  bool isKnown(PluginKind kind) const {
    const std::string name = argument(*property_);
    return property_->count() == 0 || name == kLoading || check::findProperty(kind, name) != nullptr;
  }

  std::string unknownProperty(std::initializer_list<PluginKind> kinds) const {
    std::string sentence = "--property is " + inQuotes(argument(*property_)) + " but must be " + kLoading;
    for (const PluginKind kind : kinds) {
      if (kind == PluginKind::deformer) sentence += ", or of a deformer";
      const char* between = kind == PluginKind::deformer ? " " : ", ";
      for (const Property* property : check::contract(kind)) {
        sentence += between + std::string(property->name());
        between = ", ";
      }
    }
    return sentence;
  }

  void appendWanted(std::vector<std::string>& names) const {
    for (const Property* property : check::contract(kind_)) {
      if (property_->count() == 0 || argument(*property_) == property->name())
        names.emplace_back(property->name());
    }
  }

  const CLI::Option* addFlag(const std::string& name, const std::string& doc) {
    return application().add_flag(name, doc)->disable_flag_override();
  }

  // --- In the process of one property
  // ---------------------------------------------------------------------------

  ExitCode answerAlone() const {
    const Result<std::int64_t> pipe = wholeArgument("--answer", argument(*answer_), 3, 1 << 20);
    if (!pipe) return fail(kWrongInput, pipe.error().message);
    const auto registry = PluginRegistry::loadModule(argument(*file_));
    const std::string answer = answerOf(registry).dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
    if (writeCheckAnswer(static_cast<int>(*pipe), answer)) return kSuccess;
    return fail(kWorkFailed, "the answer cannot be written");
  }

  OrderedJson answerOf(const std::shared_ptr<const PluginRegistry>& registry) const {
    if (registry->plugins().empty()) return {{"holds", false}, {"text", registry->refused().front().reason}};
    const PluginInfo& info = registry->plugins().front();
    if (argument(*property_) == kLoading) {
      return {{"holds", true},
              {"text", info.doc},
              {"id", info.id},
              {"kind", kindName(info.kind)},
              {"version", info.version}};
    }
    const check::Subject subject(registry, info.id);
    const Property* const property = check::findProperty(info.kind, argument(*property_));
    if (property == nullptr) return {{"holds", false}, {"text", "it is of a kind without this property"}};
    const check::Finding finding =
        property->check(subject, quick_->count() > 0 ? Effort::quick() : Effort::full());
    return {{"holds", finding.holds}, {"text", finding.text}};
  }

  // --- In the process that asks
  // ---------------------------------------------------------------------------------

  OrderedJson ask(const std::string& name) const {
    std::vector<std::string> arguments = {"check", argument(*file_), "--property", name};
    if (quick_->count() > 0) arguments.emplace_back("--quick");
    ProgressLine line("properties");
    const Result<std::string> said = runCheckProcess(arguments, CheckLimit(seconds_), [&] {
      line.show(done_, wanted_);
      return !interruption_->came();
    });
    OrderedJson answer = {{"name", name}, {"demand", demandOf(name)}};
    const OrderedJson read = said ? OrderedJson::parse(*said, nullptr, false) : OrderedJson();
    if (!read.is_object() || !read.value("holds", OrderedJson()).is_boolean() ||
        !read.value("text", OrderedJson()).is_string()) {
      answer["holds"] = false;
      answer["text"] = said ? "its process ended without an answer" : said.error().message;
      return answer;
    }
    answer["holds"] = read["holds"];
    answer["text"] = read["text"];
    for (const char* key : kFacts) {
      if (read.value(key, OrderedJson()).is_string()) answer[key] = read[key];
    }
    return answer;
  }

  std::string demandOf(const std::string& name) const {
    const Property* const property = check::findProperty(kind_, name);
    return property == nullptr ? kLoadingDemand : std::string(property->demand());
  }

  void tell(const OrderedJson& answer) {
    const std::string name = answer["name"];
    const bool holds = answer["holds"];
    if (name == kLoading) {
      for (const char* key : kFacts) report_[key] = answer.contains(key) ? answer[key] : nullptr;
    }
    report_["properties"].push_back(
        {{"name", name}, {"demand", answer["demand"]}, {"holds", holds}, {"text", answer["text"]}});
    failures_ += holds ? 0 : 1;
    if (json_->count() > 0) return;
    const std::string text = shortened(std::string(answer["text"]), 1000);
    std::cout << (holds ? "pass  " : "FAIL  ") << name
              << std::string(kNameColumn - std::min(kNameColumn, name.size()), ' ') << text << std::endl;
  }

  void tellEnd(bool holds) {
    if (json_->count() > 0) {
      OrderedJson report = {{"file", argument(*file_)}};
      report.update(report_);
      report["holds"] = holds;
      printJson(report);
      return;
    }
    const std::size_t count = report_["properties"].size();
    if (holds) {
      std::cout << "it keeps the contract: " << count << " properties hold\n";
    } else {
      std::cout << "it breaks the contract: " << failures_ << " of " << count << " properties "
                << (failures_ == 1 ? "does" : "do") << " not hold\n";
    }
  }

  const CLI::Option* file_;
  const CLI::Option* property_;
  const CLI::Option* quick_;
  const CLI::Option* limit_;
  const CLI::Option* answer_;
  const CLI::Option* json_;
  double seconds_ = kUsualLimit;
  const Interruption* interruption_ = nullptr;
  OrderedJson report_ = OrderedJson::object();
  PluginKind kind_ = PluginKind::generator;  // of the module, once it is loaded
  std::size_t wanted_ = 0, done_ = 0, failures_ = 0;
};

}  // namespace

std::unique_ptr<Command> makeCheckCommand(CLI::App& parent) {
  return std::make_unique<CheckCommand>(parent);
}

}  // namespace teren
