#include "apps/report/Defaults.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

namespace teren {
namespace {

constexpr double kSame = 1e-6;

std::string number(double value) {
  return rounded(value, 3);
}

bool isSame(double a, double b) {
  return std::fabs(a - b) <= kSame * std::fabs(b);
}

std::string nameOf(BlendKernel kernel) {
  return kernel == BlendKernel::linear ? "linear" : "smooth";
}

/// Over the rows of a kernel (empty: both), with or without preserved variance, the largest of a column.
double largest(const Table& blending, const std::string& kernel, bool preserve, const std::string& column) {
  double most = 0.0;
  for (std::size_t row = 0; row < blending.rows().size(); ++row) {
    if (!kernel.empty() && blending.text(row, "kernel") != kernel) continue;
    if ((blending.text(row, "preserve variance") == "yes") != preserve) continue;
    most = std::max(most, blending.number(row, column));
  }
  return most;
}

Justification kernelOf(const DefaultsInCode& defaults, const Table& blending) {
  const auto crease = [&](const char* kernel) {
    return largest(blending, kernel, defaults.preserveVariance, "crease p99");
  };
  const auto time = [&](const char* kernel) {
    return largest(blending, kernel, defaults.preserveVariance, "time median");
  };
  const bool linearSeen = crease("linear") > kSeenCrease, smoothSeen = crease("smooth") > kSeenCrease;
  const bool smoothIsRight = !smoothSeen && (linearSeen || time("smooth") < time("linear"));
  return {"blend kernel", nameOf(defaults.kernel), "LayerDescription::blend",
          "The cheapest kernel whose creases along lattice lines are at most " + number(kSeenCrease) +
              " degrees at 99 of 100 places. Smooth: " + number(crease("smooth")) + " degrees, " +
              number(time("smooth")) + " ns a sample; linear: " + number(crease("linear")) + " degrees, " +
              number(time("linear")) +
              " ns (table blending, the worst of the layers, crease p99, time median).",
          smoothIsRight == (defaults.kernel == BlendKernel::smooth)};
}

/// The row of a generator and a kernel with or without preserved variance.
std::optional<std::size_t> blendingRow(const Table& blending, const std::string& generator,
                                       const std::string& kernel, bool preserve) {
  for (std::size_t row = 0; row < blending.rows().size(); ++row) {
    if (blending.text(row, "generator") == generator && blending.text(row, "kernel") == kernel &&
        (blending.text(row, "preserve variance") == "yes") == preserve) {
      return row;
    }
  }
  return std::nullopt;
}

Justification varianceOf(const DefaultsInCode& defaults, const Table& blending) {
  const std::string kernel = nameOf(defaults.kernel);
  std::size_t pairs = 0, better = 0;
  std::string figures;
  for (std::size_t with = 0; with < blending.rows().size(); ++with) {
    const std::string generator = blending.text(with, "generator");
    const std::optional<std::size_t> without = blendingRow(blending, generator, kernel, false);
    if (blendingRow(blending, generator, kernel, true) != with || !without) continue;
    const auto both = [&](const char* column) {
      return number(blending.number(with, column)) + " % in place of " +
             number(blending.number(*without, column)) + " %";
    };
    figures += " With it the deviation of " + generator + " ripples by " + both("ripple of deviation") +
               ", its slope by " + both("ripple of slope") + ".";
    ++pairs;
    if (blending.number(with, "ripple of deviation") < blending.number(*without, "ripple of deviation")) {
      ++better;
    }
  }
  return {"preserved variance", defaults.preserveVariance ? "yes" : "no",
          "LayerDescription::preserveVariance",
          "Wanted where it makes the land of every layer measured vary more evenly across a patch." +
              figures + " (table blending, kernel " + kernel + ")",
          pairs > 0 && (better == pairs) == defaults.preserveVariance};
}

Justification pixelErrorOf(const DefaultsInCode& defaults, const Table& detail) {
  std::optional<std::size_t> right, own;
  for (std::size_t row = 0; row < detail.rows().size(); ++row) {
    if (!isSame(detail.number(row, "view distance"), defaults.distance)) continue;
    const double error = detail.number(row, "pixel error");
    if (isSame(error, defaults.pixelError)) own = row;
    const bool fits = detail.number(row, "triangles") <= kMostTriangles;
    if (fits && (!right || error < detail.number(*right, "pixel error"))) right = row;
  }
  Justification answer{"pixel error", number(defaults.pixelError) + " px", "DetailSettings::pixelError",
                       "The smallest whose view of " + number(defaults.distance) +
                           " m, the default, fits under the cap with at most " + rounded(kMostTriangles, 3) +
                           " triangles.",
                       right && own && right == own};
  const auto tell = [&](const char* begin, std::size_t row) {
    answer.why += begin + detail.text(row, "pixel error") + " px: " + detail.text(row, "triangles") +
                  " triangles, " + number(detail.number(row, "memory")) + " MiB, true error at most " +
                  number(detail.number(row, "true max")) + " px, p99 " +
                  number(detail.number(row, "true p99")) + " px.";
  };
  if (right) tell(" By that rule ", *right);
  if (own && own != right) tell(" The default ", *own);
  if (!right) answer.why += " No row does.";
  answer.why += " (table detail)";
  return answer;
}

Justification flyingPixelErrorOf(const DefaultsInCode& defaults, const Table& frames) {
  std::optional<std::size_t> right;
  bool ownIsThere = false;
  std::string figures;
  for (std::size_t row = 0; row < frames.rows().size(); ++row) {
    if (!isSame(frames.number(row, "view distance"), defaults.flyingDistance)) continue;
    if (!isSame(frames.number(row, "lines"), kFlyingLines)) continue;
    const double error = frames.number(row, "pixel error"), median = frames.number(row, "frame median");
    ownIsThere = ownIsThere || isSame(error, defaults.flyingPixelError);
    const bool isSmooth = median * kSmooth <= 1e3;
    if (isSmooth && (!right || error < frames.number(*right, "pixel error"))) right = row;
    figures += (figures.empty() ? " " : ", ") + number(error) + " px: " + number(median) + " ms, p99 " +
               number(frames.number(row, "frame p99")) + " ms";
  }
  Justification answer{"pixel error of teren-fly", number(defaults.flyingPixelError) + " px", "kFlyingDetail",
                       "The smallest at which the median frame of a view of " +
                           number(defaults.flyingDistance) + " m, of " + number(kFlyingLines) +
                           " lines, is drawn " + number(kSmooth) + " times a second.",
                       std::nullopt};
  if (!figures.empty()) answer.why += figures + " (table frames).";
  if (!ownIsThere) return answer;
  answer.holds = right && isSame(frames.number(*right, "pixel error"), defaults.flyingPixelError);
  return answer;
}

Justification budgetOf(const DefaultsInCode& defaults, const Table& scheduling) {
  std::optional<std::size_t> largest, least;  // within the frame's share; that suffices
  const auto suffices = [&](std::size_t row) {
    return scheduling.number(row, "missing") == 0.0 && scheduling.number(row, "error reached") >= kReached;
  };
  for (std::size_t row = 0; row < scheduling.rows().size(); ++row) {
    if (scheduling.number(row, "workers") != 0.0) continue;
    const double budget = scheduling.number(row, "budget");
    const auto isMore = [&](const std::optional<std::size_t>& than) {
      return !than || budget > scheduling.number(*than, "budget");
    };
    if (budget <= kShareOfFrame && isMore(largest)) largest = row;
    if (suffices(row) && (!least || !isMore(least))) least = row;
  }
  Justification answer{
      "budget of an update", number(defaults.budget) + " ms", "teren flight --budget-us",
      "The largest within an eighth of a frame, of 60 a second: what a program can spare "
      "without missing one. It has to suffice: a flight at 300 m/s without workers, with "
      "the default detail, misses no ground and has the error wanted in " +
          number(kReached) +
          " % of the looks. Budgets run by the wall's clock, so what other programs do meanwhile counts "
          "against them.",
      largest && suffices(*largest) && isSame(scheduling.number(*largest, "budget"), defaults.budget)};
  const auto tell = [&](const std::string& begin, std::size_t row) {
    answer.why += begin + scheduling.text(row, "budget") + " ms: " + scheduling.text(row, "missing") +
                  " updates missed ground, the error was reached in " +
                  number(scheduling.number(row, "error reached")) + " %, an update takes " +
                  number(scheduling.number(row, "update p99")) + " us (p99).";
  };
  if (largest) tell(" ", *largest);
  if (least && least != largest) tell(" The smallest that suffices, ", *least);
  if (!least) answer.why += " No row suffices.";
  answer.why += " (table scheduling)";
  return answer;
}

}  // namespace

std::vector<Justification> justify(const DefaultsInCode& defaults, const Table& blending, const Table& detail,
                                   const Table& frames, const Table& scheduling) {
  return {kernelOf(defaults, blending), varianceOf(defaults, blending), pixelErrorOf(defaults, detail),
          flyingPixelErrorOf(defaults, frames), budgetOf(defaults, scheduling)};
}

}  // namespace teren
