// A piece of landscape that the tests of `teren bake` agree on, and how its files are read back.
#pragma once

#include <array>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/apps/teren/Program.h"

namespace teren {

/// 3 x 2 patches of the fault generator, 97 x 65 heights 2 m apart at level 0, from (-64, 128) [m] on.
inline Arguments bakeFault(const std::string& file, const Arguments& added = {}) {
  Arguments all = {"bake", "--generator", "fault", "--seed", "9",  "--patches",
                   "-1",   "2",           "3",     "2",      "-o", file};
  all.insert(all.end(), added.begin(), added.end());
  return all;
}

inline nlohmann::json bakeJson(const std::string& file, const Arguments& added = {}) {
  Arguments all = bakeFault(file, added);
  all.push_back("--json");
  const Answer answer = teren(all);
  EXPECT_EQ(answer.exitCode, 0) << answer.complaint;
  EXPECT_EQ(answer.complaint, "");
  return nlohmann::json::parse(answer.output);
}

inline std::vector<float> readR32(const std::filesystem::path& file) {
  const std::string bytes = fileBytes(file);
  std::vector<float> heights(bytes.size() / 4);
  std::memcpy(heights.data(), bytes.data(), heights.size() * 4);
  return heights;
}

/// The triangles of a grid of vertices counted row by row from the south-west: (SW, SE, NE) and (SW, NE, NW)
/// of every quad, anticlockwise.
inline std::vector<std::array<std::size_t, 3>> gridTriangles(std::size_t columns, std::size_t rows) {
  std::vector<std::array<std::size_t, 3>> triangles;
  for (std::size_t row = 0; row + 1 < rows; ++row) {
    for (std::size_t column = 0; column + 1 < columns; ++column) {
      const std::size_t southWest = row * columns + column, northWest = southWest + columns;
      triangles.push_back({southWest, southWest + 1, northWest + 1});
      triangles.push_back({southWest, northWest + 1, northWest});
    }
  }
  return triangles;
}

/// The same triangle, beginning with its smallest number.
inline std::array<std::size_t, 3> rotated(std::array<std::size_t, 3> triangle) {
  while (triangle[0] > triangle[1] || triangle[0] > triangle[2]) {
    triangle = {triangle[1], triangle[2], triangle[0]};
  }
  return triangle;
}

}  // namespace teren
