// A stamp on islands of sand of 10^4 and 10^5 vertices, in turns in one run: medians of CPU time for the
// stamp, the steps until all is at rest, the snapshot and the samples of the changed rectangle, and the ratio
// of all that.
//   bench-island [STAMPS]
// Ground is rough, so that few vertices can go, and was dug everywhere before; the tool is round, 3 spacings
// in radius and one deep, each time at another place. The bound is latency: some hundred triangles scattered
// over the mesh, and, for the changed rectangle, copying it.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "teren/Hash.h"

#include "generators/numbers/RandomNumber.h"
#include "generators/sand/SandIsland.h"
#include "tests/bench/Timing.h"

namespace teren {
namespace {

Stamp stampAt(double east, double north, double size, double depth) {
  static constexpr std::string_view kTools[] = {"round"};
  static constexpr Parameter table[] = {Parameter::choice("tool", "round", kTools, ""),
                                        Parameter::boolean("push", false, ""),
                                        Parameter::real("direction", 0.0, 0.0, 360.0, "", ""),
                                        Parameter::real("repose", kDryRepose, 20.0, 45.0, "", ""),
                                        Parameter::real("moisture", 0.0, 0.0, 1.0, "", "")};
  return {.east = east,
          .north = north,
          .size = size,
          .depth = depth,
          .values = Values::check(table, {}, "sand").value()};
}

class Digging {
 public:
  explicit Digging(int squares) : random_(static_cast<std::uint64_t>(squares)) {
    region_.columns = region_.rows = (squares + 2 * kApron) / region_.intervals;
    HeightMap ground(region_.sampleColumns(), region_.sampleRows());
    for (int y = 0; y < ground.rows(); ++y) {
      for (int x = 0; x < ground.columns(); ++x)
        ground(x, y) = static_cast<float>(0.5 * uniformAroundZero(random_.next()));
    }
    island_ = SandIsland::begin(region_, ground.view()).value();
    for (double north = kMargin; north <= side() - kMargin; north += 10.0) {
      for (double east = kMargin; east <= side() - kMargin; east += 10.0) {
        press(stampAt(east, north, 4.0, 1.0));
      }
    }
    island_->step(Slice::unlimited(), kEnd);
    look();
  }

  void dig() {
    const auto place = [&] {
      return 0.5 * side() + (0.5 * side() - kMargin) * uniformAroundZero(random_.next());
    };
    const double east = place(), north = place();
    const double begin = processorSeconds();
    press(stampAt(east, north, 6.0, 2.0));
    const double stamped = processorSeconds();
    island_->step(Slice::unlimited(), kEnd);
    const double slid = processorSeconds();
    look();
    const double ended = processorSeconds();
    all_.push_back(ended - begin);
    stamp_.push_back(stamped - begin);
    slide_.push_back(slid - stamped);
    look_.push_back(ended - slid);
  }

  double print() const {
    const double all = median(all_);
    std::printf("%7zu vertices: %.3f ms; stamp %.3f, steps %.3f, snapshot and samples %.3f\n",
                static_cast<const SandIsland&>(*island_).surface().mesh().vertexCount(), 1e3 * all,
                1e3 * median(stamp_), 1e3 * median(slide_), 1e3 * median(look_));
    return all;
  }

 private:
  static constexpr std::uint64_t kEnd = std::numeric_limits<std::uint64_t>::max();
  static constexpr int kApron = 32;                       // squares, to which sand might run
  static constexpr double kMargin = 36.0 + 2.0 * kApron;  // [m]

  double side() const noexcept { return (region_.sampleColumns() - 1) * region_.spacing; }
  void press(const Stamp& stamp) {
    if (const Result<void> pressed = island_->apply(stamp); !pressed) {
      std::fprintf(stderr, "bench-island: %s\n", pressed.error().message.c_str());
      std::exit(1);
    }
  }
  void look() {
    const auto snapshot = island_->snapshot();
    const SampleRectangle changed = snapshot->changed();
    HeightMap out(changed.columns, changed.rows);
    snapshot->samples(changed, out.view());
  }

  RandomSequence random_;
  DeformRegion region_{.intervals = 8, .spacing = 2.0};
  std::unique_ptr<LiveSurface> island_;
  std::vector<double> all_, stamp_, slide_, look_;
};

}  // namespace
}  // namespace teren

int main(int argc, char** argv) {
  const int stamps = argc > 1 ? std::atoi(argv[1]) : 400;
  teren::Digging small(64), large(192);
  for (int n = 0; n < stamps; ++n) {
    small.dig();
    large.dig();
  }
  const double one = small.print(), other = large.print();
  std::printf("ratio %.2f\n", other / one);
}
