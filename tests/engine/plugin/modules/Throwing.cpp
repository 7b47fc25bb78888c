// A well described generator whose constructor throws: something unknown for height 2, nothing made for 3, an
// exception without a text for 4.
#include <exception>
#include <stdexcept>

#include "Broken.h"

namespace {

class NoText final : public std::exception {
 public:
  const char* what() const noexcept override { return nullptr; }
};

std::unique_ptr<teren::Generator> make(const teren::Values& values) {
  if (values.real("height") == 2.0) throw 2;
  if (values.real("height") == 3.0) return nullptr;
  if (values.real("height") == 4.0) throw NoText();
  throw std::runtime_error("no ground today");
}

}  // namespace

TEREN_BROKEN_ENTRY {
  static teren::PluginDescription description = broken::flatDescription("throwing");
  description.makeGenerator = &make;
  return &description;
}
