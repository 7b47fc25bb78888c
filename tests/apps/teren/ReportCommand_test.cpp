// The files of teren report, what is in them, and what it refuses.
#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <unistd.h>
#include <vector>

#include <gtest/gtest.h>

#include "tests/apps/teren/Program.h"
#include "tests/support/TrialSize.h"

namespace teren {
namespace {

/// The plugins shipped, as a person has them.
Program::Settings shipped() {
  Program::Settings settings;
  settings.plugins = TEREN_PLUGINS;
  return settings;
}

/// Columns by name, of a table without quoted cells.
using Columns = std::map<std::string, std::vector<std::string>>;

Columns columnsOf(const std::filesystem::path& file) {
  std::istringstream lines(fileBytes(file));
  std::vector<std::string> names;
  Columns columns;
  for (std::string line; std::getline(lines, line);) {
    EXPECT_EQ(line.find('"'), std::string::npos) << line;
    std::vector<std::string> cells(1);
    for (const char c : line) {
      if (c == ',') cells.emplace_back();
      if (c != ',') cells.back() += c;
    }
    if (names.empty()) {
      names = cells;
      continue;
    }
    EXPECT_EQ(cells.size(), names.size()) << line;
    for (std::size_t k = 0; k < cells.size(); ++k) columns[names.at(k)].push_back(cells[k]);
  }
  return columns;
}

std::vector<double> numbers(const Columns& columns, const std::string& name) {
  std::vector<double> all;
  const auto found = columns.find(name);
  if (found == columns.end()) ADD_FAILURE() << "there is no column " << name;
  if (found == columns.end()) return all;
  for (const std::string& text : found->second) {
    std::size_t read = 0;
    all.push_back(std::stod(text, &read));
    EXPECT_EQ(read, text.size()) << name << ": " << text;
    EXPECT_TRUE(std::isfinite(all.back())) << name << ": " << text;
  }
  return all;
}

void expectAtLeast(const Columns& columns, const std::string& larger, const std::string& smaller) {
  const std::vector<double> a = numbers(columns, larger), b = numbers(columns, smaller);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k)
    EXPECT_GE(a[k], b[k]) << larger << ", " << smaller << ", row " << k;
}

void expectPositive(const Columns& columns, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    for (const double number : numbers(columns, name)) EXPECT_GT(number, 0.0) << name;
  }
}

/// Of fewer than a hundred values the 99th percentile would be the largest.
void expectEnoughForP99(const Columns& columns, const std::string& count) {
  for (const double number : numbers(columns, count)) EXPECT_GT(number, 100.0) << count;
}

void checkBlending(const std::filesystem::path& folder) {
  const Columns table = columnsOf(folder / "blending.csv");
  ASSERT_EQ(table.at("kernel").size(), 8U);
  expectPositive(table, {"time median [ns]", "patches", "crease places", "repetitions"});
  expectAtLeast(table, "time p99 [ns]", "time median [ns]");
  expectEnoughForP99(table, "repetitions");
  expectAtLeast(table, "crease max [degree]", "crease p99 [degree]");
  expectAtLeast(table, "crease p99 [degree]", "crease median [degree]");
  const std::vector<double> crease = numbers(table, "crease p99 [degree]"),
                            inside = numbers(table, "inside p99 [degree]");
  for (std::size_t k = 0; k < 8; ++k) {
    EXPECT_EQ(table.at("kernel")[k] == "linear", crease[k] > 5.0);
    EXPECT_EQ(table.at("kernel")[k] == "smooth", crease[k] < 0.01);
    EXPECT_LT(inside[k], 0.01);
  }
  EXPECT_EQ(columnsOf(folder / "blending-places.csv").at("world").size(), 8U * 15U);
}

void checkGenerators(const std::filesystem::path& folder) {
  const Columns table = columnsOf(folder / "generators.csv");
  const std::vector<std::string>& ids = table.at("generator");
  for (const char* id : {"circles", "constant", "fault", "midpoint", "noise", "slope", "spectral", "steps"}) {
    EXPECT_EQ(std::count(ids.begin(), ids.end(), id), 6) << id;
  }
  expectPositive(table, {"time median [ns]", "map [us]"});
  expectEnoughForP99(table, "repetitions");
  expectEnoughForP99(table, "maps");
  expectAtLeast(table, "time p99 [ns]", "time median [ns]");
  const std::vector<double> level = numbers(table, "level"),
                            promised = numbers(table, "residual promised [m]"),
                            truth = numbers(table, "residual true [m]");
  for (std::size_t k = 0; k < level.size(); ++k) {
    EXPECT_TRUE(level[k] > 0.0 || truth[k] == 0.0) << ids[k];
    if (level[k] > 3.0) continue;
    EXPECT_LE(truth[k], 1.5 * promised[k] + 1e-9) << ids[k] << ", level " << level[k];
    EXPECT_LE(promised[k], 1.5 * truth[k] + 1e-9) << ids[k] << ", level " << level[k];
  }
}

