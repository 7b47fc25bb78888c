// One layer of the world: a generator with its filters and lattice, and what its plugins are asked for.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "teren/ContinuousGenerator.h"
#include "teren/World.h"

#include "world/StepWatch.h"

namespace teren {

/// Sentences about plugins that misbehaved. Thread-safe.
class MessageBox {
 public:
  /// Keeps the first sentence of each source (a layer, or one of its plugins) and drops later ones.
  void post(const std::string& source, const std::string& sentence);
  /// Of a layer whose mean stands in for a map: `cause` alone is remembered, the sentence tells both.
  void postFailure(const std::string& layer, const std::string& cause);
  std::vector<std::string> take();
  /// The cause of the first failure, if there was any; taking the sentences does not take it.
  std::optional<std::string> failure();

 private:
  void postLocked(const std::string& source, const std::string& sentence);

  std::mutex mutex_;
  std::vector<std::string> sources_, sentences_;
  std::optional<std::string> failure_;
};

/// What makes a layer. `ids` are the plugins', the generator's first, then the filters', for messages;
/// `versions` are theirs.
struct LayerPlugins {
  std::shared_ptr<const Generator> generator;
  std::vector<std::shared_ptr<const Filter>> filters;
  std::vector<std::string> ids, versions;
  /// The generator, where it is continuous and no filters follow: then it makes no maps, but a field.
  const ContinuousGenerator* field = nullptr;
  double fieldError = 0.0;  ///< [m] its ContinuousGenerator::fieldError at the spacing of level 0
};

/// How far across its cell of a lattice of 2^pitchShift patches a pitch a place lies, in [0, 1]; exact where
/// the place is a sample of the world's grid.
double acrossCell(std::int64_t patch, double fraction, int pitchShift) noexcept;

/// Immutable. Distances along its lattice are counted in level-0 samples of the world, whole numbers.
class Layer {
 public:
  /// A checked layer of a world whose patches have 2^worldBits intervals; `pitchShift` is m in
  /// "pitch = world pitch times 2^m", `layerBits` the logarithm of this layer's intervals a pitch, `range`
  /// what generator and filters together promise.
  Layer(std::string name, std::uint64_t worldSeed, double worldPitch, int worldBits, int pitchShift,
        int layerBits, BlendKernel kernel, bool preserveVariance, LayerPlugins plugins,
        const HeightRange& range, std::shared_ptr<MessageBox> messages);

  const std::string& name() const noexcept { return name_; }
  BlendKernel kernel() const noexcept { return kernel_; }
  bool preserveVariance() const noexcept { return preserveVariance_; }
  const Generator& generator() const noexcept { return *plugins_.generator; }
  const std::vector<std::shared_ptr<const Filter>>& filters() const noexcept { return plugins_.filters; }
  const std::vector<std::string>& pluginIds() const noexcept { return plugins_.ids; }
  const std::vector<std::string>& pluginVersions() const noexcept { return plugins_.versions; }
  /// Not null: the layer is this field, its samples are drawn as they are, and nothing said of maps concerns
  /// it.
  const ContinuousGenerator* field() const noexcept { return plugins_.field; }
  double fieldError() const noexcept { return plugins_.fieldError; }
  /// Of the generator (stage 0) or of filter stage - 1. Shared by all tasks: watching changes no layer.
  StepWatch& watch(std::size_t stage) const noexcept { return (*watches_)[stage]; }
  /// After the filters.
  const HeightRange& range() const noexcept { return range_; }
  double pitch() const noexcept { return pitch_; }

  /// Logarithm of the number of level-0 samples in one pitch.
  int cellBits() const noexcept { return worldBits_ + pitchShift_; }
  /// Logarithm of the number of patches in one pitch (m).
  int pitchShift() const noexcept { return pitchShift_; }
  /// Logarithm of the intervals a finest base map has in one pitch (half its side).
  int layerBits() const noexcept { return layerBits_; }

  /// The last level of the world at which this layer is drawn; above it only its mean is.
  int cutLevel() const noexcept { return cutLevel_; }
  /// The level of the base maps that the world's grid of `level` <= cutLevel() samples. At level 0 always 0,
  /// so that the level-0 surface samples the landscape itself even where filters make coarse maps
  /// approximate.
  int mapLevel(int level) const noexcept;
  /// Side of a base map at one of its levels, 2^k + 1 (or 1: the centre).
  int mapSamples(int mapLevel) const noexcept;

  /// Request for the base map at lattice point (i, j).
  MapRequest request(std::int64_t i, std::int64_t j, int mapLevel) const noexcept;

  /// Request for a field's samples 2^level apart in the world's grid, the first one there. Exact for
  /// positions on the grid of level 0.
  FieldRequest fieldRequest(const Position& first, int level, int columns, int rows) const noexcept;

  /// The door: whether a height is finite and inside the promised range.
  bool accepts(float height) const noexcept {
    return std::isfinite(height) && height >= range_.min && height <= range_.max;
  }
  /// "plugin "x" wrote the height ..."
  std::string refusal(float height) const;
  /// The plugin that `cause` begins with failed there, so the mean stands in; each layer is told of once.
  void reportFailure(const std::string& cause, std::int64_t i, std::int64_t j) const;
  /// The plugin of a stage broke the rule of StepWatch; each of a layer's plugins is told of once.
  void reportOverrun(std::size_t stage, const Overrun& overrun) const;

 private:
  std::string name_;
  std::uint64_t worldSeed_;
  double pitch_;
  int worldBits_, pitchShift_, layerBits_, cutLevel_;
  BlendKernel kernel_;
  bool preserveVariance_;
  LayerPlugins plugins_;
  HeightRange range_;
  std::shared_ptr<MessageBox> messages_;
  std::shared_ptr<std::vector<StepWatch>> watches_;  // by stage
};

}  // namespace teren
