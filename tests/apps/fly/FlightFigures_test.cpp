#include "apps/fly/FlightFigures.h"

#include <algorithm>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

namespace teren {
namespace {

std::string says(const std::vector<DisplayLine>& lines, const std::string& name) {
  const auto line = std::find_if(lines.begin(), lines.end(),
                                 [&name](const DisplayLine& each) { return each.what == name; });
  return line == lines.end() ? "no such line" : line->says;
}

std::string figure(const FlightFigures& figures, const std::string& name) {
  return says(flightLines(figures), name);
}

TEST(FlightFigures, GroupDigitsByThousands) {
  EXPECT_EQ(groupedNumber(0.0L, 1), "0.0");
  EXPECT_EQ(groupedNumber(999.0L, 0), "999");
  EXPECT_EQ(groupedNumber(1000.0L, 0), "1 000");
  EXPECT_EQ(groupedNumber(-1234567.25L, 1), "-1 234 567.2");
  EXPECT_EQ(groupedNumber(-123.0L, 0), "-123");
}

TEST(FlightFigures, SayThePositionInMetres) {
  FlightFigures figures;
  figures.position = {100, -1, 0.25, 0.5};
  EXPECT_EQ(figure(figures, "east"), "6 416.0 m");
  EXPECT_EQ(figure(figures, "north"), "-32.0 m");
  EXPECT_EQ(figure(figures, "patch"), "(100, -1) + (16.00, 32.00) m");
}

TEST(FlightFigures, KeepTenthsOfAMetreAtTheEndOfTheWorld) {
  FlightFigures figures;
  figures.position = {kMaxPatch - 1, -kMaxPatch, 0.103125, 0.0};  // 6.6 m into the last patch
  EXPECT_EQ(figure(figures, "east"), "288 230 376 151 711 686.6 m");
  EXPECT_EQ(figure(figures, "north"), "-288 230 376 151 711 744.0 m");
  EXPECT_EQ(figure(figures, "patch"), "(4503599627370495, -4503599627370496) + (6.60, 0.00) m");
}

TEST(FlightFigures, NameTheHeadingByItsCompassPoint) {
  FlightFigures figures;
  EXPECT_EQ(figure(figures, "heading"), "000° N");
  figures.heading = std::numbers::pi / 4.0;
  EXPECT_EQ(figure(figures, "heading"), "045° NE");
  figures.heading = 1.5 * std::numbers::pi;
  EXPECT_EQ(figure(figures, "heading"), "270° W");
  figures.heading = 2.0 * std::numbers::pi - 1e-6;
  EXPECT_EQ(figure(figures, "heading"), "000° N");
}

TEST(FlightFigures, SayWhenTheGroundIsUnknown) {
  FlightFigures figures;
  EXPECT_EQ(figure(figures, "above ground"), "unknown");
  figures.heightAboveGround = 123.456;
  EXPECT_EQ(figure(figures, "above ground"), "123.5 m");
}

TEST(CostFigures, TellHowWrongThePictureMayBe) {
  CostFigures figures;
  figures.pixelError = {.p99 = 2.34, .max = 17.06};
  EXPECT_EQ(says(costLines(figures), "pixel error"), "17.1 px  (p99 2.3)");
}

TEST(CostFigures, TellWhatIsStillToCome) {
  CostFigures figures;
  figures.nodes = 1690;
  EXPECT_EQ(says(costLines(figures), "nodes"), "1 690");
  figures.pending = 12;
  EXPECT_EQ(says(costLines(figures), "nodes"), "1 690  (+ 12 to come)");
}

}  // namespace
}  // namespace teren
