// Integer hashes and the random numbers made of them: the only source of randomness in Teren, because
// std distributions differ between standard libraries and would break "same bits" (law 1).
#pragma once

#include <cstdint>
#include <string_view>

namespace teren {

/// Bijective mixing of 64 bits; every input bit changes each output bit with probability close to one half
/// (finaliser of SplitMix64: Steele, Lea, Flood 2014, with Stafford's constants, variant 13).
constexpr std::uint64_t mixBits(std::uint64_t x) noexcept {
  x ^= x >> 30;
  x *= 0xbf58476d1ce4e5b9ULL;
  x ^= x >> 27;
  x *= 0x94d049bb133111ebULL;
  x ^= x >> 31;
  return x;
}

/// Joins a hash with one more word; the order of the words matters.
constexpr std::uint64_t hashWith(std::uint64_t hash, std::uint64_t word) noexcept {
  return mixBits(hash * 0x9e3779b97f4a7c15ULL + mixBits(word + 0x632be59bd9b4e019ULL));
}

/// FNV-1a over bytes, 64 bits; also the hash `teren bake` prints.
class Fnv1a {
 public:
  constexpr void addByte(std::uint8_t byte) noexcept {
    value_ ^= byte;
    value_ *= 0x00000100000001b3ULL;
  }
  constexpr std::uint64_t value() const noexcept { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

constexpr std::uint64_t hashText(std::string_view text) noexcept {
  Fnv1a hash;
  for (char c : text) hash.addByte(static_cast<std::uint8_t>(c));
  return hash.value();
}

/// The seed of a layer: a pure function of the world's seed and the layer's name.
constexpr std::uint64_t layerSeed(std::uint64_t worldSeed, std::string_view layerName) noexcept {
  return hashWith(mixBits(worldSeed), hashText(layerName));
}

/// The seed of one base map: a pure function of the world's seed, the layer's name and the lattice point.
constexpr std::uint64_t mapSeed(std::uint64_t worldSeed, std::string_view layerName, std::int64_t i,
                                std::int64_t j) noexcept {
  const std::uint64_t hash = hashWith(layerSeed(worldSeed, layerName), static_cast<std::uint64_t>(i));
  return hashWith(hash, static_cast<std::uint64_t>(j));
}

/// A sequence of random 64-bit words: word n is a hash of (seed, n), so any of them can be had alone.
class RandomSequence {
 public:
  constexpr explicit RandomSequence(std::uint64_t seed, std::uint64_t position = 0) noexcept
      : seed_(mixBits(seed)), position_(position) {}

  constexpr std::uint64_t next() noexcept { return mixBits(seed_ + 0x9e3779b97f4a7c15ULL * ++position_); }

  /// Uniform in [0, 2^bits), 1 <= bits <= 63.
  constexpr std::int64_t nextBits(int bits) noexcept {
    return static_cast<std::int64_t>(next() >> (64 - bits));
  }

 private:
  std::uint64_t seed_;
  std::uint64_t position_;
};

}  // namespace teren
