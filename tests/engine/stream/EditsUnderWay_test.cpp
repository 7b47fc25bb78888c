// Edits that come while land comes and goes: none is lost on the way, what is asked for is of one moment, and
// nothing waits for ever.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/engine/stream/EditedLand.h"

namespace teren {
namespace {

using std::chrono::microseconds;

/// Raises a box by so much.
class Raised final : public GroundEdits {
 public:
  Raised(const SampleBox& box, float height, int intervals, std::size_t bytes = 0)
      : box_(box), height_(height), n_(intervals), bytes_(bytes) {}
  void overlay(int level, std::int64_t column, std::int64_t row, HeightView grid) const override {
    for (int y = 0; y < grid.rows(); ++y) {
      for (int x = 0; x < grid.columns(); ++x) {
        const std::int64_t i = (column + x) << level, j = (row + y) << level;
        if (box_.touches({i, j, i, j})) grid(x, y) = height_;
      }
    }
  }
  double moved(int level, std::int64_t i, std::int64_t j) const override {
    const std::int64_t side = std::int64_t{n_} << level;
    return box_.touches({i * side, j * side, (i + 1) * side, (j + 1) * side}) ? 1.0 : 0.0;
  }
  std::size_t bytes() const noexcept override { return bytes_; }

 private:
  SampleBox box_;
  float height_;
  std::int64_t n_;
  std::size_t bytes_;
};

class EditsUnderWay : public EditedLand {
 protected:
  Puppet& addPuppet(double east, double north) {
    auto& puppet = static_cast<Puppet&>(engine->add(std::make_unique<Puppet>()));
    puppet.place.position = at(east, north);
    puppet.place.height = 60.0;
    return puppet;
  }
  void show(const EditedGround::Snapshot& dug) { engine->setEdits(dug.edits, dug.changed); }
  /// `across` patches around the middle.
  SampleBox boxOf(std::int64_t across) const {
    const std::int64_t n = world->intervals(), middle = GetParam().patch * n, half = across * n / 2;
    return {middle - half, middle - half, middle + half, middle + half};
  }
  void raise(const SampleBox& box, float height) {
    engine->setEdits(std::make_shared<const Raised>(box, height, world->intervals()), {&box, 1});
  }
};

/// The meshes that join nodes of one level, by where they are: they are told by the heights of their nodes.
std::map<std::array<std::int64_t, 5>, const Mesh*> gridsOf(const Scene& scene) {
  std::map<std::array<std::int64_t, 5>, const Mesh*> grids;
  for (const auto& mesh : scene.meshes()) {
    const auto corners = static_cast<std::size_t>((mesh->columns + 1) * (mesh->rows + 1));
    if (mesh->vertices.size() != corners) continue;  // a border
    grids[{mesh->originColumn, mesh->originRow, mesh->columns, mesh->rows, mesh->level}] = mesh.get();
  }
  return grids;
}

TEST_P(EditsUnderWay, AreAllThereInTheEndWhateverCameAndWentMeanwhile) {
  ASSERT_TRUE(isMeasured());
  Puppet& second = addPuppet(100.0, 300.0);
  std::optional<EditedGround::Snapshot> latest;
  for (int round = 0; round < 4; ++round) {
    for (int update = 0; update < 60; ++update) {
      // Leaps out of the view and back, so that nodes under the other object are held, drawn, held again.
      if (update % 7 == 0) moveTo(metres(-600.0, 600.0), metres(-600.0, 600.0));
      if (update % 11 == 0) second.place.position = at(metres(-500.0, 500.0), metres(-500.0, 500.0));
      if (update % 5 == 0) {
        latest = dig(metres(-500.0, 500.0), metres(-500.0, 500.0), metres(10.0, 60.0), 5.0);
        show(*latest);
      }
      engine->update(1.0 / 60.0, microseconds(static_cast<int>(metres(20.0, 900.0))));
    }
    engine->settle();
    for (std::size_t object = 0; object < 2; ++object) {
      const Position& place = engine->object(object).motion().position;
      ASSERT_TRUE(engine->finestHeight(place));
      EXPECT_NEAR(*engine->finestHeight(place), truth(place), 1e-4) << "round " << round;
    }
    for (int turn = 0; turn < 500; ++turn) {
      const Position place = at(metres(-700.0, 700.0), metres(-700.0, 700.0));
      const std::optional<double> finest = engine->finestHeight(place);
      if (finest) {
        ASSERT_NEAR(*finest, truth(place), 1e-4) << "round " << round;
      }
    }
  }
  // And all that is drawn is what somebody draws who knew the edits from the beginning.
  auto other = Engine::create(world, engine->options());
  ASSERT_TRUE(other.ok());
  for (std::size_t object = 0; object < 2; ++object) {
    static_cast<Puppet&>((*other)->add(std::make_unique<Puppet>())).place = engine->object(object).motion();
  }
  const EditedGround::Snapshot all = ground.snapshot();
  (*other)->setEdits(all.edits, all.changed);
  (*other)->settle();
  const auto drawn = gridsOf(*engine->scene()), anew = gridsOf(*(*other)->scene());
  int compared = 0;
  for (const auto& [name, mesh] : anew) {
    const auto here = drawn.find(name);
    if (here == drawn.end()) continue;  // what is drawn farther away depends on what was drawn before
    EXPECT_TRUE(std::ranges::equal(here->second->vertices, mesh->vertices));
    EXPECT_EQ(here->second->bend, mesh->bend);
    EXPECT_EQ(here->second->moved, mesh->moved);
    compared += mesh->moved > 0.0F || mesh->level == 0;
  }
  EXPECT_GT(compared, 20);
}

TEST_P(EditsUnderWay, AreShownToWhoeverAsksAtOneMomentEverywhere) {
  addPuppet(150.0, 2500.0);  // where nothing is drawn, in a view of one level
  engine->settle();
  const std::array<Position, 2> places{at(10.0, 20.0), at(150.0, 2500.0)};
  const auto heights = [&] {
    return std::array{engine->finestHeight(places[0]).value(), engine->finestHeight(places[1]).value()};
  };
  const std::array before = heights();
  const SampleBox middle = boxOf(2);
  const auto n = std::int64_t{world->intervals()};
  const SampleBox far{places[1].i * n, places[1].j * n, (places[1].i + 1) * n, (places[1].j + 1) * n};
  const SampleBox box = middle.joinedWith(far);
  raise(box, 321.0F);
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(2);
  while (heights() == before && std::chrono::steady_clock::now() < end) {
    engine->update(1.0 / 60.0, microseconds(50));
    const double drawn = engine->drawnHeight(places[0]).value_or(0.0);
    ASSERT_EQ(heights()[0] == before[0], heights()[1] == before[1]);
    if (GetParam().view.level == 0 && !GetParam().view.detail) {
      ASSERT_EQ(heights()[0] == 321.0, drawn == 321.0);
    }
  }
  EXPECT_EQ(heights(), (std::array{321.0, 321.0}));
}

TEST_P(EditsUnderWay, LetLandComeThoughTheyNeverEnd) {
  engine->settle();
  // The view fills, to its rim, where what is drawn grows, and with it what edits change.
  ASSERT_FALSE(engine->finestHeight(at(1200.0, 60.0)));
  moveTo(1200.0, 60.0);
  const double rim = GetParam().view.detail ? 900.0 : 0.6 * GetParam().view.reach(*world);
  const auto isFull = [&] {
    bool isThere = true;
    for (const double side : {-1.0, 1.0}) {
      isThere = isThere && engine->drawnHeight(at(1200.0 + side * rim, 60.0)) &&
                engine->drawnHeight(at(1200.0, 60.0 + side * rim));
    }
    if (!isThere || !GetParam().view.detail) return isThere;
    const Position own = at(1200.0, 60.0);
    DrawnPoint point;
    engine->sceneQuery()->points({&own, 1}, {&point, 1});
    return point.there && point.level == 0;
  };
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(2);
  float height = 0.0F;
  while (!isFull() && std::chrono::steady_clock::now() < end) {
    raise(boxOf(64), height += 0x1p-9F);  // all that is drawn, so that there are always edits to come
    engine->update(1.0 / 60.0, microseconds(200));
  }
  EXPECT_TRUE(isFull()) << "after " << height << " edits";
  // Nor do edits wait for ever.
  const float before = height;
  const auto isShown = [&] { return engine->drawnHeight(at(1.0, 1.0)).value_or(0.0) > before; };
  moveTo(10.0, 20.0);
  while (!isShown() && std::chrono::steady_clock::now() < end) {
    raise(boxOf(64), height += 0x1p-9F);
    engine->update(1.0 / 60.0, microseconds(200));
  }
  EXPECT_TRUE(isShown());
}

TEST_P(EditsUnderWay, LeaveTheBendOfTheWorldsOwnGroundAsItIs) {
  using Bends = std::map<std::array<std::int64_t, 5>, float>;
  const auto bends = [](const Engine& drawn) {
    Bends found;
    for (const auto& [name, mesh] : gridsOf(*drawn.scene())) found[name] = mesh->bend;
    return found;
  };
  ASSERT_TRUE(isMeasured());
  engine->settle();
  const Bends own = bends(*engine);
  digAndShow(0.0, 0.0, 40.0, 60.0);
  const Bends edited = bends(*engine);
  moveTo(60'000.0, 40'000.0);
  engine->settle();
  moveTo(10.0, 20.0);
  engine->settle();
  const Bends again = bends(*engine);
  EXPECT_EQ(edited, again);
  int compared = 0;
  for (const auto& [name, bend] : edited) {
    const auto before = own.find(name);
    if (before == own.end()) continue;
    EXPECT_EQ(bend, before->second);
    ++compared;
  }
  EXPECT_GT(compared, 20);
}

/// An engine under a cap, and edits that take much of it.
class EditsInMemory : public EditsUnderWay {
 protected:
  void SetUp() override {
    ASSERT_TRUE(isMeasured());
    addPuppet(150.0, 2500.0);
    engine->settle();
    EngineOptions options = engine->options();
    options.capBytes = std::size_t{16} << 20;
    auto made = Engine::create(world, options);
    ASSERT_TRUE(made.ok()) << made.error().message;
    for (std::size_t object = 0; object < 2; ++object) {
      static_cast<Puppet&>((*made)->add(std::make_unique<Puppet>())).place = engine->object(object).motion();
    }
    engine = std::move(*made);
    settle();
  }
  void settle() {
    for (int turn = 0; turn < 60; ++turn) {  // each choice may make it a little finer again
      Puppet& eye = static_cast<Puppet&>(engine->object(0));
      eye.place.position = at(10.0, turn % 2 == 0 ? 20.0 : 40.0);
      engine->settle();
    }
  }
  std::size_t cap() const { return engine->options().capBytes; }
  void raise(float height, std::size_t bytes) {
    const SampleBox box = boxOf(64);
    engine->setEdits(std::make_shared<const Raised>(box, height, world->intervals(), bytes), {&box, 1});
    settle();
  }
};

TEST_P(EditsInMemory, GiveBackTheRoomThatTheyWereShownIn) {
  const double before = engine->figures().pixelError;
  raise(10.0F, cap() - engine->figures().bytes - 4096);
  raise(20.0F, 0);
  EXPECT_LE(engine->figures().pixelError, 1.3 * before);
}

TEST_P(EditsInMemory, TakeRoomFromTheViewSoThatGroundUnderObjectsIsThere) {
  const double before = engine->figures().pixelError;
  raise(10.0F, cap() / 16 * 9);
  EXPECT_GT(engine->figures().pixelError, before);
  const Position elsewhere = at(4000.0, 2500.0);
  static_cast<Puppet&>(engine->object(1)).place.position = elsewhere;
  settle();
  EXPECT_TRUE(engine->finestHeight(elsewhere));
  EXPECT_LE(engine->figures().bytes, cap());
  EXPECT_EQ(engine->figures().pending, 0U);
}

INSTANTIATE_TEST_SUITE_P(, EditsInMemory, testing::Values(Land{"ByError", kByError, 0, 0}),
                         [](const auto& land) { return std::string(land.param.name); });

TEST_P(EditsUnderWay, KeepUnderTheCapThoughTheyChangeAllThatIsDrawn) {
  EngineOptions options = engine->options();
  options.capBytes = std::size_t{1} << 20;
  if (const auto refused = Engine::create(world, options); !refused.ok()) options.capBytes <<= 3;
  options.capBytes += std::size_t{1} << 20;
  auto made = Engine::create(world, options);
  ASSERT_TRUE(made.ok()) << made.error().message;
  auto& puppet = static_cast<Puppet&>((*made)->add(std::make_unique<Puppet>()));
  puppet.place = engine->object(0).motion();
  (*made)->settle();
  for (int turn = 1; turn < 6; ++turn) {
    const SampleBox box = boxOf(64);
    (*made)->setEdits(
        std::make_shared<const Raised>(box, 100.0F * static_cast<float>(turn), world->intervals()),
        {&box, 1});
    (*made)->settle();
    EXPECT_EQ((*made)->drawnHeight(at(10.0, 20.0)), 100.0 * turn);
  }
  EXPECT_LE((*made)->figures().peakBytes, options.capBytes);
}

/// Notes who lets go of it last.
class Parting final : public GroundEdits {
 public:
  explicit Parting(std::thread::id& by) : by_(by) {}
  ~Parting() override { by_ = std::this_thread::get_id(); }
  void overlay(int, std::int64_t, std::int64_t, HeightView) const override {}
  double moved(int, std::int64_t, std::int64_t) const override { return 0.0; }
  std::size_t bytes() const noexcept override { return 0; }

