// The world: what it is described by, and the landscape as a function of position (law 0).
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "teren/Filter.h"
#include "teren/Generator.h"
#include "teren/PluginRegistry.h"
#include "teren/Position.h"
#include "teren/Result.h"

namespace teren {

enum class BlendKernel {
  linear,  ///< product of two tents, as published; creases along lattice lines
  smooth,  ///< quintic, C2; no crease
};

struct FilterDescription {
  std::string filter;  ///< plugin id
  std::vector<Values::Entry> parameters;
};

/// Where the generator is continuous (ContinuousGenerator.h) and no filters follow, the layer is its field:
/// `samples`, `blend` and `preserveVariance` are about base maps and do not concern it. `pitch` still says up
/// to which level it is drawn: choose it not far below the field's largest features.
struct LayerDescription {
  std::string name;       ///< what is hashed; empty: the generator's id, with -2, -3 ... on repetition
  std::string generator;  ///< plugin id
  std::vector<Values::Entry> parameters;
  double pitch = 64.0;  ///< [m] the world's pitch times 2^m, 0 <= m <= 40
  int samples = 65;     ///< side of a base map, 2^k + 1, 3 ... 2049
  BlendKernel blend = BlendKernel::smooth;
  bool preserveVariance = true;
  std::vector<FilterDescription> filters;
};

struct WorldDescription {
  std::uint64_t seed = 0;
  double pitch = 64.0;  ///< [m] 0.001 ... 1e6
  int samples = 65;     ///< a patch has (samples - 1) / 2 intervals a side; 2^k + 1, 5 ... 1025
  std::vector<LayerDescription> layers;  ///< 1 ... kMostLayers; every height costs all of them
  static constexpr std::size_t kMostLayers = 256;

  /// Reads the JSON form. `source` names the file in messages. Every key is optional but `layers`; unknown
  /// keys, wrong types, bad values and nesting deeper than 32 are refused, naming the key and its place.
  static Result<WorldDescription> fromJson(std::string_view text, std::string_view source);
  static Result<WorldDescription> fromFile(const std::filesystem::path& file);
  /// The world shipped with Teren: ranges, hills and detail, at pitches of 8192, 1024 and 64 m. With its sea
  /// at -150 m, 38 % of it is water, and 18 % lies above 450 m, where snow begins.
  static WorldDescription standard();
};

/// What is known of one point of the landscape, drawn as finely as possible.
struct SurfacePoint {
  double height = 0.0;                          ///< [m] the landscape's function (law 0)
  double drawn = 0.0;                           ///< [m] the level-0 triangle above or below it
  std::array<double, 3> normal{0.0, 0.0, 1.0};  ///< unit, of that triangle
  double error = 0.0;  ///< [m] |height - drawn| is at most this, anywhere in the triangle
};

class Layer;
class BaseMapStore;
class MessageBox;
class NodeErrors;

/// A checked world, immutable; all member functions are const and may be called from any thread.
class World {
 public:
  /// Checks the description and makes the generators and filters. Errors name layer, field and value.
  static Result<std::shared_ptr<const World>> create(const WorldDescription& description,
                                                     const PluginRegistry& registry);
  ~World();

  double pitch() const noexcept { return pitch_; }
  std::uint64_t seed() const noexcept { return seed_; }
  /// Of the whole description, defaults filled in: what belongs to this world (edits, say) is told by it.
  /// Plugins count by their ids, not their versions.
  std::uint64_t descriptionHash() const noexcept { return descriptionHash_; }
  /// Intervals along a patch's side (n, a power of two); a node of any level has as many along its own side.
  int intervals() const noexcept { return intervals_; }
  /// [m] between samples at a level.
  double spacing(int level) const noexcept;
  /// The last level at which any layer still draws more than its mean: the coarsest layer's cut level.
  int topLevel() const noexcept { return topLevel_; }

  /// Law 0: the landscape's height [m], a pure function of the description and the position. Makes the base
  /// maps it needs and keeps the latest (at most kQueryBytes) for the next query; a first query costs up to
  /// four maps per layer, later ones nearby about a microsecond per layer; a layer that is a field is asked
  /// for one sample, a float, and keeps nothing. Where the maps around one place are more than kQueryBytes
  /// (four of 2049 samples a side are 67 MB) those that do not fit are made anew each time; a layer's four
  /// are held while it is asked, so that any world can be.
  double height(const Position& position) const;
  /// The same, of many valid places; both spans have the same length (assert). Makes no map twice in a call,
  /// however many cells they are in and in whatever order, and looks each up once: 1.6 times as fast as
  /// single calls where places leap about (bench-scene-query).
  void heights(std::span<const Position> places, std::span<double> heights) const;
  static constexpr std::size_t kQueryBytes = std::size_t{64} << 20;
  /// What queries keep now. Not part of what an engine counts and caps.
  std::size_t queryBytes() const;

  /// Both heights of a point, law 0 and the level-0 triangles, and a bound on their difference. Makes no map
  /// twice, whatever fits into kQueryBytes.
  SurfacePoint query(const Position& position) const;
  /// The same, of many valid places, as `heights`.
  void query(std::span<const Position> places, std::span<SurfacePoint> points) const;

  /// Sum of the layers' means [m], and the standard deviation [m] of the landscape at a lattice point, were
  /// the layers' promises exact.
  double mean() const noexcept;
  double deviation() const noexcept;

  /// Sentences about plugins that misbehaved since the last call. Those that failed (threw, wrote NaN, left
  /// their promised range or were never done), each layer once: the landscape goes on with the layer's mean
  /// in their place. Those whose steps went on far beyond their slices (engine/world/StepWatch.h says how
  /// far), each plugin of a layer once: their heights are as good as any.
  std::vector<std::string> takeMessages() const;
  /// Why a plugin first failed, in a sentence; empty where none has. Afterwards heights may be the mean of
  /// its layer, so what is to be kept, a file say, is not the landscape described.
  std::optional<std::string> failure() const;

  std::span<const Layer> layers() const noexcept;  ///< engine/world/Layer.h, for the engine itself
  /// engine/world/NodeErrors.h, for the engine itself; what is known grows, what is known stays the same.
  NodeErrors& nodeErrors() const noexcept;

 private:
  World();
  double pitch_ = 0.0;
  std::uint64_t seed_ = 0;
  std::uint64_t descriptionHash_ = 0;
  int intervals_ = 0;
  int topLevel_ = 0;
  std::vector<Layer> layers_;
  std::shared_ptr<MessageBox> messages_;
  std::unique_ptr<BaseMapStore> queryMaps_;
  std::unique_ptr<NodeErrors> nodeErrors_;
};

}  // namespace teren
