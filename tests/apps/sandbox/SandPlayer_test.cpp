#include "apps/sandbox/SandPlayer.h"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <unistd.h>
#include <vector>

#include <gtest/gtest.h>

namespace teren {
namespace {

namespace fs = std::filesystem;

/// What a script came to.
struct Played {
  std::string error, output;
  ExitCode failure = kSuccess;
  bool over = false;
  std::uint64_t hash = 0;
};

/// Notes what it is asked for.
class NotedStage final : public SandStage {
 public:
  void setWireframe(bool on) override { asked.push_back(on ? "wire" : "surface"); }
  void setCamera(const Values& values) override {
    asked.push_back("tilt " + numberText(values.real("tilt")));
  }
  Result<void> screenshot(const std::string& file) override {
    asked.push_back(file);
    return {};
  }
  std::vector<std::string> asked;
};

/// Plays a script on 500 vertices, in pieces of so many slices; 0: whole.
Played play(const std::string& text, int slices = 0, SandStage* stage = nullptr) {
  const Result<SandScript> script = SandScript::fromText(text, "test.txt");
  EXPECT_TRUE(script) << script.error().message;
  SandGround ground;
  ground.vertices = 500;
  SandSession session(ground);
  std::ostringstream output;
  SandPlayer player(*script, session, stage, output);
  Played played;
  for (int pieces = 0; pieces < 1'000'000; ++pieces) {
    const Result<bool> over =
        player.play([&, count = 0]() mutable { return slices > 0 && ++count % slices == 0; });
    if (!over) {
      played.error = over.error().message;
      played.failure = player.failure();
    }
    played.over = !over || *over;
    if (played.over) break;
  }
  played.output = output.str();
  played.hash = hashOf(session.sandbox().surface());
  return played;
}

class SandPlayerFiles : public testing::Test {
 protected:
  SandPlayerFiles() { fs::create_directories(folder_); }
  ~SandPlayerFiles() override { fs::remove_all(folder_); }
  std::string file(const char* name) const { return "\"" + (folder_ / name).string() + "\""; }

