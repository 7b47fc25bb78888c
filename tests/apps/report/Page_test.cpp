// The page stands alone and says what it was given.
#include "apps/report/Page.h"

#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "apps/report/Report.h"

namespace teren {
namespace {

Page sample(const Table& table) {
  return {"A <title>",
          {"A fact & more."},
          {{"One", "With a table.", &table, {"<svg id='x'></svg>"}}, {"Two", "Without.", nullptr, {}}},
          {{"kernel", "smooth", "Where::blend", "Because 1 < 2.", true},
           {"budget", "2 ms", "W", "No.", false},
           {"other", "3", "W", "Who knows.", std::nullopt}}};
}

TEST(ReportPage, HoldsFactsTablesPicturesAndDefaults) {
  Table table("t", "T", "D", {{"c", "m", "doc"}});
  table.add({42.5});
  const std::string html = htmlOf(sample(table));
  for (const char* part : {"<!DOCTYPE html>", "<title>A &lt;title&gt;</title>", "A fact &amp; more.",
                           "<td>42.5</td>", "<svg id='x'></svg>", "Without.", "Because 1 &lt; 2.",
                           "<code>Where::blend</code>", "is what this run justifies",
                           "is not what this run justifies", "This run has not measured it", "</html>"}) {
    EXPECT_NE(html.find(part), std::string::npos) << part;
  }
  EXPECT_LT(html.find("smooth"), html.find("is not what"));
}

TEST(ReportPage, FetchesNothing) {
  Table table("t", "T", "D", {{"c", "m", "doc"}});
  const std::string html = htmlOf(sample(table));
  for (const char* part : {"<script", "<link", "<img", "@import", "src=", "http"}) {
    EXPECT_EQ(html.find(part), std::string::npos) << part;
  }
}

}  // namespace
}  // namespace teren
