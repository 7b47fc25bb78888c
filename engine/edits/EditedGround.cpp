#include "teren/EditedGround.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <exception>
#include <list>
#include <map>
#include <tuple>
#include <utility>

#include "teren/Hash.h"
#include "teren/HeightMapOperations.h"
#include "teren/Quote.h"
#include "teren/StepLimit.h"

#include "edits/GroundCheckpoint.h"
#include "edits/GroundOverrides.h"
#include "edits/GroundSnapshot.h"
#include "edits/LooseLayer.h"
#include "edits/PatchRectangle.h"
#include "height/Surface.h"
#include "patch/NodeTask.h"
#include "plugin/Thrown.h"
#include "world/BaseMap.h"
#include "world/Layer.h"

namespace teren {

namespace {

/// Base maps that are kept for the next ground to begin on.
constexpr std::size_t kGroundMapBytes = std::size_t{64} << 20;

const Error kCancelled{"cancelled"};

/// An edit, checked, with all that follows from it alone.
struct PlacedEdit {
  std::string kind;
  std::shared_ptr<const Deformer> deformer;
  std::string version;
  Stamp stamp;  // its place still to be told, for a region
  Position position;
  PatchRectangle needed;
};

struct Live {
  std::string kind;
  std::shared_ptr<const Deformer> deformer;
  PatchRectangle patches;
  HeightMap ground;  // as it was when the surface began, or grew there
  std::unique_ptr<LiveSurface> surface;
  std::uint64_t stepsAtEdit = 0;  // its steps when the latest edit came
  SampleRectangle written{};      // what is in the overrides
  bool isWritten = true;          // and it is how the surface is now

  std::uint64_t stepsSinceEdit() const { return surface->steps() - stepsAtEdit; }
};

/// Patches over which only surfaces of one kind live any more, which are to become one; at rest.
struct Room {
  PatchRectangle patches;
  std::vector<Live*> living;
};

/// What a plugin's function answers; an exception of its is a sentence.
template <class Ask>
auto guarded(const std::string& kind, const Ask& ask) -> Result<decltype(ask())> {
  std::string thrown = "something that is no std::exception";
  try {
    return ask();
  } catch (const std::exception& problem) {
    thrown = inQuotes(textOf(problem));
  } catch (...) {
  }
  return Error{"the deformer " + inQuotes(kind) + " threw " + thrown};
}

/// The patches within `reach` [m] of a place along one axis: the first, and the one behind the last.
std::pair<std::int64_t, std::int64_t> around(std::int64_t index, double fraction, double reach,
                                             double pitch) {
  const double pitches = reach / pitch;
  return {index + static_cast<std::int64_t>(std::floor(fraction - pitches)),
          index + static_cast<std::int64_t>(std::floor(fraction + pitches)) + 1};
}

/// Moves what the world says of a place by what edits changed around it.
void move(const Position& place, const World& world, const GroundOverrides& overrides, SurfacePoint& point) {
  const int n = world.intervals(), bits = std::countr_zero(static_cast<unsigned>(n));
  const double east = place.u * n, north = place.v * n;
  const std::int64_t column = (place.i << bits) + static_cast<std::int64_t>(std::floor(east));
  const std::int64_t row = (place.j << bits) + static_cast<std::int64_t>(std::floor(north));
  std::array<std::optional<float>, 4> changed;  // south-west, -east, north-west, -east
  for (std::size_t corner = 0; corner < 4; ++corner) {
    changed[corner] = overrides.sample(column + (corner & 1), row + (corner >> 1));
  }
  const auto isChanged = [](const std::optional<float>& sample) { return sample.has_value(); };
  if (std::none_of(changed.begin(), changed.end(), isChanged)) return;
  const auto pitches = [n](std::int64_t sample) { return static_cast<double>(sample & (n - 1)) / n; };
  std::array<double, 4> own{}, now{};
  double largest = 1.0;
  for (std::size_t corner = 0; corner < 4; ++corner) {
    const std::int64_t x = column + (corner & 1), y = row + (corner >> 1);
    own[corner] = world.query({x >> bits, y >> bits, pitches(x), pitches(y)}).drawn;
    now[corner] = changed[corner] ? static_cast<double>(*changed[corner]) : own[corner];
    largest = std::max({largest, std::fabs(own[corner]), std::fabs(now[corner])});
  }
  const double x = east - std::floor(east), y = north - std::floor(north);
  const TrianglePoint before = sampleTriangle({own[0], own[1], own[2], own[3]}, x, y);
  const TrianglePoint after = sampleTriangle({now[0], now[1], now[2], now[3]}, x, y);
  point.height += after.height - before.height;
  point.drawn = after.height;
  point.normal = faceNormal(after, world.spacing(0));
  point.error += largest * 0x1p-23;  // what rounding adds
}

/// Of the description, and of what its plugins are.
std::uint64_t hashOf(const World& world) {
  std::uint64_t hash = world.descriptionHash();
  for (const Layer& layer : world.layers()) {
    for (const std::string& version : layer.pluginVersions()) hash = hashWith(hash, hashText(version));
  }
  return hash;
}

/// Whether a patch was taken from this world, by the first and the last of its samples and one between; what
/// neighbours share is left to them where there are others.
bool isOf(const World& world, const GroundOverrides::Key& key, const GroundOverrides::Patch& patch) {
  const int n = patch.own.columns();
  std::vector<std::pair<int, int>> taken, inner;
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      if (!std::isnan(patch.own(x, y))) (x > 0 && y > 0 ? inner : taken).emplace_back(x, y);
    }
  }
  const auto& samples = inner.empty() ? taken : inner;
  for (const std::size_t which : {std::size_t{0}, samples.size() / 2, samples.size() - 1}) {
    if (samples.empty()) return true;
    const auto [x, y] = samples[which];
    const Position place{key.second, key.first, static_cast<double>(x) / n, static_cast<double>(y) / n};
    if (static_cast<float>(world.query(place).drawn) != patch.own(x, y)) return false;
  }
  return true;
}

}  // namespace

