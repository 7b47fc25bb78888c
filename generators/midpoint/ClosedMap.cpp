#include "generators/midpoint/ClosedMap.h"

#include <cmath>
#include <cstddef>
#include <vector>

namespace teren {
namespace {

/// Every point as a sum of independent sources, one a point.
class ClosedMap {
 public:
  explicit ClosedMap(int intervals) : side_(intervals + 1), points_(square(side_)) {}

  /// A new point: parents' sums and an own source.
  struct Parent {
    int x, y;
    double weight;
  };
  void add(int x, int y, std::span<const Parent> parents, double deviation) {
    std::vector<double>& sum = points_[at(x, y)];
    sum.assign(points_.size(), 0.0);
    for (const Parent& parent : parents) {
      const std::vector<double>& other = points_[at(parent.x, parent.y)];
      for (std::size_t n = 0; n < sum.size(); ++n) sum[n] += parent.weight * other[n];
    }
    sum[at(x, y)] = deviation;
  }

  double meanVariance() const {
    double all = 0.0;
    for (const std::vector<double>& sum : points_) {
      for (double weight : sum) all += weight * weight;
    }
    return all / static_cast<double>(points_.size());
  }

 private:
  static std::size_t square(int n) { return static_cast<std::size_t>(n) * static_cast<std::size_t>(n); }
  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(side_) + static_cast<std::size_t>(x);
  }
  int side_;
  std::vector<std::vector<double>> points_;
};

void addStage(ClosedMap& map, const MidpointSettings& settings, const MidpointStage& stage, int intervals,
              int h) {
  const auto deviation = [](MidpointSource source, double move) {
    return move * std::sqrt(midpointVariance(source));
  };
  for (int y = h; y < intervals; y += 2 * h) {
    for (int x = h; x < intervals; x += 2 * h) {
      const ClosedMap::Parent parents[] = {{x - h, y - h, stage.centre[0]},
                                           {x + h, y - h, stage.centre[1]},
                                           {x - h, y + h, stage.centre[2]},
                                           {x + h, y + h, stage.centre[3]}};
      map.add(x, y, parents, deviation(settings.centre, stage.centreMove));
    }
  }
  for (int across = 0; across <= intervals; across += 2 * h) {
    const int centre = across == 0 ? h : across - h;
    for (int along = h; along < intervals; along += 2 * h) {
      const ClosedMap::Parent row[] = {{along - h, across, stage.rimEnds},
                                       {along + h, across, stage.rimEnds},
                                       {along, centre, stage.rimCentre}};
      map.add(along, across, row,
              deviation(across == 0 ? settings.south : settings.north, stage.rimMoves[across == 0 ? 0 : 2]));
      const ClosedMap::Parent column[] = {{across, along - h, stage.rimEnds},
                                          {across, along + h, stage.rimEnds},
                                          {centre, along, stage.rimCentre}};
      map.add(across, along, column,
              deviation(across == 0 ? settings.west : settings.east, stage.rimMoves[across == 0 ? 1 : 3]));
    }
  }
}

}  // namespace

double meanVarianceOfMap(const MidpointSettings& settings, std::span<const MidpointStage> stages) {
  const int intervals = 1 << stages.size();
  ClosedMap map(intervals);
  const double corner = std::sqrt(midpointVariance(settings.centre));
  for (const int y : {0, intervals}) {
    for (const int x : {0, intervals}) map.add(x, y, {}, corner);
  }
  int h = intervals;
  for (const MidpointStage& stage : stages) addStage(map, settings, stage, intervals, h /= 2);
  return map.meanVariance();
}

}  // namespace teren
