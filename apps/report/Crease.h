// How sharply a landscape is bent along a line, and how evenly it varies across a patch: what blending is
// judged by.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "teren/Position.h"
#include "teren/Result.h"

#include "apps/report/Effort.h"

namespace teren {

/// Heights [m] at valid places; both spans have the same length.
using HeightsAt = std::function<void(std::span<const Position> places, std::span<double> heights)>;

enum class Across { east, north };

/// [degree] The angle at each place between the landscape on the one side of it and on the other, seen along
/// a line from north to south (across: east) or from west to east (across: north):
///   |atan(slope ahead) - atan(slope behind)|, slopes of parabolas through the heights at 0, 1 and 2 steps.
/// 0 of a plane within 1e-6 for steps of a millimetre or more and heights below 1 km; of a function with a
/// bounded third derivative in proportion to the step's square.
std::vector<double> creaseAngles(const HeightsAt& heightsAt, std::span<const Position> places, Across across,
                                 double step, double pitch);

/// How much a landscape varies at one place of its patches, over many patches.
struct PlaceVariation {
  double across = 0.0, along = 0.0;  ///< [patches] 0 <= along <= across <= 1/2; mirrored places count as one
  double deviation = 0.0;            ///< [m] root mean square of height - mean
  double slope = 0.0;                ///< root mean square of the gradient
};

/// Of the square of patches from (0, 0) to (patches - 1, patches - 1), at the places `parts` to a patch's
/// half; gradients by central differences one `step` [m] to each side.
Result<std::vector<PlaceVariation>> variationAcross(const HeightsAt& heightsAt, double mean, int patches,
                                                    int parts, double step, double pitch, const GoOn& goOn);

/// (largest - smallest) / mean of the values; 0 where their mean is.
double rippleOf(std::span<const double> values);

}  // namespace teren
