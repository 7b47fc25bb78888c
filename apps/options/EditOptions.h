// The option with which programs name the file that keeps a world's edits: --edits FILE.
#pragma once

#include <filesystem>
#include <string>

#include <CLI/CLI.hpp>

#include "teren/Result.h"
#include "teren/World.h"

#include "apps/options/WorldOptions.h"

namespace teren {

/// Belongs to one application or subcommand, which must live as long as it.
class EditOptions {
 public:
  /// `otherwise` says in the help what is meant where no file is named.
  EditOptions(CLI::App& application, const std::string& otherwise);

  bool given() const { return edits_->count() > 0; }
  /// The file that was named; it is given.
  Result<std::filesystem::path> named() const;
  /// The file that was named, else the world's own: beside its description, whose name then ends in .edits
  /// (land.json: land.edits), or for a world without a file in the user's data folder, under the world's
  /// hash. Errors: a name that is empty; no data folder, because neither XDG_DATA_HOME nor HOME is set.
  Result<std::filesystem::path> file(const WorldOptions& options, const World& world) const;

 private:
  const CLI::Option* edits_ = nullptr;
};

}  // namespace teren
