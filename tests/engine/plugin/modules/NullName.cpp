// The name of its second parameter is a null pointer with a length.
#include "Broken.h"

namespace {
std::span<const teren::Parameter> table() noexcept {
  static const std::array rows = {
      teren::Parameter::real("height", 1.0, 0.0, 2.0, "m", "sound"),
      teren::Parameter::real(std::string_view(nullptr, 5), 1.0, 0.0, 2.0, "m", "nameless")};
  return rows;
}
}  // namespace

TEREN_BROKEN_ENTRY {
  static teren::PluginDescription description = broken::flatDescription("null-name");
  description.parameters = &table;
  return &description;
}
