#include <algorithm>
#include <vector>

#include "apps/check/Counterexample.h"
#include "apps/check/Properties.h"
#include "apps/check/Property.h"
#include "apps/check/Subject.h"

namespace teren::check {

Finding Property::check(const Subject& subject, const Effort& effort) const {
  if (subject.settings().empty()) return {false, "it cannot be made of its defaults: " + subject.refusal({})};
  try {
    return {true, holds(subject, effort)};
  } catch (const Counterexample& counterexample) {
    return {false, counterexample.text};
  }
}

std::span<const Property* const> contract() {
  static const PropertyPointer owned[] = {
      makeCompletion(),  makeSlicing(),      makeOrder(),  makeThreads(),    makeParallel(),
      makeSliceLength(), makeFinite(),       makeRange(),  makeMean(),       makeDeviation(),
      makeResidual(),    makeLevels(),       makeField(),  makeFieldError(), makeParameters(),
      makeMargins(),     makeCancellation(), makeMemory(), makeAllocation()};
  static const std::vector<const Property*> properties = [] {
    std::vector<const Property*> pointers;
    for (const PropertyPointer& property : owned) pointers.push_back(property.get());
    return pointers;
  }();
  return properties;
}

const Property* findProperty(std::string_view name) {
  const auto found = std::find_if(contract().begin(), contract().end(),
                                  [name](const Property* property) { return property->name() == name; });
  return found == contract().end() ? nullptr : *found;
}

}  // namespace teren::check
