#include <algorithm>
#include <cmath>

#include "apps/check/Allowance.h"
#include "apps/check/Counterexample.h"
#include "apps/check/Ensemble.h"
#include "apps/check/Properties.h"
#include "apps/check/Rounded.h"
#include "apps/check/Subject.h"

namespace teren::check {
namespace {

/// In standard errors. Some ten thousand means are looked at: one beyond so many is found by chance in one of
/// a hundred checks.
constexpr double kChance = 5.0;

class Mean final : public Property {
 public:
  std::string_view name() const noexcept override { return "mean"; }
  std::string_view demand() const noexcept override {
    return "Over many seeds the mean of every sample is the promised one, within 3 % of the deviation and "
           "chance.";
  }

 protected:
  std::string holds(const Subject& subject, const Effort& effort) const override {
    std::string figure;
    for (const Setting& setting : subject.settings()) {
      const MapMaker maker = subject.maker(setting);
      Ensemble ensemble(maker);
      const Allowance allowance(effort.forEnsemble(setting.empty()));
      for (int n = 0; n < effort.seeds && (n < Ensemble::kFewestSeeds || allowance.left()); ++n)
        ensemble.add();
      compare(maker, ensemble);
      if (figure.empty()) figure = text(ensemble, ensemble.mean());
    }
    return figure;
  }

 private:
  static std::string text(const Ensemble& ensemble, const Estimate& offset) {
    return rounded(ensemble.promised().mean + offset.value) + " +- " + rounded(offset.error) + " m of " +
           rounded(ensemble.promised().mean) + " m over " + std::to_string(ensemble.seeds()) + " seeds";
  }

  static void compare(const MapMaker& maker, const Ensemble& ensemble) {
    const HeightRange& promised = ensemble.promised();
    const double rounding = 1e-6 * std::max(std::fabs(promised.min), std::fabs(promised.max));
    const auto check = [&](const Estimate& offset, const std::string& where) {
      const double most = Ensemble::kTolerance * promised.deviation + kChance * offset.error + rounding;
      if (std::fabs(offset.value) <= most) return;
      throw Counterexample{"with " + maker.setting() + ": the mean " + where + " is " +
                           text(ensemble, offset)};
    };
    check(ensemble.mean(), "over the map");
    for (int y = 0; y < Ensemble::kSamples; ++y) {
      for (int x = 0; x < Ensemble::kSamples; ++x) {
        check(ensemble.meanAt(x, y), "of sample (" + std::to_string(x) + ", " + std::to_string(y) + ") of " +
                                         std::to_string(Ensemble::kSamples) + " a side");
      }
    }
  }
};

}  // namespace

PropertyPointer makeMean() {
  return std::make_unique<Mean>();
}

}  // namespace teren::check
