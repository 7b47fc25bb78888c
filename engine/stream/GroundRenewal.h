// Brings other edits into all that the engine holds: everything goes over to them at once, a little at a
// time.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "teren/GroundEdits.h"
#include "teren/HeightMap.h"
#include "teren/World.h"

#include "patch/NodeKey.h"
#include "stream/JoinTask.h"
#include "stream/NodeStore.h"

namespace teren {

/// One renewal after the other. Each finds the nodes held that see changed samples and lets their new heights
/// come (NodeStore::come); plans the pieces of those that are drawn, from when on the drawn set must stay as
/// it is (isFixing); hands out a task that builds them; and exchanges them, shows all and settles it. Until
/// then everything, also what is inserted meanwhile, has the heights of the edits before: what is drawn or
/// asked for always shows the same edits everywhere, and nothing opens. Not thread-safe.
class GroundRenewal {
 public:
  GroundRenewal(const World& world, NodeStore& nodes) : world_(world), nodes_(nodes) {}

  /// Edits to come after those under way; those that had not been begun come with them.
  void setEdits(std::shared_ptr<const GroundEdits> edits, std::span<const SampleBox> changed);

  /// The errors of levels are known better, and with them how vertices move.
  void lookAgain();

  /// What all that is held and settled shows; null: no edits.
  const std::shared_ptr<const GroundEdits>& shown() const noexcept { return shown_; }
  /// A node to be inserted, with the heights of the edits shown.
  EditedNode edited(const NodeKey& key, HeightMap own, HeightMap coarser) const;
  /// It has been.
  void noteInserted(const NodeKey& key);

  /// Edits that are shown no more: letting go of them may free what is theirs alone, which may be much.
  std::vector<std::shared_ptr<const GroundEdits>> takeOld() { return std::exchange(old_, {}); }

  bool isWaiting() const noexcept { return next_ != nullptr; }  ///< there are edits to begin with
  bool isUnderWay() const noexcept { return stage_ != Stage::idle; }
  /// The drawn set, and what is held of it, must stay as it is.
  bool isFixing() const noexcept { return stage_ >= Stage::planning; }
  /// All heights that are to come have, so it may go on with plan().
  bool isReadyToPlan() const noexcept { return stage_ == Stage::overlaying && stale_.empty(); }
  bool isPlanned() const noexcept { return stage_ == Stage::planned; }
  bool isBuilding() const noexcept { return stage_ == Stage::building; }

  void begin();
  void plan();
  /// As before plan(): there is no room for what was planned.
  void putOff();
  void make();
  /// One step of what needs no decision, some 20 us at most; false where it has to wait for one.
  bool step();
  /// Of all pieces, once they are made.
  std::unique_ptr<JoinTask> takeTask();
  void takeBuilt(std::unique_ptr<JoinTask> built);

  /// Of the meshes planned, at most.
  std::size_t plannedBytes() const noexcept { return pieceBytes_; }
  std::size_t bytes() const noexcept;
  /// Of them, what edits take, also with nothing under way: as much as those that take most. The others
  /// mostly share what they have with these.
  std::size_t editsBytes() const noexcept { return std::max({shownBytes_, comingBytes_, nextBytes_}); }

 private:
  enum class Stage {
    idle,
    finding,
    overlaying,
    planning,
    planned,
    making,
    made,
    building,
    exchanging,
    settling,
    clearing
  };

  EditedNode edited(const NodeKey& key, HeightMap own, HeightMap coarser, const GroundEdits* edits) const;
  bool stays(const NodeKey& key, const GroundEdits& edits) const;
  bool staysOtherwise(const NodeKey& key) const;
  void noteChanged(const SampleBox& box);
  void findSome();
  void overlayOne();
  void planOne();
  void forgetSome();
  static void eraseSome(NodeSet& keys);
  void makeOne();
  void exchangeOne();
  void settleOne();
  void clearSome();

  const World& world_;
  NodeStore& nodes_;
  Stage stage_ = Stage::idle;
  std::shared_ptr<const GroundEdits> shown_, coming_, next_;
  std::vector<std::shared_ptr<const GroundEdits>> old_;
  std::size_t shownBytes_ = 0, comingBytes_ = 0, nextBytes_ = 0;
  std::deque<SampleBox> changed_, nextChanged_;  // in tiles
  bool looksAgain_ = false;                      // at all nodes held, with what comes next
  std::vector<NodeKey> toLookAt_;                // of them
  NodeSet found_;
  std::vector<NodeKey> stale_, renewed_;  // still to be overlaid; drawn ones that were
  std::size_t nextRenewed_ = 0;
  NodeSet seen_;
  std::vector<NodeKey> affected_;
  std::vector<PiecePlan> plans_;
  bool isPutOff_ = false;                    // those, and seen_, are of no account any more
  std::size_t pieces_ = 0, pieceBytes_ = 0;  // all that are planned
  std::size_t left_ = 0;                     // of them, not exchanged
  std::unique_ptr<JoinTask> task_;
};

}  // namespace teren
