#include "world/BaseMap.h"

#include <string>
#include <utility>
#include <vector>

#include "teren/Hash.h"
#include "teren/HeightMapOperations.h"
#include "teren/StepLimit.h"

namespace teren {

std::size_t BaseMapKeyHash::operator()(const BaseMapKey& key) const noexcept {
  const auto place = (static_cast<std::uint64_t>(key.layer) << 32) | static_cast<std::uint32_t>(key.level);
  return hashWith(hashWith(place, static_cast<std::uint64_t>(key.i)), static_cast<std::uint64_t>(key.j));
}

BaseMapTask::BaseMapTask(const Layer& layer, const BaseMapKey& key)
    : layer_(layer),
      request_(layer.request(key.i, key.j, key.level)),
      map_(std::make_shared<HeightMap>(request_.samples, request_.samples)),
      work_(workOf(0)) {}

PluginWork BaseMapTask::workOf(std::size_t stage) {
  return {layer_, stage, stepLimit(request_.samples, request_.samples), [this, stage] {
            return stage == 0 ? layer_.generator().begin(request_, map_->view())
                              : layer_.filters()[stage - 1]->begin(request_, map_->view());
          }};
}

bool BaseMapTask::step(const Slice& slice) {
  if (!stepPlugins(slice)) return false;
  if (!failed_) check();
  return true;
}

bool BaseMapTask::stepPlugins(const Slice& slice) {
  const std::size_t last = layer_.filters().size();
  while (true) {
    const PluginWork::State state = work_.step(slice);
    if (state == PluginWork::State::working) return false;
    if (state == PluginWork::State::failed) fail(work_.failure());
    if (failed_ || stage_ == last) return true;
    work_ = workOf(++stage_);
    if (slice.over()) return false;
  }
}

void BaseMapTask::check() {
  for (const float height : map_->samples()) {
    if (!layer_.accepts(height)) return fail(layer_.refusal(height));
  }
}

void BaseMapTask::fail(const std::string& cause) {
  failed_ = true;
  fillHeights(map_->view(), static_cast<float>(layer_.range().mean));
  layer_.reportFailure(cause, request_.i, request_.j);
}

BaseMap BaseMapStore::find(const BaseMapKey& key) {
  const std::lock_guard lock(mutex_);
  const std::list<Entry>::iterator* const found = index_.find(key);
  if (found == nullptr) return nullptr;
  entries_.splice(entries_.begin(), entries_, *found);
  return (*found)->map;
}

void BaseMapStore::insert(const BaseMapKey& key, BaseMap map) {
  std::vector<BaseMap> dropped;
  const std::lock_guard lock(mutex_);
  if (index_.contains(key)) return;  // made twice at once: both have the same bits
  entries_.push_front({key, std::move(map)});
  index_.insert(key, entries_.begin());
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
