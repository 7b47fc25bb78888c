#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Edit.h"
#include "teren/Hash.h"

namespace teren {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Edit plainEdit() {
  return {"crater", -0.1, 70368744177664.25, 3.0, 12.5, -2.0, 18446744073709551615U, 60, {}};
}

std::string complaintAbout(std::string_view line) {
  const Result<Edit> edit = parseEdit(line);
  return edit ? "no complaint" : edit.error().message;
}

TEST(EditText, IsTheLineThatTheIssueFixed) {
  Edit edit = plainEdit();
  edit.parameters = {
      {"rim", 0.25}, {"rays", std::int64_t{7}}, {"glassy", true}, {"rule", std::string("published")}};
  EXPECT_EQ(
      editText(edit),
      "stamp crater -0.1 70368744177664.25 3 12.5 -2 18446744073709551615 60 rim=0.25 rays=7 glassy=true "
      "rule=published");
}

TEST(EditText, ReadsBackEveryEditBitForBit) {
  RandomSequence random(20261122);
  const auto anyDouble = [&](double most) {
    const double value = std::bit_cast<double>(random.next());
    return std::isfinite(value) && std::fabs(value) <= most ? value : -0.0;
  };
  constexpr std::string_view kLetters = "ab \"\\#=,.-+0159etrufnil\xC3\xA9";
  for (int round = 0; round < 20'000; ++round) {
    Edit edit;
    edit.kind = "k-" + std::to_string(round);
    edit.x = anyDouble(std::numeric_limits<double>::max());
    edit.y = anyDouble(std::numeric_limits<double>::max());
    edit.z = anyDouble(kMostEditMetres);
    edit.size = std::max(std::fabs(anyDouble(kMostEditMetres)), std::numeric_limits<double>::denorm_min());
    edit.depth = anyDouble(kMostEditMetres);
    edit.seed = random.next();
    edit.steps = random.next() % (kMostEditSteps + 1);
    std::string text;
    for (auto left = random.nextBits(4); left > 0; --left) text += kLetters[random.next() % kLetters.size()];
    edit.parameters = {{"text", text},
                       {"whole", static_cast<std::int64_t>(random.next())},
                       {"truth", random.nextBits(1) == 1},
                       {"real", anyDouble(std::numeric_limits<double>::max()) * 0.3}};
    ASSERT_TRUE(checkEdit(edit)) << checkEdit(edit).error().message;
    const std::string line = editText(edit);
    const Result<Edit> read = parseEdit(line);
    ASSERT_TRUE(read) << line << ": " << read.error().message;
    EXPECT_EQ(editText(*read), line);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(read->x), std::bit_cast<std::uint64_t>(edit.x));
    EXPECT_EQ(std::bit_cast<std::uint64_t>(read->depth), std::bit_cast<std::uint64_t>(edit.depth));
    const auto* real = std::get_if<double>(&edit.parameters[3].second);
    if (std::floor(*real) == *real) edit.parameters.pop_back();  // may come back as the same whole number
    Edit other = *read;
    other.parameters.resize(edit.parameters.size());
    EXPECT_EQ(other, edit) << line;
  }
}

TEST(EditText, TellsTextsFromNumbersAndTruthByTheirQuotationMarks) {
  const Result<Edit> edit = parseEdit(
      "stamp k 1 2 3 4 5 6 7 a=1 b=\"1\" c=true d=\"true\" e=1e3 f=-0 g=x,y h=\"\" i=\"a # \\\" \\\\\"");
  ASSERT_TRUE(edit) << edit.error().message;
  const std::vector<Values::Entry> expected = {
      {"a", std::int64_t{1}},     {"b", std::string("1")},   {"c", true},
      {"d", std::string("true")}, {"e", std::int64_t{1000}}, {"f", -0.0},
      {"g", std::string("x,y")},  {"h", std::string()},      {"i", std::string("a # \" \\")}};
  EXPECT_EQ(edit->parameters, expected);
  EXPECT_TRUE(std::signbit(std::get<double>(edit->parameters[5].second)));
}

