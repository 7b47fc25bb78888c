#include "world/Layer.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "teren/Hash.h"
#include "teren/Parameter.h"
#include "teren/Quote.h"

namespace teren {

void MessageBox::postLocked(const std::string& source, const std::string& sentence) {
  if (std::find(sources_.begin(), sources_.end(), source) != sources_.end()) return;
  sources_.push_back(source);
  sentences_.push_back(sentence);
}

void MessageBox::post(const std::string& source, const std::string& sentence) {
  const std::lock_guard lock(mutex_);
  postLocked(source, sentence);
}

void MessageBox::postFailure(const std::string& layer, const std::string& cause) {
  const std::lock_guard lock(mutex_);
  if (!failure_) failure_ = cause;
  postLocked(layer, cause + "; the layer's mean takes its place there");
}

std::vector<std::string> MessageBox::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(sentences_, {});
}

std::optional<std::string> MessageBox::failure() {
  const std::lock_guard lock(mutex_);
  return failure_;
}

Layer::Layer(std::string name, std::uint64_t worldSeed, double worldPitch, int worldBits, int pitchShift,
             int layerBits, BlendKernel kernel, bool preserveVariance, LayerPlugins plugins,
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
      plugins_(std::move(plugins)),
      range_(range),
      messages_(std::move(messages)),
      watches_(std::make_shared<std::vector<StepWatch>>(plugins_.filters.size() + 1)) {
  assert(plugins_.ids.size() == plugins_.filters.size() + 1);
}

void Layer::reportOverrun(std::size_t stage, const Overrun& overrun) const {
  const auto milliseconds = [](std::chrono::nanoseconds time) {
    return numberText(static_cast<double>(time / std::chrono::microseconds(1)) / 1000.0) + " ms";
  };
  const std::string& id = plugins_.ids[stage];
  messages_->post(name_ + '\n' + id, "layer " + inQuotes(name_) + ": plugin " + inQuotes(id) + " used " +
                                         milliseconds(overrun.used) +
                                         " of processor time in a step that was given " +
                                         milliseconds(overrun.slice) + ", so frames come late");
}

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

double acrossCell(std::int64_t patch, double fraction, int pitchShift) noexcept {
  const std::int64_t mask = (std::int64_t{1} << pitchShift) - 1;
  return (static_cast<double>(patch & mask) + fraction) / static_cast<double>(std::int64_t{1} << pitchShift);
}

FieldRequest Layer::fieldRequest(const Position& first, int level, int columns, int rows) const noexcept {
  FieldRequest request;
  const auto place = [this](std::int64_t patch, double fraction, std::int64_t& point, double& offset) {
    point = patch >> pitchShift_;
    offset = acrossCell(patch, fraction, pitchShift_);
    if (offset < 1.0) return;
    offset = 0.0;  // a place so near to the next lattice line that it was rounded to it
    ++point;
  };
  place(first.i, first.u, request.i, request.u);
  place(first.j, first.v, request.j, request.v);
  request.seed = layerSeed(worldSeed_, name_);
  request.pitch = pitch_;
  request.spacing = pitch_ / static_cast<double>(std::int64_t{1} << cellBits()) *
                    static_cast<double>(std::int64_t{1} << level);
  request.columns = columns;
  request.rows = rows;
  request.level = level;
  return request;
}

std::string Layer::refusal(float height) const {
  std::string all = plugins_.ids.size() == 1 ? "plugin " : "its plugins ";
  for (const std::string& id : plugins_.ids) all += (all.back() == ' ' ? "" : ", ") + inQuotes(id);
  return all + " wrote the height " + numberText(height) + " m, outside the promised range of " +
         numberText(range_.min) + " to " + numberText(range_.max) + " m";
}

void Layer::reportFailure(const std::string& cause, std::int64_t i, std::int64_t j) const {
  messages_->postFailure(name_, "layer " + inQuotes(name_) + ": " + cause + " at lattice point (" +
                                    std::to_string(i) + ", " + std::to_string(j) + ")");
}

}  // namespace teren
