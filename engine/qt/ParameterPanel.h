// The parameters of a plugin as a form, made from its table: what a program puts beside its land.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include <QString>
#include <QWidget>

#include "teren/PluginRegistry.h"
#include "teren/Result.h"

namespace teren {

/// One row for each parameter: its name, a field of its type with the unit, and its documentation as the tool
/// tip. The fields take nothing that the table forbids: numbers stay in their range, and a text that is
/// refused goes back to the one before. Whether a plugin makes something of the values together, only making
/// it tells (TerrainWidget::setWorld).
///
/// A QWidget like any other; all calls from the GUI thread.
class ParameterPanel : public QWidget {
  Q_OBJECT

 public:
  /// Starts with the defaults. The plugin's table is used as long as the panel lives.
  explicit ParameterPanel(const PluginInfo& plugin, QWidget* parent = nullptr);
  ~ParameterPanel() override;

  /// Every parameter with the value its field shows, in the table's order: Values::check accepts them.
  std::vector<Values::Entry> values() const;

  /// Shows these values and the defaults of all other parameters, without emitting valuesChanged. What
  /// Values::check refuses leaves the panel as it was.
  Result<void> setValues(std::span<const Values::Entry> entries);

 Q_SIGNALS:
  /// A person has changed a value.
  void valuesChanged();
  /// One sentence: what a person has typed is refused.
  void refused(const QString& sentence);

 private:
  class Private;
  std::unique_ptr<Private> private_;
};

}  // namespace teren
