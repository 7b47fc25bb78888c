// A good filter: adds one height to every sample.
#include "Broken.h"

namespace {

class Raise final : public teren::Filter {
 public:
  static std::span<const teren::Parameter> parameters() noexcept {
    static constexpr std::array table = {
        teren::Parameter::real("height", 1.0, -1000.0, 1000.0, "m", "what is added")};
    return table;
  }
  explicit Raise(const teren::Values& values) : height_(values.real("height")) {}
  teren::HeightRange range(const teren::HeightRange& before) const override {
    return {before.mean + height_, before.deviation, before.min + height_, before.max + height_};
  }
  double residual(double before, int) const override { return before; }
  std::unique_ptr<teren::SlicedTask> begin(const teren::MapRequest&, teren::HeightView inOut) const override {
    return std::make_unique<Task>(inOut, static_cast<float>(height_));
  }

 private:
  class Task final : public teren::SlicedTask {
   public:
    Task(teren::HeightView inOut, float height) : inOut_(inOut), height_(height) {}
    bool step(const teren::Slice&) override {
      for (int row = 0; row < inOut_.rows(); ++row) {
        for (int column = 0; column < inOut_.columns(); ++column) inOut_(column, row) += height_;
      }
      return true;
    }

   private:
    teren::HeightView inOut_;
    float height_;
  };
  double height_;
};

}  // namespace

TEREN_FILTER_PLUGIN(Raise, "raise", "1.0", "adds one height")
