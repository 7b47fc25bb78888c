#include "teren/Parameter.h"

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "teren/Hash.h"
#include "teren/Quote.h"

namespace teren {
namespace {

constexpr std::array<std::string_view, 2> kRules = {"published", "corrected"};
constexpr std::array kTable = {
    Parameter::real("hurst", 0.8, 0.0, 1.0, "", "roughness"),
    Parameter::integer("faults", 150, 1, 10000, "", "how many"),
    Parameter::boolean("wrap", false, "periodic"),
    Parameter::choice("rule", "corrected", kRules, "which one"),
};
constexpr std::array kWideTable = {
    Parameter::integer("n", 0, -(std::int64_t{1} << 53), std::int64_t{1} << 53, "", "any")};

Result<Values> checkOne(std::string name, ParameterValue value) {
  const std::array entries = {Values::Entry(std::move(name), std::move(value))};
  return Values::check(kTable, entries, "fault");
}

TEST(Values, HoldTheDefaultsInTheOrderOfTheTable) {
  const Values values = Values::defaults(kTable);
  ASSERT_EQ(values.entries().size(), 4U);
  EXPECT_EQ(values.real("hurst"), 0.8);
  EXPECT_EQ(values.integer("faults"), 150);
  EXPECT_FALSE(values.boolean("wrap"));
  EXPECT_EQ(values.choice("rule"), "corrected");
  EXPECT_EQ(values.entries()[3].first, "rule");
}

TEST(Values, TakeWhatIsGivenAndLeaveTheRest) {
  const std::array entries = {Values::Entry("rule", std::string("published")),
                              Values::Entry("faults", std::int64_t{7}), Values::Entry("wrap", true)};
  const Result<Values> values = Values::check(kTable, entries, "fault");
  ASSERT_TRUE(values.ok());
  EXPECT_EQ(values->integer("faults"), 7);
  EXPECT_EQ(values->choice("rule"), "published");
  EXPECT_TRUE(values->boolean("wrap"));
  EXPECT_EQ(values->real("hurst"), 0.8);
}

TEST(Values, ConvertBetweenWholeRealsAndIntegersOnly) {
  EXPECT_EQ(checkOne("faults", 12.0)->integer("faults"), 12);
  EXPECT_EQ(checkOne("hurst", std::int64_t{1})->real("hurst"), 1.0);
  EXPECT_FALSE(checkOne("faults", 12.5).ok());
  EXPECT_FALSE(checkOne("faults", true).ok());
  EXPECT_FALSE(checkOne("wrap", std::int64_t{1}).ok());
  EXPECT_FALSE(checkOne("hurst", std::string("0.5")).ok());
  EXPECT_FALSE(checkOne("rule", 1.0).ok());
}

TEST(Values, AcceptBothEndsOfARangeAndNothingBeyond) {
  EXPECT_TRUE(checkOne("hurst", 0.0).ok());
  EXPECT_TRUE(checkOne("hurst", 1.0).ok());
  EXPECT_FALSE(checkOne("hurst", std::nextafter(1.0, 2.0)).ok());
  EXPECT_FALSE(checkOne("hurst", -std::numeric_limits<double>::denorm_min()).ok());
  EXPECT_FALSE(checkOne("faults", std::int64_t{0}).ok());
  EXPECT_FALSE(checkOne("faults", std::int64_t{10001}).ok());
}

TEST(Values, RefuseNumbersThatAreNotFinite) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), infinity, -infinity}) {
    EXPECT_FALSE(checkOne("hurst", bad).ok());
    EXPECT_FALSE(checkOne("faults", bad).ok());
  }
}

TEST(Values, NeverRoundAnInteger) {
  const std::int64_t limit = std::int64_t{1} << 53;
  const auto check = [](ParameterValue value) {
    const std::array entries = {Values::Entry("n", std::move(value))};
    return Values::check(kWideTable, entries, "wide").ok();
  };
  EXPECT_TRUE(check(limit));
  EXPECT_TRUE(check(-limit));
  EXPECT_FALSE(check(limit + 1));
  EXPECT_FALSE(check(-limit - 1));
  EXPECT_FALSE(check(std::numeric_limits<std::int64_t>::min()));
  EXPECT_FALSE(check(1e300));
}

constexpr std::array kTextTable = {Parameter::text("rows", "1 2", 5, "a list")};

TEST(Values, TakeATextUpToItsMostBytesWithoutControlCharacters) {
  const auto check = [](ParameterValue value) {
    const std::array entries = {Values::Entry("rows", std::move(value))};
    return Values::check(kTextTable, entries, "list");
  };
  EXPECT_EQ(Values::defaults(kTextTable).text("rows"), "1 2");
  for (const char* good : {"", "12345", "h\xc3\xb6he"})
    EXPECT_EQ(check(std::string(good))->text("rows"), good);
  for (const char* bad : {"123456", "1\n2", "1\t2", "\x7f"})
    EXPECT_FALSE(check(std::string(bad)).ok()) << bad;
  EXPECT_FALSE(check(std::string("1\0", 2)).ok());
  EXPECT_FALSE(check(12.0).ok());
  EXPECT_EQ(check(std::string("123456")).error().message,
            "parameter \"rows\" of list is \"123456\" but must be a text of at most 5 bytes without control "
            "characters");
  EXPECT_EQ(parseAssignment(kTextTable, "rows=1=2")->second, ParameterValue(std::string("1=2")));
}