/// Everything that edits change.
class EditedGround::State {
 public:
  State(const World& world, DeformerSource deformers)
      : world_(world),
        deformers_(std::move(deformers)),
        maps_(kGroundMapBytes),
        overrides_(world.intervals()),
        loose_(world.intervals()),
        mark_(EditListMark::ofNone(hashOf(world))) {}

  Result<PlacedEdit> place(const Edit& edit) const;
  Result<void> press(const PlacedEdit& edit, std::uint64_t steps, const EditWork& work);
  Result<void> rest(const EditWork& work);

  GroundOverrides& overrides() noexcept { return overrides_; }
  const GroundOverrides& overrides() const noexcept { return overrides_; }
  bool atRest() const noexcept { return resting_; }
  std::uint64_t stepsSinceEdit() const noexcept;
  std::size_t bytes() const;
  /// Back to where there were at most so many edits and nothing lived; how many there were.
  std::size_t goBack(std::size_t edits);
  Result<bool> fits(const GroundCheckpoint& checkpoint, std::span<const Edit> edits,
                    const EditWork& work) const;
  void adopt(std::shared_ptr<const GroundCheckpoint> checkpoint) {
    assert(mark_.edits == 0 && checkpoints_.empty());
    checkpoints_.push_back(std::move(checkpoint));
  }
  std::shared_ptr<const GroundCheckpoint> checkpoint(std::size_t most) const {
    const auto found = std::find_if(checkpoints_.rbegin(), checkpoints_.rend(),
                                    [most](const auto& one) { return one->mark().edits <= most; });
    return found == checkpoints_.rend() ? nullptr : *found;
  }
  std::size_t edits() const noexcept { return mark_.edits; }
  const EndedSurfaces& ended() const noexcept { return ended_; }
  /// Of an edit that was pressed.
  void count(const Edit& edit, const PlacedEdit& placed) noexcept {
    mark_ = mark_.followedBy(edit, placed.version);
  }

  std::optional<Error> spent;  // why there is no ground any more

 private:
  Result<void> run(Live& live, std::uint64_t upTo, const EditWork& work) const;
  Result<void> runAll(std::uint64_t steps, const EditWork& work);
  Result<std::optional<PatchRectangle>> spreadOf(const Live& live) const;
  Result<bool> spread(Live& live, const EditWork& work);
  Result<void> runToRest(Live& live, const EditWork& work) const;
  Result<void> write(Live& live);
  Result<void> noteEnd(const Live& live);
  Result<void> lay(Live& live) const;
  Result<void> keepLoose(const Live& live);
  Result<Room> clear(std::string kind, const PatchRectangle& patches, const EditWork& work);
  Result<bool> extend(std::span<Live* const> living, const PatchRectangle& patches,
                      const HeightMap& ground) const;
  Result<Live*> joinedIn(const Room& room, const HeightMap& ground);
  Result<HeightMap> groundOf(const PatchRectangle& patches, const EditWork& work);
  Result<Live*> surfaceFor(const PlacedEdit& edit, const EditWork& work);
  DeformRegion regionOf(const PatchRectangle& patches) const noexcept;

  const World& world_;
  DeformerSource deformers_;
  BaseMapStore maps_;
  GroundOverrides overrides_;
  LooseLayer loose_;
  bool isPause() const noexcept { return mark_.edits % kMostEditsTogether == 0; }
  void keepCheckpoint();

