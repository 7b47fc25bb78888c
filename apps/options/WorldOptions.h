// The options with which every program names its world:
//   WORLD = --world FILE | --generator ID [--set NAME=VALUE]... [--pitch M] [--samples W]
//           [--blend linear|smooth]; all take [--seed N]; nothing: the world shipped with Teren.
#pragma once

#include <filesystem>
#include <optional>

#include <CLI/CLI.hpp>

#include "teren/PluginRegistry.h"
#include "teren/Result.h"
#include "teren/World.h"

namespace teren {

/// Belongs to one application or subcommand, which must live as long as it.
class WorldOptions {
 public:
  explicit WorldOptions(CLI::App& application);

  /// After parsing: the world that was asked for. Errors are of the kind kWrongInput: a file that cannot be
  /// read or understood, an unknown generator, a bad parameter or number, options that exclude each other.
  /// What remains to be checked (pitches, samples), World::create checks.
  Result<WorldDescription> resolve(const PluginRegistry& registry) const;

  /// The same, made.
  Result<std::shared_ptr<const World>> create(const PluginRegistry& registry) const;

  /// The description's file, where --world names one.
  std::optional<std::filesystem::path> file() const;

 private:
  Result<WorldDescription> base(const PluginRegistry& registry) const;
  Result<WorldDescription> fromGenerator(const PluginRegistry& registry) const;

  const CLI::Option* world_;
  const CLI::Option* generator_;
  const CLI::Option* set_;
  const CLI::Option* pitch_;
  const CLI::Option* samples_;
  const CLI::Option* blend_;
  const CLI::Option* seed_;
};

}  // namespace teren
