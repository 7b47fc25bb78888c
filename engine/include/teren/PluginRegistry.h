// Finds, checks and loads plugin modules, and makes generators and filters by id.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "teren/Filter.h"
#include "teren/Generator.h"
#include "teren/Parameter.h"
#include "teren/Plugin.h"
#include "teren/Result.h"

namespace teren {

/// Whether a plugin may have this id: lower-case letters, digits and '-', at least one, at most
/// kLongestPluginId.
bool isPluginId(std::string_view id) noexcept;
inline constexpr std::size_t kLongestPluginId = 64;

/// A loaded plugin. The texts and the table live as long as the process: modules are never unloaded.
struct PluginInfo {
  std::string id;
  PluginKind kind = PluginKind::generator;
  std::string version;
  std::string doc;
  std::filesystem::path file;
  std::span<const Parameter> parameters;
};

/// A module that was found but not taken, and one sentence why.
struct RefusedModule {
  std::filesystem::path file;
  std::string reason;
};

/// The plugins a program can use. Immutable once made, so it may be shared by any threads.
class PluginRegistry {
 public:
  /// Looks for files named teren-<id>.so in each folder in order; the first of two equal ids wins and the
  /// other is reported as refused. A folder that does not exist is passed over; inside a folder the files are
  /// taken in the order of their names. Loading runs the modules' static initialisers.
  static std::shared_ptr<const PluginRegistry> load(std::span<const std::filesystem::path> folders);

  /// The folders of TEREN_PLUGIN_PATH (colon-separated), then the folder "teren/plugins" beside the engine's
  /// shared library (found by its own address, so a foreign program finds it too), then the install prefix.
  static std::vector<std::filesystem::path> searchPath();

  /// load(searchPath()), done once per process at the first call.
  static std::shared_ptr<const PluginRegistry> standard();

  std::span<const PluginInfo> plugins() const noexcept { return plugins_; }  ///< sorted by id
  std::span<const RefusedModule> refused() const noexcept { return refused_; }

  /// A registry of this one module, which need not lie on the search path; where it is refused, of none.
  static std::shared_ptr<const PluginRegistry> loadModule(const std::filesystem::path& file);

  /// nullptr where no plugin has this id.
  const PluginInfo* find(std::string_view id) const noexcept;

  /// Checks the entries against the plugin's table and makes it. Errors: unknown id (the sentence lists the
  /// known ones, or tells why its module was refused), an id of another kind, a bad value, a constructor that
  /// throws.
  Result<std::shared_ptr<const Generator>> makeGenerator(std::string_view id,
                                                         std::span<const Values::Entry> entries) const;
  Result<std::shared_ptr<const Filter>> makeFilter(std::string_view id,
                                                   std::span<const Values::Entry> entries) const;

 private:
  PluginRegistry() = default;
  void loadFolder(const std::filesystem::path& folder);
  void loadFile(const std::filesystem::path& file);
  /// The description of the plugin with this id and kind, or why there is none.
  Result<const PluginDescription*> describe(std::string_view id, PluginKind kind) const;

  std::vector<PluginInfo> plugins_;
  std::vector<const PluginDescription*> descriptions_;  // parallel to plugins_, both sorted by id
  std::vector<RefusedModule> refused_;
};

}  // namespace teren
