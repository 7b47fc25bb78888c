#include "stream/MeshPages.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Scene.h"

namespace teren {
namespace {

std::shared_ptr<const Mesh> meshOf(std::uint64_t id) {
  auto mesh = std::make_shared<Mesh>();
  mesh->id = id;
  return mesh;
}

std::vector<std::uint64_t> idsOf(const MeshList& meshes) {
  std::vector<std::uint64_t> ids;
  for (const auto& mesh : meshes) ids.push_back(mesh->id);
  return ids;
}

/// Meshes that come, each with a greater id, and go, anywhere or from one place on.
class Crowd {
 public:
  void add(int count) {
    for (int k = 0; k < count; ++k) {
      pages_.add(meshOf(++last_));
      there_.insert(last_);
    }
  }
  void remove(int count) {
    auto next = there_.end();
    for (int k = 0; k < count && !there_.empty(); ++k) {
      const bool leaps = next == there_.end() || random_() % 4 == 0;
      if (leaps) next = std::next(there_.begin(), static_cast<std::ptrdiff_t>(random_() % there_.size()));
      pages_.remove(*next);
      next = there_.erase(next);
    }
  }
  MeshPages& pages() { return pages_; }
  std::vector<std::uint64_t> there() const { return {there_.begin(), there_.end()}; }
  std::uint64_t dice() { return random_(); }

 private:
  std::mt19937_64 random_{7};
  MeshPages pages_;
  std::set<std::uint64_t> there_;
  std::uint64_t last_ = 0;
};

TEST(MeshPages, HoldWhatHasComeAndNotGoneInOrderAndNoSnapshotChanges) {
  Crowd crowd;
  crowd.add(500);
  std::map<int, std::pair<MeshList, std::vector<std::uint64_t>>> snapshots;
  for (int step = 0; step < 300; ++step) {
    crowd.add(static_cast<int>(crowd.dice() % 20));
    crowd.remove(static_cast<int>(crowd.dice() % 20));
    if (step == 200) crowd.remove(10'000);
    snapshots.emplace(step, std::pair{crowd.pages().snapshot(), crowd.there()});
    ASSERT_LE(crowd.pages().pages(), crowd.pages().size() / 4 + 1);
  }
  for (const auto& [step, expected] : snapshots) {
    ASSERT_EQ(idsOf(expected.first), expected.second) << step;
    ASSERT_EQ(expected.first.size(), expected.second.size());
    for (std::size_t k = 0; k < expected.second.size(); ++k) {
      ASSERT_EQ(expected.first[k]->id, expected.second[k]);
    }
    if (expected.second.empty()) continue;
    ASSERT_EQ(expected.first.front()->id, expected.second.front());
    ASSERT_EQ(expected.first.back()->id, expected.second.back());
  }
}

TEST(MeshPages, ShareWithTheSnapshotBeforeAllPagesButThoseThatChanged) {
  Crowd crowd;
  crowd.add(4000);
  const MeshList before = crowd.pages().snapshot();
  crowd.remove(8);
  crowd.add(16);
  const MeshList after = crowd.pages().snapshot();
  std::set<const MeshList::Page*> old;
  for (const MeshList::Place& place : before.pages()) old.insert(place.page.get());
  std::size_t shared = 0;
  for (const MeshList::Place& place : after.pages()) shared += old.contains(place.page.get()) ? 1U : 0U;
  EXPECT_GE(shared, after.pages().size() - 12);
  EXPECT_GE(after.pages().size(), 250U);
}

TEST(SceneDifference, NamesWhatCameAndWhatWentBetweenAnySnapshots) {
  Crowd crowd;
  crowd.add(300);
  std::vector<Scene> scenes;
  std::vector<std::vector<std::uint64_t>> there;
  for (int step = 0; step < 30; ++step) {
    scenes.emplace_back(static_cast<std::uint64_t>(step), 1.0, crowd.pages().snapshot());
    there.push_back(crowd.there());
    crowd.add(static_cast<int>(crowd.dice() % 30));
    crowd.remove(static_cast<int>(crowd.dice() % 30));
  }
  for (std::size_t a = 0; a < scenes.size(); ++a) {
    for (std::size_t b = 0; b < scenes.size(); ++b) {
      const SceneDifference found = difference(scenes[a], scenes[b]);
      std::vector<std::uint64_t> added, expectedAdded, expectedRemoved;
      for (const auto& mesh : found.added) added.push_back(mesh->id);
      std::set_difference(there[b].begin(), there[b].end(), there[a].begin(), there[a].end(),
                          std::back_inserter(expectedAdded));
      std::set_difference(there[a].begin(), there[a].end(), there[b].begin(), there[b].end(),
                          std::back_inserter(expectedRemoved));
      ASSERT_EQ(added, expectedAdded) << a << " to " << b;
      ASSERT_EQ(found.removed, expectedRemoved) << a << " to " << b;
    }
  }
}

TEST(MeshList, OfAVectorIsThatVector) {
  for (const std::size_t count : {0U, 1U, 15U, 16U, 17U, 100U}) {
    std::vector<std::shared_ptr<const Mesh>> meshes;
    for (std::size_t k = 0; k < count; ++k) meshes.push_back(meshOf(3 * k + 1));
    const MeshList list(meshes);
    EXPECT_TRUE(std::equal(list.begin(), list.end(), meshes.begin(), meshes.end()));
    EXPECT_EQ(list.size(), count);
    EXPECT_EQ(list.empty(), count == 0);
  }
}

}  // namespace
}  // namespace teren
