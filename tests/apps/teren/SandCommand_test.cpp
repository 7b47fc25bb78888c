// The table of teren sand, and what it refuses.
#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>
#include <unistd.h>
#include <vector>

#include <gtest/gtest.h>

#include "tests/apps/teren/Program.h"

namespace teren {
namespace {

std::vector<std::vector<std::string>> tableOf(const std::string& text) {
  std::vector<std::vector<std::string>> table;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    table.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) table.back().push_back(cell);
  }
  return table;
}

/// A cell of the table by its column's name.
double cell(const std::vector<std::vector<std::string>>& table, std::size_t row, const std::string& name) {
  for (std::size_t k = 0; k < table[0].size(); ++k) {
    if (table[0][k] == name) return std::stod(table[row][k]);
  }
  ADD_FAILURE() << "there is no column " << name;
  return 0.0;
}

TEST(SandCommand, TellsOfEveryGrooveWhatItCostAndThatNothingWasLost) {
  const Answer answer =
      teren({"sand", "--vertices", "1000", "--vertices", "3000", "--trace", "30", "--steps", "3000"});
  ASSERT_EQ(answer.exitCode, 0) << answer.complaint;
  EXPECT_EQ(answer.complaint, "");
  const auto table = tableOf(answer.output);
  ASSERT_EQ(table.size(), 3U);
  for (std::size_t row = 1; row < table.size(); ++row) {
    ASSERT_EQ(table[row].size(), table[0].size());
    EXPECT_GT(cell(table, row, "stamps"), 15.0);
    EXPECT_LT(cell(table, row, "stamps"), 25.0);
    for (const char* part : {"insertion_ms", "constraint_ms", "removal_ms", "berm_ms", "slide_ms",
                             "clean_up_ms", "iteration_median_ms", "grid_ms", "grid_iteration_median_ms"}) {
      EXPECT_GT(cell(table, row, part), 0.0) << part;
    }
    EXPECT_GT(cell(table, row, "slide_steps"), 1000.0);
    EXPECT_LE(cell(table, row, "slide_steps"), 3000.0 * cell(table, row, "stamps"));
    EXPECT_GT(cell(table, row, "moved_m3"), 0.001);
    EXPECT_LT(cell(table, row, "moved_m3"), 1.0);
    EXPECT_LT(cell(table, row, "drift"), 1e-12);
    EXPECT_EQ(cell(table, row, "grid_side"), 483.0);
  }
  EXPECT_EQ(cell(table, 1, "vertices"), 1000.0);
  EXPECT_EQ(cell(table, 2, "vertices"), 3000.0);
}

TEST(SandCommand, NamesTheVerticesThatBytesAreDividedBy) {
  const auto table = tableOf(teren({"sand", "--vertices", "1000", "--trace", "20"}).output);
  ASSERT_EQ(table.size(), 2U);
  const double bytes = cell(table, 1, "bytes"), most = cell(table, 1, "vertices_most");
  EXPECT_GE(most, cell(table, 1, "vertices_after"));
  EXPECT_GE(most, 1000.0);
  EXPECT_NEAR(cell(table, 1, "bytes_per_vertex_most"), bytes / most, 0.06);
  EXPECT_NEAR(cell(table, 1, "bytes_per_vertex_after"), bytes / cell(table, 1, "vertices_after"), 0.06);
  EXPECT_NEAR(cell(table, 1, "grid_bytes_per_byte"), cell(table, 1, "grid_bytes") / bytes, 0.006);
}

TEST(SandCommand, HoldsAtMostNinetyBytesAVertexInALargeMesh) {
  const auto table =
      tableOf(teren({"sand", "--vertices", "200000", "--trace", "5", "--steps", "1000"}).output);
  ASSERT_EQ(table.size(), 2U);
  EXPECT_GT(cell(table, 1, "bytes_per_vertex_most"), 72.0) << "two triangles, a point and a height alone";
  EXPECT_LT(cell(table, 1, "bytes_per_vertex_most"), 90.0);
}

