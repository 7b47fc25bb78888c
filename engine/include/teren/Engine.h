// The engine: invents terrain around moving objects, a slice at a time, and publishes what there is to draw.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "teren/GroundEdits.h"
#include "teren/Object.h"
#include "teren/Position.h"
#include "teren/Scene.h"
#include "teren/SceneQuery.h"
#include "teren/Slice.h"
#include "teren/World.h"

namespace teren {

/// Detail by the error a person sees: the land is coarser the farther away it is, to the horizon.
struct DetailSettings {
  /// [px] kLeastError ... kMostError: how far what is drawn may be from the level-0 surface on the screen.
  /// The bound is an upper one: by default 99 of 100 places of the world shipped are off by less than 2 px.
  /// Half of it takes up to three times the triangles; the default is the smallest that needs no more than
  /// 10^6 for 10 km of that world (`teren report`, table detail).
  double pixelError = 8.0;
  static constexpr double kLeastError = 0.1, kMostError = 100.0;
  double distance = 10'000.0;  ///< [m] more than 0, at most kMostDistance: how far the land is drawn
  static constexpr double kMostDistance = 1e6;
  double lines = 720.0;  ///< [px] 1 ... kMostLines: the height of the picture ...
  static constexpr double kMostLines = 32768.0;
  double fieldOfView =
      0.785;  ///< [radian] 0.01 ... 3: ... and the angle it shows, from its lower to its upper edge

  friend bool operator==(const DetailSettings&, const DetailSettings&) = default;
};

/// The view around the active object (others: Engine::setView): (2 radius + 1)^2 nodes of one uniform level,
/// or detail by error.
struct ViewSettings {
  int level = 2;   ///< 0 ... World::topLevel(); a level more draws a quarter of the triangles per area
  int radius = 6;  ///< 1 ... kMostRadius nodes; triangles grow with its square
  static constexpr int kMostRadius = 64;
  std::optional<DetailSettings> detail = std::nullopt;  ///< in place of level and radius

  /// How far [m] the ground is drawn in every direction at least, wherever in its node the object is.
  double reach(const World& world) const noexcept;
  /// The smallest radius at this level that reaches `distance`.
  static int radiusFor(double distance, int level, const World& world) noexcept;
};

struct EngineOptions {
  ViewSettings view;
  /// Threads that make terrain, 0 ... kMostWorkers. With 0 all work is done in slices on the thread that
  /// calls update; with more, update only integrates what they have finished. The landscape is the same.
  int workers = 0;
  static constexpr int kMostWorkers = 64;
  /// Most bytes the engine holds, at least kLeastCap: maps, nodes, meshes, tasks in flight, and what its
  /// renderer reports. Where the view needs more, its far parts are left out until there is room (law 6).
  std::size_t capBytes = std::size_t{512} << 20;
  static constexpr std::size_t kLeastCap = std::size_t{8} << 20;
};

struct EngineFigures {
  std::size_t nodes = 0;      ///< in the scene
  std::size_t triangles = 0;  ///< in the scene
  std::size_t bytes = 0;      ///< held now, of what EngineOptions::capBytes counts
  std::size_t peakBytes = 0;  ///< the most held so far
  int radius = 0;             ///< of a uniform view: less than asked for under the cap
  /// [px] With detail by error, what is aimed at: more than asked for under the cap. 0 in a uniform view.
  double pixelError = 0.0;
  std::vector<std::size_t> nodesAtLevel;  ///< in the scene, from level 0 on
  std::size_t pending = 0;                ///< nodes wanted and not there yet
  /// With detail by error: nothing is pending, and updates measure how wrong nodes are, as long as levels are
  /// left of which that is not known and there is room under the cap. In any view: what was replaced last is
  /// still to be freed. Who lets updates rest while nothing is pending should go on meanwhile: then the
  /// detail is chosen anew.
  bool measuring = false;
  std::size_t unfinishedTasks = 0;         ///< given to workers (or to later slices), at this moment
  std::uint64_t slices = 0;                ///< begun since the engine was made
  std::uint64_t lateSlices = 0;            ///< that ended beyond the budget
  std::chrono::nanoseconds lastUpdate{0};  ///< wall time of the last update
};

/// One engine per view of a world. All calls from one thread; snapshots may be read by any.
class Engine {
 public:
  static Result<std::unique_ptr<Engine>> create(std::shared_ptr<const World> world,
                                                const EngineOptions& options);
  ~Engine();

  const World& world() const noexcept;
  /// As they are now: setDetail changes them.
  const EngineOptions& options() const noexcept;
  /// Another pixel error, distance or picture, from the next update on. Only of an engine made with detail by
  /// error; refuses what create() would refuse.
  Result<void> setDetail(const DetailSettings& detail);

