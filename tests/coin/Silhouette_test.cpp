// Where the land ends and the sky begins in pictures (law 7): what the vertex shader makes of a pixel error,
// with all that is left out of a picture, beside a reference four times as fine. The same is asked of the
// triangles themselves, without OpenGL, in tests/engine/stream/Silhouette_test.cpp.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iostream>
#include <memory>
#include <numbers>
#include <vector>

#include <Inventor/nodes/SoPerspectiveCamera.h>
#include <Inventor/nodes/SoSeparator.h>
#include <QImage>
#include <gtest/gtest.h>

#include "teren/Hash.h"

#include "coin/SceneZero.h"
#include "coin/SoTerrain.h"
#include "patch/ErrorCalibration.h"
#include "tests/coin/OffscreenView.h"
#include "tests/coin/Stage.h"
#include "tests/engine/stream/SilhouetteView.h"
#include "world/NodeErrors.h"

namespace teren {
namespace {

constexpr int kWidth = 1280, kHeight = 720;
// Detail is chosen for a picture of so few lines, so that each of its pixels is eight rows of ours.
constexpr double kLines = 90.0, kRowsPerPixel = kHeight / kLines;
constexpr double kDistance = 1200.0, kSight = 1100.0;  // [m] of the views, and of what is drawn
constexpr double kFieldOfView = std::numbers::pi / 4.0;

DetailSettings detailOf(double pixelError) {
  return {.pixelError = pixelError, .distance = kDistance, .lines = kLines, .fieldOfView = kFieldOfView};
}

/// The row of the highest ground in each column, kHeight where there is none.
std::vector<int> skyline(const QImage& picture) {
  const QRgb sky = qRgb(255, 0, 255);
  std::vector<int> rows;
  for (int x = 0; x < kWidth; ++x) {
    int y = 0;
    while (y < kHeight && picture.pixel(x, y) == sky) ++y;
    rows.push_back(y);
  }
  return rows;
}

class SilhouetteOfPictures : public testing::Test {
 protected:
  SilhouetteOfPictures() : view_(kWidth, kHeight) {
    stage_.terrain->waterLevel = -1e6F;
    stage_.terrain->viewDistance = static_cast<float>(10.0 * kDistance);
  }

  std::vector<int> skylineOf(const std::shared_ptr<const Scene>& scene, const Eye& eye, double pitch,
                             double heading) {
    SceneZero zero;
    zero.follow(eye.position, eye.height, pitch);
    const Offset away = offset(zero.position(), eye.position, pitch);
    stage_.terrain->origin = SbVec3d(zero.position().x(pitch), zero.position().y(pitch), zero.height());
    stage_.terrain->setScene(std::make_shared<const Scene>());
    stage_.terrain->setScene(scene);
    stage_.look(SbVec3f(static_cast<float>(away.east), static_cast<float>(away.north),
                        static_cast<float>(eye.height - zero.height())),
                heading, 0.0);
    stage_.camera->heightAngle = static_cast<float>(kFieldOfView);
    stage_.camera->nearDistance = 0.5F;
    stage_.camera->farDistance = static_cast<float>(kSight);
    return skyline(view_.picture(stage_.root, kMagenta));
  }

  Stage stage_;
  OffscreenView view_;
};

/// Differences [px] of two skylines, each as its place in the picture stretches it.
std::vector<double> differences(const std::vector<int>& a, const std::vector<int>& b) {
  std::vector<double> pixels;
  const double focal = 0.5 * kHeight / std::tan(0.5 * kFieldOfView);
  for (std::size_t x = 0; x < a.size(); ++x) {
    const double aside = (static_cast<double>(x) + 0.5 - 0.5 * kWidth) / focal;
    pixels.push_back(std::abs(a[x] - b[x]) / kRowsPerPixel / std::sqrt(1.0 + aside * aside));
  }
  return pixels;
}

TEST_F(SilhouetteOfPictures, AtOnePixelIsWithinWhatIsPromised) {
  const auto world = test::shippedWorld();
  ErrorCalibration calibration(*world);
  while (!calibration.step(Slice::unlimited())) {
  }
  test::SilhouetteView drawn(world, {.detail = detailOf(1.0)}, detailOf(1.0));
  test::SilhouetteView reference(world, {.detail = detailOf(0.25)}, detailOf(0.25));
  RandomSequence random(21);
  const auto metres = [&] { return (static_cast<double>(random.nextBits(30)) * 0x1p-29 - 1.0) * 1e5; };
  std::vector<double> errors;
  for (int level = 0; level <= world->topLevel(); ++level) {
    errors.push_back(world->nodeErrors().estimate(level));
  }
  std::vector<double> all, tooFar;
  for (const double above : {2.0, 30.0, 300.0}) {
    const double east = metres(), north = metres();
    const Position place = Position::fromMetres(east, north, world->pitch()).value();
    const double height = world->query(place).drawn + above;
    drawn.settleAt(place, height);
    reference.settleAt(place, height);
    const auto scene = drawn.engine().scene();
    // The same meshes, moved as if ten times as much might be wrong.
    const auto moved = std::make_shared<const Scene>(
        scene->serial(), scene->spacing(),
        std::vector<std::shared_ptr<const Mesh>>(scene->meshes().begin(), scene->meshes().end()),
        Morph(10.0 * static_cast<double>(scene->morph().tolerance()), errors));
    const double allowed = drawn.promised() + reference.promised() + 1.0 / kRowsPerPixel;
    for (const double heading : {0.0, 180.0}) {
      const auto fine = skylineOf(reference.engine().scene(), reference.eye(), world->pitch(), heading);
      const auto off = differences(skylineOf(scene, drawn.eye(), world->pitch(), heading), fine);
      EXPECT_LE(*std::max_element(off.begin(), off.end()), allowed)
          << above << " m above ground, heading " << heading;
      all.insert(all.end(), off.begin(), off.end());
      const auto far = differences(skylineOf(moved, drawn.eye(), world->pitch(), heading), fine);
      tooFar.insert(tooFar.end(), far.begin(), far.end());
    }
  }
  std::sort(all.begin(), all.end());
  std::sort(tooFar.begin(), tooFar.end());
  std::cout << "off by " << all[all.size() / 2] << " px in the median, p99 " << all[all.size() * 99 / 100]
            << ", at most " << all.back() << "; with vertices that move too far at most " << tooFar.back()
            << " px\n";
  EXPECT_GT(all.back(), 0.0);
  EXPECT_GT(tooFar.back(), all.back()) << "or else it would not matter how far they move";
}

}  // namespace
}  // namespace teren
