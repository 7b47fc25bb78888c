#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "teren/Hash.h"
#include "teren/Parameter.h"

#include "apps/check/Counterexample.h"
#include "apps/check/MapComparison.h"
#include "apps/check/Properties.h"
#include "apps/check/deform/DeformTrial.h"

namespace teren::check {
namespace {

class Loose final : public Property {
 public:
  std::string_view name() const noexcept override { return "loose"; }
  std::string_view demand() const noexcept override {
    return "A surface that knows loose material moves nothing when some is laid, tells what was laid beyond "
           "the reach of stamps as it was, bit for bit, elsewhere depths that are finite and not negative, "
           "and the same in slices; one that knows none says so, always, and writes nothing.";
  }

 protected:
  std::string holds(const Subject& subject, const Effort&) const override {
    const DeformTrial trial(subject);
    int knowing = 0, all = 0;
    for (const DeformTask& task : trial.tasks()) {
      const Outcome whole = run(trial, task, Slice::unlimited());
      const Outcome sliced = run(trial, task, shortestSlice());
      expectSame(whole.depths.view(), "of loose material in one step", sliced.depths.view(),
                 "in slices that are over from the start", whole.past);
      knowing += whole.depths.samples().empty() ? 0 : 1;
      ++all;
    }
    return std::to_string(knowing) + " surfaces of " + std::to_string(all) + " know loose material";
  }

 private:
  /// Where the stamps of a task have led, on ground parts of which are loose.
  struct Outcome {
    HeightMap depths;  // empty where the surface knows no loose material
    std::string past;
  };

  static Outcome run(const DeformTrial& trial, const DeformTask& task, const Slice& slice) {
    const HeightMap ground = DeformTrial::hills(task.region);
    HeightMap laid(ground.columns(), ground.rows());
    WatchedSurface surface(trial, task.region, ground.view());
    const std::span<const TriedStamp> stamps = task.stamps;
    const bool knowsLoose = look(surface, task.region, laid, stamps.first(0)).has_value();
    laid = patches(task.region);
    surface.layLoose(laid.view());
    expectSame(ground.view(), "before", surface.heights().view(), "with loose material laid", surface.past());
    std::optional<HeightMap> depths;
    for (std::size_t count = 0; count <= stamps.size(); ++count) {
      if (count > 0) surface.apply(stamps[count - 1]);
      surface.advance(slice, kToRest);
      depths = look(surface, task.region, laid, stamps.first(count));
      if (depths.has_value() != knowsLoose) {
        throw Counterexample{surface.past() + ": it knows " + (knowsLoose ? "no" : "of") +
                             " loose material, and before any was laid it was otherwise"};
      }
    }
    return {depths ? *std::move(depths) : HeightMap(), surface.past()};
  }

  /// Up to 3 m deep, and nothing in a third of the squares of 8 x 8 samples.
  static HeightMap patches(const DeformRegion& region) {
    HeightMap depths(region.sampleColumns(), region.sampleRows());
    const auto hash = [](int x, int y) {
      return hashWith(static_cast<std::uint64_t>(x), static_cast<std::uint64_t>(y));
    };
    for (int y = 0; y < depths.rows(); ++y) {
      for (int x = 0; x < depths.columns(); ++x) {
        if (hash(x / 8, y / 8) % 3 == 0) continue;
        depths(x, y) = static_cast<float>(3.0 * 0x1p-64 * static_cast<double>(hash(x, y)));
      }
    }
    return depths;
  }

  /// How deep it is loose after these stamps; nothing where it knows no loose material.
  static std::optional<HeightMap> look(WatchedSurface& surface, const DeformRegion& region,
                                       const HeightMap& laid, std::span<const TriedStamp> stamps) {
    const auto isReached = [&](int x, int y) {
      if (stamps.empty() || !region.changeable().contains(x, y)) return false;
      const auto& [stamp, reach, text] = stamps.front();
      return stamps.size() > 1 ||  // together they may move it farther
             std::hypot(x * region.spacing - stamp.east, y * region.spacing - stamp.north) < reach;
    };
    HeightMap depths(laid.columns(), laid.rows());
    std::ranges::fill_n(depths.view().data(), std::ssize(depths.samples()), kUntouched);
    const bool knows = surface.loose(depths.view());
    for (int y = 0; y < depths.rows(); ++y) {
      for (int x = 0; x < depths.columns(); ++x) {
        const float depth = depths(x, y);
        const auto where = [&] {
          return surface.past() + ": at sample (" + std::to_string(x) + ", " + std::to_string(y) + ") ";
        };
        if (!knows && !std::isnan(depth)) {
          throw Counterexample{where() + "it writes a depth, and says that it knows no loose material"};
        }
        if (!knows) continue;
        if (!(std::isfinite(depth) && depth >= 0.0F)) {
          throw Counterexample{where() + "it is loose " + numberText(depth) + " m deep"};
        }
        if (isReached(x, y) || depth == laid(x, y)) continue;
        throw Counterexample{where() + "it is loose " + numberText(depth) + " m deep, laid were " +
                             numberText(laid(x, y)) + " m and no stamp reaches it"};
      }
    }
    if (!knows) return std::nullopt;
    return depths;
  }

  static constexpr float kUntouched = std::numeric_limits<float>::quiet_NaN();
};

}  // namespace

PropertyPointer makeLoose() {
  return std::make_unique<Loose>();
}

}  // namespace teren::check
