// A world's ground as a list of edits leaves it: what bake and query answer with, wherever the list is
// applied.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "teren/Deformer.h"
#include "teren/Edit.h"
#include "teren/GroundEdits.h"
#include "teren/HeightMap.h"
#include "teren/Position.h"
#include "teren/World.h"

namespace teren {

class GroundCheckpoint;
class GroundSnapshot;

/// A deformer and the table of its stamps' values, which lives as long as the deformer.
struct DeformerKind {
  std::shared_ptr<const Deformer> deformer;
  std::span<const Parameter> parameters;
  std::string version;  ///< of its plugin: another one may make other ground of the same edits
};

/// Gives a deformer by its id, or says in one sentence why there is none; for the same id always the same.
using DeformerSource = std::function<Result<DeformerKind>(std::string_view id)>;

/// The registry's deformers.
DeformerSource deformersOf(std::shared_ptr<const PluginRegistry> registry);

/// Live surfaces that have ended, and what was lost or won by that: in them volume is kept, but what remains
/// are samples (LiveSurface::samplingError).
struct EndedSurfaces {
  std::uint64_t surfaces = 0;
  double error = 0.0;     ///< [m^3] of all together, positive where there is more now
  double absolute = 0.0;  ///< [m^3] of each by itself, added up without their signs

  friend bool operator==(const EndedSurfaces&, const EndedSurfaces&) = default;
};

/// How work at edits is cut up. What comes out does not depend on it.
struct EditWork {
  std::chrono::microseconds slice{0};  ///< how long a slice may be; zero: unlimited
  std::function<bool()> goesOn;        ///< asked between slices, where given; false cancels
};

/// The ground depends on the world, the ordered list of edits and nothing else (law 1). How:
///
/// * An edit needs the patches within its deformer's reach and the collar around that. First everything in
///   motion does the edit's logical steps, in the order in which it was begun.
/// * If a live surface of its kind has all those patches, it is applied there. Otherwise room is made over
///   the patches needed: while a live surface is in the way there, the one that began first runs to rest and
///   its samples become the ground's; one of the edit's kind makes the room the bounding rectangle of both,
///   unless that had more than kMostJoinedSamples. All others end; those that made it larger become one that
///   has the room (LiveSurface::merge, or grow of one), so that loose material stays loose. Where they refuse
///   to, the first grows alone and the others end; where it refuses, too, or there is none, a new one begins.
/// * After each kMostEditsTogether edits everything comes to rest and ends, before anything else is done: so
///   the ground then is its samples alone, and how deep it is loose at each of them, which is what replay()
///   begins with. Whatever begins or grows over loose ground is told (LiveSurface::layLoose).
/// * A surface at rest that would spread (LiveSurface::spreadsTo) does so before its next logical step, as
///   soon as one is asked for, and before whatever began after it does any. It is made room for as for an
///   edit; where it would have more than kMostJoinedSamples, or leave the world, it lies as it lies.
/// * At level L, samples that coincide with level-0 samples that were changed are these (grids only sample).
///   Between samples the ground is the world's, moved by what lies between the changed samples and the
///   world's own, linearly over the drawn triangles: so how far drawn ground is off stays the world's bound.
///
/// One thread at a time; the const functions any number, while nobody changes it.
class EditedGround {
 public:
  static constexpr std::int64_t kMostJoinedSamples = std::int64_t{1} << 20;
  /// More make undoing slower, fewer let surfaces begin anew more often.
  static constexpr std::size_t kMostEditsTogether = 128;
  static constexpr std::int64_t kMostStampSamples = std::int64_t{1} << 22;  ///< of the patches one edit needs

  EditedGround(std::shared_ptr<const World> world, DeformerSource deformers);
  ~EditedGround();
  EditedGround(const EditedGround&) = delete;
  EditedGround& operator=(const EditedGround&) = delete;