  EditListMark mark_;  // of what was applied so far
  EndedSurfaces ended_;
  /// Of pauses; the farther back, the fewer.
  std::vector<std::shared_ptr<const GroundCheckpoint>> checkpoints_;
  std::list<Live> live_;             // in the order in which they were begun
  bool resting_ = true;              // and all that is live is in the overrides
  std::uint64_t stepsToSpread_ = 0;  // since the latest edit, for all that has spread since
};

DeformRegion EditedGround::State::regionOf(const PatchRectangle& patches) const noexcept {
  return {patches.west,
          patches.south,
          static_cast<int>(patches.east - patches.west),
          static_cast<int>(patches.north - patches.south),
          world_.intervals(),
          world_.spacing(0)};
}

Result<PlacedEdit> EditedGround::State::place(const Edit& edit) const {
  if (const Result<void> checked = checkEdit(edit); !checked) return checked.error();
  if (edit.steps < stepsSinceEdit()) {
    return Error{"STEPS is " + std::to_string(edit.steps) + " but the ground has done " +
                 std::to_string(stepsSinceEdit()) + " since the edit before"};
  }
  const Result<DeformerKind> kind = deformers_(edit.kind);
  if (!kind) return kind.error();
  Result<Values> values = Values::check(kind->parameters, edit.parameters, edit.kind);
  if (!values) return values.error();
  const double pitch = world_.pitch();
  const Result<Position> position = Position::fromMetres(edit.x, edit.y, pitch);
  if (!position) return position.error();
  PlacedEdit placed{edit.kind, kind->deformer, kind->version, {}, *position, {}};
  placed.stamp = {0.0, 0.0, edit.z, edit.size, edit.depth, edit.seed, *std::move(values)};
  const double spacing = world_.spacing(0);
  const auto asked = guarded(edit.kind, [&] { return kind->deformer->reach(placed.stamp, spacing); });
  if (!asked) return asked.error();
  const Result<double>& reach = *asked;
  if (!reach) return reach.error();
  const double most = pitch * std::sqrt(static_cast<double>(kMostStampSamples));
  if (!(*reach >= 0.0 && *reach <= most)) {  // NaN too
    return Error{"the deformer " + inQuotes(edit.kind) + " reaches " + numberText(*reach) +
                 " m with this stamp, expected 0 to " + numberText(most) + " m"};
  }
  // A little more, so that no rounding puts the collar where the stamp may reach.
  const double needed = *reach + (kCollarCells + 0x1p-10) * spacing;
  std::tie(placed.needed.west, placed.needed.east) = around(position->i, position->u, needed, pitch);
  std::tie(placed.needed.south, placed.needed.north) = around(position->j, position->v, needed, pitch);
  if (!PatchRectangle{-kMaxPatch, -kMaxPatch, kMaxPatch, kMaxPatch}.contains(placed.needed)) {
    return Error{"the edit at (" + numberText(edit.x) + ", " + numberText(edit.y) +
                 ") m reaches beyond the world"};
  }
  if (placed.needed.samples(world_.intervals()) > kMostStampSamples) {
    return Error{"the edit at (" + numberText(edit.x) + ", " + numberText(edit.y) +
                 ") m needs the ground up to " + numberText(needed) +
                 " m around, more than 2^22 samples, which is the most"};
  }
  return placed;
}

Result<void> EditedGround::State::run(Live& live, std::uint64_t upTo, const EditWork& work) const {
  LiveSurface& surface = *live.surface;
  const DeformRegion region = regionOf(live.patches);
  const std::int64_t most = stepLimit(region.sampleColumns(), region.sampleRows());
  std::uint64_t before = surface.steps();
  for (std::int64_t slices = 0; surface.steps() < upTo && !surface.atRest(); ++slices) {
    live.isWritten = false;
    if (work.goesOn && !work.goesOn()) return kCancelled;
    if (std::exchange(before, surface.steps()) != surface.steps()) slices = 0;
    if (slices > most) {
      return Error{"the deformer " + inQuotes(live.kind) + " has not completed a logical step in " +
                   std::to_string(most) + " slices"};
    }
    const Slice slice = work.slice.count() > 0 ? Slice::lasting(work.slice) : Slice::unlimited();
    if (const auto stepped = guarded(live.kind, [&] { return surface.step(slice, upTo); }); !stepped) {
      return stepped.error();
    }
  }
  if (surface.steps() <= upTo) return {};
  return Error{"the deformer " + inQuotes(live.kind) + " did " + std::to_string(surface.steps()) +
               " logical steps where " + std::to_string(upTo) + " were asked for"};
}

