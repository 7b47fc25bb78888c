// Land that is edited while it is drawn, for tests.
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <ostream>
#include <utility>

#include <gtest/gtest.h>

#include "teren/EditedGround.h"
#include "teren/Engine.h"
#include "teren/Hash.h"

#include "tests/engine/edits/TestDeformers.h"
#include "tests/engine/stream/FaultWorld.h"
#include "tests/engine/stream/NodeErrorsWait.h"

namespace teren {

class Puppet final : public Object {
 public:
  void update(double, const Ground&) override {}
  Motion motion() const override { return place; }
  Motion place;
};

struct Land {
  const char* name;
  ViewSettings view;
  int workers;
  std::int64_t patch;  // about which it lies
  friend void PrintTo(const Land& land, std::ostream* out) { *out << land.name; }
};

inline const DetailSettings kDetail{.pixelError = 20.0, .distance = 3000.0};

/// Edits whose bowls reach over patches' borders, and an engine that draws them.
class EditedLand : public testing::TestWithParam<Land> {
 protected:
  EditedLand()
      : world(test::faultWorld(3, 17, {1024.0, 64.0}, 20)),
        ground(world, testDeformer),
        middle_(static_cast<double>(GetParam().patch) * world->pitch()),
        random_(7) {
    auto made = Engine::create(world, {.view = GetParam().view, .workers = GetParam().workers});
    EXPECT_TRUE(made.ok()) << (made.ok() ? "" : made.error().message);
    engine = std::move(*made);
    puppet_ = static_cast<Puppet*>(&engine->add(std::make_unique<Puppet>()));
    moveTo(10.0, 20.0);
  }
  void moveTo(double east, double north) {
    puppet_->place.position = *Position::fromMetres(middle_ + east, middle_ + north, world->pitch());
    puppet_->place.height = 60.0;
  }
  /// What is chosen of a view by error depends on nothing that happens to be known by now.
  bool isMeasured() { return !GetParam().view.detail || test::measureNodeErrors(*engine); }
  double metres(double least, double most) {
    return least + (most - least) * static_cast<double>(random_.nextBits(20)) * 0x1p-20;
  }
  Position at(double east, double north) const {
    return *Position::fromMetres(middle_ + east, middle_ + north, world->pitch());
  }
  /// Some bowls around a place, one of them over the corner of four patches, and what they make of the
  /// ground.
  EditedGround::Snapshot dig(double east, double north, double size, double depth) {
    const auto corner = [&](double metres) { return world->pitch() * std::round(metres / world->pitch()); };
    for (const auto& [x, y] : {std::pair{corner(east), corner(north)},
                               std::pair{east + metres(-200.0, 200.0), north + metres(-200.0, 200.0)},
                               std::pair{east + metres(-200.0, 200.0), north + metres(-200.0, 200.0)}}) {
      const Result<void> applied = ground.apply(
          {"bowl", middle_ + x, middle_ + y, 0.0, size, depth, random_.next(), ground.stepsSinceEdit(), {}});
      EXPECT_TRUE(applied.ok()) << (applied.ok() ? "" : applied.error().message);
    }
    EXPECT_TRUE(ground.rest().ok());
    return ground.snapshot();
  }
  void digAndShow(double east, double north, double size, double depth) {
    const EditedGround::Snapshot dug = dig(east, north, size, depth);
    engine->setEdits(dug.edits, dug.changed);
    engine->settle();
  }
  /// Edited level-0 triangles.
  double truth(const Position& place) const {
    SurfacePoint point;
    ground.query({&place, 1}, {&point, 1});
    return point.drawn;
  }

  std::shared_ptr<const World> world;
  EditedGround ground;
  std::unique_ptr<Engine> engine;

 private:
  double middle_;
  RandomSequence random_;
  Puppet* puppet_ = nullptr;
};

inline const ViewSettings kFinest{0, 4}, kCoarser{1, 3}, kByError{.detail = kDetail};

}  // namespace teren
