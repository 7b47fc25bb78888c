// `teren check`: what it prints, with what it ends, and that no module can crash it, hold it up or outlive
// it.
#include <algorithm>
#include <csignal>
#include <sstream>
#include <string>
#include <unistd.h>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/apps/teren/Program.h"

namespace teren {
namespace {

using Json = nlohmann::json;

std::string module(const std::string& id) {
  return std::string(TEREN_TEST_CHECK_MODULES "/teren-") + id + ".so";
}

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// The line of the table that begins with this verdict and name.
std::string line(const Answer& answer, const std::string& verdict, const std::string& name) {
  std::istringstream lines(answer.output);
  for (std::string text; std::getline(lines, text);) {
    if (text.starts_with(verdict + "  " + name + " ")) return text;
  }
  return {};
}

std::size_t lines(const Answer& answer) {
  return static_cast<std::size_t>(std::count(answer.output.begin(), answer.output.end(), '\n'));
}

TEST(Check, TellsEveryPropertyOfAModuleThatKeepsThem) {
  const Answer answer = teren({"check", "--quick", module("sound")});
  EXPECT_EQ(answer.exitCode, 0);
  EXPECT_EQ(answer.complaint, "") << "no progress where there is no terminal";
  EXPECT_NE(line(answer, "pass", "loading"), "");
  EXPECT_TRUE(holds(line(answer, "pass", "deviation"), " m of 1 m over 250 seeds"));
  EXPECT_TRUE(answer.output.ends_with("it keeps the contract: 20 properties hold\n")) << answer.output;
  EXPECT_EQ(lines(answer), 21U);
  EXPECT_FALSE(holds(answer.output, "FAIL"));
}

TEST(Check, TellsTheSameInJson) {
  const Answer answer = teren({"check", "--json", "--quick", module("no-residual")});
  EXPECT_EQ(answer.exitCode, 1);
  EXPECT_EQ(answer.complaint, "");
  const Json report = Json::parse(answer.output);
  EXPECT_EQ(report["file"], module("no-residual"));
  EXPECT_EQ(report["id"], "no-residual");
  EXPECT_EQ(report["kind"], "generator");
  EXPECT_EQ(report["version"], "1.0");
  EXPECT_EQ(report["holds"], false);
  EXPECT_EQ(report["properties"].size(), 20U);
  for (const Json& property : report["properties"]) {
    EXPECT_EQ(property["holds"], property["name"] != "residual") << property;
    EXPECT_NE(property["demand"], "");
    EXPECT_NE(property["text"], "");
  }
}

TEST(Check, EndsWithOneAndTheCounterExampleWhereAPropertyIsBroken) {
  const Answer answer = teren({"check", "--quick", module("no-margins")});
  EXPECT_EQ(answer.exitCode, 1);
  EXPECT_TRUE(holds(line(answer, "FAIL", "margins"), "7 m was written beside the map")) << answer.output;
  EXPECT_TRUE(answer.output.ends_with("it breaks the contract: 1 of 20 properties does not hold\n"));
}

TEST(Check, AsksForOnePropertyAlone) {
  const Answer answer = teren({"check", "--property", "levels", module("no-margins")});
  EXPECT_EQ(answer.exitCode, 0);
  EXPECT_EQ(lines(answer), 3U);
  EXPECT_NE(line(answer, "pass", "levels"), "");
}

TEST(Check, GivesTheReasonWhyTheEngineRefusesAModule) {
  const std::pair<const char*, const char*> refused[] = {
      {"other-words", "\"pointer size\" is"}, {"wrong-magic", "magic number"}, {"throwing-entry", "threw"}};
  for (const auto& [id, reason] : refused) {
    const std::string file = std::string(TEREN_TEST_MODULES "/broken/teren-") + id + ".so";
    const Answer answer = teren({"check", file});
    EXPECT_EQ(answer.exitCode, 1) << id;
    EXPECT_TRUE(holds(line(answer, "FAIL", "loading"), reason)) << answer.output;
    EXPECT_EQ(lines(answer), 2U) << "nothing else can be asked";
  }
  const Answer json = teren({"check", "--json", TEREN_TEST_MODULES "/broken/teren-wrong-magic.so"});
  EXPECT_EQ(json.exitCode, 1);
  EXPECT_EQ(Json::parse(json.output)["id"], Json());
  EXPECT_EQ(Json::parse(json.output)["properties"].size(), 1U);
}

TEST(Check, RefusesAWrongCommandLine) {
  const std::pair<Arguments, const char*> cases[] = {
      {{"check"}, "FILE"},
      {{"check", "/no/such/teren-file.so"}, "there is no file"},
      {{"check", module("sound"), "--property", "beauty"}, "\"beauty\" but must be loading, completion, "},
      {{"check", module("sound"), "--limit", "0"}, "--limit"},
      {{"check", module("sound"), "--limit", "nan"}, "--limit"},
      {{"check", module("sound"), "--property", "loading", "--answer", "-1"}, "--answer"},
      {{"check", module("sound"), "--answer", "3"}, "--answer needs --property"},
      {{"check", module("sound"), module("sound")}, "not expected"},
  };
  for (const auto& [arguments, part] : cases) {
    const Answer answer = teren(arguments);
    EXPECT_EQ(answer.exitCode, 2);
    EXPECT_TRUE(isOneSentence(answer.complaint) && holds(answer.complaint, part)) << answer.complaint;
    EXPECT_EQ(answer.output, "");
  }
}

TEST(Check, OutlivesAModuleThatCrashesAndTellsTheRest) {
  const Answer answer = teren({"check", "--quick", "--json", module("crash")});
  EXPECT_EQ(answer.exitCode, 1);
  EXPECT_EQ(answer.complaint, "here I fall\n") << "what a module says goes to standard error";
  const Json report = Json::parse(answer.output);
  for (const Json& property : report["properties"]) {
    EXPECT_EQ(property["holds"], property["name"] != "completion") << property;
    if (property["holds"]) continue;
    EXPECT_EQ(property["text"], "its process was ended by signal 9 (Killed)");
  }
}

TEST(Check, NoticesAModuleThatEndsItsProcessWhileItIsLoaded) {
  const Answer answer = teren({"check", module("exits-at-once")});
  EXPECT_EQ(answer.exitCode, 1);
  EXPECT_TRUE(holds(line(answer, "FAIL", "loading"), "ended without an answer")) << answer.output;
}

TEST(Check, EndsAModuleThatWorksForEver) {
  const Answer answer = teren({"check", "--property", "completion", "--limit", "0.5", module("loop")});
  EXPECT_EQ(answer.exitCode, 1);
  EXPECT_NE(line(answer, "pass", "loading"), "");
  EXPECT_TRUE(holds(line(answer, "FAIL", "completion"), "used 0.5 s of processor time")) << answer.output;
}

/// The two processes of the module "waits-for-ever", once they are there.
std::vector<pid_t> waitingProcesses(const Program& program) {
  for (int tries = 0; tries < 6000; ++tries) {
    std::istringstream text(fileBytes(program.folder() / "processes"));
    pid_t first = 0, second = 0;
    if (text >> first >> second) return {first, second};
    usleep(10'000);
  }
  return {};
}

/// Whether nobody has this number, or only until its new parent looks.
bool isGone(pid_t process) {
  for (int tries = 0; tries < 1000; ++tries) {
    const std::string status = fileBytes("/proc/" + std::to_string(process) + "/stat");
    if (status.empty() || status.find(") Z") != std::string::npos) return true;
    usleep(10'000);
  }
  return false;
}

TEST(Check, EndsAModuleThatWaitsForEverAndAllItsProcesses) {
  Program program({"check", "--limit", "0.3", module("waits-for-ever")});
  const std::vector<pid_t> processes = waitingProcesses(program);
  const Answer answer = program.finish();
  EXPECT_EQ(answer.exitCode, 1);
  EXPECT_TRUE(holds(line(answer, "FAIL", "loading"), "waited for 3 s")) << answer.output;
  ASSERT_EQ(processes.size(), 2U);
  for (const pid_t process : processes) EXPECT_TRUE(isGone(process));
}

TEST(Check, StopsWithItsProcessesWhenInterrupted) {
  for (const int signal : {SIGINT, SIGTERM}) {
    Program program({"check", module("waits-for-ever")});
    const std::vector<pid_t> processes = waitingProcesses(program);
    ASSERT_EQ(processes.size(), 2U);
    program.signal(signal);
    const Answer answer = program.finish();
    EXPECT_EQ(answer.exitCode, 1);
    EXPECT_EQ(answer.complaint, "teren: interrupted, the check was not completed\n");
    EXPECT_EQ(answer.output, "");
    for (const pid_t process : processes) EXPECT_TRUE(isGone(process));
  }
}

TEST(Check, LeavesNoProcessBehindWhenItIsKilled) {
  Program program({"check", module("waits-for-ever")});
  const std::vector<pid_t> processes = waitingProcesses(program);
  ASSERT_EQ(processes.size(), 2U);
  program.signal(SIGKILL);
  EXPECT_EQ(program.finish().exitCode, -1);
  EXPECT_TRUE(isGone(processes[0]));
  kill(processes[1], SIGKILL);  // nobody can end the children of a module whose asker was killed
}

}  // namespace
}  // namespace teren
