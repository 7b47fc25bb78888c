// Where vertices come out on the screen, asked from OpenGL itself and compared with long double.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <ostream>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <Inventor/SbVec3d.h>
#include <Inventor/nodes/SoPerspectiveCamera.h>
#include <Inventor/nodes/SoSeparator.h>
#include <gtest/gtest.h>

#include "teren/Hash.h"
#include "teren/Position.h"

#include "coin/OpenGL.h"
#include "coin/SceneZero.h"
#include "coin/SoTerrain.h"
#include "tests/coin/OffscreenView.h"
#include "tests/coin/Stage.h"

namespace teren {
namespace {

constexpr int kWidth = 1280, kHeight = 720;
constexpr double kMostStrayed = 0.05;  // [px]
constexpr int kIntervals = 1024;       // of a patch's side

/// [low, high)
double uniform(RandomSequence& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random.nextBits(53)) * 0x1p-53;
}

/// A place on the screen [px], from the lower left corner.
struct Pixel {
  long double x = 0.0L, y = 0.0L;
};

/// The corners of all triangles, in the order they are drawn, as OpenGL places them in the window: it is told
/// to hand them out instead of filling them.
std::vector<Pixel> cornersDrawn(OffscreenView& view, SoNode* root) {
  std::vector<float> tokens(16384);
  glFeedbackBuffer(static_cast<GLsizei>(tokens.size()), GL_2D, tokens.data());
  glRenderMode(GL_FEEDBACK);
  view.draw(root, kMagenta);
  const int count = glRenderMode(GL_RENDER);
  std::vector<Pixel> corners;
  for (int at = 0; at + 1 < count;) {
    if (tokens[static_cast<std::size_t>(at)] != static_cast<float>(GL_POLYGON_TOKEN)) return {};
    const int sides = static_cast<int>(tokens[static_cast<std::size_t>(at + 1)]);
    at += 2;
    for (int side = 0; side < sides; ++side, at += 2) {
      corners.push_back({tokens[static_cast<std::size_t>(at)], tokens[static_cast<std::size_t>(at + 1)]});
    }
  }
  return corners;
}

/// An eye in the world, and the ground that it looks at.
struct Look {
  double pitch = 64.0;  // [m] of the world's lattice
  Position eye;
  double eyeHeight = 0.0;
  SbRotation orientation;
  float fieldOfView = 0.8F;
  HandMade ground;
};

/// As the demo does it: the scene's zero follows the eye, and floats begin there.
void pose(const Stage& stage, const Look& look) {
  SceneZero zero;
  zero.follow(look.eye, look.eyeHeight, look.pitch);
  const Offset away = offset(zero.position(), look.eye, look.pitch);
  stage.terrain->origin =
      SbVec3d(zero.position().x(look.pitch), zero.position().y(look.pitch), zero.height());
  stage.camera->position = SbVec3f(static_cast<float>(away.east), static_cast<float>(away.north),
                                   static_cast<float>(look.eyeHeight - zero.height()));
  stage.camera->orientation = look.orientation;
  stage.camera->heightAngle = look.fieldOfView;
  stage.camera->nearDistance = 0.1F;
  stage.camera->farDistance = 1e6F;
}

/// Where a level-0 sample at this height belongs on the screen.
Pixel truth(const Look& look, std::int64_t column, std::int64_t row, float height) {
  const auto away = [&](std::int64_t sample, std::int64_t patch, double inPatch) {
    const auto samples = static_cast<long double>(sample - patch * kIntervals);
    return (samples - static_cast<long double>(inPatch) * kIntervals) *
           (static_cast<long double>(look.pitch) / kIntervals);
  };
  const std::array<long double, 3> place{
      away(column, look.eye.i, look.eye.u), away(row, look.eye.j, look.eye.v),
      static_cast<long double>(height) - static_cast<long double>(look.eyeHeight)};
  // Turned back by the quaternion (x, y, z, w) of the orientation.
  const float* q = look.orientation.getValue();
  const long double x = -q[0], y = -q[1], z = -q[2], w = q[3];
  const long double length = x * x + y * y + z * z + w * w;
  const std::array<long double, 3> across{y * place[2] - z * place[1], z * place[0] - x * place[2],
                                          x * place[1] - y * place[0]};
  std::array<long double, 3> turned{};
  const std::array<long double, 3> axis{x, y, z};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
    const long double twice = axis[l] * across[m] - axis[m] * across[l];
    turned[k] = place[k] + 2.0L * (w * across[k] + twice) / length;
  }
  const long double pixels =
      0.5L * kHeight / (-turned[2] * std::tan(0.5L * static_cast<long double>(look.fieldOfView)));
  return {0.5L * kWidth + turned[0] * pixels, 0.5L * kHeight + turned[1] * pixels};
}

