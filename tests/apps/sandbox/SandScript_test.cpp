#include "apps/sandbox/SandScript.h"

#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Hash.h"

namespace teren {
namespace {

namespace fs = std::filesystem;

constexpr const char* kGood = R"(# every command there is
sand 5000 size=2 depth=0.5 roughness=0.1 seed=7
sand vertices=4000
sand
tool round size=0.1 depth=0.02 corners=5
tool polygon outline="0.5,0 -0.5,0.4 -0.5,-0.4" size=0.3
tool rake teeth=3
repose 33.5
moisture .25
slides off
slides on
	stamp 0.5 0.5	# a tab before, a comment behind
stamp 0.5 0.5 -0.01
drag 0.2 0.2 to 0.8 0.8
drag 0.2 0.2 0 to 0.8 0.8 -0.1 to 0.8 0.2 0 speed=2
settle
settle 500
beats 12
undo
redo
save "a file.sand"
load a.sand
export a.obj
wireframe on
camera turn=20 tilt=60 distance=1.5 x=0.1 y=-.1 z=0.05
camera
screenshot a.png
hash
counts
quit
)";

/// The one sentence that refuses a script; empty where it is not refused.
std::string refusal(const std::string& text) {
  const Result<SandScript> script = SandScript::fromText(text, "test.txt");
  return script ? std::string() : script.error().message;
}

TEST(SandScript, ReadsEveryCommand) {
  const Result<SandScript> script = SandScript::fromText(kGood, "test.txt");
  ASSERT_TRUE(script) << script.error().message;
  const auto commands = script->commands();
  ASSERT_EQ(commands.size(), 29U);
  EXPECT_EQ(commands[0].line, 2);
  const auto& sand = std::get<NewSand>(commands[0].what).ground;
  EXPECT_EQ(sand.vertices, 5000);
  EXPECT_EQ(sand.side, 2.0);
  EXPECT_EQ(sand.depth, 0.5);
  EXPECT_EQ(sand.roughness, 0.1);
  EXPECT_EQ(sand.seed, 7U);
  EXPECT_EQ(std::get<NewSand>(commands[1].what).ground.vertices, 4000);
  EXPECT_EQ(std::get<TakeTool>(commands[3].what).values.integer("corners"), 5);
  EXPECT_EQ(std::get<TakeTool>(commands[4].what).values.choice("tool"), "polygon");
  EXPECT_EQ(std::get<SetRepose>(commands[6].what).angle, 33.5);
  EXPECT_EQ(std::get<SetMoisture>(commands[7].what).moisture, 0.25);
  EXPECT_FALSE(std::get<SetSlides>(commands[8].what).on);
  EXPECT_FALSE(std::get<Stroke>(commands[10].what).places[0].height);
  EXPECT_EQ(std::get<Stroke>(commands[11].what).places[0].height, -0.01);
  EXPECT_EQ(std::get<Stroke>(commands[12].what).places.size(), 2U);
  const auto& stroke = std::get<Stroke>(commands[13].what);
  EXPECT_EQ(stroke.places.size(), 3U);
  EXPECT_EQ(stroke.places[1].height, -0.1);
  EXPECT_EQ(stroke.speed, 2.0);
  EXPECT_TRUE(std::get<RunBeats>(commands[14].what).mustRest);
  EXPECT_EQ(std::get<RunBeats>(commands[15].what).most, 500U);
  EXPECT_FALSE(std::get<RunBeats>(commands[16].what).mustRest);
  EXPECT_EQ(std::get<UseFile>(commands[19].what).file, "a file.sand");
  EXPECT_TRUE(std::get<SetWireframe>(commands[22].what).on);
  EXPECT_EQ(std::get<SetCamera>(commands[23].what).values.real("y"), -0.1);
  EXPECT_TRUE(script->needsPicture());
  EXPECT_EQ(std::get<Deed>(commands[28].what), Deed::quit);
}

TEST(SandScript, ReadsTheExamplesThatComeWithTheProgram) {
  int examples = 0;
  for (const auto& entry : fs::directory_iterator(TEREN_SANDBOX_EXAMPLES)) {
    const Result<SandScript> script = SandScript::fromFile(entry.path().string());
    EXPECT_TRUE(script) << script.error().message;
    ++examples;
  }
  EXPECT_GT(examples, 0);
}

TEST(SandScript, NeedsNoPictureWhereItMakesNone) {
  EXPECT_FALSE(
      SandScript::fromText("stamp 0.5 0.5\nwireframe on\ncamera tilt=20\nhash\n", "a")->needsPicture());
}

TEST(SandScript, MayBeEmptyAndEndWithoutALineBreakOrWithThoseOfOtherSystems) {
  EXPECT_EQ(SandScript::fromText("", "a")->commands().size(), 0U);
  EXPECT_EQ(SandScript::fromText("# nothing\n\n  \n", "a")->commands().size(), 0U);
  EXPECT_EQ(SandScript::fromText("undo\r\nredo", "a")->commands().size(), 2U);
}

TEST(SandScript, ExplainsEveryCommandThatItKnows) {
  const std::string help = "\n" + SandScript::help();
  const std::string unknown = refusal("nothing");
  for (const char* name : {"sand",      "tool",   "repose",     "moisture", "slides", "stamp", "drag",
                           "settle",    "beats",  "undo",       "redo",     "save",   "load",  "export",
                           "wireframe", "camera", "screenshot", "hash",     "counts", "quit"}) {
    EXPECT_NE(help.find("\n  " + std::string(name)), std::string::npos) << name;
    EXPECT_NE(unknown.find(name), std::string::npos) << name;
  }
}

/// A bad line and a word of the sentence that refuses it.
struct BadLine {
  const char* line;
  const char* why;
};

TEST(SandScript, RefusesWhatIsNoCommandInOneSentenceWithItsLine) {
  const BadLine bad[] = {
      {"dig 1 2", "is no command"},
      {"STAMP 0.5 0.5", "is no command"},
      {"=", "is no command"},
      {"\"\"", "is no command"},
      {"stamp", "expected X Y or X Y Z"},
      {"stamp 0.5", "expected X Y or X Y Z"},
      {"stamp 0.5 0.5 0 0", "expected X Y or X Y Z"},
      {"stamp nan 0.5", "X is \"nan\""},
      {"stamp 0.5 inf", "Y is \"inf\""},
      {"stamp -inf 0.5", "X is \"-inf\""},
      {"stamp 0.5 0.5 nan", "Z is \"nan\""},
      {"stamp 1e999 0.5", "X is \"1e999\""},
      {"stamp 1e308 0.5", "X is \"1e308\""},
      {"stamp -0.5 0.5", "X is \"-0.5\""},
      {"stamp 0,5 0,5", "X is \"0,5\""},
      {"stamp 0x10 0.5", "X is \"0x10\""},
      {"stamp 0.5 0.5 1e300", "Z is \"1e300\""},
      {"drag", "drag has a place of 0 numbers"},
      {"drag 0.5 0.5", "one place"},
      {"drag 0.5 0.5 to", "place of 0 numbers"},
      {"drag to 0.5 0.5", "place of 0 numbers"},
      {"drag 0.1 0.1 to 0.5 0.5 -0.1", "one at each or at none"},
      {"drag 0.1 0.1 to 0.5 0.5 speed=nan", "speed is \"nan\""},
      {"drag 0.1 0.1 to 0.5 0.5 speed=", "speed is \"\""},
      {"drag 0.1 0.1 to 0.5 0.5 speed=-1", "speed is \"-1\""},
      {"drag 0.1 0.1 to 0.5 0.5 speed=1e9", "speed is \"1e9\""},
      {"drag 0.1 0.1 speed=1 to 0.5 0.5", "Z is \"speed=1\""},
      {"sand 3", "vertices is \"3\""},
      {"sand -1", "vertices is \"-1\""},
      {"sand 1e9", "vertices is \"1e9\""},
      {"sand 99999999999999999999", "vertices is"},
      {"sand 100 size=0", "size"},
      {"sand 100 size=nan", "size"},
      {"sand 100 size=1e300", "size"},
      {"sand 100 depth=-1", "depth"},
      {"sand 100 roughness=inf", "roughness"},
      {"sand 100 vertices=100", "vertices"},
      {"sand 100 colour=red", "colour"},
      {"sand 100 size", "size"},
      {"tool", "names no tool"},
      {"tool spoon", "spoon"},
      {"tool round size=0", "size"},
      {"tool round size=nan", "size"},
      {"tool round depth=-1", "depth"},
      {"tool round depth=inf", "depth"},
      {"tool round corners=2", "corners"},
      {"tool round corners=1e6", "corners"},
      {"tool rake teeth=0", "teeth"},
      {"tool rake teeth=33", "teeth"},
      {"tool ball size=0.1 depth=0.06", "ball"},
      {"tool polygon outline=\"\"", "3 to 256 points"},
      {"tool polygon outline=\"0,0 1,1\"", "3 to 256 points"},
      {"tool polygon outline=\"0,0 1,1 1,0 0,1\"", "cross"},
      {"tool polygon outline=\"0,0 1,0 1,0 0,1\"", "touch itself"},
      {"tool polygon outline=\"0,0 1,0 2,0\"", ""},
      {"tool polygon outline=\"0,0 1,nan 0,1\"", "expected"},
      {"tool polygon outline=\"0,0 1,1e999 0,1\"", "expected"},
      {"tool polygon outline=\"0,0 1e300,0 0,1e300\"", "numbers between"},
      {"tool polygon outline=\"0;0 1;1 0;1\"", "expected"},
      {"tool polygon file=/no/such/outline", "\"/no/such/outline\""},
      {"tool polygon file=/dev/zero", "\"/dev/zero\""},
      {"tool polygon file=/", "\"/\""},
      {"tool polygon file=", "\"\""},
      {"repose", "expected one number from 1 to 60"},
      {"repose 30 40", "expected one number"},
      {"repose 0", "repose is \"0\""},
      {"repose 91", "repose is \"91\""},
      {"repose nan", "repose is \"nan\""},
      {"moisture 2", "moisture is \"2\""},
      {"moisture -inf", "moisture is \"-inf\""},
      {"slides", "on or off"},
      {"slides maybe", "on or off"},
      {"slides on off", "on or off"},
      {"wireframe 1", "on or off"},
      {"settle -1", "settle is \"-1\""},
      {"settle 1e3", "settle is \"1e3\""},
      {"settle 1 2", "one number of beats"},
      {"beats", "one number of beats"},
      {"beats 18446744073709551616", "beats is"},
      {"undo 3", "takes nothing"},
      {"hash a.txt", "takes nothing"},
      {"save", "one file was expected"},
      {"save a b", "one file was expected"},
      {"save \"\"", "one file was expected"},
      {"save \"a", "not closed"},
      {"screenshot", "one file was expected"},
      {"camera tilt=0", "tilt"},
      {"camera tilt=nan", "tilt"},
      {"camera distance=-1", "distance"},
      {"camera up=1", "up"},
      {"stamp 0.5 0.5\x01", "control character"},
      {"\x1b[31mstamp 0.5 0.5", "control character"},
      {"\xff\xfe s t a m p", "is no command"},
  };
  for (const BadLine& one : bad) {
    const std::string sentence = refusal("# a comment\nundo\n" + std::string(one.line) + "\nredo\n");
    EXPECT_TRUE(sentence.starts_with("test.txt, line 3: ")) << one.line << ": " << sentence;
    EXPECT_NE(sentence.find(one.why), std::string::npos) << one.line << ": " << sentence;
    EXPECT_EQ(sentence.find_first_of("\n\r\x1b"), std::string::npos) << sentence;
    EXPECT_LT(sentence.size(), 500U) << sentence;
  }
}

TEST(SandScript, RefusesLinesAndScriptsWithoutAnEnd) {
  EXPECT_NE(refusal("undo\n" + std::string(20'000, 'a')).find("line 2: the line is longer"),
            std::string::npos);
  EXPECT_NE(refusal("stamp" + std::string(20'000, ' ') + "0.5 0.5").find("longer"), std::string::npos);
  std::string endless;
  for (int n = 0; n < 100'001; ++n) endless += "undo\n";
  EXPECT_NE(refusal(endless).find("line 100001: there are more than 100000 commands"), std::string::npos);
  std::string points = "tool polygon outline=\"";
  for (int n = 0; n < 257; ++n) points += "0.1,0.1 ";
  EXPECT_NE(refusal(points + "\"").find("more than 256 points"), std::string::npos);
  EXPECT_NE(refusal(std::string("undo\n\0undo", 10)).find("line 2: there is a control character"),
            std::string::npos);
}

TEST(SandScript, IsReadOfFilesOnlyAndOfSmallOnes) {
  const fs::path folder = fs::temp_directory_path() / ("teren-script-test-" + std::to_string(getpid()));
  fs::create_directories(folder);
  const fs::path large = folder / "large", good = folder / "good script";
  std::ofstream(large) << std::string((std::size_t{4} << 20) + 1, '\n');
  std::ofstream(good) << kGood;
  EXPECT_TRUE(SandScript::fromFile(good));
  for (const std::string& bad :
       {large.string(), folder.string(), (folder / "missing").string(), std::string("/dev/zero"),
        std::string(), good.string() + std::string(1, '\0'), std::string(10'000, 'a')}) {
    const Result<SandScript> script = SandScript::fromFile(bad);
    ASSERT_FALSE(script) << bad;
    EXPECT_EQ(script.error().message.find('\n'), std::string::npos);
    EXPECT_NE(script.error().message.find("expected a script"), std::string::npos) << script.error().message;
  }
  fs::remove_all(folder);
}

TEST(SandScript, RefusesOutlinesThatAreLongerAltogetherThanAScriptMayBe) {
  const fs::path file = fs::temp_directory_path() / ("teren-long-outline-" + std::to_string(getpid()));
  std::ofstream(file) << "0,0 0.5,0 0.25" << std::string(60'000, '0') << ",0.5\n";
  const std::string line = "tool polygon file=\"" + file.string() + "\"\n";
  std::string text;
  for (int n = 0; n < 69; ++n) text += line;
  EXPECT_EQ(refusal(text), "");
  for (int n = 69; n < 75; ++n) text += line;
  EXPECT_NE(refusal(text).find("line 70: the outlines"), std::string::npos) << refusal(text);
  fs::remove(file);
}

TEST(SandScript, TakesATextOrRefusesItInOneSentenceWhateverItsDamage) {
  const std::string good = kGood;
  RandomSequence random(71);
  int refused = 0;
  for (int n = 0; n < 20'000; ++n) {
    std::string damaged = good;
    for (std::uint64_t k = 1 + random.next() % 4; k > 0; --k) {
      const std::size_t at = random.next() % damaged.size();
      switch (random.next() % 4) {
        case 0:
          damaged[at] = static_cast<char>(random.next());
          break;
        case 1:
          damaged.erase(at, 1 + random.next() % 20);
          break;
        case 2:
          damaged.insert(at, damaged.substr(random.next() % damaged.size(), random.next() % 40));
          break;
        default:
          damaged.insert(at, std::string(1 + random.next() % 30, "9e-.#\"=, "[random.next() % 9]));
      }
    }
    const std::string sentence = refusal(damaged);
    refused += sentence.empty() ? 0 : 1;
    ASSERT_EQ(sentence.find_first_of("\n\r"), std::string::npos) << sentence;
  }
  EXPECT_GT(refused, 5'000);
  EXPECT_LT(refused, 20'000);
}

}  // namespace
}  // namespace teren
