// What must be true of the pixels.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include <Inventor/SoPickedPoint.h>
#include <Inventor/actions/SoGLRenderAction.h>
#include <Inventor/actions/SoRayPickAction.h>
#include <Inventor/nodes/SoCallback.h>
#include <Inventor/nodes/SoDirectionalLight.h>
#include <Inventor/nodes/SoDrawStyle.h>
#include <Inventor/nodes/SoPerspectiveCamera.h>
#include <Inventor/nodes/SoSeparator.h>
#include <QColor>
#include <QImage>
#include <gtest/gtest.h>

#include "teren/Engine.h"
#include "teren/Hash.h"
#include "teren/SceneQuery.h"

#include "coin/SoTerrain.h"
#include "coin/TerrainLook.h"
#include "coin/TerrainShaders.h"
#include "tests/coin/OffscreenView.h"
#include "tests/coin/Stage.h"
#include "tests/engine/stream/FaultWorld.h"
#include "tests/engine/stream/NodeErrorsWait.h"

namespace teren {
namespace {

const QRgb kBackground = qRgb(255, 0, 255);

/// [0, 1)
double unit(RandomSequence& random) {
  return static_cast<double>(random.nextBits(53)) * 0x1p-53;
}

bool near(QRgb pixel, const SbColor& colour, int tolerance) {
  return std::abs(qRed(pixel) - static_cast<int>(255.0F * colour[0])) <= tolerance &&
         std::abs(qGreen(pixel) - static_cast<int>(255.0F * colour[1])) <= tolerance &&
         std::abs(qBlue(pixel) - static_cast<int>(255.0F * colour[2])) <= tolerance;
}

/// A rough hill in the middle of 256 samples.
double hill(double x, double y) {
  const double squared = (x - 128.0) * (x - 128.0) + (y - 128.0) * (y - 128.0);
  const double bump = std::fabs(std::remainder(x * 7.0 + y * 13.0, 5.0));
  return 30.0 / (1.0 + squared / 500.0) + 0.9 * bump;
}

/// For the plain way of drawing: the environment of the contexts made while it lives.
class WithoutShaders {
 public:
  WithoutShaders() { setenv("TEREN_NO_SHADERS", "1", 1); }
  ~WithoutShaders() { unsetenv("TEREN_NO_SHADERS"); }
  WithoutShaders(const WithoutShaders&) = delete;
  WithoutShaders& operator=(const WithoutShaders&) = delete;
};

/// Looks down from random places close above hand-made ground of many meshes; counts background between them.
/// What a wrong last bit opens is a sliver of 1/256 pixel, so it takes some hundred pictures, long edges on
/// the screen, a spacing with which every product rounds, and meshes far from the sample that vertices are
/// counted from.
int cracksOfHandMadeGround(std::uint64_t seed) {
  const Stage stage;
  const std::int64_t far = (std::int64_t{1} << 40) + 400;
  const double spacing = 0.7;
  stage.terrain->waterLevel = -2e6F;
  stage.terrain->origin =
      SbVec3d(static_cast<double>(far) * spacing, static_cast<double>(-far) * spacing, 0.0);
  stage.terrain->setScene(makeScene(
      {.side = 64, .intervals = 4, .column = far, .row = -far, .spacing = spacing, .height = hill}));
  OffscreenView view(400, 400);
  RandomSequence random(seed);
  int cracks = 0;
  for (int picture = 0; picture < 200; ++picture) {
    const double x = 60.0 + 60.0 * unit(random);
    const double y = 60.0 + 60.0 * unit(random);
    const double height = hill(std::round(x / spacing), std::round(y / spacing)) + 7.0;
    stage.look(SbVec3f(static_cast<float>(x), static_cast<float>(y), static_cast<float>(height)),
               360.0 * unit(random), -90.0 + 15.0 * unit(random));
    cracks += backgroundPixels(view.picture(stage.root, kMagenta));
  }
  return cracks;
}

TEST(Picture, MeshesMeetWithoutCracksFarFromTheWorldsZero) {
  EXPECT_EQ(cracksOfHandMadeGround(1), 0);
}

TEST(Picture, MeshesMeetWithoutCracksWithoutShadersToo) {
  const WithoutShaders plain;
  EXPECT_EQ(cracksOfHandMadeGround(2), 0);
}

TEST(Picture, ShowsWhatIsNotUploadedYetAllTheSame) {
  const Stage stage;
  stage.terrain->waterLevel = -2e6F;
  stage.terrain->setScene(makeScene({.side = 16, .intervals = 64, .spacing = 0.25, .height = hill}));
  stage.look(SbVec3f(128.0F, 128.0F, 250.0F), 0.0, -90.0);
  OffscreenView view(320, 320);
  const QImage first = view.picture(stage.root, kMagenta);
  const std::size_t uploadedAtFirst = stage.terrain->bufferBytes();
  QImage last;
  for (int frame = 0; frame < 8; ++frame) last = view.picture(stage.root, kMagenta);
  ASSERT_LT(uploadedAtFirst, stage.terrain->bufferBytes()) << "all was uploaded at once: nothing is tested";
  EXPECT_EQ(backgroundPixels(first), 0);
  EXPECT_EQ(first, last);
}

TEST(Picture, TheGroundsTextureStaysInItsPlaceUnderAMovingEyeAndRepeatsAfter1024Grains) {
  const Stage stage;
  stage.terrain->waterLevel = -2e6F;
  stage.terrain->viewDistance = 500.0F;
  stage.terrain->setScene(makeScene({.side = 18, .intervals = 64}));
  OffscreenView view(64, 64);
  const auto at = [&](float metres) {
    stage.look(SbVec3f(100.0F + metres, 100.0F + metres, 40.0F), 0.0, -90.0);
    return view.picture(stage.root, kMagenta);
  };
  at(0.0F);  // uploads
  const QImage here = at(0.0F);
  ASSERT_EQ(backgroundPixels(here), 0);
  for (const float metres : {0.5F, 1.0F, 150.0F})
    EXPECT_NE(at(metres), here) << "it moves along with the eye";
  EXPECT_EQ(at(2048.0F), here);
}

/// The largest difference of a colour between two pictures.
int mostDifferent(const QImage& a, const QImage& b) {
  int most = 0;
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      const QRgb p = a.pixel(x, y), q = b.pixel(x, y);
      most = std::max({most, std::abs(qRed(p) - qRed(q)), std::abs(qGreen(p) - qGreen(q)),
                       std::abs(qBlue(p) - qBlue(q))});
    }
  }
  return most;
}

