// A generator that lies about its range, or throws.
#include <limits>

#include "tests/engine/world/modules/Promise.h"

namespace {

class Hostile final : public teren::Generator {
 public:
  static std::span<const teren::Parameter> parameters() noexcept { return hostile::parameters(); }
  explicit Hostile(const teren::Values& values) : way_(values.choice("way")) {}
  teren::HeightRange range() const override { return hostile::promise(way_); }
  double residual(int, int) const override { return 0.0; }
  std::unique_ptr<teren::GenerationTask> begin(const teren::MapRequest&,
                                               teren::HeightView out) const override {
    return std::make_unique<Task>(out);
  }

 private:
  /// Even where the promise was sound, the map is not.
  class Task final : public teren::GenerationTask {
   public:
    explicit Task(teren::HeightView out) : out_(out) {}
    bool step(const teren::Slice&) override {
      out_(0, 0) = std::numeric_limits<float>::quiet_NaN();
      return true;
    }

   private:
    teren::HeightView out_;
  };
  std::string way_;
};

}  // namespace

TEREN_GENERATOR_PLUGIN(Hostile, "hostile", "1.0", "a generator that breaks its promises")
