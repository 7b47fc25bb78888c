// Base maps: how one is made (generator, then filters, then the door), and where finished ones are kept.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>
#include <mutex>

#include "teren/HeightMap.h"
#include "teren/Slice.h"

#include "world/Layer.h"
#include "world/PluginWork.h"
#include "world/SteadyMap.h"

namespace teren {

struct BaseMapKey {
  int layer = 0;  ///< index into World::layers
  int level = 0;  ///< of the map, not of the world
  std::int64_t i = 0, j = 0;
  friend bool operator==(const BaseMapKey&, const BaseMapKey&) = default;
};

struct BaseMapKeyHash {
  std::size_t operator()(const BaseMapKey& key) const noexcept;
};

using BaseMap = std::shared_ptr<const HeightMap>;

/// The making of one base map. Whatever a plugin does - throw, write NaN, leave its promised range, never be
/// done (see StepLimit.h) - the map comes out finite: a failed one is the layer's mean everywhere, and the
/// layer reports one sentence.
class BaseMapTask final : public SlicedTask {
 public:
  BaseMapTask(const Layer& layer, const BaseMapKey& key);
  bool step(const Slice& slice) override;

  /// Complete once step has returned true.
  BaseMap result() const { return map_; }

 private:
  PluginWork workOf(std::size_t stage);
  /// True when all plugins are done, or one has failed.
  bool stepPlugins(const Slice& slice);
  void check();
  void fail(const std::string& cause);

  const Layer& layer_;
  MapRequest request_;
  std::shared_ptr<HeightMap> map_;
  std::size_t stage_ = 0;  // 0: generator, k: filter k - 1
  PluginWork work_;        // of this stage
  bool failed_ = false;
};

/// Finished base maps, the least recently used dropped first when more than `capacity` bytes are held (they
/// can be made again, to the same bits); one is always kept. Thread-safe; what a caller holds stays alive
/// beyond its dropping.
class BaseMapStore {
 public:
  explicit BaseMapStore(std::size_t capacity) : capacity_(capacity) {}

  BaseMap find(const BaseMapKey& key);
  void insert(const BaseMapKey& key, BaseMap map);
  std::size_t bytes() const;

  /// Maps beyond a new, lower capacity go when the next is inserted, or one by one with dropOldest.
  void setCapacity(std::size_t capacity);
  /// Drops the least recently used map if more than the capacity is held. False: nothing was to be dropped.
  bool dropOldest();

 private:
  struct Entry {
    BaseMapKey key;
    BaseMap map;
  };
  static std::size_t cost(const BaseMap& map) noexcept;
  /// Takes the oldest out, for the caller to destroy once the lock is released; null: all fits.
  BaseMap takeOldest();

  mutable std::mutex mutex_;
  std::size_t capacity_;
  std::size_t bytes_ = 0;
  std::list<Entry> entries_;  // most recently used first
  SteadyMap<BaseMapKey, std::list<Entry>::iterator, BaseMapKeyHash> index_;
};

}  // namespace teren
