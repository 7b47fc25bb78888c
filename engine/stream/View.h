// Which nodes the engine wants, and how urgently.
#pragma once

#include <span>
#include <vector>

#include "teren/Engine.h"

#include "patch/NodeKey.h"
#include "stream/GridWalk.h"

namespace teren {

/// Whether a node may be wanted: inside the world, so that its neighbours never leave it either.
bool insideWorld(const NodeKey& key) noexcept;

/// The nodes of the view around a position, nearest to it first (ties by key, so that the order is fixed).
std::vector<NodeKey> viewNodes(const Position& position, const ViewSettings& view, const World& world);

/// Whether a node may be drawn in the view around `centre`: of its level, and within `margin` nodes more than
/// the view, so that turning about does not throw away what is wanted again at once.
bool mayStay(const NodeKey& key, const NodeKey& centre, const ViewSettings& view, int margin) noexcept;

/// The level-0 nodes an object needs: those within kGroundMargin (or its reach, if larger) of its place now
/// and wherever its motion takes it within kGroundSeconds, be it only over a corner of one, in the order in
/// which it reaches them.
/// Only the next kGroundPitches of its way count, so a faster object's ground is wanted for a shorter time.
struct GroundNodes {
  std::vector<NodeKey> wanted;
  /// It will have left these within kGroundNotice, most likely before they could be made: to be kept where
  /// they are held, but not made. For an object faster than kGroundPitches in kGroundNotice (about 160 km/s
  /// over patches of 64 m) there are only these, and only around its place.
  std::vector<NodeKey> passing;

  /// A node on an object's way.
  struct Passage {
    NodeKey key;
    Span span;  ///< when the object is over it, or within its margin
  };
  std::vector<Passage> passages;  ///< all of them; kept for the room it has
};
inline constexpr double kGroundMargin = 8.0;   ///< [m]
inline constexpr double kGroundSeconds = 2.0;  ///< [s]
inline constexpr double kGroundNotice = 0.05;  ///< [s]
inline constexpr double kGroundPitches = 128.0;
/// Allocates only for more nodes than `nodes` has had before.
void groundNodes(const Motion& motion, const World& world, GroundNodes& nodes);

}  // namespace teren