TEST(EditText, LeavesOutCommentsAndEmptyLines) {
  const Result<std::vector<Edit>> edits = parseEdits(
      "# a list\n\n  \t\nstamp k 1 2 3 4 5 6 7\r\n\tstamp k 1 2 3 4 5 6 8 # with a comment\nstamp k 1 2 3 4 "
      "5 6 9#\n"
      "stamp k 1 2 3 4 5 6 10 a=b#c",
      "list");
  ASSERT_TRUE(edits) << edits.error().message;
  ASSERT_EQ(edits->size(), 4U);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ((*edits)[k].steps, 7 + k);
  EXPECT_EQ((*edits)[3].parameters, (std::vector<Values::Entry>{{"a", std::string("b")}}));
}

TEST(EditText, RefusesWhatIsNoEditNamingFieldValueAndExpectation) {
  const std::string form = "expected stamp KIND X Y Z SIZE DEPTH SEED STEPS [NAME=VALUE]...";
  EXPECT_EQ(complaintAbout("dig k 1 2 3 4 5 6 7"), "the line begins with \"dig\", " + form);
  EXPECT_EQ(complaintAbout(""), "the line begins with \"\", " + form);
  EXPECT_EQ(complaintAbout("stamp Crater 1 2 3 4 5 6 7"),
            "KIND is \"Crater\" but must be a deformer's id of lower-case letters, digits and '-'");
  EXPECT_EQ(complaintAbout("stamp k nan 2 3 4 5 6 7"), "X is \"nan\" but must be a finite number of metres");
  EXPECT_EQ(complaintAbout("stamp k 1 1e999 3 4 5 6 7"),
            "Y is \"1e999\" but must be a finite number of metres");
  EXPECT_EQ(complaintAbout("stamp k 1 2 -inf 4 5 6 7"),
            "Z is \"-inf\" but must be a number of metres from -1e+06 to 1e+06");
  EXPECT_EQ(complaintAbout("stamp k 1 2 3 0 5 6 7"),
            "SIZE is \"0\" but must be a number of metres above 0 and up to 1e+06");
  EXPECT_EQ(complaintAbout("stamp k 1 2 3 4 1000001 6 7"),
            "DEPTH is \"1000001\" but must be a number of metres from -1e+06 to 1e+06");
  EXPECT_EQ(complaintAbout("stamp k 1 2 3 4 5 -6 7"),
            "SEED is \"-6\" but must be a whole number from 0 to 18446744073709551615");
  EXPECT_EQ(complaintAbout("stamp k 1 2 3 4 5 18446744073709551616 7"),
            "SEED is \"18446744073709551616\" but must be a whole number from 0 to 18446744073709551615");
  EXPECT_EQ(complaintAbout("stamp k 1 2 3 4 5 6 1000001"),
            "STEPS is \"1000001\" but must be a whole number from 0 to 1000000");
  EXPECT_EQ(complaintAbout("stamp k 1 2 3 4 5 6"),
            "STEPS is \"\" but must be a whole number from 0 to 1000000");
  EXPECT_EQ(complaintAbout("stamp k 1 2 3 4 5 6 7 8"), "\"8\" stands where NAME=VALUE was expected");
  EXPECT_EQ(complaintAbout("stamp k 1 2 3 4 5 6 7 =8"),
            "\"\" is no parameter's name, which begins with a letter and has letters, digits, '-' and '_'");
  EXPECT_EQ(complaintAbout("stamp k 1 2 3 4 5 6 7 a="), "\"a\" has no value after the '='");
  EXPECT_EQ(complaintAbout("stamp k 1 2 3 4 5 6 7 a=1 b=2 a=3"),
            "the parameter \"a\" is there twice, expected each name once");
  EXPECT_EQ(complaintAbout("stamp k 1 2 3 4 5 6 7 a=\"b"), "the text of a has no quotation mark at its end");
  EXPECT_EQ(complaintAbout("stamp k 1 2 3 4 5 6 7 a=\"b\"c"),
            "something follows the text of a without a space");
  EXPECT_EQ(complaintAbout("stamp k 1 2 3 4 5 6 7 a=b\"c"),
            "a has a quotation mark in \"b\"c\", expected it at both ends or not at all");
  EXPECT_EQ(complaintAbout("stamp k 1 2 3 4 5 6 7 a=\"\\n\""),
            "a has a '\\' that neither '\"' nor '\\' follows");
  EXPECT_EQ(complaintAbout("stamp k 1 2 3 4 5 6 7 a=\x1b[2J"),
            "the line \"stamp k 1 2 3 4 5 6 7 a=?[2J\" has control characters");
  EXPECT_EQ(complaintAbout(std::string("stamp k 1 2 3 4 5 6 7 a=\0", 25)),
            "the line \"stamp k 1 2 3 4 5 6 7 a=?\" has control characters");
  EXPECT_EQ(complaintAbout("stamp k 1 2 3 4 5 6 7 a=" + std::string(kMostEditBytes, 'x')),
            "the edit is longer than 65536 bytes");
}