Result<void> EditedGround::State::runToRest(Live& live, const EditWork& work) const {
  const Result<void> done = run(live, live.stepsAtEdit + kMostEditSteps, work);
  if (!done || live.surface->atRest()) return done;
  return Error{"the deformer " + inQuotes(live.kind) + " has not come to rest after " +
               std::to_string(kMostEditSteps) + " logical steps"};
}

Result<void> EditedGround::State::write(Live& live) {
  const auto taken = guarded(live.kind, [&] { return live.surface->snapshot(); });
  if (!taken) return taken.error();
  const ConstHeightView ground = live.ground.view();
  const SampleRectangle changed = (*taken)->changed();
  const std::string owner = "the deformer " + inQuotes(live.kind) + " ";
  if (!SampleRectangle{0, 0, ground.columns(), ground.rows()}.contains(changed))
    return Error{owner + "claims to have changed ground beyond its region"};
  const SampleRectangle part = changed.joinedWith(live.written);
  HeightMap heights(part.columns, part.rows);
  const auto read = guarded(live.kind, [&] { return (*taken)->samples(part, heights.view()), true; });
  if (!read) return read.error();
  const SampleRectangle changeable = regionOf(live.patches).changeable();
  for (int y = 0; y < part.rows; ++y) {
    for (int x = 0; x < part.columns; ++x) {
      const float height = heights(x, y);
      const int column = part.column + x, row = part.row + y;
      if (!std::isfinite(height)) return Error{owner + "made a height that is not finite"};
      if (!changeable.contains(column, row) && height != ground(column, row))
        return Error{owner + "changed the collar around its region"};
    }
  }
  const std::int64_t n = world_.intervals();
  overrides_.take(live.patches.west * n + part.column, live.patches.south * n + part.row, heights.view(),
                  ground.part(part.column, part.row, part.columns, part.rows));
  live.written = part;
  live.isWritten = true;
  return {};
}

/// Tells a surface that has begun or grown how much of its ground the ones before it left loose.
Result<void> EditedGround::State::lay(Live& live) const {
  const DeformRegion region = regionOf(live.patches);
  HeightMap depths(region.sampleColumns(), region.sampleRows());
  const std::int64_t n = region.intervals;
  if (!loose_.overlay(region.i * n, region.j * n, depths.view())) return {};
  const ConstHeightView all = std::as_const(depths).view();
  const auto laid = guarded(live.kind, [&] { return live.surface->layLoose(all), true; });
  if (!laid) return laid.error();
  return {};
}

/// Keeps how much a surface that ends leaves loose: where it does not know, what it has changed is solid.
Result<void> EditedGround::State::keepLoose(const Live& live) {
  const DeformRegion region = regionOf(live.patches);
  const std::int64_t column = region.i * region.intervals, row = region.j * region.intervals;
  HeightMap depths(region.sampleColumns(), region.sampleRows());
  const auto knows = guarded(live.kind, [&] { return live.surface->loose(depths.view()); });
  if (!knows) return knows.error();
  if (*knows) {
    const auto all = depths.samples();
    if (!std::all_of(all.begin(), all.end(),
                     [](float depth) { return depth >= 0.0F && std::isfinite(depth); }))
      return Error{"the deformer " + inQuotes(live.kind) + " tells a depth of loose ground that is none"};
  } else {
    if (!loose_.overlay(column, row, depths.view())) return {};
    HeightMap now(live.ground);
    overrides_.overlay(GroundOverrides::Over::earlier, 0, column, row, now.view());
    for (int y = 0; y < now.rows(); ++y) {
      for (int x = 0; x < now.columns(); ++x) {
        if (now(x, y) != live.ground(x, y)) depths(x, y) = 0.0F;
      }
    }
  }
  const SampleRectangle part = region.changeable();
  loose_.take(column + part.column, row + part.row,
              std::as_const(depths).view().part(part.column, part.row, part.columns, part.rows));
  return {};
}

/// Of a surface that is written, before it goes.
Result<void> EditedGround::State::noteEnd(const Live& live) {
  if (Result<void> kept = keepLoose(live); !kept) return kept;
  const auto error = guarded(live.kind, [&] { return live.surface->samplingError(); });
  if (!error) return error.error();
  if (!std::isfinite(*error)) {
    return Error{"the deformer " + inQuotes(live.kind) + " tells a sampling error that is not finite"};
  }
  ++ended_.surfaces;
  ended_.error += *error;
  ended_.absolute += std::fabs(*error);
  return {};
}

