// A well described generator whose constructor throws: something unknown for height 2, nothing made for 3.
#include <stdexcept>

#include "Broken.h"

namespace {
std::unique_ptr<teren::Generator> make(const teren::Values& values) {
  if (values.real("height") == 2.0) throw 2;
  if (values.real("height") == 3.0) return nullptr;
  throw std::runtime_error("no ground today");
}
}  // namespace

TEREN_BROKEN_ENTRY {
  static teren::PluginDescription description = broken::flatDescription("throwing");
  description.makeGenerator = &make;
  return &description;
}