  /// Adds an object; the first becomes active. The reference lives as long as the engine, or takeObjects().
  Object& add(std::unique_ptr<Object> object);
  /// Gives all objects back, in the order they were added, for another engine; then there are none. They keep
  /// the keys they hold, and references to them stay good as long as their new owner has them.
  std::vector<std::unique_ptr<Object>> takeObjects();
  std::size_t objectCount() const noexcept;
  Object& object(std::size_t index) noexcept;
  /// Draws land around this object too while it is not the active one, as finely as `detail` says, from the
  /// next update on; empty: no longer. All views together are one scene, which is as fine everywhere as any
  /// of them wants there, and share the cap: under it the pixel errors of all grow alike. A picture of such a
  /// view moves its vertices with this object's eye and morph(object), not with Scene::morph(), which is the
  /// active object's. Only of an engine made with detail by error; refuses what create() would refuse, an
  /// object that is not there, and more than kMostViews at once (another active object may make it one more).
  /// Costs what the nodes of the view cost. takeObjects() ends them all.
  Result<void> setView(std::size_t object, const std::optional<DetailSettings>& detail);
  /// How the vertices of the latest snapshot move in a picture from this object's eye: for the pixel error of
  /// its view; of an object without one, as the snapshot says. Where the land is finer than this view asks
  /// for, because another does, vertices have gone all of the way to the coarser surface: it looks at
  /// least as fine as asked for, and no picture is more wrong than its own pixel error for sharing the scene.
  Morph morph(std::size_t object) const noexcept;
  static constexpr std::size_t kMostViews = 16;  ///< the active object's included
  std::size_t active() const noexcept;
  /// The object active before lets go of its keys.
  void setActive(std::size_t index) noexcept;
  /// What the person does, for the active object; returns whether it meant anything to it.
  bool handle(const InputEvent& event);
  /// The active object lets go of its keys: the window has lost the keyboard.
  void letGo();

  /// Moves the objects by dt seconds (not finite or negative: 0) and tells them what they ran into, on the
  /// straight way from where each was, at any speed: the level-0 ground, as far as it is there, and each
  /// other, the earliest first. Then works at what is missing until the budget is used, then publishes a new
  /// scene if anything changed. No slice starts after the budget's end. Call from a timer or sensor, never
  /// while the scene is being drawn.
  void update(double dt, std::chrono::nanoseconds budget);

  /// Works without moving anything until all that the view wants is there.
  /// `progress(done, wanted)` is called about twenty times a second; returning false stops early.
  void settle(const std::function<bool(std::size_t done, std::size_t wanted)>& progress = {});

  /// The latest snapshot, never null.
  std::shared_ptr<const Scene> scene() const noexcept;

  /// Heights, normals and rays on the latest snapshot, its vertices as they lie, never null; any thread may
  /// ask it. SceneQuery::seenFrom makes of it what an eye sees. Made when it is first asked for after a
  /// snapshot was published: a microsecond for each mesh that has come since it was last asked for, however
  /// many snapshots ago that was, and a tenth of that for each of the others.
  std::shared_ptr<const SceneQuery> sceneQuery() const;

  /// [m] The triangles on the screen at a position: those of the scene, moved (Morph.h) as the active object
  /// sees them from where it was at the end of the last update. Empty where nothing is drawn, and, like the
  /// next two, for a position that is not valid(). Looked up in the engine, without sceneQuery(): in less
  /// than a microsecond, and where levels meet in O(triangles of one border).
  std::optional<double> drawnHeight(const Position& position) const;
  /// [m] The level-0 triangles at a position, as they are kept under objects: World::query's `drawn`, bit for
  /// bit. Empty where they are not there.
  std::optional<double> finestHeight(const Position& position) const;
  /// What objects see: see Ground.
  const Ground& ground() const noexcept;

  EngineFigures figures() const noexcept;

  /// Sentences since the last call about plugins (World::takeMessages) and objects that misbehaved.
  std::vector<std::string> takeMessages();

  /// From the next update on the ground is the world's with these edits, wherever it is drawn or asked for.
  /// `changed`: boxes with all samples that differ from the ground so far. What was changed once stays among
  /// the changed samples of all edits to come, with whatever height. All that is drawn changes at once, as
  /// soon as its meshes are made anew: nothing opens, and land beside it waits for it. Costs about a
  /// microsecond of the updates to come for each node held over the boxes, and a mesh, or several, for each
  /// one drawn there; counted under the cap, but never freed.
  void setEdits(std::shared_ptr<const GroundEdits> edits, std::span<const SampleBox> changed);

  /// Bytes the renderer holds for this engine's scenes (vertex buffers): counted under the cap. Call when
  /// they change.
  void setRendererBytes(std::size_t bytes) noexcept;

 private:
  struct State;
  explicit Engine(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace teren
