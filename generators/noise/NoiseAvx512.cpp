// Noise 16 samples at a time; compiled for processors with AVX-512 F, BW, DQ and VL.
#include <immintrin.h>

#include "generators/noise/NoiseKernel.h"

namespace teren {
namespace {

struct Lanes16 {
  static constexpr int kCount = 16;
  typedef float Floats __attribute__((vector_size(64)));
  typedef std::uint32_t Words __attribute__((vector_size(64)));
  typedef std::int32_t Signed __attribute__((vector_size(64)));

  static Floats set(float value) { return (Floats)_mm512_set1_ps(value); }
  static Words word(std::uint32_t value) { return (Words)_mm512_set1_epi32(static_cast<int>(value)); }
  static Floats load(const float* from) { return (Floats)_mm512_loadu_ps(from); }
  static Words load(const std::uint32_t* from) { return (Words)_mm512_loadu_si512(from); }
  static void store(float* to, Floats value) { _mm512_storeu_ps(to, (__m512)value); }

  template <class Mask, class T>
  static T choose(Mask condition, T yes, T no) {
    return condition ? yes : no;
  }
  static Floats size(Floats value) { return (Floats)((Words)value & word(0x7fffffffu)); }
  static Floats toFloats(Words value) { return __builtin_convertvector((Signed)value, Floats); }
  static Words toWords(Floats value) { return (Words) __builtin_convertvector(value, Signed); }

  class Gradients {
   public:
    explicit Gradients(NoiseKind kind)
        : east_(load(noiseGradients(kind).east)), north_(load(noiseGradients(kind).north)) {}
    /// With a mask, for without it GCC 12 warns of its own header.
    void look(Words hash, Floats& east, Floats& north) const {
      const auto index = (__m512i)(hash >> 28);
      east = (Floats)_mm512_maskz_permutexvar_ps(0xffff, index, (__m512)east_);
      north = (Floats)_mm512_maskz_permutexvar_ps(0xffff, index, (__m512)north_);
    }

   private:
    Floats east_, north_;
  };
};

}  // namespace

NoiseRowKernel noiseKernelAvx512(NoiseVariant variant) noexcept {
  return noiseKernelOf<Lanes16>(variant);
}

}  // namespace teren
