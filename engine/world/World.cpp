#include "teren/World.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <exception>
#include <map>
#include <numeric>
#include <set>

#include "teren/Quote.h"

#include "height/Surface.h"
#include "plugin/Thrown.h"
#include "world/BaseMap.h"
#include "world/DescriptionHash.h"
#include "world/ErrorBound.h"
#include "world/FieldTask.h"
#include "world/Layer.h"
#include "world/LayerSampler.h"
#include "world/NodeErrors.h"

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

/// What a plugin says when asked for `what`; one that throws instead is refused.
template <class Promise>
auto promised(const Promise& promise, const std::string& plugin, const char* what)
    -> Result<decltype(promise())> {
  std::string thrown = "something that is no std::exception";
  try {
    return promise();
  } catch (const std::exception& problem) {
    thrown = inQuotes(textOf(problem));
  } catch (...) {
  }
  return Error{plugin + " threw " + thrown + " when asked for its " + what};
}

template <class Promise>
Result<HeightRange> promisedRange(const Promise& promise, const std::string& plugin) {
  const Result<HeightRange> range = promised(promise, plugin, "range");
  if (!range) return range;
  if (const Result<void> sane = checkRange(*range, plugin); !sane) return sane.error();
  return range;
}

/// Fields are asked for places down to 2^-20 pitches (FieldRequest::spacing), and for no finer ones.
constexpr int kMostFieldBits = 20;

