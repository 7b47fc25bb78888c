// What a TerrainWidget is told by programs that pass on anything a person or a file says: one sentence, as a
// Result and as a signal, and the landscape before goes on.
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <QDir>
#include <QSignalSpy>
#include <QTemporaryFile>
#include <QTest>
#include <gtest/gtest.h>

#include "coin/SoTerrain.h"
#include "tests/qt/Sight.h"

namespace teren {
namespace {

constexpr int kMegabyte = 1 << 20;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

using Call = std::function<Result<void>(TerrainWidget&)>;

/// A widget at rest, and what it had before it was told anything.
class HostileCall : public ::testing::Test {
 protected:
  HostileCall()
      : land_(landAtRest()),
        world_(land_->world()),
        viewer_(land_->viewer()),
        scene_(land_->terrain().scene()),
        picture_(screenOf(*land_)) {}
  ~HostileCall() override { expectUnchanged(); }
  HostileCall(const HostileCall&) = delete;
  HostileCall& operator=(const HostileCall&) = delete;

  void expectRefusal(const Call& call, const std::string& word = "") {
    QSignalSpy said(land_.get(), &TerrainWidget::errorOccurred);
    const Result<void> result = call(*land_);
    ASSERT_FALSE(result.ok()) << word;
    const std::string& sentence = result.error().message;
    ASSERT_EQ(said.count(), 1);
    EXPECT_EQ(said[0][0].toString().toStdString(), sentence);
    EXPECT_NE(sentence.find(word), std::string::npos) << sentence.substr(0, 2000);
    EXPECT_LE(sentence.size(), 1400U) << sentence.substr(0, 2000);
    for (const char c : sentence) EXPECT_GE(static_cast<unsigned char>(c), 0x20) << sentence.substr(0, 2000);
  }

  void expectUnchanged() {
    EXPECT_TRUE(comesToRest(*land_));
    EXPECT_EQ(land_->world(), world_);
    EXPECT_EQ(land_->viewer(), viewer_);
    EXPECT_EQ(land_->options().view.level, 1);
    EXPECT_EQ(land_->terrain().scene(), scene_);
    EXPECT_LT(difference(screenOf(*land_), picture_), 0.01);
  }

