// Good input with random damage: whatever comes of it is either taken or refused with one sentence. Seeds are
// fixed and logged, so a failure can be repeated; TEREN_FULL=1 tries a hundred times as much.
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Hash.h"
#include "teren/Parameter.h"
#include "teren/World.h"

#include "apps/options/CommandLine.h"
#include "tests/doors/Refusal.h"
#include "tests/doors/Registry.h"

namespace teren {
namespace {

int trials(int usual) {
  return std::getenv("TEREN_FULL") != nullptr ? 100 * usual : usual;
}

std::size_t below(RandomSequence& random, std::size_t count) {
  return static_cast<std::size_t>(random.next() % count);
}

template <class List>
const auto& anyOf(RandomSequence& random, const List& list) {
  return list[below(random, std::size(list))];
}

const std::string kGoodWorld =
    R"({ "seed": 42, "pitch": 64.0, "samples": 33, "blend": "smooth", "preserveVariance": true,
  "layers": [ { "name": "hills", "generator": "fault", "parameters": { "faults": 15, "deviation": 2.5 }, "pitch": 128,
                "samples": 17, "blend": "linear", "filters": [ { "filter": "band", "parameters": { "k": 0.9, "passes": 2 } } ] },
              { "generator": "flat", "parameters": { "height": -7 } } ] })";

/// What people and programs get wrong.
const std::vector<std::string> kScraps = {"1e999",
                                          "-1e999",
                                          "1e-999",
                                          "42.5",
                                          "-1",
                                          "18446744073709551616",
                                          "9223372036854775808",
                                          "-9223372036854775809",
                                          "0",
                                          "-0",
                                          "NaN",
                                          "Infinity",
                                          "null",
                                          "true",
                                          "\"\"",
                                          "\"x\"",
                                          "[]",
                                          "{}",
                                          "[[[[",
                                          "{\"a\":",
                                          "}",
                                          "]",
                                          ",",
                                          ":",
                                          "\"",
                                          "\\",
                                          "\\u0000",
                                          "\\ud800",
                                          "\xff",
                                          "\xc0\x80",
                                          std::string(1, '\0'),
                                          "\n",
                                          "//",
                                          "0x10",
                                          "1_000",
                                          "1,5",
                                          "64",
                                          "65",
                                          "4",
                                          "3",
                                          "2049",
                                          "0.001",
                                          "1e6",
                                          "1e300",
                                          "\"samples\": 5,",
                                          "\"seed\": 1,",
                                          "\"layers\": 3,"};

/// One to four changes: bytes overwritten, taken out or doubled, scraps put in, numbers replaced, the end cut
/// off.
std::string damaged(std::string text, RandomSequence& random) {
  for (std::size_t left = 1 + below(random, 4); left > 0 && !text.empty(); --left) {
    const std::size_t at = below(random, text.size());
    const std::size_t length = 1 + below(random, std::min<std::size_t>(text.size() - at, 20));
    switch (below(random, 6)) {
      case 0:
        text[at] = static_cast<char>(random.next());
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(at, text.substr(at, length));
        break;
      case 3:
        text.insert(at, anyOf(random, kScraps));
        break;
      case 4: {  // a whole number or word
        const std::size_t first = text.find_first_of("0123456789-", at);
        if (first == std::string::npos) break;
        const std::size_t last = text.find_first_not_of("0123456789.-e", first);
        text.replace(first, std::min(last, text.size()) - first, anyOf(random, kScraps));
        break;
      }
      default:
        if (below(random, 8) == 0) text.resize(at);
    }
  }
  return text;
}

