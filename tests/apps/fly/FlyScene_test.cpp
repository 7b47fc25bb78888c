// The pictures of the demo, camera, sky, aircraft, land and water together.
#include "apps/fly/FlyScene.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <utility>
#include <vector>

#include <Inventor/nodes/SoSeparator.h>
#include <QColor>
#include <QImage>
#include <gtest/gtest.h>

#include "teren/PixelError.h"

#include "apps/fly/LandColours.h"
#include "tests/coin/OffscreenView.h"
#include "tests/engine/world/TestWorld.h"

namespace teren {
namespace {

constexpr double kPitch = 64.0;  // [m]
constexpr std::int64_t kFarAway = std::int64_t{1} << 34;
static_assert(static_cast<double>(kFarAway) * kPitch == 0x1p40);
constexpr double kSea = -20.0;  // [m]

/// Hills and bumps out of the same maps again and again: the land 2^40 m away is that at the origin.
std::shared_ptr<const World> repeatingWorld() {
  WorldDescription description;
  description.samples = 65;
  const auto add = [&description](double pitch, int samples, double deviation) {
    LayerDescription layer;
    layer.generator = "same";
    layer.parameters = {{"deviation", deviation}};
    layer.pitch = pitch;
    layer.samples = samples;
    description.layers.push_back(layer);
  };
  add(4096.0, 17, 120.0);
  add(512.0, 33, 4.0);
  return makeTestWorld(description);
}

/// A flight of some seconds in both persons, with turns, over lakes and hills, from patch (i, j) on.
std::vector<QImage> flightFrom(std::int64_t i, std::int64_t j, QSize size) {
  constexpr int kFrames = 16, kStepsAFrame = 8;
  constexpr double kStep = 1.0 / 30.0;  // [s]
  EngineOptions options;
  options.view = {.level = 1, .radius = 12};
  options.workers = 0;
  AircraftStart start;
  start.position = {i, j, 0.3, 0.6};
  start.speed = 90.0;
  start.waterLevel = kSea;
  Flight flight(Engine::create(repeatingWorld(), options).value(), start);
  flight.settle([](std::size_t, std::size_t) { return true; });
  Daylight light;
  light.waterLevel = static_cast<float>(kSea);
  FlyScene scene(light, flight.engine());
  CameraRig rig;
  OffscreenView view(size.width(), size.height());
  std::vector<QImage> pictures;
  for (int frame = 0; frame < kFrames; ++frame) {
    if (frame == kFrames / 2) rig.togglePerson();
    flight.aircraft()[0]->setControls({.turn = frame % 4 == 0 ? 1.0 : -0.3});
    for (int step = 0; step < kStepsAFrame; ++step) {
      flight.advance(kStep);
      rig.update(kStep, {}, poseOf(flight.activeObject()));
    }
    flight.engine().settle();
    const Viewpoint eye = rig.viewpoint(poseOf(flight.activeObject()), flight.engine().ground(), kSea);
    scene.show(flight, eye, rig.person(), kStep);
    pictures.push_back(view.picture(scene.node(), light.haze));
  }
  return pictures;
}

/// The largest difference of any channel of any pixel.
int difference(const QImage& one, const QImage& other) {
  int most = 0;
  for (int y = 0; y < one.height(); ++y) {
    const std::uint8_t* left = one.constScanLine(y);
    const std::uint8_t* right = other.constScanLine(y);
    for (int x = 0; x < 3 * one.width(); ++x) most = std::max(most, std::abs(left[x] - right[x]));
  }
  return most;
}

/// Pixels of the first aircraft's paint.
int paintedPixels(const QImage& picture) {
  int count = 0;
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const QRgb pixel = picture.pixel(x, y);
      count += qRed(pixel) > 100 && qGreen(pixel) < 60 && qBlue(pixel) < 60 ? 1 : 0;
    }
  }
  return count;
}

