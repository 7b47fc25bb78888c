#include "teren/PluginRegistry.h"

#include <algorithm>
#include <cstdlib>
#include <dlfcn.h>
#include <exception>
#include <system_error>
#include <utility>

#include "teren/Quote.h"

#include "plugin/Module.h"
#include "plugin/Thrown.h"

namespace teren {
namespace {

namespace fs = std::filesystem;

/// The most bytes of a plugin's own sentence.
constexpr std::size_t kSentenceBytes = 400;

/// Only its address matters: it lies in the engine's shared library.
const char kOwnAddress = 0;

/// The folder of the shared library this code is in; empty where the loader does not know.
fs::path libraryFolder() {
  Dl_info info{};
  if (dladdr(&kOwnAddress, &info) == 0 || info.dli_fname == nullptr) return {};
  std::error_code error;
  const fs::path library = fs::canonical(info.dli_fname, error);
  return error ? fs::path() : library.parent_path();
}

/// Files named teren-*.so, sorted by name; directories and odd files included, so that they are reported.
Result<std::vector<fs::path>> moduleFiles(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  fs::directory_iterator entry(folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    if (!pluginIdFromFile(entry->path()).empty()) files.push_back(entry->path());
  }
  if (error) return Error{"the folder cannot be read: " + shortened(error.message())};
  std::sort(files.begin(), files.end());
  return files;
}

/// Calls a plugin's maker; what it throws becomes a sentence. A maker without parameters is a deformer's.
template <class Base, class... Argument>
Result<std::shared_ptr<const Base>> callMaker(std::string_view id,
                                              std::unique_ptr<Base> (*make)(const Argument&...),
                                              const Argument&... argument) {
  constexpr bool hasValues = sizeof...(Argument) > 0;
  const std::string refuses =
      "plugin " + inQuotes(id) + (hasValues ? " refuses its parameters" : " refuses to be made");
  try {
    std::shared_ptr<const Base> made = make(argument...);
    if (made != nullptr) return made;
    return Error{"plugin " + inQuotes(id) + " made nothing" + (hasValues ? " of its parameters" : "")};
  } catch (const std::exception& exception) {
    return Error{refuses + ": " + shortened(textOf(exception), kSentenceBytes)};
  } catch (...) {
    return Error{refuses + " without saying why"};
  }
}

}  // namespace

bool isPluginId(std::string_view id) noexcept {
  return !id.empty() && id.size() <= kLongestPluginId && std::all_of(id.begin(), id.end(), [](char c) {
    return ('a' <= c && c <= 'z') || ('0' <= c && c <= '9') || c == '-';
  });
}

std::shared_ptr<const PluginRegistry> PluginRegistry::load(std::span<const fs::path> folders,
                                                           ModuleLoading loading) {
  const std::shared_ptr<PluginRegistry> registry(new PluginRegistry);
  registry->folders_.assign(folders.begin(), folders.end());
  registry->loadFolders(loading, nullptr);
  return registry;
}

Result<std::shared_ptr<const PluginRegistry>> PluginRegistry::reloaded() const {
  const std::shared_ptr<PluginRegistry> registry(new PluginRegistry);
  registry->folders_ = folders_;
  registry->loadFolders(ModuleLoading::copied, this);
  for (const PluginInfo& plugin : plugins_) {
    const RefusedModule* refused = registry->find(plugin.id) ? nullptr : registry->refusal(plugin.id);
    if (refused == nullptr) continue;
    return Error{shortened(refused->file.string(), kSentenceBytes) + " was refused: " + refused->reason};
  }
  return std::shared_ptr<const PluginRegistry>(registry);
}

std::vector<std::string> PluginRegistry::changedSince(const PluginRegistry& before) const {
  std::vector<std::string> changed;
  for (const PluginInfo& plugin : plugins_) {
    if (module(plugin.id) != before.module(plugin.id)) changed.push_back(plugin.id);
  }
  for (const PluginInfo& plugin : before.plugins_) {
    if (find(plugin.id) == nullptr) changed.push_back(plugin.id);
  }
  std::sort(changed.begin(), changed.end());
  return changed;
}

void PluginRegistry::loadFolders(ModuleLoading loading, const PluginRegistry* before) {
  std::vector<fs::path> visited;
  for (const fs::path& folder : folders_) {
    std::error_code error;
    const fs::path real = fs::canonical(folder, error);
    if (error == std::errc::no_such_file_or_directory) continue;
    // The same folder by two names is no reason to report all its plugins as duplicates.
    if (std::find(visited.begin(), visited.end(), real) != visited.end()) continue;
    if (!error) visited.push_back(real);
    loadFolder(folder, loading, before);
  }
}

std::vector<fs::path> PluginRegistry::searchPath() {
  std::vector<fs::path> folders;
  if (const char* variable = std::getenv("TEREN_PLUGIN_PATH"); variable != nullptr) {
    std::string_view rest = variable;
    while (!rest.empty()) {
      const std::string_view folder = rest.substr(0, rest.find(':'));
      if (!folder.empty()) folders.emplace_back(folder);
      rest.remove_prefix(std::min(rest.size(), folder.size() + 1));
    }
  }
  const fs::path beside = libraryFolder();
  if (!beside.empty()) folders.push_back(beside / "teren" / "plugins");
  folders.emplace_back(TEREN_INSTALL_PLUGIN_DIRECTORY);
  return folders;
}

std::shared_ptr<const PluginRegistry> PluginRegistry::standard() {
  static const std::shared_ptr<const PluginRegistry> registry = load(searchPath());
  return registry;
}

void PluginRegistry::loadFolder(const fs::path& folder, ModuleLoading loading, const PluginRegistry* before) {
  const Result<std::vector<fs::path>> files = moduleFiles(folder);
  if (!files) {
    refused_.push_back({folder, files.error().message});
    return;
  }
  for (const fs::path& file : files.value()) loadFile(file, loading, before);
}

void PluginRegistry::loadFile(const fs::path& file, ModuleLoading loading, const PluginRegistry* before) {
  // A module's id is its file's name, so a second one of the same id need not be opened to be known.
  const std::string id = pluginIdFromFile(file);
  if (const PluginInfo* first = find(id); first != nullptr) {
    refused_.push_back({file, "the plugin " + inQuotes(id) + " was already found as " +
                                  shortened(first->file.string(), kSentenceBytes)});
    return;
  }
  Result<std::shared_ptr<const Module>> module =
      openModule(file, loading, before == nullptr ? nullptr : before->module(id));
  if (!module) {
    refused_.push_back({file, module.error().message});
    return;
  }
  const PluginDescription& found = *(*module)->description;
  const auto place =
      std::lower_bound(plugins_.begin(), plugins_.end(), id,
                       [](const PluginInfo& info, const std::string& name) { return info.id < name; });
  const auto parameters = (*module)->parameters;
  modules_.insert(modules_.begin() + (place - plugins_.begin()), std::move(*module));
  plugins_.insert(place, {id, found.kind, shortened(found.version), shortened(found.doc, kSentenceBytes),
                          file, parameters});
}

std::shared_ptr<const PluginRegistry> PluginRegistry::loadModule(const fs::path& file) {
  const std::shared_ptr<PluginRegistry> registry(new PluginRegistry);
  registry->loadFile(file, ModuleLoading::mapped, nullptr);
  return registry;
}

const PluginInfo* PluginRegistry::find(std::string_view id) const noexcept {
  const auto found =
      std::find_if(plugins_.begin(), plugins_.end(), [id](const PluginInfo& info) { return info.id == id; });
  return found == plugins_.end() ? nullptr : &*found;
}

std::shared_ptr<const Module> PluginRegistry::module(std::string_view id) const noexcept {
  const PluginInfo* info = find(id);
  return info == nullptr ? nullptr : modules_[static_cast<std::size_t>(info - plugins_.data())];
}

const RefusedModule* PluginRegistry::refusal(std::string_view id) const noexcept {
  const auto found = std::find_if(refused_.begin(), refused_.end(), [id](const RefusedModule& module) {
    return pluginIdFromFile(module.file) == id;
  });
  return found == refused_.end() ? nullptr : &*found;
}

Result<std::shared_ptr<const Module>> PluginRegistry::moduleOf(std::string_view id, PluginKind kind) const {
  const PluginInfo* info = find(id);
  if (info != nullptr && info->kind == kind) return module(id);
  std::string known;
  for (const PluginInfo& plugin : plugins_) {
    if (plugin.kind == kind) known += (known.empty() ? "" : ", ") + plugin.id;
  }
  const std::string list =
      known.empty() ? "; there are none" : "; there are " + shortened(known, kSentenceBytes);
  if (info != nullptr) {
    return Error{"plugin " + inQuotes(id) + " is a " + kindName(info->kind) + ", not a " + kindName(kind) +
                 list};
  }
  if (const RefusedModule* refused = refusal(id); refused != nullptr) {
    return Error{"no " + std::string(kindName(kind)) + " has the id " + inQuotes(id) + ", because " +
                 shortened(refused->file.string(), kSentenceBytes) + " was refused: " + refused->reason};
  }
  return Error{std::string("no ") + kindName(kind) + " has the id " + inQuotes(id) + list};
}

Result<std::shared_ptr<const Generator>> PluginRegistry::makeGenerator(
    std::string_view id, std::span<const Values::Entry> entries) const {
  const Result<std::shared_ptr<const Module>> module = moduleOf(id, PluginKind::generator);
  if (!module) return module.error();
  const Result<Values> values = Values::check((*module)->parameters, entries, id);
  if (!values) return values.error();
  return callMaker(id, (*module)->description->makeGenerator, *values);
}

Result<std::shared_ptr<const Filter>> PluginRegistry::makeFilter(
    std::string_view id, std::span<const Values::Entry> entries) const {
  const Result<std::shared_ptr<const Module>> module = moduleOf(id, PluginKind::filter);
  if (!module) return module.error();
  const Result<Values> values = Values::check((*module)->parameters, entries, id);
  if (!values) return values.error();
  return callMaker(id, (*module)->description->makeFilter, *values);
}

Result<std::shared_ptr<const Deformer>> PluginRegistry::makeDeformer(std::string_view id) const {
  const Result<std::shared_ptr<const Module>> module = moduleOf(id, PluginKind::deformer);
  if (!module) return module.error();
  return callMaker(id, (*module)->description->makeDeformer);
}

}  // namespace teren
