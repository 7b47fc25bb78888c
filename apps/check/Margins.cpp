#include <algorithm>

#include "teren/Parameter.h"

#include "apps/check/Counterexample.h"
#include "apps/check/MapComparison.h"
#include "apps/check/MapMaker.h"
#include "apps/check/Properties.h"
#include "apps/check/Subject.h"

namespace teren::check {
namespace {

constexpr float kMark = -12345.5f;
constexpr int kWest = 2, kSouth = 3;  // samples of margin

class Margins final : public Property {
 public:
  std::string_view name() const noexcept override { return "margins"; }
  std::string_view demand() const noexcept override {
    return "Nothing is written beside the map, and its bits are the same where it is a part of a larger one.";
  }

 protected:
  std::string holds(const Subject& subject, const Effort&) const override {
    int maps = 0;
    for (const Setting& setting : subject.settings()) {
      const MapMaker maker = subject.maker(setting);
      for (const MapRequest& request : {requestOf(4, 3, 2), requestOf(4, 3), requestOf(4, 33)}) {
        insideALargerOne(maker, request);
        ++maps;
      }
    }
    return std::to_string(maps) + " maps";
  }

 private:
  static void insideALargerOne(const MapMaker& maker, const MapRequest& request) {
    const int samples = request.samples;
    HeightMap whole(samples + 5, samples + 4);
    for (int row = 0; row < whole.rows(); ++row) std::fill_n(whole.view().row(row), whole.columns(), kMark);
    const HeightView part = whole.view().part(kWest, kSouth, samples, samples);
    maker.prepare(request, part);
    finish(*maker.begin(request, part), shortestSlice());
    const std::string differs = difference(maker.make(request, shortestSlice()).view(), "in a map of its own",
                                           part, "in a part of a larger map");
    if (!differs.empty()) throw Counterexample{maker.place(request) + ": " + differs};
    for (int row = 0; row < samples; ++row) std::fill_n(part.row(row), samples, kMark);
    for (int row = 0; row < whole.rows(); ++row) {
      for (int column = 0; column < whole.columns(); ++column) {
        if (whole(column, row) == kMark) continue;
        throw Counterexample{maker.place(request) + ": " + numberText(whole(column, row)) +
                             " m was written beside the map, at sample (" + std::to_string(column - kWest) +
                             ", " + std::to_string(row - kSouth) + ")"};
      }
    }
  }
};

}  // namespace

PropertyPointer makeMargins() {
  return std::make_unique<Margins>();
}

}  // namespace teren::check
