// The defaults in the code beside the rows of a report that justify them, or do not.
#pragma once

#include <string>
#include <vector>

#include "teren/World.h"

#include "apps/report/Table.h"

namespace teren {

/// As the code has them.
struct DefaultsInCode {
  BlendKernel kernel = BlendKernel::smooth;
  bool preserveVariance = true;
  double pixelError = 2.0;  ///< [px]
  double budget = 2.0;      ///< [ms]
};

struct Justification {
  std::string what;   ///< "pixel error"
  std::string value;  ///< "2 px"
  std::string where;  ///< "DetailSettings::pixelError"
  std::string why;    ///< the rule, and what the rows say, in sentences
  bool holds = false;
};

/// By these rules:
///   kernel: the cheapest whose crease's 99th percentile is at most kSeenCrease on every layer measured;
///   preserved variance: what makes the ripple of the deviation less on every layer measured;
///   pixel error: the smallest whose view reaches as far as any in the table, and takes at most
///   kMostTriangles; budget: the smallest with which, without workers, no ground was missing and the error
///   was reached in kReached of the looks.
inline constexpr double kSeenCrease = 0.1;  ///< [degree]
inline constexpr double kMostTriangles = 1e6;
inline constexpr double kReached = 99.0;  ///< [%]
std::vector<Justification> justify(const DefaultsInCode& defaults, const Table& blending, const Table& detail,
                                   const Table& scheduling);

}  // namespace teren
