// What `teren flight` answers. No test here looks at a clock: how long anything took is for people to read.
#include <algorithm>
#include <bit>
#include <cstdio>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "teren/Hash.h"

#include "tests/apps/teren/Program.h"
#include "tests/engine/plugin/ScratchFolder.h"

namespace teren {
namespace {

using Json = nlohmann::json;

Arguments flight(const Arguments& added) {
  Arguments all = {"flight", "--json"};
  all.insert(all.end(), added.begin(), added.end());
  return all;
}

Json flightJson(const Arguments& added) {
  const Answer answer = teren(flight(added));
  EXPECT_EQ(answer.exitCode, 0) << answer.complaint;
  EXPECT_EQ(answer.complaint, "");
  return Json::parse(answer.output);
}

std::string hashOf(const Arguments& added) {
  return flightJson(added).at("hash");
}

/// A winding flight of two objects for a second and a half, and what is added to it.
std::string windingHash(const Arguments& added) {
  Arguments all = {"--seconds", "1.5",    "--path",      "turns",   "--speed",      "300", "--objects",
                   "2",         "--seed", "18446744073", "--start", "-1234567.875", "98.5"};
  all.insert(all.end(), added.begin(), added.end());
  return hashOf(all);
}

std::set<std::string> keysOf(const Json& object) {
  std::set<std::string> keys;
  for (const auto& item : object.items()) keys.insert(item.key());
  return keys;
}

/// A journal of craters over the beginning of that flight.
class DugFlight {
 public:
  DugFlight() {
    std::string text;
    for (int k = 0; k < 8; ++k) {
      text += "stamp crater " + std::to_string(-1234567 + 9 * k) + " " + std::to_string(110 + 45 * k) +
              " 0 30 8 " + std::to_string(k) + " 0\n";
    }
    folder_.write("craters.txt", text);
    const Answer applied = teren(
        {"edits", "apply", (folder_ / "craters.txt").string(), "--seed", "18446744073", "--edits", file()});
    EXPECT_EQ(applied.exitCode, 0) << applied.complaint;
  }
  std::string file() const { return (folder_ / "land.edits").string(); }
  std::string hash(Arguments added) const {
    added.insert(added.end(), {"--edits", file()});
    return windingHash(added);
  }

