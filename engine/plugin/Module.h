// Opens one module file and checks everything it says about itself before the engine believes it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "teren/Parameter.h"
#include "teren/Plugin.h"
#include "teren/PluginRegistry.h"
#include "teren/Result.h"

namespace teren {

/// An accepted module: it stays loaded until the process ends, so the description and the table may be read
/// by any thread at any time.
struct Module {
  const PluginDescription* description = nullptr;
  std::span<const Parameter> parameters;
  std::uint64_t contents = 0;  ///< hash of the file it was loaded from
};

/// The id in a file name teren-<id>.so; empty where the name has not that form (the id itself is not
/// checked).
std::string pluginIdFromFile(const std::filesystem::path& file);

/// Loads the file, which runs its static initialisers, and checks its description and table; where it still
/// holds the same bytes as `before`, that is the answer. The sentence of a refusal does not repeat the file's
/// name. What is refused is unloaded again. A static initialiser that throws or crashes ends the process: the
/// loader lets nobody catch that. One thread at a time.
Result<std::shared_ptr<const Module>> openModule(const std::filesystem::path& file, ModuleLoading loading,
                                                 const std::shared_ptr<const Module>& before = nullptr);

/// Every word that differs between `module` and the engine, or is known to one side only, by name and with
/// both values; success where there is none.
Result<void> compareAbiWords(std::span<const AbiWord> module, std::span<const AbiWord> engine);

}  // namespace teren
