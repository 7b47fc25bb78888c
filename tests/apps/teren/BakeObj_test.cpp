// What `teren bake -o FILE.obj` writes, read as a modelling program would.
#include <bit>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include <gtest/gtest.h>

#include "tests/apps/teren/BakedFiles.h"

namespace teren {
namespace {

struct Obj {
  std::string comment;
  std::vector<std::array<std::string, 3>> vertices, normals;
  std::vector<std::array<std::size_t, 3>> triangles;  // counted from 0
};

/// The three words of a line, and no more.
std::array<std::string, 3> threeWords(std::istringstream& line) {
  std::array<std::string, 3> words;
  std::string fourth;
  EXPECT_TRUE(line >> words[0] >> words[1] >> words[2]);
  EXPECT_FALSE(line >> fourth);
  return words;
}

/// "7//7": vertex and normal, the same number; counted from 0.
std::size_t cornerNumber(const std::string& word) {
  const std::size_t slashes = word.find("//");
  EXPECT_NE(slashes, std::string::npos) << word;
  EXPECT_EQ(word.substr(0, slashes), word.substr(slashes + 2));
  return std::stoul(word) - 1;
}

Obj readObj(const std::filesystem::path& file) {
  Obj obj;
  std::istringstream text(fileBytes(file));
  for (std::string wholeLine; std::getline(text, wholeLine);) {
    std::istringstream line(wholeLine);
    std::string key;
    line >> key;
    if (key == "#") {
      obj.comment += wholeLine + "\n";
    } else if (key == "v") {
      obj.vertices.push_back(threeWords(line));
    } else if (key == "vn") {
      obj.normals.push_back(threeWords(line));
    } else if (key == "f") {
      const auto words = threeWords(line);
      obj.triangles.push_back({cornerNumber(words[0]), cornerNumber(words[1]), cornerNumber(words[2])});
    } else {
      EXPECT_EQ(key, "o") << "no such line in an .obj file: " << wholeLine;
    }
  }
  return obj;
}

double number(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  EXPECT_EQ(*end, '\0') << text;
  return value;
}

TEST(BakeObj, GivesEveryHeightBackToTheBit) {
  const ScratchFolder folder;
  bakeJson(folder / "a.r32");
  bakeJson(folder / "a.obj");
  const std::vector<float> heights = readR32(folder / "a.r32");
  const Obj obj = readObj(folder / "a.obj");
  ASSERT_EQ(heights.size(), 97U * 65U);
  ASSERT_EQ(obj.vertices.size(), heights.size());
  for (std::size_t k = 0; k < heights.size(); ++k) {
    ASSERT_EQ(number(obj.vertices[k][0]), 2.0 * static_cast<double>(k % 97));
    ASSERT_EQ(number(obj.vertices[k][1]), 2.0 * static_cast<double>(k / 97));
    ASSERT_EQ(std::bit_cast<std::uint32_t>(std::strtof(obj.vertices[k][2].c_str(), nullptr)),
              std::bit_cast<std::uint32_t>(heights[k]))
        << obj.vertices[k][2];
  }
}

TEST(BakeObj, SplitsEveryQuadFromSouthWestToNorthEast) {
  const ScratchFolder folder;
  bakeJson(folder / "a.obj");
  EXPECT_EQ(readObj(folder / "a.obj").triangles, gridTriangles(97, 65));
}

TEST(BakeObj, TurnsItsNormalsAsTheHeightsSlope) {
  const ScratchFolder folder;
  bakeJson(folder / "a.r32");
  bakeJson(folder / "a.obj");
  const std::vector<float> heights = readR32(folder / "a.r32");
  const Obj obj = readObj(folder / "a.obj");
  ASSERT_EQ(obj.normals.size(), heights.size());
  for (std::size_t k = 0; k < heights.size(); ++k) {
    const std::size_t column = k % 97, row = k / 97;
    const std::size_t west = column > 0 ? k - 1 : k, east = column < 96 ? k + 1 : k;
    const std::size_t south = row > 0 ? k - 97 : k, north = row < 64 ? k + 97 : k;
    const double x = number(obj.normals[k][0]), y = number(obj.normals[k][1]), z = number(obj.normals[k][2]);
    ASSERT_NEAR(x * x + y * y + z * z, 1.0, 3e-4);
    const double alongX = 2.0 * static_cast<double>(east - west),
                 alongY = 2.0 * static_cast<double>(north - south) / 97.0;
    const double eastRise = heights[east] - heights[west], northRise = heights[north] - heights[south];
    ASSERT_NEAR(x * alongX + z * eastRise, 0.0, 1e-4 * (alongX + std::fabs(eastRise))) << k;
    ASSERT_NEAR(y * alongY + z * northRise, 0.0, 1e-4 * (alongY + std::fabs(northRise))) << k;
  }
}

TEST(BakeObj, CountsFromItsCornerAndTellsWhereThatIs) {
  const ScratchFolder folder;
  const Answer answer = teren({"bake", "--generator", "fault", "--patches", "-1099511627776", "1099511627775",
                               "1", "1", "--level", "3", "-o", folder / "a.obj"});
  ASSERT_EQ(answer.exitCode, 0) << answer.complaint;
  const Obj obj = readObj(folder / "a.obj");
  ASSERT_EQ(obj.vertices.size(), 25U);
  EXPECT_EQ(obj.vertices.front()[0], "0");
  EXPECT_EQ(obj.vertices.front()[1], "0");
  EXPECT_EQ(obj.vertices.back()[0], "64");
  EXPECT_EQ(obj.vertices.back()[1], "64");
  for (const char* part : {"patch (-1099511627776, 1099511627775)", "x = -70368744177664 m",
                           "y = 70368744177600 m", "pitch 64 m", "5 x 5 heights, 16 m apart"}) {
    EXPECT_NE(obj.comment.find(part), std::string::npos) << part << "\n" << obj.comment;
  }
}

TEST(BakeObj, KnowsOnlyOneZero) {
  const ScratchFolder folder;
  const Answer answer = teren({"bake", "--generator", "flat", "--set", "height=-0", "--patches", "0", "0",
                               "1", "1", "-o", folder / "a.obj"});
  ASSERT_EQ(answer.exitCode, 0) << answer.complaint;
  for (const auto& vertex : readObj(folder / "a.obj").vertices) ASSERT_EQ(vertex[2], "0");
}

}  // namespace
}  // namespace teren
