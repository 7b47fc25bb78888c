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

/// While it is open whether the tolerance is kept, up to so many times the seeds are tried.
constexpr int kPatience = 16;
/// In standard errors: more than so many beyond the tolerance is no chance, so many inside it is enough.
constexpr double kNoChance = 4.0, kEnough = 2.0;

enum class Verdict { kept, open, broken };

class Deviation final : public Property {
 public:
  std::string_view name() const noexcept override { return "deviation"; }
  std::string_view demand() const noexcept override {
    return "Over many seeds and the area of a map the deviation is the promised one (of a filter: at most), "
           "within 3 % and chance.";
  }

 protected:
  std::string holds(const Subject& subject, const Effort& effort) const override {
    std::string figure;
    for (const Setting& setting : subject.settings()) {
      const MapMaker maker = subject.maker(setting);
      Ensemble ensemble(maker);
      const Allowance allowance(effort.forEnsemble(setting.empty()));
      for (int n = 0; n < kPatience * effort.seeds && (n < Ensemble::kFewestSeeds || allowance.left()); ++n) {
        ensemble.add();
        if (ensemble.seeds() % effort.seeds == 0 && verdict(maker, ensemble) != Verdict::open) break;
      }
      if (verdict(maker, ensemble) == Verdict::broken) {
        throw Counterexample{"with " + maker.setting() + ": the deviation over the map is " + text(ensemble)};
      }
      if (figure.empty()) figure = text(ensemble) + spread(ensemble);
    }
    return figure;
  }

 private:
  static Verdict verdict(const MapMaker& maker, const Ensemble& ensemble) {
    const HeightRange& promised = ensemble.promised();
    const double rounding = 1e-6 * std::max(std::fabs(promised.min), std::fabs(promised.max));
    const Estimate deviation = ensemble.deviation();
    const double above = deviation.value - promised.deviation;
    const double off =
        (maker.filters() ? above : std::fabs(above)) - Ensemble::kTolerance * promised.deviation - rounding;
    if (off > kNoChance * deviation.error) return Verdict::broken;
    return off <= -kEnough * deviation.error ? Verdict::kept : Verdict::open;
  }

  static std::string text(const Ensemble& ensemble) {
    return rounded(ensemble.deviation().value) + " +- " + rounded(ensemble.deviation().error) + " m of " +
           rounded(ensemble.promised().deviation) + " m over " + std::to_string(ensemble.seeds()) + " seeds";
  }

  /// How uneven it is: figures only, for some generators say that theirs differs with the place.
  static std::string spread(const Ensemble& ensemble) {
    double least = ensemble.deviationAt(0, 0), most = least;
    for (int y = 0; y < Ensemble::kSamples; ++y) {
      for (int x = 0; x < Ensemble::kSamples; ++x) {
        least = std::min(least, ensemble.deviationAt(x, y));
        most = std::max(most, ensemble.deviationAt(x, y));
      }
    }
    return ", " + rounded(least) + " to " + rounded(most) + " m at single samples";
  }
};

}  // namespace

PropertyPointer makeDeviation() {
  return std::make_unique<Deviation>();
}

}  // namespace teren::check