TEST(FlyScene, TheSameFlightOverTheSameGroundGivesTheSamePictures2To40MetresAway) {
  const QSize size(480, 270);
  const std::vector<QImage> here = flightFrom(5, 6, size);
  const std::vector<QImage> there = flightFrom(5 + kFarAway, 6 - kFarAway, size);
  ASSERT_EQ(here.size(), there.size());
  for (std::size_t frame = 0; frame < here.size(); ++frame) {
    ASSERT_EQ(here[frame].size(), size);
    EXPECT_LE(difference(here[frame], there[frame]), 1) << "frame " << frame;
    EXPECT_EQ(paintedPixels(here[frame]) > 20, frame < here.size() / 2)
        << "from outside it is before the land";
    if (frame == 0) continue;
    EXPECT_GT(difference(here[frame], here[frame - 1]), 30) << "it does not move";
  }
}

/// Land with detail by error, settled, and what one sees of it.
class DetailedLand : public testing::Test {
 protected:
  void SetUp() override {
    EngineOptions options;
    options.view.detail =
        DetailSettings{.pixelError = 24.0, .distance = 4000.0, .lines = kHigh, .fieldOfView = 0.87};
    AircraftStart start;
    start.position = {5, 6, 0.3, 0.6};
    start.clearance = 200.0;
    flight_ = std::make_unique<Flight>(Engine::create(repeatingWorld(), options).value(), start);
    flight_->settle([](std::size_t, std::size_t) { return true; });
    light_.waterLevel = -1e5F;
    scene_ = std::make_unique<FlyScene>(light_, flight_->engine());
    const Motion motion = flight_->activeObject().motion();
    eye_ = {{.position = motion.position, .height = motion.height, .pitch = -0.25}, 0.87};
  }
  QImage picture(const Viewpoint& from) {
    scene_->show(*flight_, from, CameraRig::Person::first, 0.0);
    return view_.picture(scene_->node(), light_.haze);
  }
  QImage picture() { return picture(eye_); }
  std::shared_ptr<const Scene> land() { return flight_->engine().scene(); }

  static constexpr int kWide = 320, kHigh = 200;
  std::unique_ptr<Flight> flight_;
  Daylight light_;
  std::unique_ptr<FlyScene> scene_;
  Viewpoint eye_;
  OffscreenView view_{kWide, kHigh};
};

/// [0, 1] Of all pixels, those whose hue is at most a quarter of the circle's twelfth from a colour's.
double shareOf(const QImage& picture, const SbColor& colour) {
  const QColor wanted = QColor::fromRgbF(static_cast<double>(colour[0]), static_cast<double>(colour[1]),
                                         static_cast<double>(colour[2]));
  int count = 0;
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const QColor pixel = picture.pixelColor(x, y);
      const int apart = std::abs(pixel.hsvHue() - wanted.hsvHue());
      count += pixel.hsvSaturation() > 60 && std::min(apart, 360 - apart) <= 8 ? 1 : 0;
    }
  }
  return static_cast<double>(count) / (picture.width() * picture.height());
}

TEST_F(DetailedLand, ShowsEachLevelInAColourOfItsOwn) {
  scene_->setTint([](const Mesh& mesh) { return levelColour(mesh.nodeLevel); });
  const QImage levels = picture();
  const std::vector<std::size_t> nodes = flight_->engine().figures().nodesAtLevel;
  int there = 0, seen = 0;
  for (int level = 0; level < 8; ++level) {
    const bool isThere =
        static_cast<std::size_t>(level) < nodes.size() && nodes[static_cast<std::size_t>(level)] > 0;
    const double share = shareOf(levels, levelColour(level));
    there += isThere ? 1 : 0;
    seen += share > 0.005 ? 1 : 0;
    if (isThere || level == 5) continue;  // as blue as the sky
    EXPECT_LT(share, 0.002) << level;
  }
  EXPECT_GE(there, 3);
  EXPECT_GE(seen, 3);
  scene_->setTint({});
  EXPECT_GT(difference(levels, picture()), 60);
}