  const fs::path folder_ = fs::temp_directory_path() / ("teren-player-test-" + std::to_string(getpid()));
};

constexpr const char* kLong = R"(sand 800 roughness=0.2
tool round size=0.1 depth=0.05
drag 0.2 0.2 to 0.6 0.6 speed=1
beats 3
tool rake size=0.2 depth=0.02
drag 0.2 0.7 to 0.5 0.4 speed=1
undo
redo
repose 29
beats 8
hash
stamp 0.5 0.5
hash
undo
hash
)";

TEST(SandPlayer, MakesTheSameOfAScriptHoweverItIsSliced) {
  const Played whole = play(kLong);
  EXPECT_EQ(whole.error, "");
  EXPECT_EQ(std::count(whole.output.begin(), whole.output.end(), '\n'), 3);
  for (const int slices : {1, 3}) {
    const Played sliced = play(kLong, slices);
    EXPECT_EQ(sliced.output, whole.output) << slices;
    EXPECT_EQ(sliced.hash, whole.hash) << slices;
  }
}

TEST(SandPlayer, ComputesNothingBetweenCommands) {
  const std::string steep = "tool round size=0.1 depth=0.2\nstamp 0.5 0.5\n";
  EXPECT_EQ(play(steep + "beats 0\n").hash, play(steep).hash);
  EXPECT_NE(play(steep + "beats 1\n").hash, play(steep).hash);
  EXPECT_EQ(play(steep + "beats 1\nbeats 1\n").hash, play(steep + "beats 2\n").hash);
  EXPECT_EQ(play(steep + "settle\nbeats 5\n").hash, play(steep + "settle\n").hash);
}

TEST(SandPlayer, PrintsHashAndCounts) {
  const Played played = play("hash\ncounts\n");
  EXPECT_TRUE(played.output.starts_with("hash ")) << played.output;
  EXPECT_EQ(played.output.find("\nvertices 500 triangles "), 21U) << played.output;
  EXPECT_NE(played.output.find(" constrained 0\n"), std::string::npos);
}

TEST(SandPlayer, UndoOfAllLeadsBackToTheBeginning) {
  const Played played = play("hash\nstamp 0.5 0.5\ndrag 0.2 0.2 to 0.4 0.4\nsettle\nundo\nundo\nhash\n");
  EXPECT_EQ(played.output.substr(0, 22), played.output.substr(22));
}

TEST(SandPlayer, StopsAtAFailureAndNamesItsLine) {
  struct Case {
    const char* script;
    const char* why;
    ExitCode code;
  };
  for (const Case& one : {
           Case{"undo\n", "line 1: there is nothing to take back", kWrongInput},
           Case{"stamp 0.5 0.5\nredo\n", "line 2: there is nothing to do again", kWrongInput},
           Case{"stamp 0.01 0.5\n\nstamp 1.01 0.5\n", "line 3: the tool at (1.01, 0.5) lies beyond",
                kWrongInput},
           Case{"drag 0.5 0.5 to 2 0.5\n", "line 1: the tool at (2, 0.5) lies beyond", kWrongInput},
           Case{"tool square size=5\nstamp 0.5 0.5\n", "line 2: the tool reaches", kWrongInput},
           Case{"load /no/such/sand\n", "line 1: ", kWrongInput},
           Case{"load /\n", "line 1: ", kWrongInput},
           Case{"save /no/such/folder/sand\n", "line 1: ", kWorkFailed},
           Case{"export /no/such/folder/a.obj\n", "line 1: ", kWorkFailed},
           Case{"screenshot a.png\n", "line 1: a screenshot takes a window", kWorkFailed},
           Case{"tool round size=0.3 depth=0.3\nstamp 0.5 0.5\nsettle 0\n", "line 3: the sand is not at rest",
                kWorkFailed},
       }) {
    const Played played = play(std::string(one.script) + "hash\n");
    EXPECT_NE(played.error.find(one.why), std::string::npos) << one.script << played.error;
    EXPECT_TRUE(played.error.starts_with("test.txt, line ")) << played.error;
    EXPECT_EQ(played.error.find('\n'), std::string::npos) << played.error;
    EXPECT_EQ(played.failure, one.code) << one.script;
    EXPECT_EQ(played.output, "") << "nothing after the failure";
  }
}

TEST(SandPlayer, QuitEndsTheScript) {
  const Played played = play("hash\nquit\nhash\n");
  EXPECT_TRUE(played.over);
  EXPECT_EQ(played.output.size(), 22U);
}

TEST(SandPlayer, GivesTheStageItsPart) {
  NotedStage stage;
  EXPECT_EQ(play("wireframe on\ncamera tilt=70\nscreenshot a.png\nwireframe off\n", 0, &stage).error, "");
  EXPECT_EQ(stage.asked, (std::vector<std::string>{"wire", "tilt 70", "a.png", "surface"}));
}

TEST_F(SandPlayerFiles, GoOnAfterLoadingAsIfNothingHadHappened) {
  const std::string begin = "tool round size=0.1 depth=0.1\ndrag 0.2 0.2 to 0.4 0.4\n";
  const std::string end = "tool wedge size=0.1 depth=0.03\ndrag 0.6 0.2 to 0.4 0.4\nbeats 20\nhash\n";
  const Played straight = play(begin + end);
  const Played detour =
      play(begin + "save " + file("a b.sand") + "\nsand 500\nload " + file("a b.sand") + "\n" + end, 1);
  EXPECT_EQ(detour.error, "");
  EXPECT_EQ(detour.output, straight.output);
}

TEST_F(SandPlayerFiles, ExportEveryTriangle) {
  const Played played = play("stamp 0.5 0.5\ncounts\nexport " + file("a.obj") + "\n");
  EXPECT_EQ(played.error, "");
  std::ifstream lines(folder_ / "a.obj");
  std::size_t vertices = 0, faces = 0;
  for (std::string line; std::getline(lines, line);) {
    vertices += line.starts_with("v ") ? 1 : 0;
    faces += line.starts_with("f ") ? 1 : 0;
  }
  EXPECT_TRUE(played.output.starts_with("vertices " + std::to_string(vertices) + " triangles " +
                                        std::to_string(faces)))
      << played.output;
}

TEST_F(SandPlayerFiles, OfToolsAreReadWithComments) {
  std::ofstream(folder_ / "arrow") << "# an arrow\n0.5,0\n-0.5,0.4 # its barb\n-0.2,0 -0.5,-0.4\n";
  const Played fromFile = play("tool polygon size=0.2 file=" + file("arrow") + "\nstamp 0.5 0.5\n");
  const Played fromLine =
      play("tool polygon size=0.2 outline=\"0.5,0 -0.5,0.4 -0.2,0 -0.5,-0.4\"\nstamp 0.5 0.5\n");
  EXPECT_EQ(fromFile.error, "");
  EXPECT_EQ(fromFile.hash, fromLine.hash);
}

TEST_F(SandPlayerFiles, ThatAreNoSandAreRefusedAndThePresentSandStays) {
  std::ofstream(folder_ / "garbage") << std::string(5'000, '\x7f');
  std::ofstream(folder_ / "empty");
  std::ofstream(folder_ / "script") << "stamp 0.5 0.5\n";
  const std::uint64_t before = play("stamp 0.5 0.5\n").hash;
  for (const char* name : {"garbage", "empty", "script"}) {
    const Played played = play("stamp 0.5 0.5\nload " + file(name) + "\n");
    EXPECT_TRUE(played.error.starts_with("test.txt, line 2: ")) << played.error;
    EXPECT_NE(played.error.find(name), std::string::npos) << played.error;
    EXPECT_EQ(played.error.find('\n'), std::string::npos);
    EXPECT_EQ(played.hash, before);
  }
}

}  // namespace
}  // namespace teren
