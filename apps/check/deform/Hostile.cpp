#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "apps/check/Counterexample.h"
#include "apps/check/MapComparison.h"
#include "apps/check/Properties.h"
#include "apps/check/deform/DeformTrial.h"

namespace teren::check {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

struct HostileStamp {
  Stamp stamp;
  std::string text;
  bool mustBeRefused = true;
};

std::vector<HostileStamp> hostile(const DeformRegion& region, const TriedStamp& good) {
  std::vector<HostileStamp> stamps;
  const auto with = [&](double Stamp::*field, double value, const char* text, bool mustBeRefused) {
    stamps.push_back({good.stamp, good.text + ", but " + text, mustBeRefused});
    stamps.back().stamp.*field = value;
  };
  for (const auto& [field, name] :
       {std::pair(&Stamp::east, "its east "), std::pair(&Stamp::north, "its north "),
        std::pair(&Stamp::size, "its size "), std::pair(&Stamp::depth, "its depth ")}) {
    const std::string number = name;
    with(field, kNaN, (number + "NaN").c_str(), true);
    with(field, kInfinity, (number + "infinity").c_str(), true);
    with(field, -kInfinity, (number + "minus infinity").c_str(), true);
  }
  with(&Stamp::size, 0.0, "its size 0", true);
  with(&Stamp::size, -1.0, "its size -1", true);
  with(&Stamp::size, 1e300, "its size 1e300", true);
  const double width = (region.sampleColumns() - 1) * region.spacing;
  const double length = (region.sampleRows() - 1) * region.spacing;
  with(&Stamp::east, -1e-9, "a little west of the region", true);
  with(&Stamp::east, width + 1e-9, "a little east of the region", true);
  with(&Stamp::north, 0.5 * region.spacing, "in the collar's south", true);
  with(&Stamp::north, length - 0.5 * region.spacing, "in the collar's north", true);
  with(&Stamp::east, 1e300, "far away", true);
  // Those may mean something.
  with(&Stamp::depth, 1e300, "its depth 1e300", false);
  with(&Stamp::depth, -1e300, "its depth -1e300", false);
  with(&Stamp::depth, 0.0, "its depth 0", false);
  with(&Stamp::depth, 5e-324, "its depth the least there is", false);
  with(&Stamp::size, 5e-324, "its size the least there is", false);
  with(&Stamp::height, kNaN, "held at NaN", false);
  with(&Stamp::height, kInfinity, "held at infinity", false);
  with(&Stamp::height, -1e300, "held at -1e300", false);
  return stamps;
}

class Hostile final : public Property {
 public:
  std::string_view name() const noexcept override { return "hostile"; }
  std::string_view demand() const noexcept override {
    return "A stamp with a number that is not finite, without size, or beyond the region is refused with one "
           "sentence, whatever is odd is refused or taken, and a refusal leaves the surface as it was.";
  }

 protected:
  std::string holds(const Subject& subject, const Effort&) const override {
    const DeformTrial trial(subject);
    int tried = 0;
    for (const DeformTask& task : trial.tasks()) {
      for (const TriedStamp& good : task.stamps) tryAll(trial, task.region, good, tried);
    }
    return std::to_string(tried) + " hostile stamps";
  }

 private:
  /// On a surface that is in the middle of a step, where the deformer does steps.
  static void tryAll(const DeformTrial& trial, const DeformRegion& region, const TriedStamp& good,
                     int& tried) {
    const HeightMap ground = DeformTrial::hills(region);
    WatchedSurface surface(trial, region, ground.view());
    const auto begin = [&](WatchedSurface& fresh) {
      fresh.apply(good);
      fresh.step(shortestSlice(), kToRest);
    };
    begin(surface);
    for (const HostileStamp& bad : hostile(region, good)) {
      ++tried;
      static_cast<void>(trial.reach(bad.stamp, bad.text));
      const HeightMap before = surface.heights();
      const std::uint64_t steps = surface.steps();
      const bool rest = surface.atRest();
      if (surface.refusal(bad.stamp, bad.text).empty()) {
        if (bad.mustBeRefused) throw Counterexample{bad.text + ": it is taken"};
        expectFinite(surface);
        surface = WatchedSurface(trial, region, ground.view());
        begin(surface);
        continue;
      }
      if (surface.steps() != steps || surface.atRest() != rest) {
        throw Counterexample{bad.text + " is refused, but it was at step " + std::to_string(steps) +
                             " before and is at " + std::to_string(surface.steps()) + " after it"};
      }
      expectSame(before.view(), "before", surface.heights().view(), "after a stamp that was refused",
                 bad.text);
    }
    // Nothing is left that shows later.
    WatchedSurface untouched(trial, region, ground.view());
    begin(untouched);
    untouched.advance(Slice::unlimited(), kToRest);
    surface.advance(Slice::unlimited(), kToRest);
    expectSame(untouched.heights().view(), "without hostile stamps", surface.heights().view(), "with them",
               surface.past());
  }

  static void expectFinite(WatchedSurface& surface) {
    surface.advance(Slice::unlimited(), kToRest);
    const HeightMap after = surface.heights();
    for (const float height : after.samples()) {
      if (!std::isfinite(height)) throw Counterexample{surface.past() + ": a sample is not finite"};
    }
  }
};

}  // namespace

PropertyPointer makeHostile() {
  return std::make_unique<Hostile>();
}

}  // namespace teren::check
