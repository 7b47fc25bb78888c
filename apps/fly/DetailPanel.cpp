#include "apps/fly/DetailPanel.h"

#include <utility>

#include <QFontMetrics>
#include <QHBoxLayout>

#include "teren/Parameter.h"

#include "apps/fly/Steps.h"

namespace teren {
namespace {

/// Moves it without an action.
void put(QSlider& slider, int index) {
  const bool before = slider.blockSignals(true);
  slider.setValue(index);
  slider.blockSignals(before);
}

QString kilometres(double metres) {
  return QString::fromStdString(numberText(metres / 1e3)) + QStringLiteral(" km");
}

QString pixels(double error) {
  return QString::fromStdString(numberText(error)) + QStringLiteral(" px");
}

}  // namespace

DetailPanel::DetailPanel(Actions actions, QWidget* parent) : QWidget(parent) {
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(10, 4, 10, 4);
  distance_ = add("distance", "view distance", Steps::distances().count(), distanceText_);
  pixelError_ = add("pixelError", "pixel error", Steps::pixelErrors().count(), pixelErrorText_);
  connect(distance_, &QSlider::valueChanged, this,
          [act = std::move(actions.setDistance)](int index) { act(Steps::distances().at(index)); });
  connect(pixelError_, &QSlider::valueChanged, this,
          [act = std::move(actions.setPixelError)](int index) { act(Steps::pixelErrors().at(index)); });
  setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
}

QSlider* DetailPanel::add(const char* name, const char* text, int steps, QLabel*& value) {
  auto* slider = new QSlider(Qt::Horizontal, this);
  slider->setObjectName(QString::fromLatin1(name));
  slider->setRange(0, steps - 1);
  slider->setPageStep(1);
  slider->setTickPosition(QSlider::TicksBelow);
  slider->setFocusPolicy(Qt::NoFocus);  // the keys stay the flight's
  value = new QLabel(this);
  value->setObjectName(QString::fromLatin1(name) + QStringLiteral("Value"));
  value->setMinimumWidth(value->fontMetrics().horizontalAdvance(QStringLiteral("0000.0 px")));
  layout()->addWidget(new QLabel(QString::fromLatin1(text), this));
  layout()->addWidget(slider);
  layout()->addWidget(value);
  return slider;
}

void DetailPanel::showDetail(const std::optional<DetailSettings>& detail) {
  setEnabled(detail.has_value());
  if (!detail) {
    distanceText_->setText(QStringLiteral("one level"));
    pixelErrorText_->setText(QStringLiteral("any"));
    return;
  }
  put(*distance_, Steps::distances().nearest(detail->distance));
  put(*pixelError_, Steps::pixelErrors().nearest(detail->pixelError));
  distanceText_->setText(kilometres(detail->distance));
  pixelErrorText_->setText(pixels(detail->pixelError));
}

}  // namespace teren
