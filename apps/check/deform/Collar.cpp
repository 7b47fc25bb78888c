#include <cmath>
#include <string>

#include "teren/Parameter.h"

#include "apps/check/Counterexample.h"
#include "apps/check/Properties.h"
#include "apps/check/deform/DeformTrial.h"

namespace teren::check {
namespace {

class Collar final : public Property {
 public:
  std::string_view name() const noexcept override { return "collar"; }
  std::string_view demand() const noexcept override {
    return "Ground beyond the reach of a stamp stays as it is, bit for bit, and so does the collar, wherever "
           "and however often is stamped.";
  }

 protected:
  std::string holds(const Subject& subject, const Effort&) const override {
    const DeformTrial trial(subject);
    int stamps = 0;
    for (const DeformTask& task : trial.tasks()) {
      const HeightMap ground = DeformTrial::hills(task.region);
      WatchedSurface together(trial, task.region, ground.view());
      for (const TriedStamp& tried : task.stamps) {
        for (const TriedStamp& placed :
             {tried, inCorner(tried, task.region, false), inCorner(tried, task.region, true)}) {
          WatchedSurface alone(trial, task.region, ground.view());
          alone.apply(placed);
          alone.advance(Slice::unlimited(), kToRest);
          look(alone, task.region, ground, &placed);
          together.apply(placed);
          ++stamps;
        }
        look(together, task.region, ground, nullptr);
      }
      together.advance(Slice::unlimited(), kToRest);
      look(together, task.region, ground, nullptr);
    }
    return std::to_string(stamps) + " stamps, alone and together";
  }

 private:
  /// As near to a corner of the region as it may be.
  static TriedStamp inCorner(TriedStamp tried, const DeformRegion& region, bool northEast) {
    // A little more than the reach: what a deformer asks for itself may round otherwise.
    const double far = (tried.reach + kCollarCells * region.spacing) * (1.0 + 1e-12);
    tried.stamp.east = northEast ? (region.sampleColumns() - 1) * region.spacing - far : far;
    tried.stamp.north = northEast ? (region.sampleRows() - 1) * region.spacing - far : far;
    return tried;
  }

  static void look(WatchedSurface& surface, const DeformRegion& region, const HeightMap& ground,
                   const TriedStamp* alone) {
    const HeightMap after = surface.heights();
    const SampleRectangle changeable = region.changeable();
    for (int y = 0; y < ground.rows(); ++y) {
      for (int x = 0; x < ground.columns(); ++x) {
        if (after(x, y) == ground(x, y)) continue;
        const std::string sample = "sample (" + std::to_string(x) + ", " + std::to_string(y) + ") ";
        if (!changeable.contains(x, y)) {
          throw Counterexample{surface.past() + ": " + sample + "of the collar has changed"};
        }
        if (alone == nullptr) continue;
        const double distance =
            std::hypot(x * region.spacing - alone->stamp.east, y * region.spacing - alone->stamp.north);
        if (distance < alone->reach) continue;
        throw Counterexample{surface.past() + ": " + sample + "has changed, " + numberText(distance) +
                             " m from the middle, and its reach is " + numberText(alone->reach) + " m"};
      }
    }
  }
};

}  // namespace

PropertyPointer makeCollar() {
  return std::make_unique<Collar>();
}

}  // namespace teren::check
