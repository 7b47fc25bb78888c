// Noise one sample at a time, for any processor.
#include "generators/noise/NoiseKernel.h"

namespace teren {
namespace {

struct Lane {
  static constexpr int kCount = 1;
  using Floats = float;
  using Words = std::uint32_t;

  static Floats set(float value) { return value; }
  static Words word(std::uint32_t value) { return value; }
  static Floats load(const float* from) { return *from; }
  static Words load(const std::uint32_t* from) { return *from; }
  static void store(float* to, Floats value) { *to = value; }

  template <class T>
  static T choose(bool condition, T yes, T no) {
    return condition ? yes : no;
  }
  static Floats size(Floats value) { return __builtin_fabsf(value); }
  static Floats toFloats(Words value) { return static_cast<float>(static_cast<std::int32_t>(value)); }
  static Words toWords(Floats value) { return static_cast<std::uint32_t>(static_cast<std::int32_t>(value)); }

  class Gradients {
   public:
    explicit Gradients(NoiseKind kind) : all_(noiseGradients(kind)) {}
    void look(Words hash, Floats& east, Floats& north) const {
      east = all_.east[hash >> 28];
      north = all_.north[hash >> 28];
    }

   private:
    const NoiseGradients& all_;
  };
};

}  // namespace

NoiseRowKernel noiseKernelPlain(NoiseVariant variant) noexcept {
  return noiseKernelOf<Lane>(variant);
}

}  // namespace teren
