// What must be true of pictures of sand.
#include "apps/sandbox/SandScene.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include <Inventor/SbViewportRegion.h>
#include <Inventor/SoPickedPoint.h>
#include <Inventor/actions/SoGetBoundingBoxAction.h>
#include <Inventor/actions/SoGetPrimitiveCountAction.h>
#include <Inventor/actions/SoRayPickAction.h>
#include <Inventor/nodes/SoCube.h>
#include <Inventor/nodes/SoPerspectiveCamera.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoTranslation.h>
#include <QColor>
#include <QImage>
#include <gtest/gtest.h>

#include "teren/Hash.h"

#include "generators/sand/LevelSand.h"
#include "generators/sand/SandPublisher.h"
#include "tests/coin/OffscreenView.h"

namespace teren {
namespace {

const SbColor kMagenta(1.0F, 0.0F, 1.0F);

bool isBackground(QRgb pixel) {
  return pixel == qRgb(255, 0, 255);
}
/// The colour of constrained edges, whatever is below them.
bool isRed(QRgb pixel) {
  return qRed(pixel) > 180 && qGreen(pixel) < 70 && qBlue(pixel) < 70;
}
/// And of a tool's outline.
bool isBlue(QRgb pixel) {
  return qBlue(pixel) > qRed(pixel) + 60 && qBlue(pixel) > qGreen(pixel) + 30;
}

int countPixels(const QImage& picture, const std::function<bool(QRgb)>& wanted) {
  int count = 0;
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) count += wanted(picture.pixel(x, y)) ? 1 : 0;
  }
  return count;
}

/// Mean brightness [0, 255] of a part of a picture, given in shares of its sides.
double brightness(const QImage& picture, double left, double top, double right, double bottom) {
  double sum = 0.0;
  int count = 0;
  for (int y = static_cast<int>(top * picture.height()); y < static_cast<int>(bottom * picture.height());
       ++y) {
    for (int x = static_cast<int>(left * picture.width()); x < static_cast<int>(right * picture.width());
         ++x) {
      sum += qGray(picture.pixel(x, y));
      ++count;
    }
  }
  return sum / count;
}
double brightness(const QImage& picture) {
  return brightness(picture, 0.0, 0.0, 1.0, 1.0);
}

/// How much neighbouring pixels differ on average [0, 255].
double roughness(const QImage& picture) {
  double sum = 0.0;
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 1; x < picture.width(); ++x) {
      sum += std::abs(qGray(picture.pixel(x, y)) - qGray(picture.pixel(x - 1, y)));
    }
  }
  return sum / (picture.height() * (picture.width() - 1));
}

class WithoutShaders {
 public:
  WithoutShaders() { setenv("TEREN_NO_SHADERS", "1", 1); }
  ~WithoutShaders() { unsetenv("TEREN_NO_SHADERS"); }
  WithoutShaders(const WithoutShaders&) = delete;
  WithoutShaders& operator=(const WithoutShaders&) = delete;
};

/// A metre of sand, a camera, and what may lie beside.
class Beach {
 public:
  explicit Beach(int vertices = 4'000, double loose = 0.2) : sandbox(levelSand(vertices, loose, 100), {}) {
    root->ref();
    camera->nearDistance = 0.01F;
    camera->farDistance = 40.0F;
    root->addChild(camera);
    root->addChild(scene.node());
    show();
  }
  ~Beach() { root->unref(); }
  Beach(const Beach&) = delete;
  Beach& operator=(const Beach&) = delete;