/// Level ground of 64 m at a height, seen from some metres above it.
QImage levelGround(OffscreenView& view, double height, double above, float waterLevel, int intervals = 32) {
  const Stage stage;
  stage.terrain->viewDistance = 1e5F;
  stage.terrain->waterLevel = waterLevel;
  stage.camera->farDistance = 1e5F;
  stage.terrain->setScene(makeScene(
      {.side = 1, .intervals = intervals, .spacing = 64.0 / intervals, .height = [height](double, double) {
         return height;
       }}));
  stage.look(SbVec3f(32.0F, 32.0F, static_cast<float>(height + above)), 0.0, -90.0);
  stage.camera->heightAngle = static_cast<float>(2.0 * std::atan(25.0 / above));
  view.draw(stage.root, kMagenta);  // uploads
  return view.picture(stage.root, kMagenta);
}

TEST(Picture, LosesTheGroundsDetailBeforeItIsLeftOut) {
  OffscreenView view(128, 128);
  const double ends = kDetailEnds;
  const QImage last = levelGround(view, 100.0, ends - 0.5, -1e6F),
               none = levelGround(view, 100.0, ends + 0.5, -1e6F);
  EXPECT_LE(mostDifferent(last, none), 2);
  EXPECT_GT(mostDifferent(none, levelGround(view, 100.0, 0.4 * ends, -1e6F)), 20);
}

TEST(Picture, HasPatternsAsLargeOnAFinerLattice) {
  OffscreenView view(128, 128);
  for (const float waterLevel : {-1e6F, 100.5F}) {
    const QImage usual = levelGround(view, 100.0, 60.0, waterLevel);
    EXPECT_LE(mostDifferent(usual, levelGround(view, 100.0, 60.0, waterLevel, 128)), 2) << waterLevel;
    EXPECT_GT(mostDifferent(usual, usual.mirrored(true, false)), 10) << "or there is nothing to see";
  }
}

TEST(Picture, ComputesSnowAndShoresFromWhereTheyMayBegin) {
  OffscreenView view(128, 128);
  EXPECT_LE(mostDifferent(levelGround(view, kSnowAbove - 0.01, 60.0, -1e6F),
                          levelGround(view, kSnowAbove + 0.01, 60.0, -1e6F)),
            1);
  EXPECT_LE(mostDifferent(levelGround(view, 100.0, 60.0, 100.0F - kShoreBelow - 0.01F),
                          levelGround(view, 100.0, 60.0, 100.0F - kShoreBelow + 0.01F)),
            1);
  const QImage grass = levelGround(view, 100.0, 60.0, -1e6F);
  EXPECT_GT(mostDifferent(grass, levelGround(view, 500.0, 60.0, -1e6F)), 80);
  EXPECT_GT(mostDifferent(grass, levelGround(view, 100.0, 60.0, 96.0F)), 80);
}

