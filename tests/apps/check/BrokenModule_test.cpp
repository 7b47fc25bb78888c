// The checker itself: sound modules keep every property, and each broken module breaks its own and no other,
// with a counter-example that says what is wrong.
#include <algorithm>
#include <memory>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "teren/PluginRegistry.h"

#include "apps/check/Property.h"
#include "apps/check/Subject.h"

namespace teren::check {
namespace {

/// A module that is not there, or is refused, stops the test.
std::unique_ptr<Subject> subject(const std::string& id) {
  const auto registry = PluginRegistry::loadModule(TEREN_TEST_CHECK_MODULES "/teren-" + id + ".so");
  if (registry->find(id) == nullptr) throw std::runtime_error(registry->refused().front().reason);
  return std::make_unique<Subject>(registry, id);
}

std::string testName(std::string name) {
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

class SoundModule : public testing::TestWithParam<const char*> {};

TEST_P(SoundModule, KeepsEveryProperty) {
  const auto module = subject(GetParam());
  for (const Property* property : contract(module->info().kind)) {
    const Finding finding = property->check(*module, Effort::quick());
    EXPECT_TRUE(finding.holds) << property->name() << ": " << finding.text;
    EXPECT_NE(finding.text, "") << property->name();
  }
}

INSTANTIATE_TEST_SUITE_P(Every, SoundModule,
                         testing::Values("sound", "sound-field", "sound-filter", "sound-press"),
                         [](const auto& test) { return testName(test.param); });

struct Breach {
  std::string module, property;
  std::vector<std::string> needles;
};

void PrintTo(const Breach& breach, std::ostream* stream) {
  *stream << breach.module;
}

std::vector<Breach> breaches() {
  return {
      {"no-completion", "completion", {"with defaults", "5 x 5 samples", "threw \"too small\""}},
      {"no-end", "completion", {"5 x 5 samples", "not done after 52800 steps"}},
      {"no-slicing", "slicing", {"sample (0, 0)", "made in one step", "over from the start"}},
      {"no-order", "order", {"33 x 33 samples", "sample (0, 0)", "made alone", "in turn with others"}},
      {"no-threads", "threads", {"made by one thread but 0 m", "stepped by others"}},
      {"no-parallel", "parallel", {"made by one thread alone", "while other threads made other maps"}},
      {"no-slice-length", "slice-length", {"257 x 257 samples", "slices asked for 100 us used"}},
      {"no-finite", "finite", {"seed 0,", "sample (0, 0) is NaN, as it was before"}},
      {"no-writing", "finite", {"seed 0,", "sample (2, 2) is NaN, as it was before"}},
      {"no-range", "range", {"sample (", "m, promised is -1 to 1 m"}},
      {"no-mean", "mean", {"the mean over the map is 0.1", "of 0 m over 250 seeds"}},
      {"no-deviation", "deviation", {"the deviation over the map is 1.2", "of 1 m over 250 seeds"}},
      {"no-residual", "residual", {"level 1 of 65 samples a side is wrong by 1.", "promised is 0.5"}},
      {"no-levels", "levels", {"level 1,", "at this level but", "in the finest map"}},
      {"no-field", "field", {"with defaults at (0 + 0.25, 7 + 0.5) pitches", "in this rectangle but"}},
      {"no-field-error", "field-error", {"0.0625 m", "from the triangles", "promised is"}},
      {"no-parameters", "parameters", {"with deviation = 2, which its table allows", "two are too many"}},
      {"no-margins", "margins", {"7 m was written beside the map, at sample (1, 0)"}},
      {"no-cancellation", "cancellation", {"made before", "begun after a task was given up after 0 steps"}},
      {"no-memory", "memory", {"with defaults: after 320 maps", "more after each further map"}},
      {"no-allocation", "allocation", {"9 x 9 samples", "step number 2 allocates 1 time"}},
      {"deform-no-stamps", "stamps", {"no stamp with strength = 2 is taken, of 6 tried", "too strong"}},
      {"deform-no-effect", "stamps", {"after a stamp with defaults, 12 m large", "no sample has changed"}},
      {"deform-no-slicing", "slicing", {"in one step", "in slices that are over from the start"}},
      {"deform-no-parallel", "parallel", {"by one thread alone but", "beside other threads"}},
      {"deform-no-slice-length", "slice-length", {"slices asked for 100 us used"}},
      {"deform-no-collar", "collar", {"has changed, ", "m from the middle, and its reach is 6 m"}},
      {"deform-no-heights", "heights", {"sample (5, 0) is ", "but the height asked for there is"}},
      {"deform-no-samples", "heights", {"in all samples but 0 m in a part of them"}},
      {"deform-no-changed", "changed", {"after a stamp with defaults", "has changed, too"}},
      {"deform-no-snapshots", "snapshots", {"snapshot number 0", "when it was taken"}},
      {"deform-no-refusal", "hostile", {"but its east NaN", "before but 7 m after a stamp that was refused"}},
      {"deform-no-sentence", "hostile", {"but its east NaN", "refuses with \"\", which is not one sentence"}},
      {"deform-no-door", "hostile", {"but its east NaN: it is taken"}},
      {"deform-no-bytes", "bytes", {"bytes, but", "more are in use than before it began"}},
      {"deform-no-growth", "growth", {"of one that has grown but", "of one that began so"}},
      {"deform-no-loose",
       "loose",
       {"before any stamp: at sample (", "m deep, laid were ", "no stamp reaches"}},
      {"deform-no-freeing", "bytes", {"after 320 surfaces that are gone"}},
  };
}

class BrokenModule : public testing::TestWithParam<Breach> {};

TEST_P(BrokenModule, BreaksItsPropertyAndNoOther) {
  const auto module = subject(GetParam().module);
  for (const Property* property : contract(module->info().kind)) {
    const Finding finding = property->check(*module, Effort::quick());
    EXPECT_EQ(finding.holds, property->name() != GetParam().property)
        << property->name() << ": " << finding.text;
    if (finding.holds) continue;
    for (const std::string& needle : GetParam().needles) {
      EXPECT_NE(finding.text.find(needle), std::string::npos) << needle << " in: " << finding.text;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Every, BrokenModule, testing::ValuesIn(breaches()),
                         [](const auto& test) { return testName(test.param.module); });

TEST(Contract, HasABrokenModuleForEachProperty) {
  for (const PluginKind kind : {PluginKind::generator, PluginKind::deformer}) {
    std::vector<Breach> all = breaches();
    std::erase_if(all, [kind](const Breach& breach) {
      return breach.module.starts_with("deform-") != (kind == PluginKind::deformer);
    });
    for (const Property* property : contract(kind)) {
      EXPECT_TRUE(std::any_of(all.begin(), all.end(), [&](const Breach& breach) {
        return breach.property == property->name();
      })) << property->name();
      EXPECT_EQ(findProperty(kind, property->name()), property);
      EXPECT_TRUE(property->demand().ends_with('.')) << property->name();
    }
    EXPECT_EQ(findProperty(kind, "no such property"), nullptr);
  }
  EXPECT_EQ(contract(PluginKind::filter).data(), contract(PluginKind::generator).data());
}

}  // namespace
}  // namespace teren::check
