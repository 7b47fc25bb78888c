// Edits in land that is being drawn: shown everywhere at once, closed at every moment, at every level, and
// the same after all of it was dropped and made again.
#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "teren/EditedGround.h"
#include "teren/Hash.h"
#include "teren/PixelError.h"

#include "tests/engine/stream/EditedLand.h"

namespace teren {
namespace {

using Place = std::array<std::int64_t, 2>;
using Corner = std::array<std::int64_t, 3>;  // and the bits of the height

struct Edges {
  std::size_t openOnTheMap = 0, open = 0;
  bool isOneSurface = true;  // no edge twice in one direction, one height and normal at each place
};

Edges edgesOf(const Scene& scene) {
  std::multiset<std::pair<Place, Place>> flat;
  std::multiset<std::pair<Corner, Corner>> edges;
  std::map<Place, std::array<std::uint32_t, 2>> vertices;
  Edges result;
  for (const auto& mesh : scene.meshes()) {
    const auto corner = [&](std::uint32_t number) {
      const SurfaceVertex& vertex = mesh->vertices[number];
      const Corner at{mesh->originColumn + (std::int64_t{vertex.column} << mesh->level),
                      mesh->originRow + (std::int64_t{vertex.row} << mesh->level),
                      std::bit_cast<std::int32_t>(vertex.height)};
      const std::array<std::uint32_t, 2> look{
          std::bit_cast<std::uint32_t>(vertex.height),
          static_cast<std::uint32_t>(static_cast<std::uint16_t>(vertex.normalX)) << 16 |
              static_cast<std::uint16_t>(vertex.normalY)};
      const auto [known, isNew] = vertices.emplace(Place{at[0], at[1]}, look);
      result.isOneSurface = result.isOneSurface && (isNew || known->second == look);
      return at;
    };
    const TriangleIndices& indices = *mesh->indices;
    for (std::size_t first = 0; first < indices.size(); first += 3) {
      const std::array<Corner, 3> at{corner(indices[first]), corner(indices[first + 1]),
                                     corner(indices[first + 2])};
      for (std::size_t c = 0; c < 3; ++c) {
        const Corner &from = at[c], &to = at[(c + 1) % 3];
        edges.insert({from, to});
        flat.insert({{from[0], from[1]}, {to[0], to[1]}});
      }
    }
  }
  for (const auto& [from, to] : edges) {
    result.isOneSurface = result.isOneSurface && edges.count({from, to}) == 1;
    result.open += edges.count({to, from}) == 0;
  }
  for (const auto& [from, to] : flat) result.openOnTheMap += flat.count({to, from}) == 0;
  return result;
}

void expectClosed(const Scene& scene) {
  const Edges edges = edgesOf(scene);
  EXPECT_TRUE(edges.isOneSurface) << "serial " << scene.serial();
  EXPECT_EQ(edges.open, edges.openOnTheMap) << "a crack in serial " << scene.serial();
}

std::uint64_t hashOf(const Scene& scene) {
  std::map<Corner, int> corners;
  for (const auto& mesh : scene.meshes()) {
    for (const SurfaceVertex& vertex : mesh->vertices) {
      ++corners[{mesh->originColumn + (std::int64_t{vertex.column} << mesh->level),
                 mesh->originRow + (std::int64_t{vertex.row} << mesh->level),
                 std::bit_cast<std::int32_t>(vertex.height)}];
    }
  }
  std::uint64_t hash = 0;
  for (const auto& [corner, count] : corners) {
    for (const std::int64_t word : corner) hash = hashWith(hash, static_cast<std::uint64_t>(word));
  }
  return hash;
}

TEST_P(EditedLand, IsDrawnAsItWasEdited) {
  engine->settle();
  digAndShow(0.0, 0.0, 30.0, 8.0);
  digAndShow(150.0, -90.0, 50.0, 5.0);
  expectClosed(*engine->scene());
  int compared = 0;
  for (int turn = 0; turn < 3000; ++turn) {
    // At a sample of level 3, which is one of all finer ones, too.
    const double step = 8.0 * world->spacing(0);
    const Position place =
        at(step * std::round(metres(-250.0, 250.0) / step), step * std::round(metres(-250.0, 250.0) / step));
    const std::optional<double> drawn = engine->drawnHeight(place), finest = engine->finestHeight(place);
    const double edited = truth(place);
    if (finest) {
      ASSERT_NEAR(*finest, edited, 1e-4);
    }
    if (!drawn) continue;  // beyond the view
    DrawnPoint point;
    engine->sceneQuery()->points({&place, 1}, {&point, 1});
    ASSERT_TRUE(point.there);
    if (point.level > 3 || std::fabs(edited - world->query(place).drawn) < 1.0) continue;
    ASSERT_NEAR(*drawn, edited, 1e-4);
    ++compared;
  }
  EXPECT_GT(compared, 20);
}

TEST_P(EditedLand, IsClosedInEveryPictureOnTheWay) {
  engine->settle();
  std::set<std::uint64_t> shown;
  for (int turn = 0; turn < 4; ++turn) {
    moveTo(10.0 + 20.0 * turn, 20.0);
    const EditedGround::Snapshot dug =
        dig(metres(-100.0, 200.0), metres(-100.0, 100.0), metres(8.0, 60.0), 6.0);
    engine->setEdits(dug.edits, dug.changed);
    for (int update = 0; update < 400; ++update) {
      engine->update(1.0 / 60.0, std::chrono::microseconds(100));
      if (!shown.insert(engine->scene()->serial()).second) continue;
      expectClosed(*engine->scene());
      if (HasFailure()) return;
    }
    engine->settle();
    const Position place = at(10.0 + 20.0 * turn, 20.0);
    EXPECT_NEAR(*engine->finestHeight(place), truth(place), 1e-4);
  }
  EXPECT_GT(shown.size(), 4U);
}

TEST_P(EditedLand, IsTheSameAfterItWasDroppedAndMadeAgain) {
  ASSERT_TRUE(isMeasured());
  digAndShow(0.0, 0.0, 40.0, 10.0);
  const std::uint64_t before = hashOf(*engine->scene());
  moveTo(60'000.0, 40'000.0);
  engine->settle();
  EXPECT_FALSE(engine->drawnHeight(at(0.0, 0.0))) << "it has to be gone";
  EXPECT_NE(hashOf(*engine->scene()), before);
  moveTo(10.0, 20.0);
  engine->settle();
  EXPECT_EQ(hashOf(*engine->scene()), before);
}

TEST_P(EditedLand, IsTheSameWhetherItWasThereWhenItWasEditedOrNot) {
  ASSERT_TRUE(isMeasured());
  const EditedGround::Snapshot dug = dig(0.0, 0.0, 40.0, 10.0);
  engine->setEdits(dug.edits, dug.changed);
  engine->settle();
  const std::uint64_t after = hashOf(*engine->scene());
  auto other = Engine::create(world, engine->options());
  ASSERT_TRUE(other.ok());
  auto& puppet = static_cast<Puppet&>((*other)->add(std::make_unique<Puppet>()));
  puppet.place = engine->object(0).motion();
  (*other)->settle();
  EXPECT_NE(hashOf(*(*other)->scene()), after);
  (*other)->setEdits(dug.edits, dug.changed);
  (*other)->settle();
  EXPECT_EQ(hashOf(*(*other)->scene()), after);
}

TEST_P(EditedLand, TellsHowFarDrawnGroundIsOffWhereItWasEdited) {
  engine->settle();
  ASSERT_TRUE(isMeasured());
  for (const double east : {0.0, 400.0, 900.0, 1700.0}) digAndShow(east, 0.0, 40.0, 60.0);
  engine->settle();
  const auto query = engine->sceneQuery();
  int asked = 0, far = 0;
  for (int turn = 0; turn < 20'000; ++turn) {
    const Position place = at(metres(-300.0, 2000.0), metres(-250.0, 250.0));
    DrawnPoint point;
    query->points({&place, 1}, {&point, 1});
    if (!point.there) continue;
    const double off = std::fabs(point.height - truth(place));
    ASSERT_LE(off, point.error + 1e-3) << "level " << int{point.level};
    ++asked;
    far += off > 0.5;
  }
  EXPECT_GT(asked, 1000);
  const bool isCoarse = GetParam().view.detail || GetParam().view.level > 0;
  EXPECT_GT(far, isCoarse ? 50 : -1) << "or else nothing was tried";
}

INSTANTIATE_TEST_SUITE_P(, EditedLand,
                         testing::Values(Land{"OfLevel0", kFinest, 0, 0}, Land{"OfLevel1", kCoarser, 0, 0},
                                         Land{"OfLevel0Far", kFinest, 2, -(std::int64_t{1} << 20)},
                                         Land{"ByError", kByError, 0, 0},
                                         Land{"ByErrorOfWorkers", kByError, 2, 0},
                                         Land{"ByErrorFar", kByError, 0, std::int64_t{1} << 20}),
                         [](const auto& land) { return std::string(land.param.name); });

class EditedDetail : public EditedLand {};
INSTANTIATE_TEST_SUITE_P(, EditedDetail, testing::Values(Land{"ByError", kByError, 0, 0}),
                         [](const auto& land) { return std::string(land.param.name); });

TEST_P(EditedDetail, ShowsDeepHolesFarAwayAsExactlyAsItWasAskedFor) {
  engine->settle();
  ASSERT_TRUE(isMeasured());
  engine->settle();
  const auto levelAt = [&](const Position& place) {
    DrawnPoint point;
    engine->sceneQuery()->points({&place, 1}, {&point, 1});
    EXPECT_TRUE(point.there);
    return int{point.level};
  };
  const Position place = at(1920.0, 0.0);
  const int before = levelAt(place);
  digAndShow(1920.0, 0.0, 45.0, 150.0);
  EXPECT_LT(levelAt(place), before);
  const Eye eye{engine->object(0).motion().position, 60.0, lensPixels(kDetail.lines, kDetail.fieldOfView)};
  EXPECT_LE(pixelError(*world, *engine->scene(), eye).max, kDetail.pixelError * (1.0 + 1e-5));
  EXPECT_NEAR(*engine->drawnHeight(place), truth(place), 15.0) << "the hole is seen";
}

}  // namespace
}  // namespace teren
