// A well described deformer that cannot be made.
#include <stdexcept>

#include "Broken.h"

namespace {

std::unique_ptr<teren::Deformer> make() {
  throw std::runtime_error("the ground is frozen");
}

}  // namespace

TEREN_BROKEN_ENTRY {
  static teren::PluginDescription description = broken::flatDescription("throwing-deformer");
  description.kind = teren::PluginKind::deformer;
  description.makeDeformer = &make;
  return &description;
}