TEST(Values, NameTheParameterTheValueAndWhatWasExpected) {
  EXPECT_EQ(checkOne("hurst", 1.5).error().message,
            "parameter \"hurst\" of fault is 1.5 but must be a number from 0 to 1");
  EXPECT_EQ(checkOne("rule", std::string("new")).error().message,
            "parameter \"rule\" of fault is \"new\" but must be one of published, corrected");
  EXPECT_EQ(checkOne("hurts", 0.5).error().message,
            "fault has no parameter \"hurts\"; it has hurst, faults, wrap, rule");
}

TEST(Values, RefuseANameGivenTwice) {
  const std::array entries = {Values::Entry("hurst", 0.1), Values::Entry("hurst", 0.2)};
  const Result<Values> values = Values::check(kTable, entries, "fault");
  ASSERT_FALSE(values.ok());
  EXPECT_EQ(values.error().message, "parameter \"hurst\" of fault is given twice");
}

TEST(Values, KeepMegabytesOutOfMessages) {
  const std::string huge(3'000'000, 'z');
  EXPECT_LT(checkOne("rule", huge).error().message.size(), 300U);
  EXPECT_LT(checkOne(huge, 1.0).error().message.size(), 300U);
  EXPECT_LT(parseAssignment(kTable, huge).error().message.size(), 300U);
  EXPECT_LT(parseAssignment(kTable, "hurst=" + huge).error().message.size(), 300U);
  EXPECT_LT(parseNumber(huge).error().message.size(), 300U);
  EXPECT_LT(parseNumber(std::string(3'000'000, '9')).error().message.size(), 300U);
}

TEST(ParseAssignment, ReadsEachTypeOfTheTable) {
  EXPECT_EQ(parseAssignment(kTable, "hurst=-.5")->second, ParameterValue(-0.5));
  EXPECT_EQ(parseAssignment(kTable, "faults=+12")->second, ParameterValue(std::int64_t{12}));
  EXPECT_EQ(parseAssignment(kTable, "faults=1e3")->second, ParameterValue(1000.0));
  EXPECT_EQ(parseAssignment(kTable, "wrap=true")->second, ParameterValue(true));
  EXPECT_EQ(parseAssignment(kTable, "wrap=0")->second, ParameterValue(false));
  EXPECT_EQ(parseAssignment(kTable, "rule=a=b")->second, ParameterValue(std::string("a=b")));
}

TEST(ParseAssignment, KeepsTheTextOfANameItDoesNotKnow) {
  const Result<Values::Entry> entry = parseAssignment(kTable, "height=7");
  ASSERT_TRUE(entry.ok());
  EXPECT_EQ(entry->first, "height");
  EXPECT_EQ(entry->second, ParameterValue(std::string("7")));
}

TEST(ParseAssignment, KeepsTheLastDigitOfALongInteger) {
  EXPECT_EQ(parseAssignment(kTable, "faults=9007199254740993")->second,
            ParameterValue(std::int64_t{9007199254740993}));
}

TEST(ParseAssignment, RefusesWhatIsNoAssignment) {
  for (const char* text : {"", "=", "=3", "hurst", "hurst=", "hurst=abc", "hurst=1 ", "hurst=nan",
                           "faults=", "faults=0x10", "faults=+-3", "wrap=yes", "wrap="}) {
    EXPECT_FALSE(parseAssignment(kTable, text).ok()) << text;
  }
}

TEST(ParseNumber, ReadsWhatAPersonCallsANumber) {
  EXPECT_EQ(parseNumber("-.5").value(), -0.5);
  EXPECT_EQ(parseNumber("+2").value(), 2.0);
  EXPECT_EQ(parseNumber("1e3").value(), 1000.0);
  EXPECT_EQ(parseNumber("5.").value(), 5.0);
  EXPECT_EQ(parseNumber("+.25E-2").value(), 0.0025);
  EXPECT_TRUE(std::signbit(parseNumber("-0").value()));
}

TEST(ParseNumber, RefusesEverythingElse) {
  for (const char* text :
       {"",   "+",  "-",   ".",    "+-2", "-+2",  "--2",      "++2",   " 1",     "1 ", "1,5", "0x10",
        "1e", "e3", "nan", "-nan", "inf", "+inf", "infinity", "1e999", "-1e999", "1f", "one"}) {
    EXPECT_FALSE(parseNumber(text).ok()) << text;
  }
  EXPECT_FALSE(parseNumber(std::string_view("1\0", 2)).ok());
}

TEST(NumberText, ReadsBackAsTheSameBits) {
  RandomSequence random(20240607);
  int tried = 0;
  for (int k = 0; k < 20000; ++k) {
    const double value = std::bit_cast<double>(random.next());
    if (!std::isfinite(value)) continue;
    const Result<double> back = parseNumber(numberText(value));
    ASSERT_TRUE(back.ok()) << numberText(value);
    ASSERT_EQ(std::bit_cast<std::uint64_t>(back.value()), std::bit_cast<std::uint64_t>(value));
    ++tried;
  }
  EXPECT_GT(tried, 19000);
}

TEST(NumberText, IsTheShortest) {
  EXPECT_EQ(numberText(0.1), "0.1");
  EXPECT_EQ(numberText(150.0), "150");
  EXPECT_EQ(numberText(-0.0), "-0");
  EXPECT_EQ(numberText(1e22), "1e+22");
}

}  // namespace
}  // namespace teren