void checkDetail(const std::filesystem::path& folder) {
  const Columns table = columnsOf(folder / "detail.csv");
  std::vector<std::string> wanted = table.at("pixel error [px]");
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  EXPECT_EQ(wanted, (std::vector<std::string>{"0.25", "0.5", "1", "2", "4", "8", "16", "32"}));
  for (const auto& [name, cells] : table) numbers(table, name);
  expectPositive(table, {"view distance [m]", "nodes", "triangles", "choosing median [ms]",
                         "time to fill [s]", "places"});
  expectAtLeast(table, "choosing p99 [ms]", "choosing median [ms]");
  expectEnoughForP99(table, "repetitions");
  expectAtLeast(table, "promised max [px]", "promised p99 [px]");
  expectAtLeast(table, "promised max [px]", "true max [px]");
  expectAtLeast(table, "true max [px]", "true p99 [px]");
  expectAtLeast(table, "true p99 [px]", "true RMS [px]");
  expectAtLeast(table, "true max m [m]", "true p99 m [m]");
  expectAtLeast(table, "true p99 m [m]", "true RMS m [m]");
  for (const double share : numbers(table, "beyond promise [%]")) EXPECT_LE(share, 0.2);
}

void checkScheduling(const std::filesystem::path& folder) {
  const Columns table = columnsOf(folder / "scheduling.csv");
  for (const auto& [name, cells] : table) numbers(table, name);
  const std::vector<std::string>& workers = table.at("workers");
  EXPECT_GE(std::count(workers.begin(), workers.end(), "0"), 6);
  EXPECT_EQ(workers.size() % 6, 0U);
  expectPositive(table,
                 {"nodes a second [1/s]", "time to fill [s]", "update median [us]", "error median [px]"});
  expectEnoughForP99(table, "updates");
  expectEnoughForP99(table, "looks");
  expectAtLeast(table, "update max [us]", "update p99 [us]");
  expectAtLeast(table, "update p99 [us]", "update median [us]");
}

void checkTriangles(const std::filesystem::path& folder) {
  const Columns table = columnsOf(folder / "triangles.csv");
  for (const auto& [name, cells] : table) numbers(table, name);
  EXPECT_GE(table.at("error [m]").size(), 5U);
  for (const char* way : {"uniform error [m]", "chosen error [m]", "TIN error [m]"})
    expectAtLeast(table, "error [m]", way);
  expectAtLeast(table, "uniform triangles", "chosen triangles");
  expectPositive(table, {"TIN triangles", "TIN time [ms]"});
}

void checkNodeMeshes(const std::filesystem::path& folder) {
  const Columns table = columnsOf(folder / "node-meshes.csv");
  EXPECT_EQ(table.at("way").size(), 2U * 13U) << "two pixel errors; regular nodes and twelve kinds of meshes";
  expectPositive(table, {"nodes", "triangles", "memory [MiB]", "samples [us]", "nodes made [1/s]",
                         "nodes needed [1/s]", "budget needed [%]", "time to fill [s]"});
  const std::vector<double> meshing = numbers(table, "meshing [us]"),
                            shares = numbers(table, "regular / this");
  for (std::size_t row = 0; row < meshing.size(); ++row) {
    const bool isRegular = table.at("way")[row] == "regular grid";
    EXPECT_EQ(isRegular, meshing[row] == 0.0);
    EXPECT_TRUE(!isRegular || shares[row] == 1.0);
  }
}