TEST(Picture, IsDrawnFrontToBack) {
  const Stage stage;
  const auto scene = makeScene({.side = 8, .intervals = 2, .height = hill});
  struct Seen {
    std::shared_ptr<const Scene> scene;
    std::vector<const Mesh*> meshes;
  } seen{scene, {}};
  auto* ask = new SoCallback;
  ask->setCallback(
      [](void* data, SoAction* action) {
        if (!action->isOfType(SoGLRenderAction::getClassTypeId())) return;
        auto& told = *static_cast<Seen*>(data);
        told.meshes = visibleMeshes(action->getState(), *told.scene, {SbVec3d(0.0, 0.0, 0.0), 2.0});
      },
      &seen);
  stage.root->addChild(ask);
  OffscreenView view(64, 64);
  for (const double heading : {20.0, 110.0, 200.0, 290.0}) {
    const SbVec3f eye(17.0F, 14.0F, 40.0F);
    stage.look(eye, heading, -70.0);
    view.draw(stage.root, kMagenta);
    const ScenePlacement placement(SbVec3d(0.0, 0.0, 0.0), 2.0);
    float last = 0.0F;
    for (const Mesh* mesh : seen.meshes) {
      const float away = (placement.box(*mesh).getClosestPoint(eye) - eye).length();
      EXPECT_GE(away, last);
      last = away;
    }
    EXPECT_GT(seen.meshes.size(), 3U) << "heading " << heading;
  }
}

TEST(Picture, ShowsTheSeaWhereItsBedIsOutsideTheView) {
  const Stage stage;
  stage.terrain->waterLevel = 0.0F;
  stage.terrain->viewDistance = 120.0F;
  stage.terrain->setScene(makeScene({.height = [](double, double) { return -900.0; }}));
  stage.look(SbVec3f(64.0F, 1.0F, 30.0F), 0.0, -45.0);
  OffscreenView view(64, 64);
  const QImage picture = view.picture(stage.root, kMagenta);
  EXPECT_EQ(stage.terrain->drawnTriangles(), 0U);
  EXPECT_EQ(backgroundPixels(picture), 0);
}

/// Flat ground of 2 x 2 meshes, the western ones red and the eastern ones green, from above.
void expectRedAndGreen(const char* how) {
  const Stage stage;
  stage.terrain->waterLevel = -1e6F;
  stage.terrain->viewDistance = 5000.0F;
  stage.terrain->setScene(makeScene({.side = 2, .intervals = 8}));  // 32 m
  stage.look(SbVec3f(16.0F, 16.0F, 60.0F), 0.0, -90.0);
  OffscreenView view(64, 64);
  const auto isTinted = [&view, &stage, how](bool wanted) {
    const QImage picture = view.picture(stage.root, kMagenta);
    for (const int y : {20, 32, 44}) {
      const QColor west = picture.pixelColor(24, y), east = picture.pixelColor(40, y);
      EXPECT_EQ(west.red() > 100 && west.green() < 40 && west.blue() < 40, wanted) << how << " " << y;
      EXPECT_EQ(east.green() > 100 && east.red() < 40 && east.blue() < 40, wanted) << how << " " << y;
    }
  };
  isTinted(false);
  stage.terrain->setTint([](const Mesh& mesh) {
    return mesh.originColumn == 0 ? SbColor(1.0F, 0.0F, 0.0F) : SbColor(0.0F, 1.0F, 0.0F);
  });
  isTinted(true);
  stage.terrain->setTint([](const Mesh&) { return SbColor(0.0F, 0.0F, 1.0F); });
  isTinted(false);
  stage.terrain->setTint({});
  isTinted(false);
}

TEST(Picture, ShowsEachMeshInTheColourItIsTinted) {
  expectRedAndGreen("with shaders");
  const WithoutShaders plain;
  expectRedAndGreen("without shaders");
}