  std::unique_ptr<TerrainWidget> land_;
  std::shared_ptr<const World> world_;
  Viewer viewer_;
  std::shared_ptr<const Scene> scene_;
  QImage picture_;
};

TEST_F(HostileCall, OfAWorldAsTextIsRefused) {
  const QString megabyte(kMegabyte, QLatin1Char('x'));
  for (const QString& text :
       {QString(), QString(QChar(0)), megabyte, QString(kMegabyte, QLatin1Char('[')),
        QString(kMegabyte, QLatin1Char('\n')), QString(20 * kMegabyte, QLatin1Char(' ')),
        QString(QChar(0xD800)), QStringLiteral("null"), QStringLiteral("{}"),
        QStringLiteral(R"({ "layers": 3 })"),
        QStringLiteral(R"({ "layers": [ { "generator": "fault", "pitch": 1e999 } ] })"),
        QStringLiteral(R"({ "layers": [ { "generator": "fault", "pitch": NaN } ] })"),
        QStringLiteral(R"({ "layers": [ { "generator": "%1" } ] })").arg(megabyte),
        QStringLiteral(R"({ "layers": [ { "generator": "fault", "%1": 1 } ] })").arg(megabyte),
        QStringLiteral(R"({ "layers": [ { "generator": "fault", "parameters": { "faults": "%1" } } ] })")
            .arg(megabyte)}) {
    expectRefusal([&](TerrainWidget& land) { return land.setWorldText(text); });
  }
}

TEST_F(HostileCall, OfAWorldAsAFileIsRefused) {
  QTemporaryFile good;
  ASSERT_TRUE(good.open());
  good.write(R"({ "layers": [ { "generator": "fault" } ] })");
  good.close();
  for (const QString& file :
       {QString(), QDir::tempPath(), QStringLiteral("/dev/zero"), QStringLiteral("/nowhere/none"),
        QString(kMegabyte, QLatin1Char('x')), QString(kMegabyte, QLatin1Char('/')),
        good.fileName() + QChar(0) + QStringLiteral(".txt")}) {
    expectRefusal([&](TerrainWidget& land) { return land.setWorldFile(file); }, "is not a file");
  }
}

TEST_F(HostileCall, OfADescriptionIsRefused) {
  using Spoil = std::function<void(WorldDescription&)>;
  const std::string megabyte(kMegabyte, 'x');
  std::vector<Spoil> spoils = {
      [](WorldDescription& world) { world.layers.clear(); },
      [](WorldDescription& world) { world.layers.assign(300, world.layers[0]); },
      [](WorldDescription& world) { world.samples = std::numeric_limits<int>::min(); },
      [](WorldDescription& world) { world.layers[0].samples = std::numeric_limits<int>::max(); },
      [&](WorldDescription& world) { world.layers[0].generator = megabyte; },
      [&](WorldDescription& world) {
        world.layers[0].parameters = {{megabyte, 1.0}};
      },
      [&](WorldDescription& world) {
        world.layers[0].parameters = {{"hurst", megabyte}};
      },
      [&](WorldDescription& world) {
        world.layers[0].filters = {{megabyte, {}}};
      },
      [](WorldDescription& world) {
        world.layers[0].parameters = {{"harmonics", std::int64_t{1} << 62}};
      },
  };
  for (const double odd : {kNaN, kInfinity, -kInfinity, 0.0, -64.0, 1e300}) {
    spoils.emplace_back([odd](WorldDescription& world) { world.pitch = odd; });
    spoils.emplace_back([odd](WorldDescription& world) { world.layers[0].pitch = odd; });
    spoils.emplace_back([odd](WorldDescription& world) {
      world.layers[0].parameters = {{"hurst", odd == 0.0 ? -1e-300 : odd}};
    });
  }
  for (const Spoil& spoil : spoils) {
    WorldDescription world = WorldDescription::standard();
    spoil(world);
    expectRefusal([&](TerrainWidget& land) { return land.setWorld(world); });
  }
}

TEST_F(HostileCall, OfOptionsIsRefused) {
  constexpr int kMost = std::numeric_limits<int>::max(), kLeast = std::numeric_limits<int>::min();
  const EngineOptions good = land_->options();
  std::vector<EngineOptions> wrong;
  for (const int odd : {-1, kMost, kLeast}) {
    wrong.insert(wrong.end(), 3, good);
    wrong.end()[-3].view.level = odd;
    wrong.end()[-2].view.radius = odd;
    wrong.end()[-1].workers = odd;
  }
  for (const std::size_t odd : {std::size_t{0}, std::size_t{1}, EngineOptions::kLeastCap - 1}) {
    wrong.push_back(good);
    wrong.back().capBytes = odd;
  }
  for (const EngineOptions& options : wrong) {
    expectRefusal([&](TerrainWidget& land) { return land.setOptions(options); });
  }
}

TEST_F(HostileCall, OfAViewerIsRefused) {
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
  constexpr std::int64_t kLeast = std::numeric_limits<std::int64_t>::min();
  for (const std::int64_t odd : {kMost, kLeast, kMaxPatch + 1, -kMaxPatch - 1}) {
    expectRefusal([&](TerrainWidget& land) { return land.setViewer({.position = {.i = odd}}); }, "patch");
    expectRefusal([&](TerrainWidget& land) { return land.setViewer({.position = {.j = odd}}); }, "patch");
  }
  for (const double odd : {kNaN, kInfinity, -kInfinity, 1e300, -1e-300, 1.0}) {
    expectRefusal([&](TerrainWidget& land) { return land.setViewer({.position = {.u = odd}}); }, "place");
    expectRefusal([&](TerrainWidget& land) { return land.setViewer({.position = {.v = odd}}); }, "place");
  }
  for (const double odd : {kNaN, kInfinity, -kInfinity}) {
    expectRefusal([&](TerrainWidget& land) { return land.setViewer({.position = {}, .heading = odd}); },
                  "heading");
    expectRefusal([&](TerrainWidget& land) { return land.setViewer({.position = {}, .pitch = odd}); },
                  "pitch");
    expectRefusal(
        [&](TerrainWidget& land) { return land.setViewer({.position = {}, .heightAboveGround = odd}); },
        "heightAboveGround");
  }
}

TEST_F(HostileCall, OfABudgetOrAPickIsBroughtIntoItsRange) {
  const auto before = land_->frameBudget();
  for (const auto odd : {std::chrono::nanoseconds::min(), std::chrono::nanoseconds::max()}) {
    land_->setFrameBudget(odd);
    EXPECT_GT(land_->frameBudget().count(), 0);
    EXPECT_LE(land_->frameBudget(), std::chrono::seconds(1));
  }
  land_->setFrameBudget(before);
  constexpr int kMost = std::numeric_limits<int>::max(), kLeast = std::numeric_limits<int>::min();
  for (const QPoint& point :
       {QPoint(kMost, kMost), QPoint(kLeast, kLeast), QPoint(kLeast, 5), QPoint(5, kMost)}) {
    EXPECT_FALSE(land_->pick(point).has_value());
  }
}

TEST(HostileCallBeforeAWorld, OfOptionsIsRefusedWithTheFirstWorld) {
  TerrainWidget land;
  EXPECT_TRUE(land.setOptions({.view = {.level = -1}}).ok()) << "nothing is refused yet";
  const Result<void> refused = land.setWorld(WorldDescription::standard());
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().message.find("level is -1"), std::string::npos) << refused.error().message;
  EXPECT_EQ(land.world(), nullptr);
  EXPECT_TRUE(land.setOptions({.view = {.level = 1, .radius = 1}}).ok());
  EXPECT_TRUE(land.setWorld(WorldDescription::standard()).ok());
}

}  // namespace
}  // namespace teren