TEST(EditText, NamesTheFileAndTheLine) {
  const Result<std::vector<Edit>> edits =
      parseEdits("# one\nstamp k 1 2 3 4 5 6 7\nstamp k x 2 3 4 5 6 7\n", "my.txt");
  ASSERT_FALSE(edits);
  EXPECT_EQ(edits.error().message, "my.txt, line 3: X is \"x\" but must be a finite number of metres");
}

TEST(EditText, ThatAProgramMakesIsCheckedLikeOneThatIsRead) {
  const auto refused = [](auto change) {
    Edit edit = plainEdit();
    change(edit);
    return !checkEdit(edit);
  };
  EXPECT_TRUE(checkEdit(plainEdit()));
  for (const double value : {kNan, kInfinity, -kInfinity}) {
    EXPECT_TRUE(refused([&](Edit& edit) { edit.x = value; }));
    EXPECT_TRUE(refused([&](Edit& edit) { edit.y = value; }));
    EXPECT_TRUE(refused([&](Edit& edit) { edit.z = value; }));
    EXPECT_TRUE(refused([&](Edit& edit) { edit.size = value; }));
    EXPECT_TRUE(refused([&](Edit& edit) { edit.depth = value; }));
    EXPECT_TRUE(refused([&](Edit& edit) { edit.parameters = {{"a", value}}; }));
  }
  EXPECT_TRUE(refused([](Edit& edit) { edit.kind = "two words"; }));
  EXPECT_TRUE(refused([](Edit& edit) { edit.size = -1.0; }));
  EXPECT_TRUE(refused([](Edit& edit) { edit.steps = kMostEditSteps + 1; }));
  EXPECT_TRUE(refused([](Edit& edit) { edit.parameters = {{"a b", true}}; }));
  EXPECT_TRUE(refused([](Edit& edit) { edit.parameters = {{"a", std::string("line\nbreak")}}; }));
  EXPECT_TRUE(refused([](Edit& edit) { edit.parameters = {{"a", true}, {"a", true}}; }));
  EXPECT_TRUE(refused([](Edit& edit) { edit.parameters = {{"a", std::string(kMostEditBytes, '"')}}; }));
}

TEST(EditText, TakesATextWithRandomDamageOrRefusesItInOneSentence) {
  const std::string good =
      "stamp crater 12.5 -7 0 3 0.5 42 8 rim=0.25 rule=\"as \\\"published\\\"\" glassy=true # note";
  RandomSequence random(7);
  for (int round = 0; round < 50'000; ++round) {
    std::string line = good;
    for (auto left = random.nextBits(2) + 1; left > 0; --left) {
      const std::size_t at = random.next() % line.size();
      if (random.nextBits(1) == 0) {
        line[at] = static_cast<char>(random.nextBits(8));
      } else {
        line.erase(at, random.next() % 4);
      }
      if (line.empty()) line = " ";
    }
    const Result<Edit> edit = parseEdit(line);
    if (edit) {
      EXPECT_TRUE(checkEdit(*edit));
      const Result<Edit> again = parseEdit(editText(*edit));
      ASSERT_TRUE(again) << again.error().message;
      EXPECT_EQ(editText(*again), editText(*edit));
    } else {
      EXPECT_EQ(edit.error().message.find('\n'), std::string::npos);
      EXPECT_LT(edit.error().message.size(), 400U);
    }
  }
}

TEST(EditText, ReadsAMillionLinesOfOnePlace) {
  std::string text;
  for (int line = 0; line < 1'000'000; ++line) text += "stamp crater 100.5 200.25 0 3 0.5 42 1 rim=0.25\n";
  const Result<std::vector<Edit>> edits = parseEdits(text, "many");
  ASSERT_TRUE(edits) << edits.error().message;
  EXPECT_EQ(edits->size(), 1'000'000U);
  EXPECT_EQ(edits->front(), edits->back());
}

}  // namespace
}  // namespace teren
