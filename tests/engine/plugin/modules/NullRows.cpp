// Speaks of three parameters, but they lie nowhere.
#include "Broken.h"

namespace {
std::span<const teren::Parameter> table() noexcept {
  return {static_cast<const teren::Parameter*>(nullptr), 3};
}
}  // namespace

TEREN_BROKEN_ENTRY {
  static teren::PluginDescription description = broken::flatDescription("null-rows");
  description.parameters = &table;
  return &description;
}
