#include "apps/static/Pieces.h"

#include <set>
#include <utility>

#include <gtest/gtest.h>

#include "teren/Engine.h"

namespace teren {
namespace {

class Stone final : public Object {
 public:
  explicit Stone(const Position& position) { motion_.position = position; }
  void update(double, const Ground&) override {}
  Motion motion() const override { return motion_; }

 private:
  Motion motion_;
};

/// The settled view of nine nodes around a position.
std::unique_ptr<Engine> ninePatches(int samples, int level, const Position& position) {
  WorldDescription description;
  description.samples = samples;
  LayerDescription layer;
  layer.generator = "fault";
  layer.pitch = 256.0;
  description.layers = {layer};
  EngineOptions options;
  options.view = {.level = level, .radius = 1};
  std::unique_ptr<Engine> engine =
      Engine::create(World::create(description, *PluginRegistry::standard()).value(), options).value();
  engine->add(std::make_unique<Stone>(position));
  engine->settle();
  return engine;
}

TEST(Pieces, AreNinePatchesTwelveSeamsAndFourCornerPiecesEachInItsPlace) {
  constexpr std::int64_t kFar = std::int64_t{1} << 40;
  for (const int samples : {9, 17, 65}) {
    for (const int level : {0, 1}) {
      for (const Position& position :
           {Position{0, 0, 0.5, 0.5}, Position{-1, 3, 0.5, 0.5}, Position{kFar, -kFar}}) {
        const std::unique_ptr<Engine> engine = ninePatches(samples, level, position);
        const std::vector<Piece> pieces = piecesOf(*engine->scene(), engine->world().intervals());
        ASSERT_EQ(pieces.size(), 25U) << samples << " samples, level " << level;
        std::set<std::pair<int, int>> places;
        for (const Piece& piece : pieces) {
          places.insert({piece.column, piece.row});
          const int inside = engine->world().intervals() - 2;
          EXPECT_EQ(piece.mesh->columns, piece.column % 2 == 0 ? inside : 2);
          EXPECT_EQ(piece.mesh->rows, piece.row % 2 == 0 ? inside : 2);
          EXPECT_TRUE(0 <= piece.column && piece.column < 5 && 0 <= piece.row && piece.row < 5);
          const bool even = piece.column % 2 == 0 && piece.row % 2 == 0;
          const bool odd = piece.column % 2 == 1 && piece.row % 2 == 1;
          EXPECT_EQ(piece.kind(), even ? PieceKind::patch : odd ? PieceKind::corner : PieceKind::seam);
        }
        EXPECT_EQ(places.size(), 25U);
      }
    }
  }
  EXPECT_TRUE(piecesOf(Scene(), 32).empty());
}

TEST(Pieces, LieTogetherAtZeroAndApartAtOneWithoutTouching) {
  constexpr double kSide = 64.0;
  for (int column = 0; column < 5; ++column) {
    for (int row = 0; row < 5; ++row) {
      const Piece piece{nullptr, column, row};
      const Shift together = shiftOf(piece, 5, 5, kSide, 0.0), apart = shiftOf(piece, 5, 5, kSide, 1.0);
      EXPECT_EQ(together.east, 0.0);
      EXPECT_EQ(together.north, 0.0);
      EXPECT_EQ(together.up, 0.0);
      EXPECT_EQ(apart.east, 16.0 * (column - 2));
      EXPECT_EQ(apart.north, 16.0 * (row - 2));
      const Shift half = shiftOf(piece, 5, 5, kSide, 0.5);
      EXPECT_EQ(half.east, apart.east / 2.0);
      EXPECT_EQ(half.up, apart.up / 2.0);
    }
  }
  EXPECT_EQ(shiftOf({nullptr, 2, 2}, 5, 5, kSide, 1.0).up, 0.0);
  EXPECT_GT(shiftOf({nullptr, 1, 2}, 5, 5, kSide, 1.0).up, 0.0);
  EXPECT_GT(shiftOf({nullptr, 1, 1}, 5, 5, kSide, 1.0).up, shiftOf({nullptr, 1, 2}, 5, 5, kSide, 1.0).up);
}

}  // namespace
}  // namespace teren