TEST_F(DetailedLand, IsGreenWhereItIsAsRightAsWantedAndRedWhereItIsNot) {
  const Eye eye{eye_.pose.position, eye_.pose.height, lensPixels(kHigh, eye_.fieldOfView)};
  double wanted = 24.0;
  scene_->setTint([&](const Mesh& mesh) {
    return errorColour(pixelError(flight_->engine().world(), mesh, eye, land()->morph()) / wanted);
  });
  const auto count = [](const QImage& picture) {
    int red = 0, green = 0;
    for (int y = 0; y < picture.height(); ++y) {
      for (int x = 0; x < picture.width(); ++x) {
        const QRgb pixel = picture.pixel(x, y);
        red += qRed(pixel) > qGreen(pixel) + 40 ? 1 : 0;
        green += qGreen(pixel) > qRed(pixel) + 15 && qGreen(pixel) > qBlue(pixel) + 15 ? 1 : 0;
      }
    }
    return std::pair(red, green);
  };
  const double most = pixelError(flight_->engine().world(), *land(), eye).max;
  ASSERT_GT(most, 1.0);
  wanted = 1.01 * most;
  const auto [noRed, green] = count(picture());
  EXPECT_EQ(noRed, 0);
  EXPECT_GT(green, kWide * kHigh / 3);
  wanted = 0.1 * most;
  const auto [red, lessGreen] = count(picture());
  EXPECT_GT(red, kWide * kHigh / 10);
  EXPECT_LT(lessGreen, green);
}

TEST_F(DetailedLand, LetsTheSkyThroughAsWires) {
  const auto haze = [this](const QImage& picture) {
    int count = 0;
    const QColor wanted = QColor::fromRgbF(0.76, 0.84, 0.92);
    for (int y = kHigh * 3 / 4; y < kHigh; ++y) {
      for (int x = 0; x < kWide; ++x) {
        const QRgb pixel = picture.pixel(x, y);
        count += std::abs(qRed(pixel) - wanted.red()) + std::abs(qBlue(pixel) - wanted.blue()) < 40 ? 1 : 0;
      }
    }
    return count;
  };
  const QImage solid = picture();
  EXPECT_EQ(haze(solid), 0);
  scene_->setWires(true);
  const QImage wires = picture();
  EXPECT_GT(haze(wires), kWide * kHigh / 40);
  EXPECT_LT(haze(wires), kWide * kHigh / 4) << "there are wires";
  scene_->setWires(false);
  EXPECT_LE(difference(picture(), solid), 1);
}

TEST_F(DetailedLand, ShowsTheFrozenEyeAndWhatItSeesAsLinesFromOutside) {
  Viewpoint outside = eye_;
  outside.pose.position = outside.pose.position.movedBy(0.0, -900.0, kPitch).value();
  outside.pose.height += 500.0;
  outside.pose.pitch = -0.45;
  const auto yellow = [](const QImage& picture) {
    int count = 0;
    for (int y = 0; y < picture.height(); ++y) {
      for (int x = 0; x < picture.width(); ++x) {
        const QRgb pixel = picture.pixel(x, y);
        count += qRed(pixel) > 220 && qGreen(pixel) > 180 && qBlue(pixel) < 90 ? 1 : 0;
      }
    }
    return count;
  };
  EXPECT_EQ(yellow(picture(outside)), 0);
  scene_->freeze(eye_, static_cast<double>(kWide) / kHigh);
  const QImage frozen = picture(outside);
  EXPECT_GT(yellow(frozen), 150);
  Viewpoint behind = eye_;
  behind.pose.position = behind.pose.position.movedBy(0.0, -14.0, kPitch).value();
  behind.pose.pitch = 0.0;
  EXPECT_GT(paintedPixels(picture(behind)), 20) << "the aircraft one sat in is there too";
  scene_->thaw();
  EXPECT_EQ(yellow(picture(outside)), 0);
  EXPECT_EQ(paintedPixels(picture(behind)), 0);
}

}  // namespace
}  // namespace teren
