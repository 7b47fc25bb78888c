// What gnuplot is asked for, and pictures as parts of a page.
#include "apps/report/Plot.h"

#include <cstdlib>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "apps/report/Gnuplot.h"
#include "tests/engine/plugin/ScratchFolder.h"

namespace teren {
namespace {

TEST(Plot, AsksForEveryCurveThatHasPoints) {
  const std::string script = scriptOf({"name",
                                       "It's a title",
                                       "x [m]",
                                       "y",
                                       true,
                                       true,
                                       {{"one", {{1.0, 2.0}, {0.0, 3.0}, {4.0, 0.5}}},
                                        {"none", {{1.0, 0.0}, {-1.0, 1.0}}},
                                        {"two", {{8.0, 9.0}}, true}}});
  EXPECT_NE(script.find("\n1 2\n4 0.5\n"), std::string::npos) << "0 has no logarithm\n" << script;
  EXPECT_NE(script.find("\n8 9\n"), std::string::npos);
  EXPECT_EQ(script.find("none"), std::string::npos);
  EXPECT_NE(script.find("'It''s a title'"), std::string::npos) << script;
  EXPECT_NE(script.find("dashtype"), std::string::npos);
}

TEST(Plot, LetsNoTextBecomeACommand) {
  const std::string script =
      scriptOf({"name", "a'\nset output '/tmp/x", "x", "y", false, false, {{"c'\n!ls", {{0.0, 1.0}}}}});
  EXPECT_EQ(script.find("\nset output"), std::string::npos) << script;
  EXPECT_EQ(script.find("\n!ls"), std::string::npos) << script;
  EXPECT_NE(script.find("'a''set output ''/tmp/x'"), std::string::npos) << script;
}

TEST(Plot, WithoutAPointIsNotDrawn) {
  const Plot plot{"name", "title", "x", "y", false, true, {{"one", {{1.0, -2.0}}}}};
  EXPECT_EQ(scriptOf(plot), "");
  EXPECT_FALSE(drawn(plot));
}

/// Puts a gnuplot of one's own in the way of the installed one.
class OtherGnuplot {
 public:
  explicit OtherGnuplot(const std::string& script) {
    const char* const path = std::getenv("PATH");
    before_ = path == nullptr ? "" : path;
    folder_.write("gnuplot", "#!/bin/sh\n" + script + "\n");
    std::filesystem::permissions(folder_ / "gnuplot", std::filesystem::perms::owner_all);
    setenv("PATH", (folder_.path().string() + ":" + before_).c_str(), 1);
  }
  OtherGnuplot(const OtherGnuplot&) = delete;
  OtherGnuplot& operator=(const OtherGnuplot&) = delete;
  ~OtherGnuplot() { setenv("PATH", before_.c_str(), 1); }

 private:
  ScratchFolder folder_;
  std::string before_;
};

TEST(Plot, IsDrawnWhereGnuplotIsInstalled) {
  if (const Result<void> found = findGnuplot(); !found) GTEST_SKIP() << found.error().message;
  const auto picture = drawn({"name", "title", "x", "y", false, false, {{"one", {{1.0, 2.0}, {2.0, 3.0}}}}});
  ASSERT_TRUE(picture) << picture.error().message;
  EXPECT_NE(inlineSvg(*picture, "name"), "");
}

TEST(Plot, IsRefusedWhereGnuplotHasWrittenAPartOfIt) {
  const Plot plot{"name", "title", "x", "y", false, false, {{"one", {{1.0, 2.0}}}}};
  for (const char* part : {"", "<svg><g>", "<svg><g></svg", "<svg></svg><g"}) {
    const OtherGnuplot cut(std::string("printf '") + part + "'");
    const auto picture = drawn(plot);
    ASSERT_FALSE(picture) << part;
    EXPECT_NE(picture.error().message.find("has not drawn all of the plot name"), std::string::npos)
        << picture.error().message;
  }
  const OtherGnuplot whole("printf '<svg></svg>\\n\\n'");
  const auto picture = drawn(plot);
  ASSERT_TRUE(picture) << picture.error().message;
  EXPECT_EQ(*picture, "<svg></svg>\n\n");
}

TEST(Plot, BecomesAPartOfAPageWithIdsOfItsOwn) {
  const std::string svg = inlineSvg(
      "<?xml version=\"1.0\"?>\n<svg width=\"1\">\n<g id=\"canvas\"><path id='gpPt1'/><use "
      "xlink:href='#gpPt1'/>"
      "<g filter=\"url(#box)\"/></g></svg>\n",
      "name");
  EXPECT_EQ(svg,
            "<svg width=\"1\">\n<g id=\"name-canvas\"><path id='name-gpPt1'/><use xlink:href='#name-gpPt1'/>"
            "<g filter=\"url(#name-box)\"/></g></svg>");
  EXPECT_EQ(inlineSvg("no picture", "name"), "");
  EXPECT_EQ(inlineSvg("</svg><svg", "name"), "");
}

}  // namespace
}  // namespace teren
