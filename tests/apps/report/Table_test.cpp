// The table model as a file and as HTML.
#include "apps/report/Table.h"

#include <limits>
#include <string>

#include <gtest/gtest.h>

namespace teren {
namespace {

Table sample() {
  Table table("name", "Title", "Doc", {{"who", "", "a text"}, {"how long", "ms", "a <time> & \"more\""}});
  table.add({std::string("plain"), 0.25});
  table.add({std::string("a, \"b\"\nc"), 1234567.0});
  table.add({std::string("<script>"), Cell()});
  return table;
}

TEST(Table, IsWrittenAsCommaSeparatedLines) {
  EXPECT_EQ(csvOf(sample()),
            "who,how long [ms]\n"
            "plain,0.25\n"
            "\"a, \"\"b\"\"\nc\",1234567\n"
            "<script>,\n");
}

TEST(Table, LetsNoTextBecomeMarkup) {
  const std::string html = htmlOf(sample());
  EXPECT_EQ(html.find("<script>"), std::string::npos);
  EXPECT_NE(html.find("&lt;script&gt;"), std::string::npos);
  EXPECT_EQ(html.find("<time>"), std::string::npos);
  EXPECT_NE(html.find("title=\"a &lt;time&gt; &amp; &quot;more&quot;\""), std::string::npos) << html;
  EXPECT_EQ(escapedForHtml("<a href='x\">&amp;"), "&lt;a href=&#39;x&quot;&gt;&amp;amp;");
  EXPECT_EQ(escapedForHtml("M\xC3\xBCnchen"), "M\xC3\xBCnchen");
}

TEST(Table, HasARowForEachRowAndACellForEachColumn) {
  const std::string html = htmlOf(sample());
  const auto count = [&html](const std::string& what) {
    std::size_t found = 0;
    for (std::size_t at = html.find(what); at != std::string::npos; at = html.find(what, at + 1)) ++found;
    return found;
  };
  EXPECT_EQ(count("<tr>"), 4U);
  EXPECT_EQ(count("</tr>"), 4U);
  EXPECT_EQ(count("<td"), 6U);
  EXPECT_EQ(count("<th title"), 2U);
}

TEST(Table, TellsCellsByTheNamesOfTheirColumns) {
  const Table table = sample();
  EXPECT_EQ(table.number(0, "how long"), 0.25);
  EXPECT_EQ(table.number(2, "how long"), 0.0);
  EXPECT_EQ(table.text(0, "who"), "plain");
  EXPECT_EQ(table.text(0, "how long"), "0.25");
}

TEST(Table, RoundsNumbersToDigitsAndKeepsWholeOnesReadable) {
  EXPECT_EQ(rounded(0.0, 4), "0");
  EXPECT_EQ(rounded(-0.0, 4), "0");
  EXPECT_EQ(rounded(0.123456, 3), "0.123");
  EXPECT_EQ(rounded(1e-12, 3), "1e-12");
  EXPECT_EQ(rounded(20000.0, 3), "20000");
  EXPECT_EQ(rounded(-3172480.0, 4), "-3172480");
  EXPECT_EQ(rounded(999.6, 3), "1000");
  EXPECT_EQ(rounded(1e300, 3), "1e+300");
}

}  // namespace
}  // namespace teren
