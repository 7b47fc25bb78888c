#include "apps/options/EditOptions.h"

#include <array>
#include <cstdio>
#include <cstdlib>

#include "apps/options/CommandLine.h"

namespace teren {
namespace {

/// Where programs keep what is a user's (XDG Base Directory Specification 0.8); relative ones do not count.
Result<std::filesystem::path> dataFolder() {
  const char* const chosen = std::getenv("XDG_DATA_HOME");
  if (chosen != nullptr && std::filesystem::path(chosen).is_absolute())
    return std::filesystem::path(chosen) / "teren";
  const char* const home = std::getenv("HOME");
  if (home != nullptr && std::filesystem::path(home).is_absolute()) {
    return std::filesystem::path(home) / ".local" / "share" / "teren";
  }
  return Error{
      "there is no folder for the edits of a world without a file (neither XDG_DATA_HOME nor HOME names "
      "one), name a file with --edits"};
}

}  // namespace

EditOptions::EditOptions(CLI::App& application, const std::string& otherwise) {
  const std::string doc = "the file that keeps the world's edits " + otherwise;
  edits_ = application.add_option("--edits", doc)->type_name("FILE")->group("World");
}

Result<std::filesystem::path> EditOptions::named() const {
  if (argument(*edits_).empty()) return Error{"--edits is \"\" but must name a file"};
  return std::filesystem::path(argument(*edits_));
}

Result<std::filesystem::path> EditOptions::file(const WorldOptions& options, const World& world) const {
  if (given()) return named();
  if (const auto description = options.file())
    return std::filesystem::path(*description).replace_extension(".edits");
  const Result<std::filesystem::path> folder = dataFolder();
  if (!folder) return folder.error();
  std::array<char, 17> digits{};
  std::snprintf(digits.data(), digits.size(), "%016llx",
                static_cast<unsigned long long>(world.descriptionHash()));
  return *folder / (std::string(digits.data()) + ".edits");
}

}  // namespace teren
