// Stamps, slides and clean-up in random order, with random tools at random places: nothing may break, ever.
// TEREN_FULL=1 plays a hundred times as long.
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/generators/sand/RandomGame.h"

namespace teren {
namespace {

int operations() {
  return std::getenv("TEREN_FULL") != nullptr ? 10'000'000 : 100'000;
}

TEST(RandomPlay, NeverBreaksTheMeshNorLosesVolume) {
  const std::vector<ToolShape> tools = toolbox();
  const int most = operations();
  std::uint64_t seed = 61;
  auto game = std::make_unique<RandomGame>(seed);
  int sinceChecked = 0;
  for (int n = 0; n < most; ++n) {
    game->play(tools);
    if (++sinceChecked == 100 || game->isOver()) {
      ASSERT_EQ(game->fault(), "") << "after operation " << n << ", seed " << seed;
      sinceChecked = 0;
    }
    if (game->isOver()) game = std::make_unique<RandomGame>(++seed);
  }
  RecordProperty("games", static_cast<int>(seed - 60));
}

TEST(RandomPlay, IsSoundAfterEverySingleOperation) {
  const std::vector<ToolShape> tools = toolbox();
  for (std::uint64_t seed = 1'001; seed < 1'011; ++seed) {
    RandomGame game(seed);
    for (int n = 0; n < operations() / 1'000 && !game.isOver(); ++n) {
      game.play(tools);
      ASSERT_EQ(game.fault(), "") << "after operation " << n << ", seed " << seed;
    }
  }
}

}  // namespace
}  // namespace teren
