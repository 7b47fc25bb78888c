#include "apps/report/FlownNodes.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstdint>
#include <iterator>

namespace teren {
namespace {

struct NodeName {
  int level = 0;
  std::int64_t i = 0, j = 0;
  friend auto operator<=>(const NodeName&, const NodeName&) = default;
};

/// [m] From a place on an axis to an interval of it.
double gap(double place, double low, double side) {
  return std::max({low - place, place - (low + side), 0.0});
}

class Choice {
 public:
  Choice(std::span<const double> errors, const FlownView& view, double north)
      : errors_(errors), view_(view), north_(north) {
    const int top = static_cast<int>(errors.size()) - 1;
    const double side = std::ldexp(view.nodeSide, top);
    const auto reach = static_cast<std::int64_t>(std::ceil(view.distance / side)) + 1;
    const auto row = static_cast<std::int64_t>(std::floor(north / side));
    for (std::int64_t j = row - reach; j <= row + reach; ++j) {
      for (std::int64_t i = -reach; i <= reach; ++i) take({top, i, j});
    }
    std::sort(nodes_.begin(), nodes_.end());
  }

  std::vector<NodeName> nodes() && { return std::move(nodes_); }

 private:
  void take(const NodeName& node) {
    const double side = std::ldexp(view_.nodeSide, node.level);
    const double way = std::hypot(gap(view_.nodeSide / 2.0, static_cast<double>(node.i) * side, side),
                                  gap(north_, static_cast<double>(node.j) * side, side));
    if (way > view_.distance) return;
    const double seen =
        errors_[static_cast<std::size_t>(node.level)] / std::hypot(way, view_.clearance) * view_.lensPixels;
    if (node.level == 0 || seen <= view_.pixelError) {
      nodes_.push_back(node);
      return;
    }
    for (int child = 0; child < 4; ++child) {
      take({node.level - 1, 2 * node.i + (child & 1), 2 * node.j + (child >> 1)});
    }
  }

  std::span<const double> errors_;
  const FlownView& view_;
  double north_;
  std::vector<NodeName> nodes_;
};

}  // namespace

FlownNodes flownNodes(std::span<const double> errors, const FlownView& view) {
  FlownNodes flown{std::vector<double>(errors.size(), 0.0), std::vector<double>(errors.size(), 0.0)};
  if (errors.empty()) return flown;
  const auto looks = std::max(1, static_cast<int>(std::lround(view.seconds * view.looksASecond)));
  std::vector<NodeName> before, fresh;
  for (int look = 0; look <= looks; ++look) {
    std::vector<NodeName> nodes = Choice(errors, view, view.speed * look / view.looksASecond).nodes();
    for (const NodeName& node : nodes) flown.inView[static_cast<std::size_t>(node.level)] += 1.0;
    fresh.clear();
    std::set_difference(nodes.begin(), nodes.end(), before.begin(), before.end(), std::back_inserter(fresh));
    for (const NodeName& node : fresh) {
      if (look > 0) flown.newASecond[static_cast<std::size_t>(node.level)] += 1.0;
    }
    before = std::move(nodes);
  }
  for (double& count : flown.inView) count /= looks + 1;
  for (double& count : flown.newASecond) count *= view.looksASecond / looks;
  return flown;
}

}  // namespace teren
