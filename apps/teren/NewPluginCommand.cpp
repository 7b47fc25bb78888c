// teren new-plugin ID [--kind generator|filter|deformer]: writes a small project for a plugin of one's own.
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <system_error>

#include "teren/PluginRegistry.h"
#include "teren/Quote.h"

#include "apps/files/OutputFile.h"
#include "apps/teren/Command.h"
#include "apps/teren/Interruption.h"
#include "apps/teren/PluginProject.h"

namespace teren {
namespace {

namespace fs = std::filesystem;

Result<void> write(const fs::path& path, const std::string& text) {
  Result<OutputFile> file = OutputFile::create(path);
  if (!file) return file.error();
  if (std::fwrite(text.data(), 1, text.size(), file->stream()) != text.size()) {
    return Error{inQuotes(path.string()) + " cannot be written"};
  }
  return file->commit();
}

std::optional<PluginKind> kindOf(const std::string& name) {
  for (const PluginKind kind : {PluginKind::generator, PluginKind::filter, PluginKind::deformer}) {
    if (name == kindName(kind)) return kind;
  }
  return std::nullopt;
}

class NewPluginCommand final : public Command {
 public:
  explicit NewPluginCommand(CLI::App& parent)
      : Command(parent, "new-plugin",
                "write a small project for a plugin of your own, in the folder teren-ID") {
    id_ = application().add_option("ID", "lower-case letters, digits and '-'");
    kind_ = application().add_option("--kind", "generator, filter or deformer [generator]");
  }

  ExitCode run() override {
    if (id_->count() == 0) return fail(kWrongInput, "new-plugin: the plugin's ID is missing");
    const std::string id = argument(*id_), kind = kind_->count() > 0 ? argument(*kind_) : "generator";
    if (!isPluginId(id)) {
      return fail(kWrongInput, "new-plugin: the ID is " + inQuotes(id) +
                                   ", expected lower-case letters, digits and '-', 1 to 64 of them");
    }
    const std::optional<PluginKind> wanted = kindOf(kind);
    if (!wanted) {
      return fail(kWrongInput, "--kind is " + inQuotes(kind) + ", expected generator, filter or deformer");
    }
    const std::shared_ptr<const PluginRegistry> registry = PluginRegistry::standard();
    if (const PluginInfo* other = registry->find(id); other != nullptr) {
      return fail(kWrongInput, "there is a plugin " + inQuotes(id) + " already, " + other->file.string() +
                                   "; yours would take its place in every world that uses it, so choose "
                                   "another ID");
    }
    const fs::path folder = "teren-" + id;
    std::error_code problem;
    if (!fs::create_directory(folder, problem)) {
      return problem ? fail(kWorkFailed, "the folder " + inQuotes(folder.string()) +
                                             " cannot be made: " + problem.message())
                     : fail(kWrongInput,
                            "there is a " + inQuotes(folder.string()) + " already, and it is left alone");
    }
    return writeInto(folder, *wanted, id);
  }

 private:
  ExitCode writeInto(const fs::path& folder, PluginKind kind, const std::string& id) const {
    const Interruption interruption;  // Ctrl-C waits for the last file: a moment
    for (const ProjectFile& file : pluginProject(kind, id)) {
      const Result<void> written = write(folder / file.name, file.text);
      if (written) continue;
      std::error_code ignored;
      fs::remove_all(folder, ignored);  // made above, and nothing half is left
      return fail(kWorkFailed, written.error().message);
    }
    std::cout << "wrote " << folder.string() << "; its README.md says how to build and see it\n";
    return kSuccess;
  }

  const CLI::Option* id_;
  const CLI::Option* kind_;
};

}  // namespace

std::unique_ptr<Command> makeNewPluginCommand(CLI::App& parent) {
  return std::make_unique<NewPluginCommand>(parent);
}

}  // namespace teren
