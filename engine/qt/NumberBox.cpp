#include "qt/NumberBox.h"

#include <algorithm>
#include <cfloat>
#include <cmath>

namespace teren {
namespace {

constexpr int kLongestNumber = 400;  // characters; the longest double written out has fewer

/// The power of ten that a positive number begins with.
double leadingPlace(double number) {
  return std::pow(10.0, std::floor(std::log10(number)));
}

}  // namespace

NumberBox::NumberBox(const Parameter& parameter, QWidget* parent)
    : QDoubleSpinBox(parent), integer_(parameter.type == ParameterType::integer) {
  const double width = parameter.max - parameter.min;
  stepFromZero_ = !integer_ && width > 0.0 ? leadingPlace(width) / 100.0 : 1.0;
  setDecimals(integer_ ? 0 : DBL_MAX_10_EXP + DBL_DIG);  // Qt rounds every value to them
  setRange(parameter.min, parameter.max);
  setValue(parameter.defaultNumber);
  if (!parameter.unit.empty()) {
    setSuffix(QLatin1Char(' ') +
              QString::fromUtf8(parameter.unit.data(), static_cast<int>(parameter.unit.size())));
  }
  setKeyboardTracking(false);
}

QString NumberBox::textFromValue(double value) const {
  return QString::fromStdString(numberText(value));
}

QString NumberBox::bare(const QString& text) const {
  const QString cut = !suffix().isEmpty() && text.endsWith(suffix()) ? text.chopped(suffix().size()) : text;
  return cut.trimmed();
}

double NumberBox::valueFromText(const QString& text) const {
  const Result<double> number = parseNumber(bare(text).toStdString());
  return number ? *number : value();
}

QValidator::State NumberBox::validate(QString& text, int& /*position*/) const {
  if (text.size() > kLongestNumber) return QValidator::Invalid;
  const Result<double> number = parseNumber(bare(text).toStdString());
  // "-" or "1e" may still become a number.
  if (!number || *number < minimum() || *number > maximum()) return QValidator::Intermediate;
  return !integer_ || *number == std::floor(*number) ? QValidator::Acceptable : QValidator::Intermediate;
}

void NumberBox::stepBy(int steps) {
  const double own = value() == 0.0 ? stepFromZero_ : leadingPlace(std::fabs(value())) / 10.0;
  const double step = integer_ ? std::max(1.0, std::floor(own)) : own;
  // Rounded to 12 digits, so that three tenths are 0.3 and not the sum of three doubles.
  setValue(QString::number((std::round(value() / step) + steps) * step, 'g', 12).toDouble());
}

}  // namespace teren