  std::shared_ptr<const SandSnapshot> show() {
    std::shared_ptr<const SandSnapshot> snapshot = publisher.publish(sandbox);
    scene.show(snapshot);
    return snapshot;
  }
  /// A furrow from west to east through the middle, at rest.
  void dig() {
    const ToolShape tool = *ToolShape::disc(0.05, 0.05);
    for (const StampPlace& place : stampsAlong({0.2, 0.5, 0.0}, {0.8, 0.5, 0.0}, 0.02)) {
      ASSERT_TRUE(sandbox.stamp(tool, place));
      sandbox.iterate(20'000);
    }
    show();
  }
  void lookDown(double x, double y, double from) const {
    camera->position = SbVec3f(static_cast<float>(x), static_cast<float>(y), static_cast<float>(from));
    camera->orientation = SbRotation::identity();
  }
  void look(const SbVec3f& from, const SbVec3f& to) const {
    camera->position = from;
    camera->pointAt(to, SbVec3f(0.0F, 0.0F, 1.0F));
  }

  Sandbox sandbox;
  SandPublisher publisher;
  SandScene scene;
  SoSeparator* root = new SoSeparator;
  SoPerspectiveCamera* camera = new SoPerspectiveCamera;
};

TEST(SandScene, ShowsAFurrowByItsLightAndItsDarkSlope) {
  Beach beach;
  OffscreenView view(200, 200);
  beach.lookDown(0.5, 0.5, 0.6);
  const QImage level = view.picture(beach.root, kMagenta);
  beach.dig();
  const QImage dug = view.picture(beach.root, kMagenta);
  EXPECT_EQ(countPixels(level, isBackground), 0);
  // The sun is in the south-west: it shines on slopes that fall to the south.
  const double before = brightness(level), north = brightness(dug, 0.3, 0.40, 0.7, 0.47),
               south = brightness(dug, 0.3, 0.53, 0.7, 0.60);
  EXPECT_GT(north, before + 5.0);
  EXPECT_LT(south, before - 25.0);
  EXPECT_NEAR(brightness(dug, 0.3, 0.0, 0.7, 0.1), before, 4.0) << "far from the furrow nothing changes";
}

TEST(SandScene, ShowsConstrainedEdgesInRedInWireframeOnly) {
  for (const bool shaders : {true, false}) {
    const std::optional<WithoutShaders> without =
        shaders ? std::nullopt : std::make_optional<WithoutShaders>();
    Beach beach(2'000);
    OffscreenView view(200, 200);
    beach.lookDown(0.5, 0.5, 1.0);
    beach.scene.setWireframe(true);
    EXPECT_EQ(countPixels(view.picture(beach.root, kMagenta), isRed), 0) << "nothing is constrained";
    ASSERT_TRUE(beach.sandbox.stamp(*ToolShape::square(0.3, 0.01), {0.5, 0.5, 0.0}));
    beach.show();
    const QImage wire = view.picture(beach.root, kMagenta);
    EXPECT_GT(countPixels(wire, isRed), 400);
    EXPECT_GT(roughness(wire), 8.0) << "edges in sight";
    beach.scene.setWireframe(false);
    EXPECT_EQ(countPixels(view.picture(beach.root, kMagenta), isRed), 0);
  }
}

TEST(SandScene, NeverShowsTheBackgroundThroughTheGround) {
  Beach beach(3'000);
  beach.dig();
  OffscreenView view(160, 160);
  RandomSequence random(7);
  const auto unit = [&] { return static_cast<double>(random.nextBits(24)) * 0x1p-24; };
  for (int n = 0; n < 60; ++n) {
    beach.lookDown(0.3 + 0.4 * unit(), 0.3 + 0.4 * unit(), 0.08 + 0.2 * unit());
    EXPECT_EQ(countPixels(view.picture(beach.root, kMagenta), isBackground), 0) << n;
  }
}

TEST(SandScene, IsABlockFromBeside) {
  for (const bool shaders : {true, false}) {
    const std::optional<WithoutShaders> without =
        shaders ? std::nullopt : std::make_optional<WithoutShaders>();
    Beach beach(3'000);
    OffscreenView view(120, 120);
    for (const SbVec3f& from : {SbVec3f(0.5F, -1.0F, 0.0F), SbVec3f(2.0F, 0.5F, 0.0F),
                                SbVec3f(0.5F, 2.0F, 0.0F), SbVec3f(-1.0F, 0.5F, 0.0F)}) {
      beach.look(from, {0.5F, 0.5F, 0.0F});
      // A twentieth of a metre from a metre away is 7.2 pixels high.
      const QImage picture = view.picture(beach.root, kMagenta);
      EXPECT_EQ(countPixels(picture.copy(20, 61, 80, 6), isBackground), 0);
      EXPECT_EQ(countPixels(picture.copy(20, 69, 80, 40), isBackground), 80 * 40);
    }
  }
}

TEST(SandScene, LooksAboutTheSameWithoutShaders) {
  Beach beach;
  beach.dig();
  beach.look({0.5F, -0.4F, 0.6F}, {0.5F, 0.5F, 0.0F});
  QImage with, without;
  {
    OffscreenView view(240, 160);
    with = view.picture(beach.root, kMagenta);
  }
  {
    const WithoutShaders plain;
    OffscreenView view(240, 160);
    without = view.picture(beach.root, kMagenta);
  }
  int compared = 0;
  for (int y = 0; y < 160; y += 16) {
    for (int x = 0; x < 240; x += 16) {
      const QImage a = with.copy(x, y, 16, 16), b = without.copy(x, y, 16, 16);
      ASSERT_NEAR(countPixels(a, isBackground), countPixels(b, isBackground), 6) << x << ", " << y;
      if (countPixels(a, isBackground) > 0) continue;
      EXPECT_NEAR(brightness(a), brightness(b), 14.0) << x << ", " << y;
      ++compared;
    }
  }
  EXPECT_GT(compared, 40);
}

TEST(SandScene, HasGrainThatIsFineNearAndGoneFarAway) {
  const Beach beach;
  OffscreenView view(200, 200);
  for (const double height : {0.03, 0.06, 0.1, 0.2}) {
    beach.lookDown(0.5, 0.5, height);
    const QImage near = view.picture(beach.root, kMagenta);
    EXPECT_GT(roughness(near), 3.0) << height;
    const QImage blurred = near.scaled(20, 20, Qt::IgnoreAspectRatio, Qt::SmoothTransformation);
    EXPECT_LT(roughness(blurred), 0.55 * roughness(near))
        << "grain is finer than ten pixels, from " << height;
  }
  beach.lookDown(0.5, 0.5, 4.0);
  EXPECT_LT(roughness(view.picture(beach.root, kMagenta).copy(90, 90, 20, 20)), 1.0);
}

TEST(SandScene, KeepsItsGrainInPlaceWhenTheEyeMoves) {
  const Beach beach;
  OffscreenView view(200, 200);
  beach.lookDown(0.5, 0.5, 0.1);
  const QImage here = view.picture(beach.root, kMagenta);
  // A pixel is 0.1 m * 2 tan(22.5 degrees) / 200 wide.
  const double pixel = 0.1 * 2.0 * (std::sqrt(2.0) - 1.0) / 200.0;
  beach.lookDown(0.5 + 10.0 * pixel, 0.5, 0.1);
  const QImage there = view.picture(beach.root, kMagenta);
  double moved = 0.0, still = 0.0;
  for (int y = 50; y < 150; ++y) {
    for (int x = 50; x < 150; ++x) {
      moved += std::abs(qGray(here.pixel(x + 10, y)) - qGray(there.pixel(x, y)));
      still += std::abs(qGray(here.pixel(x, y)) - qGray(there.pixel(x, y)));
    }
  }
  EXPECT_LT(moved, 0.2 * still);
}

TEST(SandScene, IsDarkerWhereItIsWet) {
  for (const bool shaders : {true, false}) {
    const std::optional<WithoutShaders> without =
        shaders ? std::nullopt : std::make_optional<WithoutShaders>();
    Beach beach(500);
    OffscreenView view(100, 100);
    beach.lookDown(0.5, 0.5, 0.6);
    const double dry = brightness(view.picture(beach.root, kMagenta));
    beach.scene.setMoisture(0.5);
    const double damp = brightness(view.picture(beach.root, kMagenta));
    beach.scene.setMoisture(1.0);
    const double wet = brightness(view.picture(beach.root, kMagenta));
    EXPECT_LT(damp, 0.85 * dry);
    EXPECT_LT(wet, 0.85 * damp);
    beach.scene.setMoisture(7.0);
    EXPECT_EQ(brightness(view.picture(beach.root, kMagenta)), wet);
    beach.scene.setMoisture(std::nan(""));
    EXPECT_EQ(brightness(view.picture(beach.root, kMagenta)), dry);
  }
}

TEST(SandScene, TellsLooseSandFromSolidGround) {
  for (const bool shaders : {true, false}) {
    const std::optional<WithoutShaders> without =
        shaders ? std::nullopt : std::make_optional<WithoutShaders>();
    const Beach loose(500, 0.2), solid(500, 0.0);
    OffscreenView view(100, 100);
    loose.lookDown(0.5, 0.5, 0.6);
    solid.lookDown(0.5, 0.5, 0.6);
    EXPECT_GT(brightness(view.picture(loose.root, kMagenta)),
              brightness(view.picture(solid.root, kMagenta)) + 30.0);
  }
}

TEST(SandScene, UploadsOnlyPagesThatChanged) {
  Beach beach(30'000);
  OffscreenView view(100, 100);
  beach.lookDown(0.5, 0.5, 1.0);
  view.draw(beach.root, kMagenta);
  const std::size_t all = beach.scene.uploadedBytes();
  EXPECT_GE(all, std::size_t{30'000} * 20 + std::size_t{60'000} * 12);
  EXPECT_GE(beach.scene.bufferBytes(), all);
  EXPECT_LT(beach.scene.bufferBytes(), all + all / 4);
  view.draw(beach.root, kMagenta);
  EXPECT_EQ(beach.scene.uploadedBytes(), all) << "nothing has changed";
  const auto before = beach.show();
  ASSERT_TRUE(beach.sandbox.stamp(*ToolShape::disc(0.02, 0.01), {0.5, 0.5, 0.0}));
  const auto after = beach.show();
  std::size_t changed = 0;
  after->vertexPages().forEachDifference(before->vertexPages(),
                                         [&](std::size_t) { changed += sizeof(SandVertexPage); });
  after->trianglePages().forEachDifference(before->trianglePages(),
                                           [&](std::size_t) { changed += 12 * SandTrianglePage::kSlots; });
  view.draw(beach.root, kMagenta);
  EXPECT_EQ(beach.scene.uploadedBytes(), all + changed);
  EXPECT_LT(changed, all / 10);
}

TEST(SandScene, ShowsTheSameInABufferThatHasGrownAndInANewOne) {
  Beach beach(3'000);
  OffscreenView view(120, 120);
  beach.lookDown(0.5, 0.5, 1.2);
  view.draw(beach.root, kMagenta);
  const std::size_t small = beach.scene.bufferBytes();
  std::size_t before = 0;
  for (int n = 0; n < 400 && beach.scene.bufferBytes() == small; ++n) {
    const double x = 0.8 + 0.01 * (n % 12), y = 0.8 + 0.01 * (n / 12 % 12);
    ASSERT_TRUE(beach.sandbox.stamp(*ToolShape::disc(0.02, 0.01, 64), {x, y, 0.0}));
    beach.show();
    before = beach.scene.uploadedBytes();
    view.draw(beach.root, kMagenta);
  }
  ASSERT_GT(beach.scene.bufferBytes(), small);
  EXPECT_GT(beach.scene.uploadedBytes() - before, std::size_t{3'000} * 20) << "all vertices again";
  const QImage grown = view.picture(beach.root, kMagenta);
  OffscreenView other(120, 120);
  EXPECT_EQ(grown, other.picture(beach.root, kMagenta));
}

/// A patch of a metre in the middle of a box, so small that most of it is published as the same pages
/// whatever the box's height is.
Sandbox patchOfThinSand(std::int32_t height) {
  LatticeFrame frame;
  frame.step = 0x1p-10;
  frame.width = std::int32_t{1} << 20;
  frame.height = height;
  RandomSequence random(11);
  std::vector<LatticePoint> points;
  for (int n = 0; n < 3'000; ++n) {
    const auto x = (1 << 19) + static_cast<std::int32_t>(random.nextBits(10));
    points.push_back({x, (1 << 19) + static_cast<std::int32_t>(random.nextBits(10))});
  }
  const std::vector<double> heights(points.size(), 0.0);
  return Sandbox(SandSurface(frame, points, heights, 2.0), {});
}

TEST(SandScene, ShowsSandByTheSizeOfTheBoxItLiesInNow) {
  for (const bool shaders : {true, false}) {
    const std::optional<WithoutShaders> without =
        shaders ? std::nullopt : std::make_optional<WithoutShaders>();
    Beach beach(100);
    beach.lookDown(512.5, 512.5, 0.6);
    OffscreenView view(120, 120), other(120, 120);
    for (const std::int32_t height : {2 << 19, 3 << 19}) {
      beach.sandbox = patchOfThinSand(height);
      beach.scene.show(beach.publisher.publishAll(beach.sandbox));
      view.draw(beach.root, kMagenta);
    }
    const bool equal = view.picture(beach.root, kMagenta) == other.picture(beach.root, kMagenta);
    EXPECT_TRUE(equal) << (shaders ? "with shaders" : "without shaders");
  }
}

TEST(SandScene, MarksWhereAToolWouldCut) {
  Beach beach(1'000);
  OffscreenView view(200, 200);
  beach.lookDown(0.5, 0.5, 1.0);
  EXPECT_EQ(countPixels(view.picture(beach.root, kMagenta), isBlue), 0);
  const ToolShape rake = *ToolShape::rake(0.3, 0.02, 3);
  beach.scene.setTool(rake, {0.5, 0.5, 0.0, 0.6, 0.8});
  EXPECT_GT(countPixels(view.picture(beach.root, kMagenta), isBlue), 80);
  beach.scene.setTool(rake, {1.0, 0.5, 0.0, 0.6, 0.8});
  const int half = countPixels(view.picture(beach.root, kMagenta), isBlue);
  EXPECT_GT(half, 20) << "what is over the sand";
  beach.scene.setTool(rake, {7.0, 0.5, 0.0});
  EXPECT_EQ(countPixels(view.picture(beach.root, kMagenta), isBlue), 0);
  beach.scene.setTool(rake, {0.5, 0.5, 0.0});
  beach.scene.hideTool();
  EXPECT_EQ(countPixels(view.picture(beach.root, kMagenta), isBlue), 0);
}

TEST(SandScene, IsPickedWhereTheSurfaceIsAndItsToolIsNot) {
  Beach beach(2'000);
  beach.dig();
  beach.scene.setTool(*ToolShape::square(0.1, 0.02), {0.5, 0.5, 0.0});
  beach.look({0.5F, -0.4F, 0.6F}, {0.5F, 0.5F, -0.04F});
  SoRayPickAction pick(SbViewportRegion(200, 200));
  pick.setPoint(SbVec2s(100, 100));
  pick.apply(beach.root);
  ASSERT_NE(pick.getPickedPoint(), nullptr);
  const SbVec3f place = pick.getPickedPoint()->getPoint();
  const std::optional<double> ground =
      beach.sandbox.surface().mesh().heightAt(static_cast<double>(place[0]), static_cast<double>(place[1]));
  ASSERT_TRUE(ground);
  EXPECT_NEAR(static_cast<double>(place[2]), *ground, 1e-5);
  EXPECT_NEAR(static_cast<double>(place[0]), 0.5, 0.01);
  EXPECT_GT(pick.getPickedPoint()->getNormal()[2], 0.5F);
  pick.setPoint(SbVec2s(100, 199));
  pick.apply(beach.root);
  EXPECT_EQ(pick.getPickedPoint(), nullptr);
}

TEST(SandScene, TellsInventorItsBoxAndItsTriangles) {
  Beach beach(1'000);
  beach.dig();
  SoGetBoundingBoxAction box(SbViewportRegion(100, 100));
  box.apply(beach.scene.node());
  const SbBox3f bounds = box.getBoundingBox();
  EXPECT_EQ(bounds.getMin()[0], 0.0F);
  EXPECT_EQ(bounds.getMax()[1], 1.0F);
  EXPECT_LT(bounds.getMin()[2], -0.02F);
  EXPECT_GT(bounds.getMax()[2], 0.0F);
  SoGetPrimitiveCountAction count;
  count.apply(beach.scene.node());
  EXPECT_EQ(static_cast<std::size_t>(count.getTriangleCount()),
            beach.sandbox.surface().mesh().triangleCount());
}

TEST(SandScene, LeavesWhatIsDrawnAfterItAsItWouldBe) {
  for (const bool shaders : {true, false}) {
    const std::optional<WithoutShaders> without =
        shaders ? std::nullopt : std::make_optional<WithoutShaders>();
    Beach beach(500);
    auto* place = new SoTranslation;
    place->translation = SbVec3f(0.5F, 0.5F, 0.3F);
    auto* cube = new SoCube;
    cube->width = cube->height = cube->depth = 0.05F;
    beach.root->addChild(place);
    beach.root->addChild(cube);
    beach.lookDown(0.5, 0.5, 0.6);
    OffscreenView view(100, 100);
    beach.scene.setWireframe(true);
    const QImage with = view.picture(beach.root, kMagenta).copy(45, 45, 10, 10);
    beach.scene.show(nullptr);
    const QImage alone = view.picture(beach.root, kMagenta);
    EXPECT_GT(countPixels(alone, isBackground), 100) << "no sand";
    EXPECT_EQ(with, alone.copy(45, 45, 10, 10));
  }
}

TEST(SandScene, OutlivesItsContextAndDiesBeforeIt) {
  auto beach = std::make_unique<Beach>(500);
  beach->lookDown(0.5, 0.5, 0.6);
  OffscreenView first(100, 100), second(100, 100);
  const QImage picture = first.picture(beach->root, kMagenta);
  EXPECT_EQ(second.picture(beach->root, kMagenta), picture);
  const std::size_t both = beach->scene.bufferBytes();
  first.destroyContext();
  EXPECT_EQ(beach->scene.bufferBytes(), both / 2);
  EXPECT_EQ(second.picture(beach->root, kMagenta), picture);
  beach.reset();
  Beach other(500);
  other.lookDown(0.5, 0.5, 0.6);
  EXPECT_EQ(second.picture(other.root, kMagenta), picture) << "what the first one left is deleted";
}

}  // namespace
}  // namespace teren
