#include <cmath>
#include <string>
#include <vector>

#include "apps/check/Counterexample.h"
#include "apps/check/Properties.h"
#include "apps/check/deform/DeformTrial.h"

namespace teren::check {
namespace {

/// Patches that come in the west and in the south.
constexpr int kWest = 1, kSouth = 2;

class Growth final : public Property {
 public:
  std::string_view name() const noexcept override { return "growth"; }
  std::string_view demand() const noexcept override {
    return "A surface that grows keeps its samples and its steps, and is from then on as one that began over "
           "the larger region; one that does not says so in one sentence and stays as it was.";
  }

 protected:
  std::string holds(const Subject& subject, const Effort&) const override {
    const DeformTrial trial(subject);
    int grown = 0, all = 0;
    for (const DeformTask& task : trial.tasks()) {
      grown += grows(trial, task) ? 1 : 0;
      ++all;
    }
    return std::to_string(grown) + " surfaces of " + std::to_string(all) + " have grown";
  }

 private:
  static DeformRegion larger(DeformRegion region) {
    region.i -= kWest;
    region.j -= kSouth;
    region.columns += kWest + 2;
    region.rows += kSouth + 1;
    return region;
  }

  /// At a place of so few digits that no sum with a patch's side is rounded.
  static TriedStamp exact(TriedStamp tried, const DeformRegion& region) {
    const auto towards = [](double place, double middle) {
      return (place < middle ? std::ceil(place * 1024.0) : std::floor(place * 1024.0)) / 1024.0;
    };
    tried.stamp.east = towards(tried.stamp.east, 0.5 * (region.sampleColumns() - 1) * region.spacing);
    tried.stamp.north = towards(tried.stamp.north, 0.5 * (region.sampleRows() - 1) * region.spacing);
    return tried;
  }
  static TriedStamp moved(TriedStamp tried, const DeformRegion& region) {
    tried.stamp.east += kWest * region.intervals * region.spacing;
    tried.stamp.north += kSouth * region.intervals * region.spacing;
    return tried;
  }

  static bool grows(const DeformTrial& trial, const DeformTask& task) {
    const DeformRegion whole = larger(task.region);
    const HeightMap ground = DeformTrial::hills(whole);
    const SampleRectangle place = whole.placeOf(task.region);
    const ConstHeightView part = ground.view().part(place.column, place.row, place.columns, place.rows);
    WatchedSurface surface(trial, task.region, part), other(trial, whole, ground.view());
    const auto rest = [&] {
      surface.advance(Slice::unlimited(), kToRest);
      other.advance(Slice::unlimited(), kToRest);
    };
    for (const TriedStamp& tried : task.stamps) {
      const TriedStamp stamp = exact(tried, task.region);
      surface.apply(stamp);
      other.apply(moved(stamp, task.region));
    }
    rest();
    const HeightMap before = surface.heights();
    if (!surface.grow(whole, ground.view()).empty()) {
      expectSame(before.view(), "before", surface.heights().view(), "after it refused to grow",
                 surface.past());
      return false;
    }
    compare(surface, other);
    for (const TriedStamp& tried : task.stamps) {
      // Over the rim that was, too: a patch and two are less than most tools reach.
      for (const TriedStamp& stamp :
           {moved(exact(tried, task.region), task.region), exact(tried, task.region)}) {
        surface.apply(stamp);
        other.apply(stamp);
      }
      surface.advance(Slice::unlimited(), surface.steps() + 2);
      other.advance(Slice::unlimited(), other.steps() + 2);
    }
    rest();
    compare(surface, other);
    return true;
  }

  static void compare(WatchedSurface& surface, WatchedSurface& other) {
    expectSame(surface.heights().view(), "of one that has grown", other.heights().view(),
               "of one that began so", surface.past());
    if (surface.steps() == other.steps()) return;
    throw Counterexample{surface.past() + ": one that has grown has done " + std::to_string(surface.steps()) +
                         " steps, one that began so " + std::to_string(other.steps())};
  }
};

}  // namespace

PropertyPointer makeGrowth() {
  return std::make_unique<Growth>();
}

}  // namespace teren::check