/// The whole quick report, once for all that is asked of it.
TEST(ReportCommand, MeasuresEverythingAndPutsItIntoTablesPlotsAndAPage) {
  if (test::kSanitized && !test::isFull())
    GTEST_SKIP() << "tests/apps/report goes through all of it in little";
  const ScratchFolder folder;
  folder.write(
      "stats.json",
      R"({"frames": 100, "frame_ms": {"p50": 20.5, "p99": 33, "max": 60}, "triangles": 12345, "nodes": 67,
                   "engine_us": {"p50": 900, "p99": 2000, "max": 9}, "pixel_error": {"p99": 3.5, "max": 3.9}})");
  const std::filesystem::path report = folder / "new" / "report";
  Program program({"report", "--quick", "-o", report, "--frames", folder / "stats.json"}, shipped());
  const Answer answer = program.finish();
  ASSERT_EQ(answer.exitCode, 0) << answer.complaint;
  EXPECT_EQ(answer.output, "");
  EXPECT_EQ(answer.complaint, "") << "standard error is no terminal";
  EXPECT_TRUE(answer.left.empty());
  checkBlending(report);
  checkGenerators(report);
  checkDetail(report);
  checkScheduling(report);
  checkTriangles(report);
  checkNodeMeshes(report);
  EXPECT_EQ(columnsOf(report / "frames.csv").at("frame median [ms]"), std::vector<std::string>{"20.5"});
  const std::string page = fileBytes(report / "index.html");
  for (const char* part :
       {"<!DOCTYPE html>", "--quick", "LayerDescription::blend", "DetailSettings::pixelError",
        "kFlyingDetail", "teren flight --budget-us", "stats.json", "</html>"}) {
    EXPECT_NE(page.find(part), std::string::npos) << part;
  }
  for (const char* part : {"<script", "<link", "<img", "src=", "href=\"http", "href='http", "@import"}) {
    EXPECT_EQ(page.find(part), std::string::npos) << part;
  }
  std::size_t drawn = 0;
  for (const std::string& name : namesIn(report)) {
    EXPECT_EQ(name.find(".part"), std::string::npos) << name;
    if (name.ends_with(".svg")) ++drawn;
  }
  const char* const expected =
      drawn == 0 ? "There are no plots here, because gnuplot cannot be started" : "<svg";
  EXPECT_NE(page.find(expected), std::string::npos);
}

TEST(ReportCommand, StopsWhenAskedToAndLeavesNothing) {
  const ScratchFolder folder;
  for (const int signal : {SIGINT, SIGTERM}) {
    Program program({"report", "-o", folder / "new" / "folders" / "report"}, shipped());
    ASSERT_TRUE(program.waitUntilItCatches(signal));
    usleep(500'000);
    program.signal(signal);
    const Answer answer = program.finish();
    EXPECT_EQ(answer.exitCode, 1);
    EXPECT_EQ(answer.complaint, "teren: interrupted\n");
    EXPECT_TRUE(answer.left.empty());
    EXPECT_TRUE(namesIn(folder.path()).empty()) << "not even the folders it made";
  }
}

TEST(ReportCommand, KeepsAReportThatIsThereWhenItIsInterrupted) {
  const ScratchFolder folder;
  folder.write("index.html", "an older one");
  Program program({"report", "-o", folder.path()}, shipped());
  ASSERT_TRUE(program.waitUntilItCatches(SIGINT));
  program.signal(SIGINT);
  EXPECT_EQ(program.finish().exitCode, 1);
  EXPECT_EQ(namesIn(folder.path()), std::vector<std::string>{"index.html"});
  EXPECT_EQ(fileBytes(folder / "index.html"), "an older one");
}

TEST(ReportCommand, RefusesWhatItCannotDoWithOneSentence) {
  const ScratchFolder folder;
  folder.write("file", "no folder");
  folder.write("bad.json", "{}");
  const std::vector<std::pair<Arguments, std::string>> hostile{
      {{"report"}, "-o"},
      {{"report", "--quick"}, "-o"},
      {{"report", "-o"}, "-o"},
      {{"report", "-o", ""}, "folder"},
      {{"report", "-o", "a", "-o", "b"}, "-o"},
      {{"report", "-o", "a", "more"}, "more"},
      {{"report", "--quick=5", "-o", "a"}, "quick"},
      {{"report", "--qick", "-o", "a"}, "--qick"},
      {{"report", "-o", folder / "file"}, "file"},
      {{"report", "-o", folder / "file" / "below"}, "file"},
      {{"report", "-o", "/proc/no/such"}, "/proc/no/such"},
      {{"report", "-o", "a", "--frames"}, "--frames"},
      {{"report", "-o", "a", "--frames", ""}, "\"\""},
      {{"report", "-o", "a", "--frames", folder / "nowhere"}, "nowhere"},
      {{"report", "-o", "a", "--frames", folder / "bad.json"}, "bad.json"},
      {{"report", "-o", "a", "--frames", folder.path()}, "not a file"}};
  for (const auto& [arguments, named] : hostile) {
    const Answer answer = teren(arguments);
    EXPECT_EQ(answer.exitCode, 2) << arguments.back();
    EXPECT_EQ(answer.output, "");
    EXPECT_TRUE(isOneSentence(answer.complaint)) << answer.complaint;
    EXPECT_NE(answer.complaint.find(named), std::string::npos) << answer.complaint;
    EXPECT_TRUE(answer.left.empty()) << arguments.back();
  }
}

}  // namespace
}  // namespace teren
