#include "plugin/TableCheck.h"

#include <array>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace teren {
namespace {

constexpr std::array<std::string_view, 2> kGood = {"one", "two"};
constexpr std::array<std::string_view, 2> kTwice = {"one", "one"};

std::string refusal(const Parameter& row) {
  const Result<void> checked = checkTable({&row, 1});
  return checked ? std::string() : checked.error().message;
}

TEST(TableCheck, AcceptsEveryKindOfRow) {
  const std::array table = {Parameter::real("a", 0.0, -1.0, 1.0, "m", ""),
                            Parameter::integer("b-2", 5, 5, 5, "", ""), Parameter::boolean("c_d", true, ""),
                            Parameter::choice("E", "two", kGood, ""), Parameter::text("F", "", 65536, "")};
  EXPECT_TRUE(checkTable(table).ok());
  EXPECT_TRUE(checkTable({}).ok());
}

TEST(TableCheck, RefusesOddNames) {
  for (const char* name : {"", "1a", "-a", "a b", "a=b", "h\xc3\xb6he"}) {
    EXPECT_NE(refusal(Parameter::real(name, 0.0, 0.0, 1.0, "", "")), "") << name;
  }
}

TEST(TableCheck, RefusesNamesThatAreThereTwice) {
  const std::array table = {Parameter::boolean("a", true, ""), Parameter::boolean("b", true, ""),
                            Parameter::boolean("a", true, "")};
  const Result<void> checked = checkTable(table);
  ASSERT_FALSE(checked.ok());
  EXPECT_EQ(checked.error().message, "parameter \"a\" is in the table twice");
}

TEST(TableCheck, RefusesRangesAndDefaultsThatCannotBe) {
  const double infinity = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refusal(Parameter::real("a", 0.0, 1.0, -1.0, "", "")), "");
  EXPECT_NE(refusal(Parameter::real("a", 0.0, -infinity, 1.0, "", "")), "");
  EXPECT_NE(refusal(Parameter::real("a", 0.0, nan, 1.0, "", "")), "");
  EXPECT_NE(refusal(Parameter::real("a", nan, 0.0, 1.0, "", "")), "");
  EXPECT_EQ(refusal(Parameter::real("a", 2.0, 0.0, 1.0, "", "")),
            "the default 2 of parameter \"a\" is outside the range 0 to 1");
  EXPECT_NE(refusal(Parameter::integer("a", 0, 0, std::int64_t{1} << 60, "", "")), "");
  Parameter half = Parameter::integer("a", 0, 0, 1, "", "");
  half.defaultNumber = 0.5;
  EXPECT_NE(refusal(half), "");
  half = Parameter::boolean("a", true, "");
  half.defaultNumber = 0.5;
  EXPECT_NE(refusal(half), "");
}

TEST(TableCheck, RefusesChoicesThatCannotBe) {
  EXPECT_NE(refusal(Parameter::choice("a", "", {}, "")), "");
  EXPECT_NE(refusal(Parameter::choice("a", "three", kGood, "")), "");
  EXPECT_NE(refusal(Parameter::choice("a", "one", kTwice, "")), "");
}

TEST(TableCheck, RefusesNullPointersThatClaimALength) {
  const std::string_view nowhere(nullptr, 5);
  const std::array<std::string_view, 2> choices = {"one", nowhere};
  EXPECT_NE(refusal(Parameter::real(nowhere, 0.0, 0.0, 1.0, "", "")), "");
  EXPECT_NE(refusal(Parameter::real("a", 0.0, 0.0, 1.0, nowhere, "")), "");
  EXPECT_NE(refusal(Parameter::real("a", 0.0, 0.0, 1.0, "", nowhere)), "");
  EXPECT_NE(refusal(Parameter::choice("a", "one", choices, "")), "");
  EXPECT_NE(refusal(Parameter::choice("a", nowhere, kGood, "")), "");
  EXPECT_NE(refusal(Parameter::text("a", nowhere, 10, "")), "");
  EXPECT_NE(refusal(Parameter::choice("a", "", {static_cast<const std::string_view*>(nullptr), 2}, "")), "");
  EXPECT_FALSE(checkTable({static_cast<const Parameter*>(nullptr), 1}).ok());
}

TEST(TableCheck, RefusesTextsThatNoSentenceCouldHold) {
  const std::string huge(100'000, 'a');
  const std::array<std::string_view, 2> lines = {"one", "two\nlines"};
  const std::vector<std::string_view> many(kMostChoices + 1, "one");
  EXPECT_NE(refusal(Parameter::real(huge, 0.0, 0.0, 1.0, "", "")), "");
  EXPECT_NE(refusal(Parameter::real("a", 0.0, 0.0, 1.0, "m\x1b[31m", "")), "");
  EXPECT_NE(refusal(Parameter::real("a", 0.0, 0.0, 1.0, "", "two\nlines")), "");
  EXPECT_NE(refusal(Parameter::real("a", 0.0, 0.0, 1.0, "", huge)), "");
  EXPECT_NE(refusal(Parameter::real("a", 0.0, 0.0, 1.0, "", "\xff")), "");
  EXPECT_NE(refusal(Parameter::choice("a", "one", lines, "")), "");
  EXPECT_NE(refusal(Parameter::choice("a", "one", many, "")), "");
}

TEST(TableCheck, RefusesTextsThatCannotBe) {
  EXPECT_NE(refusal(Parameter::text("a", "", 0, "")), "");
  EXPECT_NE(refusal(Parameter::text("a", "", 65537, "")), "");
  EXPECT_NE(refusal(Parameter::text("a", "two", 2, "")), "");
  EXPECT_EQ(refusal(Parameter::text("a", "b\n", 2, "")),
            "the default \"b?\" of parameter \"a\" has more than 2 bytes or a control character");
}

TEST(TableCheck, RefusesUnknownTypesAndEndlessTables) {
  Parameter odd = Parameter::boolean("a", true, "");
  odd.type = static_cast<ParameterType>(77);
  EXPECT_NE(refusal(odd), "");
  const std::vector<Parameter> many(kMostParameters + 1, Parameter::boolean("a", true, ""));
  EXPECT_EQ(checkTable(many).error().message, "the table has 1001 parameters, at most 1000 are allowed");
}

}  // namespace
}  // namespace teren
