// Plugins that pass every check and then fail at work: the program ends with 1 and leaves nothing half true;
// the engine goes on with the layer's mean. That each way of failing turns one base map into the mean is
// tested where maps are made: tests/engine/world/BaseMap_test.cpp.
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Engine.h"

#include "tests/doors/Refusal.h"
#include "tests/doors/Registry.h"

namespace teren {
namespace {

struct Misbehaviour {
  std::string work;
  Needles needles;
};

std::vector<Misbehaviour> misbehaviours() {
  return {{"nan", {"wrote the height nan m", "-1 to 1 m"}},
          {"infinite", {"wrote the height inf m", "-1 to 1 m"}},
          {"above", {"wrote the height 1.5 m", "-1 to 1 m"}},
          {"below", {"m, outside the promised range of -1 to 1 m"}},
          {"throws", {"threw \"no?luck\""}},
          {"throws-int", {"no std::exception"}},
          {"throws-null", {"without a text"}},
          {"begin-throws", {"threw \"no?ground\""}},
          {"begin-nothing", {"began no task"}},
          {"late", {"threw \"tired\""}},
          {"endless", {"is not done after"}}};
}

TEST(Misbehaviour, FailsBakeAndQueryWithOneSentenceAndNoFile) {
  for (const Misbehaviour& wrong : misbehaviours()) {
    Needles needles = wrong.needles;
    needles.insert(needles.end(), {"layer \"hostile\"", "plugin \"hostile\"", "lattice point (0, 0)"});
    const Arguments world = {"--generator", "hostile", "--set", "work=" + wrong.work};
    Arguments bake = {"bake", "--patches", "0", "0", "3", "3", "-o", "never.r32"};
    bake.insert(bake.end(), world.begin(), world.end());
    Needles named = needles;
    named.push_back("\"never.r32\" was not written");
    expectRefused(bake, 1, named);
    bake.insert(bake.end(), {"--workers", "3"});
    expectRefused(bake, 1, wrong.needles);
    for (const Arguments& json : {Arguments(), Arguments{"--json"}}) {
      Arguments query = {"query", "1", "2", "-3", "4"};
      query.insert(query.end(), world.begin(), world.end());
      query.insert(query.end(), json.begin(), json.end());
      expectRefused(query, 1, needles);
    }
  }
}

TEST(Misbehaviour, KeepsTheOldFile) {
  const ScratchFolder folder;
  folder.write("a.r32", "old");
  expectRefused({"bake", "--generator", "hostile", "--patches", "0", "0", "1", "1", "-o", folder / "a.r32"},
                1, {"a.r32"});
  EXPECT_EQ(namesIn(folder.path()), std::vector<std::string>{"a.r32"});
  EXPECT_EQ(fileBytes(folder / "a.r32"), "old");
}

Arguments slowBake(const std::string& file) {
  return {"bake", "--generator", "hostile", "--set",      "work=slow", "--patches", "0",
          "0",    "1",           "1",       "--slice-us", "20",        "-o",        file};
}

TEST(Misbehaviour, ThatIsOnlySlowIsNamedBesideTheWholeFile) {
  const ScratchFolder folder;
  const Answer answer = Program(slowBake(folder / "a.r32"), withHostileModules()).finish();
  EXPECT_EQ(answer.exitCode, 0);
  EXPECT_TRUE(isOneSentence(answer.complaint)) << answer.complaint;
  for (const char* needle : {"layer \"hostile\"", "plugin \"hostile\"", "ms of processor time", "given"})
    EXPECT_NE(answer.complaint.find(needle), std::string::npos) << answer.complaint;
  EXPECT_EQ(fileBytes(folder / "a.r32"), std::string(33 * 33 * 4, '\0'));
}

TEST(ClosedStream, IsNotMistakenForTheFile) {
  // A file opened first would get the number of a closed stream, and what is said would be written into it.
  for (const std::vector<int>& closed : {std::vector{2}, std::vector{1, 2}, std::vector{0, 1, 2}}) {
    const ScratchFolder folder;
    Program::Settings settings = withHostileModules();
    settings.closed = closed;
    const Answer answer = Program(slowBake(folder / "a.r32"), settings).finish();
    EXPECT_EQ(answer.exitCode, closed.size() == 1 ? 0 : 1) << "without standard output there is no answer";
    EXPECT_EQ(fileBytes(folder / "a.r32"), std::string(33 * 33 * 4, '\0'));
  }
}

TEST(Misbehaviour, OfOneLayerLeavesTheEngineTheOthersAndOneSentence) {
  for (const Misbehaviour& wrong : misbehaviours()) {
    SCOPED_TRACE(wrong.work);
    WorldDescription description;
    description.samples = 9;
    LayerDescription sound, hostile;
    sound.generator = "fault";
    sound.samples = 9;
    hostile.generator = "hostile";
    hostile.samples = 3;
    hostile.parameters = {{"work", wrong.work}};
    description.layers = {sound, hostile};
    const auto world = World::create(description, registryOfAllModules());
    ASSERT_TRUE(world.ok()) << world.error().message;
    auto engine = Engine::create(*world, {.view = {0, 1}});
    ASSERT_TRUE(engine.ok());
    (*engine)->add(std::make_unique<Resting>(Motion{{5, 5, 0.5, 0.5}}));
    (*engine)->settle();
    EXPECT_EQ((*engine)->figures().pending, 0U);
    EXPECT_EQ((*engine)->figures().nodes, 9U);
    const std::vector<std::string> said = (*world)->takeMessages();
    ASSERT_EQ(said.size(), 1U);
    expectOneSentence(said[0], wrong.needles);
    description.layers = {sound};
    const auto alone = World::create(description, registryOfAllModules());
    const Position place{5, 5, 0.5, 0.5};
    EXPECT_EQ((*engine)->drawnHeight(place), static_cast<float>((*alone)->height(place)));
  }
}

}  // namespace
}  // namespace teren
