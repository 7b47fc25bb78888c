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

Justification varianceOf(const DefaultsInCode& defaults, const Table& blending) {
  const std::string kernel = nameOf(defaults.kernel);
  const double with = largest(blending, kernel, true, "ripple of deviation");
  const double without = largest(blending, kernel, false, "ripple of deviation");
  return {"preserved variance", defaults.preserveVariance ? "yes" : "no",
          "LayerDescription::preserveVariance",
          "What makes land vary more evenly across a patch. With it the deviation ripples by " +
              number(with) + " %, without by " + number(without) + " % (table blending, " + kernel +
              ", the worst of the layers, ripple of deviation); the slope by " +
              number(largest(blending, kernel, true, "ripple of slope")) + " and " +
              number(largest(blending, kernel, false, "ripple of slope")) + " %.",
          (with < without) == defaults.preserveVariance};
}

Justification pixelErrorOf(const DefaultsInCode& defaults, const Table& detail) {
  double farthest = 0.0;
  for (std::size_t row = 0; row < detail.rows().size(); ++row) {
    farthest = std::max(farthest, detail.number(row, "view distance"));
  }
  std::optional<std::size_t> right, own;
  for (std::size_t row = 0; row < detail.rows().size(); ++row) {
    const double error = detail.number(row, "pixel error");
    if (isSame(error, defaults.pixelError)) own = row;
    const bool fits =
        detail.number(row, "view distance") >= farthest && detail.number(row, "triangles") <= kMostTriangles;
    if (fits && (!right || error < detail.number(*right, "pixel error"))) right = row;
  }
  Justification answer{"pixel error", number(defaults.pixelError) + " px", "DetailSettings::pixelError",
                       "The smallest whose view reaches " + number(farthest) +
                           " m under the cap with at most " + rounded(kMostTriangles, 3) + " triangles.",
                       right && own && right == own};
  const auto tell = [&](const char* begin, std::size_t row) {
    answer.why += begin + detail.text(row, "pixel error") + " px: " + detail.text(row, "triangles") +
                  " triangles as far as " + detail.text(row, "view distance") + " m, true error at most " +
                  number(detail.number(row, "true max")) + " px, p99 " +
                  number(detail.number(row, "true p99")) + " px.";
  };
  if (right) tell(" By that rule ", *right);
  if (own && own != right) tell(" The default ", *own);
  if (!right) answer.why += " No row does.";
  answer.why += " (table detail)";
  return answer;
}

Justification budgetOf(const DefaultsInCode& defaults, const Table& scheduling) {
  std::optional<std::size_t> right, own;
  for (std::size_t row = 0; row < scheduling.rows().size(); ++row) {
    if (scheduling.number(row, "workers") != 0.0) continue;
    const double budget = scheduling.number(row, "budget");
    if (isSame(budget, defaults.budget)) own = row;
    const bool enough =
        scheduling.number(row, "missing") == 0.0 && scheduling.number(row, "error reached") >= kReached;
    if (enough && (!right || budget < scheduling.number(*right, "budget"))) right = row;
  }
  Justification answer{"budget of an update", number(defaults.budget) + " ms", "teren flight --budget-us",
                       "The smallest with which a flight at 300 m/s without workers misses no ground and has "
                       "the error wanted in " +
                           number(kReached) + " % of the looks.",
                       right && own && right == own};
  const auto tell = [&](const char* begin, std::size_t row) {
    answer.why += begin + scheduling.text(row, "budget") + " ms: " + scheduling.text(row, "missing") +
                  " updates missed ground, the error was reached in " +
                  number(scheduling.number(row, "error reached")) + " %, an update takes " +
                  number(scheduling.number(row, "update p99")) + " us (p99).";
  };
  if (right) tell(" By that rule ", *right);
  if (own && own != right) tell(" The default ", *own);
  if (!right) answer.why += " No row does.";
  answer.why += " (table scheduling)";
  return answer;
}

}  // namespace

std::vector<Justification> justify(const DefaultsInCode& defaults, const Table& blending, const Table& detail,
                                   const Table& scheduling) {
  return {kernelOf(defaults, blending), varianceOf(defaults, blending), pixelErrorOf(defaults, detail),
          budgetOf(defaults, scheduling)};
}

}  // namespace teren
