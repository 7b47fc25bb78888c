#include "teren/Quote.h"

#include <string>

#include <gtest/gtest.h>

namespace teren {
namespace {

TEST(Quote, LeavesPlainTextAsItIs) {
  EXPECT_EQ(inQuotes("faults=150"), "\"faults=150\"");
  EXPECT_EQ(inQuotes("Gebirge für Ægir 山"), "\"Gebirge für Ægir 山\"");
  EXPECT_EQ(inQuotes(""), "\"\"");
}

TEST(Quote, CutsMegabytesAndSaysSo) {
  const std::string text = shortened(std::string(5'000'000, 'x'));
  EXPECT_EQ(text, std::string(kQuoteBytes, 'x') + "...");
  EXPECT_EQ(shortened(std::string(kQuoteBytes, 'x')), std::string(kQuoteBytes, 'x'));
}

TEST(Quote, CutsBetweenCharacters) {
  const std::string text = shortened(std::string(kQuoteBytes - 1, 'x') + "äöü");
  EXPECT_EQ(text, std::string(kQuoteBytes - 1, 'x') + "...");
}

TEST(Quote, ReplacesWhatWouldBreakALineOrATerminal) {
  EXPECT_EQ(shortened("a\nb\rc\td\x1b[31m\x7f"), "a?b?c?d?[31m?");
  EXPECT_EQ(shortened(std::string("a\0b", 3)), "a?b");
  EXPECT_EQ(shortened("\xc2\x85|\xe2\x80\xa8|\xe2\x80\xa9"),
            "??|???|???");  // NEL, line and paragraph separators
}

TEST(Quote, ReplacesWhatIsNotUtf8) {
  EXPECT_EQ(shortened("\xff\xfe|\xc3|\xe2\x82|\x80"), "??|?|??|?");
  EXPECT_EQ(shortened("\xc0\xaf|\xe0\x80\xaf|\xed\xa0\x80|\xf4\x90\x80\x80"), "??|???|???|????");
}

}  // namespace
}  // namespace teren
