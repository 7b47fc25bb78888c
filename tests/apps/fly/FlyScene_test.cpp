// The pictures of the demo, camera, sky, aircraft, land and water together.
#include "apps/fly/FlyScene.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <vector>

#include <Inventor/nodes/SoSeparator.h>
#include <QImage>
#include <gtest/gtest.h>

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

}  // namespace
}  // namespace teren
