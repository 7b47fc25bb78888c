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

namespace {

std::vector<const Property*> pointersTo(std::span<const PropertyPointer> owned) {
  std::vector<const Property*> pointers;
  for (const PropertyPointer& property : owned) pointers.push_back(property.get());
  return pointers;
}

}  // namespace

std::span<const Property* const> contract(PluginKind kind) {
  static const PropertyPointer ofMaps[] = {
      makeCompletion(),  makeSlicing(),      makeOrder(),  makeThreads(),    makeParallel(),
      makeSliceLength(), makeFinite(),       makeRange(),  makeMean(),       makeDeviation(),
      makeResidual(),    makeLevels(),       makeField(),  makeFieldError(), makeParameters(),
      makeMargins(),     makeCancellation(), makeMemory(), makeAllocation()};
  static const PropertyPointer ofDeformers[] = {
      makeStamps(),  makeStepSlicing(), makeSurfaces(), makeStepLength(), makeCollar(), makeHeights(),
      makeChanged(), makeSnapshots(),   makeHostile(),  makeBytes(),      makeGrowth(), makeLoose()};
  static const std::vector<const Property*> mapContract = pointersTo(ofMaps);
  static const std::vector<const Property*> deformerContract = pointersTo(ofDeformers);
  return kind == PluginKind::deformer ? deformerContract : mapContract;
}

const Property* findProperty(PluginKind kind, std::string_view name) {
  const auto properties = contract(kind);
  const auto found = std::find_if(properties.begin(), properties.end(),
                                  [name](const Property* property) { return property->name() == name; });
  return found == properties.end() ? nullptr : *found;
}

}  // namespace teren::check
