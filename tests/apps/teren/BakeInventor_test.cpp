// What `teren bake -o FILE.iv` writes, read by Open Inventor itself.
#include <algorithm>
#include <bit>

#include <Inventor/SoDB.h>
#include <Inventor/SoInput.h>
#include <Inventor/SoPrimitiveVertex.h>
#include <Inventor/actions/SoCallbackAction.h>
#include <Inventor/actions/SoSearchAction.h>
#include <Inventor/nodes/SoCoordinate3.h>
#include <Inventor/nodes/SoNormal.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoShape.h>
#include <gtest/gtest.h>

#include "tests/apps/teren/BakedFiles.h"

namespace teren {
namespace {

/// A scene read from a file.
class Inventor {
 public:
  explicit Inventor(const std::filesystem::path& file) {
    SoDB::init();
    SoInput input;
    if (!input.openFile(file.c_str())) return;
    root_ = SoDB::readAll(&input);
    if (root_ != nullptr) root_->ref();
  }
  ~Inventor() {
    if (root_ != nullptr) root_->unref();
  }
  Inventor(const Inventor&) = delete;
  Inventor& operator=(const Inventor&) = delete;

  SoNode* root() const { return root_; }
  template <class Node>
  const Node* find() const {
    SoSearchAction search;
    search.setType(Node::getClassTypeId());
    search.apply(root_);
    return search.getPath() != nullptr ? static_cast<const Node*>(search.getPath()->getTail()) : nullptr;
  }

 private:
  SoSeparator* root_ = nullptr;
};

using Triangle = std::array<std::size_t, 3>;

/// The triangles as Open Inventor draws them, their vertices named by place in a grid so many columns wide.
std::vector<Triangle> drawnTriangles(SoNode* root, std::size_t columns, double spacing) {
  struct Found {
    std::size_t columns;
    double spacing;
    std::vector<Triangle> triangles;
  } found{columns, spacing, {}};
  SoCallbackAction action;
  action.addTriangleCallback(
      SoShape::getClassTypeId(),
      [](void* data, SoCallbackAction*, const SoPrimitiveVertex* a, const SoPrimitiveVertex* b,
         const SoPrimitiveVertex* c) {
        auto& into = *static_cast<Found*>(data);
        const auto place = [&](const SoPrimitiveVertex* vertex) {
          const SbVec3f& point = vertex->getPoint();
          return static_cast<std::size_t>(point[1] / into.spacing) * into.columns +
                 static_cast<std::size_t>(point[0] / into.spacing);
        };
        into.triangles.push_back(rotated({place(a), place(b), place(c)}));
      },
      &found);
  action.apply(root);
  return found.triangles;
}

TEST(BakeInventor, GivesEveryHeightBackToTheBit) {
  const ScratchFolder folder;
  bakeJson(folder / "a.r32");
  bakeJson(folder / "a.iv");
  const std::vector<float> heights = readR32(folder / "a.r32");
  const Inventor scene(folder / "a.iv");
  ASSERT_NE(scene.root(), nullptr);
  const auto* coordinates = scene.find<SoCoordinate3>();
  ASSERT_NE(coordinates, nullptr);
  ASSERT_EQ(coordinates->point.getNum(), 97 * 65);
  ASSERT_EQ(heights.size(), 97U * 65U);
  for (int k = 0; k < 97 * 65; ++k) {
    const SbVec3f& point = coordinates->point[k];
    ASSERT_EQ(point[0], 2.0F * static_cast<float>(k % 97));
    ASSERT_EQ(point[1], 2.0F * static_cast<float>(k / 97));
    ASSERT_EQ(std::bit_cast<std::uint32_t>(point[2]),
              std::bit_cast<std::uint32_t>(heights[static_cast<std::size_t>(k)]));
  }
}

TEST(BakeInventor, DrawsEveryQuadSplitFromSouthWestToNorthEast) {
  const ScratchFolder folder;
  bakeJson(folder / "a.iv");
  const Inventor scene(folder / "a.iv");
  ASSERT_NE(scene.root(), nullptr);
  std::vector<Triangle> drawn = drawnTriangles(scene.root(), 97, 2.0);
  std::vector<Triangle> expected = gridTriangles(97, 65);
  std::sort(drawn.begin(), drawn.end());
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(drawn, expected);
}

TEST(BakeInventor, HasANormalForEveryVertex) {
  const ScratchFolder folder;
  bakeJson(folder / "a.iv");
  const Inventor scene(folder / "a.iv");
  ASSERT_NE(scene.root(), nullptr);
  const auto* normals = scene.find<SoNormal>();
  ASSERT_NE(normals, nullptr);
  ASSERT_EQ(normals->vector.getNum(), 97 * 65);
  for (int k = 0; k < 97 * 65; ++k) {
    ASSERT_NEAR(normals->vector[k].length(), 1.0F, 2e-4F);
    ASSERT_GT(normals->vector[k][2], 0.0F);
  }
}

TEST(BakeInventor, TellsWhereItsCornerIs) {
  const ScratchFolder folder;
  bakeJson(folder / "a.iv");
  const std::string text = fileBytes(folder / "a.iv");
  EXPECT_TRUE(text.starts_with("#Inventor V2.1 ascii\n"));
  EXPECT_NE(text.find("x = -64 m, y = 128 m of the world: the corner of patch (-1, 2)"), std::string::npos);
}

}  // namespace
}  // namespace teren
