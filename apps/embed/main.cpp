// teren-embed: the land of a seed in a window, and the height under the cursor.
#include <limits>

#include <QApplication>
#include <QHBoxLayout>
#include <QLabel>
#include <QSpinBox>
#include <QVBoxLayout>

#include "qt/TerrainWidget.h"

int main(int count, char** arguments) {
  QApplication application(count, arguments);
  QWidget window;
  window.setWindowTitle(QStringLiteral("Teren"));
  auto* land = new teren::TerrainWidget;
  auto* seed = new QSpinBox;
  seed->setRange(0, std::numeric_limits<int>::max());
  auto* label = new QLabel;

  auto* row = new QHBoxLayout;
  row->addWidget(new QLabel(QStringLiteral("Seed")));
  row->addWidget(seed);
  row->addWidget(label, 1);
  auto* column = new QVBoxLayout(&window);
  column->addWidget(land, 1);
  column->addLayout(row);

  QObject::connect(land, &teren::TerrainWidget::errorOccurred, label, &QLabel::setText);
  QObject::connect(land, &teren::TerrainWidget::cursorMoved, label, [land, label](const QPoint& point) {
    const auto ground = land->pick(point);
    label->setText(ground ? QStringLiteral("%1 m").arg(ground->height, 0, 'f', 1) : QStringLiteral("sky"));
  });
  QObject::connect(seed, qOverload<int>(&QSpinBox::valueChanged), land, [land](int value) {
    auto world = teren::WorldDescription::standard();
    world.seed = static_cast<std::uint64_t>(value);
    static_cast<void>(land->setWorld(world));  // the label shows what is wrong
  });
  seed->setValue(42);
  window.show();
  return QApplication::exec();
}