/// The standard world at many levels, chosen for one eye; then seen from others, wherever its levels meet.
TEST(Picture, OfManyLevelsShowsNoBackgroundThroughTheGroundFromAnywhere) {
  const Stage stage;
  stage.terrain->seed = "42";
  stage.terrain->waterLevel = -1e6F;  // water would hide cracks
  stage.camera->heightAngle = 1.4F;
  OffscreenView view(480, 270);
  RandomSequence random(5);
  for (const float pixelError : {60.0F, 25.0F}) {
    stage.terrain->viewDistance = 4000.0F;
    stage.terrain->pixelError = pixelError;
    stage.look(SbVec3f(0.0F, 0.0F, 500.0F), 0.0, -90.0);
    view.picture(stage.root, kMagenta);  // from here the levels are chosen
    stage.terrain->settle();
    const Engine& engine = *stage.terrain->engine();
    const std::vector<std::size_t> nodes = engine.figures().nodesAtLevel;
    ASSERT_GE(std::count_if(nodes.begin(), nodes.end(), [](std::size_t count) { return count > 0; }), 4);
    for (int turn = 0; turn < 30; ++turn) {
      const auto place = [&](float reach, double above) {
        const auto x = static_cast<float>(reach * (2.0 * unit(random) - 1.0));
        const auto y = static_cast<float>(reach * (2.0 * unit(random) - 1.0));
        const auto at = Position::fromMetres(x, y, engine.world().pitch());
        return SbVec3f(x, y, static_cast<float>(*engine.drawnHeight(*at) + above));
      };
      const SbVec3f high = place(2500.0F, 20.0 + 200.0 * unit(random));
      stage.look(high, 360.0 * unit(random), -90.0 + 25.0 * unit(random));
      EXPECT_EQ(backgroundPixels(view.picture(stage.root, kMagenta)), 0)
          << "at " << high[0] << ", " << high[1];
      const SbVec3f low = place(1500.0F, 20.0 + 200.0 * unit(random));
      stage.look(low, 360.0 * unit(random), 0.0);
      EXPECT_EQ(backgroundBelowTheHorizon(view.picture(stage.root, kMagenta)), 0)
          << "at " << low[0] << ", " << low[1];
    }
  }
}

/// The standard world, settled, somewhere on dry land.
class Landscape : public ::testing::Test {
 protected:
  void SetUp() override {
    root_ = readScene("#Inventor V2.1 ascii\nSoTerrain { seed \"42\" }");
    auto* read = static_cast<SoSeparator*>(root_);
    terrain_ = static_cast<SoTerrain*>(read->getChild(0));
    stage_.root->replaceChild(stage_.terrain, terrain_);
    stage_.terrain = terrain_;
    ASSERT_STREQ(terrain_->errorText().getString(), "");
    terrain_->settle();
    ground_ = *terrain_->engine()->drawnHeight(Position{});
  }
  void TearDown() override { root_->unref(); }
  QImage picture() { return view_.picture(stage_.root, kMagenta); }

  Stage stage_;
  SoNode* root_ = nullptr;
  SoTerrain* terrain_ = nullptr;
  OffscreenView view_{640, 360};
  double ground_ = 0.0;
};

TEST_F(Landscape, HasSkyAboveAndGroundBelowTheHorizonAndNothingBetween) {
  RandomSequence random(3);
  stage_.camera->heightAngle = 1.4F;
  for (int turn = 0; turn < 12; ++turn) {
    const double heading = 360.0 * unit(random);
    stage_.look(SbVec3f(0.0F, 0.0F, static_cast<float>(ground_ + 200.0 + 150.0 * unit(random))), heading,
                0.0);
    const QImage seen = picture();
    EXPECT_EQ(backgroundBelowTheHorizon(seen), 0) << "heading " << heading;
    for (int x = 0; x < seen.width(); x += 16) {
      EXPECT_EQ(seen.pixel(x, 0), kBackground);
      EXPECT_NE(seen.pixel(x, seen.height() - 1), kBackground);
    }
  }
}

TEST_F(Landscape, HasNoCracksSeenFromAbove) {
  terrain_->waterLevel = -1e6F;  // water would hide them
  RandomSequence random(4);
  for (int turn = 0; turn < 20; ++turn) {
    const auto x = static_cast<float>(600.0 * unit(random) - 300.0);
    const auto y = static_cast<float>(600.0 * unit(random) - 300.0);
    stage_.look(SbVec3f(x, y, static_cast<float>(ground_ + 700.0)), 360.0 * unit(random),
                -90.0 + 30.0 * unit(random));
    EXPECT_EQ(backgroundPixels(picture()), 0) << "at " << x << ", " << y;
  }
}

