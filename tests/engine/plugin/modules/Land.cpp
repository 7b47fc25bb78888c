// A flat land as high as its version. It is in no nameless namespace and its table is a static of an inline
// function, so the compiler marks it as unique in a process. The third version is refused for its id.
#include "Broken.h"

class Land final : public teren::Generator {
 public:
  static std::span<const teren::Parameter> parameters() noexcept {
    static constexpr std::array table = {
#if LAND_VERSION > 1
      teren::Parameter::real("more", 0.0, 0.0, 9.0, "m", "what the first version had not"),
#endif
      teren::Parameter::real("height", 0.0, 0.0, 9.0, "m", "how much higher than its version")
    };
    return table;
  }
  explicit Land(const teren::Values& values) : height_(LAND_VERSION + values.real("height")), flat_(values) {}
  teren::HeightRange range() const override {
    return {height_, 0.0, height_, height_};
  }
  double residual(int, int, double) const override {
    return 0.0;
  }
  std::unique_ptr<teren::GenerationTask> begin(const teren::MapRequest& request,
                                               teren::HeightView out) const override {
    return flat_.begin(request, out);
  }

 private:
  double height_;
  broken::Flat flat_;
};

#if LAND_VERSION == 1
TEREN_GENERATOR_PLUGIN(Land, "land", "1", "flat")
#elif LAND_VERSION == 2
TEREN_GENERATOR_PLUGIN(Land, "land", "2", "flat")
#else
TEREN_GENERATOR_PLUGIN(Land, "other", "3", "flat")
#endif
