#include "qt/ParameterPanel.h"

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include <QCheckBox>
#include <QComboBox>
#include <QLineEdit>
#include <QSignalSpy>
#include <QTest>
#include <gtest/gtest.h>

#include "qt/NumberBox.h"

namespace teren {
namespace {

constexpr std::array<std::string_view, 2> kRules{"corrected", "published"};
constexpr std::array<Parameter, 6> kTable{
    Parameter::real("deviation", 4.0, 0.0, 10'000.0, "m", "standard deviation of the result"),
    Parameter::real("frequency", 1.0 / 3.0, 1e-9, 1e3, "1/m", "of the first octave"),
    Parameter::integer("faults", 150, 1, std::int64_t{1} << 53, "", "how many"),
    Parameter::boolean("closed", true, "whether it is"),
    Parameter::choice("rule", "corrected", kRules, "which rule"),
    Parameter::text("matrix", "1 2 1", 20, "its elements"),
};

PluginInfo pluginWithEveryType() {
  PluginInfo plugin;
  plugin.id = "every-type";
  plugin.parameters = kTable;
  return plugin;
}

class ParameterPanelTest : public testing::Test {
 protected:
  template <class Field>
  Field& field(const char* name) {
    Field* found = panel_.findChild<Field*>(QString::fromLatin1(name));
    EXPECT_NE(found, nullptr) << name;
    return *found;
  }
  /// Marks what a field shows, types and finishes.
  void type(QWidget& field, const QString& text) {
    field.setFocus();
    QTest::keyClick(&field, Qt::Key_A, Qt::ControlModifier);
    QTest::keyClicks(&field, text);
    QTest::keyClick(&field, Qt::Key_Return);
  }
  ParameterValue value(std::string_view name) const {
    for (const Values::Entry& entry : panel_.values()) {
      if (entry.first == name) return entry.second;
    }
    ADD_FAILURE() << name;
    return false;
  }

  PluginInfo plugin_ = pluginWithEveryType();
  ParameterPanel panel_{plugin_};
  QSignalSpy changes_{&panel_, &ParameterPanel::valuesChanged};
  QSignalSpy refusals_{&panel_, &ParameterPanel::refused};
};

TEST_F(ParameterPanelTest, HasARowForEachParameterOfTheTable) {
  const std::vector<Values::Entry> values = panel_.values();
  ASSERT_EQ(values.size(), kTable.size());
  for (std::size_t n = 0; n < kTable.size(); ++n) {
    EXPECT_EQ(values[n].first, kTable[n].name);
    EXPECT_EQ(values[n].second, kTable[n].defaultValue()) << kTable[n].name;
    EXPECT_EQ(field<QWidget>(values[n].first.c_str()).toolTip().toStdString(), kTable[n].doc);
  }
  EXPECT_TRUE(Values::check(kTable, values, "every-type").ok());
  EXPECT_EQ(field<NumberBox>("deviation").text(), QStringLiteral("4 m"));
}

TEST_F(ParameterPanelTest, GivesBackEveryNumberExactly) {
  for (const double number : {0.1, 1e-9, 1e3, 123.456789012345678, 2.2250738585072014e-3}) {
    const Values::Entry entry{"frequency", number};
    ASSERT_TRUE(panel_.setValues(std::span(&entry, 1)).ok());
    EXPECT_EQ(std::get<double>(value("frequency")), number);
  }
  const Values::Entry entry{"faults", (std::int64_t{1} << 53) - 1};
  ASSERT_TRUE(panel_.setValues(std::span(&entry, 1)).ok());
  EXPECT_EQ(std::get<std::int64_t>(value("faults")), (std::int64_t{1} << 53) - 1);
  EXPECT_EQ(changes_.count(), 0) << "only a person's changes are told";
}

TEST_F(ParameterPanelTest, TakesWhatIsTyped) {
  type(field<NumberBox>("deviation"), QStringLiteral("12.5"));
  EXPECT_EQ(std::get<double>(value("deviation")), 12.5);
  EXPECT_EQ(changes_.count(), 1);
  type(field<NumberBox>("faults"), QStringLiteral("7"));
  EXPECT_EQ(std::get<std::int64_t>(value("faults")), 7);
  field<QCheckBox>("closed").click();
  EXPECT_FALSE(std::get<bool>(value("closed")));
  field<QComboBox>("rule").setCurrentIndex(1);
  EXPECT_EQ(std::get<std::string>(value("rule")), "published");
  type(field<QLineEdit>("matrix"), QStringLiteral("1 1 1"));
  EXPECT_EQ(std::get<std::string>(value("matrix")), "1 1 1");
  EXPECT_EQ(changes_.count(), 5);
  EXPECT_EQ(refusals_.count(), 0);
}

TEST_F(ParameterPanelTest, LetsNothingInThatTheTableForbids) {
  const QString megabyte(1 << 20, QLatin1Char('9'));
  for (const QString& hostile : {QStringLiteral("nan"), QStringLiteral("inf"), QStringLiteral("-1"),
                                 QStringLiteral("1e300"), QStringLiteral("many"), QStringLiteral("")}) {
    type(field<NumberBox>("deviation"), hostile);
    EXPECT_EQ(std::get<double>(value("deviation")), 4.0) << hostile.toStdString();
  }
  type(field<NumberBox>("faults"), QStringLiteral("2.5"));
  EXPECT_EQ(std::get<std::int64_t>(value("faults")), 150);
  auto* edit = field<NumberBox>("deviation").findChild<QLineEdit*>();
  ASSERT_NE(edit, nullptr);
  edit->selectAll();
  edit->insert(megabyte);
  QTest::keyClick(&field<NumberBox>("deviation"), Qt::Key_Return);
  EXPECT_EQ(std::get<double>(value("deviation")), 4.0);

  field<QLineEdit>("matrix").selectAll();
  field<QLineEdit>("matrix").insert(megabyte);
  QTest::keyClick(&field<QLineEdit>("matrix"), Qt::Key_Return);
  const std::vector<Values::Entry> values = panel_.values();
  EXPECT_TRUE(Values::check(kTable, values, "every-type").ok());

  // 20 characters, but 40 bytes.
  const std::string before = std::get<std::string>(value("matrix"));
  field<QLineEdit>("matrix").setText(QString(20, QChar(0x00E4)));
  QTest::keyClick(&field<QLineEdit>("matrix"), Qt::Key_Return);
  EXPECT_EQ(std::get<std::string>(value("matrix")), before);
  EXPECT_EQ(field<QLineEdit>("matrix").text().toStdString(), before);
  ASSERT_EQ(refusals_.count(), 1);
  EXPECT_NE(refusals_.front().front().toString().toStdString().find("\"matrix\""), std::string::npos);
}

TEST_F(ParameterPanelTest, KeepsTheBytesOfATextThatIsNoUtf8) {
  const Values::Entry entry{"matrix", std::string(20, '\xff')};
  ASSERT_TRUE(panel_.setValues(std::span(&entry, 1)).ok());
  EXPECT_EQ(std::get<std::string>(value("matrix")), std::string(20, '\xff'));
  QTest::keyClick(&field<QLineEdit>("matrix"), Qt::Key_Return);
  EXPECT_EQ(std::get<std::string>(value("matrix")), std::string(20, '\xff')) << "nobody has typed";
  EXPECT_EQ(changes_.count() + refusals_.count(), 0);
}

TEST_F(ParameterPanelTest, RefusesBadValuesOfAProgramAndStaysAsItWas) {
  field<QCheckBox>("closed").click();
  const std::vector<Values::Entry> before = panel_.values();
  const std::vector<std::vector<Values::Entry>> bad = {
      {{"deviation", std::numeric_limits<double>::quiet_NaN()}},
      {{"faults", std::int64_t{3}}, {"deviation", -1.0}},
      {{"rule", std::string("invented")}},
      {{"matrix", std::string(1 << 20, 'x')}},
      {{"no such", 1.0}},
      {{"deviation", true}},
  };
  for (const std::vector<Values::Entry>& entries : bad) {
    EXPECT_FALSE(panel_.setValues(entries).ok()) << entries.back().first;
    EXPECT_EQ(panel_.values(), before);
  }
}

TEST_F(ParameterPanelTest, StepsByATenthOfTheLeadingPlace) {
  auto& deviation = field<NumberBox>("deviation");
  for (int n = 0; n < 3; ++n) deviation.stepBy(1);
  EXPECT_EQ(deviation.value(), 4.3);
  deviation.setValue(0.0);
  deviation.stepBy(1);
  EXPECT_GT(deviation.value(), 0.0);
  auto& faults = field<NumberBox>("faults");
  faults.stepBy(-1);
  EXPECT_EQ(faults.value(), 140.0);
  faults.setValue(1.0);
  faults.stepBy(-1);
  EXPECT_EQ(faults.value(), 1.0) << "the range's end";
}

}  // namespace
}  // namespace teren
