#include "world/Layer.h"

#include <algorithm>
#include <utility>

#include "teren/Hash.h"

namespace teren {

void MessageBox::post(const std::string& source, const std::string& sentence) {
  const std::lock_guard lock(mutex_);
  if (std::find(sources_.begin(), sources_.end(), source) != sources_.end()) return;
  sources_.push_back(source);
  sentences_.push_back(sentence);
}

std::vector<std::string> MessageBox::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(sentences_, {});
}

Layer::Layer(std::string name, std::uint64_t worldSeed, double worldPitch, int worldBits, int pitchShift,
             int layerBits, BlendKernel kernel, bool preserveVariance,
             std::shared_ptr<const Generator> generator, std::vector<std::shared_ptr<const Filter>> filters,
             const HeightRange& range, std::shared_ptr<MessageBox> messages)
    : name_(std::move(name)),
      worldSeed_(worldSeed),
      pitch_(worldPitch * static_cast<double>(std::int64_t{1} << pitchShift)),
      worldBits_(worldBits),
      pitchShift_(pitchShift),
      layerBits_(layerBits),
      // Grid spacing (pitch / n) 2^L <= layer pitch / 4.
      cutLevel_(std::max(0, worldBits + pitchShift - 2)),
      kernel_(kernel),
      preserveVariance_(preserveVariance),
      generator_(std::move(generator)),
      filters_(std::move(filters)),
      range_(range),
      messages_(std::move(messages)) {}

int Layer::mapLevel(int level) const noexcept {
  return level == 0 ? 0 : std::max(0, level - (worldBits_ + pitchShift_ - layerBits_));
}

int Layer::mapSamples(int mapLevel) const noexcept {
  return mapLevel > layerBits_ ? 1 : (2 << (layerBits_ - mapLevel)) + 1;
}

MapRequest Layer::request(std::int64_t i, std::int64_t j, int mapLevel) const noexcept {
  MapRequest request;
  request.i = i;
  request.j = j;
  request.seed = mapSeed(worldSeed_, name_, i, j);
  request.samples = mapSamples(mapLevel);
  request.level = mapLevel;
  request.finestIntervals = 2 << layerBits_;
  request.spacing = pitch_ / (1 << layerBits_) * static_cast<double>(std::int64_t{1} << mapLevel);
  return request;
}

}  // namespace teren
