// What was dug along a line is there again, to the bit, after all of it was dropped far away, after the
// program began again, and with other workers and budgets.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <unistd.h>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Engine.h"
#include "teren/GroundEditor.h"
#include "teren/Hash.h"
#include "teren/PluginRegistry.h"

#include "tests/engine/stream/FaultWorld.h"
#include "tests/engine/stream/NodeErrorsWait.h"

namespace teren {
namespace {

constexpr int kStamps = 1000;
constexpr double kLine = 2000.0, kAway = 50'000.0;  // [m]

class Puppet final : public Object {
 public:
  void update(double, const Ground&) override {}
  Motion motion() const override { return place; }
  Motion place;
};

struct Way {
  const char* name;
  ViewSettings view;
  int workers;
  int budget;  // [us]
};

/// All meshes between nodes of one level, by where they are, and what they hold.
using Grids = std::map<std::array<std::int64_t, 5>, std::vector<SurfaceVertex>>;

/// A program that flies and digs.
class Digger {
 public:
  Digger(const Way& way, const std::filesystem::path& journal)
      : budget_(way.budget), world_(test::faultWorld(3, 17, {1024.0, 64.0}, 20)) {
    EngineOptions options;
    options.view = way.view;
    options.workers = way.workers;
    options.capBytes = std::size_t{24} << 20;
    auto made = Engine::create(world_, options);
    EXPECT_TRUE(made.ok()) << (made.ok() ? "" : made.error().message);
    engine_ = std::move(*made);
    puppet_ = static_cast<Puppet*>(&engine_->add(std::make_unique<Puppet>()));
    auto editor = GroundEditor::open(world_, deformersOf(PluginRegistry::standard()), journal);
    EXPECT_TRUE(editor.ok()) << (editor.ok() ? "" : editor.error().message);
    editor_ = std::move(*editor);
    moveTo(0.0, 0.0);
  }
  /// So that what a view by error chooses does not depend on when.
  bool isMeasured() { return !engine_->options().view.detail || test::measureNodeErrors(*engine_); }

