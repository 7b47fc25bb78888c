// Broken modules at the program's door. That each is refused with its own sentence, and what is refused about
// a file before the loader sees it, is tested where modules are opened: tests/engine/plugin.
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/doors/Refusal.h"
#include "tests/engine/plugin/ScratchFolder.h"

namespace teren {
namespace {

const std::filesystem::path kModules = TEREN_TEST_MODULES;

Arguments bakeWith(const std::string& generator) {
  return {"bake", "--generator", generator, "--patches", "0", "0", "1", "1", "-o", "never.r32"};
}

TEST(BrokenModule, IsNamedWithTheReasonWhenItsPluginIsAskedFor) {
  int tried = 0;
  for (const std::string& name : namesIn(kModules / "broken")) {
    if (!name.ends_with(".so")) continue;
    const std::string id = name.substr(6, name.size() - 9);  // teren-ID.so
    expectRefused(bakeWith(id), 2, {"\"" + id + "\"", "was refused: ", name});
    ++tried;
  }
  EXPECT_GE(tried, 17);
}

TEST(BrokenModule, CutShortOrForeignIsNamedWithTheReason) {
  const ScratchFolder folder;
  const std::string whole = fileBytes(kModules / "good" / "teren-flat.so");
  folder.write("teren-cut.so", whole.substr(0, whole.size() / 2));
  folder.write("teren-text.so", "#!/bin/sh\necho no module\n");
  folder.write("teren-empty.so", "");
  std::filesystem::create_directory(folder / "teren-folder.so");
  folder.write("teren-huge.so", whole);
  std::filesystem::resize_file(folder / "teren-huge.so",
                               std::uintmax_t{1} << 40);  // takes no room on the disk
  Program::Settings settings;
  settings.plugins = folder.path();
  expectRefused(bakeWith("huge"), 2,
                {"teren-huge.so was refused", "1099511627776 bytes, expected at most 2^30"}, settings);
  expectRefused(bakeWith("cut"), 2, {"teren-cut.so was refused", "cut short"}, settings);
  expectRefused(bakeWith("text"), 2, {"teren-text.so was refused", "no ELF file"}, settings);
  expectRefused(bakeWith("empty"), 2, {"teren-empty.so was refused", "empty"}, settings);
  expectRefused(bakeWith("folder"), 2, {"teren-folder.so was refused", "not a regular file"}, settings);
}

TEST(BrokenModule, LeavesTheOthersRunning) {
  const Answer answer = Program({"query", "--generator", "flat", "0", "0"}, withHostileModules()).finish();
  EXPECT_EQ(answer.exitCode, 0) << answer.complaint;
  EXPECT_EQ(answer.complaint, "");
}

TEST(SearchPath, MayHoldAnything) {
  for (const std::string& path : {std::string("/nowhere"), std::string(":::"), std::string("/dev/null"),
                                  std::string(100'000, 'x'), std::string("/proc/self/mem:\n:\xff")}) {
    Program::Settings settings;
    settings.plugins = path;
    const Answer answer = Program({"query", "--generator", "fault", "0", "0"}, settings).finish();
    EXPECT_EQ(answer.exitCode, 0) << answer.complaint;
    EXPECT_EQ(answer.complaint, "");
  }
}

}  // namespace
}  // namespace teren
