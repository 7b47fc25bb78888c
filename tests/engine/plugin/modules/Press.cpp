// A good deformer: presses the one sample down that is nearest.
#include <array>
#include <cmath>
#include <span>

#include "teren/Plugin.h"

namespace {

using namespace teren;

class Ground final : public DeformedGround {
 public:
  Ground(double spacing, HeightMap map) : spacing_(spacing), map_(std::move(map)) {}
  double height(double east, double north) const override {
    return map_(static_cast<int>(std::lround(east / spacing_)),
                static_cast<int>(std::lround(north / spacing_)));
  }
  void samples(const SampleRectangle& rectangle, HeightView out) const override {
    for (int y = 0; y < rectangle.rows; ++y) {
      for (int x = 0; x < rectangle.columns; ++x) out(x, y) = map_(rectangle.column + x, rectangle.row + y);
    }
  }
  SampleRectangle changed() const override { return {0, 0, map_.columns(), map_.rows()}; }

 private:
  double spacing_;
  HeightMap map_;
};

class Surface final : public LiveSurface {
 public:
  Surface(double spacing, ConstHeightView ground) : spacing_(spacing), map_(ground.columns(), ground.rows()) {
    for (int y = 0; y < ground.rows(); ++y) std::copy_n(ground.row(y), ground.columns(), map_.view().row(y));
  }
  Result<void> apply(const Stamp& stamp) override {
    map_(static_cast<int>(std::lround(stamp.east / spacing_)),
         static_cast<int>(std::lround(stamp.north / spacing_))) -=
        static_cast<float>(stamp.depth * stamp.values.real("strength"));
    return {};
  }
  bool step(const Slice&, std::uint64_t) override { return true; }
  std::uint64_t steps() const noexcept override { return 0; }
  bool atRest() const noexcept override { return true; }
  std::shared_ptr<const DeformedGround> snapshot() override {
    return std::make_shared<Ground>(spacing_, map_);
  }
  std::size_t bytes() const noexcept override { return sizeof(*this) + map_.bytes(); }

 private:
  double spacing_;
  HeightMap map_;
};

class Press final : public Deformer {
 public:
  static std::span<const Parameter> parameters() noexcept {
    static constexpr std::array table = {
        Parameter::real("strength", 1.0, 0.0, 10.0, "", "by what the depth is multiplied")};
    return table;
  }
  Result<double> reach(const Stamp&, double spacing) const override { return spacing; }
  Result<std::unique_ptr<LiveSurface>> begin(const DeformRegion& region,
                                             ConstHeightView ground) const override {
    return std::unique_ptr<LiveSurface>(std::make_unique<Surface>(region.spacing, ground));
  }
};

}  // namespace

TEREN_DEFORMER_PLUGIN(Press, "press", "1.0", "presses one sample down")
