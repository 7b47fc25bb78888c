// Where the land ends and the sky begins: at a pixel error it may be off by no more than what is promised for
// it (law 7). The reference is drawn at level 0 throughout: finer than any pixel error asks for, and right
// whatever is believed of errors.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <memory>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Hash.h"

#include "patch/ErrorCalibration.h"
#include "tests/engine/stream/SilhouetteView.h"

namespace teren {
namespace {

constexpr double kDistance = 1200.0;  // [m] of the view
constexpr double kSight = 1100.0;     // [m] rays end where both views still have land
constexpr double kLines = 90.0;       // [px] of the picture, low enough for five levels within that distance
constexpr int kColumns = 180;

/// [rad] How high above the horizontal the land reaches in this direction, to 1e-9.
double skyline(const SceneQuery& query, const Eye& eye, double heading) {
  double land = -0.5 * std::numbers::pi + 1e-3, sky = -land;
  while (sky - land > 1e-9) {
    const double middle = 0.5 * (land + sky);
    const double level = std::cos(middle);
    const Ray ray{eye.position,
                  eye.height,
                  {level * std::sin(heading), level * std::cos(heading), std::sin(middle)},
                  kSight};
    RayHit hit;
    query.firstHits({&ray, 1}, {&hit, 1});
    (hit.end == RayEnd::ground ? land : sky) = middle;
  }
  return land;
}

/// Differences [px] of two skylines in all directions, ascending.
std::vector<double> differences(test::SilhouetteView& drawn, test::SilhouetteView& reference) {
  const auto coarse = drawn.engine().sceneQuery(), fine = reference.engine().sceneQuery();
  std::vector<double> pixels;
  for (int column = 0; column < kColumns; ++column) {
    const double heading = 2.0 * std::numbers::pi * column / kColumns;
    const double off = skyline(*coarse, drawn.eye(), heading) - skyline(*fine, drawn.eye(), heading);
    pixels.push_back(std::fabs(off) * drawn.lens());
  }
  std::sort(pixels.begin(), pixels.end());
  return pixels;
}

/// An eye so far [m] above the ground at a random place.
void goSomewhere(RandomSequence& random, double above, test::SilhouetteView& drawn,
                 test::SilhouetteView& reference) {
  const World& world = drawn.engine().world();
  const auto metres = [&] { return (static_cast<double>(random.nextBits(30)) * 0x1p-29 - 1.0) * 1e5; };
  const double east = metres(), north = metres();
  const Position place = Position::fromMetres(east, north, world.pitch()).value();
  const double height = world.query(place).drawn + above;
  drawn.settleAt(place, height);
  reference.settleAt(place, height);
}

TEST(Silhouette, AtOnePixelIsWithinWhatIsPromised) {
  const auto world = test::shippedWorld();
  ErrorCalibration calibration(*world);
  while (!calibration.step(Slice::unlimited())) {
  }
  const DetailSettings detail{.pixelError = 1.0, .distance = kDistance, .lines = kLines};
  test::SilhouetteView drawn(world, {.detail = detail}, detail);
  test::SilhouetteView reference(world, {0, ViewSettings::radiusFor(kDistance, 0, *world)}, detail);
  RandomSequence random(20);
  std::vector<double> all;
  for (const double above : {2.0, 30.0, 300.0}) {
    goSomewhere(random, above, drawn, reference);
    const std::vector<double> pixels = differences(drawn, reference);
    std::cout << above << " m above ground: promised " << drawn.promised() << " px; off by "
              << pixels[pixels.size() / 2] << " px in the median, at most " << pixels.back() << "; meshes "
              << drawn.engine().scene()->meshes().size() << ", "
              << reference.engine().scene()->meshes().size() << "\n";
    EXPECT_LE(drawn.promised(), 1.0 + 1e-6) << "moved vertices come as near to it as rounding lets them";
    EXPECT_EQ(reference.promised(), 0.0);
    EXPECT_LE(pixels.back(), drawn.promised()) << above << " m above ground";
    all.insert(all.end(), pixels.begin(), pixels.end());
  }
  std::sort(all.begin(), all.end());
  std::cout << "p99 " << all[all.size() * 99 / 100] << ", largest " << all.back() << " px\n";
  EXPECT_GT(all.back(), 0.0);
}

}  // namespace
}  // namespace teren