/// Ends the surfaces in the way of one of a kind but for those of that kind.
Result<Room> EditedGround::State::clear(std::string kind, const PatchRectangle& patches,
                                        const EditWork& work) {
  Room room{patches, {}};
  for (;;) {
    const auto inTheWay = std::find_if(live_.begin(), live_.end(), [&](const Live& live) {
      return std::find(room.living.begin(), room.living.end(), &live) == room.living.end() &&
             live.patches.overlaps(room.patches);
    });
    if (inTheWay == live_.end()) return room;
    if (Result<void> done = runToRest(*inTheWay, work); !done) return done.error();
    if (Result<void> written = write(*inTheWay); !written) return written.error();
    const PatchRectangle larger = room.patches.joinedWith(inTheWay->patches);
    if (inTheWay->kind == kind && larger.samples(world_.intervals()) <= kMostJoinedSamples) {
      room.patches = larger;
      room.living.push_back(&*inTheWay);
    } else {
      if (Result<void> noted = noteEnd(*inTheWay); !noted) return noted.error();
      live_.erase(inTheWay);
    }
  }
}

/// The first surface grows over the patches and takes the others in; false: it refuses. `ground` is theirs
/// with all samples that surfaces have left.
Result<bool> EditedGround::State::extend(std::span<Live* const> living, const PatchRectangle& patches,
                                         const HeightMap& ground) const {
  const DeformRegion region = regionOf(patches);
  HeightMap before(ground);
  SampleRectangle written;
  std::vector<LiveSurface*> others;
  for (const Live* live : living) {
    const SampleRectangle place = region.placeOf(regionOf(live->patches));
    copyHeights(live->ground.view(), before.view().part(place.column, place.row, place.columns, place.rows));
    const SampleRectangle& own = live->written;
    written = written.joinedWith({own.column + place.column, own.row + place.row, own.columns, own.rows});
    if (live != living.front()) others.push_back(live->surface.get());
  }
  Live& first = *living.front();
  const ConstHeightView heights = before.view();
  const auto extended = guarded(first.kind, [&] {
    return others.empty() ? first.surface->grow(region, heights)
                          : first.surface->merge(region, heights, others);
  });
  if (!extended) return extended.error();
  if (!*extended) return false;
  first.patches = patches;
  first.ground = std::move(before);
  first.written = written;
  return true;
}

/// The surface that has the room from now on, if one of those there takes it; all others end.
Result<Live*> EditedGround::State::joinedIn(const Room& room, const HeightMap& ground) {
  std::size_t taken = room.living.size();
  while (taken > 0) {
    const Result<bool> extended = extend(std::span(room.living).first(taken), room.patches, ground);
    if (!extended) return extended.error();
    if (*extended) break;
    taken = taken > 1 ? 1 : 0;
  }
  for (const Live* live : std::span(room.living).subspan(taken)) {
    if (Result<void> noted = noteEnd(*live); !noted) return noted.error();
  }
  Live* const one = taken > 0 ? room.living.front() : nullptr;
  live_.remove_if([&](const Live& live) {
    return &live != one && std::find(room.living.begin(), room.living.end(), &live) != room.living.end();
  });
  return one;
}

Result<HeightMap> EditedGround::State::groundOf(const PatchRectangle& patches, const EditWork& work) {
  const DeformRegion region = regionOf(patches);
  const int n = region.intervals;
  HeightMap ground(region.sampleColumns(), region.sampleRows());
  for (int j = 0; j < region.rows; ++j) {
    for (int i = 0; i < region.columns; ++i) {
      NodeTask task(world_, {0, patches.west + i, patches.south + j}, maps_);
      do {
        if (work.goesOn && !work.goesOn()) return kCancelled;
      } while (!task.step(work.slice.count() > 0 ? Slice::lasting(work.slice) : Slice::unlimited()));
      // A line that two patches share is the south or west one's, as in `bake`.
      const int west = i > 0 ? 1 : 0, south = j > 0 ? 1 : 0;
      const MatchedParts parts =
          matchedParts(task.heights().view(), {west, south, n + 1 - west, n + 1 - south}, ground.view(),
                       i * n + west, j * n + south);
      copyHeights(parts.source, parts.target);
    }
  }
  overrides_.overlay(GroundOverrides::Over::world, 0, patches.west * n, patches.south * n, ground.view());
  return ground;
}

Result<Live*> EditedGround::State::surfaceFor(const PlacedEdit& edit, const EditWork& work) {
  const auto ready = std::find_if(live_.begin(), live_.end(), [&](const Live& live) {
    return live.kind == edit.kind && live.patches.contains(edit.needed);
  });
  if (ready != live_.end()) return &*ready;
  const Result<Room> room = clear(edit.kind, edit.needed, work);
  if (!room) return room.error();
  Result<HeightMap> ground = groundOf(room->patches, work);
  if (!ground) return ground.error();
  const Result<Live*> joined = joinedIn(*room, *ground);
  if (!joined) return joined.error();
  if (*joined != nullptr) {
    if (Result<void> laid = lay(**joined); !laid) return laid.error();
    return *joined;
  }
  Live live{edit.kind, edit.deformer, room->patches, *std::move(ground), nullptr};
  const ConstHeightView heights = live.ground.view();
  auto begun = guarded(edit.kind, [&] { return edit.deformer->begin(regionOf(room->patches), heights); });
  if (!begun) return begun.error();
  if (!*begun) return begun->error();
  if (**begun == nullptr) return Error{"the deformer " + inQuotes(edit.kind) + " began no surface"};
  live.surface = std::move(**begun);
  if (Result<void> laid = lay(live); !laid) return laid.error();
  live_.push_back(std::move(live));
  return &live_.back();
}

