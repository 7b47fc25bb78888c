// Modules that change on disk while a program uses them.
#include <elf.h>
#include <iterator>
#include <string>
#include <sys/resource.h>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Hash.h"
#include "teren/PluginRegistry.h"

#include "ScratchFolder.h"
#include "plugin/SharedObject.h"

namespace teren {
namespace {

namespace fs = std::filesystem;
using Registry = std::shared_ptr<const PluginRegistry>;

const fs::path kModules = TEREN_TEST_MODULES;

std::size_t openFiles() {
  const fs::directory_iterator files("/proc/self/fd");
  return static_cast<std::size_t>(std::distance(begin(files), end(files)));
}

/// With modules whose symbols are "hidden" and "visible".
class PluginReload : public testing::TestWithParam<std::string> {
 protected:
  PluginReload() {
    fs::copy(kModules / "good" / "teren-flat.so", folder_ / "teren-flat.so");
    put(1);
  }

  Registry load(ModuleLoading loading) const {
    const std::vector<fs::path> folders = {folder_.path()};
    return PluginRegistry::load(folders, loading);
  }
  /// As a linker does: a new file takes the place of the old one.
  void put(int version) const {
    fs::copy(module(version), folder_ / "next");
    fs::rename(folder_ / "next", folder_ / "teren-land.so");
  }
  /// As cp does: the same file gets other bytes.
  void overwrite(int version) const { overwriteWith(module(version)); }
  void overwriteWith(const fs::path& module) const {
    fs::copy_file(module, folder_ / "teren-land.so", fs::copy_options::overwrite_existing);
  }
  static fs::path module(int version) {
    return kModules / (GetParam() + "-" + std::to_string(version)) / "teren-land.so";
  }
  static double heightOf(const Registry& registry) {
    const auto land = registry->makeGenerator("land", {});
    return land ? (*land)->range().mean : -1.0;
  }

