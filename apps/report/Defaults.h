// The defaults in the code beside the rows of a report that justify them, or do not.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "teren/World.h"

#include "apps/report/Table.h"

namespace teren {

/// As the code has them.
struct DefaultsInCode {
  BlendKernel kernel = BlendKernel::smooth;
  bool preserveVariance = true;
  double pixelError = 8.0;           ///< [px] of an engine with detail by error ...
  double distance = 10'000.0;        ///< [m] ... and how far it sees
  double flyingPixelError = 24.0;    ///< [px] of teren-fly ...
  double flyingDistance = 20'000.0;  ///< [m] ... and how far that sees
  double budget = 2.0;               ///< [ms]
};

struct Justification {
  std::string what;           ///< "pixel error"
  std::string value;          ///< "8 px"
  std::string where;          ///< "DetailSettings::pixelError"
  std::string why;            ///< the rule, and what the rows say, in sentences
  std::optional<bool> holds;  ///< nothing where the run has not measured it
};

/// By these rules:
///   kernel: the cheapest whose crease's 99th percentile is at most kSeenCrease on every layer measured;
///   preserved variance: what makes the ripple of the deviation less on every layer measured;
///   pixel error: the smallest whose view, as far as an engine sees by default, takes at most kMostTriangles;
///   pixel error of teren-fly: the smallest whose median frame, of kFlyingLines lines, is drawn kSmooth times
///   a second; budget: the largest within kShareOfFrame of a frame, if without workers no ground was missing
///   and the error was reached in kReached of the looks.
inline constexpr double kSeenCrease = 0.1;  ///< [degree]
/// About what two processors without a graphics card draw 25 times a second (doc/accuracy.md).
inline constexpr double kMostTriangles = 1e6;
inline constexpr double kSmooth = 30.0;                    ///< [1/s]
inline constexpr double kFlyingLines = 720.0;              ///< [px] of the pictures that are counted for it
inline constexpr double kShareOfFrame = 1e3 / 60.0 / 8.0;  ///< [ms] an eighth of a frame, of 60 a second
inline constexpr double kReached = 99.0;                   ///< [%]
/// `frames` may be without rows.
std::vector<Justification> justify(const DefaultsInCode& defaults, const Table& blending, const Table& detail,
                                   const Table& frames, const Table& scheduling);

}  // namespace teren
