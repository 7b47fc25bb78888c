// The engine's work: decides which nodes are wanted, has them made, joins them to the drawn set, frees what
// is not wanted, and keeps all of it under the byte cap.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "teren/Engine.h"
#include "teren/GroundEdits.h"

#include "patch/NodeKey.h"
#include "schedule/SliceMeter.h"
#include "schedule/TaskRunner.h"
#include "stream/GroundRenewal.h"
#include "stream/JoinTask.h"
#include "stream/MemoryPlan.h"
#include "stream/NodeStore.h"
#include "stream/NodeTable.h"
#include "stream/Refinement.h"
#include "stream/Selection.h"
#include "stream/View.h"
#include "world/BaseMap.h"

namespace teren {

class ErrorCalibration;

/// One thread calls it; with workers, nodes and pieces are made on theirs, and the caller only hands out
/// tasks, takes what is finished and frees. All of the caller's work is done in slices (law 4).
///
/// With detail by error, what is wanted is the cut of a Selection and everything above it, and the drawn set
/// follows by the steps of a Refinement: coarse land first, and no hole from then on. Choosing is work like
/// any other: the old cut is followed until the next one is there.
///
/// Under the cap (law 6) the view's radius, or the pixel error, and the room for base maps are planned from
/// what a node costs (MemoryPlan), as many bytes again as its meshes have set aside for the renderer's copy
/// of them, and no task begins unless there is room for what it makes. So the cap holds at every moment,
/// unless a renderer takes more than that (then the view shrinks at the next choice).
class Streamer {
 public:
  Streamer(const World& world, const EngineOptions& options);

  /// What the cap must be at least for such a world and view: ground, one task in flight, a view of radius 1.
  /// `others`: views of further objects.
  static std::size_t leastCap(const World& world, const EngineOptions& options,
                              std::span<const std::optional<DetailSettings>> others = {});

  /// Says what is wanted around these objects: the ground at once, and all of a uniform view, where somebody
  /// has come to another node. Detail by error is chosen by work().
  void choose(std::span<const Motion> motions, std::size_t active);
  /// Works until the deadline or until there is nothing to do (here, or yet).
  void work(Slice::Clock::time_point deadline);
  /// With workers: waits a while for one to finish something.
  void wait(std::chrono::milliseconds most) { runner_.waitForFinished(most); }
  /// Nothing is missing, or nothing more can be done under the cap; and nothing is left to free.
  bool isSettled() const;
  /// With detail by error: nothing is missing, but node errors are still to be measured, and can be under the
  /// cap.
  bool isMeasuring() const;

  /// The view of detail by error; there must be one already.
  void setDetail(const DetailSettings& detail);
  /// Of the objects by index, while they are not active; with detail by error only.
  void setViews(std::span<const std::optional<DetailSettings>> views);

  /// See Engine::setEdits.
  void setEdits(std::shared_ptr<const GroundEdits> edits, std::span<const SampleBox> changed) {
    renewal_.setEdits(std::move(edits), changed);
  }
  /// Edits are not shown yet.
  bool isRenewing() const noexcept { return renewal_.isWaiting() || renewal_.isUnderWay(); }

  const NodeStore& nodes() const noexcept { return nodes_; }
  /// What is drawn, to be published.
  std::shared_ptr<const Scene> snapshot(const Morph& morph) { return nodes_.snapshot(morph); }
  /// See NodeStore.
  void letGoOfOldSnapshots() noexcept;
  /// There are edits that go with them.
  bool hasOldEdits() const noexcept { return !oldEdits_.empty(); }
  const SliceMeter& meter() const noexcept { return meter_; }
  const MemoryPlan& plan() const noexcept { return plan_; }
  /// [px] Aimed at; 0 in a uniform view.
  double pixelError() const noexcept {
    return options_.view.detail ? tolerance_ * options_.view.detail->pixelError : 0.0;
  }
  /// A choice that is not done yet counts for one, which is missing, and so do edits that are not shown yet.
  std::size_t wanted() const noexcept { return wanted_.size() + refinement_.wanted() + underWay(); }
  std::size_t missing() const noexcept {
    return missing_ + (wanted_.size() - surveyed_) + refinement_.missing() + underWay();
  }
  std::size_t unfinished() const { return runner_.unfinished(); }  ///< tasks
  std::size_t bytes() const;
  std::size_t peakBytes() const noexcept { return peakBytes_; }
  void setRendererBytes(std::size_t bytes) noexcept;

