// The rules by which rows justify a default, on tables that are made up.
#include "apps/report/Defaults.h"

#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

namespace teren {
namespace {

Table table(const std::vector<std::string>& columns, const std::vector<std::vector<Cell>>& rows) {
  std::vector<Column> all;
  for (const std::string& name : columns) all.push_back({name, "", ""});
  Table table("t", "T", "D", all);
  for (const std::vector<Cell>& row : rows) table.add(row);
  return table;
}

/// Of two generators; what is handed over are figures of the first.
Table blending(double smoothCrease, double linearCrease, double keptRipple) {
  using T = std::string;
  Table rows = table({"generator", "kernel", "preserve variance", "time median", "crease p99",
                      "ripple of deviation", "ripple of slope"},
                     {});
  for (const auto& [generator, without, with] :
       {std::tuple{T("one"), 10.0, keptRipple}, {T("other"), 50.0, 30.0}}) {
    rows.add({generator, T("linear"), T("no"), 60.0, linearCrease, without, 9.0});
    rows.add({generator, T("linear"), T("yes"), 61.0, linearCrease, with, 9.0});
    rows.add({generator, T("smooth"), T("no"), 65.0, smoothCrease, without, 9.0});
    rows.add({generator, T("smooth"), T("yes"), 66.0, smoothCrease, with, 9.0});
  }
  return rows;
}

/// The rows of a view that reaches farther say nothing.
Table detail(double trianglesAtEight, double trianglesAtFour = 3e6) {
  return table({"pixel error", "view distance", "triangles", "memory", "true max", "true p99"},
               {{4.0, 10000.0, trianglesAtFour, 80.0, 2.0, 0.6},
                {8.0, 20000.0, 2e6, 60.0, 4.0, 1.2},
                {8.0, 10000.0, trianglesAtEight, 40.0, 4.0, 1.2},
                {16.0, 20000.0, 1e5, 30.0, 8.0, 2.4},
                {16.0, 10000.0, 1e5, 20.0, 8.0, 2.4}});
}

/// Of a view of one level, too, of one that is not as far, and of a smaller picture.
Table frames(double atSixteen, double atTwentyFour) {
  return table({"pixel error", "view distance", "lines", "frame median", "frame p99"},
               {{Cell(), Cell(), Cell(), 5.0, 6.0},
                {4.0, 5000.0, 720.0, 20.0, 21.0},
                {8.0, 20000.0, 200.0, 20.0, 21.0},
                {16.0, 20000.0, 720.0, atSixteen, 40.0},
                {24.0, 20000.0, 720.0, atTwentyFour, 40.0},
                {32.0, 20000.0, 720.0, 28.0, 40.0}});
}

Table scheduling(double reachedAtTwo, double missingAtTwo) {
  return table({"workers", "budget", "missing", "error reached", "update p99"},
               {{0.0, 1.0, 0.0, 99.9, 1100.0},
                {0.0, 2.0, missingAtTwo, reachedAtTwo, 2100.0},
                {0.0, 4.0, 0.0, 100.0, 4100.0},
                {1.0, 2.0, 1.0, 0.0, 300.0}});
}

constexpr DefaultsInCode kDefaults{.pixelError = 8.0,
                                   .distance = 10'000.0,
                                   .flyingPixelError = 24.0,
                                   .flyingDistance = 20'000.0,
                                   .budget = 2.0};

using Verdicts = std::vector<std::optional<bool>>;

Verdicts holding(const Table& blending, const Table& detail, const Table& frames, const Table& scheduling,
                 const DefaultsInCode& defaults = kDefaults) {
  Verdicts all;
  for (const Justification& choice : justify(defaults, blending, detail, frames, scheduling))
    all.push_back(choice.holds);
  return all;
}

TEST(Defaults, HoldWhereTheRowsSaySo) {
  EXPECT_EQ(holding(blending(1e-4, 10.0, 5.0), detail(8e5), frames(34.0, 33.0), scheduling(99.5, 0.0)),
            Verdicts(5, true));
}

TEST(Defaults, DoNotHoldWhereTheRowsSayOtherwise) {
  EXPECT_EQ(holding(blending(1.0, 10.0, 5.0), detail(2e6), frames(34.0, 33.4), scheduling(98.0, 0.0)),
            (Verdicts{false, true, false, false, false}))
      << "creases in both kernels, too many triangles, too slow, error not reached";
  EXPECT_EQ(holding(blending(1e-4, 0.01, 25.0), detail(8e5, 9e5), frames(33.0, 31.0), scheduling(100.0, 1.0)),
            (Verdicts{false, false, false, false, false}))
      << "linear is as good and cheaper, preserving makes one of two layers worse, 4 px take few, 16 px are "
         "fast enough, ground missing";
  const DefaultsInCode other{BlendKernel::linear, false, 16.0, 10'000.0, 32.0, 20'000.0, 1.0};
  EXPECT_EQ(holding(blending(1e-4, 10.0, 5.0), detail(8e5), frames(34.0, 33.0), scheduling(99.5, 0.0), other),
            Verdicts(5, false))
      << "finer or more would do";
}

TEST(Defaults, AreNotJudgedByFramesThatNobodyHasMeasured) {
  const auto verdict = [](const Table& frames) {
    return holding(blending(1e-4, 10.0, 5.0), detail(8e5), frames, scheduling(99.5, 0.0)).at(3);
  };
  EXPECT_EQ(verdict(table({"file"}, {})), std::nullopt);
  EXPECT_EQ(verdict(table({"pixel error", "view distance", "lines", "frame median", "frame p99"},
                          {{16.0, 20000.0, 720.0, 20.0, 30.0}, {24.0, 5000.0, 720.0, 20.0, 30.0}})),
            std::nullopt)
      << "not of the default's";
}

TEST(Defaults, NameTheRowsThatDecide) {
  const auto all =
      justify(kDefaults, blending(1e-4, 10.0, 5.0), detail(2e6), frames(34.0, 33.0), scheduling(50.0, 0.0));
  EXPECT_EQ(all.at(2).value, "8 px");
  EXPECT_NE(all.at(2).why.find("16 px: 100000 triangles, 20 MiB"), std::string::npos) << all.at(2).why;
  EXPECT_NE(all.at(3).why.find("16 px: 34 ms, p99 40 ms, 24 px: 33 ms"), std::string::npos) << all.at(3).why;
  EXPECT_EQ(all.at(3).why.find("4 px: 20 ms"), std::string::npos) << all.at(3).why;
  EXPECT_NE(all.at(4).why.find("The smallest that suffices, 1 ms"), std::string::npos) << all.at(4).why;
  const auto none =
      justify(kDefaults, blending(1e-4, 10.0, 5.0), table({"pixel error", "view distance", "triangles"}, {}),
              frames(34.0, 33.0), table({"workers", "budget", "missing", "error reached"}, {}));
  EXPECT_EQ(none.at(2).holds, false);
  EXPECT_NE(none.at(2).why.find("No row does"), std::string::npos);
  EXPECT_EQ(none.at(4).holds, false);
}

}  // namespace
}  // namespace teren