  const ScratchFolder folder_;
};

TEST_P(PluginReload, TakesChangedModulesAnewAndSharesTheOthers) {
  for (const ModuleLoading loading : {ModuleLoading::mapped, ModuleLoading::copied}) {
    put(1);
    const Registry before = load(loading);
    const auto land = before->makeGenerator("land", {}).value();
    put(2);
    const Registry after = before->reloaded().value();
    EXPECT_EQ(after->changedSince(*before), std::vector<std::string>{"land"});
    EXPECT_EQ(after->find("flat")->parameters.data(), before->find("flat")->parameters.data());
    EXPECT_EQ(heightOf(after), 2.0);
    EXPECT_EQ(after->find("land")->version, "2");
    EXPECT_EQ(heightOf(before), 1.0) << "a registry does not change";
    EXPECT_EQ(land->range().mean, 1.0);
  }
}

TEST_P(PluginReload, ReadsTheTableOfTheNewVersionNotTheOldOne) {
  const Registry before = load(ModuleLoading::copied);
  put(2);
  const Registry after = before->reloaded().value();
  ASSERT_EQ(before->find("land")->parameters.size(), 1U);
  EXPECT_EQ(before->find("land")->parameters[0].name, "height");
  ASSERT_EQ(after->find("land")->parameters.size(), 2U);
  EXPECT_EQ(after->find("land")->parameters[0].name, "more");
}

TEST_P(PluginReload, KeepsModulesApartWhoseSymbolsHaveTheSameNames) {
  const ScratchFolder other;
  fs::copy(module(2), other / "teren-land.so");
  const Registry first = load(ModuleLoading::mapped);
  const std::vector<fs::path> folders = {other.path()};
  const Registry second = PluginRegistry::load(folders, ModuleLoading::mapped);
  EXPECT_EQ(second->find("land")->parameters.size(), 2U);
  EXPECT_EQ(heightOf(second), 2.0);
  EXPECT_EQ(heightOf(first), 1.0);
}

TEST_P(PluginReload, LeavesModulesAloneWhoseBytesAreTheSame) {
  const Registry before = load(ModuleLoading::mapped);
  put(1);  // rebuilt, to the same bytes
  const Registry after = before->reloaded().value();
  EXPECT_TRUE(after->changedSince(*before).empty());
  EXPECT_EQ(after->find("land")->parameters.data(), before->find("land")->parameters.data());
}

TEST_P(PluginReload, GoesOnWithCopiesWhoseFilesAreOverwritten) {
  const Registry before = load(ModuleLoading::copied);
  const auto land = before->makeGenerator("land", {}).value();
  overwrite(2);
  const Registry after = before->reloaded().value();
  overwrite(1);
  EXPECT_EQ(land->range().mean, 1.0);
  EXPECT_EQ(heightOf(before), 1.0);
  EXPECT_EQ(heightOf(after), 2.0);
  EXPECT_EQ(heightOf(after->reloaded().value()), 1.0);
}

TEST_P(PluginReload, FailsWithASentenceWhereAModuleIsRefusedNow) {
  const Registry before = load(ModuleLoading::copied);
  folder_.write("teren-land.so", fileBytes(module(2)).substr(0, 4000));
  const auto after = before->reloaded();
  ASSERT_FALSE(after.ok());
  EXPECT_EQ(after.error().message, (folder_ / "teren-land.so").string() +
                                       " was refused: it is cut short: its headers speak of more than the "
                                       "file holds");
  EXPECT_EQ(heightOf(before), 1.0);
  put(2);
  EXPECT_EQ(heightOf(before->reloaded().value()), 2.0) << "the next try";
}

TEST_P(PluginReload, FindsNewModulesAndMissesThoseThatAreGone) {
  fs::remove(folder_ / "teren-land.so");
  const Registry without = load(ModuleLoading::mapped);
  put(1);
  const Registry with = without->reloaded().value();
  EXPECT_EQ(with->changedSince(*without), std::vector<std::string>{"land"});
  EXPECT_EQ(heightOf(with), 1.0);
  fs::remove(folder_ / "teren-land.so");
  const Registry gone = with->reloaded().value();
  EXPECT_EQ(gone->changedSince(*with), std::vector<std::string>{"land"});
  EXPECT_EQ(gone->find("land"), nullptr);
  EXPECT_EQ(heightOf(with), 1.0);
}

TEST_P(PluginReload, ComesAndGoesHoweverOftenAndOpensNoMoreThanAFileEachTime) {
  Registry registry = load(ModuleLoading::copied);
  const std::size_t before = openFiles();
  for (int n = 0; n < 20; ++n) {
    overwrite(n % 2 == 0 ? 2 : 1);
    registry = registry->reloaded().value();
    ASSERT_EQ(heightOf(registry), n % 2 == 0 ? 2.0 : 1.0);
    ASSERT_TRUE(registry->reloaded()->get()->changedSince(*registry).empty());
  }
  EXPECT_LE(openFiles(), before + 20);
}

TEST_P(PluginReload, LeavesNothingOfWhatItRefuses) {
  const Registry registry = load(ModuleLoading::copied);
  const std::size_t before = openFiles();
  fs::copy_file(kModules / "broken" / "teren-wrong-magic.so", folder_ / "teren-wrong-magic.so");
  for (int n = 0; n < 5; ++n) EXPECT_EQ((*registry->reloaded())->refused().size(), 1U);
  EXPECT_EQ(openFiles(), before);
}

TEST_P(PluginReload, IsRefusedWhereTheProcessMayWriteNoFileOfThatSize) {
  const Registry registry = load(ModuleLoading::copied);
  put(2);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small = {5000, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const auto reloaded = registry->reloaded();
  setrlimit(RLIMIT_FSIZE, &before);
  ASSERT_FALSE(reloaded.ok());
  EXPECT_NE(reloaded.error().message.find("there is no room for a copy of it"), std::string::npos);
}

TEST_P(PluginReload, IsNotFooledByARefusedModuleThatCannotBeUnloaded) {
  overwriteWith(kModules / "stays" / "teren-land.so");
  EXPECT_EQ(load(ModuleLoading::copied)->refused().size(), 1U);
  overwrite(1);
  EXPECT_EQ(heightOf(load(ModuleLoading::copied)), 1.0);
}

INSTANTIATE_TEST_SUITE_P(Symbols, PluginReload, testing::Values("hidden", "visible"),
                         [](const auto& symbols) { return symbols.param; });

/// How many symbols of a module the loader would keep one of in the process.
int uniqueSymbols(const std::string& bytes) {
  std::string weak = bytes;
  makeUniqueSymbolsWeak(weak);
  int changed = 0;
  for (std::size_t n = 0; n < bytes.size(); ++n) changed += bytes[n] != weak[n];
  return changed;
}

TEST(UniqueSymbols, AreMadeWeakAndNothingElseIsTouched) {
  EXPECT_EQ(uniqueSymbols(fileBytes(kModules / "good" / "teren-flat.so")), 0)
      << "hidden symbols are not seen";
  std::string bytes = fileBytes(kModules / "visible-1" / "teren-land.so");
  EXPECT_GT(uniqueSymbols(bytes), 0);
  makeUniqueSymbolsWeak(bytes);
  EXPECT_EQ(uniqueSymbols(bytes), 0);
}

TEST(UniqueSymbols, OfDamagedFilesDoNoHarm) {
  const std::string whole = fileBytes(kModules / "visible-1" / "teren-land.so");
  for (std::size_t size = 0; size < whole.size(); size += whole.size() / 97) {
    std::string cut = whole.substr(0, size);
    makeUniqueSymbolsWeak(cut);
    EXPECT_EQ(cut.size(), size);
  }
  RandomSequence random(7);
  for (int n = 0; n < 200; ++n) {
    std::string damaged = whole;
    for (std::size_t at = sizeof(Elf64_Ehdr) - 32; at < sizeof(Elf64_Ehdr); ++at) {
      damaged[at] = static_cast<char>(random.nextBits(8));
    }
    makeUniqueSymbolsWeak(damaged);
  }
  std::string text = "no module";
  makeUniqueSymbolsWeak(text);
  EXPECT_EQ(text, "no module");
}

}  // namespace
}  // namespace teren
