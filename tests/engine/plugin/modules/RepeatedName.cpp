// Two parameters have one name.
#include "Broken.h"

namespace {
std::span<const teren::Parameter> table() noexcept {
  static constexpr std::array rows = {teren::Parameter::real("height", 1.0, 0.0, 2.0, "m", "first"),
                                      teren::Parameter::integer("height", 1, 0, 2, "", "second")};
  return rows;
}
}  // namespace

TEREN_BROKEN_ENTRY {
  static teren::PluginDescription description = broken::flatDescription("repeated-name");
  description.parameters = &table;
  return &description;
}
