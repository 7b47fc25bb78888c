#include "qt/ParameterPanel.h"

#include <functional>
#include <string>
#include <string_view>
#include <utility>

#include <QCheckBox>
#include <QComboBox>
#include <QFormLayout>
#include <QLineEdit>
#include <QSignalBlocker>

#include "qt/NumberBox.h"

namespace teren {
namespace {

QString asQString(std::string_view text) {
  return QString::fromUtf8(text.data(), static_cast<int>(text.size()));
}

}  // namespace

class ParameterPanel::Private {
 public:
  Private(ParameterPanel& owner, const PluginInfo& plugin);

  Result<void> setValues(std::span<const Values::Entry> entries);
  std::vector<Values::Entry> values() const;

 private:
  /// One parameter's field.
  struct Row {
    const Parameter* parameter;
    QWidget* field;
    std::function<ParameterValue()> read;
    std::function<void(const ParameterValue&)> write;
  };

  Row makeRow(const Parameter& parameter);
  Row numberRow(const Parameter& parameter);
  Row booleanRow(const Parameter& parameter);
  Row choiceRow(const Parameter& parameter);
  Row textRow(const Parameter& parameter);

  ParameterPanel& panel_;
  std::string id_;
  std::span<const Parameter> table_;
  std::vector<Row> rows_;
};

ParameterPanel::Private::Private(ParameterPanel& owner, const PluginInfo& plugin)
    : panel_(owner), id_(plugin.id), table_(plugin.parameters) {
  auto* form = new QFormLayout(&owner);
  for (const Parameter& parameter : table_) {
    Row row = makeRow(parameter);
    row.field->setObjectName(asQString(parameter.name));
    row.field->setToolTip(asQString(parameter.doc));
    row.write(parameter.defaultValue());
    form->addRow(asQString(parameter.name), row.field);
    rows_.push_back(std::move(row));
  }
}

ParameterPanel::Private::Row ParameterPanel::Private::makeRow(const Parameter& parameter) {
  switch (parameter.type) {
    case ParameterType::boolean:
      return booleanRow(parameter);
    case ParameterType::choice:
      return choiceRow(parameter);
    case ParameterType::text:
      return textRow(parameter);
    case ParameterType::real:
    case ParameterType::integer:
      break;
  }
  return numberRow(parameter);
}

ParameterPanel::Private::Row ParameterPanel::Private::numberRow(const Parameter& parameter) {
  auto* box = new NumberBox(parameter, &panel_);
  QObject::connect(box, qOverload<double>(&QDoubleSpinBox::valueChanged), &panel_,
                   [this] { Q_EMIT panel_.valuesChanged(); });
  if (parameter.type == ParameterType::integer) {
    return {&parameter, box, [box] { return ParameterValue(static_cast<std::int64_t>(box->value())); },
            [box](const ParameterValue& value) {
              box->setValue(static_cast<double>(std::get<std::int64_t>(value)));
            }};
  }
  return {&parameter, box, [box] { return ParameterValue(box->value()); },
          [box](const ParameterValue& value) { box->setValue(std::get<double>(value)); }};
}

ParameterPanel::Private::Row ParameterPanel::Private::booleanRow(const Parameter& parameter) {
  auto* box = new QCheckBox(&panel_);
  QObject::connect(box, &QCheckBox::toggled, &panel_, [this] { Q_EMIT panel_.valuesChanged(); });
  return {&parameter, box, [box] { return ParameterValue(box->isChecked()); },
          [box](const ParameterValue& value) { box->setChecked(std::get<bool>(value)); }};
}

ParameterPanel::Private::Row ParameterPanel::Private::choiceRow(const Parameter& parameter) {
  auto* box = new QComboBox(&panel_);
  for (const std::string_view choice : parameter.choices) box->addItem(asQString(choice));
  QObject::connect(box, qOverload<int>(&QComboBox::currentIndexChanged), &panel_,
                   [this] { Q_EMIT panel_.valuesChanged(); });
  return {&parameter, box, [box] { return ParameterValue(box->currentText().toStdString()); },
          [box](const ParameterValue& value) {
            box->setCurrentText(QString::fromStdString(std::get<std::string>(value)));
          }};
}

ParameterPanel::Private::Row ParameterPanel::Private::textRow(const Parameter& parameter) {
  auto* line = new QLineEdit(&panel_);
  line->setMaxLength(static_cast<int>(parameter.max));  // bytes are at least as many: the table decides below
  auto good = std::make_shared<std::string>();          // its bytes, which need not be UTF-8
  QObject::connect(line, &QLineEdit::editingFinished, &panel_, [this, line, good, &parameter] {
    if (line->text() == QString::fromStdString(*good)) return;
    const Values::Entry typed{std::string(parameter.name), line->text().toStdString()};
    if (const Result<Values> checked = Values::check(table_, std::span(&typed, 1), id_); !checked) {
      line->setText(QString::fromStdString(*good));
      Q_EMIT panel_.refused(QString::fromStdString(checked.error().message));
      return;
    }
    *good = std::get<std::string>(typed.second);
    Q_EMIT panel_.valuesChanged();
  });
  return {&parameter, line, [good] { return ParameterValue(*good); },
          [line, good](const ParameterValue& value) {
            *good = std::get<std::string>(value);
            line->setText(QString::fromStdString(*good));
          }};
}

std::vector<Values::Entry> ParameterPanel::Private::values() const {
  std::vector<Values::Entry> entries;
  for (const Row& row : rows_) entries.emplace_back(row.parameter->name, row.read());
  return entries;
}

Result<void> ParameterPanel::Private::setValues(std::span<const Values::Entry> entries) {
  const Result<Values> checked = Values::check(table_, entries, id_);
  if (!checked) return checked.error();
  for (std::size_t n = 0; n < rows_.size(); ++n) {
    const QSignalBlocker silence(rows_[n].field);
    rows_[n].write(checked->entries()[n].second);
  }
  return {};
}

ParameterPanel::ParameterPanel(const PluginInfo& plugin, QWidget* parent)
    : QWidget(parent), private_(std::make_unique<Private>(*this, plugin)) {}
ParameterPanel::~ParameterPanel() = default;

std::vector<Values::Entry> ParameterPanel::values() const {
  return private_->values();
}

Result<void> ParameterPanel::setValues(std::span<const Values::Entry> entries) {
  return private_->setValues(entries);
}

}  // namespace teren
