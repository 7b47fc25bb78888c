// Which nodes the engine wants, and how urgently.
#pragma once

#include <span>
#include <vector>

#include "teren/Engine.h"

#include "patch/NodeKey.h"

namespace teren {

/// The nodes of the view around a position, nearest to it first (ties by key, so that the order is fixed).
std::vector<NodeKey> viewNodes(const Position& position, const ViewSettings& view, const World& world);

/// Whether a node may be drawn in the view around `centre`: of its level, and within `margin` nodes more than
/// the view, so that turning about does not throw away what is wanted again at once.
bool mayStay(const NodeKey& key, const NodeKey& centre, const ViewSettings& view, int margin) noexcept;

/// The level-0 nodes an object needs: those within kGroundMargin of its place now and where its motion takes
/// it within kGroundSeconds, its own first.
inline constexpr double kGroundMargin = 8.0;   ///< [m]
inline constexpr double kGroundSeconds = 2.0;  ///< [s]
std::vector<NodeKey> groundNodes(const Motion& motion, const World& world);

}  // namespace teren
