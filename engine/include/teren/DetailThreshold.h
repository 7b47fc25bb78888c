// At which error a node gives way to its four children, and they to it: for whoever chooses nodes, and for
// shaders that hide the exchange.
#pragma once

namespace teren {

/// A node is split where its error is seen as more than kSplitsAt times the pixel error wanted, and its
/// children merge again where it is seen as at most kMergesAt times that: who flies to and fro does not make
/// land come and go. Lower values want more nodes, about as the inverse square.
inline constexpr double kSplitsAt = 1.0, kMergesAt = 0.8;

/// The multiple of the pixel error wanted at which a node is exchanged.
constexpr double exchangeAt(bool isSplit) noexcept {
  return isSplit ? kMergesAt : kSplitsAt;
}

}  // namespace teren