/// The patches of a surface at rest that would spread, with those to which it would; none where it would not,
/// or may not.
Result<std::optional<PatchRectangle>> EditedGround::State::spreadOf(const Live& live) const {
  constexpr int kFar = 1 << 24;
  const auto asked = guarded(live.kind, [&] { return live.surface->spreadsTo(); });
  if (!asked) return asked.error();
  if (asked->isEmpty()) return std::optional<PatchRectangle>();
  if (!SampleRectangle{-kFar, -kFar, 2 * kFar, 2 * kFar}.contains(*asked))
    return Error{"the deformer " + inQuotes(live.kind) + " would spread to where no ground is"};
  const int bits = std::countr_zero(static_cast<unsigned>(world_.intervals()));
  const auto patchOf = [bits](int sample) { return std::int64_t{sample} >> bits; };
  const PatchRectangle& own = live.patches;
  const PatchRectangle all =
      own.joinedWith({own.west + patchOf(asked->column - kCollarCells - 1),
                      own.south + patchOf(asked->row - kCollarCells - 1),
                      own.west + patchOf(asked->column + asked->columns + kCollarCells) + 1,
                      own.south + patchOf(asked->row + asked->rows + kCollarCells) + 1});
  const bool isInWorld = PatchRectangle{-kMaxPatch, -kMaxPatch, kMaxPatch, kMaxPatch}.contains(all);
  if (!isInWorld || all.samples(world_.intervals()) > kMostJoinedSamples)
    return std::optional<PatchRectangle>();
  return std::optional(all);
}

/// Lets a surface at rest spread, if it would, and makes room for that before. True: it has changed, or what
/// lives has. One step more than it had done is counted, so that whoever applies the same edits does so too:
/// it may go on as a part of another surface that had done fewer.
Result<bool> EditedGround::State::spread(Live& live, const EditWork& work) {
  const Result<std::optional<PatchRectangle>> over = spreadOf(live);
  if (!over) return over.error();
  if (!*over) return false;
  stepsToSpread_ = std::max(stepsToSpread_, live.stepsSinceEdit() + 1);
  if (live.patches.contains(**over)) {
    const auto isAtRest = guarded(live.kind, [&] { return live.surface->spread(), live.surface->atRest(); });
    if (!isAtRest) return isAtRest.error();
    if (!*isAtRest) return true;
    return Error{"the deformer " + inQuotes(live.kind) + " says that it would spread, and does not"};
  }
  const Result<Room> room = clear(live.kind, **over, work);
  if (!room) return room.error();
  const Result<HeightMap> ground = groundOf(room->patches, work);
  if (!ground) return ground.error();
  const Result<Live*> joined = joinedIn(*room, *ground);
  if (!joined) return joined.error();
  if (*joined == nullptr) return true;
  if (Result<void> laid = lay(**joined); !laid) return laid.error();
  return true;
}

/// All that lives goes so many steps on from the latest edit, or to rest, where it spreads if it would.
Result<void> EditedGround::State::runAll(std::uint64_t steps, const EditWork& work) {
  for (auto live = live_.begin(); live != live_.end();) {
    if (Result<void> done = run(*live, live->stepsAtEdit + steps, work); !done) return done;
    if (live->surface->atRest() && live->stepsSinceEdit() < steps) {
      const Result<bool> spreads = spread(*live, work);
      if (!spreads) return spreads.error();
      if (*spreads) {
        live = live_.begin();
        continue;
      }
    }
    ++live;
  }
  return {};
}

Result<void> EditedGround::State::press(const PlacedEdit& edit, std::uint64_t steps, const EditWork& work) {
  if (isPause()) {
    if (Result<void> rested = rest(work); !rested) return rested;
  }
  resting_ = false;
  if (Result<void> done = runAll(steps, work); !done) return done;
  const Result<Live*> live = surfaceFor(edit, work);
  if (!live) return live.error();
  const double pitch = world_.pitch();
  const Offset place =
      offset({(*live)->patches.west, (*live)->patches.south, 0.0, 0.0}, edit.position, pitch);
  Stamp stamp = edit.stamp;
  stamp.east = place.east;
  stamp.north = place.north;
  const auto pressed = guarded(edit.kind, [&] { return (*live)->surface->apply(stamp); });
  if (!pressed) return pressed.error();
  if (!*pressed) return pressed->error();
  (*live)->isWritten = false;
  for (Live& one : live_) one.stepsAtEdit = one.surface->steps();
  stepsToSpread_ = 0;
  return {};
}