 private:
  std::thread::id& by_;
};

TEST_P(EditsUnderWay, AreFreedByWorkersWhereThereAreAny) {
  engine->settle();
  std::array<std::thread::id, 3> freedBy;
  const SampleBox box = boxOf(2);
  for (std::thread::id& by : freedBy) {
    engine->setEdits(std::make_shared<const Parting>(by), {&box, 1});
    engine->settle();
  }
  engine->settle();
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_NE(freedBy[k], std::thread::id()) << "those before are let go of";
    EXPECT_EQ(freedBy[k] == std::this_thread::get_id(), GetParam().workers == 0);
  }
  EXPECT_EQ(freedBy[2], std::thread::id());
  engine.reset();  // before what it notes in goes
}

INSTANTIATE_TEST_SUITE_P(, EditsUnderWay,
                         testing::Values(Land{"OfLevel0", kFinest, 0, 0}, Land{"OfLevel1", kCoarser, 0, 0},
                                         Land{"OfLevel0Far", kFinest, 2, -(std::int64_t{1} << 20)},
                                         Land{"ByError", kByError, 0, 0},
                                         Land{"ByErrorOfWorkers", kByError, 2, 0}),
                         [](const auto& land) { return std::string(land.param.name); });

}  // namespace
}  // namespace teren
