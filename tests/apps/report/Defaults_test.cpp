// The rules by which rows justify a default, on tables that are made up.
#include "apps/report/Defaults.h"

#include <string>
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

Table blending(double smoothCrease, double linearCrease, double keptRipple) {
  using T = std::string;
  return table(
      {"kernel", "preserve variance", "time median", "crease p99", "ripple of deviation", "ripple of slope"},
      {{T("linear"), T("no"), 60.0, linearCrease, 50.0, 9.0},
       {T("linear"), T("yes"), 61.0, linearCrease, keptRipple, 9.0},
       {T("smooth"), T("no"), 65.0, smoothCrease, 50.0, 9.0},
       {T("smooth"), T("yes"), 66.0, smoothCrease, keptRipple, 9.0}});
}

Table detail(double trianglesAtTwo, double distanceAtTwo) {
  return table({"pixel error", "view distance", "triangles", "true max", "true p99"},
               {{1.0, 5000.0, 9e6, 0.5, 0.3},
                {2.0, distanceAtTwo, trianglesAtTwo, 1.0, 0.6},
                {4.0, 20000.0, 3e5, 2.0, 1.2}});
}

Table scheduling(double reachedAtTwo, double missingAtTwo) {
  return table({"workers", "budget", "missing", "error reached", "update p99"},
               {{0.0, 1.0, 0.0, 50.0, 1100.0},
                {0.0, 2.0, missingAtTwo, reachedAtTwo, 2100.0},
                {0.0, 4.0, 0.0, 100.0, 4100.0},
                {1.0, 0.25, 0.0, 100.0, 300.0}});
}

std::vector<bool> holding(const Table& blending, const Table& detail, const Table& scheduling,
                          const DefaultsInCode& defaults = {}) {
  std::vector<bool> all;
  for (const Justification& choice : justify(defaults, blending, detail, scheduling))
    all.push_back(choice.holds);
  return all;
}

TEST(Defaults, HoldWhereTheRowsSaySo) {
  EXPECT_EQ(holding(blending(1e-4, 10.0, 5.0), detail(8e5, 20000.0), scheduling(99.5, 0.0)),
            std::vector<bool>(4, true));
}

TEST(Defaults, DoNotHoldWhereTheRowsSayOtherwise) {
  EXPECT_EQ(holding(blending(1.0, 10.0, 5.0), detail(2e6, 20000.0), scheduling(98.0, 0.0)),
            (std::vector<bool>{false, true, false, false}))
      << "creases in both kernels, too many triangles, error not reached";
  EXPECT_EQ(holding(blending(1e-4, 0.01, 60.0), detail(8e5, 10000.0), scheduling(100.0, 1.0)),
            (std::vector<bool>{false, false, false, false}))
      << "linear is as good and cheaper, preserving makes it worse, not as far, ground missing";
  DefaultsInCode other{BlendKernel::linear, false, 4.0, 4.0};
  EXPECT_EQ(holding(blending(1e-4, 10.0, 5.0), detail(8e5, 20000.0), scheduling(99.5, 0.0), other),
            std::vector<bool>(4, false))
      << "smaller would do";
}

TEST(Defaults, NameTheRowsThatDecide) {
  const auto all = justify({}, blending(1e-4, 10.0, 5.0), detail(2e6, 20000.0), scheduling(50.0, 0.0));
  EXPECT_EQ(all.at(2).value, "2 px");
  EXPECT_NE(all.at(2).why.find("4 px: 300000 triangles as far as 20000 m"), std::string::npos)
      << all.at(2).why;
  EXPECT_NE(all.at(3).why.find("4 ms"), std::string::npos) << all.at(3).why;
  const auto none =
      justify({}, blending(1e-4, 10.0, 5.0), table({"pixel error", "view distance", "triangles"}, {}),
              table({"workers", "budget", "missing", "error reached"}, {}));
  EXPECT_FALSE(none.at(2).holds);
  EXPECT_NE(none.at(2).why.find("No row does"), std::string::npos);
  EXPECT_FALSE(none.at(3).holds);
}

}  // namespace
}  // namespace teren
