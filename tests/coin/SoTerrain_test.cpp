#include "coin/SoTerrain.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <limits>
#include <ostream>
#include <string>
#include <thread>
#include <vector>

#include <Inventor/SbVec3d.h>
#include <Inventor/SbViewportRegion.h>
#include <Inventor/SoDB.h>
#include <Inventor/SoFullPath.h>
#include <Inventor/SoInput.h>
#include <Inventor/SoPickedPoint.h>
#include <Inventor/SoPrimitiveVertex.h>
#include <Inventor/actions/SoCallbackAction.h>
#include <Inventor/actions/SoGetBoundingBoxAction.h>
#include <Inventor/actions/SoGetMatrixAction.h>
#include <Inventor/actions/SoGetPrimitiveCountAction.h>
#include <Inventor/actions/SoRayPickAction.h>
#include <Inventor/actions/SoSearchAction.h>
#include <Inventor/misc/SoChildList.h>
#include <Inventor/nodes/SoPerspectiveCamera.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/sensors/SoSensorManager.h>
#include <gtest/gtest.h>

#include "teren/Engine.h"
#include "teren/Hash.h"

#include "coin/SoTerrainMesh.h"
#include "tests/coin/Complaints.h"
#include "tests/coin/OffscreenView.h"
#include "tests/coin/Stage.h"
#include "world/NodeErrors.h"

