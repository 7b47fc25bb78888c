// Stamps, slides and clean-up in random order, with random tools at random places: nothing may break, ever.
// TEREN_FULL=1 plays a hundred times as long, a sanitizer a tenth.
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/generators/sand/RandomGame.h"
#include "tests/support/TrialSize.h"

namespace teren {
namespace {

int operations() {
  return test::trials(100'000, 10'000'000);
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

TEST(RandomPlay, ComesToRestWithNoLooseFaceTooSteep) {
  const std::vector<ToolShape> tools = toolbox();
  std::vector<std::uint64_t> seeds{3923, 4985};  // where clean-up and division would go on long
  for (int seed = 1; seed <= operations() / 1'600; ++seed) seeds.push_back(static_cast<std::uint64_t>(seed));
  int most = 0;
  for (const std::uint64_t seed : seeds) {
    RandomGame game(seed);
    for (int n = 0; n < 150 && !game.isOver(); ++n) game.play(tools);
    const int iterations = game.iterationsToRest(20);
    ASSERT_LE(iterations, 14) << "log2 of the vertices and two; seed " << seed;
    ASSERT_LE(game.excess(), 0.0) << "seed " << seed;
    ASSERT_EQ(game.fault(), "") << "seed " << seed;
    most = std::max(most, iterations);
  }
  RecordProperty("iterations", most);
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
