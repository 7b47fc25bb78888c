// Noise 8 samples at a time; compiled for processors with AVX2.
#include <immintrin.h>

#include "generators/noise/NoiseKernel.h"

namespace teren {
namespace {

struct Lanes8 {
  static constexpr int kCount = 8;
  typedef float Floats __attribute__((vector_size(32)));
  typedef std::uint32_t Words __attribute__((vector_size(32)));
  typedef std::int32_t Signed __attribute__((vector_size(32)));

  static Floats set(float value) { return (Floats)_mm256_set1_ps(value); }
  static Words word(std::uint32_t value) { return (Words)_mm256_set1_epi32(static_cast<int>(value)); }
  static Floats load(const float* from) { return (Floats)_mm256_loadu_ps(from); }
  static Words load(const std::uint32_t* from) {
    return (Words)_mm256_loadu_si256(reinterpret_cast<const __m256i*>(from));
  }
  static void store(float* to, Floats value) { _mm256_storeu_ps(to, (__m256)value); }

  template <class Mask, class T>
  static T choose(Mask condition, T yes, T no) {
    return condition ? yes : no;
  }
  static Floats size(Floats value) { return (Floats)((Words)value & word(0x7fffffffu)); }
  static Floats toFloats(Words value) { return __builtin_convertvector((Signed)value, Floats); }
  static Words toWords(Floats value) { return (Words) __builtin_convertvector(value, Signed); }

  /// The table's even entries; odd ones are their opposites.
  class Gradients {
   public:
    explicit Gradients(NoiseKind kind) {
      const NoiseGradients& all = noiseGradients(kind);
      for (int n = 0; n < 8; ++n) {
        east_[n] = all.east[2 * n];
        north_[n] = all.north[2 * n];
      }
    }
    void look(Words hash, Floats& east, Floats& north) const {
      const auto index = (__m256i)(hash >> 29);
      const Words sign = (hash << 3) & 0x80000000u;
      east = (Floats)((Words)_mm256_permutevar8x32_ps((__m256)east_, index) ^ sign);
      north = (Floats)((Words)_mm256_permutevar8x32_ps((__m256)north_, index) ^ sign);
    }

   private:
    Floats east_, north_;
  };
};

}  // namespace

NoiseRowKernel noiseKernelAvx2(NoiseVariant variant) noexcept {
  return noiseKernelOf<Lanes8>(variant);
}

}  // namespace teren