 private:
  struct Build {
    TaskRunner::Ticket ticket;
    bool isGround;
  };
  /// A node to be made next.
  struct Wish {
    NodeKey key;
    std::int64_t urgency;
    bool isGround;
  };
  /// [m] Between which the ground lies, as far as is known.
  struct GroundRange {
    double low = 0.0, high = 0.0;
    friend bool operator==(const GroundRange&, const GroundRange&) = default;
  };
  /// The caller's own work, as a task: freeing, integrating, handing out.
  class Housekeeping final : public SlicedTask {
   public:
    explicit Housekeeping(Streamer& streamer) : streamer_(streamer) {}
    bool step(const Slice& slice) override;

   private:
    Streamer& streamer_;
  };

  void sizeBuilds();

  // Choosing
  void chooseGround(std::span<const Motion> motions);
  MemoryNeeds needs(std::size_t groundNodes) const;
  void chooseUniform(const Position& eye);
  bool isGroundAsBefore() const;
  void rank(std::span<const NodeKey> view);
  void surveyRank(std::size_t rank);
  bool surveySome();
  bool isSurveyed() const noexcept { return surveyed_ == wanted_.size() && !listsHeld_ && held_.empty(); }
  void cancelUnwanted();
  void countMissing();
  bool isDrawable(const NodeKey& key) const;
  bool isThere(const NodeKey& key) const;
  bool isGround(std::size_t rank) const noexcept { return rank < groundCount_; }

  // Detail by error
  void chooseDetail(std::span<const Motion> motions, std::size_t active);
  bool isViewedAsBefore() const;
  bool isChosen() const;
  std::size_t underWay() const noexcept {
    return (selection_ && !isChosen() ? 1 : 0) + (isRenewing() ? 1 : 0);
  }
  bool chooseSome(const Slice& slice);
  MemoryNeeds detailNeeds() const;
  GroundRange groundRange() const;
  void beginChoice();
  void beginLearning();
  void learnSome();
  void noteError(const NodeKey& key);
  void tryTolerance(double tolerance, double share);
  void judgeChoice();
  bool fits(const MemoryNeeds& needs, double share) const noexcept;
  /// More leaves than these cannot fit.
  std::size_t mostLeaves(const MemoryNeeds& needs) const noexcept;
  std::size_t detailBytes() const noexcept;
  bool isWanted(const NodeKey& key) const;

  // Edits
  bool renewSome();
  bool beginRenewal(bool isIdle);
  bool isTurnOfOthers() const;
  bool planRenewal();
  bool takeRoomForRenewal();
  bool renewIdly();
  void endRenewal();
  bool freeOldEdits();
  void workUntilDeadline();
  std::chrono::nanoseconds worked() const;

  // Working
  std::size_t leastViewBuilds() const noexcept;
  void feedWorkers();
  bool tidyOne(const Slice& slice);
  void drop(const NodeKey& key);
  void collect();
  void integrate(TaskRunner::Finished finished);
  void integrateJoin(const JoinTask& task);
  bool startJoin();
  bool startRefining();
  void change(const DrawnChange& change, std::span<const BuiltPiece> pieces);
  bool passOver();
  std::optional<Wish> nextWish();
  bool startBuild();
  bool startCalibration();
  /// [bytes] Beyond the cap, with the renderer's share of what is drawn already.
  std::size_t lacking(std::size_t more) const;
  bool hasRoomFor(std::size_t more) const { return lacking(more) == 0; }
  /// Frees something of what can be made again, for what lacks room (law 6): a calibration, or a base map as
  /// long as more than the least are kept. False where nothing is left to free.
  bool giveWay(std::size_t to);

  const World& world_;
  EngineOptions options_;
  std::size_t buildBytes_ = 0;    // of one node task, at most; never less than before
  std::size_t calibrationBytes_;  // of one calibration
  std::size_t mostViewBuilds_ = 0, mostGroundBuilds_ = 0;
  std::size_t viewBuilds_ = 1;  // in flight at once, as far as workers need them
  bool isFull_ = false;         // there were as many since the last update
  BaseMapStore maps_;
  NodeStore nodes_;
  SliceMeter meter_;
  Housekeeping housekeeping_{*this};