namespace teren {
namespace {

const SbViewportRegion kRegion(64, 64);

SbBox3f boxOf(SoNode* node) {
  SoGetBoundingBoxAction action(kRegion);
  action.apply(node);
  return action.getBoundingBox();
}

/// Hidden children included. The cast is Inventor's own idiom, though the object is no SoFullPath.
__attribute__((no_sanitize("vptr"))) SoNode* lastNode(const SoPath* path) {
  return static_cast<const SoFullPath*>(path)->getTail();
}

/// Straight down from high above a point of the scene.
const SoPickedPoint* pickDown(SoRayPickAction& action, SoNode* root, float x, float y) {
  action.setRay(SbVec3f(x, y, 4000.0F), SbVec3f(0.0F, 0.0F, -1.0F));
  action.apply(root);
  return action.getPickedPoint();
}

TEST(SoTerrain, IsReadFromAFileAndWrittenBackWithItsFieldsOnly) {
  const std::string text =
      "#Inventor V2.1 ascii\n\nSeparator {\n  SoTerrain {\n    seed \"42\"\n    parameters [ ]\n    "
      "viewDistance 100\n"
      "    viewLevel 0\n    waterLevel -100\n    origin 64 128 5\n    logarithmicDepth TRUE\n  }\n}\n";
  SoNode* root = readScene(text);
  auto* terrain = static_cast<SoTerrain*>(static_cast<SoSeparator*>(root)->getChild(0));
  ASSERT_TRUE(terrain->isOfType(SoTerrain::getClassTypeId()));
  EXPECT_STREQ(terrain->seed.getValue().getString(), "42");
  EXPECT_TRUE(terrain->logarithmicDepth.getValue());
  const std::string before = writeScene(root);
  terrain->settle();
  EXPECT_GT(terrain->getChildren()->getLength(), 0);
  const std::string after = writeScene(root);
  EXPECT_EQ(after, before);
  EXPECT_NE(after.find("logarithmicDepth TRUE"), std::string::npos) << after;
  EXPECT_EQ(after.find("TerrainMesh"), std::string::npos);

  SoNode* again = readScene(after);
  EXPECT_EQ(writeScene(again), after);
  again->unref();
  root->unref();
}

TEST(SoTerrain, OwnsTheStandardWorldWhereItsFieldsSayNothing) {
  const Stage stage;
  ASSERT_NE(stage.terrain->engine(), nullptr);
  EXPECT_STREQ(stage.terrain->errorText().getString(), "");
  EXPECT_EQ(stage.terrain->engine()->world().seed(), WorldDescription::standard().seed);
  EXPECT_GE(stage.terrain->engine()->options().view.reach(stage.terrain->engine()->world()), 1500.0);
}

TEST(SoTerrain, MakesItsWorldFromGeneratorAndParameters) {
  const Stage stage;
  makeSmall(*stage.terrain);
  stage.terrain->generator = "fault";
  stage.terrain->parameters.set1Value(0, "deviation=3");
  stage.terrain->seed = "18446744073709551615";
  ASSERT_STREQ(stage.terrain->errorText().getString(), "");
  EXPECT_EQ(stage.terrain->engine()->world().seed(), std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(stage.terrain->engine()->world().deviation(), 3.0);
}

TEST(SoTerrain, LooksForItsWorldInTheFolderOfTheFileItIsReadFrom) {
  const std::filesystem::path folder = std::filesystem::path(::testing::TempDir()) / "teren-coin-world";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "flat.json") << R"({"seed": 7, "layers": [{"generator": "fault"}]})";
  std::ofstream(folder / "scene.iv")
      << "#Inventor V2.1 ascii\nSoTerrain { world \"flat.json\" viewLevel 0 }\n";
  SoInput input;
  ASSERT_TRUE(input.openFile((folder / "scene.iv").c_str()));
  SoSeparator* root = SoDB::readAll(&input);
  input.closeFile();
  ASSERT_NE(root, nullptr);
  root->ref();
  auto* terrain = static_cast<SoTerrain*>(root->getChild(0));
  EXPECT_STREQ(terrain->errorText().getString(), "");
  ASSERT_NE(terrain->engine(), nullptr);
  EXPECT_EQ(terrain->engine()->world().seed(), 7U);
  EXPECT_STREQ(terrain->world.getValue().getString(), "flat.json");
  root->unref();
  std::filesystem::remove_all(folder);
}

struct BadField {
  const char* fields;
  const char* field;  // must be named
  const char* value;  // must be shown
};

/// The test's name as ctest shows it.
void PrintTo(const BadField& bad, std::ostream* stream) {
  *stream << bad.fields;
}

class SoTerrainRefuses : public ::testing::TestWithParam<BadField> {};

TEST_P(SoTerrainRefuses, ABadFieldWithOneSentenceAndKeepsTheLandscape) {
  const Stage stage;
  makeSmall(*stage.terrain);
  stage.terrain->settle();
  const std::shared_ptr<const Scene> before = stage.terrain->scene();
  ASSERT_FALSE(before->meshes().empty());
  const Complaints complaints;
  ASSERT_TRUE(stage.terrain->set(GetParam().fields));
  const std::string said = stage.terrain->errorText().getString();
  EXPECT_NE(said.find(GetParam().field), std::string::npos) << said;
  EXPECT_NE(said.find(GetParam().value), std::string::npos) << said;
  EXPECT_EQ(said.find('\n'), std::string::npos) << said;
  EXPECT_EQ(complaints.sentences.size(), 1U);
  stage.terrain->settle();
  EXPECT_EQ(stage.terrain->scene(), before);
}

INSTANTIATE_TEST_SUITE_P(
    EachField, SoTerrainRefuses,
    ::testing::Values(
        BadField{"seed \"-1\"", "seed", "-1"}, BadField{"seed \"18446744073709551616\"", "seed", "616"},
        BadField{"seed \"4x\"", "seed", "4x"},
        BadField{"world \"/nowhere/none.json\"", "none.json", "/nowhere"},
        BadField{"generator \"nosuch\"", "generator", "nosuch"},
        BadField{"generator \"band\"", "generator", "band"},
        BadField{"generator \"fault\" world \"a.json\"", "world", "a.json"},
        BadField{"parameters \"faults=3\"", "parameters", "faults=3"},
        BadField{"generator \"fault\" parameters \"faults\"", "parameters", "faults"},
        BadField{"generator \"fault\" parameters \"faults=-7\"", "faults", "-7"},
        BadField{"generator \"fault\" parameters \"nosuch=1\"", "nosuch", "nosuch"},
        BadField{"viewLevel -1", "viewLevel", "-1"}, BadField{"viewLevel 99", "viewLevel", "99"},
        BadField{"pixelError -1", "pixelError", "-1"}, BadField{"pixelError 0.05", "pixelError", "0.05"},
        BadField{"pixelError 101", "pixelError", "101"},
        BadField{"pixelError 20 viewDistance 2e6", "viewDistance", "2e+06"},
        BadField{"viewDistance 0", "viewDistance", "0 m"},
        BadField{"viewDistance 1e9", "viewDistance", "1e+09"}));

TEST(SoTerrain, RefusesNumbersThatAreNone) {
  const Complaints complaints;
  const Stage stage;
  makeSmall(*stage.terrain);
  stage.terrain->settle();
  const std::shared_ptr<const Scene> before = stage.terrain->scene();
  const SbBox3f box = boxOf(stage.root);
  stage.terrain->origin = SbVec3d(0.0, std::numeric_limits<double>::infinity(), 0.0);
  EXPECT_STREQ(stage.terrain->errorText().getString(),
               "origin is 0 inf 0, expected three numbers from -1e30 to 1e30");
  EXPECT_EQ(boxOf(stage.root), box) << "the last good origin holds";
  stage.terrain->origin = SbVec3d(0.0, 0.0, 0.0);
  EXPECT_STREQ(stage.terrain->errorText().getString(), "");
  stage.terrain->viewDistance = std::numeric_limits<float>::quiet_NaN();
  EXPECT_NE(std::string(stage.terrain->errorText().getString()).find("viewDistance"), std::string::npos);
  EXPECT_EQ(stage.terrain->scene(), before);
  EXPECT_EQ(complaints.sentences.size(), 2U);
}

TEST(SoTerrain, RecoversWhenTheFieldsAreGoodAgain) {
  const Complaints complaints;
  const Stage stage;
  makeSmall(*stage.terrain);
  stage.terrain->seed = "garbage";
  EXPECT_EQ(stage.terrain->engine(), nullptr);
  EXPECT_TRUE(boxOf(stage.root).isEmpty());
  stage.terrain->seed = "5";
  EXPECT_STREQ(stage.terrain->errorText().getString(), "");
  ASSERT_NE(stage.terrain->engine(), nullptr);
  EXPECT_EQ(stage.terrain->engine()->world().seed(), 5U);
}

TEST(SoTerrain, ExpectsThreeByThreePatchesBeforeThereIsGround) {
  const Stage stage;
  stage.terrain->origin = SbVec3d(6400.0, -6400.0, 10.0);
  stage.terrain->waterLevel = -2e6F;
  const SbBox3f box = boxOf(stage.root);
  const World& world = stage.terrain->engine()->world();
  ASSERT_TRUE(stage.terrain->scene()->meshes().empty());
  EXPECT_EQ(box.getMin(),
            SbVec3f(-64.0F, -64.0F, static_cast<float>(world.mean() - 10.0 - 3.0 * world.deviation())));
  EXPECT_EQ(box.getMax(),
            SbVec3f(128.0F, 128.0F, static_cast<float>(world.mean() - 10.0 + 3.0 * world.deviation())));
}

TEST(SoTerrain, HasTheBoxOfItsMeasuredGroundAndOfTheWaterAboveIt) {
  const Stage stage;
  stage.terrain->waterLevel = -2e6F;
  stage.terrain->setScene(makeScene({.height = [](double x, double y) { return 0.5 * x - y; }}));
  EXPECT_EQ(boxOf(stage.root), SbBox3f(0.0F, 0.0F, -64.0F, 128.0F, 128.0F, 32.0F));
  stage.terrain->waterLevel = -100.0F;
  EXPECT_EQ(boxOf(stage.root), SbBox3f(0.0F, 0.0F, -64.0F, 128.0F, 128.0F, 32.0F))
      << "no ground lies below it";
  stage.terrain->waterLevel = 50.0F;
  EXPECT_EQ(boxOf(stage.root), SbBox3f(0.0F, 0.0F, -64.0F, 128.0F, 128.0F, 50.0F));
  stage.terrain->waterLevel = -2e6F;
  stage.terrain->origin = SbVec3d(100.0, 0.0, 1.0);
  EXPECT_EQ(boxOf(stage.root), SbBox3f(-100.0F, 0.0F, -65.0F, 28.0F, 128.0F, 31.0F));
}

TEST(SoTerrain, IsPickedAtTheHeightOfItsWorldAlsoFarFromTheWorldsZero) {
  for (const double far : {0.0, 64.0 * 0x1p36}) {
    const Stage stage;
    makeSmall(*stage.terrain);
    stage.terrain->origin = SbVec3d(far, -far, 100.0);
    stage.terrain->settle();
    const World& world = stage.terrain->engine()->world();
    for (const float x : {-80.3F, 0.7F, 33.1F, 64.0F, 95.9F}) {
      SoRayPickAction action(kRegion);
      const SoPickedPoint* picked = pickDown(action, stage.root, x, 0.31F * x);
      ASSERT_NE(picked, nullptr);
      const SbVec3f point = picked->getPoint();
      EXPECT_NEAR(point[0], x, 1e-3);
      const Position place =
          *Position::fromMetres(far, -far, world.pitch())
               ->movedBy(static_cast<double>(point[0]), static_cast<double>(point[1]), world.pitch());
      const double height = static_cast<double>(point[2]) + 100.0;
      EXPECT_NEAR(height, *stage.terrain->engine()->drawnHeight(place), 2e-3);
      EXPECT_NEAR(height, world.height(place), world.query(place).error + 2e-3);
      EXPECT_TRUE(lastNode(picked->getPath())->isOfType(SoTerrainMesh::getClassTypeId()));
      EXPECT_TRUE(picked->getPath()->containsNode(stage.terrain));
    }
  }
}

TEST(SoTerrain, SearchesFindItsMeshesAndTheirPathsLeadToThem) {
  const Stage stage;
  stage.terrain->setScene(makeScene({.column = 1000}));
  SoSearchAction search;
  search.setType(SoTerrainMesh::getClassTypeId());
  search.setInterest(SoSearchAction::ALL);
  search.apply(stage.root);
  ASSERT_EQ(search.getPaths().getLength(), 16);
  SoPath* path = search.getPaths()[5];
  SoGetMatrixAction matrix(kRegion);
  matrix.apply(path);
  EXPECT_EQ(matrix.getMatrix()[3][0], 2032.0F);
  EXPECT_EQ(matrix.getInverse()[3][0], -2032.0F);
  SoGetBoundingBoxAction box(kRegion);
  box.apply(path);
  EXPECT_EQ(box.getBoundingBox(), SbBox3f(2032.0F, 32.0F, 0.0F, 2064.0F, 64.0F, 0.0F));
}

struct Triangles {
  int count = 0;
  SbBox3f box;
};

void countTriangle(void* data, SoCallbackAction* action, const SoPrimitiveVertex* a,
                   const SoPrimitiveVertex* b, const SoPrimitiveVertex* c) {
  auto* triangles = static_cast<Triangles*>(data);
  ++triangles->count;
  for (const SoPrimitiveVertex* vertex : {a, b, c}) {
    SbVec3f point;
    action->getModelMatrix().multVecMatrix(vertex->getPoint(), point);
    triangles->box.extendBy(point);
    EXPECT_NEAR(vertex->getNormal().length(), 1.0F, 1e-4F);
  }
}

TEST(SoTerrain, CallbacksAndCountsSeeEveryTriangleInItsPlace) {
  const Stage stage;
  stage.terrain->setScene(makeScene({.height = [](double x, double /*y*/) { return x; }}));
  Triangles seen;
  SoCallbackAction callback(kRegion);
  callback.addTriangleCallback(SoTerrainMesh::getClassTypeId(), countTriangle, &seen);
  callback.apply(stage.root);
  EXPECT_EQ(seen.count, 16 * 16 * 16 * 2);
  EXPECT_EQ(seen.box, SbBox3f(0.0F, 0.0F, 0.0F, 128.0F, 128.0F, 64.0F));
  SoGetPrimitiveCountAction count(kRegion);
  count.apply(stage.root);
  EXPECT_EQ(count.getTriangleCount(), seen.count);
}

struct Corners {
  SbVec3d a, b, c;
};

void collectTriangle(void* data, SoCallbackAction* action, const SoPrimitiveVertex* a,
                     const SoPrimitiveVertex* b, const SoPrimitiveVertex* c) {
  const auto place = [action](const SoPrimitiveVertex* vertex) {
    SbVec3f point;
    action->getModelMatrix().multVecMatrix(vertex->getPoint(), point);
    return SbVec3d(point);
  };
  static_cast<std::vector<Corners>*>(data)->push_back({place(a), place(b), place(c)});
}

/// How far along the ray (in lengths of `way`) it meets a triangle; infinity where it does not.
/// (Moeller and Trumbore 1997)
double meets(const SbVec3d& from, const SbVec3d& way, const Corners& triangle) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const SbVec3d ab = triangle.b - triangle.a, ac = triangle.c - triangle.a;
  const SbVec3d across = way.cross(ac), away = from - triangle.a;
  const double volume = ab.dot(across);
  const double u = away.dot(across) / volume;
  const SbVec3d turned = away.cross(ab);
  const double v = way.dot(turned) / volume, t = ac.dot(turned) / volume;
  return u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t >= 0.0 ? t : kNever;
}

TEST(SoTerrain, IsPickedWhereItsNearestTriangleIs) {
  const Stage stage;
  stage.terrain->setScene(makeScene(
      {.height = [](double x, double y) { return 9.0 * std::sin(0.7 * x) * std::cos(0.9 * y) + 0.1 * x; }}));
  std::vector<Corners> triangles;
  SoCallbackAction callback(kRegion);
  callback.addTriangleCallback(SoTerrainMesh::getClassTypeId(), collectTriangle, &triangles);
  callback.apply(stage.root);
  constexpr std::uint64_t kSeed = 12;
  SCOPED_TRACE(kSeed);
  RandomSequence random(kSeed);
  const auto uniform = [&random](double low, double high) {
    return low + (high - low) * static_cast<double>(random.nextBits(53)) * 0x1p-53;
  };
  int hits = 0;
  for (int ray = 0; ray < 300; ++ray) {
    // From all around, mostly nearly level, as the eye of a person looks over land.
    const SbVec3f from(static_cast<float>(uniform(-60.0, 190.0)), static_cast<float>(uniform(-60.0, 190.0)),
                       static_cast<float>(uniform(10.0, 40.0)));
    const SbVec3f to(static_cast<float>(uniform(0.0, 128.0)), static_cast<float>(uniform(0.0, 128.0)), 3.0F);
    SbVec3f way = to - from;
    way.normalize();
    double nearest = std::numeric_limits<double>::infinity();
    for (const Corners& triangle : triangles) {
      nearest = std::min(nearest, meets(SbVec3d(from), SbVec3d(way), triangle));
    }
    SoRayPickAction action(kRegion);
    action.setRay(from, way, 0.0F, 1000.0F);
    action.apply(stage.root);
    const SoPickedPoint* picked = action.getPickedPoint();
    ASSERT_EQ(picked != nullptr, std::isfinite(nearest)) << ray;
    if (picked == nullptr) continue;
    ++hits;
    EXPECT_NEAR(static_cast<double>((picked->getPoint() - from).length()), nearest, 2e-3) << ray;
    EXPECT_NEAR(picked->getNormal().length(), 1.0F, 1e-5F);
    EXPECT_GT(picked->getNormal()[2], 0.0F);
  }
  EXPECT_GT(hits, 100);
}

TEST(SoTerrain, ShowsTheLastSnapshotItWasGiven) {
  const Stage stage;
  const auto whole = makeScene({}, 1);
  stage.terrain->setScene(whole);
  EXPECT_EQ(stage.terrain->engine(), nullptr);
  EXPECT_EQ(stage.terrain->scene(), whole);
  // Every second mesh goes, and new ones come with ids between and after those that stay.
  std::vector<std::shared_ptr<const Mesh>> meshes;
  for (const auto& mesh : whole->meshes()) {
    if (mesh->id % 2 == 0) meshes.push_back(mesh);
  }
  const auto more = makeScene({.side = 2, .firstId = 17}, 1);
  meshes.insert(meshes.end(), more->meshes().begin(), more->meshes().end());
  stage.terrain->setScene(std::make_shared<const Scene>(2, 2.0, meshes));
  ASSERT_EQ(stage.terrain->getChildren()->getLength(), 12);
  for (int index = 0; index < 12; ++index) {
    const auto* child = static_cast<const SoTerrainMesh*>((*stage.terrain->getChildren())[index]);
    EXPECT_EQ(child->mesh(), meshes[static_cast<std::size_t>(index)]);
  }
  stage.terrain->setScene(whole);
  EXPECT_EQ(stage.terrain->getChildren()->getLength(), 16);
  makeSmall(*stage.terrain);
  stage.terrain->setScene(nullptr);
  EXPECT_EQ(stage.terrain->scene(), whole) << "until the fields' engine has something to show";
  stage.terrain->settle();
  ASSERT_NE(stage.terrain->engine(), nullptr);
  EXPECT_EQ(stage.terrain->scene(), stage.terrain->engine()->scene());
}

void processSensors() {
  SoDB::getSensorManager()->processTimerQueue();
  SoDB::getSensorManager()->processDelayQueue(TRUE);
  std::this_thread::sleep_for(std::chrono::milliseconds(2));
}

/// Lets sensors work until nothing is missing, to be measured or to be freed.
void fill(const Engine& engine) {
  for (int turn = 0; turn < 20'000; ++turn) {
    processSensors();
    const EngineFigures figures = engine.figures();
    if (turn >= 50 && figures.pending == 0 && !figures.measuring) return;
  }
  FAIL() << "it is never done";
}

TEST(SoTerrain, FillsItsViewFromItsOwnTimerFollowsTheEyeAndRests) {
  const Stage stage;
  makeSmall(*stage.terrain);
  stage.terrain->frameBudget = SbTime(0.005);
  OffscreenView view(64, 48);
  view.draw(stage.root, kMagenta);
  EXPECT_TRUE(stage.terrain->scene()->meshes().empty()) << "nothing is generated inside a traversal";
  Engine* engine = stage.terrain->engine();
  fill(*engine);
  EXPECT_EQ(stage.terrain->scene(), engine->scene());
  stage.camera->position = SbVec3f(5000.0F, -3000.0F, 900.0F);
  view.draw(stage.root, kMagenta);
  fill(*engine);
  EXPECT_EQ(stage.terrain->scene(), engine->scene());
  EXPECT_TRUE(
      engine->drawnHeight(*Position::fromMetres(5000.0, -3000.0, engine->world().pitch())).has_value());
  EXPECT_EQ(engine, stage.terrain->engine()) << "the engine is the same as long as the fields are";

  view.draw(stage.root, kMagenta);
  const auto last = engine->figures().lastUpdate;
  for (int turn = 0; turn < 50; ++turn) processSensors();
  EXPECT_EQ(engine->figures().lastUpdate, last)
      << "an update although nothing was missing and nothing had moved";
}

/// A world of one layer, whose errors are soon measured, with detail by error.
void makeDetailed(SoTerrain& terrain) {
  terrain.generator = "fault";
  terrain.viewDistance = 1500.0F;
  terrain.pixelError = 4.0F;
  terrain.frameBudget = SbTime(0.02);
}

TEST(SoTerrain, RefinesItsGroundForACameraThatStandsStillAndZooms) {
  const Stage stage;
  makeDetailed(*stage.terrain);
  stage.camera->position = SbVec3f(0.0F, 0.0F, 900.0F);
  stage.camera->heightAngle = 1.2F;
  OffscreenView view(240, 240);
  view.draw(stage.root, kMagenta);
  const Engine& engine = *stage.terrain->engine();
  fill(engine);
  view.draw(stage.root, kMagenta);
  for (int turn = 0; turn < 20; ++turn) processSensors();  // its timer rests
  const std::size_t wide = stage.terrain->scene()->triangles();
  stage.camera->heightAngle = 0.2F;
  view.draw(stage.root, kMagenta);
  fill(engine);
  EXPECT_NEAR(engine.options().view.detail->fieldOfView, 0.2, 1e-3);
  EXPECT_GT(stage.terrain->scene()->triangles(), 2 * wide);
  EXPECT_EQ(stage.terrain->scene(), engine.scene());
}

TEST(SoTerrain, GoesOnWhileNothingIsMissingUntilItKnowsHowWrongItsNodesAre) {
  const Stage stage;
  makeDetailed(*stage.terrain);
  OffscreenView view(64, 48);
  view.draw(stage.root, kMagenta);
  const Engine& engine = *stage.terrain->engine();
  fill(engine);
  EXPECT_GT(engine.world().nodeErrors().nextToCalibrate(), engine.world().topLevel());
  view.draw(stage.root, kMagenta);
  const auto last = engine.figures().lastUpdate;
  for (int turn = 0; turn < 50; ++turn) processSensors();
  EXPECT_EQ(engine.figures().lastUpdate, last) << "now there is nothing left to do";
}

TEST(SoTerrain, TellsItsEngineWhatItHoldsOnTheGraphicsCard) {
  const Stage stage;
  makeSmall(*stage.terrain);
  stage.terrain->settle();
  const std::size_t before = stage.terrain->engine()->figures().bytes;
  OffscreenView view(64, 48);
  stage.camera->position = SbVec3f(0.0F, 0.0F, 600.0F);  // Inventor's camera looks down by itself
  view.draw(stage.root, kMagenta);
  ASSERT_GT(stage.terrain->bufferBytes(), 0U);
  EXPECT_EQ(stage.terrain->engine()->figures().bytes, before + stage.terrain->bufferBytes());
}

}  // namespace
}  // namespace teren