TEST_F(Landscape, IsDrawnWithinItsFrustumOnlyAndHoldsCountedBuffers) {
  stage_.look(SbVec3f(0.0F, 0.0F, static_cast<float>(ground_ + 100.0)), 90.0, 0.0);
  for (int frame = 0; frame < 8; ++frame) picture();
  const std::size_t all = terrain_->scene()->triangles();
  EXPECT_GT(terrain_->drawnTriangles(), all / 20);
  EXPECT_LT(terrain_->drawnTriangles(), all / 2);
  EXPECT_GT(terrain_->bufferBytes(), std::size_t{100'000});
  EXPECT_LT(terrain_->bufferBytes(), std::size_t{12'000'000});
  view_.destroyContext();
  EXPECT_EQ(terrain_->bufferBytes(), 0U);
}

TEST_F(Landscape, ShowsWaterWhereTheGroundIsLowerAndNoneInADryWorld) {
  const double bottom = 60.0;
  terrain_->waterLevel = static_cast<float>(ground_ + bottom);
  stage_.look(SbVec3f(0.0F, 0.0F, static_cast<float>(ground_ + bottom + 60.0)), 0.0, -89.0);
  const QColor wet(picture().pixel(320, 180));
  EXPECT_GT(wet.blue(), wet.red() + 15);
  EXPECT_GE(wet.blue(), wet.green());
  terrain_->waterLevel = -1e6F;
  const QColor dry(picture().pixel(320, 180));
  EXPECT_GT(dry.green(), dry.blue());
}

TEST_F(Landscape, HidesBackgroundBehindWaterAlsoWhereTheSeaIsDeep) {
  terrain_->waterLevel = static_cast<float>(ground_ + 900.0);
  for (const double pitch : {-60.0, -30.0, -15.0}) {
    stage_.look(SbVec3f(0.0F, 0.0F, static_cast<float>(ground_ + 1000.0)), 30.0, pitch);
    const QImage seen = picture();
    EXPECT_EQ(backgroundBelowTheHorizon(seen), 0);
    for (int x = 0; x < seen.width(); x += 8) {
      const QColor pixel(seen.pixel(x, 359));
      EXPECT_GE(pixel.green() + 3, pixel.red()) << "magenta shines through at " << x;
    }
  }
}

TEST_F(Landscape, LosesItselfInTheHazeAtTheViewDistance) {
  terrain_->waterLevel = -1e6F;
  stage_.look(SbVec3f(0.0F, 0.0F, static_cast<float>(ground_ + 1200.0)), 20.0, -20.0);
  const QImage seen = picture();
  int first = 0;
  while (first < seen.height() && seen.pixel(320, first) == kBackground) ++first;
  ASSERT_LT(first, seen.height() - 1);
  EXPECT_TRUE(near(seen.pixel(320, first + 1), terrain_->hazeColor.getValue(), 3));
}

TEST_F(Landscape, LooksMuchTheSameWithoutShaders) {
  stage_.look(SbVec3f(0.0F, 0.0F, static_cast<float>(ground_ + 300.0)), 90.0, -15.0);
  const QImage with = picture();
  const WithoutShaders plain;
  OffscreenView other(640, 360);
  const QImage without = other.picture(stage_.root, kMagenta);
  EXPECT_EQ(backgroundBelowTheHorizon(without), 0);
  int sky = 0;
  double difference = 0.0;
  for (int y = 0; y < with.height(); ++y) {
    for (int x = 0; x < with.width(); ++x) {
      if ((with.pixel(x, y) == kBackground) != (without.pixel(x, y) == kBackground)) ++sky;
      difference += std::abs(qGreen(with.pixel(x, y)) - qGreen(without.pixel(x, y)));
    }
  }
  EXPECT_LT(sky, 640) << "pixels that are sky in one picture only";
  EXPECT_LT(difference / (640.0 * 360.0), 40.0);
}

TEST_F(Landscape, LooksTheSameByEitherDepth) {
  terrain_->waterLevel = static_cast<float>(ground_ + 20.0);
  stage_.camera->farDistance = 3000.0F;
  for (const double heading : {0.0, 120.0, 240.0}) {
    stage_.look(SbVec3f(0.0F, 0.0F, static_cast<float>(ground_ + 60.0)), heading, -10.0);
    terrain_->logarithmicDepth = FALSE;
    picture();  // uploads
    const QImage ordinary = picture();
    terrain_->logarithmicDepth = TRUE;
    const QImage logarithmic = picture();
    ASSERT_TRUE(terrain_->drewLogarithmicDepth());
    int different = 0;
    for (int y = 0; y < ordinary.height(); ++y) {
      for (int x = 0; x < ordinary.width(); ++x) {
        different += ordinary.pixel(x, y) != logarithmic.pixel(x, y) ? 1 : 0;
      }
    }
    EXPECT_LT(different, 200) << "of " << 640 * 360 << " pixels, heading " << heading;
  }
}

TEST_F(Landscape, TakesItsSunFromTheFirstDirectionalLight) {
  terrain_->waterLevel = -2e6F;  // it mirrors the sky
  stage_.look(SbVec3f(0.0F, 0.0F, static_cast<float>(ground_ + 300.0)), 90.0, -40.0);
  const auto brightness = [&] {
    const QImage seen = picture();
    double sum = 0.0;
    for (int x = 0; x < seen.width(); ++x) sum += qGreen(seen.pixel(x, 300));
    return sum / seen.width();
  };
  auto* light = new SoDirectionalLight;
  stage_.root->insertChild(light, 1);
  light->direction = SbVec3f(0.0F, 0.0F, -1.0F);
  const double noon = brightness();
  light->direction = SbVec3f(0.0F, 0.0F, 1.0F);
  const double night = brightness();
  EXPECT_GT(noon, 1.4 * night);
}

TEST_F(Landscape, LeavesOtherShapesAsTheyWere) {
  auto* after = readScene(
      "#Inventor V2.1 ascii\nSeparator { DirectionalLight { direction 0 0 -1 } Translation { translation 0 0 "
      "1800 } "
      "Material { diffuseColor 1 0 0 } Cone { bottomRadius 40 height 90 } }");
  stage_.camera->position = SbVec3f(0.0F, 0.0F, 2000.0F);  // looks down
  stage_.root->addChild(after);
  after->unref();
  const QRgb together = picture().pixel(320, 190);
  stage_.root->removeChild(terrain_);
  const QRgb alone = picture().pixel(320, 190);
  EXPECT_GT(qRed(alone), 100);
  EXPECT_LT(qGreen(alone), 50);
  EXPECT_EQ(alone, together);
}

TEST_F(Landscape, IsNotDrawnWhereItIsMadeInvisible) {
  stage_.look(SbVec3f(0.0F, 0.0F, static_cast<float>(ground_ + 300.0)), 90.0, -40.0);
  auto* style = new SoDrawStyle;
  style->style = SoDrawStyle::INVISIBLE;
  stage_.root->insertChild(style, 1);
  EXPECT_EQ(picture().pixel(320, 300), kBackground);
  EXPECT_EQ(terrain_->drawnTriangles(), 0U);
}

// --- Detail by error: vertices move with distance

/// A hand-made scene whose every vertex draws near to another ground.
std::shared_ptr<const Scene> drawingNear(const HandMade& from, const HandMade& to, const Morph& morph) {
  const auto own = makeScene(from), other = makeScene(to);
  std::vector<std::shared_ptr<const Mesh>> meshes;
  for (std::size_t k = 0; k < own->meshes().size(); ++k) {
    auto mesh = std::make_shared<Mesh>(*own->meshes()[k]);
    for (std::size_t number = 0; number < mesh->vertices.size(); ++number) {
      const SurfaceVertex& target = other->meshes()[k]->vertices[number];
      mesh->vertices[number].setCoarser(3, target.height, target.normalX, target.normalY);
      mesh->minHeight = std::min(mesh->minHeight, target.height);
      mesh->maxHeight = std::max(mesh->maxHeight, target.height);
    }
    meshes.push_back(std::move(mesh));
  }
  return std::make_shared<const Scene>(1, own->spacing(), std::move(meshes), morph);
}

/// Pixels where two pictures differ by more than so many grey levels.
int differing(const QImage& a, const QImage& b, int levels) {
  int count = 0;
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      const QRgb p = a.pixel(x, y), q = b.pixel(x, y);
      count += std::max({std::abs(qRed(p) - qRed(q)), std::abs(qGreen(p) - qGreen(q)),
                         std::abs(qBlue(p) - qBlue(q))}) > levels;
    }
  }
  return count;
}

