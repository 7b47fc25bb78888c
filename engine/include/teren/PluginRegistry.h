// Finds, checks and loads plugin modules, and makes generators, filters and deformers by id.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "teren/Deformer.h"
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

/// How a module gets from its file into memory.
enum class ModuleLoading {
  /// As libraries do: debuggers find its symbols; who overwrites the file changes the running code. A module
  /// with symbols that the loader would mix with those of other modules (g++ without -fvisibility=hidden) is
  /// copied all the same.
  mapped,
  /// From a copy in memory: the file may be overwritten or removed while the module is in use.
  copied,
};

struct Module;

/// The plugins a program can use. Immutable once made, so it may be shared by any threads.
class PluginRegistry {
 public:
  /// Looks for files named teren-<id>.so in each folder in order; the first of two equal ids wins and the
  /// other is reported as refused. A folder that does not exist is passed over; inside a folder the files are
  /// taken in the order of their names. Loading runs the modules' static initialisers.
  static std::shared_ptr<const PluginRegistry> load(std::span<const std::filesystem::path> folders,
                                                    ModuleLoading loading = ModuleLoading::mapped);

  /// The same folders as they are now. Modules whose files still hold the same bytes are shared with this
  /// registry; changed and new ones are loaded from copies, beside what is loaded. Nothing that this registry
  /// made changes: make the world anew with the new one to see the difference. Each change costs the memory
  /// of one more module (some 100 KiB) and a file descriptor until the process ends. Error: the file of a
  /// plugin that this registry has is refused now. A plugin whose file is gone is gone, and no error.
  Result<std::shared_ptr<const PluginRegistry>> reloaded() const;

  /// The ids, sorted, of plugins that `before` has not, has no longer, or has from another module.
  std::vector<std::string> changedSince(const PluginRegistry& before) const;

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
  /// The same of a deformer, which has no values: those of its stamps are checked stamp by stamp, against
  /// `find(id)->parameters`.
  Result<std::shared_ptr<const Deformer>> makeDeformer(std::string_view id) const;

 private:
  PluginRegistry() = default;
  /// Modules of `before` are taken over where their files are the same.
  void loadFolders(ModuleLoading loading, const PluginRegistry* before);
  void loadFolder(const std::filesystem::path& folder, ModuleLoading loading, const PluginRegistry* before);
  void loadFile(const std::filesystem::path& file, ModuleLoading loading, const PluginRegistry* before);
  /// nullptr where no plugin has this id.
  std::shared_ptr<const Module> module(std::string_view id) const noexcept;
  const RefusedModule* refusal(std::string_view id) const noexcept;
  /// The module of the plugin with this id and kind, or why there is none.
  Result<std::shared_ptr<const Module>> moduleOf(std::string_view id, PluginKind kind) const;

  std::vector<std::filesystem::path> folders_;
  std::vector<PluginInfo> plugins_;
  std::vector<std::shared_ptr<const Module>> modules_;  // parallel to plugins_, both sorted by id
  std::vector<RefusedModule> refused_;
};

}  // namespace teren
