// Runs coin-only, a program that knows nothing of Teren, and compares what it says with what Teren knows.
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <unistd.h>

#include <Inventor/SoPath.h>
#include <Inventor/actions/SoSearchAction.h>
#include <gtest/gtest.h>

#include "teren/Engine.h"

#include "coin/SoTerrain.h"
#include "tests/coin/Stage.h"

namespace teren {
namespace {

namespace fs = std::filesystem;

TEST(SoTerrainLibrary, ServesAProgramThatIsLinkedToInventorAlone) {
  const fs::path written = fs::temp_directory_path() / ("coin-only-" + std::to_string(getpid()) + ".iv");
  const std::string command = "LD_LIBRARY_PATH=" TEREN_LIBRARY_FOLDER " " COIN_ONLY_PROGRAM
                              " " TEREN_LAND_FILE " " +
                              written.string();
  FILE* output = popen(command.c_str(), "r");
  ASSERT_NE(output, nullptr);
  int drawn = 0, pixels = 0, colors = 0;
  EXPECT_EQ(std::fscanf(output, "drawn %d of %d pixels in %d colors\n", &drawn, &pixels, &colors), 3);
  std::array<double, 3> picked{};
  EXPECT_EQ(std::fscanf(output, "picked %lf %lf %lf\n", &picked[0], &picked[1], &picked[2]), 3);
  std::array<double, 6> box{};
  EXPECT_EQ(std::fscanf(output, "box %lf %lf %lf to %lf %lf %lf\n", &box[0], &box[1], &box[2], &box[3],
                        &box[4], &box[5]),
            6);
  std::array<char, 100> library{};
  EXPECT_EQ(std::fscanf(output, "loaded %99s\n", library.data()), 1);
  EXPECT_EQ(pclose(output), 0);
  EXPECT_STREQ(library.data(), "libSoTerrain.so");

  EXPECT_EQ(drawn, pixels) << "no background shines through the ground";
  EXPECT_GT(colors, 100);

  const Stage stage;
  stage.terrain->seed = "42";
  stage.terrain->settle();
  const World& world = stage.terrain->engine()->world();
  const auto height = stage.terrain->engine()->drawnHeight(*Position::fromMetres(10.0, 20.0, world.pitch()));
  ASSERT_TRUE(height.has_value());
  EXPECT_NEAR(picked[0], 10.0, 2e-3);
  EXPECT_NEAR(picked[1], 20.0, 2e-3);
  EXPECT_NEAR(picked[2], *height, 2e-3);

  const double reach = static_cast<double>(stage.terrain->viewDistance.getValue());
  for (int axis = 0; axis < 2; ++axis) {
    EXPECT_LT(box[static_cast<std::size_t>(axis)], -reach);
    EXPECT_GT(box[static_cast<std::size_t>(axis + 3)], reach);
  }
  EXPECT_LT(box[2], picked[2]);
  EXPECT_GT(box[5], picked[2]);

  std::ifstream stream(written);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_EQ(text.find("SoTerrainMesh"), std::string::npos) << text;
  SoNode* again = readScene(text);
  SoSearchAction search;
  search.setType(SoTerrain::getClassTypeId());
  search.apply(again);
  ASSERT_NE(search.getPath(), nullptr) << text;
  EXPECT_STREQ(static_cast<SoTerrain*>(search.getPath()->getTail())->seed.getValue().getString(), "42");
  again->unref();
  fs::remove(written);
}

}  // namespace
}  // namespace teren