TEST(Picture, OfVerticesThatDrawNearIsTheirOwnUntilTheErrorAllowsMoreAndThenTheCoarserSurface) {
  const Stage stage;
  OffscreenView view(320, 200);
  stage.terrain->waterLevel = -1e6F;
  stage.terrain->viewDistance = 2000.0F;
  const HandMade rough{.side = 8, .intervals = 32, .spacing = 1.0, .height = hill};
  const HandMade smooth{.side = 8, .intervals = 32, .spacing = 1.0, .height = [](double x, double y) {
                          return 20.0 + 0.05 * x - 0.02 * y;
                        }};
  stage.look(SbVec3f(128.0F, -60.0F, 90.0F), 0.0, -30.0);
  const auto picture = [&](const std::shared_ptr<const Scene>& scene) {
    stage.terrain->setScene(std::make_shared<const Scene>());
    stage.terrain->setScene(scene);
    return view.picture(stage.root, kMagenta);
  };
  const std::vector<double> errors{0.0, 0.0, 0.0, 1.0, 2.0};
  const QImage own = picture(makeScene(rough)), coarser = picture(makeScene(smooth));
  EXPECT_GT(differing(own, coarser, 4), 5000);
  // All of it lies 50 to 500 m away. It begins to move where 1.25 m may be wrong, and has arrived at 2 m.
  EXPECT_EQ(differing(picture(drawingNear(rough, smooth, Morph())), own, 0), 0);
  EXPECT_EQ(differing(picture(drawingNear(rough, smooth, Morph(0.001, errors))), own, 0), 0);
  EXPECT_LT(differing(picture(drawingNear(rough, smooth, Morph(0.1, errors))), coarser, 2), 50);
  const QImage between = picture(drawingNear(rough, smooth, Morph(0.01, errors)));
  EXPECT_GT(differing(between, own, 4), 1000);
  EXPECT_GT(differing(between, coarser, 4), 1000);
  const WithoutShaders plain;
  OffscreenView other(320, 200);
  const QImage unmoved = other.picture(stage.root, kMagenta);
  picture(makeScene(rough));
  EXPECT_EQ(differing(other.picture(stage.root, kMagenta), unmoved, 0), 0) << "without shaders nothing moves";
}

