// The contract of plugins as data: each demand has a name, a sentence, and a check that any loaded plugin can
// be put to. `teren check` and Teren's own tests run the same ones.
#pragma once

#include <chrono>
#include <span>
#include <string>
#include <string_view>

#include "teren/Plugin.h"

namespace teren::check {

class Subject;

/// What a check found: the figures by which the property holds, or the first counter-example - with which
/// setting, which map, which sample, and the values.
struct Finding {
  bool holds = false;
  std::string text;
};

/// How much is tried. The least of every check is always done; beyond it, work on one setting ends with its
/// share of processor time, so that a slow plugin is checked in bounded time and a fast one thoroughly.
struct Effort {
  int seeds = 1000;                           ///< of an ensemble, where time allows
  std::chrono::milliseconds perSetting{100};  ///< processor time

  /// The defaults, which most worlds use, get as many seeds as they may have unless the plugin is very slow.
  constexpr std::chrono::milliseconds forEnsemble(bool defaults) const {
    return (defaults ? 20 : 1) * perSetting;
  }

  static constexpr Effort full() { return {}; }
  /// For a look after each change.
  static constexpr Effort quick() { return {250, std::chrono::milliseconds(10)}; }
};

class Property {
 public:
  virtual ~Property() = default;

  /// Lower-case letters and '-'.
  virtual std::string_view name() const noexcept = 0;
  /// What it demands, in one sentence.
  virtual std::string_view demand() const noexcept = 0;

  /// Puts the plugin to it. What the plugin throws is a counter-example; what crashes it, crashes here: run
  /// checks of modules that are not trusted in a process of their own. May start threads, and leaves none.
  Finding check(const Subject& subject, const Effort& effort) const;

 protected:
  /// Returns the figures, or throws a Counterexample.
  virtual std::string holds(const Subject& subject, const Effort& effort) const = 0;
};

/// All properties of a kind of plugins, in the order in which they are told; they live as long as the
/// program.
std::span<const Property* const> contract(PluginKind kind);

/// nullptr where none has this name.
const Property* findProperty(PluginKind kind, std::string_view name);

}  // namespace teren::check
