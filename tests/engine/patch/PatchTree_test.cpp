#include "patch/PatchTree.h"

#include <memory>
#include <random>
#include <set>
#include <tuple>

#include <gtest/gtest.h>

namespace teren {
namespace {

using Tree = PatchTree<std::shared_ptr<int>>;

std::shared_ptr<int> number(int value) {
  return std::make_shared<int>(value);
}

TEST(PatchTree, StartsAsOneNodeAndGrowsANewRootWhenAskedOutsideItself) {
  Tree tree;
  EXPECT_EQ(tree.rootLevel({0, 0, 0}), -1);
  *tree.find({0, 5, 3}, LookUp::create) = number(1);
  EXPECT_EQ(tree.rootLevel({0, 5, 3}), 0);
  EXPECT_EQ(tree.nodeCount(), 1U);
  *tree.find({0, 4, 2}, LookUp::create) = number(2);  // (2, 1) at level 1 contains both
  EXPECT_EQ(tree.rootLevel({0, 5, 3}), 1);
  *tree.find({0, 0, 0}, LookUp::create) = number(3);
  EXPECT_EQ(tree.rootLevel({0, 5, 3}), 3);
  EXPECT_EQ(**tree.find({0, 5, 3}, LookUp::none), 1);
  EXPECT_EQ(**tree.find({0, 4, 2}, LookUp::none), 2);
  EXPECT_EQ(**tree.find({0, 0, 0}, LookUp::none), 3);
}

TEST(PatchTree, GrowsWhenAskedForACoarserNodeThanItsRoot) {
  Tree tree;
  *tree.find({0, 5, 3}, LookUp::create) = number(1);
  *tree.find({4, 0, 0}, LookUp::create) = number(2);
  EXPECT_EQ(tree.rootLevel({0, 5, 3}), 4);
  EXPECT_EQ(**tree.find({0, 5, 3}, LookUp::none), 1);
}

TEST(PatchTree, KeepsQuadrantsApartBecauseAlignedNodesAcrossAnAxisShareNoAncestor) {
  Tree tree;
  for (const std::int64_t i : {-1, 0}) {
    for (const std::int64_t j : {-1, 0})
      *tree.find({0, i, j}, LookUp::create) = number(static_cast<int>(i * 2 + j));
  }
  EXPECT_EQ(tree.nodeCount(), 4U);
  for (const std::int64_t i : {-1, 0}) {
    for (const std::int64_t j : {-1, 0}) EXPECT_EQ(**tree.find({0, i, j}, LookUp::none), i * 2 + j);
  }
}

TEST(PatchTree, FindsTheNearestCoarserDataAndSaysWhoseItIs) {
  Tree tree;
  *tree.find({5, 0, 0}, LookUp::create) = number(5);
  *tree.find({2, 3, 1}, LookUp::create) = number(2);
  NodeKey found;
  const NodeKey inside{0, 3 * 4 + 1, 1 * 4 + 2};
  EXPECT_EQ(**tree.find(inside, LookUp::nearestCoarser, &found), 2);
  EXPECT_EQ(found, (NodeKey{2, 3, 1}));
  EXPECT_EQ(**tree.find({0, 0, 0}, LookUp::nearestCoarser, &found), 5);
  EXPECT_EQ(found, (NodeKey{5, 0, 0}));
  EXPECT_EQ(tree.find(inside, LookUp::none), nullptr);
  EXPECT_EQ(tree.find({0, 32, 0}, LookUp::nearestCoarser), nullptr);
}

TEST(PatchTree, LookingCreatesNothing) {
  Tree tree;
  *tree.find({3, 1, 1}, LookUp::create) = number(1);
  const std::size_t before = tree.nodeCount();
  (void)tree.find({0, 9, 9}, LookUp::nearestCoarser);
  (void)tree.find({0, 9, 9}, LookUp::none);
  EXPECT_EQ(tree.nodeCount(), before);
}

TEST(PatchTree, AgreesWithAMapOverRandomProgramsAndIsEmptyAfterErasingAll) {
  std::mt19937_64 random(20050101);
  Tree tree;
  std::set<std::tuple<int, std::int64_t, std::int64_t>> reference;
  const auto randomKey = [&] {
    const int level = static_cast<int>(random() % 5);
    const auto index = [&] { return static_cast<std::int64_t>(random() % 64) - 32; };
    return NodeKey{level, index() >> level, index() >> level};
  };
  for (int step = 0; step < 20000; ++step) {
    const NodeKey key = randomKey();
    if (random() % 2 == 0) {
      *tree.find(key, LookUp::create) = number(step);
      reference.insert({key.level, key.i, key.j});
    } else {
      tree.erase(key);
      reference.erase({key.level, key.i, key.j});
    }
    const NodeKey asked = randomKey();
    const bool known = reference.contains({asked.level, asked.i, asked.j});
    ASSERT_EQ(tree.find(asked, LookUp::none) != nullptr, known) << "step " << step;
  }
  std::size_t visited = 0;
  tree.forEach([&](const NodeKey& key, const auto&) {
    ++visited;
    EXPECT_TRUE(reference.contains({key.level, key.i, key.j}));
  });
  EXPECT_EQ(visited, reference.size());
  for (const auto& [level, i, j] : reference) tree.erase({level, i, j});
  EXPECT_EQ(tree.nodeCount(), 0U);
}

TEST(PatchTree, ReachesTheWorldsEnds) {
  Tree tree;
  const std::int64_t far = (std::int64_t{1} << 52) - 1;
  for (const std::int64_t i : {-far - 1, far}) *tree.find({0, i, i}, LookUp::create) = number(1);
  *tree.find({0, 0, 0}, LookUp::create) = number(2);
  EXPECT_EQ(tree.rootLevel({0, far, far}), 52);
  EXPECT_EQ(**tree.find({0, 0, 0}, LookUp::none), 2);
}

}  // namespace
}  // namespace teren
