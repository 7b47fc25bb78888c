#include "world/BaseMap.h"

#include <cmath>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include "teren/Hash.h"
#include "teren/HeightMapOperations.h"
#include "teren/Parameter.h"
#include "teren/Quote.h"

#include "plugin/Thrown.h"
#include "world/StepLimit.h"

namespace teren {

std::size_t BaseMapKeyHash::operator()(const BaseMapKey& key) const noexcept {
  const auto place = (static_cast<std::uint64_t>(key.layer) << 32) | static_cast<std::uint32_t>(key.level);
  return hashWith(hashWith(place, static_cast<std::uint64_t>(key.i)), static_cast<std::uint64_t>(key.j));
}

BaseMapTask::BaseMapTask(const Layer& layer, const BaseMapKey& key)
    : layer_(layer),
      request_(layer.request(key.i, key.j, key.level)),
      map_(std::make_shared<HeightMap>(request_.samples, request_.samples)) {}

bool BaseMapTask::step(const Slice& slice) {
  try {
    if (!stepPlugins(slice)) return false;
  } catch (const std::exception& problem) {
    fail(culprit(), "threw " + inQuotes(textOf(problem)));
  } catch (...) {
    fail(culprit(), "threw something that is no std::exception");
  }
  if (!failed_) check();
  return true;
}

bool BaseMapTask::stepPlugins(const Slice& slice) {
  while (!failed_ && stage_ <= layer_.filters().size()) {
    const StepWatch::Start start = StepWatch::start(slice);
    if (!current_) {
      current_ = stage_ == 0 ? layer_.generator().begin(request_, map_->view())
                             : layer_.filters()[stage_ - 1]->begin(request_, map_->view());
    }
    if (!current_) {
      fail(culprit(), "began no task");
      break;
    }
    const bool done = current_->step(slice);
    if (const auto overrun = layer_.watch(stage_).finish(slice, start))
      layer_.reportOverrun(stage_, *overrun);
    if (!done) {
      if (++steps_ < stepLimit(request_.samples, request_.samples)) return false;
      fail(culprit(), "is not done after " + std::to_string(steps_) + " steps");
      break;
    }
    current_.reset();
    steps_ = 0;
    ++stage_;
    if (slice.over() && stage_ <= layer_.filters().size()) return false;
  }
  return true;
}

void BaseMapTask::check() {
  const HeightRange& range = layer_.range();
  for (const float height : map_->samples()) {
    if (std::isfinite(height) && height >= range.min && height <= range.max) continue;
    std::string all = layer_.pluginIds().size() == 1 ? "plugin " : "its plugins ";
    for (const std::string& id : layer_.pluginIds()) all += (all.back() == ' ' ? "" : ", ") + inQuotes(id);
    fail(all, "wrote the height " + numberText(height) + " m, outside the promised range of " +
                  numberText(range.min) + " to " + numberText(range.max) + " m");
    return;
  }
}

std::string BaseMapTask::culprit() const {
  return "plugin " + inQuotes(layer_.pluginIds()[stage_]);
}

void BaseMapTask::fail(const std::string& who, const std::string& what) {
  failed_ = true;
  current_.reset();
  fillHeights(map_->view(), static_cast<float>(layer_.range().mean));
  layer_.reportFailure("layer " + inQuotes(layer_.name()) + ": " + who + " " + what + " at lattice point (" +
                       std::to_string(request_.i) + ", " + std::to_string(request_.j) + ")");
}

BaseMap BaseMapStore::find(const BaseMapKey& key) {
  const std::lock_guard lock(mutex_);
  const auto found = index_.find(key);
  if (found == index_.end()) return nullptr;
  entries_.splice(entries_.begin(), entries_, found->second);
  return found->second->map;
}

void BaseMapStore::insert(const BaseMapKey& key, BaseMap map) {
  std::vector<BaseMap> dropped;
  const std::lock_guard lock(mutex_);
  if (index_.contains(key)) return;  // made twice at once: both have the same bits
  entries_.push_front({key, std::move(map)});
  index_.emplace(key, entries_.begin());
  bytes_ += cost(entries_.front().map);
  while (BaseMap oldest = takeOldest()) dropped.push_back(std::move(oldest));
}

BaseMap BaseMapStore::takeOldest() {
  if (bytes_ <= capacity_ || entries_.size() < 2) return nullptr;
  BaseMap oldest = std::move(entries_.back().map);
  bytes_ -= cost(oldest);
  index_.erase(entries_.back().key);
  entries_.pop_back();
  return oldest;
}

void BaseMapStore::setCapacity(std::size_t capacity) {
  const std::lock_guard lock(mutex_);
  capacity_ = capacity;
}

bool BaseMapStore::dropOldest() {
  BaseMap dropped;
  const std::lock_guard lock(mutex_);
  dropped = takeOldest();
  return dropped != nullptr;
}

std::size_t BaseMapStore::bytes() const {
  const std::lock_guard lock(mutex_);
  return bytes_;
}

std::size_t BaseMapStore::cost(const BaseMap& map) noexcept {
  // The list's and the index's own nodes and the map's control block come to about 160 bytes.
  return map->bytes() + sizeof(HeightMap) + sizeof(Entry) + 160;
}

}  // namespace teren