 private:
  ScratchFolder folder_;
};

/// The hash of one height, seen so many times.
std::string hashOfHeight(double height, int times) {
  Fnv1a hash;
  for (int k = 0; k < times; ++k) {
    const auto bits = std::bit_cast<std::uint64_t>(height);
    for (unsigned shift = 0; shift < 64; shift += 8) hash.addByte(static_cast<std::uint8_t>(bits >> shift));
  }
  char digits[17] = {};
  std::snprintf(digits, sizeof(digits), "%016llx", static_cast<unsigned long long>(hash.value()));
  return digits;
}

TEST(FlightCommand, AnswersWithItsFigures) {
  const Json answer = flightJson({"--seconds", "0.5", "--fast"});
  EXPECT_EQ(keysOf(answer),
            (std::set<std::string>{"updates", "cpu_us", "wall_us", "spinner_us", "spinner_cpu_us",
                                   "late_slices", "missing", "nodes", "peak_bytes", "rss_bytes", "hash"}));
  EXPECT_EQ(answer.at("updates"), 30);
  for (const char* key : {"cpu_us", "wall_us", "spinner_us", "spinner_cpu_us"}) {
    const Json& times = answer.at(key);
    EXPECT_EQ(keysOf(times), (std::set<std::string>{"p50", "p99", "p999", "max"}));
    EXPECT_GT(times.at("p50"), 0.0);
    EXPECT_LE(times.at("p50"), times.at("p99"));
    EXPECT_LE(times.at("p99"), times.at("p999"));
    EXPECT_LE(times.at("p999"), times.at("max"));
  }
  EXPECT_GE(answer.at("spinner_us").at("p50"), 2000.0);
  EXPECT_EQ(answer.at("missing"), 0);
  EXPECT_GT(answer.at("nodes"), 0);
  EXPECT_GT(answer.at("rss_bytes"), answer.at("peak_bytes"));
}

TEST(FlightCommand, TellsPeopleTheSame) {
  const Answer answer = teren({"flight", "--generator", "flat", "--seconds", "0.1", "--fast"});
  EXPECT_EQ(answer.exitCode, 0) << answer.complaint;
  EXPECT_NE(answer.output.find("6 updates"), std::string::npos) << answer.output;
  EXPECT_NE(answer.output.find(hashOfHeight(1.0, 6)), std::string::npos) << answer.output;
}

/// The ground at sea level and the eye 100 m above it, standing or not, for so long.
Json detailedFlight(const Arguments& added) {
  Arguments all = {"--fast", "--pixel-error", "16", "--view-distance", "2000"};
  all.insert(all.end(), added.begin(), added.end());
  const Json answer = flightJson(all);
  const Json& error = answer.at("pixel_error");
  EXPECT_EQ(keysOf(error), (std::set<std::string>{"wanted", "frames", "reached", "seen"}));
  EXPECT_EQ(error.at("wanted"), 16.0);
  return error;
}

TEST(FlightCommand, CountsTheFramesAfterTenSecondsWhosePixelErrorIsAsWanted) {
  EXPECT_EQ(detailedFlight({"--seconds", "10", "--generator", "flat", "--budget-us", "500"}).at("frames"), 0);
  const Json flat = detailedFlight({"--seconds", "11", "--generator", "flat", "--budget-us", "500"});
  EXPECT_EQ(flat.at("frames"), 60);
  EXPECT_EQ(flat.at("reached"), 60);
  EXPECT_EQ(flat.at("seen").at("max"), 0.0);
  // Who stands still for long enough sees what he wanted, and it is something.
  const Json standing = detailedFlight({"--seconds", "12", "--speed", "0"});
  EXPECT_EQ(standing.at("frames"), 120);
  EXPECT_GT(standing.at("reached"), 0);
  EXPECT_GT(standing.at("seen").at("p50"), 0.1);
  EXPECT_LE(standing.at("seen").at("p50"), 16.0);
  // Where he flies so fast that nothing can be made he sees no ground, which is not ground without error.
  const Json hopeless = detailedFlight({"--seconds", "11", "--speed", "100000", "--budget-us", "1"});
  EXPECT_EQ(hopeless.at("frames"), 60);
  EXPECT_EQ(hopeless.at("reached"), 0);
  EXPECT_FALSE(flightJson({"--seconds", "0.1", "--fast"}).contains("pixel_error"));
}

TEST(FlightCommand, FliesHalfAMinuteWithoutBeingToldHowLong) {
  EXPECT_EQ(flightJson({"--fast", "--budget-us", "50"}).at("updates"), 1800);
}

TEST(FlightCommand, GivesTheSameHashForAnyWorkersBudgetPaceCapAndView) {
  const std::string hash = windingHash({"--fast"});
  for (const Arguments& other :
       {Arguments{"--fast", "--workers", "1"}, Arguments{"--fast", "--workers", "3"},
        Arguments{"--fast", "--budget-us", "100"}, Arguments{"--fast", "--budget-us", "9000"},
        Arguments{"--fast", "--workers", "3", "--budget-us", "1"}, Arguments{}, Arguments{"--workers", "1"},
        Arguments{"--fast", "--cap-mib", "24"}, Arguments{"--fast", "--view-distance", "600"}}) {
    std::string line;
    for (const std::string& text : other) line += " " + text;
    EXPECT_EQ(windingHash(other), hash) << line;
  }
}

TEST(FlightCommand, GivesAnotherHashForAnotherWorldStartPathSpeedOrCompany) {
  std::set<std::string> hashes;
  const std::vector<Arguments> flights = {{},
                                          {"--seed", "7"},
                                          {"--start", "1", "0"},
                                          {"--start", "0", "1"},
                                          {"--speed", "101"},
                                          {"--objects", "2"},
                                          {"--generator", "fault"},
                                          {"--seconds", "0.4"}};
  for (const Arguments& added : flights) {
    Arguments all = {"--fast"};
    if (added.empty() || added.front() != "--seconds") all.insert(all.end(), {"--seconds", "0.5"});
    all.insert(all.end(), added.begin(), added.end());
    hashes.insert(hashOf(all));
  }
  EXPECT_EQ(hashes.size(), flights.size());
  // The two paths begin alike: north. They part after 15 s.
  const Arguments little = {"--fast", "--budget-us", "50", "--speed", "20", "--seconds"};
  const auto after = [&](const char* seconds, const char* path) {
    Arguments all = little;
    all.insert(all.end(), {seconds, "--path", path});
    return hashOf(all);
  };
  EXPECT_EQ(after("5", "turns"), after("5", "straight"));
  EXPECT_NE(after("20", "turns"), after("20", "straight"));
}

TEST(FlightCommand, HashesTheFinestGroundUnderItsObjects) {
  EXPECT_EQ(hashOf({"--generator", "flat", "--set", "height=12.5", "--seconds", "0.5", "--fast"}),
            hashOfHeight(12.5, 30));
  EXPECT_EQ(
      hashOf({"--generator", "flat", "--set", "height=-0", "--seconds", "0.5", "--fast", "--objects", "3"}),
      hashOfHeight(0.0, 90));
  // Where it stands, a query tells what the ground under it must be, level 0 for level 0.
  const Json query = Json::parse(teren({"query", "--seed", "5", "4321.625", "-77", "--json"}).output);
  const double drawn = query.at("points")[0].at("drawn");
  const Json standing =
      flightJson({"--seed", "5", "--start", "4321.625", "-77", "--speed", "0", "--seconds", "2", "--fast"});
  EXPECT_EQ(standing.at("missing"), 0);
  EXPECT_EQ(standing.at("hash"), hashOfHeight(drawn, 120));
}

TEST(FlightCommand, TellsTheHashOfItsFirstHalfMinuteAndItsMemoryAfterTheFirstMinute) {
  const Arguments rough = {"--fast", "--budget-us", "50", "--path", "turns", "--speed", "300", "--seconds"};
  const auto lasting = [&](const char* seconds) {
    Arguments all = rough;
    all.emplace_back(seconds);
    return flightJson(all);
  };
  const Json half = lasting("30"), whole = lasting("61");
  EXPECT_EQ(half.at("hash_at_30_s"), half.at("hash"));
  EXPECT_EQ(whole.at("hash_at_30_s"), half.at("hash"));
  EXPECT_NE(whole.at("hash"), half.at("hash"));
  EXPECT_FALSE(half.contains("rss_bytes_at_60_s"));
  EXPECT_FALSE(half.contains("memory"));
  ASSERT_EQ(whole.at("memory").size(), 1U);
  const Json& held = whole.at("memory")[0];
  EXPECT_EQ(held.at("seconds"), 60);
  EXPECT_EQ(held.at("rss_bytes"), whole.at("rss_bytes_at_60_s"));
  EXPECT_GT(held.at("engine_bytes"), 1 << 20);
  EXPECT_LE(held.at("engine_bytes"), whole.at("peak_bytes"));
  EXPECT_TRUE(held.contains("used_bytes"));  // LongFlight looks at how much
  EXPECT_TRUE(held.contains("unused_bytes"));
  EXPECT_GT(whole.at("rss_bytes_at_60_s"), whole.at("peak_bytes"));
}

TEST(FlightCommand, HasFinestGroundInTimeUnderAllItsObjects) {
  for (const char* workers : {"0", "1"}) {
    const Json answer = flightJson({"--fast", "--seconds", "4", "--path", "turns", "--objects", "3",
                                    "--budget-us", "5000", "--workers", workers});
    EXPECT_EQ(answer.at("missing"), 0) << workers << " workers";
  }
}

TEST(FlightCommand, CountsTheUpdatesWithoutFinestGroundAfterTheFirstSecond) {
  // Nothing can make ground for an object that crosses 1000 patches in a sixtieth of a second.
  const Arguments hopeless = {"--fast",  "--budget-us", "1",           "--speed", "100000",
                              "--pitch", "1.5",         "--generator", "fault",   "--seconds"};
  const auto missing = [&](const char* seconds) {
    Arguments all = hopeless;
    all.emplace_back(seconds);
    return flightJson(all).at("missing").get<int>();
  };
  EXPECT_EQ(missing("1"), 0);
  EXPECT_EQ(missing("1.5"), 30);
}

TEST(FlightCommand, KeepsItsCap) {
  const Json answer = flightJson({"--fast", "--seconds", "5", "--speed", "300", "--path", "turns",
                                  "--objects", "2", "--cap-mib", "16", "--budget-us", "5000"});
  EXPECT_LE(answer.at("peak_bytes"), 16 << 20);
  EXPECT_EQ(answer.at("missing"), 0);
}

TEST(FlightCommand, StopsCleanlyAndReportsWhenInterrupted) {
  for (const bool paced : {false, true}) {
    Arguments arguments = {"flight", "--json", "--seconds", "86400", "--generator", "flat", "--workers", "1"};
    if (!paced) arguments.emplace_back("--fast");
    Program program(arguments);
    ASSERT_TRUE(program.waitUntilItCatches(SIGINT));
    program.signal(SIGINT);
    const Answer answer = program.finish();
    EXPECT_EQ(answer.exitCode, 1);
    EXPECT_TRUE(isOneSentence(answer.complaint)) << answer.complaint;
    EXPECT_NE(answer.complaint.find("interrupted after"), std::string::npos) << answer.complaint;
    const int updates = Json::parse(answer.output).at("updates");
    EXPECT_LT(updates, 86400 * 60);
    EXPECT_NE(answer.complaint.find(" " + std::to_string(updates) + " of 5184000 "), std::string::npos);
  }
}

TEST(FlightCommand, HashesEditedGroundTheSamePacedOrNotAndForAnyWorkersAndBudget) {
  const DugFlight dug;
  const std::string hash = dug.hash({"--fast"});
  EXPECT_NE(hash, windingHash({"--fast"})) << "other ground, other hash";
  for (const Arguments& other :
       {Arguments{}, Arguments{"--fast", "--workers", "2"}, Arguments{"--fast", "--budget-us", "100"},
        Arguments{"--workers", "3", "--pixel-error", "4"}}) {
    EXPECT_EQ(dug.hash(other), hash);
  }
}

TEST(FlightCommand, RefusesAJournalThatIsNotThereOrOfAnotherWorldInOneSentence) {
  const DugFlight dug;
  for (const Arguments& wrong : {Arguments{"--edits", ""}, Arguments{"--edits", "/no/such.edits"},
                                 Arguments{"--seed", "5", "--edits", dug.file()}}) {
    const Answer answer = teren(flight(wrong));
    EXPECT_EQ(answer.exitCode, 2);
    EXPECT_EQ(answer.output, "");
    EXPECT_EQ(std::count(answer.complaint.begin(), answer.complaint.end(), '\n'), 1) << answer.complaint;
  }
}

}  // namespace
}  // namespace teren