TEST(SandCommand, ComparesWithAGridAsFineAsTheFinestOfTheMesh) {
  const auto table =
      tableOf(teren({"sand", "--vertices", "1000", "--vertices", "400000", "--trace", "5", "--steps", "1000"})
                  .output);
  ASSERT_EQ(table.size(), 3U);
  EXPECT_EQ(cell(table, 1, "grid_side"), 483.0) << "as fine as the tool's walls";
  EXPECT_NEAR(cell(table, 2, "grid_side"), 633.0, 1.0) << "as fine as 400,000 vertices lie";
  EXPECT_GT(cell(table, 1, "grid_bytes"), 8.0 * cell(table, 1, "bytes")) << "far larger where detail is rare";
  EXPECT_LT(cell(table, 2, "grid_bytes"), cell(table, 2, "bytes")) << "smaller where it is everywhere";
}

TEST(SandCommand, DigsTheSameGrooveEveryTime) {
  const Arguments arguments{"sand", "--vertices", "500", "--trace", "10", "--no-grid"};
  const auto one = tableOf(teren(arguments).output), two = tableOf(teren(arguments).output);
  ASSERT_EQ(one.size(), 2U);
  for (const char* name : {"vertices_after", "slide_steps", "divided", "moved_m3", "drift", "bytes"}) {
    EXPECT_EQ(cell(one, 1, name), cell(two, 1, name)) << name;
  }
}

TEST(SandCommand, WritesItsTableIntoAFile) {
  const Answer answer = teren({"sand", "--vertices", "100", "--trace", "5", "--no-grid", "-o", "table.csv"});
  EXPECT_EQ(answer.exitCode, 0) << answer.complaint;
  EXPECT_EQ(answer.output, "");
  EXPECT_EQ(answer.left, std::vector<std::string>{"table.csv"});
}

/// A folder of programs that is all a program finds.
class SearchPath {
 public:
  SearchPath() { setenv("PATH", folder_.path().c_str(), 1); }
  ~SearchPath() { setenv("PATH", former_.c_str(), 1); }
  SearchPath(const SearchPath&) = delete;
  SearchPath& operator=(const SearchPath&) = delete;
  void add(const std::string& name, const std::string& script) const {
    folder_.write(name, "#!/bin/sh\n" + script + "\n");
    std::filesystem::permissions(folder_ / name, std::filesystem::perms::owner_all);
  }

 private:
  ScratchFolder folder_;
  std::string former_ = std::getenv("PATH");
};

const Arguments kPlotted{"sand", "--vertices", "100", "--vertices", "300", "--trace",
                         "5",    "--trace",    "10",  "--steps",    "100", "--plots"};

Arguments plottedTo(const std::string& folder) {
  Arguments arguments = kPlotted;
  arguments.push_back(folder);
  return arguments;
}

TEST(SandCommand, DrawsTimesAndBytesWithGnuplot) {
  const SearchPath path;
  path.add("gnuplot", "exec /bin/cat");  // what it is asked to draw
  const ScratchFolder folder;
  const Answer answer = teren(plottedTo(folder / "plots" / "of sand"));
  ASSERT_EQ(answer.exitCode, 0) << answer.complaint;
  EXPECT_EQ(tableOf(answer.output).size(), 5U) << "the table as well";
  std::vector<std::string> drawn = namesIn(folder / "plots" / "of sand");
  std::sort(drawn.begin(), drawn.end());
  EXPECT_EQ(drawn,
            (std::vector<std::string>{"bytes-by-vertices.svg", "time-by-trace.svg", "time-by-vertices.svg"}));
  const auto asked = [&](const std::string& name) { return fileBytes(folder / "plots" / "of sand" / name); };
  const auto table = tableOf(answer.output);
  for (const char* part :
       {"location and insertion", "constraints", "removal", "slides", "clean-up", "regular grid"}) {
    EXPECT_NE(asked("time-by-vertices.svg").find(part), std::string::npos) << part;
    EXPECT_NE(asked("time-by-trace.svg").find(part), std::string::npos) << part;
  }
  const std::string bytes = asked("bytes-by-vertices.svg");
  EXPECT_NE(bytes.find("\n100 "), std::string::npos);
  EXPECT_NE(bytes.find("\n300 " + std::to_string(cell(table, 4, "bytes") / 1e6).substr(0, 5)),
            std::string::npos)
      << bytes;
  EXPECT_NE(asked("time-by-trace.svg").find("300 vertices"), std::string::npos) << "of the largest mesh";
}