  void moveTo(double east, double north) {
    puppet_->place.position = at(east, north);
    puppet_->place.height = 150.0;
  }
  Position at(double east, double north) const { return *Position::fromMetres(east, north, world_->pitch()); }
  void update() {
    if (std::optional<EditedGround::Snapshot> dug = editor_->take())
      engine_->setEdits(dug->edits, dug->changed);
    engine_->update(1.0 / 60.0, std::chrono::microseconds(budget_));
  }
  void digTheLine() {
    RandomSequence random(5);
    for (int stamp = 0; stamp < kStamps; ++stamp) {
      const double along = kLine * stamp / kStamps;
      const double aside = 60.0 * (static_cast<double>(random.nextBits(20)) * 0x1p-20 - 0.5);
      moveTo(along - 100.0, 0.0);
      const auto pressed = editor_->press({"crater",
                                           along,
                                           aside,
                                           0.0,
                                           12.0 + static_cast<double>(random.nextBits(4)),
                                           6.0,
                                           random.next(),
                                           0,
                                           {}});
      ASSERT_TRUE(pressed.ok()) << pressed.error().message;
      update();
    }
  }
  /// Until all edits are shown and nothing is missing.
  void settle() {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(4);
    while (editor_->unfinished() > 0 && std::chrono::steady_clock::now() < end) {
      update();
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
    EXPECT_EQ(editor_->unfinished(), 0U);
    engine_->settle();
    for (const std::string& message : editor_->takeMessages()) ADD_FAILURE() << message;
  }
  /// Nothing of the line is held any more.
  void expectNothingThere() const {
    for (double along = 0.0; along < kLine; along += 50.0) {
      EXPECT_FALSE(engine_->drawnHeight(at(along, 0.0)));
      EXPECT_FALSE(engine_->finestHeight(at(along, 0.0)));
    }
  }
  std::vector<std::optional<double>> heights() const {
    std::vector<std::optional<double>> heights;
    for (double along = -50.0; along < kLine; along += 7.3) {
      for (const double aside : {-41.0, -13.0, 0.0, 9.1, 33.0}) {
        heights.push_back(engine_->drawnHeight(at(along, aside)));
      }
    }
    return heights;
  }
  Grids grids() const {
    Grids grids;
    for (const auto& mesh : engine_->scene()->meshes()) {
      const auto corners = static_cast<std::size_t>((mesh->columns + 1) * (mesh->rows + 1));
      if (mesh->vertices.size() != corners) continue;  // a border
      grids[{mesh->originColumn, mesh->originRow, mesh->columns, mesh->rows, mesh->level}] = mesh->vertices;
    }
    return grids;
  }
  std::size_t edits() const { return editor_->edits(); }
  const Engine& engine() const { return *engine_; }

 private:
  int budget_;
  std::shared_ptr<const World> world_;
  std::unique_ptr<Engine> engine_;
  std::unique_ptr<GroundEditor> editor_;
  Puppet* puppet_ = nullptr;
};

class DugGround : public testing::TestWithParam<int> {
 protected:
  DugGround()
      : folder_(std::filesystem::temp_directory_path() / ("teren-dug-" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~DugGround() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path folder_;
};

constexpr double kEast = 900.0, kNorth = 40.0;  // from where it is looked at

void goAwayAndBack(Digger& digger) {
  digger.moveTo(kEast + kAway, kNorth);
  digger.settle();
  digger.expectNothingThere();
  digger.moveTo(kEast, kNorth);
  digger.settle();
}

TEST_P(DugGround, IsThereAgainToTheBit) {
  const bool isByError = GetParam() != 0;
  ViewSettings view{0, 16};
  if (isByError) view.detail = DetailSettings{.pixelError = 8.0, .distance = 3000.0};
  std::optional<std::vector<std::optional<double>>> wanted;
  for (const Way& way :
       {Way{"alone", view, 0, 2000}, Way{"short budget", view, 0, 150}, Way{"two workers", view, 2, 1000}}) {
    SCOPED_TRACE(way.name);
    const std::filesystem::path journal = folder_ / (std::string(way.name) + ".edits");
    Grids before;
    {
      Digger digger(way, journal);
      ASSERT_TRUE(digger.isMeasured());
      ASSERT_NO_FATAL_FAILURE(digger.digTheLine());
      digger.moveTo(kEast, kNorth);
      digger.settle();
      before = digger.grids();
      goAwayAndBack(digger);
      const Grids after = digger.grids();
      int compared = 0;
      for (const auto& [name, vertices] : after) {
        const auto same = before.find(name);
        if (same == before.end()) continue;  // what stays drawn is finer for a while
        ASSERT_EQ(same->second, vertices);
        ++compared;
      }
      EXPECT_GT(compared, 50);
      const auto heights = digger.heights();
      EXPECT_GT(std::count_if(heights.begin(), heights.end(), [](const auto& h) { return h.has_value(); }),
                300);
      if (!wanted) wanted = heights;
      EXPECT_EQ(heights, *wanted) << "as others drew it";
      EXPECT_LE(digger.engine().figures().peakBytes, digger.engine().options().capBytes);
    }
    Digger again(way, journal);
    EXPECT_EQ(again.edits(), static_cast<std::size_t>(kStamps));
    ASSERT_TRUE(again.isMeasured());
    again.moveTo(kEast, kNorth);
    again.settle();
    EXPECT_EQ(again.heights(), *wanted) << "after it began again";
    for (const auto& [name, vertices] : again.grids()) {
      if (const auto same = before.find(name); same != before.end()) {
        ASSERT_EQ(same->second, vertices);
      }
    }
  }
  // Without the edits it is another ground.
  Digger untouched({"", view, 0, 2000}, folder_ / "none.edits");
  ASSERT_TRUE(untouched.isMeasured());
  untouched.moveTo(kEast, kNorth);
  untouched.settle();
  EXPECT_NE(untouched.heights(), *wanted);
}

INSTANTIATE_TEST_SUITE_P(, DugGround, testing::Values(0, 1), [](const auto& view) {
  return std::string(view.param != 0 ? "ByError" : "OfLevel0");
});

}  // namespace
}  // namespace teren