TEST(Picture, OfVerticesThatDrawNearIsPickedWhereItIsSeen) {
  const Stage stage;
  stage.terrain->waterLevel = -1e6F;
  const HandMade rough{.side = 8, .intervals = 32, .spacing = 1.0, .height = hill};
  const HandMade smooth{.side = 8, .intervals = 32, .spacing = 1.0, .height = [](double x, double y) {
                          return 20.0 + 0.05 * x - 0.02 * y;
                        }};
  const std::vector<double> errors{0.0, 0.0, 0.0, 1.0, 2.0};
  const Morph morph(0.01, errors), twice(0.02, errors);
  stage.terrain->setScene(drawingNear(rough, smooth, morph));
  const SceneQuery lying(stage.terrain->scene(), rough.intervals);
  const SbVec3f from(128.0F, -60.0F, 90.0F);
  stage.look(from, 0.0, -30.0);
  const auto eyeAt = [&](const SbVec3f& place) {
    return DetailEye{
        *Position::fromMetres(static_cast<double>(place[0]), static_cast<double>(place[1]), 32.0),
        static_cast<double>(place[2])};
  };
  int picked = 0;
  // [m] By how much picks miss the ground of a query at most.
  const auto miss = [&](const SceneQuery& query) {
    RandomSequence random(31);
    double most = 0.0;
    picked = 0;
    for (int k = 0; k < 100; ++k) {
      SbVec3f way(static_cast<float>(unit(random) - 0.5), 1.0F,
                  static_cast<float>(-0.1 - 0.6 * unit(random)));
      way.normalize();
      SoRayPickAction action(SbViewportRegion(320, 200));
      action.setRay(from, way, 0.0F, 1000.0F);
      action.apply(stage.root);
      const SoPickedPoint* point = action.getPickedPoint();
      const Ray ray{.from = eyeAt(from).position,
                    .height = eyeAt(from).height,
                    .direction = {static_cast<double>(way[0]), static_cast<double>(way[1]),
                                  static_cast<double>(way[2])}};
      RayHit hit;
      query.firstHits({&ray, 1}, {&hit, 1});
      if (point == nullptr || hit.end != RayEnd::ground) continue;
      ++picked;
      most = std::max(most, std::fabs(static_cast<double>((point->getPoint() - from).length()) - hit.way));
    }
    return most;
  };
  EXPECT_LT(miss(lying), 2e-3) << "before there is a picture";
  EXPECT_FALSE(stage.terrain->movedWith().has_value());
  OffscreenView view(320, 200);
  view.picture(stage.root, kMagenta);
  ASSERT_TRUE(stage.terrain->movedWith().has_value());
  EXPECT_LT((*stage.terrain->movedWith() - SbVec3d(from)).length(), 1e-4);
  EXPECT_LT(miss(lying.seenFrom(eyeAt(from))), 2e-3);
  EXPECT_GT(picked, 70);
  EXPECT_GT(miss(lying), 1.0) << "moved by metres";
  const SbVec3f other(300.0F, 200.0F, 50.0F);
  stage.terrain->setDetailEye(SbVec3d(other), twice);
  EXPECT_LT(miss(lying.seenFrom(eyeAt(from))), 2e-3) << "as the last picture was";
  view.picture(stage.root, kMagenta);
  EXPECT_LT(miss(lying.seenFrom(eyeAt(other), twice)), 2e-3);
  EXPECT_GT(miss(lying.seenFrom(eyeAt(other))), 0.1) << "moved as another view";
  const WithoutShaders plain;
  OffscreenView still(320, 200);
  still.picture(stage.root, kMagenta);
  EXPECT_FALSE(stage.terrain->movedWith().has_value());
  EXPECT_LT(miss(lying), 2e-3) << "without shaders nothing moves";
}

