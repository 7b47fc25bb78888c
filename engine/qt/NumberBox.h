// A spin box for the numbers of parameter tables: any normal double inside a range, exactly as it is.
#pragma once

#include <QDoubleSpinBox>
#include <QString>

#include "teren/Parameter.h"

namespace teren {

/// Shows a number as the shortest decimal text that reads back as the same double, in any locale with a
/// point, and takes what teren::parseNumber takes. What is typed counts when it is finished; what is no
/// number or out of range goes back to the number before. A step is a tenth of the number's leading decimal
/// place; from zero, a hundredth of the range's. Subnormal numbers become zero.
class NumberBox : public QDoubleSpinBox {
  Q_OBJECT

 public:
  /// For a real or integer parameter; it starts with the default.
  explicit NumberBox(const Parameter& parameter, QWidget* parent = nullptr);

  QString textFromValue(double value) const override;
  double valueFromText(const QString& text) const override;
  QValidator::State validate(QString& text, int& position) const override;
  void stepBy(int steps) override;

 private:
  /// Without the unit.
  QString bare(const QString& text) const;

  bool integer_;
  double stepFromZero_;
};

}  // namespace teren
