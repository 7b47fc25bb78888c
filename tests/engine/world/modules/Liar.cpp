// A filter that lies about its range, or throws.
#include "tests/engine/world/modules/Promise.h"

namespace {

class Liar final : public teren::Filter {
 public:
  static std::span<const teren::Parameter> parameters() noexcept { return hostile::parameters(); }
  explicit Liar(const teren::Values& values) : way_(values.choice("way")) {}
  teren::HeightRange range(const teren::HeightRange&) const override { return hostile::promise(way_); }
  double residual(double before, int) const override { return before; }
  std::unique_ptr<teren::SlicedTask> begin(const teren::MapRequest&, teren::HeightView) const override {
    return nullptr;
  }

 private:
  std::string way_;
};

}  // namespace

TEREN_FILTER_PLUGIN(Liar, "liar", "1.0", "a filter that breaks its promises")