  /// Applies the next edit of the list. Refuses, and nothing has changed: what checkEdit refuses, an unknown
  /// kind, parameters that its table refuses, a place or a reach beyond the world or kMostStampSamples, and
  /// fewer steps than were done since the edit before. Where the deformer refuses the stamp, breaks its
  /// promises (throws, writes what is not finite or into the collar, never rests) or the work is cancelled
  /// ("cancelled"), the ground is no list's any more: every later call says the same.
  Result<void> apply(const Edit& edit, const EditWork& work = {});

  /// The ground becomes that of another list, which agrees with what was applied so far as far as both go;
  /// also where the ground was no list's any more. Applies at most kMostEditsTogether edits again, and where
  /// the list ends farther back an eighth of how far. Errors name the edit by its number, from 1.
  Result<void> replay(std::span<const Edit> edits, const EditWork& work = {});

  /// The ground at the latest pause between edits, of the first `most` of them, for a program to come; null
  /// where there was none. The same object until another one is later.
  std::shared_ptr<const GroundCheckpoint> checkpoint(
      std::size_t most = std::numeric_limits<std::size_t>::max()) const;
  /// Lets replay() begin with what another ground has left, before anything is applied (assert). False: it is
  /// of no use here, as it belongs to other edits than the first ones of `edits`, to other versions of
  /// plugins, or to terrain that was elsewhere: some samples of every patch are held against the world's own.
  /// Refuses to be cancelled only.
  Result<bool> adopt(std::shared_ptr<const GroundCheckpoint> checkpoint, std::span<const Edit> edits,
                     const EditWork& work = {});
  /// Applies the edits that made a checkpoint again, without it, and refuses where that makes other ground;
  /// one that would be of no use here says nothing, and is let be.
  Result<void> prove(const GroundCheckpoint& checkpoint, std::span<const Edit> edits,
                     const EditWork& work = {});
  /// How many edits were applied.
  std::size_t edits() const noexcept;

  /// Everything runs to rest, as it must before anyone asks. Live surfaces stay; an edit that comes later
  /// must say how many steps that took (stepsSinceEdit), so that a list that is played again does as many.
  Result<void> rest(const EditWork& work = {});
  /// Whether the questions below may be asked. True before the first edit.
  bool atRest() const noexcept;
  /// Logical steps since the latest edit, of that which took most.
  std::uint64_t stepsSinceEdit() const noexcept;

  const World& world() const noexcept { return *world_; }

  // At rest only (assert):

  /// What World::query says, with the edits; the two of a place without edits near by are equal. Spans of one
  /// length (assert), valid places.
  void query(std::span<const Position> places, std::span<SurfacePoint> points) const;
  /// Writes the changed samples over a grid of a level: its sample (x, y) is number (column + x, row + y) of
  /// that level, counted from the world's zero. O(changed samples in it + log patches a row of patches).
  void overlay(int level, std::int64_t column, std::int64_t row, HeightView grid) const;
  /// What is changed, and what ever was and is the world's own again, for those who draw (Engine::setEdits);
  /// and where it is not as in the last snapshot, in boxes. O(patches with changed samples).
  struct Snapshot {
    std::shared_ptr<const GroundEdits> edits;
    std::vector<SampleBox> changed;
  };
  Snapshot snapshot();

  /// Of all that was changed, where and to what; the same wherever the list was applied.
  std::uint64_t hash() const;
  /// What has ended so far; the same wherever the list was applied, too.
  EndedSurfaces ended() const;

  /// Bytes of changed samples and of live surfaces.
  std::size_t bytes() const;

 private:
  class State;
  std::shared_ptr<const World> world_;
  std::unique_ptr<State> state_;
  std::shared_ptr<const GroundSnapshot> shown_;  // the last one
};

/// Applies a list to a world and lets it come to rest. Errors name the edit by its number, from 1. `progress`
/// is asked between slices, with how many edits are done; false cancels ("cancelled").
Result<std::unique_ptr<EditedGround>> editedGround(
    std::shared_ptr<const World> world, DeformerSource deformers, std::span<const Edit> edits,
    const std::function<bool(std::size_t done, std::size_t wanted)>& progress = {});

}  // namespace teren
