#include "teren/World.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <exception>
#include <map>
#include <set>

#include "teren/Quote.h"

#include "height/Surface.h"
#include "plugin/Thrown.h"
#include "world/BaseMap.h"
#include "world/ErrorBound.h"
#include "world/Layer.h"
#include "world/LayerSampler.h"

namespace teren {

namespace {

constexpr int kMaxPitchShift = 40;

/// k where samples = 2^k + 1, or -1.
int sideBits(int samples) {
  if (samples < 2) return -1;
  const auto intervals = static_cast<unsigned>(samples - 1);
  return std::has_single_bit(intervals) ? std::countr_zero(intervals) : -1;
}

Result<int> checkedSideBits(int samples, int least, int most, const std::string& where) {
  const int bits = sideBits(samples);
  if (bits >= 0 && samples >= least && samples <= most) return bits;
  return Error{where + "samples is " + std::to_string(samples) + ", expected 2^k + 1 from " +
               std::to_string(least) + " to " + std::to_string(most)};
}

/// m where pitch = worldPitch 2^m.
Result<int> checkedPitchShift(double pitch, double worldPitch, const std::string& where) {
  for (int shift = 0; shift <= kMaxPitchShift; ++shift) {
    if (pitch == worldPitch * static_cast<double>(std::int64_t{1} << shift)) return shift;
  }
  return Error{where + "pitch is " + numberText(pitch) + " m, expected the world's pitch of " +
               numberText(worldPitch) + " m times 2^m with m from 0 to " + std::to_string(kMaxPitchShift)};
}

/// Heights beyond this are refused: sums of layers stay far inside the range of float.
constexpr double kMaxHeight = 1e30;

Result<void> checkRange(const HeightRange& range, const std::string& plugin) {
  const auto held = [](double height) { return std::fabs(height) <= kMaxHeight; };  // false for NaN
  const bool finite = held(range.mean) && held(range.deviation) && held(range.min) && held(range.max);
  if (finite && range.deviation >= 0.0 && range.min <= range.mean && range.mean <= range.max) return {};
  return Error{plugin + " promises a range that makes no sense: mean " + numberText(range.mean) +
               ", deviation " + numberText(range.deviation) + ", min " + numberText(range.min) + ", max " +
               numberText(range.max)};
}

/// What `promise` of a plugin says, checked; a plugin that throws instead is refused too.
template <class Promise>
Result<HeightRange> promisedRange(const Promise& promise, const std::string& plugin) {
  std::string thrown = "something that is no std::exception";
  try {
    const HeightRange range = promise();
    if (const Result<void> sane = checkRange(range, plugin); !sane) return sane.error();
    return range;
  } catch (const std::exception& problem) {
    thrown = inQuotes(textOf(problem));
  } catch (...) {
  }
  return Error{plugin + " threw " + thrown + " when asked for its range"};
}

/// Gives unnamed layers their default names, in order; refuses two layers of one name.
Result<std::vector<LayerDescription>> namedLayers(std::vector<LayerDescription> layers) {
  std::set<std::string> taken;
  for (const LayerDescription& layer : layers) {
    if (layer.name.empty() || taken.insert(layer.name).second) continue;
    return Error{"two layers have the name " + inQuotes(layer.name) + ", expected each name once"};
  }
  std::map<std::string, std::int64_t> repetitions;  // of a generator's id
  for (LayerDescription& layer : layers) {
    if (!layer.name.empty()) continue;
    std::int64_t& number = repetitions[layer.generator];
    do {
      ++number;
      layer.name = number == 1 ? layer.generator : layer.generator + "-" + std::to_string(number);
    } while (!taken.insert(layer.name).second);
  }
  return layers;
}

Result<Layer> makeLayer(const LayerDescription& description, const WorldDescription& world, int worldBits,
                        const PluginRegistry& registry, const std::shared_ptr<MessageBox>& messages) {
  const std::string where = "layer " + inQuotes(description.name) + ": ";
  const Result<int> bits = checkedSideBits(description.samples, 3, 2049, where);
  if (!bits) return bits.error();
  const Result<int> shift = checkedPitchShift(description.pitch, world.pitch, where);
  if (!shift) return shift.error();
  Result<std::shared_ptr<const Generator>> generator =
      registry.makeGenerator(description.generator, description.parameters);
  if (!generator) return Error{where + generator.error().message};
  Result<HeightRange> range =
      promisedRange([&] { return (*generator)->range(); }, where + inQuotes(description.generator));
  if (!range) return range.error();
  LayerPlugins plugins{std::move(*generator), {}, {description.generator}};
  for (const FilterDescription& wanted : description.filters) {
    Result<std::shared_ptr<const Filter>> filter = registry.makeFilter(wanted.filter, wanted.parameters);
    if (!filter) return Error{where + filter.error().message};
    range = promisedRange([&] { return (*filter)->range(*range); }, where + inQuotes(wanted.filter));
    if (!range) return range.error();
    plugins.filters.push_back(std::move(*filter));
    plugins.ids.push_back(wanted.filter);
  }
  return Layer(description.name, world.seed, world.pitch, worldBits, *shift, *bits - 1, description.blend,
               description.preserveVariance, std::move(plugins), *range, messages);
}

BaseMap finishedMap(const Layer& layer, const BaseMapKey& key, BaseMapStore& store) {
  BaseMap map = store.find(key);
  if (map) return map;
  BaseMapTask task(layer, key);
  while (!task.step(Slice::unlimited())) {
  }
  store.insert(key, task.result());
  return task.result();
}

CellMaps finishedMaps(const Layer& layer, int index, std::int64_t i, std::int64_t j, BaseMapStore& store) {
  CellMaps maps;
  for (int map = 0; map < 4; ++map) {
    maps[static_cast<std::size_t>(map)] =
        finishedMap(layer, {index, 0, i + (map & 1), j + (map >> 1)}, store);
  }
  return maps;
}

/// How many patches lie along a layer's pitch.
double patchesAlong(int pitchShift) {
  return static_cast<double>(std::int64_t{1} << pitchShift);
}

/// How far across its cell of a layer a place lies; exact where the position is a sample of the world's grid.
double across(std::int64_t patch, double fraction, int pitchShift) {
  const std::int64_t mask = (std::int64_t{1} << pitchShift) - 1;
  return (static_cast<double>(patch & mask) + fraction) / patchesAlong(pitchShift);
}

/// The finest maps of the cell of a layer that a position lies in.
CellMaps mapsAround(const Layer& layer, int index, const Position& position, BaseMapStore& store) {
  const int shift = layer.pitchShift();
  return finishedMaps(layer, index, position.i >> shift, position.j >> shift, store);
}

/// The layer at (u, v) in [0, 1] of the position's patch, given those maps.
double heightInPatch(const Layer& layer, const CellMaps& maps, const Position& position, double u, double v) {
  const int shift = layer.pitchShift();
  return layerHeight(layer, linePlace(layer, 0, across(position.i, u, shift)),
                     linePlace(layer, 0, across(position.j, v, shift)), maps);
}

}  // namespace

World::World() = default;
World::~World() = default;

Result<std::shared_ptr<const World>> World::create(const WorldDescription& description,
                                                   const PluginRegistry& registry) {
  if (!(description.pitch >= 1e-3 && description.pitch <= 1e6)) {
    return Error{"pitch is " + numberText(description.pitch) + " m, expected 0.001 to 1e6"};
  }
  const Result<int> bits = checkedSideBits(description.samples, 5, 1025, "");
  if (!bits) return bits.error();
  if (description.layers.empty()) return Error{"the world has no layers, expected at least one"};
  if (description.layers.size() > WorldDescription::kMostLayers) {
    return Error{"the world has " + std::to_string(description.layers.size()) + " layers, expected at most " +
                 std::to_string(WorldDescription::kMostLayers)};
  }
  Result<std::vector<LayerDescription>> layers = namedLayers(description.layers);
  if (!layers) return layers.error();

  std::shared_ptr<World> world(new World);
  world->pitch_ = description.pitch;
  world->seed_ = description.seed;
  const int worldBits = *bits - 1;
  world->intervals_ = 1 << worldBits;
  world->messages_ = std::make_shared<MessageBox>();
  for (const LayerDescription& layer : *layers) {
    Result<Layer> made = makeLayer(layer, description, worldBits, registry, world->messages_);
    if (!made) return made.error();
    world->topLevel_ = std::max(world->topLevel_, made->cutLevel());
    world->layers_.push_back(std::move(*made));
  }
  world->queryMaps_ = std::make_unique<BaseMapStore>(kQueryBytes);
  return std::shared_ptr<const World>(std::move(world));
}

double World::spacing(int level) const noexcept {
  return pitch_ / intervals_ * static_cast<double>(std::int64_t{1} << level);
}

std::span<const Layer> World::layers() const noexcept {
  return layers_;
}

std::vector<std::string> World::takeMessages() const {
  return messages_->take();
}

std::optional<std::string> World::failure() const {
  return messages_->failure();
}

double World::mean() const noexcept {
  double sum = 0.0;
  for (const Layer& layer : layers_) sum += layer.range().mean;
  return sum;
}

double World::deviation() const noexcept {
  double squares = 0.0;
  for (const Layer& layer : layers_) squares += layer.range().deviation * layer.range().deviation;
  return std::sqrt(squares);
}

double World::height(const Position& position) const {
  double sum = 0.0;
  for (std::size_t index = 0; index < layers_.size(); ++index) {
    const CellMaps maps = mapsAround(layers_[index], static_cast<int>(index), position, *queryMaps_);
    sum += heightInPatch(layers_[index], maps, position, position.u, position.v);
  }
  return sum;
}

SurfacePoint World::query(const Position& position) const {
  const double n = intervals_;
  const double x = position.u * n, y = position.v * n;
  const double column = std::floor(x), row = std::floor(y);
  // The square's corners lie in the same cell of every layer, or on its border, where the cell beyond gives
  // the same bits: the maps around the position serve for all.
  std::array<double, 4> corners{};
  SurfacePoint point;
  for (std::size_t index = 0; index < layers_.size(); ++index) {
    const Layer& layer = layers_[index];
    const CellMaps maps = mapsAround(layer, static_cast<int>(index), position, *queryMaps_);
    for (int corner = 0; corner < 4; ++corner) {
      corners[static_cast<std::size_t>(corner)] +=
          heightInPatch(layer, maps, position, (column + (corner & 1)) / n, (row + (corner >> 1)) / n);
    }
    point.height += heightInPatch(layer, maps, position, position.u, position.v);
    const int shift = layer.pitchShift();
    point.error += triangleError(layer, maps, across(position.i, column / n, shift),
                                 across(position.j, row / n, shift), 1.0 / (n * patchesAlong(shift)));
  }
  const auto drawn = [&](std::size_t corner) {
    return static_cast<double>(static_cast<float>(corners[corner]));
  };
  const SquareHeights heights{drawn(0), drawn(1), drawn(2), drawn(3)};
  const TrianglePoint triangle = sampleTriangle(heights, x - column, y - row);
  point.drawn = triangle.height;
  point.normal = faceNormal(triangle, spacing(0));
  const double largest = std::max({std::fabs(heights.southWest), std::fabs(heights.southEast),
                                   std::fabs(heights.northWest), std::fabs(heights.northEast), 1.0});
  point.error += largest * 0x1p-23;  // drawn heights are floats; sums in double round far less
  return point;
}

}  // namespace teren