/// Notes the field of a generator that is continuous, and how far triangles through its samples may lie from
/// it.
Result<void> takeField(LayerPlugins& plugins, double spacing, const std::string& plugin) {
  const auto field = promised([&] { return asContinuous(*plugins.generator); }, plugin, "traits");
  if (!field) return field.error();
  if (*field == nullptr) return {};
  const Result<double> error = promised([&] { return (*field)->fieldError(spacing); }, plugin, "error");
  if (!error) return error.error();
  if (!(*error >= 0.0 && *error <= kMaxHeight)) {  // NaN too
    return Error{plugin + " promises an error of " + numberText(*error) + " m for samples " +
                 numberText(spacing) + " m apart, expected 0 to 1e30"};
  }
  plugins.field = *field;
  plugins.fieldError = *error;
  return {};
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
  LayerPlugins plugins;
  plugins.generator = std::move(*generator);
  plugins.ids = {description.generator};
  plugins.versions = {registry.find(description.generator)->version};
  for (const FilterDescription& wanted : description.filters) {
    Result<std::shared_ptr<const Filter>> filter = registry.makeFilter(wanted.filter, wanted.parameters);
    if (!filter) return Error{where + filter.error().message};
    range = promisedRange([&] { return (*filter)->range(*range); }, where + inQuotes(wanted.filter));
    if (!range) return range.error();
    plugins.filters.push_back(std::move(*filter));
    plugins.ids.push_back(wanted.filter);
    plugins.versions.push_back(registry.find(wanted.filter)->version);
  }
  if (plugins.filters.empty()) {
    const double spacing = world.pitch / static_cast<double>(1 << worldBits);
    const Result<void> taken = takeField(plugins, spacing, where + inQuotes(description.generator));
    if (!taken) return taken.error();
    if (plugins.field != nullptr && worldBits + *shift > kMostFieldBits) {
      return Error{where + "pitch is " + numberText(description.pitch) +
                   " m, expected at most 2^20 samples of " + numberText(spacing) + " m, because " +
                   inQuotes(description.generator) + " is a continuous field"};
    }
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

/// Calls visit(maps, number) for every place, with the finest maps of the layer's cell that it lies in: cell
/// by cell, so that each is looked up, or made, once.
template <class Visit>
void forEachByCell(const Layer& layer, int index, std::span<const Position> places, BaseMapStore& store,
                   const Visit& visit) {
  const int shift = layer.pitchShift();
  const auto cell = [&](std::size_t number) {
    return std::pair{places[number].j >> shift, places[number].i >> shift};
  };
  const auto mapsOf = [&](std::size_t number) {
    return finishedMaps(layer, index, cell(number).second, cell(number).first, store);
  };
  if (places.size() == 1) return visit(mapsOf(0), std::size_t{0});
  std::vector<std::size_t> order(places.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return cell(a) < cell(b); });
  std::vector<std::span<const std::size_t>> cells;  // the places of each
  for (std::size_t k = 0; k < order.size();) {
    const std::size_t first = k;
    while (k < order.size() && cell(order[k]) == cell(order[first])) ++k;
    cells.push_back(std::span(order).subspan(first, k - first));
  }
  // In the order in which they were asked for, as one by one: what fails first is told first.
  std::sort(cells.begin(), cells.end(), [](const auto& a, const auto& b) { return a.front() < b.front(); });
  for (const std::span<const std::size_t> numbers : cells) {
    const CellMaps maps = mapsOf(numbers.front());
    for (const std::size_t number : numbers) visit(maps, number);
  }
}

/// The layer at (u, v) in [0, 1] of the position's patch, given those maps.
double heightInPatch(const Layer& layer, const CellMaps& maps, const Position& position, double u, double v) {
  const int shift = layer.pitchShift();
  return layerHeight(layer, linePlace(layer, 0, acrossCell(position.i, u, shift)),
                     linePlace(layer, 0, acrossCell(position.j, v, shift)), maps);
}

/// A square of level-0 samples of a layer that is a field.
template <int kSide>
struct FieldSamples {
  std::array<float, kSide * kSide> heights{};
  bool sound = false;  ///< the mean stands in for none of them

  FieldSamples(const Layer& layer, const Position& first) {
    FieldTask task(layer, layer.fieldRequest(first, 0, kSide, kSide), {heights.data(), kSide, kSide});
    while (!task.step(Slice::unlimited())) {
    }
    sound = !task.failed();
  }
};

/// What a query asks of each layer.
struct SquareSums {
  double height = 0.0;  ///< at the position
  std::array<double, 4>
      corners{};       ///< of its square of the level-0 grid: south-west, -east, north-west, -east
  double error = 0.0;  ///< bound on |height - triangles through the corners|
};

/// `southWest` is the corner of the square that the position lies in.
void addField(const Layer& layer, const Position& position, const Position& southWest, SquareSums& sums) {
  const FieldSamples<2> square(layer, southWest);
  const FieldSamples<1> point(layer, position);
  double largest = 0.0;
  for (std::size_t corner = 0; corner < 4; ++corner) {
    const double height = static_cast<double>(square.heights[corner]);
    sums.corners[corner] += height;
    largest = std::max(largest, std::fabs(height));
  }
  sums.height += static_cast<double>(point.heights[0]);
  // Nothing leaves the range; where the mean stands in for a sample, that alone is known.
  double error = layer.range().max - layer.range().min;
  if (square.sound && point.sound) error = std::min(error, layer.fieldError());
  sums.error += error + (2.0 * largest + error) * 0x1p-24;  // samples are floats, between the corners too
}

/// Likewise.
void addMaps(const Layer& layer, const CellMaps& maps, const Position& position, const Position& southWest,
             double side, SquareSums& sums) {
  // The square's corners lie in the same cell of the layer, or on its border, where the cell beyond gives the
  // same bits: the maps around the position serve for all.
  for (int corner = 0; corner < 4; ++corner) {
    sums.corners[static_cast<std::size_t>(corner)] += heightInPatch(
        layer, maps, position, southWest.u + (corner & 1) * side, southWest.v + (corner >> 1) * side);
  }
  sums.height += heightInPatch(layer, maps, position, position.u, position.v);
  const int shift = layer.pitchShift();
  sums.error += triangleError(layer, maps, acrossCell(southWest.i, southWest.u, shift),
                              acrossCell(southWest.j, southWest.v, shift),
                              side / static_cast<double>(std::int64_t{1} << shift));
}

SurfacePoint surfacePoint(const Position& place, const SquareSums& sums, double n, double spacing) {
  const double x = place.u * n, y = place.v * n;
  const auto drawn = [&](std::size_t corner) {
    return static_cast<double>(static_cast<float>(sums.corners[corner]));
  };
  const SquareHeights heights{drawn(0), drawn(1), drawn(2), drawn(3)};
  const TrianglePoint triangle = sampleTriangle(heights, x - std::floor(x), y - std::floor(y));
  SurfacePoint point;
  point.height = sums.height;
  point.drawn = triangle.height;
  point.normal = faceNormal(triangle, spacing);
  const double largest = std::max({std::fabs(heights.southWest), std::fabs(heights.southEast),
                                   std::fabs(heights.northWest), std::fabs(heights.northEast), 1.0});
  point.error = sums.error + largest * 0x1p-23;  // drawn heights are floats; sums in double round far less
  return point;
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
  world->descriptionHash_ = teren::descriptionHash(description, *layers, registry);
  world->queryMaps_ = std::make_unique<BaseMapStore>(kQueryBytes);
  world->nodeErrors_ = std::make_unique<NodeErrors>(world->layers_, world->spacing(0), world->topLevel_);
  return std::shared_ptr<const World>(std::move(world));
}

double World::spacing(int level) const noexcept {
  return pitch_ / intervals_ * static_cast<double>(std::int64_t{1} << level);
}

std::span<const Layer> World::layers() const noexcept {
  return layers_;
}

NodeErrors& World::nodeErrors() const noexcept {
  return *nodeErrors_;
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

std::size_t World::queryBytes() const {
  return queryMaps_->bytes();
}

double World::height(const Position& position) const {
  double height = 0.0;
  heights({&position, 1}, {&height, 1});
  return height;
}

void World::heights(std::span<const Position> places, std::span<double> heights) const {
  assert(places.size() == heights.size());
  std::fill(heights.begin(), heights.end(), 0.0);
  for (std::size_t index = 0; index < layers_.size(); ++index) {
    const Layer& layer = layers_[index];
    if (layer.field() != nullptr) {
      for (std::size_t k = 0; k < places.size(); ++k) {
        heights[k] += static_cast<double>(FieldSamples<1>(layer, places[k]).heights[0]);
      }
      continue;
    }
    forEachByCell(layer, static_cast<int>(index), places, *queryMaps_,
                  [&](const CellMaps& maps, std::size_t k) {
                    heights[k] += heightInPatch(layer, maps, places[k], places[k].u, places[k].v);
                  });
  }
}

SurfacePoint World::query(const Position& position) const {
  SurfacePoint point;
  query({&position, 1}, {&point, 1});
  return point;
}

void World::query(std::span<const Position> places, std::span<SurfacePoint> points) const {
  assert(places.size() == points.size());
  const double n = intervals_;
  std::vector<SquareSums> sums(places.size());
  const auto southWest = [&](const Position& place) {
    return Position{place.i, place.j, std::floor(place.u * n) / n, std::floor(place.v * n) / n};
  };
  for (std::size_t index = 0; index < layers_.size(); ++index) {
    const Layer& layer = layers_[index];
    if (layer.field() != nullptr) {
      for (std::size_t k = 0; k < places.size(); ++k)
        addField(layer, places[k], southWest(places[k]), sums[k]);
      continue;
    }
    forEachByCell(layer, static_cast<int>(index), places, *queryMaps_,
                  [&](const CellMaps& maps, std::size_t k) {
                    addMaps(layer, maps, places[k], southWest(places[k]), 1.0 / n, sums[k]);
                  });
  }
  for (std::size_t k = 0; k < places.size(); ++k) points[k] = surfacePoint(places[k], sums[k], n, spacing(0));
}

}  // namespace teren
