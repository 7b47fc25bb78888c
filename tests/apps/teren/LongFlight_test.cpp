// Law 6 over time: what a long flight holds is counted, stays under the cap, and does not grow. Ten minutes
// of flight; an hour with TEREN_FULL.
#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/apps/teren/Program.h"
#include "tests/support/TrialSize.h"

namespace teren {
namespace {

using Json = nlohmann::json;

constexpr std::int64_t kMiB = std::int64_t{1} << 20;

/// Of some minutes, so that what is held for a moment only does not count.
std::int64_t medianOf(const Json& memory, const char* key, std::size_t first, std::size_t last) {
  std::vector<std::int64_t> values;
  for (std::size_t k = first; k < last; ++k) values.push_back(memory[k].at(key));
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

std::string table(const Json& memory) {
  std::string text = "MiB after minutes: resident, engine's, of queries, allocated, kept by the allocator\n";
  for (const Json& held : memory) {
    text += std::to_string(held.at("seconds").get<int>() / 60);
    for (const char* key : {"rss_bytes", "engine_bytes", "query_bytes", "used_bytes", "unused_bytes"}) {
      text += "  " + std::to_string(held.at(key).get<double>() / static_cast<double>(kMiB)).substr(0, 6);
    }
    text += "\n";
  }
  return text;
}

void expectNoGrowth(std::int64_t cap, const Arguments& added) {
  if (test::kSanitized) GTEST_SKIP() << "a sanitizer keeps what is freed";
  const bool full = test::isFull();
  Arguments all = {"flight",
                   "--json",
                   "--fast",
                   "--path",
                   "turns",
                   "--speed",
                   "300",
                   "--budget-us",
                   "300",
                   "--seconds",
                   full ? "3600" : "600",
                   "--cap-mib",
                   std::to_string(cap)};
  all.insert(all.end(), added.begin(), added.end());
  const Answer answer = teren(all);
  ASSERT_EQ(answer.exitCode, 0) << answer.complaint;
  const Json flown = Json::parse(answer.output);
  const Json& memory = flown.at("memory");
  ASSERT_EQ(memory.size(), full ? 60U : 10U);
  const std::string told = table(memory);
  EXPECT_LE(flown.at("peak_bytes"), cap * kMiB);
  // The program's own part: worlds, plugins, the flight's logs.
  constexpr std::int64_t kProgram = 4 * kMiB;
  for (const Json& held : memory) {
    EXPECT_LE(
        held.at("used_bytes"),
        (held.at("engine_bytes").get<std::int64_t>() + held.at("query_bytes").get<std::int64_t>()) * 11 / 10 +
            kProgram)
        << told;
  }
  const std::size_t last = memory.size();
  const auto warm = [&](const char* key) { return medianOf(memory, key, 1, 4); };
  const auto growth = [&](const char* key) { return medianOf(memory, key, last - 3, last) - warm(key); };
  // Where the land there takes more bytes than that of the beginning, more is resident.
  EXPECT_LT(growth("rss_bytes"), warm("rss_bytes") / (full ? 50 : 12) +
                                     std::max<std::int64_t>(growth("engine_bytes"), 0) +
                                     growth("query_bytes"))
      << told;
  // What is counted includes room that is not in use yet, more in one minute and less in another.
  std::vector<std::int64_t> uncounted;
  for (const Json& held : memory) {
    uncounted.push_back(held.at("used_bytes").get<std::int64_t>() -
                        held.at("engine_bytes").get<std::int64_t>() -
                        held.at("query_bytes").get<std::int64_t>() * 11 / 10);
  }
  EXPECT_LT(*std::min_element(uncounted.end() - 3, uncounted.end()),
            *std::max_element(uncounted.begin() + 1, uncounted.begin() + 4) + kMiB / 2)
      << "not counted\n"
      << told;
}

TEST(LongFlight, DoesNotGrowOverOneLevel) {
  expectNoGrowth(256, {});
}

TEST(LongFlight, DoesNotGrowWithDetailByError) {
  expectNoGrowth(256, {"--pixel-error", "16", "--view-distance", "20000"});
}

TEST(LongFlight, DoesNotGrowUnderATightCapWithAWorker) {
  expectNoGrowth(24, {"--pixel-error", "4", "--view-distance", "10000", "--workers", "1"});
}

}  // namespace
}  // namespace teren
