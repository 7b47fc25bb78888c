// Puts a deformer to work: stamps of every setting that it takes, ground to press them into, and live
// surfaces under watch. Whatever the plugin throws becomes a counter-example that says which stamp it was.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "teren/Deformer.h"
#include "teren/HeightMap.h"

#include "apps/check/Subject.h"

namespace teren::check {

inline constexpr std::uint64_t kToRest = std::numeric_limits<std::uint64_t>::max();

/// A stamp, and how it is told to a person.
struct TriedStamp {
  Stamp stamp;
  double reach = 0.0;  ///< [m]
  std::string text;
};

/// What a deformer is asked to do: stamps, all of which their region holds, and that region.
struct DeformTask {
  DeformRegion region;
  std::vector<TriedStamp> stamps;
};

/// One deformer; any thread may use it.
class DeformTrial {
 public:
  static constexpr double kSpacing = 2.0;  ///< [m]
  static constexpr int kIntervals = 16;
  static constexpr int kMostPatches = 64;  ///< along a side of a region

  /// The subject must outlive it.
  explicit DeformTrial(const Subject& subject);

  const Deformer& deformer() const noexcept { return *deformer_; }

  /// Stamps of this setting of several sizes, depths and places, as many of six as are taken; an error where
  /// none is.
  Result<DeformTask> taskOf(const Setting& setting) const;
  /// For each setting of the subject with which some stamp is taken, and one that takes stamps of all
  /// settings in turn. The first is of the defaults, which must be among them.
  std::vector<DeformTask> tasks() const;

  /// Gentle hills 300 m high, all slopes below 1/4.
  static HeightMap hills(const DeformRegion& region);
  /// Every sample another height of -1000 ... 1000 m.
  static HeightMap rubble(const DeformRegion& region);

  /// Deformer::reach: a sentence or a distance, anything else is a counter-example.
  Result<double> reach(const Stamp& stamp, const std::string& text) const;

 private:
  const PluginInfo& info_;
  std::span<const Setting> settings_;
  std::shared_ptr<const Deformer> deformer_;
};

/// A live surface. Every call is watched.
class WatchedSurface {
 public:
  WatchedSurface(const DeformTrial& trial, const DeformRegion& region, ConstHeightView ground);

  /// The stamp must be taken.
  void apply(const TriedStamp& stamp);
  /// The sentence with which it refuses; empty where it has taken the stamp.
  std::string refusal(const Stamp& stamp, const std::string& text);
  bool step(const Slice& slice, std::uint64_t upTo);
  /// step() in such slices until it says it is done; a counter-example where it never is.
  void advance(const Slice& slice, std::uint64_t upTo);

  /// The sentence with which it refuses to grow; empty where it has.
  std::string grow(const DeformRegion& region, ConstHeightView ground);

  void layLoose(ConstHeightView depths);
  bool loose(HeightView depths) const;

  std::uint64_t steps() const;
  bool atRest() const;
  std::size_t bytes() const;
  std::shared_ptr<const DeformedGround> snapshot();
  HeightMap heights();

  /// "after NAME, NAME": the stamps so far.
  std::string past() const;

 private:
  template <class Call>
  auto watched(const Call& call) const;

  DeformRegion region_;
  std::unique_ptr<LiveSurface> surface_;
  std::string past_;
};

/// All samples of a snapshot.
HeightMap heightsOf(const DeformedGround& ground, const DeformRegion& region);

/// Throws a counter-example where the two are not the same, bit for bit.
void expectSame(ConstHeightView a, const std::string& one, ConstHeightView b, const std::string& other,
                const std::string& where);

}  // namespace teren::check
