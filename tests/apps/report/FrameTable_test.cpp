// What is read of the files that programs with a window write.
#include "apps/report/FrameTable.h"

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/engine/plugin/ScratchFolder.h"

namespace teren {
namespace {

constexpr const char* kGood =
    R"({"frames": 100, "frame_ms": {"p50": 20.5, "p99": 33, "max": 60}, "engine_us": {"p50": 900, "p99": 2000, "max": 9},
        "triangles": 12345, "nodes": 67, "bytes": 8, "pixel_error": {"p99": 3.5, "max": 3.9}})";

TEST(FrameTable, HasARowForEachFile) {
  const ScratchFolder folder;
  folder.write("a.json", kGood);
  const auto table = readFrames(std::vector<std::string>{folder / "a.json", folder / "a.json"});
  ASSERT_TRUE(table) << table.error().message;
  ASSERT_EQ(table->rows().size(), 2U);
  EXPECT_EQ(table->text(1, "file"), "a.json");
  EXPECT_EQ(table->number(1, "frame median"), 20.5);
  EXPECT_EQ(table->number(1, "frame p99"), 33.0);
  EXPECT_EQ(table->number(1, "triangles"), 12345.0);
  EXPECT_EQ(table->number(1, "promised max"), 3.9);
  EXPECT_TRUE(readFrames({})->rows().empty());
}

TEST(FrameTable, KnowsWhatWasWantedWhereDetailGoesByError) {
  const ScratchFolder folder;
  std::string text = kGood;
  folder.write("level.json", text);
  text.insert(1, R"("detail": {"pixel_error": 24, "distance": 20000, "lines": 720}, )");
  folder.write("error.json", text);
  const auto table = readFrames(std::vector<std::string>{folder / "level.json", folder / "error.json"});
  ASSERT_TRUE(table) << table.error().message;
  EXPECT_EQ(table->text(0, "pixel error"), "");
  EXPECT_EQ(table->number(1, "pixel error"), 24.0);
  EXPECT_EQ(table->number(1, "view distance"), 20000.0);
  EXPECT_EQ(table->number(1, "lines"), 720.0);
  EXPECT_EQ(table->number(1, "frame median"), 20.5);
}

TEST(FrameTable, RefusesOtherFilesNamingThemAndWhatIsMissing) {
  const ScratchFolder folder;
  const auto refused = [&](const std::string& bytes, const std::string& named) {
    folder.write("bad.json", bytes);
    const auto table = readFrames(std::vector<std::string>{folder / "bad.json"});
    ASSERT_FALSE(table) << bytes;
    EXPECT_NE(table.error().message.find("bad.json"), std::string::npos) << table.error().message;
    EXPECT_NE(table.error().message.find(named), std::string::npos) << table.error().message;
  };
  refused("", "JSON");
  refused("[1, 2]", "JSON");
  refused("{\"frames\": 1", "JSON");
  refused("{}", "frames");
  refused(R"({"frames": 1, "frame_ms": 5})", "frame_ms.p50");
  refused(R"({"detail": 5, "frames": 1})", "detail.pixel_error");
  refused(R"({"detail": {"pixel_error": 24}, "frames": 1})", "detail.distance");
  refused(R"({"frames": 1, "frame_ms": {"p50": "fast"}})", "frame_ms.p50");
  refused(R"({"frames": 1e999})", "JSON");
  refused(std::string(2 << 20, ' '), "larger");
  EXPECT_FALSE(readFrames(std::vector<std::string>{folder / "nowhere.json"}));
  EXPECT_FALSE(readFrames(std::vector<std::string>{""}));
}

}  // namespace
}  // namespace teren
