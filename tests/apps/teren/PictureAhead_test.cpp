#include "apps/teren/PictureAhead.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include <gtest/gtest.h>

#include "teren/PluginRegistry.h"

namespace teren {
namespace {

/// 64 m a patch, 16 intervals; the ground lies somewhere, meshes are made by hand.
std::shared_ptr<const World> world() {
  WorldDescription description = WorldDescription::standard();
  description.samples = 33;
  return World::create(description, *PluginRegistry::standard()).value();
}

/// One triangle's width of ground at `height`, so many metres from the world's zero; 4 m a side.
Mesh spot(double east, double north, double height) {
  Mesh mesh;
  mesh.originColumn = std::llround(east / 4.0);
  mesh.originRow = std::llround(north / 4.0);
  mesh.columns = mesh.rows = 1;
  mesh.minHeight = mesh.maxHeight = static_cast<float>(height);
  return mesh;
}

/// From the world's zero.
Motion eyeGoing(double east, double north, double up = 0.0) {
  Motion eye;
  eye.east = east;
  eye.north = north;
  eye.up = up;
  return eye;
}

constexpr double kFieldOfView = 0.785;

struct Sight {
  explicit Sight(const Motion& eye) : land(world()), picture(*land, eye, {.fieldOfView = kFieldOfView}) {}
  /// What lies 1000 m ahead of an eye at the world's zero that looks north, so far [pictures] from the middle
  /// to the right and upwards.
  bool shows(double right, double up) const {
    const double half = 1000.0 * std::tan(0.5 * kFieldOfView);
    return picture.mayShow(spot(right * half * 16.0 / 9.0, 1000.0, up * half));
  }
  std::shared_ptr<const World> land;
  PictureAhead picture;
};

TEST(PictureAhead, ShowsWhatLiesBetweenItsEdges) {
  const Sight sight(eyeGoing(0.0, 30.0));
  EXPECT_TRUE(sight.shows(0.0, 0.0));
  for (const double side : {-1.0, 1.0}) {
    EXPECT_TRUE(sight.shows(0.97 * side, 0.0));
    EXPECT_FALSE(sight.shows(1.03 * side, 0.0));
    EXPECT_TRUE(sight.shows(0.0, 0.97 * side));
    EXPECT_FALSE(sight.shows(0.0, 1.03 * side));
  }
  EXPECT_FALSE(sight.picture.mayShow(spot(0.0, -1000.0, 0.0)));
}

TEST(PictureAhead, TurnsWithTheFlight) {
  const double turn = std::numbers::pi / 3.0;
  Motion eye = eyeGoing(std::sin(turn), std::cos(turn));
  const auto at = [&](double angle) {
    return Sight(eye).picture.mayShow(spot(2000.0 * std::sin(angle), 2000.0 * std::cos(angle), 0.0));
  };
  EXPECT_TRUE(at(turn));
  EXPECT_FALSE(at(turn - 0.7));
  EXPECT_FALSE(at(turn + 0.7));
  EXPECT_FALSE(at(turn + std::numbers::pi));
  eye = eyeGoing(0.0, 1.0, 1.0);
  EXPECT_TRUE(Sight(eye).picture.mayShow(spot(0.0, 1000.0, 1000.0)));
  EXPECT_FALSE(Sight(eye).picture.mayShow(spot(0.0, 1000.0, 0.0)));
}

TEST(PictureAhead, LooksNorthWhereItStandsAndKnowsWhereThatIs) {
  EXPECT_TRUE(Sight({}).shows(0.0, 0.0));
  Motion far;
  far.position = {std::int64_t{1} << 50, -5, 0.5, 0.25};
  far.height = 700.0;
  Mesh mesh = spot(32.0, 1000.0, 700.0);
  const Sight sight(far);
  EXPECT_FALSE(sight.picture.mayShow(mesh));
  mesh.originColumn += far.position.i * 16;
  mesh.originRow += far.position.j * 16;
  EXPECT_TRUE(sight.picture.mayShow(mesh));
  mesh.minHeight = mesh.maxHeight = 0.0F;
  EXPECT_FALSE(sight.picture.mayShow(mesh));
}

TEST(PictureAhead, EndsAtTheDistanceThatTheLandIsWantedTo) {
  const auto land = world();
  const PictureAhead picture(*land, eyeGoing(0.0, 30.0), {.distance = 5000.0, .fieldOfView = kFieldOfView});
  EXPECT_TRUE(picture.mayShow(spot(0.0, 4992.0, 0.0)));
  EXPECT_FALSE(picture.mayShow(spot(0.0, 5012.0, 0.0)));
  EXPECT_TRUE(picture.mayShow(spot(0.0, 4992.0, -1500.0))) << "across the ground";
  EXPECT_FALSE(picture.mayShow(spot(2500.0, 4500.0, 0.0)));
}

TEST(PictureAhead, TakesTheMeshesItMayShowOutOfAScene) {
  const auto ahead = std::make_shared<Mesh>(spot(0.0, 500.0, 0.0));
  const auto behind = std::make_shared<Mesh>(spot(0.0, -500.0, 0.0));
  const Scene shown = Sight({}).picture.of(Scene(7, 4.0, {behind, ahead}));
  EXPECT_EQ(shown.serial(), 7U);
  EXPECT_EQ(shown.spacing(), 4.0);
  ASSERT_EQ(shown.meshes().size(), 1U);
  EXPECT_EQ(shown.meshes()[0], ahead);
}

TEST(PictureAhead, ShowsWhatItStandsOnTheEdgeOf) {
  Mesh wide = spot(-2000.0, -2000.0, 0.0);  // all around the eye, and below it
  wide.columns = wide.rows = 1000;
  wide.minHeight = -100.0F;
  EXPECT_TRUE(Sight({}).picture.mayShow(wide));
}

}  // namespace
}  // namespace teren
