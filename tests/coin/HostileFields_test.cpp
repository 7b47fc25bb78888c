// What the fields of a SoTerrain are made to hold by files and programs that mean harm, or know no better:
// one sentence, and the landscape before goes on.
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <Inventor/SbTime.h>
#include <Inventor/SbVec3d.h>
#include <Inventor/SbViewportRegion.h>
#include <Inventor/SoDB.h>
#include <Inventor/SoInput.h>
#include <Inventor/actions/SoGetBoundingBoxAction.h>
#include <Inventor/errors/SoReadError.h>
#include <Inventor/nodes/SoPerspectiveCamera.h>
#include <Inventor/nodes/SoSeparator.h>
#include <QImage>
#include <gtest/gtest.h>

#include "teren/Engine.h"

#include "coin/SoTerrain.h"
#include "tests/coin/Complaints.h"
#include "tests/coin/OffscreenView.h"
#include "tests/coin/Stage.h"

namespace teren {
namespace {

constexpr std::size_t kMegabyte = std::size_t{1} << 20;

/// One line of readable text, of bounded length, that names the field.
void expectOneSentence(const std::string& sentence, const std::string& field) {
  EXPECT_NE(sentence.find(field), std::string::npos) << sentence.substr(0, 2000);
  EXPECT_LE(sentence.size(), 1400U) << sentence.substr(0, 2000);
  for (const char c : sentence) EXPECT_GE(static_cast<unsigned char>(c), 0x20) << sentence.substr(0, 2000);
}

/// A terrain that shows a small landscape, and what it showed.
struct Shown {
  explicit Shown(OffscreenView& window) : view(window) {
    makeSmall(*stage.terrain);
    stage.terrain->settle();
    stage.camera->position = SbVec3f(0.0F, 0.0F, 600.0F);
    before = stage.terrain->scene();
    engine = stage.terrain->engine();
    picture = view.picture(stage.root, kMagenta);
  }

  /// One sentence that names the field, once, and the same engine, scene and picture as before.
  void expectRefusal(const std::string& field, const std::function<void(SoTerrain&)>& change) {
    ASSERT_FALSE(before->meshes().empty());
    const Complaints complaints;
    change(*stage.terrain);
    expectOneSentence(stage.terrain->errorText().getString(), field);
    stage.terrain->settle();
    EXPECT_EQ(stage.terrain->scene(), before);
    EXPECT_EQ(stage.terrain->engine(), engine);
    EXPECT_EQ(view.picture(stage.root, kMagenta), picture);
    ASSERT_EQ(complaints.sentences.size(), 1U);
    EXPECT_NE(complaints.sentences[0].find(stage.terrain->errorText().getString()), std::string::npos)
        << complaints.sentences[0].substr(0, 2000);
  }

