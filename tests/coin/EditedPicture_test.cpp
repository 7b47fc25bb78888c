// Bowls dug where nodes of several levels meet: no picture on the way shows background through the ground.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <Inventor/nodes/SoPerspectiveCamera.h>
#include <Inventor/nodes/SoSeparator.h>
#include <QImage>
#include <gtest/gtest.h>

#include "teren/EditedGround.h"
#include "teren/Engine.h"
#include "teren/Hash.h"

#include "coin/SoTerrain.h"
#include "tests/coin/OffscreenView.h"
#include "tests/coin/Stage.h"
#include "tests/engine/edits/TestDeformers.h"
#include "tests/engine/stream/FaultWorld.h"
#include "tests/engine/stream/NodeErrorsWait.h"
#include "tests/engine/stream/PlacesBetweenLevels.h"
#include "tests/support/TrialSize.h"

namespace teren {
namespace {

class Post final : public Object {
 public:
  void update(double, const Ground&) override {}
  Motion motion() const override { return {.position = {}, .height = 60.0}; }
};

class EditedPicture : public testing::Test {
 protected:
  EditedPicture()
      : world_(test::faultWorld(3, 17, {1024.0, 64.0}, 20)),
        ground_(world_, testDeformer),
        view_(480, 270),
        random_(23) {
    auto made = Engine::create(
        world_, {.view = {.detail = DetailSettings{.pixelError = 12.0, .distance = 3000.0, .lines = 360.0}}});
    EXPECT_TRUE(made.ok()) << (made.ok() ? "" : made.error().message);
    engine_ = std::move(*made);
    engine_->add(std::make_unique<Post>());
    stage_.camera->heightAngle = 1.4F;
    stage_.terrain->waterLevel = -1e6F;  // water would hide cracks
    stage_.terrain->viewDistance = 3000.0F;
  }

  double metres(double least, double most) {
    return least + (most - least) * static_cast<double>(random_.nextBits(20)) * 0x1p-20;
  }
  /// Some bowls, each over a vertex between levels, no farther than is drawn all around it.
  void digAtSeams() {
    std::vector<test::SamplePlace> places = test::placesBetweenLevels(*engine_->scene());
    const double spacing = world_->spacing(0);
    std::erase_if(places, [&](const test::SamplePlace& place) {
      return spacing * static_cast<double>(std::max(std::abs(place.first), std::abs(place.second))) > 1200.0;
    });
    ASSERT_GT(places.size(), 100U) << "levels have to meet";
    dug_.clear();
    for (int bowl = 0; bowl < 4; ++bowl) {
      const auto& [column, row] = places[random_.next() % places.size()];
      dug_.emplace_back(spacing * static_cast<double>(column), spacing * static_cast<double>(row));
      const Result<void> applied = ground_.apply({"bowl",
                                                  dug_.back().first,
                                                  dug_.back().second,
                                                  0.0,
                                                  metres(10.0, 80.0),
                                                  metres(2.0, 30.0),
                                                  random_.next(),
                                                  ground_.stepsSinceEdit(),
                                                  {}});
      ASSERT_TRUE(applied.ok()) << applied.error().message;
    }
    ASSERT_TRUE(ground_.rest().ok());
    const EditedGround::Snapshot dug = ground_.snapshot();
    engine_->setEdits(dug.edits, dug.changed);
  }
  std::vector<std::optional<double>> drawnAtDug() const {
    std::vector<std::optional<double>> heights;
    for (const auto& [x, y] : dug_)
      heights.push_back(engine_->drawnHeight(*Position::fromMetres(x, y, world_->pitch())));
    return heights;
  }
  /// Down at what was dug, with vertices moved as somebody elsewhere sees them, and as the camera does.
  void expectNoBackground(int pictures) {
    stage_.terrain->setScene(engine_->scene());
    for (int picture = 0; picture < pictures; ++picture) {
      const auto& [x, y] = dug_[random_.next() % dug_.size()];
      const double east = x + metres(-60.0, 60.0), north = y + metres(-60.0, 60.0);
      const auto drawn = engine_->drawnHeight(*Position::fromMetres(east, north, world_->pitch()));
      ASSERT_TRUE(drawn.has_value());
      const double height = *drawn + metres(30.0, 200.0);
      stage_.look(SbVec3f(static_cast<float>(east), static_cast<float>(north), static_cast<float>(height)),
                  metres(0.0, 360.0), metres(-90.0, -70.0));
      std::optional<SbVec3d> eye;
      if (picture % 2 == 0) eye = SbVec3d(metres(-1500.0, 1500.0), metres(-1500.0, 1500.0), height);
      stage_.terrain->setDetailEye(eye);
      EXPECT_EQ(backgroundPixels(view_.picture(stage_.root, kMagenta)), 0)
          << "at " << east << ", " << north << ", serial " << engine_->scene()->serial();
    }
  }

  std::shared_ptr<const World> world_;
  EditedGround ground_;
  std::unique_ptr<Engine> engine_;
  const Stage stage_;
  OffscreenView view_;

 private:
  RandomSequence random_;
  std::vector<std::pair<double, double>> dug_;  // [m] where, the last time
};

TEST_F(EditedPicture, ShowsNoBackgroundThroughGroundDugWhereLevelsMeetBeforeWhileAndAfterItIsRenewed) {
  engine_->settle();
  ASSERT_TRUE(test::measureNodeErrors(*engine_));
  engine_->settle();
  EXPECT_GT(engine_->scene()->morph().tolerance(), 0.0F) << "vertices have to move";
  for (int turn = 0; turn < test::trials(8, 80); ++turn) {
    digAtSeams();
    const auto before = drawnAtDug();
    expectNoBackground(1);
    std::uint64_t last = engine_->scene()->serial();
    int looked = 0;  // at the first that shows what was dug, and what comes right behind it
    for (int update = 0; looked == 0 ? update < 100'000 : update < 300 && looked < 3; ++update) {
      engine_->update(1.0 / 60.0, std::chrono::microseconds(300));
      const std::uint64_t serial = engine_->scene()->serial();
      if (serial == last || drawnAtDug() == before) continue;
      last = serial;
      expectNoBackground(2);
      if (HasFatalFailure()) return;
      ++looked;
    }
    EXPECT_GE(looked, 1) << "what was dug is never shown";
    engine_->settle();
    expectNoBackground(10);
    if (HasFailure()) return;
  }
}

}  // namespace
}  // namespace teren
