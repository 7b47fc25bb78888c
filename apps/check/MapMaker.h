// Makes maps with the plugin that is checked: a generator makes them anew, a filter changes noise of the
// map's own seed. Whatever the plugin throws on the way becomes a counter-example that says which map it was.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "teren/ContinuousGenerator.h"
#include "teren/Filter.h"
#include "teren/Generator.h"
#include "teren/HeightMap.h"

namespace teren::check {

inline constexpr double kPitch = 64.0;  ///< [m] of the layer whose maps and fields are tried

/// Request number n, at its own lattice point far from zero, of a layer with a pitch of 64 m whose finest
/// maps have `samples` samples a side.
MapRequest requestOf(int n, int samples, int level = 0);

/// One plugin with one setting; any thread may use it, as any may use a generator or filter.
class MapMaker {
 public:
  MapMaker(std::shared_ptr<const Generator> generator, std::string setting);
  MapMaker(std::shared_ptr<const Filter> filter, std::string setting);

  bool filters() const noexcept { return filter_ != nullptr; }
  const std::string& setting() const noexcept { return setting_; }

  /// Levels are the finest map, subsampled.
  bool exactLevels() const;
  HeightRange range() const;
  double residual(int level, int samples) const;
  /// What a filter promises of maps with this residual.
  double filteredResidual(double before, int level) const;

  /// What the plugin begins with: of a filter a map of noise, of a generator a map of NaN, so that a sample
  /// it leaves out is seen.
  void prepare(const MapRequest& request, HeightView map) const;
  /// The plugin's own task on a prepared map; never null.
  std::unique_ptr<SlicedTask> begin(const MapRequest& request, HeightView map) const;

  /// A whole map, in steps of this slice; `steps`, if asked, becomes their number.
  HeightMap make(const MapRequest& request, const Slice& slice = Slice::unlimited(),
                 std::int64_t* steps = nullptr) const;

  /// The plugin as a continuous generator; null where it is none.
  const ContinuousGenerator* continuous() const;
  /// A whole rectangle of its field; it must have one.
  HeightMap field(const FieldRequest& request, const Slice& slice = Slice::unlimited()) const;

  /// The map a filter changes.
  HeightMap source(const MapRequest& request) const;

  /// "with NAME = VALUE at lattice point (I, J), seed S, level L, W x W samples".
  std::string place(const MapRequest& request) const;
  std::string place(const FieldRequest& request) const;

 private:
  class Task;
  std::unique_ptr<SlicedTask> watched(std::string place, std::int64_t limit,
                                      std::unique_ptr<SlicedTask> task) const;

  std::shared_ptr<const Generator> generator_;  // what a filter changes, or the plugin
  std::shared_ptr<const Filter> filter_;
  std::string setting_;
};

/// Steps until the task is done; returns the number of steps.
std::int64_t finish(SlicedTask& task, const Slice& slice = Slice::unlimited());

/// Where two maps of the same sides differ first: "sample (X, Y) is A m ONE but B m OTHER"; empty where they
/// are the same, bit for bit.
std::string difference(ConstHeightView a, const std::string& one, ConstHeightView b,
                       const std::string& other);

}  // namespace teren::check
