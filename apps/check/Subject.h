// The plugin that is checked, with all settings it is tried with.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "teren/PluginRegistry.h"

#include "apps/check/MapMaker.h"
#include "apps/check/Setting.h"

namespace teren::check {

/// Immutable; any thread may use it.
class Subject {
 public:
  /// The registry must know the id. `more` are settings to try besides settingsOf the plugin's table.
  Subject(std::shared_ptr<const PluginRegistry> registry, const std::string& id,
          const std::vector<Setting>& more = {});

  const PluginInfo& info() const noexcept { return *info_; }
  /// Every setting that is to be tried, the defaults first.
  std::span<const Setting> candidates() const noexcept { return candidates_; }
  /// Those of them the plugin takes.
  std::span<const Setting> settings() const noexcept { return settings_; }

  /// The sentence with which the setting is refused; empty where it is taken.
  std::string refusal(const Setting& setting) const;
  /// A new instance of a generator or filter; the setting must be one that is taken.
  MapMaker maker(const Setting& setting) const;
  /// A new instance of a deformer, whose settings are its stamps'; it must be one that can be made.
  std::shared_ptr<const Deformer> deformer() const;

 private:
  std::shared_ptr<const PluginRegistry> registry_;
  const PluginInfo* info_;
  std::vector<Setting> candidates_, settings_;
};

}  // namespace teren::check
