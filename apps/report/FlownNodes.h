// How many nodes a view of a flight takes, and how many of them are new each second, where every level is as
// wrong as it was measured to be.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace teren {

/// An eye at a constant height above level ground, heading north.
struct FlownView {
  double nodeSide = 64.0;      ///< [m] of a node of level 0
  double distance = 20'000.0;  ///< [m] nodes farther away are left out
  double lensPixels = 869.0;   ///< as in Eye
  double pixelError = 8.0;     ///< [px] a node is split where its error is seen as more
  double clearance = 100.0;    ///< [m]
  double speed = 300.0;        ///< [m/s]
  double seconds = 10.0;       ///< of flight
  double looksASecond = 10.0;  ///< how often the nodes are chosen
};

/// By level.
struct FlownNodes {
  std::vector<double> inView;      ///< on average
  std::vector<double> newASecond;  ///< chosen at a look, and not at the one before
};

/// `errors` [m] by level, from 0 on; that of level 0 does not matter, for it is never split. Nodes of the
/// last level tile the ground. O(looks * nodes).
FlownNodes flownNodes(std::span<const double> errors, const FlownView& view);

}  // namespace teren
