#include "teren/PluginRegistry.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <dlfcn.h>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "teren/HeightMap.h"

#include "ScratchFolder.h"
#include "plugin/Module.h"

namespace teren {
namespace {

namespace fs = std::filesystem;

const fs::path kModules = TEREN_TEST_MODULES;

std::shared_ptr<const PluginRegistry> loadFrom(std::vector<fs::path> folders) {
  return PluginRegistry::load(folders);
}

/// Refusals by file name.
std::map<std::string, std::string> reasons(const PluginRegistry& registry) {
  std::map<std::string, std::string> byName;
  for (const RefusedModule& module : registry.refused()) byName[module.file.filename()] = module.reason;
  return byName;
}

bool isOneSentence(const std::string& text) {
  return !text.empty() && text.back() != '.' && text.find('\n') == std::string::npos && text.size() < 1000;
}

TEST(PluginRegistry, FindsGoodModulesAndKnowsAllAboutThem) {
  const auto registry = loadFrom({kModules / "good"});
  EXPECT_TRUE(registry->refused().empty());
  ASSERT_EQ(registry->plugins().size(), 3U);
  const PluginInfo& flat = registry->plugins()[0];
  EXPECT_EQ(flat.id, "flat");
  EXPECT_EQ(flat.kind, PluginKind::generator);
  EXPECT_EQ(flat.version, "1.0");
  EXPECT_EQ(flat.doc, "one height everywhere");
  EXPECT_EQ(flat.file, kModules / "good" / "teren-flat.so");
  ASSERT_EQ(flat.parameters.size(), 1U);
  EXPECT_EQ(flat.parameters[0].name, "height");
  EXPECT_EQ(registry->plugins()[1].id, "press");
  EXPECT_EQ(registry->plugins()[1].kind, PluginKind::deformer);
  ASSERT_EQ(registry->plugins()[1].parameters.size(), 1U);
  EXPECT_EQ(registry->plugins()[2].id, "raise");
  EXPECT_EQ(registry->plugins()[2].kind, PluginKind::filter);
  EXPECT_EQ(registry->find("flat"), &flat);
  EXPECT_EQ(registry->find("fla"), nullptr);
}

TEST(PluginRegistry, MakesGeneratorsAndFiltersThatWork) {
  const auto registry = loadFrom({kModules / "good"});
  const std::array height = {Values::Entry("height", 7.5)};
  const auto generator = registry->makeGenerator("flat", height);
  ASSERT_TRUE(generator.ok()) << generator.error().message;
  const auto filter = registry->makeFilter("raise", height);
  ASSERT_TRUE(filter.ok()) << filter.error().message;

  HeightMap map(5, 5);
  MapRequest request;
  request.samples = 5;
  ASSERT_TRUE((*generator)->begin(request, map.view())->step(Slice::unlimited()));
  ASSERT_TRUE((*filter)->begin(request, map.view())->step(Slice::unlimited()));
  for (const float sample : map.samples()) EXPECT_EQ(sample, 15.0F);
}

TEST(PluginRegistry, MakesDeformersWhoseStampsSayEverything) {
  const auto registry = loadFrom({kModules / "good"});
  const auto deformer = registry->makeDeformer("press");
  ASSERT_TRUE(deformer.ok()) << deformer.error().message;
  const HeightMap ground(9, 9);
  auto surface = (*deformer)->begin({.intervals = 8, .spacing = 0.5}, ground.view());
  ASSERT_TRUE(surface.ok()) << surface.error().message;
  const std::array strength = {Values::Entry("strength", 3.0)};
  const auto values = Values::check(registry->find("press")->parameters, strength, "press");
  ASSERT_TRUE((*surface)->apply({.east = 2.0, .north = 1.5, .depth = 2.0, .values = *values}).ok());
  EXPECT_EQ((*surface)->snapshot()->height(2.0, 1.5), -6.0);
  EXPECT_EQ((*surface)->snapshot()->height(1.5, 2.0), 0.0);
}

TEST(PluginRegistry, RefusesEveryBrokenModuleWithItsOwnSentence) {
  const auto registry = loadFrom({kModules / "broken", kModules / "good"});
  const std::map<std::string, std::string> expected = {
      {"teren-bad-id.so", "its id \"Bad Id\" is not made of lower-case letters, digits and '-', 1 to 64"},
      {"teren-default-outside.so", "the default 3 of parameter \"height\" is outside the range 0 to 2"},
      {"teren-no-deformer-maker.so", "it is a deformer but has no makeDeformer"},
      {"teren-no-maker.so", "it is a filter but has no makeFilter"},
      {"teren-no-symbol.so", "it does not export the function terenPlugin"},
      {"teren-no-table.so", "its description has no parameter table"},
      {"teren-null-description.so", "its function terenPlugin returned no description"},
      {"teren-null-name.so",
       "the name of row 2 of the table is not one line of readable text of at most 64 bytes"},
      {"teren-null-rows.so", "the table has 3 parameters at no address"},
      {"teren-null-texts.so", "its description has no version"},
      {"teren-null-words.so", "its description holds no readable list of ABI words"},
      {"teren-one-other-word.so",
       "it was built for another binary interface: \"plugin interface version\" is " +
           std::to_string(kPluginInterfaceVersion + 1) + " in the module and " +
           std::to_string(kPluginInterfaceVersion) + " in the engine"},
      {"teren-other-id.so", "its id is \"something-else\" but its file name says \"other-id\""},
      {"teren-other-strings.so",
       "it was built for another binary interface: \"C++11 string ABI\" is 0 in the module and 1 in the "
       "engine"},
      {"teren-other-words.so",
       "it was built for another binary interface: \"plugin interface version\" is 42 in the module and " +
           std::to_string(kPluginInterfaceVersion) +
           " in the engine, \"pointer size\" is 4 in the module and 8 in the engine, \"sanitizer\" is "
           "missing in "
           "the module and " +
           std::to_string(kSanitizerWord) +
           " in the engine, \"phase of the moon\" is 3 in the module and unknown in the engine"},
      {"teren-repeated-name.so", "parameter \"height\" is in the table twice"},
      {"teren-throwing-entry.so", "its function terenPlugin threw: the entry point?is unwell"},
      {"teren-undefined-symbol.so", "the loader refuses it: undefined symbol: terenTestNobodyHasThis"},
      {"teren-unknown-kind.so", "its kind 4 is none of generator (1), filter (2) and deformer (3)"},
      {"teren-wrong-magic.so", "its description does not begin with Teren's magic number"},
  };
  EXPECT_EQ(reasons(*registry), expected);
  for (const RefusedModule& module : registry->refused())
    EXPECT_TRUE(isOneSentence(module.reason)) << module.reason;
  // What is broken leaves the rest running.
  EXPECT_EQ(registry->plugins().size(), 3U);
}

TEST(PluginRegistry, UnloadsWhatItRefusesAndKeepsWhatItAccepts) {
  const auto registry = loadFrom({kModules / "broken", kModules / "good"});
  const auto loaded = [](const fs::path& file) {
    void* const handle = dlopen(file.c_str(), RTLD_NOW | RTLD_NOLOAD);
    if (handle != nullptr) dlclose(handle);
    return handle != nullptr;
  };
  EXPECT_FALSE(loaded(kModules / "broken" / "teren-wrong-magic.so"));
  EXPECT_TRUE(loaded(kModules / "good" / "teren-flat.so"));
}

TEST(PluginRegistry, TakesTheFirstOfTwoEqualIdsAndReportsTheOther) {
  const ScratchFolder first;
  const ScratchFolder second;
  fs::copy(kModules / "good" / "teren-flat.so", first.path());
  fs::copy(kModules / "good" / "teren-flat.so", second.path());
  const auto registry = loadFrom({first.path(), second.path()});
  ASSERT_EQ(registry->plugins().size(), 1U);
  EXPECT_EQ(registry->plugins()[0].file, first / "teren-flat.so");
  ASSERT_EQ(registry->refused().size(), 1U);
  EXPECT_EQ(registry->refused()[0].file, second / "teren-flat.so");
  EXPECT_EQ(registry->refused()[0].reason,
            "the plugin \"flat\" was already found as " + (first / "teren-flat.so").string());
}

TEST(PluginRegistry, TriesTheNextFolderAfterABrokenModule) {
  const ScratchFolder first;
  first.write("teren-flat.so", fileBytes(kModules / "good" / "teren-flat.so").substr(0, 5000));
  const auto registry = loadFrom({first.path(), kModules / "good"});
  ASSERT_NE(registry->find("flat"), nullptr);
  EXPECT_EQ(registry->find("flat")->file, kModules / "good" / "teren-flat.so");
  EXPECT_EQ(reasons(*registry).at("teren-flat.so"),
            "it is cut short: its headers speak of more than the file holds");
}

TEST(PluginRegistry, VisitsAFolderOnceHoweverItIsCalled) {
  const ScratchFolder folder;
  fs::create_directory_symlink(kModules / "good", folder / "link");
  const auto registry = loadFrom({kModules / "good", folder / "link", kModules / "good" / "."});
  EXPECT_EQ(registry->plugins().size(), 3U);
  EXPECT_TRUE(registry->refused().empty());
}

TEST(PluginRegistry, PassesOverAbsentFoldersAndForeignFiles) {
  const ScratchFolder folder;
  folder.write("libsomething.so", "not ours");
  folder.write("teren-notes.txt", "not ours");
  folder.write("teren-.so", "not ours");
  const auto registry = loadFrom({folder.path(), folder / "absent"});
  EXPECT_TRUE(registry->plugins().empty());
  EXPECT_TRUE(registry->refused().empty());
}

TEST(PluginRegistry, ReportsAFolderThatIsAFile) {
  const ScratchFolder folder;
  folder.write("file", "text");
  const auto registry = loadFrom({folder / "file"});
  ASSERT_EQ(registry->refused().size(), 1U);
  EXPECT_EQ(registry->refused()[0].reason, "the folder cannot be read: Not a directory");
}

TEST(PluginRegistry, RefusesFileNamesThatNoIdCanHave) {
  const ScratchFolder folder;
  fs::copy(kModules / "good" / "teren-flat.so", folder / "teren-Flat.so");
  fs::create_directory(folder / "teren-folder.so");
  const auto registry = loadFrom({folder.path()});
  EXPECT_EQ(reasons(*registry),
            (std::map<std::string, std::string>{
                {"teren-Flat.so",
                 "a module's file name must be teren-<id>.so, the id in lower-case letters, digits and '-'"},
                {"teren-folder.so", "it is not a regular file"}}));
}

TEST(PluginRegistry, NamesWhatItHasWhenAnIdIsUnknown) {
  const auto registry = loadFrom({kModules / "good"});
  EXPECT_EQ(registry->makeGenerator("fault", {}).error().message,
            "no generator has the id \"fault\"; there are flat");
  EXPECT_EQ(registry->makeFilter("fault", {}).error().message,
            "no filter has the id \"fault\"; there are raise");
  EXPECT_EQ(registry->makeGenerator("raise", {}).error().message,
            "plugin \"raise\" is a filter, not a generator; there are flat");
  EXPECT_EQ(registry->makeDeformer("raise").error().message,
            "plugin \"raise\" is a filter, not a deformer; there are press");
  EXPECT_EQ(registry->makeGenerator("press", {}).error().message,
            "plugin \"press\" is a deformer, not a generator; there are flat");
  EXPECT_EQ(registry->makeDeformer("sand").error().message,
            "no deformer has the id \"sand\"; there are press");
  EXPECT_EQ(loadFrom({})->makeGenerator("fault", {}).error().message,
            "no generator has the id \"fault\"; there are none");
}

TEST(PluginRegistry, TellsWhyAPluginIsMissingWhenItsModuleWasRefused) {
  const auto registry = loadFrom({kModules / "broken"});
  EXPECT_EQ(registry->makeGenerator("no-symbol", {}).error().message,
            "no generator has the id \"no-symbol\", because " +
                (kModules / "broken" / "teren-no-symbol.so").string() +
                " was refused: it does not export the function terenPlugin");
}

TEST(PluginRegistry, ChecksParametersBeforeThePluginSeesThem) {
  const auto registry = loadFrom({kModules / "good"});
  const std::array tooHigh = {Values::Entry("height", 1e9)};
  EXPECT_EQ(registry->makeGenerator("flat", tooHigh).error().message,
            "parameter \"height\" of flat is 1e+09 but must be a number from -1000 to 1000 m");
}

TEST(PluginRegistry, CatchesConstructorsThatThrow) {
  const auto registry = loadFrom({kModules / "throwing"});
  const auto refusal = [&](double height) {
    const std::array entries = {Values::Entry("height", height)};
    return registry->makeGenerator("throwing", entries).error().message;
  };
  EXPECT_EQ(refusal(1.0), "plugin \"throwing\" refuses its parameters: no ground today");
  EXPECT_EQ(refusal(2.0), "plugin \"throwing\" refuses its parameters without saying why");
  EXPECT_EQ(refusal(3.0), "plugin \"throwing\" made nothing of its parameters");
  EXPECT_EQ(refusal(4.0), "plugin \"throwing\" refuses its parameters: an exception without a text");
}

TEST(PluginRegistry, CatchesMakersOfDeformersThatThrow) {
  EXPECT_EQ(loadFrom({kModules / "throwing"})->makeDeformer("throwing-deformer").error().message,
            "plugin \"throwing-deformer\" refuses to be made: the ground is frozen");
}

TEST(PluginRegistry, SearchesTheVariableThenBesideTheEngineThenTheInstallPrefix) {
  ASSERT_EQ(setenv("TEREN_PLUGIN_PATH", "/first::/second:", 1), 0);
  const std::vector<fs::path> folders = PluginRegistry::searchPath();
  unsetenv("TEREN_PLUGIN_PATH");
  ASSERT_EQ(folders.size(), 4U);
  EXPECT_EQ(folders[0], "/first");
  EXPECT_EQ(folders[1], "/second");
  EXPECT_EQ(folders[2].filename(), "plugins");
  EXPECT_TRUE(fs::exists(folders[2].parent_path().parent_path() / "libteren-core.so")) << folders[2];
  EXPECT_EQ(PluginRegistry::searchPath().size(), 2U);
}

TEST(PluginId, IsLowerCaseLettersDigitsAndHyphens) {
  EXPECT_TRUE(isPluginId("fault"));
  EXPECT_TRUE(isPluginId("band-2"));
  for (const char* id : {"", "Fault", "fault.2", "a b", "a/b", "a_b", "\xc3\xa4"})
    EXPECT_FALSE(isPluginId(id)) << id;
  EXPECT_FALSE(isPluginId(std::string(65, 'a')));
}

TEST(AbiWords, AgreeWithThemselvesInAnyOrder) {
  std::array words = std::to_array(kAbiWords);
  std::reverse(words.begin(), words.end());
  EXPECT_TRUE(compareAbiWords(words, kAbiWords).ok());
}

TEST(AbiWords, AreEachNamedWhenTheyDiffer) {
  for (std::size_t k = 0; k < std::size(kAbiWords); ++k) {
    std::array words = std::to_array(kAbiWords);
    words[k].value += 1;
    const Result<void> compared = compareAbiWords(words, kAbiWords);
    ASSERT_FALSE(compared.ok());
    EXPECT_NE(compared.error().message.find(kAbiWords[k].name), std::string::npos);
    EXPECT_NE(compared.error().message.find(std::to_string(words[k].value) + " in the module"),
              std::string::npos);
    EXPECT_NE(compared.error().message.find(std::to_string(kAbiWords[k].value) + " in the engine"),
              std::string::npos);
  }
}

TEST(AbiWords, MayBeNoneOrNameless) {
  EXPECT_FALSE(compareAbiWords({}, kAbiWords).ok());
  std::array words = std::to_array(kAbiWords);
  words[0].name = nullptr;
  EXPECT_FALSE(compareAbiWords(words, kAbiWords).ok());
}

}  // namespace
}  // namespace teren