/// Two triangles that fill a part of the picture, `distance` [m] before an eye that stands `patches` from the
/// world's zero.
Look randomLook(RandomSequence& random, double pitch, std::int64_t patches, double distance) {
  constexpr double kDegree = 0.017453292519943295;
  Look look;
  look.pitch = pitch;
  look.eye = {patches + static_cast<std::int64_t>(random.nextBits(20)),
              -patches - static_cast<std::int64_t>(random.nextBits(20)), uniform(random, 0.0, 1.0),
              uniform(random, 0.0, 1.0)};
  look.eyeHeight = uniform(random, -500.0, 4000.0);
  const double heading = uniform(random, 0.0, 360.0) * kDegree, down = uniform(random, 25.0, 80.0) * kDegree;
  look.orientation = SbRotation(SbVec3f(1.0F, 0.0F, 0.0F), static_cast<float>(90.0 * kDegree - down)) *
                     SbRotation(SbVec3f(0.0F, 0.0F, 1.0F), static_cast<float>(-heading));
  HandMade& ground = look.ground;
  ground.side = ground.intervals = 1;
  ground.spacing = pitch / kIntervals;
  while (2.0 * std::ldexp(ground.spacing, ground.level) < 0.2 * distance) ++ground.level;
  const double east = distance * std::cos(down) * std::sin(heading),
               north = distance * std::cos(down) * std::cos(heading);
  ground.column = look.eye.i * kIntervals + std::llround(look.eye.u * kIntervals + east / ground.spacing) -
                  (std::int64_t{1} << ground.level) / 2;
  ground.row = look.eye.j * kIntervals + std::llround(look.eye.v * kIntervals + north / ground.spacing) -
               (std::int64_t{1} << ground.level) / 2;
  const double height = look.eyeHeight - distance * std::sin(down);
  const double roughness = 0.03 * distance * uniform(random, -1.0, 1.0) / std::ldexp(1.0, ground.level);
  ground.height = [height, roughness](double x, double y) { return height + roughness * (x + 0.3 * y); };
  return look;
}

/// The farthest [px] that a corner comes out from where it belongs.
struct Strayed {
  double most = 0.0, distance = 0.0;
  int corners = 0;
};

Strayed strayedAt(double pitch, std::int64_t patches, std::uint64_t seed) {
  constexpr int kLooks = 400, kFrames = 4;
  constexpr double kNearest = 0.5, kFarthest = 1e5;  // [m]
  const Stage stage;
  stage.terrain->waterLevel = -2e6F;
  OffscreenView view(kWidth, kHeight);
  view.draw(stage.root, kMagenta);
  RandomSequence random(seed);
  Strayed strayed;
  for (int trial = 0; trial < kLooks; ++trial) {
    const double distance = kNearest * std::pow(kFarthest / kNearest, uniform(random, 0.0, 1.0));
    Look look = randomLook(random, pitch, patches, distance);
    look.ground.firstId = static_cast<std::uint64_t>(trial) + 1;
    const auto scene = makeScene(look.ground);
    const Mesh& mesh = *scene->meshes().front();
    stage.terrain->setScene(std::make_shared<const Scene>());
    stage.terrain->setScene(scene);
    for (int frame = 0; frame < kFrames; ++frame) {
      pose(stage, look);
      const std::vector<Pixel> drawn = cornersDrawn(view, stage.root);
      EXPECT_EQ(drawn.size(), mesh.indices->size()) << "trial " << trial;
      for (std::size_t k = 0; k < std::min(drawn.size(), mesh.indices->size()); ++k) {
        const SurfaceVertex& vertex = mesh.vertices[(*mesh.indices)[k]];
        const Pixel wanted = truth(look, mesh.originColumn + (std::int64_t{vertex.column} << mesh.level),
                                   mesh.originRow + (std::int64_t{vertex.row} << mesh.level), vertex.height);
        const auto away = static_cast<double>(std::hypot(drawn[k].x - wanted.x, drawn[k].y - wanted.y));
        if (away > strayed.most) strayed = {away, distance, strayed.corners};
        ++strayed.corners;
      }
      const double step = 0.01 * distance;  // [m] the eye moves on
      look.eye = *look.eye.movedBy(uniform(random, -step, step), uniform(random, -step, step), pitch);
      look.eyeHeight += uniform(random, -step, step);
    }
  }
  return strayed;
}