Result<void> EditedGround::State::rest(const EditWork& work) {
  if (Result<void> done = runAll(kMostEditSteps, work); !done) return done;
  for (Live& live : live_) {
    if (Result<void> done = runToRest(live, work); !done) return done;
    if (live.isWritten) continue;
    if (Result<void> written = write(live); !written) return written;
  }
  if (isPause()) {
    for (const Live& live : live_) {
      if (Result<void> noted = noteEnd(live); !noted) return noted;
    }
    live_.clear();
    keepCheckpoint();
  }
  resting_ = true;
  return {};
}

/// Of those that are so many pauses back, each eighth of that is kept: about 8 for each doubling.
void EditedGround::State::keepCheckpoint() {
  const std::uint64_t edits = mark_.edits;
  if (edits == 0 || (!checkpoints_.empty() && checkpoints_.back()->mark().edits == edits)) return;
  checkpoints_.push_back(std::make_shared<const GroundCheckpoint>(mark_, ended_, overrides_.share(), loose_));
  std::erase_if(checkpoints_, [edits](const auto& checkpoint) {
    const std::uint64_t pause = checkpoint->mark().edits / kMostEditsTogether;
    const std::uint64_t back = edits / kMostEditsTogether - pause;
    return pause % std::bit_floor(std::max<std::uint64_t>(back / 8, 1)) != 0;
  });
}

std::size_t EditedGround::State::goBack(std::size_t edits) {
  while (!checkpoints_.empty() && checkpoints_.back()->mark().edits > edits) checkpoints_.pop_back();
  if (checkpoints_.empty()) {
    mark_ = EditListMark::ofNone(hashOf(world_));
    ended_ = {};
    overrides_ = GroundOverrides(world_.intervals());
    loose_ = LooseLayer(world_.intervals());
  } else {
    mark_ = checkpoints_.back()->mark();
    ended_ = checkpoints_.back()->ended();
    overrides_ = checkpoints_.back()->overrides();
    loose_ = checkpoints_.back()->loose();
  }
  live_.clear();
  stepsToSpread_ = 0;
  resting_ = true;
  spent.reset();
  return mark_.edits;
}

Result<bool> EditedGround::State::fits(const GroundCheckpoint& checkpoint, std::span<const Edit> edits,
                                       const EditWork& work) const {
  const EditListMark& mark = checkpoint.mark();
  if (mark.edits > edits.size() || mark.edits % kMostEditsTogether != 0 ||
      checkpoint.intervals() != world_.intervals()) {
    return false;
  }
  std::map<std::string, std::string, std::less<>> versions;
  EditListMark found = EditListMark::ofNone(hashOf(world_));
  for (const Edit& edit : edits.first(mark.edits)) {
    auto version = versions.find(edit.kind);
    if (version == versions.end()) {
      const Result<DeformerKind> kind = deformers_(edit.kind);
      if (!kind) return false;
      version = versions.emplace(edit.kind, kind->version).first;
    }
    found = found.followedBy(edit, version->second);
  }
  if (found != mark) return false;
  const GroundOverrides overrides = checkpoint.overrides();
  for (const auto& [key, held] : overrides.patches()) {
    if (work.goesOn && !work.goesOn()) return kCancelled;
    if (!isOf(world_, key, *held.patch)) return false;
  }
  return true;
}

std::uint64_t EditedGround::State::stepsSinceEdit() const noexcept {
  if (isPause()) return 0;  // whatever the next edit says, all comes to rest before
  std::uint64_t most = stepsToSpread_;
  for (const Live& live : live_) most = std::max(most, live.stepsSinceEdit());
  return most;
}

std::size_t EditedGround::State::bytes() const {
  std::size_t sum = overrides_.bytes() + loose_.bytes();
  for (const auto& checkpoint : checkpoints_) sum += checkpoint->bytes();
  for (const Live& live : live_) sum += sizeof(live) + live.ground.bytes() + live.surface->bytes();
  return sum;
}

EditedGround::EditedGround(std::shared_ptr<const World> world, DeformerSource deformers)
    : world_(std::move(world)), state_(std::make_unique<State>(*world_, std::move(deformers))) {}

EditedGround::~EditedGround() = default;

