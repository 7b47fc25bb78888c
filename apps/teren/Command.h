// One subcommand of `teren`: adds its options to the command line and, if it is the one chosen, does its
// work.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>

#include <CLI/CLI.hpp>

#include "teren/PluginRegistry.h"
#include "teren/World.h"

#include "apps/options/CommandLine.h"

namespace teren {

class Command {
 public:
  virtual ~Command() = default;

  /// True once parsing has chosen this subcommand.
  bool chosen() const { return application_->parsed(); }
  /// Called once, after parsing. Answers go to standard output, one sentence about what went wrong to
  /// standard error.
  virtual ExitCode run() = 0;

 protected:
  Command(CLI::App& parent, const std::string& name, const std::string& doc)
      : parent_(&parent), application_(parent.add_subcommand(name, doc)) {}

  CLI::App& application() { return *application_; }
  const CLI::Option* addJson() {
    const std::string doc = "answer in JSON";
    return application_->add_flag("--json", doc)->disable_flag_override();
  }
  ExitCode fail(ExitCode code, std::string_view sentence) const {
    return teren::fail(*parent_, code, sentence);
  }
  /// What the plugins did wrong on the way, after work that was done all the same.
  void complainAbout(const World& world) const {
    for (const std::string& message : world.takeMessages()) complain(*parent_, message);
  }
  /// Where a plugin failed, so that what was made is not the landscape described: what does not happen now,
  /// and why, in one sentence.
  std::optional<ExitCode> failWith(const World& world, const std::string& consequence) const {
    const std::optional<std::string> cause = world.failure();
    if (!cause) return std::nullopt;
    return fail(kWorkFailed, consequence + ": " + *cause);
  }

 private:
  CLI::App* parent_;
  CLI::App* application_;
};

std::unique_ptr<Command> makePluginsCommand(CLI::App& parent);
std::unique_ptr<Command> makeDescribeCommand(CLI::App& parent);
std::unique_ptr<Command> makeBakeCommand(CLI::App& parent);
std::unique_ptr<Command> makeQueryCommand(CLI::App& parent);
std::unique_ptr<Command> makeEditsCommand(CLI::App& parent);
std::unique_ptr<Command> makeFlightCommand(CLI::App& parent);
std::unique_ptr<Command> makeNewPluginCommand(CLI::App& parent);
std::unique_ptr<Command> makeCheckCommand(CLI::App& parent);
std::unique_ptr<Command> makeSandCommand(CLI::App& parent);
std::unique_ptr<Command> makeReportCommand(CLI::App& parent);

}  // namespace teren