struct Place {
  const char* name;
  double pitch;
  double away;  // [m] from the world's zero
  bool shaders;
};
void PrintTo(const Place& place, std::ostream* stream) {
  *stream << place.name;
}

class Precision : public ::testing::TestWithParam<Place> {};

TEST_P(Precision, OfEveryVertexIsAFractionOfAPixelWhereverTheCameraMoves) {
  constexpr std::uint64_t kSeed = 61;
  RecordProperty("seed", static_cast<int>(kSeed));
  const Place& place = GetParam();
  if (!place.shaders) setenv("TEREN_NO_SHADERS", "1", 1);
  const Strayed strayed = strayedAt(place.pitch, static_cast<std::int64_t>(place.away / place.pitch), kSeed);
  unsetenv("TEREN_NO_SHADERS");
  RecordProperty("strayed_millipixels", std::to_string(1000.0 * strayed.most));
  EXPECT_GT(strayed.corners, 9000);
  EXPECT_LT(strayed.most, kMostStrayed) << "of a vertex " << strayed.distance << " m away";
}

/// How many places on the screen the corners of hand-made ground have, over some random looks, beyond the one
/// that each sample should have.
int placesTooMany(std::uint64_t seed) {
  constexpr int kLooks = 200, kVertices = 17;  // along a side of the ground
  const std::int64_t far = (std::int64_t{1} << 40) + 400;
  const double spacing = 0.7;
  const Stage stage;
  stage.terrain->waterLevel = -2e6F;
  stage.terrain->origin =
      SbVec3d(static_cast<double>(far) * spacing, static_cast<double>(-far) * spacing, 0.0);
  stage.terrain->setScene(
      makeScene({.side = 4, .intervals = 4, .column = far, .row = -far, .spacing = spacing}));
  OffscreenView view(kWidth, kHeight);
  view.draw(stage.root, kMagenta);
  RandomSequence random(seed);
  int more = 0;
  for (int look = 0; look < kLooks; ++look) {
    stage.look(
        SbVec3f(static_cast<float>(uniform(random, 5.0, 6.0)), static_cast<float>(uniform(random, 5.0, 6.0)),
                static_cast<float>(uniform(random, 30.0, 36.0))),
        uniform(random, 0.0, 360.0), uniform(random, -90.0, -85.0));
    std::set<std::pair<long double, long double>> places;
    for (const Pixel& corner : cornersDrawn(view, stage.root)) places.emplace(corner.x, corner.y);
    EXPECT_GE(places.size(), std::size_t{kVertices * kVertices}) << "look " << look;
    more += static_cast<int>(places.size()) - kVertices * kVertices;
  }
  return more;
}

TEST(SharedVertices, OfNeighbouringMeshesAreInOnePlaceToTheLastBit) {
  EXPECT_EQ(placesTooMany(62), 0);
}

TEST(SharedVertices, OfNeighbouringMeshesAreInOnePlaceWithoutShadersToo) {
  setenv("TEREN_NO_SHADERS", "1", 1);
  EXPECT_EQ(placesTooMany(63), 0);
  unsetenv("TEREN_NO_SHADERS");
}

INSTANTIATE_TEST_SUITE_P(
    EveryWayOfDrawing, Precision,
    ::testing::Values(Place{"shaders", 64.0, 1e12, true},
                      Place{"shaders, a pitch that doubles cannot hold", 44.7, 1e12, true},
                      Place{"fixed function", 64.0, 1e12, false},
                      Place{"fixed function, a pitch that doubles cannot hold", 44.7, 1e12, false}));

}  // namespace
}  // namespace teren