  Stage stage;
  OffscreenView& view;
  std::shared_ptr<const Scene> before;
  Engine* engine;
  QImage picture;
};

std::vector<std::string> hostileTexts() {
  return {std::string(kMegabyte, 'x'),
          std::string(kMegabyte, '7'),
          std::string(kMegabyte, '='),
          std::string(kMegabyte, '\n'),
          "nan",
          "-inf",
          "1e999",
          "0x10",
          " 1",
          "\xff\xfe\x01\x7f",
          "%s%n%n%n",
          "../../../etc/passwd"};
}

TEST(HostileField, OfTextIsRefusedWithOneSentenceAndTheLandscapeGoesOn) {
  OffscreenView view(64, 48);
  for (const std::string& text : hostileTexts()) {
    SCOPED_TRACE(text.substr(0, 40));
    Shown(view).expectRefusal("seed is", [&](SoTerrain& terrain) { terrain.seed = text.c_str(); });
    Shown(view).expectRefusal("generator: ", [&](SoTerrain& terrain) { terrain.generator = text.c_str(); });
    Shown(view).expectRefusal("", [&](SoTerrain& terrain) { terrain.world = text.c_str(); });
    Shown(view).expectRefusal("parameters: ", [&](SoTerrain& terrain) {
      terrain.generator = "fault";
      terrain.parameters = text.c_str();
    });
    Shown(view).expectRefusal("deviation", [&](SoTerrain& terrain) {
      terrain.generator = "fault";
      terrain.parameters = ("deviation=" + text).c_str();
    });
  }
}

TEST(HostileField, OfAHundredThousandParametersIsRefusedWithOneSentence) {
  OffscreenView view(64, 48);
  Shown(view).expectRefusal("faults", [](SoTerrain& terrain) {
    terrain.generator = "fault";
    terrain.parameters.enableNotify(FALSE);
    for (int n = 0; n < 100'000; ++n) terrain.parameters.set1Value(n, "faults=3");
    terrain.parameters.enableNotify(TRUE);
    terrain.parameters.touch();
  });
}

TEST(HostileField, OfNumbersIsRefusedWithOneSentenceAndTheValueBeforeHolds) {
  OffscreenView view(64, 48);
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double odd : {kNaN, kInfinity, -kInfinity, 1e300, -1e300}) {
    SCOPED_TRACE(odd);
    const auto narrow = static_cast<float>(odd);
    for (int axis = 0; axis < 3; ++axis) {
      SbVec3d origin(0.0, 0.0, 0.0);
      origin[axis] = odd;
      Shown(view).expectRefusal("origin is", [&](SoTerrain& terrain) { terrain.origin = origin; });
      SbColor haze(0.5F, 0.5F, 0.5F);
      haze[axis] = narrow;
      Shown(view).expectRefusal("hazeColor is", [&](SoTerrain& terrain) { terrain.hazeColor = haze; });
    }
    Shown(view).expectRefusal("viewDistance is", [&](SoTerrain& terrain) { terrain.viewDistance = narrow; });
    Shown(view).expectRefusal("pixelError is", [&](SoTerrain& terrain) { terrain.pixelError = narrow; });
    Shown(view).expectRefusal("frameBudget is",
                              [&](SoTerrain& terrain) { terrain.frameBudget = SbTime(odd); });
  }
  for (const float odd : {0.0F, -0.0F, -1.0F, 1e30F}) {
    Shown(view).expectRefusal("viewDistance is", [&](SoTerrain& terrain) { terrain.viewDistance = odd; });
  }
  for (const double odd : {-1e-9, 1.001, 1e9}) {
    Shown(view).expectRefusal("frameBudget is",
                              [&](SoTerrain& terrain) { terrain.frameBudget = SbTime(odd); });
  }
  for (const int odd : {-1, 99, std::numeric_limits<int>::max(), std::numeric_limits<int>::min()}) {
    Shown(view).expectRefusal("viewLevel is", [&](SoTerrain& terrain) { terrain.viewLevel = odd; });
  }
}

TEST(HostileField, OfAWaterLevelThatIsNoNumberMeansADryWorld) {
  OffscreenView view(64, 48);
  Shown dry(view);
  dry.stage.terrain->waterLevel = -2e6F;
  const QImage picture = dry.view.picture(dry.stage.root, kMagenta);
  for (const float odd : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                          -std::numeric_limits<float>::infinity(), std::numeric_limits<float>::lowest()}) {
    dry.stage.terrain->waterLevel = odd;
    EXPECT_EQ(dry.view.picture(dry.stage.root, kMagenta), picture) << odd;
    EXPECT_STREQ(dry.stage.terrain->errorText().getString(), "");
  }
}

TEST(HostileField, LetsAnErrorGoWhenItsValueIsGoodAgain) {
  OffscreenView view(64, 48);
  Shown shown(view);
  const Complaints complaints;
  SoTerrain& terrain = *shown.stage.terrain;
  terrain.frameBudget = SbTime(2.0);
  terrain.hazeColor = SbColor(2.0F, 0.0F, 0.0F);
  terrain.frameBudget = SbTime(0.5);
  expectOneSentence(terrain.errorText().getString(), "hazeColor");
  terrain.hazeColor = SbColor(1.0F, 0.0F, 0.0F);
  EXPECT_STREQ(terrain.errorText().getString(), "");
  EXPECT_EQ(complaints.sentences.size(), 2U);
}

TEST(HostileField, FarFromEverythingIsStillPlacedInFiniteNumbers) {
  OffscreenView view(64, 48);
  for (const double far : {1e30, -1e30, 1e18}) {
    const Shown shown(view);
    shown.stage.terrain->origin = SbVec3d(far, -far, far);
    EXPECT_STREQ(shown.stage.terrain->errorText().getString(), "");
    SoGetBoundingBoxAction action(SbViewportRegion(64, 64));
    action.apply(shown.stage.root);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_TRUE(std::isfinite(action.getBoundingBox().getMin()[axis])) << far;
      EXPECT_TRUE(std::isfinite(action.getBoundingBox().getMax()[axis])) << far;
    }
  }
}