TEST(DetailByError, HasNoCracksHoweverFarItsVerticesHaveMoved) {
  SoNode* root = readScene("#Inventor V2.1 ascii\nSoTerrain { seed \"42\" pixelError 8 viewDistance 3000 }");
  const Stage stage;
  auto* terrain = static_cast<SoTerrain*>(static_cast<SoSeparator*>(root)->getChild(0));
  stage.root->replaceChild(stage.terrain, terrain);
  terrain->waterLevel = -1e6F;
  terrain->settle();
  OffscreenView view(640, 360);
  RandomSequence random(7);
  std::set<int> levels;
  for (const auto& mesh : terrain->scene()->meshes()) levels.insert(mesh->nodeLevel);
  EXPECT_GE(levels.size(), 4U);
  EXPECT_GT(terrain->scene()->morph().tolerance(), 0.0F);
  const double ground = *terrain->engine()->drawnHeight(Position{});
  QImage before;
  for (int turn = 0; turn < 20; ++turn) {
    const auto x = static_cast<float>(1000.0 * unit(random) - 500.0);
    const auto y = static_cast<float>(1000.0 * unit(random) - 500.0);
    stage.look(SbVec3f(x, y, static_cast<float>(ground + 700.0)), 360.0 * unit(random),
               -90.0 + 30.0 * unit(random));
    terrain->setDetailEye(SbVec3d(2000.0 * unit(random) - 1000.0, 2000.0 * unit(random) - 1000.0,
                                  ground + 300.0 * unit(random)));
    const QImage moved = view.picture(stage.root, kMagenta);
    EXPECT_EQ(backgroundPixels(moved), 0) << "at " << x << ", " << y;
    terrain->setDetailEye(std::nullopt);
    before = view.picture(stage.root, kMagenta);
    EXPECT_EQ(backgroundPixels(before), 0) << "at " << x << ", " << y;
  }
  root->unref();
}

TEST(DetailByError, ShowsHardlyThatNodesChangePlaces) {
  const auto world = test::faultWorld(3, 17, {1024.0, 64.0}, 20);
  class Puppet final : public Object {
   public:
    void update(double, const Ground&) override {}
    Motion motion() const override { return place; }
    Motion place;
  };
  auto made = Engine::create(
      world, {.view = {.detail = DetailSettings{.pixelError = 12.0, .distance = 3000.0, .lines = 360.0}}});
  ASSERT_TRUE(made.ok());
  Engine& engine = **made;
  auto& puppet = static_cast<Puppet&>(engine.add(std::make_unique<Puppet>()));
  const auto settleAt = [&](double north) {
    puppet.place.position = *Position::fromMetres(10.0, north, world->pitch());
    puppet.place.height = 150.0;
    engine.settle();
    return engine.scene();
  };
  settleAt(0.0);
  ASSERT_TRUE(test::measureNodeErrors(engine));
  const Stage stage;
  stage.camera->heightAngle = 0.785F;
  stage.terrain->waterLevel = -1e6F;
  stage.terrain->viewDistance = 3000.0F;
  OffscreenView view(640, 360);
  const auto picture = [&](const Scene& scene, bool moving) {
    std::vector<std::shared_ptr<const Mesh>> meshes(scene.meshes().begin(), scene.meshes().end());
    stage.terrain->setScene(std::make_shared<const Scene>());
    stage.terrain->setScene(std::make_shared<const Scene>(scene.serial(), scene.spacing(), std::move(meshes),
                                                          moving ? scene.morph() : Morph()));
    return view.picture(stage.root, kMagenta);
  };
  auto before = settleAt(0.0);
  int moving = 0, still = 0, exchanges = 0;
  for (double north = 16.0; north <= 320.0; north += 16.0) {
    const auto after = settleAt(north);
    if (after->serial() == before->serial()) continue;
    ++exchanges;
    stage.look(SbVec3f(10.0F, static_cast<float>(north), 150.0F), 0.0, -12.0);
    moving += differing(picture(*before, true), picture(*after, true), 6);
    still += differing(picture(*before, false), picture(*after, false), 6);
    before = after;
  }
  EXPECT_GT(exchanges, 5);
  EXPECT_GT(still, 1000);
  EXPECT_LT(moving, still / 3) << "pixels that jump, and without the way to the coarser surface";
}

}  // namespace
}  // namespace teren
