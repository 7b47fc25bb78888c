#include "generators/midpoint/MidpointReference.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "generators/midpoint/MidpointNumbers.h"

namespace teren {
namespace {

/// A map of 2^k + 1 samples a side, filled as it is asked for.
class PlainMap {
 public:
  PlainMap(const MidpointDisplacement& displacement, const MapRequest& request, int side)
      : settings_(displacement.settings()),
        plan_(displacement.plan(MidpointDisplacement::stagesOf(request))),
        seed_(request.seed),
        last_(side - 1),
        heights_(static_cast<std::size_t>(side) * static_cast<std::size_t>(side)) {}

  float height(int x, int y) {
    std::optional<float>& height = heights_[static_cast<std::size_t>(y) * (last_ + 1) + x];
    if (!height) height = static_cast<float>(isCorner(x, y) ? corner(x, y) : made(x, y));
    return *height;
  }

 private:
  bool isCorner(int x, int y) const { return (x == 0 || x == last_) && (y == 0 || y == last_); }

  double number(MidpointSource source, int stage, int column, int row) const {
    return midpointNumber(source, Gaussian::table(), midpointWord(midpointRowKey(seed_, stage, row), column));
  }

  double corner(int x, int y) const {
    const int which = (x > 0 ? 1 : 0) + (y > 0 ? 2 : 0);
    return plan_.cornerMove * number(settings_.centre, -1, which, 0);
  }

  /// The point's place tells its stage: the largest power of two that divides it is the distance to its
  /// neighbours. It is a centre if both coordinates have that power, else an edge point.
  double made(int x, int y) {
    const int h = 1 << std::countr_zero(static_cast<unsigned>(x | y));
    const int number = std::countr_zero(static_cast<unsigned>(last_ / h)) - 1;
    const MidpointStage& stage = plan_.stages[static_cast<std::size_t>(number)];
    if (((x / h) & (y / h) & 1) != 0) return centre(stage, number, x, y, h);
    return (x / h) % 2 != 0 ? alongRow(stage, number, x, y, h) : alongColumn(stage, number, x, y, h);
  }

  double centre(const MidpointStage& stage, int i, int x, int y, int h) {
    return stage.centre[0] * height(x - h, y - h) + stage.centre[1] * height(x + h, y - h) +
           stage.centre[2] * height(x - h, y + h) + stage.centre[3] * height(x + h, y + h) +
           stage.centreMove * number(settings_.centre, i, x / h, y / h);
  }

  double alongRow(const MidpointStage& stage, int i, int x, int y, int h) {
    const double ends = static_cast<double>(height(x - h, y)) + static_cast<double>(height(x + h, y));
    const MidpointSource source = y == 0 ? settings_.south : settings_.north;
    const double random = number(source, i, x / h, y / h);
    if (y == 0) return stage.rimEnds * ends + stage.rimCentre * height(x, h) + stage.rimMoves[0] * random;
    if (y == last_) {
      return stage.rimEnds * ends + stage.rimCentre * height(x, y - h) + stage.rimMoves[2] * random;
    }
    return stage.ends * ends + stage.firstCentre * height(x, y - h) + stage.secondCentre * height(x, y + h) +
           stage.moves[2] * random;
  }

  double alongColumn(const MidpointStage& stage, int i, int x, int y, int h) {
    const double ends = static_cast<double>(height(x, y - h)) + static_cast<double>(height(x, y + h));
    const MidpointSource source = x == 0 ? settings_.west : settings_.east;
    const double random = number(source, i, x / h, y / h);
    if (x == 0) return stage.rimEnds * ends + stage.rimCentre * height(h, y) + stage.rimMoves[1] * random;
    if (x == last_) {
      return stage.rimEnds * ends + stage.rimCentre * height(x - h, y) + stage.rimMoves[3] * random;
    }
    return stage.ends * ends + stage.firstCentre * height(x - h, y) + stage.secondCentre * height(x + h, y) +
           stage.moves[3] * random;
  }

  const MidpointSettings& settings_;
  const MidpointPlan& plan_;
  std::uint64_t seed_;
  int last_;
  std::vector<std::optional<float>> heights_;
};

}  // namespace

void midpointReference(const MidpointDisplacement& displacement, const MapRequest& request, HeightView out) {
  if (request.samples == 1) {
    out(0, 0) = PlainMap(displacement, request, 3).height(1, 1);
    return;
  }
  PlainMap map(displacement, request, request.samples);
  for (int row = 0; row < request.samples; ++row) {
    for (int column = 0; column < request.samples; ++column) out(column, row) = map.height(column, row);
  }
}

}  // namespace teren
