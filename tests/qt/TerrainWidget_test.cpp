#include "qt/TerrainWidget.h"

#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <QApplication>
#include <QHBoxLayout>
#include <QPointer>
#include <QSignalSpy>
#include <QTabWidget>
#include <QTemporaryFile>
#include <QTest>
#include <QVBoxLayout>
#include <QWheelEvent>
#include <gtest/gtest.h>

#include "coin/SoTerrain.h"
#include "tests/engine/plugin/ScratchFolder.h"
#include "tests/qt/Sight.h"
#include "world/NodeErrors.h"

namespace teren {
namespace {

/// What the ground is according to the world, and how far the finest triangles may be from it.
void expectGround(const TerrainWidget& land, const Position& position, double height) {
  const SurfacePoint point = land.world()->query(position);
  EXPECT_NEAR(height, point.height, point.error + 2e-3);
}

TEST(TerrainWidget, ShowsTheLandOfItsWorldOnTheScreen) {
  TerrainWidget land;
  land.resize(kWidth, kHeight);
  land.show();
  ASSERT_TRUE(comesToRest(land));
  EXPECT_EQ(landShare(screenOf(land)), 0.0) << "without a world there is only haze";
  EXPECT_EQ(land.world(), nullptr);
  showSmallLand(land);
  ASSERT_TRUE(comesToRest(land));
  const QImage picture = screenOf(land);
  EXPECT_GT(landShare(picture), 0.4);
  EXPECT_LT(landShare(picture), 1.0) << "there is some sky";
  EXPECT_EQ(land.figures().pending, 0U);
  EXPECT_GT(land.figures().triangles, 10'000U);
}

TEST(TerrainWidget, PicksTheGroundThatIsSeenAlsoFarFromTheWorldsZero) {
  const auto land = landAtRest();
  ASSERT_TRUE(land->setOptions({.view = {.level = 0, .radius = 4}}).ok());
  for (const std::int64_t far : {std::int64_t{0}, std::int64_t{1} << 40}) {
    Viewer viewer{.position = {far, -far, 0.3, 0.7}, .heightAboveGround = 40.0, .pitch = -0.7};
    while (land->world()->height(viewer.position) < 0.0) viewer.position.j -= 50;  // over land
    ASSERT_TRUE(land->setViewer(viewer).ok());
    ASSERT_TRUE(comesToRest(*land));
    for (const QPoint& point :
         {QPoint(10, kHeight - 5), QPoint(kWidth / 2, kHeight / 2), QPoint(kWidth - 1, kHeight - 1)}) {
      const std::optional<GroundPoint> ground = land->pick(point);
      ASSERT_TRUE(ground.has_value())
          << point.x() << " " << point.y() << " " << far << " " << land->eyeHeight();
      expectGround(*land, ground->position, ground->height);
      const Offset away = offset(viewer.position, ground->position, land->world()->pitch());
      EXPECT_GT(away.north, 0.0) << "the view goes north";
      EXPECT_EQ(away.east > 0.0, point.x() >= kWidth / 2);
    }
  }
}

TEST(TerrainWidget, PicksNothingInTheSkyAndOutside) {
  const auto land = landAtRest();
  EXPECT_FALSE(land->pick(QPoint(-1, 5)).has_value());
  EXPECT_FALSE(land->pick(QPoint(5, kHeight)).has_value());
  ASSERT_TRUE(land->setViewer({.position = {}, .heightAboveGround = 3000.0, .pitch = 0.8}).ok());
  ASSERT_TRUE(comesToRest(*land));
  EXPECT_FALSE(land->pick(QPoint(kWidth / 2, kHeight / 2)).has_value());
}

TEST(TerrainWidget, KeepsTheEyeAboveTheGroundWhereverItIsMovedAndSaysSo) {
  const auto land = landAtRest();
  QSignalSpy moved(land.get(), &TerrainWidget::positionChanged);
  const Viewer viewer{
      .position = {3000, 77, 0.5, 0.25}, .heightAboveGround = 12.0, .heading = 1.0, .pitch = 0.1};
  ASSERT_TRUE(land->setViewer(viewer).ok());
  ASSERT_EQ(moved.count(), 1);
  EXPECT_EQ(moved[0][0].value<Viewer>(), viewer);
  ASSERT_TRUE(comesToRest(*land));
  EXPECT_EQ(moved.back()[0].value<Viewer>(), viewer);
  EXPECT_EQ(moved.back()[1].toDouble(), land->eyeHeight());
  // The highest of the finest triangles and those that are drawn, one level coarser here.
  EXPECT_GT(land->eyeHeight(), land->world()->query(viewer.position).drawn + 12.0 - 2e-3);
  EXPECT_LT(land->eyeHeight(), land->world()->query(viewer.position).drawn + 12.0 + 5.0);
  const int count = moved.count();
  ASSERT_TRUE(land->setViewer(viewer).ok());
  EXPECT_EQ(moved.count(), count) << "it is there already";
}

TEST(TerrainWidget, KeepsTheEyeAboveTheWater) {
  const auto land = landAtRest();
  land->terrain().waterLevel = 5000.0F;
  ASSERT_TRUE(land->setViewer({.position = {}, .heightAboveGround = 7.0}).ok());
  EXPECT_EQ(land->eyeHeight(), 5007.0);
}

TEST(TerrainWidget, RestsWithoutATimerWhenNothingChanges) {
  const auto land = landAtRest();
  timerEvents(100);  // what is still under way
  const auto last = land->figures().lastUpdate;
  EXPECT_EQ(timerEvents(400), 0);
  EXPECT_EQ(land->figures().lastUpdate, last);
  EXPECT_FALSE(isWorking(*land));
}

/// A world of one layer, whose errors are soon measured, with detail by error.
void showDetail(TerrainWidget& land) {
  land.terrain().waterLevel = -1e6F;
  land.setFrameBudget(std::chrono::milliseconds(20));
  ASSERT_TRUE(
      land.setOptions({.view = {.detail = DetailSettings{.pixelError = 4.0, .distance = 1500.0}}}).ok());
  ASSERT_TRUE(land.setWorldText(QStringLiteral(R"({ "layers": [ { "generator": "fault" } ] })")).ok());
  ASSERT_TRUE(comesToRest(land));
}

TEST(TerrainWidget, RestsOnlyWhenItKnowsHowWrongItsNodesAre) {
  TerrainWidget land;
  land.resize(kWidth, kHeight);
  land.show();
  showDetail(land);
  EXPECT_GT(land.world()->nodeErrors().nextToCalibrate(), land.world()->topLevel());
}

TEST(TerrainWidget, ChoosesItsDetailForThePictureItHasAlsoWhenItIsResized) {
  TerrainWidget land;
  land.resize(kWidth, kHeight);
  land.show();
  showDetail(land);
  const std::size_t low = land.figures().triangles;
  land.resize(kWidth, 4 * kHeight);
  ASSERT_TRUE(comesToRest(land));
  const std::size_t high = land.figures().triangles;
  EXPECT_GT(high, low + low / 2) << "each pixel is smaller now";
  land.resize(kWidth, kHeight);
  ASSERT_TRUE(comesToRest(land));
  EXPECT_LT(land.figures().triangles, (low + high) / 2) << "hysteresis keeps some of it";
  EXPECT_EQ(land.options().view.detail->lines, DetailSettings{}.lines) << "options are as they were set";
}

TEST(TerrainWidget, RestsWhileHiddenAndGoesOnWhenShown) {
  const auto land = landAtRest();
  ASSERT_TRUE(land->setViewer({.position = {9000, 0, 0.0, 0.0}}).ok());
  ASSERT_TRUE(isWorking(*land));
  land->hide();
  timerEvents(100);
  const auto last = land->figures().lastUpdate;
  EXPECT_EQ(timerEvents(300), 0);
  ASSERT_TRUE(land->setViewer({.position = {-9000, 0, 0.0, 0.0}}).ok());
  showSmallLand(*land, 7);
  EXPECT_FALSE(isWorking(*land));
  timerEvents(100);
  EXPECT_EQ(timerEvents(300), 0);
  EXPECT_EQ(land->figures().slices, 0U) << "the new engine has done nothing yet";
  land->show();
  ASSERT_TRUE(comesToRest(*land));
  EXPECT_NE(land->figures().lastUpdate, last);
  EXPECT_EQ(land->figures().pending, 0U);
  EXPECT_GT(landShare(screenOf(*land)), 0.3);
}

TEST(TerrainWidget, RestsWhileItsWindowIsMinimized) {
  QWidget window;
  auto* layout = new QVBoxLayout(&window);
  auto* land = new TerrainWidget;
  layout->addWidget(land);
  window.show();
  showSmallLand(*land);
  ASSERT_TRUE(isWorking(*land));
  window.setWindowState(Qt::WindowMinimized);
  EXPECT_FALSE(isWorking(*land));
  ASSERT_TRUE(land->setViewer({.position = {5, 0, 0.0, 0.0}}).ok());
  EXPECT_FALSE(isWorking(*land));
  window.setWindowState(Qt::WindowNoState);
  EXPECT_TRUE(isWorking(*land));
  EXPECT_TRUE(comesToRest(*land));
}

TEST(TerrainWidget, SurvivesReparentingAndTheSwitchingOfTabs) {
  TerrainWidget* land = landAtRest().release();
  const QImage before = screenOf(*land);

  QTabWidget tabs;
  tabs.resize(kWidth + 40, kHeight + 60);
  tabs.addTab(land, QStringLiteral("land"));
  tabs.addTab(new QWidget, QStringLiteral("other"));
  tabs.show();
  ASSERT_TRUE(comesToRest(*land));
  EXPECT_GT(landShare(screenOf(*land)), 0.3);

  tabs.setCurrentIndex(1);
  timerEvents(100);
  EXPECT_EQ(timerEvents(200), 0);
  tabs.setCurrentIndex(0);
  ASSERT_TRUE(comesToRest(*land));
  EXPECT_GT(landShare(screenOf(*land)), 0.3);
  tabs.hide();

  QWidget window;
  window.resize(kWidth, kHeight);
  auto* layout = new QVBoxLayout(&window);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(land);
  land->show();
  window.show();
  ASSERT_TRUE(comesToRest(*land));
  EXPECT_LT(difference(screenOf(*land), before), 0.01) << "the same land in another window";
  window.hide();

  land->setParent(nullptr);  // a window of its own again
  land->show();
  ASSERT_TRUE(comesToRest(*land));
  EXPECT_LT(difference(screenOf(*land), before), 0.01);
  delete land;
}

TEST(TerrainWidget, MayBeDeletedAndMadeAgain) {
  QImage before;
  for (int round = 0; round < 3; ++round) {
    const auto land = landAtRest();
    const QImage picture = screenOf(*land);
    EXPECT_GT(landShare(picture), 0.3);
    EXPECT_LT(difference(picture, round == 0 ? picture : before), 0.01);
    before = picture;
    EXPECT_TRUE(land->setViewer({.position = {500 + round, 0, 0.0, 0.0}}).ok());  // it goes while it works
  }
}

TEST(TerrainWidget, StandsBesideAnotherInOneWindow) {
  QWidget window;
  window.resize(2 * kWidth, kHeight);
  auto* layout = new QHBoxLayout(&window);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  auto* left = new TerrainWidget;
  auto* right = new TerrainWidget;
  layout->addWidget(left);
  layout->addWidget(right);
  window.show();
  showSmallLand(*left, 42);
  showSmallLand(*right, 7);
  ASSERT_TRUE(comesToRest(*left));
  ASSERT_TRUE(comesToRest(*right));
  EXPECT_GT(landShare(screenOf(*left)), 0.3);
  EXPECT_GT(landShare(screenOf(*right)), 0.3);
  EXPECT_GT(difference(screenOf(*left), screenOf(*right)), 0.3) << "two worlds";
  EXPECT_NE(left->world()->height({}), right->world()->height({}));

  const QImage before = screenOf(*right);
  delete left;
  ASSERT_TRUE(comesToRest(*right));
  EXPECT_EQ(right->width(), 2 * kWidth);
  EXPECT_GT(landShare(screenOf(*right)), 0.3);
  ASSERT_TRUE(right->setViewer({.position = {500, 0, 0.0, 0.0}}).ok());
  ASSERT_TRUE(comesToRest(*right));
  EXPECT_GT(landShare(screenOf(*right)), 0.3);
}

TEST(TerrainWidget, KeepsTheLandUntilTheNextWorldHasSome) {
  const auto land = landAtRest();
  const auto before = land->terrain().scene();
  land->setFrameBudget(std::chrono::microseconds(100));
  showSmallLand(*land, 7);
  ASSERT_TRUE(QTest::qWaitFor([&land] { return land->figures().slices > 0; }, 20'000));
  EXPECT_EQ(land->terrain().scene(), before) << "nothing of the new world is there yet";
  land->setFrameBudget(std::chrono::milliseconds(4));
  ASSERT_TRUE(comesToRest(*land));
  EXPECT_NE(land->terrain().scene(), before);
  EXPECT_FALSE(land->terrain().scene()->meshes().empty());
  EXPECT_EQ(land->world()->seed(), 7U);
}

TEST(TerrainWidget, SaysWhatItRefusesAndKeepsWhatItHas) {
  const auto land = landAtRest();
  const auto world = land->world();
  const Viewer viewer = land->viewer();
  QSignalSpy said(land.get(), &TerrainWidget::errorOccurred);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  WorldDescription nameless = WorldDescription::standard();
  nameless.layers[0].generator = "nosuch";
  const std::pair<Result<void>, const char*> refusals[] = {
      {land->setWorldFile(QStringLiteral("/nowhere/none.json")), "none.json"},
      {land->setWorldText(QStringLiteral("{ \"layers\": 3 }")), "layers"},
      {land->setWorld(nameless), "nosuch"},
      {land->setOptions({.view = {.level = 99}}), "99"},
      {land->setOptions({.view = {}, .workers = -1}), "-1"},
      {land->setViewer({.position = {.u = nan}}), "nan"},
      {land->setViewer({.position = {.i = kMaxPatch + 1}}), "patch"},
      {land->setViewer({.position = {}, .heightAboveGround = 0.0}), "heightAboveGround"},
      {land->setViewer({.position = {}, .heading = std::numeric_limits<double>::infinity()}), "heading"},
      {land->setViewer({.position = {}, .pitch = 2.0}), "pitch"},
  };
  ASSERT_EQ(said.count(), static_cast<int>(std::size(refusals)));
  for (int index = 0; index < said.count(); ++index) {
    const auto& [result, word] = refusals[index];
    ASSERT_FALSE(result.ok()) << word;
    const std::string sentence = result.error().message;
    EXPECT_EQ(said[index][0].toString().toStdString(), sentence);
    EXPECT_NE(sentence.find(word), std::string::npos) << sentence;
    EXPECT_EQ(sentence.find('\n'), std::string::npos) << sentence;
  }
  EXPECT_EQ(land->world(), world);
  EXPECT_EQ(land->viewer(), viewer);
  EXPECT_EQ(land->options().view.level, 1);
  EXPECT_GT(landShare(screenOf(*land)), 0.3);
}

TEST(TerrainWidget, TakesAWorldAsTextAndAsAFile) {
  const auto land = landAtRest();
  const QString text = QStringLiteral(R"({ "seed": 5, "layers": [ { "generator": "fault" } ] })");
  ASSERT_TRUE(land->setWorldText(text).ok());
  EXPECT_EQ(land->world()->seed(), 5U);
  QTemporaryFile file;
  ASSERT_TRUE(file.open());
  file.write(QByteArray(text.toUtf8()).replace("5", "6"));
  file.close();
  ASSERT_TRUE(land->setWorldFile(file.fileName()).ok());
  EXPECT_EQ(land->world()->seed(), 6U);
}

TEST(TerrainWidget, ReportsFiguresWhileItWorksAndWhenItRests) {
  const auto land = landAtRest();
  QSignalSpy told(land.get(), &TerrainWidget::figuresChanged);
  ASSERT_TRUE(land->setViewer({.position = {700, 0, 0.0, 0.0}}).ok());
  ASSERT_TRUE(comesToRest(*land));
  ASSERT_GE(told.count(), 1);
  const auto last = told.back()[0].value<EngineFigures>();
  EXPECT_EQ(last.pending, 0U);
  EXPECT_EQ(last.slices, land->figures().slices);
  EXPECT_EQ(last.bytes, land->figures().bytes);
}

/// Stands where it is put.
class Post final : public Object {
 public:
  explicit Post(double height) { motion_.height = height; }
  void update(double /*dt*/, const Ground& /*ground*/) override {}
  Motion motion() const override { return motion_; }

 private:
  Motion motion_;
};

TEST(TerrainWidget, CountsWhatIsOnTheGraphicsCardUnderItsEnginesCap) {
  const auto land = landAtRest();
  const auto undrawn = Engine::create(land->world(), land->options());
  ASSERT_TRUE(undrawn.ok());
  (*undrawn)->add(std::make_unique<Post>(land->eyeHeight()));
  (*undrawn)->settle();
  const auto held = static_cast<double>((*undrawn)->figures().bytes);
  const auto buffers = static_cast<double>(land->terrain().bufferBytes());
  ASSERT_GT(buffers, 100'000.0);
  EXPECT_NEAR(static_cast<double>(land->figures().bytes), held + buffers, 0.1 * buffers);
}

TEST(TerrainWidget, ShowsTheSameLandWithWorkers) {
  const auto land = landAtRest();
  const QImage alone = screenOf(*land);
  EngineOptions options = land->options();
  options.workers = 2;
  ASSERT_TRUE(land->setOptions(options).ok());
  ASSERT_TRUE(comesToRest(*land));
  EXPECT_LT(difference(screenOf(*land), alone), 0.01);
}

TEST(TerrainWidget, KeepsItsBudgetBetweenATenthOfAMillisecondAndASecond) {
  using namespace std::chrono_literals;
  TerrainWidget land;
  EXPECT_EQ(land.frameBudget(), 4ms);
  for (const auto& [asked, kept] : {std::pair<std::chrono::nanoseconds, std::chrono::nanoseconds>{2ms, 2ms},
                                    {0ms, 100us},
                                    {-1h, 100us},
                                    {1h, 1s}}) {
    land.setFrameBudget(asked);
    EXPECT_EQ(land.frameBudget(), kept);
  }
}

TEST(TerrainWidget, TurnsWithTheMouseAndGoesWithTheWheel) {
  const auto land = landAtRest();
  QWidget& canvas = canvasOf(*land);
  const Viewer before = land->viewer();
  QSignalSpy cursor(land.get(), &TerrainWidget::cursorMoved);
  QTest::mouseMove(&canvas, QPoint(20, 30));
  QTest::mouseMove(&canvas, QPoint(50, 60));
  ASSERT_TRUE(QTest::qWaitFor([&cursor] { return !cursor.isEmpty() && cursor.back()[0] == QPoint(50, 60); }));
  EXPECT_EQ(cursor.back()[0].toPoint(), QPoint(50, 60));
  EXPECT_EQ(land->viewer(), before) << "without a button it only looks";

  QTest::mousePress(&canvas, Qt::LeftButton, Qt::NoModifier, QPoint(50, 60));
  QMouseEvent drag(QEvent::MouseMove, QPointF(150, 80), Qt::NoButton, Qt::LeftButton, Qt::NoModifier);
  QApplication::sendEvent(&canvas, &drag);
  QTest::mouseRelease(&canvas, Qt::LeftButton, Qt::NoModifier, QPoint(150, 80));
  EXPECT_NEAR(land->viewer().heading, before.heading - 0.5, 1e-9) << "the land follows the mouse";
  EXPECT_NEAR(land->viewer().pitch, before.pitch + 0.1, 1e-9);

  ASSERT_TRUE(land->setViewer(before).ok());
  const auto wheel = [&canvas](Qt::KeyboardModifiers modifiers) {
    QWheelEvent event(QPointF(50, 60), QPointF(50, 60), QPoint(), QPoint(0, 120), Qt::NoButton, modifiers,
                      Qt::NoScrollPhase, false);
    QApplication::sendEvent(&canvas, &event);
  };
  wheel(Qt::NoModifier);
  const Offset way = offset(before.position, land->viewer().position, land->world()->pitch());
  EXPECT_NEAR(way.north, 0.4 * before.heightAboveGround, 1e-6);
  EXPECT_NEAR(way.east, 0.0, 1e-6);
  wheel(Qt::ShiftModifier);
  EXPECT_NEAR(land->viewer().heightAboveGround, 1.15 * before.heightAboveGround, 1e-6);
}

TEST(TerrainWidget, WorksAlsoWhileItIsMovedWithoutAPause) {
  const auto land = landAtRest();
  const auto before = land->figures().slices;
  Viewer viewer = land->viewer();
  for (int turn = 0; turn < 400 && land->figures().slices == before; ++turn) {
    viewer.position.i += 1;
    ASSERT_TRUE(land->setViewer(viewer).ok());
    QTest::qWait(1);
  }
  EXPECT_GT(land->figures().slices, before);
}

TEST(TerrainWidget, MayBeDeletedByWhomItTellsOfItsFigures) {
  TerrainWidget* land = landAtRest().release();
  const QPointer<TerrainWidget> alive(land);
  QObject::connect(land, &TerrainWidget::figuresChanged, land, [land] { delete land; });
  ASSERT_TRUE(land->setViewer({.position = {50, 0, 0.0, 0.0}}).ok());
  EXPECT_TRUE(QTest::qWaitFor([&alive] { return alive.isNull(); }, 20'000));
}

TEST(TerrainWidget, MakesItsWorldAnewWithOtherPluginsAndKeepsTheOldOneWhereTheyLackOne) {
  const ScratchFolder folder;
  const auto put = [&folder](const char* version) {
    std::filesystem::copy_file(std::filesystem::path(TEREN_TEST_FLY_MODULES) / version / "teren-plain.so",
                               folder / "teren-plain.so", std::filesystem::copy_options::overwrite_existing);
  };
  const std::array folders = {folder.path()};
  put("low");
  const auto plugins = PluginRegistry::load(folders, ModuleLoading::copied);
  TerrainWidget land;
  QSignalSpy errors(&land, &TerrainWidget::errorOccurred);
  ASSERT_TRUE(land.setPlugins(plugins).ok());
  ASSERT_TRUE(land.setWorldText(QStringLiteral(R"({ "layers": [ { "generator": "plain" } ] })")).ok());
  EXPECT_EQ(land.world()->height({}), -300.0);
  put("high");
  ASSERT_TRUE(land.setPlugins(plugins->reloaded().value()).ok());
  EXPECT_EQ(land.world()->height({}), 700.0);
  EXPECT_EQ(errors.count(), 0);
  const Result<void> refused = land.setPlugins(PluginRegistry::load({}));
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().message.find("no generator has the id \"plain\""), std::string::npos);
  EXPECT_FALSE(land.setPlugins(nullptr).ok());
  EXPECT_EQ(errors.count(), 2);
  EXPECT_EQ(land.world()->height({}), 700.0);
  EXPECT_TRUE(land.setWorldText(QStringLiteral(R"({ "layers": [ { "generator": "plain" } ] })")).ok())
      << "the plugins are still those from before";
}

}  // namespace
}  // namespace teren
