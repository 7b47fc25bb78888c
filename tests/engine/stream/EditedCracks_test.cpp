// Law 2 where the ground was edited: boxes of new ground over the borders between nodes of any levels, looked
// at before, while and after what is drawn goes over to them.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Engine.h"
#include "teren/GroundEdits.h"
#include "teren/Hash.h"
#include "teren/SceneQuery.h"

#include "tests/engine/stream/FaultWorld.h"
#include "tests/engine/stream/NodeErrorsWait.h"
#include "tests/engine/stream/PlacesBetweenLevels.h"
#include "tests/support/TrialSize.h"

namespace teren {
namespace {

using Place = test::SamplePlace;
using test::placeOf;

/// Boxes of ground as rough as the world's own, in which every sample differs from what was there before.
class Boxes final : public GroundEdits {
 public:
  explicit Boxes(std::vector<SampleBox> boxes) : boxes_(std::move(boxes)) {}

  void overlay(int level, std::int64_t column, std::int64_t row, HeightView grid) const override {
    for (int y = 0; y < grid.rows(); ++y) {
      for (int x = 0; x < grid.columns(); ++x) {
        const std::int64_t east = (column + x) << level, north = (row + y) << level;
        for (std::size_t box = boxes_.size(); box-- > 0;) {  // the latest holds
          if (!boxes_[box].touches({east, north, east, north})) continue;
          const std::uint64_t place =
              hashWith(hashWith(box, static_cast<std::uint64_t>(east)), static_cast<std::uint64_t>(north));
          grid(x, y) = static_cast<float>(place >> 40) * 0x1p-22F;
          break;
        }
      }
    }
  }
  /// So little that levels stay as coarse as they are: borders between them are what is tried here.
  double moved(int level, std::int64_t i, std::int64_t j) const override {
    const std::int64_t side = std::int64_t{kIntervals} << level;
    for (const SampleBox& box : boxes_)
      if (box.touches({i * side, j * side, (i + 1) * side, (j + 1) * side})) return 1e-3;
    return 0.0;
  }
  std::size_t bytes() const noexcept override { return boxes_.size() * sizeof(SampleBox); }

  static constexpr int kIntervals = 16;

 private:
  std::vector<SampleBox> boxes_;
};

class Walker final : public Object {
 public:
  void update(double, const Ground&) override {}
  Motion motion() const override { return place; }
  Motion place;
};

struct Trial {
  const char* name;
  int workers;
  std::int64_t patch;  // about which it takes place
  friend void PrintTo(const Trial& trial, std::ostream* out) { *out << trial.name; }
};

class EditedCracks : public testing::TestWithParam<Trial> {
 protected:
  static constexpr int kIntervals = Boxes::kIntervals;
  EditedCracks() : world_(test::faultWorld(3, kIntervals + 1, {64.0}, 20)), random_(11) {
    auto made = Engine::create(
        world_, {.view = {.detail = DetailSettings{.pixelError = 5.0, .distance = 1500.0, .lines = 360.0}},
                 .workers = GetParam().workers});
    EXPECT_TRUE(made.ok()) << (made.ok() ? "" : made.error().message);
    engine_ = std::move(*made);
    walker_ = static_cast<Walker*>(&engine_->add(std::make_unique<Walker>()));
  }

  double metres(double least, double most) {
    return least + (most - least) * static_cast<double>(random_.nextBits(20)) * 0x1p-20;
  }
  void walkTo(double east, double north) {
    const double middle = static_cast<double>(GetParam().patch) * world_->pitch();
    walker_->place.position = *Position::fromMetres(middle + east, middle + north, world_->pitch());
    walker_->place.height = 30.0;
  }
  /// Some boxes over vertices that several meshes share, wherever those are, and all that were there before.
  void editSeams() {
    const std::vector<Place> mixed = test::placesBetweenLevels(*engine_->scene());
    ASSERT_GT(mixed.size(), 100U) << "levels have to meet";
    std::vector<SampleBox> changed;
    for (int box = 0; box < 12; ++box) {
      const auto& [column, row] = mixed[random_.next() % mixed.size()];
      const auto reach = [&] { return static_cast<std::int64_t>(random_.next() % 40); };
      changed.push_back({column - reach(), row - reach(), column + reach(), row + reach()});
    }
    boxes_.insert(boxes_.end(), changed.begin(), changed.end());
    engine_->setEdits(std::make_shared<Boxes>(boxes_), changed);
  }

