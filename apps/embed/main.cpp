// teren-embed: land in a window, its seed, what its mountains are made with, and the height under the cursor.
#include <QApplication>
#include <QHBoxLayout>
#include <QLabel>
#include <QSpinBox>
#include <QVBoxLayout>

#include "qt/ParameterPanel.h"
#include "qt/TerrainWidget.h"

int main(int count, char** arguments) {
  QApplication application(count, arguments);
  QWidget window;
  window.setWindowTitle(QStringLiteral("Teren"));
  auto* land = new teren::TerrainWidget;
  auto* label = new QLabel;
  auto* seed = new QSpinBox;
  seed->setRange(0, 1'000'000);
  seed->setPrefix(QStringLiteral("seed "));
  auto* row = new QHBoxLayout(&window);
  row->addWidget(land, 1);
  auto* side = new QVBoxLayout;
  row->addLayout(side);
  side->addWidget(seed);

  auto world = teren::WorldDescription::standard();
  auto& mountains = world.layers.front();
  const auto change = [&](auto& part, const auto& value) {
    part = value;
    static_cast<void>(land->setWorld(world));  // the label shows what is wrong
  };
  if (const auto* plugin = teren::PluginRegistry::standard()->find(mountains.generator)) {
    auto* panel = new teren::ParameterPanel(*plugin);
    static_cast<void>(panel->setValues(mountains.parameters));
    QObject::connect(panel, &teren::ParameterPanel::refused, label, &QLabel::setText);
    QObject::connect(panel, &teren::ParameterPanel::valuesChanged, land,
                     [&, panel] { change(mountains.parameters, panel->values()); });
    side->addWidget(panel, 1);
  }
  label->setWordWrap(true);
  side->addWidget(label);
  QObject::connect(land, &teren::TerrainWidget::errorOccurred, label, &QLabel::setText);
  QObject::connect(land, &teren::TerrainWidget::cursorMoved, label, [land, label](const QPoint& point) {
    const auto ground = land->pick(point);
    label->setText(ground ? QStringLiteral("%1 m").arg(ground->height, 0, 'f', 1) : QStringLiteral("sky"));
  });
  QObject::connect(seed, qOverload<int>(&QSpinBox::valueChanged), land,
                   [&](int value) { change(world.seed, static_cast<std::uint64_t>(value)); });
  seed->setValue(42);
  window.show();
  return QApplication::exec();
}
