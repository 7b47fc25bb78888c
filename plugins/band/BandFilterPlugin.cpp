// The plugin "band": the band filter (generators/filter).
#include "teren/Plugin.h"

#include "generators/filter/BandFilter.h"

namespace {

class BandFilterPlugin final : public teren::Filter {
 public:
  static std::span<const teren::Parameter> parameters() noexcept {
    using teren::Parameter;
    static constexpr Parameter table[] = {
        Parameter::real("k", 0.9, teren::BandFilter::kMinK, 1.0, "",
                        "Share of its own height a sample keeps in a sweep; 1 changes nothing, less smooths"),
        Parameter::integer(
            "passes", 5, 1, teren::BandFilter::kMaxPasses, "",
            "How often all four sweeps are done; more smooth more and cost proportionally more"),
    };
    return table;
  }

  explicit BandFilterPlugin(const teren::Values& values)
      : filter_(values.real("k"), static_cast<int>(values.integer("passes"))) {}

  teren::HeightRange range(const teren::HeightRange& before) const override { return filter_.range(before); }
  double residual(double before, int level) const override { return filter_.residual(before, level); }
  std::unique_ptr<teren::SlicedTask> begin(const teren::MapRequest&, teren::HeightView inOut) const override {
    return filter_.begin(inOut);
  }

 private:
  teren::BandFilter filter_;
};

}  // namespace

TEREN_FILTER_PLUGIN(BandFilterPlugin, "band", "1.0",
                    "Band filter: rounds the edges of a map, row by row and column by column")
