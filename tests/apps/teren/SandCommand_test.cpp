// The table of teren sand, and what it refuses.
#include <algorithm>
#include <sstream>
#include <string>
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
    EXPECT_GT(cell(table, row, "stamps"), 5.0);
    EXPECT_GT(cell(table, row, "slide_steps"), 1000.0);
    EXPECT_GT(cell(table, row, "moved_m3"), 0.001);
    EXPECT_LT(cell(table, row, "drift"), 1e-12);
    EXPECT_GT(cell(table, row, "bytes_per_vertex"), 70.0);
    EXPECT_EQ(cell(table, row, "grid_side"), 483.0);
  }
  EXPECT_GT(cell(table, 1, "grid_bytes"), 8.0 * cell(table, 1, "bytes")) << "a grid as fine is far larger";
  EXPECT_EQ(cell(table, 1, "vertices"), 1000.0);
  EXPECT_EQ(cell(table, 2, "vertices"), 3000.0);
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