Result<void> EditedGround::apply(const Edit& edit, const EditWork& work) {
  if (state_->spent) return *state_->spent;
  const Result<PlacedEdit> placed = state_->place(edit);
  if (!placed) return placed.error();
  Result<void> pressed = state_->press(*placed, edit.steps, work);
  if (pressed) {
    state_->count(edit, *placed);
  } else {
    state_->spent = pressed.error();
  }
  return pressed;
}

Result<void> EditedGround::rest(const EditWork& work) {
  if (state_->spent) return *state_->spent;
  Result<void> rested = state_->rest(work);
  if (!rested) state_->spent = rested.error();
  return rested;
}

Result<void> EditedGround::replay(std::span<const Edit> edits, const EditWork& work) {
  for (std::size_t k = state_->goBack(edits.size()); k < edits.size(); ++k) {
    if (work.goesOn && !work.goesOn()) return kCancelled;
    if (const Result<void> applied = apply(edits[k], work); !applied) {
      return Error{"edit " + std::to_string(k + 1) + ": " + applied.error().message};
    }
  }
  return {};
}

std::shared_ptr<const GroundCheckpoint> EditedGround::checkpoint(std::size_t most) const {
  return state_->checkpoint(most);
}

Result<bool> EditedGround::adopt(std::shared_ptr<const GroundCheckpoint> checkpoint,
                                 std::span<const Edit> edits, const EditWork& work) {
  Result<bool> fits = state_->fits(*checkpoint, edits, work);
  if (fits && *fits) state_->adopt(std::move(checkpoint));
  return fits;
}

Result<void> EditedGround::prove(const GroundCheckpoint& checkpoint, std::span<const Edit> edits,
                                 const EditWork& work) {
  const Result<bool> fits = state_->fits(checkpoint, edits, work);
  if (!fits) return fits.error();
  if (!*fits) return {};
  Result<void> done = replay(edits.first(checkpoint.mark().edits), work);
  if (done) done = rest(work);
  if (!done) return done;
  const std::shared_ptr<const GroundCheckpoint> proved = this->checkpoint();
  assert(proved && proved->mark() == checkpoint.mark());
  if (proved->text() != checkpoint.text()) return Error{"its edits make other ground"};
  return {};
}

std::size_t EditedGround::edits() const noexcept {
  return state_->edits();
}

bool EditedGround::atRest() const noexcept {
  return state_->atRest();
}

std::uint64_t EditedGround::stepsSinceEdit() const noexcept {
  return state_->stepsSinceEdit();
}

void EditedGround::query(std::span<const Position> places, std::span<SurfacePoint> points) const {
  assert(atRest());
  world_->query(places, points);
  for (std::size_t k = 0; k < places.size(); ++k) move(places[k], *world_, state_->overrides(), points[k]);
}

void EditedGround::overlay(int level, std::int64_t column, std::int64_t row, HeightView grid) const {
  assert(atRest());
  state_->overrides().overlay(GroundOverrides::Over::world, level, column, row, grid);
}

EditedGround::Snapshot EditedGround::snapshot() {
  assert(atRest());
  if (!shown_) {
    shown_ = std::make_shared<const GroundSnapshot>(GroundOverrides(world_->intervals()), world_->topLevel());
  }
  std::vector<SampleBox> changed = state_->overrides().follow(shown_->overrides());
  shown_ =
      std::make_shared<const GroundSnapshot>(state_->overrides().share(), world_->topLevel(), shown_.get());
  return {shown_, std::move(changed)};
}

std::uint64_t EditedGround::hash() const {
  assert(atRest());
  return state_->overrides().hash();
}

EndedSurfaces EditedGround::ended() const {
  return state_->ended();
}

std::size_t EditedGround::bytes() const {
  return state_->bytes();
}

DeformerSource deformersOf(std::shared_ptr<const PluginRegistry> registry) {
  return [registry = std::move(registry)](std::string_view id) -> Result<DeformerKind> {
    Result<std::shared_ptr<const Deformer>> deformer = registry->makeDeformer(id);
    if (!deformer) return deformer.error();
    return DeformerKind{*std::move(deformer), registry->find(id)->parameters, registry->find(id)->version};
  };
}

Result<std::unique_ptr<EditedGround>> editedGround(
    std::shared_ptr<const World> world, DeformerSource deformers, std::span<const Edit> edits,
    const std::function<bool(std::size_t done, std::size_t wanted)>& progress) {
  auto ground = std::make_unique<EditedGround>(std::move(world), std::move(deformers));
  EditWork work;
  if (progress) {
    work.slice = std::chrono::milliseconds(20);
    work.goesOn = [&] { return progress(ground->edits(), edits.size()); };
  }
  if (const Result<void> applied = ground->replay(edits, work); !applied) return applied.error();
  if (const Result<void> rested = ground->rest(work); !rested) return rested.error();
  return ground;
}

}  // namespace teren