  /// One vertex at a place, way to the coarser surface included; no edge twice in one direction; and beyond
  /// an edge of one triangle alone there is nothing.
  void expectClosed() {
    const auto scene = engine_->scene();
    std::map<Place, SurfaceVertex> vertices;
    std::set<std::pair<Place, Place>> edges;
    for (const auto& mesh : scene->meshes()) {
      for (SurfaceVertex vertex : mesh->vertices) {
        const Place place = placeOf(*mesh, vertex);
        vertex.column = vertex.row = 0;
        const auto [known, isNew] = vertices.emplace(place, vertex);
        ASSERT_TRUE(isNew || known->second == vertex)
            << "a crack at " << place.first << ", " << place.second << ", serial " << scene->serial();
      }
      for (std::size_t first = 0; first < mesh->indices->size(); first += 3) {
        for (std::size_t c = 0; c < 3; ++c) {
          const auto at = [&](std::size_t corner) {
            return placeOf(*mesh, mesh->vertices[(*mesh->indices)[first + corner % 3]]);
          };
          ASSERT_TRUE(edges.emplace(at(c), at(c + 1)).second) << "two triangles on one side of an edge";
        }
      }
    }
    const SceneQuery query(scene, kIntervals);
    for (const auto& [from, to] : edges) {
      if (edges.contains({to, from})) continue;
      // A quarter of a sample to the right of its middle.
      const double east = static_cast<double>(to.first - from.first);
      const double north = static_cast<double>(to.second - from.second);
      const double across = 0.25 / std::max(std::fabs(east), std::fabs(north));
      const auto part = [](std::int64_t start, double way, std::int64_t& patch) {
        patch = (start - (start % kIntervals + kIntervals) % kIntervals) / kIntervals;
        return (static_cast<double>(start - patch * kIntervals) + way) / kIntervals;
      };
      std::int64_t i = 0, j = 0;
      const double u = part(from.first, 0.5 * east + across * north, i);
      const double v = part(from.second, 0.5 * north - across * east, j);
      const auto whole = [](double share) { return static_cast<std::int64_t>(std::floor(share)); };
      const Position place{i + whole(u), j + whole(v), u - std::floor(u), v - std::floor(v)};
      DrawnPoint beyond;
      query.points({&place, 1}, {&beyond, 1});
      ASSERT_FALSE(beyond.there) << "an open edge from (" << from.first << ", " << from.second << ") to ("
                                 << to.first << ", " << to.second << "), serial " << scene->serial();
    }
  }

  std::shared_ptr<const World> world_;
  std::unique_ptr<Engine> engine_;

 private:
  RandomSequence random_;
  Walker* walker_ = nullptr;
  std::vector<SampleBox> boxes_;
};

TEST_P(EditedCracks, AreNowhereBeforeWhileAndAfterGroundIsRenewedAcrossLevels) {
  walkTo(0.0, 0.0);
  engine_->settle();
  ASSERT_TRUE(test::measureNodeErrors(*engine_));
  engine_->settle();
  std::set<std::uint64_t> shown;
  const int turns = test::trials(4, 100);
  for (int turn = 0; turn < turns; ++turn) {
    editSeams();
    if (turn % 2 == 0) walkTo(metres(-300.0, 300.0), metres(-300.0, 300.0));  // levels change meanwhile, too
    int looked = 0;
    for (int update = 0; looked == 0 ? update < 100'000 : update < 300 && looked < 6; ++update) {
      std::this_thread::sleep_for(std::chrono::microseconds(looked == 0 ? 100 : 0));  // workers have a turn
      engine_->update(1.0 / 60.0, std::chrono::microseconds(300));
      if (!shown.insert(engine_->scene()->serial()).second) continue;
      expectClosed();
      if (HasFatalFailure()) return;
      ++looked;
    }
    engine_->settle();
    expectClosed();
    if (HasFatalFailure()) return;
  }
  EXPECT_GE(shown.size(), static_cast<std::size_t>(turns));
}

INSTANTIATE_TEST_SUITE_P(, EditedCracks,
                         testing::Values(Trial{"Here", 0, 0}, Trial{"OfWorkers", 2, 0},
                                         Trial{"Far", 0, -(std::int64_t{1} << 30)}),
                         [](const auto& trial) { return std::string(trial.param.name); });

}  // namespace
}  // namespace teren