TEST(DamagedWorldFile, IsTakenOrRefusedWithOneSentence) {
  constexpr std::uint64_t kSeed = 2026;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomSequence random(kSeed);
  int made = 0, refusedByReader = 0, refusedByWorld = 0;
  for (int trial = 0; trial < trials(20'000); ++trial) {
    const std::string text = damaged(kGoodWorld, random);
    SCOPED_TRACE(testing::Message() << "trial " << trial << ": " << text);
    const Result<WorldDescription> description = WorldDescription::fromJson(text, "w.json");
    if (!description) {
      ++refusedByReader;
      expectOneSentence(description.error().message, {"w.json"});
    } else {
      const auto world = World::create(*description, registryOfAllModules());
      if (!world) {
        ++refusedByWorld;
        expectOneSentence(world.error().message, {});
      } else if (++made % 100 == 0) {
        ASSERT_TRUE(std::isfinite((*world)->height({3, -4, 0.3, 0.7})));
      }
    }
    if (HasFailure()) return;
  }
  EXPECT_GT(made, 100);
  EXPECT_GT(refusedByReader, 1000);
  EXPECT_GT(refusedByWorld, 100);
}

TEST(DamagedWorldFile, DoesNotBreakTheProgram) {
  constexpr std::uint64_t kSeed = 2027;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomSequence random(kSeed);
  const ScratchFolder folder;
  for (int trial = 0; trial < trials(60); ++trial) {
    const std::string text = damaged(kGoodWorld, random);
    SCOPED_TRACE(testing::Message() << "trial " << trial << ": " << text);
    folder.write("w.json", text);
    const Answer answer =
        Program({"query", "--world", folder / "w.json", "1", "2"}, withHostileModules()).finish();
    if (answer.exitCode == 0) {
      EXPECT_EQ(answer.complaint, "");
      EXPECT_NE(answer.output, "");
    } else {
      EXPECT_EQ(answer.exitCode, 2);
      EXPECT_TRUE(isOneSentence(answer.complaint)) << answer.complaint;
      EXPECT_EQ(answer.output, "");
    }
    EXPECT_TRUE(answer.left.empty());
    if (HasFailure()) return;
  }
}

const std::vector<std::string> kNumbers = {"0",
                                           "1",
                                           "-1",
                                           "65",
                                           "64.0",
                                           ".5",
                                           "-.5",
                                           "1e3",
                                           "nan",
                                           "-inf",
                                           "1e999",
                                           "0x10",
                                           "+7",
                                           "18446744073709551615",
                                           "-9223372036854775808",
                                           "1e-320",
                                           "",
                                           " 1",
                                           "1,5",
                                           "١"};

TEST(DamagedNumber, IsReadExactlyOrRefusedWithOneSentence) {
  constexpr std::uint64_t kSeed = 2028;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomSequence random(kSeed);
  for (int trial = 0; trial < trials(100'000); ++trial) {
    const std::string text = damaged(anyOf(random, kNumbers), random);
    SCOPED_TRACE(testing::Message() << "trial " << trial << ": " << text);
    if (const auto whole = wholeArgument("--level", text, -100, 100); whole) {
      ASSERT_TRUE(-100 <= *whole && *whole <= 100);
      ASSERT_EQ(static_cast<double>(*whole), std::strtod(text.c_str(), nullptr));
      ASSERT_EQ(text.find_first_not_of("+-0123456789"), std::string::npos);
    } else {
      expectOneSentence(whole.error().message, {"--level", "-100 to 100"});
    }
    if (const auto number = numberArgument("--pitch", text, -1e6, 1e6); number) {
      ASSERT_TRUE(-1e6 <= *number && *number <= 1e6);
      ASSERT_EQ(*number, std::strtod(text.c_str(), nullptr));
    } else {
      expectOneSentence(number.error().message, {"--pitch", "1e+06"});
    }
    if (const auto seed = seedArgument("--seed", text); seed) {
      ASSERT_EQ(text.find_first_not_of("+0123456789"), std::string::npos);
      ASSERT_EQ(*seed, std::strtoull(text.c_str(), nullptr, 10));
    } else {
      expectOneSentence(seed.error().message, {"--seed", "18446744073709551615"});
    }
    if (HasFailure()) return;
  }
}

TEST(DamagedCommandLine, IsUnderstoodOrRefusedWithOneSentence) {
  constexpr std::uint64_t kSeed = 2029;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomSequence random(kSeed);
  const std::vector<std::string> words = {
      "bake",      "query",   "plugins",   "describe",   "--world",   "--generator", "fault",  "--set",
      "faults=3",  "faults=", "=3",        "--pitch",    "--samples", "--blend",     "linear", "--seed",
      "--patches", "--level", "--workers", "--slice-us", "-o",        "never.r32",   "--json", "--",
      "-",         "---",     "-x",        "--seed=",    "--json=1",  "@x"};
  const std::vector<Arguments> good = {{"bake", "--generator", "fault", "--set", "faults=3", "--patches", "0",
                                        "0", "1", "1", "-o", "never.r32"},
                                       {"query", "--generator", "fault", "--seed", "3", "1", "2", "--json"},
                                       {"describe", "fault", "--json"}};
  for (int trial = 0; trial < trials(150); ++trial) {
    Arguments arguments = anyOf(random, good);
    for (std::size_t left = 1 + below(random, 3); left > 0; --left) {
      const std::size_t at = below(random, arguments.size());
      const auto place = arguments.begin() + static_cast<std::ptrdiff_t>(at);
      const std::string word =
          below(random, 2) == 0 ? anyOf(random, words) : damaged(anyOf(random, kNumbers), random);
      // An argument ends at its first zero byte.
      const std::string given = word.substr(0, word.find('\0'));
      if (below(random, 3) == 0) {
        arguments.insert(place, given);
      } else {
        *place = given;
      }
    }
    std::string line;
    for (const std::string& text : arguments) line += " '" + text + "'";
    SCOPED_TRACE(testing::Message() << "trial " << trial << ": teren" << line);
    const Answer answer = Program(arguments, withHostileModules()).finish();
    if (answer.exitCode == 0) {
      EXPECT_EQ(answer.complaint, "");
    } else {
      EXPECT_TRUE(answer.exitCode == 2 || answer.exitCode == 1) << answer.exitCode;
      EXPECT_TRUE(isOneSentence(answer.complaint)) << answer.complaint;
      EXPECT_EQ(answer.output, "");
      EXPECT_TRUE(answer.left.empty()) << answer.left.front();
    }
    if (HasFailure()) return;
  }
}

}  // namespace
}  // namespace teren
