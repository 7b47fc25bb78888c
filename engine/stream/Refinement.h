// The way from what is drawn to what is wanted, a step at a time: no hole, no overlap, at any moment (law 5).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "teren/Slice.h"

#include "stream/Cut.h"
#include "stream/NodeStore.h"

namespace teren {

/// Follows cuts, one after the other: knows which of their nodes are held and drawn, which have to be made,
/// and which changes bring the drawn set nearer to the cut. Told of every change of the store, it never looks
/// through all nodes again but when another cut comes, and then in slices. Not thread-safe.
class Refinement {
 public:
  explicit Refinement(const NodeStore& nodes) : nodes_(nodes) {}

  /// Begins to turn to another cut, which must come after the one followed now (Cut::Node::before). Both must
  /// stay where they are and as they are; until turnStep() is true the old one is followed.
  void turnTo(Cut& cut);
  /// Goes on; true once the other cut is followed. About 30 ns a node of both.
  bool turnStep(const Slice& slice);

  /// Heights have come.
  void noteHeld(const NodeKey& key) { note(key); }
  /// The drawn set has changed.
  void noteChange(const DrawnChange& change);

  /// Whether the cut, or the one to come, wants this node held or drawn.
  bool isWanted(const NodeKey& key) const;
  std::size_t wanted() const noexcept { return now_.cut ? now_.cut->size() : 0; }
  /// Nodes of the cut that are not held, or, leaves, not drawn.
  std::size_t missing() const noexcept { return now_.missing; }
  std::size_t leaves() const noexcept { return now_.cut ? now_.cut->leaves() : 0; }
  /// The most urgent node that is neither held nor skipped; null where there is none.
  const Cut::Node* absent();
  /// Somebody has begun to make absent().
  void skipAbsent() { ++now_.nextAbsent; }
  /// A node held that was wanted and perhaps is not any more (isWanted), to be freed. None during a turn.
  std::optional<NodeKey> takeUnwanted();
  bool hasUnwanted() const noexcept { return !unwanted_.empty(); }

  /// Whether next() has anything to look at.
  bool mayChange() const noexcept { return !now_.ready.empty() || (!leaving_.empty() && !next_.cut); }
  /// The next change that brings the drawn set nearer to the cut, of up to `most` steps; empty
  /// where none of those looked at is possible (kLooks at a time: ask again while mayChange()). In this
  /// order:
  /// 1. What lies under no root of the cut goes, some nodes at a time.
  /// 2. A leaf whose heights are held takes the place of all finer nodes drawn in it.
  /// 3. The most urgent first: a node whose heights are held comes where nothing is drawn; a drawn node above
  ///    the cut is exchanged for its four children once all of them are held and no coarser node touches it.
  /// So levels of neighbours differ by more than one only beside new roots and after 2.
  DrawnChange next(std::size_t most);
  static constexpr int kLooks = 32;
  /// A change from next() has not been made: to be thought of once more.
  void again(const DrawnChange& change);

  std::size_t bytes() const noexcept;

 private:
  struct Ready {
    std::uint32_t place;  // the least goes first
    Cut::Index index;
  };
  struct Followed {
    Cut* cut = nullptr;
    std::size_t counted = 0;  // places that have been looked at
    std::size_t missing = 0;  // of these
    std::vector<Cut::Index> absent;
    std::size_t nextAbsent = 0;
    std::vector<Ready> ready;  // a heap

    void clear(Cut* newCut);
  };
  enum class Turn { marking, gathering, listing, leaving };

  void turnSome();
  void mark(Cut::Index index);
  void gather(Cut::Index index);
  void list(Cut::Index index);
  void leave(const Cut::Node& node);

  void note(const NodeKey& key);
  void noteUnwanted(const NodeKey& key);
  void note(Followed& followed, const NodeKey& key);
  void noteGone(Followed& followed, const NodeKey& key, bool isReplaced);
  void queueBelow(Followed& followed, Cut::Index index);
  void queue(Followed& followed, Cut::Index index);
  bool leaveSome(DrawnChange& change);
  bool canSplit(const Cut::Node& node) const;
  bool addStep(const Cut::Node& node, DrawnChange& change) const;

  const NodeStore& nodes_;
  Followed now_, next_;
  Turn turn_ = Turn::marking;
  std::size_t turned_ = 0;         // nodes of the turn's stage
  std::vector<NodeKey> leaving_;   // what is drawn in them and under no root has to go
  std::vector<NodeKey> unwanted_;  // perhaps
};

}  // namespace teren
