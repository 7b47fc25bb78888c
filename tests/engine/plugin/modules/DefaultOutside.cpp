// A default lies outside its own range.
#include "Broken.h"

namespace {
std::span<const teren::Parameter> table() noexcept {
  static constexpr std::array rows = {teren::Parameter::real("height", 3.0, 0.0, 2.0, "m", "too high")};
  return rows;
}
}  // namespace

TEREN_BROKEN_ENTRY {
  static teren::PluginDescription description = broken::flatDescription("default-outside");
  description.parameters = &table;
  return &description;
}