TEST(HostileField, IsAsHarmlessUnderACameraThatIsNowhere) {
  OffscreenView view(64, 48);
  for (const float odd :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 1e38F}) {
    Shown shown(view);
    shown.stage.camera->position = SbVec3f(odd, -odd, odd);
    shown.view.draw(shown.stage.root, kMagenta);
    shown.stage.camera->position = SbVec3f(0.0F, 0.0F, 600.0F);
    EXPECT_EQ(shown.view.picture(shown.stage.root, kMagenta), shown.picture) << odd;
  }
}

/// Counts what Inventor says about what it reads.
class ReadErrors {
 public:
  ReadErrors() { SoReadError::setHandlerCallback(hear, this); }
  ~ReadErrors() { SoReadError::setHandlerCallback(SoReadError::getHandlerCallback(), nullptr); }
  ReadErrors(const ReadErrors&) = delete;
  ReadErrors& operator=(const ReadErrors&) = delete;
  int count = 0;

 private:
  static void hear(const SoError* /*error*/, void* self) { ++static_cast<ReadErrors*>(self)->count; }
};

TEST(HostileField, OfAnotherTypeInAFileIsRefusedByInventorAndTheLandscapeGoesOn) {
  OffscreenView view(64, 48);
  const Shown shown(view);
  for (const std::string field : {"viewDistance \"abc\"", "viewDistance nan", "viewLevel TRUE", "origin 1 2",
                                  "origin 1 2 inf", "hazeColor 1 2", "frameBudget soon", "nosuchfield 3",
                                  "parameters [ \"a\" ", "seed \"", "waterLevel []"}) {
    SCOPED_TRACE(field);
    const ReadErrors errors;
    const std::string text = "#Inventor V2.1 ascii\nSoTerrain { " + field + " }\n";
    SoInput input;
    input.setBuffer(text.data(), text.size());
    SoSeparator* root = SoDB::readAll(&input);
    EXPECT_EQ(root, nullptr);
    EXPECT_GE(errors.count, 1);
    EXPECT_EQ(shown.stage.terrain->scene(), shown.before);
  }
}

TEST(HostileField, OfAMegabyteInAFileIsReadAndRefusedWithOneSentence) {
  for (const std::string field : {"seed", "generator", "world", "parameters"}) {
    SCOPED_TRACE(field);
    const Complaints complaints;
    SoNode* root = readScene("#Inventor V2.1 ascii\nSoTerrain { " + field + " \"" +
                             std::string(kMegabyte, 'x') + "\" }\n");
    auto* terrain = static_cast<SoTerrain*>(static_cast<SoSeparator*>(root)->getChild(0));
    expectOneSentence(terrain->errorText().getString(), field == "world" ? "is not a file" : field);
    EXPECT_EQ(terrain->engine(), nullptr);
    EXPECT_EQ(complaints.sentences.size(), 1U);
    terrain->set((field + (field == "parameters" ? " []" : " \"\"")).c_str());
    EXPECT_STREQ(terrain->errorText().getString(), "");
    EXPECT_NE(terrain->engine(), nullptr);
    root->unref();
  }
}

}  // namespace
}  // namespace teren
