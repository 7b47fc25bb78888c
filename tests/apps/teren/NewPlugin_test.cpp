// `teren new-plugin`: what it refuses, and that nothing half is left. tests/embedding builds and tries what
// it writes.
#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/apps/teren/Program.h"

namespace teren {
namespace {

bool holds(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

void expectRefusal(const Answer& answer, int exitCode, const std::string& part) {
  EXPECT_EQ(answer.exitCode, exitCode);
  EXPECT_NE(answer.complaint.find(part), std::string::npos) << answer.complaint;
  EXPECT_EQ(std::count(answer.complaint.begin(), answer.complaint.end(), '\n'), 1) << answer.complaint;
  EXPECT_EQ(answer.output, "");
  EXPECT_FALSE(std::any_of(answer.left.begin(), answer.left.end(),
                           [](const std::string& name) { return name.starts_with("teren-"); }));
}

TEST(NewPlugin, WritesAFolderOfItsOwn) {
  for (const char* kind : {"generator", "filter", "deformer"}) {
    const Answer answer = Program({"new-plugin", "my-hills", "--kind", kind}).finish();
    EXPECT_EQ(answer.exitCode, 0) << answer.complaint;
    EXPECT_EQ(answer.complaint, "");
    EXPECT_TRUE(holds(answer.left, "teren-my-hills")) << kind;
  }
}

TEST(NewPlugin, RefusesWhatIsNoIdAndNoKind) {
  for (const std::string& id : {std::string("My"), std::string("a b"), std::string("../x"),
                                std::string("a/b"), std::string("\xc3\xa4"), std::string(65, 'a')}) {
    expectRefusal(Program({"new-plugin", id}).finish(), 2, "lower-case letters");
  }
  expectRefusal(Program({"new-plugin"}).finish(), 2, "missing");
  expectRefusal(Program({"new-plugin", "a", "--kind", "volcano"}).finish(), 2, "\"volcano\"");
}

TEST(NewPlugin, RefusesTheIdOfAPluginThatIsThere) {
  for (const char* kind : {"generator", "filter"}) {
    expectRefusal(Program({"new-plugin", "flat", "--kind", kind}).finish(), 2,
                  "there is a plugin \"flat\" already, " TEREN_TEST_MODULES "/good/teren-flat.so");
  }
  EXPECT_EQ(Program({"new-plugin", "no-symbol"}).finish().exitCode, 0) << "a refused module is no plugin";
}

TEST(NewPlugin, LeavesNothingHalfOnAFullDisk) {
  Program::Settings settings;
  settings.largestFile = 100;
  const Answer answer = Program({"new-plugin", "a"}, settings).finish();
  EXPECT_EQ(answer.exitCode, 1);
  EXPECT_FALSE(holds(answer.left, "teren-a"));
}

}  // namespace
}  // namespace teren