  MemoryPlan plan_;
  std::optional<NodeKey> centre_;  // of a uniform view: its node under the active object
  // With detail by error:
  enum class Choosing { idle, learning, selecting, turning };
  std::vector<std::optional<DetailSettings>> views_;  // of objects that are not active
  std::optional<Selection> selection_;
  Refinement refinement_{nodes_};
  std::size_t borderBytes_ = 0, selectionBytes_ = 0;
  std::vector<Viewer> viewers_, chosenFor_;  // as they are now, and as they were for the latest choice
  MemoryNeeds needs_;                        // for the latest choice
  int errorLevels_ = -1;                     // whose errors were measured then
  Morph morph_;                              // for a tolerance of 1: how far off nodes of each level may be
  bool learned_ = false;                     // more of single nodes since
  std::vector<NodeKey> toLearn_;             // held nodes whose errors are to be looked at
  GroundRange range_;                        // of the ground, as it was known then
  Choosing choosing_ = Choosing::idle;
  double tolerance_ = 1.0;  // of the pixel error, more than 1 under the cap
  double tried_ = 1.0, share_ = 1.0;
  bool lacksRoom_ = false;  // the drawn set can be brought nearer to the cut, but for want of room
  bool changesOneByOne_ = false;
  bool givesWay_ = false;  // something has been freed for want of room since work() began

  GroundRenewal renewal_{world_, nodes_};
  std::shared_ptr<const GroundEdits> chosenEdits_;            // of the latest choice
  std::vector<std::shared_ptr<const GroundEdits>> oldEdits_;  // to be let go of
  TaskRunner::Ticket freeing_ = 0;                            // of such, in flight or arrived; 0: none
  TaskRunner::Ticket renewalTask_ = 0;                        // in flight or arrived; 0: none
  std::size_t renewalBytes_ = 0;  // kept free since one found no room, till all are shown
  std::size_t renewalLacks_ = 0;  // room for so many, of the one under way
  bool joinGoesFirst_ = false;    // one since the last renewal
  int idleWorks_ = 0;             // calls of work() that had nothing else to do since it lacks room
  bool wasIdle_ = false;          // this one
  // Of work() alone:
  Slice::Clock::time_point workBegan_{};
  std::chrono::nanoseconds workedBefore_{0}, renewalBegan_{0}, renewalEnded_{0};

  GroundNodes groundOfOne_;
  std::vector<std::vector<NodeKey>> groundLists_;
  std::vector<NodeKey> ground_;
  NodeTable groundSeen_;
  std::size_t groundCount_ = 0;   // the first of wanted_: level-0 nodes under objects
  std::vector<NodeKey> wanted_;   // most urgent first; of a view by error, ground only
  NodeTable ranks_;               // in wanted_
  std::size_t missing_ = 0;       // of the first `surveyed_`
  std::size_t surveyed_ = 0;      // the others have not been looked at since all were ranked
  bool listsHeld_ = false;        // then: all nodes held are to be listed ...
  std::vector<NodeKey> held_;     // ... and looked at for what is to be dropped
  std::size_t nextWanted_ = 0;    // all before it are held or being made
  std::vector<NodeKey> drops_;    // to be freed, when there is time
  std::set<std::size_t> toJoin_;  // ranks of nodes held and to be drawn

  std::size_t rendererBytes_ = 0, peakMeshBytes_ = 0;
  std::size_t rendererExtra_ = 0;  // the most that the renderer held beyond a copy of all meshes
  std::size_t peakBytes_ = 0;

  std::unordered_map<NodeKey, Build, NodeKeyHash> builds_;  // in flight or arrived
  std::size_t groundBuilds_ = 0;
  TaskRunner::Ticket join_ = 0;  // in flight or arrived; 0: none
  std::size_t joinBytes_ = 0;
  NodeSet joining_;
  std::shared_ptr<ErrorCalibration> calibrator_;  // of the world's node errors; null where none is under way
  TaskRunner::Ticket calibration_ = 0;            // its next steps, likewise
  std::deque<TaskRunner::Finished> arrived_;
  TaskRunner runner_;  // last: ends before what its tasks use
};

}  // namespace teren
