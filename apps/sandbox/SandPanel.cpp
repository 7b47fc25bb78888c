#include "apps/sandbox/SandPanel.h"

#include <array>
#include <cstdio>
#include <span>
#include <utility>

#include <QFontDatabase>
#include <QGridLayout>
#include <QPushButton>
#include <QTabWidget>
#include <QVBoxLayout>

#include "apps/sandbox/SandTool.h"

namespace teren {
namespace {

constexpr int kWidth = 260;  // [pixels]

/// A form made of a table.
ParameterPanel* formOf(const char* name, std::span<const Parameter> table, QWidget* parent) {
  PluginInfo info;  // the panel knows tables by the plugins they are of
  info.id = name;
  info.parameters = table;
  auto* form = new ParameterPanel(info, parent);
  form->setObjectName(QString::fromLatin1(name) + QStringLiteral("Form"));
  return form;
}

/// The values a form shows.
Values valuesOf(const ParameterPanel& form, std::span<const Parameter> table) {
  return Values::check(table, form.values(), "panel").value();
}

template <class... Numbers>
std::string line(const char* format, Numbers... numbers) {
  std::array<char, 80> text{};
  std::snprintf(text.data(), text.size(), format, numbers...);
  return text.data();
}

}  // namespace

std::span<const Parameter> sandParameters() noexcept {
  static constexpr Parameter table[] = {
      Parameter::real("repose", 30.0, 1.0, 60.0, "degree", "the angle at which dry sand lies"),
      Parameter::real("moisture", 0.0, 0.0, 1.0, "", "0 is dry, 1 damp: damp sand lies steeper"),
      Parameter::boolean("slides", true, "sand slides where it is steeper than it can lie"),
      Parameter::boolean("wireframe", false, "edges instead of a surface, constrained ones in red"),
  };
  return table;
}

SandPanel::SandPanel(SandPanelActions actions, QWidget* parent)
    : QWidget(parent), actions_(std::move(actions)) {
  setFixedWidth(kWidth);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(4, 4, 4, 4);
  auto* tabs = new QTabWidget(this);
  tabs->addTab(makeHand(), QStringLiteral("Dig"));
  tabs->addTab(makeBeginning(), QStringLiteral("New sand"));
  layout->addWidget(tabs);
  layout->addWidget(makeButtons());
  figures_ = new QLabel(this);
  figures_->setObjectName(QStringLiteral("figures"));
  figures_->setFont(QFontDatabase::systemFont(QFontDatabase::FixedFont));
  layout->addWidget(figures_);
  layout->addStretch();
  sentence_ = new QLabel(this);
  sentence_->setObjectName(QStringLiteral("sentence"));
  sentence_->setTextFormat(Qt::PlainText);
  sentence_->setWordWrap(true);
  layout->addWidget(sentence_);
  progressText_ = new QLabel(this);
  layout->addWidget(progressText_);
  progress_ = new QProgressBar(this);
  progress_->setRange(0, 0);  // nobody knows how far sand will slide
  progress_->setTextVisible(false);
  progress_->setMaximumHeight(6);
  QSizePolicy kept = progress_->sizePolicy();
  kept.setRetainSizeWhenHidden(true);  // else all would jump when work begins
  progress_->setSizePolicy(kept);
  layout->addWidget(progress_);
  showProgress({});
}

QWidget* SandPanel::makeHand() {
  auto* page = new QWidget(this);
  auto* layout = new QVBoxLayout(page);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  tool_ = formOf("tool", SandTool::parameters(), page);
  sand_ = formOf("sand", sandParameters(), page);
  layout->addWidget(tool_);
  layout->addWidget(sand_);
  connect(tool_, &ParameterPanel::valuesChanged, this, [this] {
    toolShown_.clear();  // what is refused must be shown as it was
    actions_.takeTool(valuesOf(*tool_, SandTool::parameters()));
  });
  connect(sand_, &ParameterPanel::valuesChanged, this, [this] {
    sandShown_.clear();
    actions_.setSand(valuesOf(*sand_, sandParameters()));
  });
  connect(tool_, &ParameterPanel::refused, this, [this](const QString& why) { say(why.toStdString()); });
  return page;
}

QWidget* SandPanel::makeBeginning() {
  auto* page = new QWidget(this);
  auto* layout = new QVBoxLayout(page);
  ground_ = formOf("ground", SandGround::parameters(), page);
  layout->addWidget(ground_);
  auto* make = new QPushButton(QStringLiteral("Make new sand"), page);
  make->setObjectName(QStringLiteral("make"));
  connect(make, &QPushButton::clicked, this,
          [this] { actions_.makeNewSand(valuesOf(*ground_, SandGround::parameters())); });
  layout->addWidget(make);
  layout->addStretch();
  return page;
}

QWidget* SandPanel::makeButtons() {
  auto* buttons = new QWidget(this);
  auto* grid = new QGridLayout(buttons);
  grid->setContentsMargins(0, 0, 0, 0);
  const auto add = [&](const char* name, const char* text, int row, int column,
                       const std::function<void()>& act) {
    auto* button = new QPushButton(QString::fromLatin1(text), buttons);
    button->setObjectName(QString::fromLatin1(name));
    button->setFocusPolicy(Qt::NoFocus);  // the keys stay the sand's
    connect(button, &QPushButton::clicked, this, act);
    grid->addWidget(button, row, column);
  };
  add("undo", "Undo", 0, 0, actions_.undo);
  add("redo", "Redo", 0, 1, actions_.redo);
  add("save", "Save...", 1, 0, actions_.save);
  add("load", "Load...", 1, 1, actions_.load);
  add("export", "Export...", 1, 2, actions_.exportObj);
  return buttons;
}

void SandPanel::showTool(const Values& values) {
  show(*tool_, values, toolShown_);
}

void SandPanel::showSand(const Values& values) {
  show(*sand_, values, sandShown_);
}

void SandPanel::show(ParameterPanel& form, const Values& values, std::vector<Values::Entry>& shown) {
  const std::vector<Values::Entry> entries(values.entries().begin(), values.entries().end());
  if (entries == shown) return;
  (void)form.setValues(entries);  // values of its own table are never refused
  shown = entries;
}

void SandPanel::showFigures(const SandFigures& figures, double frameMilliseconds) {
  figures_->setText(QString::fromStdString(figureLines(figures, frameMilliseconds)));
}

void SandPanel::showProgress(const std::string& what) {
  progress_->setVisible(!what.empty());
  progressText_->setText(QString::fromStdString(what));
}

void SandPanel::say(const std::string& sentence) {
  sentence_->setText(QString::fromStdString(sentence));
}

std::string figureLines(const SandFigures& figures, double frameMilliseconds) {
  const double perVertex = figures.vertices == 0
                               ? 0.0
                               : static_cast<double>(figures.bytes) / static_cast<double>(figures.vertices);
  return line("vertices    %12zu\n", figures.vertices) + line("triangles   %12zu\n", figures.triangles) +
         line("constrained %12zu\n", figures.constraints) +
         line("memory     %9.1f MiB\n", static_cast<double>(figures.bytes) / 0x1p20) +
         line("a vertex      %8.1f B\n", perVertex) +
         line("location   %9.3f ms\n", 1e3 * figures.stamp.insertion) +
         line("constraint %9.3f ms\n", 1e3 * figures.stamp.constraints) +
         line("removal    %9.3f ms\n", 1e3 * figures.stamp.removal) +
         line("berm       %9.3f ms\n", 1e3 * figures.stamp.berm) +
         line("slide      %9.3f ms\n", 1e3 * figures.slide) +
         line("clean-up   %9.3f ms\n", 1e3 * figures.cleanUp) +
         line("frame      %9.3f ms\n", frameMilliseconds) + line("stamps waiting %9zu", figures.waiting);
}

}  // namespace teren