TEST(SandCommand, SaysInOneSentenceWhyNothingIsDrawn) {
  const SearchPath path;
  const ScratchFolder folder;
  const auto refused = [](const Arguments& arguments, const std::string& named, int code) {
    const Answer answer = teren(arguments);
    EXPECT_EQ(answer.exitCode, code) << named;
    EXPECT_TRUE(isOneSentence(answer.complaint)) << answer.complaint;
    EXPECT_NE(answer.complaint.find(named), std::string::npos) << answer.complaint;
    EXPECT_TRUE(answer.left.empty());
  };
  refused(plottedTo(folder / "plots"), "install", 2);
  path.add("gnuplot", "exit 3");
  refused(plottedTo(folder / "plots"), "gnuplot has failed", 2);
  path.add("gnuplot", "read -r line && exit 3; exit 0");  // fails at work
  refused(plottedTo(folder / "plots"), "gnuplot has failed", 1);
  EXPECT_TRUE(namesIn(folder / "plots").empty());
  path.add("gnuplot", "exec /bin/cat");
  folder.write("file", "no folder");
  refused(plottedTo(folder / "file"), "file", 2);
  refused(plottedTo(""), "folder", 2);
  refused({"sand", "--vertices", "100", "--plots", folder / "plots"}, "two or more", 2);
}

/// Slides that would take minutes, on the mesh and on the grid: the signal ends them.
TEST(SandCommand, StopsWithinLongSlidesAndLeavesNoHalfFile) {
  const Arguments lasting{"sand", "--vertices", "4",       "--depth", "1",       "--repose",  "1",
                          "-o",   "table",      "--trace", "5",       "--steps", "1000000000"};
  for (const auto& which : {Arguments{"--radius", "0.2", "--no-grid"}, Arguments{"--radius", "0.005"}}) {
    Arguments arguments = lasting;
    arguments.insert(arguments.end(), which.begin(), which.end());
    Program program(arguments);
    ASSERT_TRUE(program.waitUntilItCatches(SIGINT));
    usleep(500'000);
    program.signal(SIGINT);
    const Answer answer = program.finish();
    EXPECT_EQ(answer.exitCode, 1);
    EXPECT_EQ(answer.complaint, "teren: interrupted\n");
    EXPECT_TRUE(answer.left.empty());
  }
}

TEST(SandCommand, RefusesWhatMakesNoGrooveWithOneSentence) {
  const std::vector<Arguments> hostile{
      {"sand", "--vertices", "3"},       {"sand", "--vertices", "-5"},       {"sand", "--vertices", "1e3"},
      {"sand", "--vertices", "4000001"}, {"sand", "--vertices", ""},         {"sand", "--trace", "nan"},
      {"sand", "--trace", "4.9"},        {"sand", "--trace", "inf"},         {"sand", "--radius", "0"},
      {"sand", "--radius", "-0.04"},     {"sand", "--depth", "nan"},         {"sand", "--depth", "1e300"},
      {"sand", "--points", "2"},         {"sand", "--points", "12.5"},       {"sand", "--repose", "90"},
      {"sand", "--steps", "-1"},         {"sand", "-o", "no/such/folder/f"}, {"sand", "unexpected"}};
  for (const Arguments& arguments : hostile) {
    const Answer answer = teren(arguments);
    EXPECT_EQ(answer.exitCode, 2) << arguments.back();
    EXPECT_EQ(answer.output, "");
    EXPECT_EQ(std::count(answer.complaint.begin(), answer.complaint.end(), '\n'), 1) << answer.complaint;
    EXPECT_TRUE(answer.left.empty());
  }
}

}  // namespace
}  // namespace teren
