#include "apps/report/Crease.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace teren {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

Position moved(const Position& place, double east, double north, double pitch) {
  const Result<Position> there = place.movedBy(east, north, pitch);
  assert(there);
  return *there;
}

/// Sums of one class of places, and the places of one patch that belong to it.
struct PlaceSums {
  std::vector<std::array<double, 2>> images;  // [patches]
  double squares = 0.0, slopes = 0.0;
  double count = 0.0;
};

/// (x, y) and what it becomes by mirroring a patch and by exchanging its axes; none beyond the patch's own
/// half-open square.
std::vector<std::array<double, 2>> imagesOf(double x, double y) {
  std::vector<std::array<double, 2>> images;
  for (const auto& [a, b] : {std::array{x, y}, std::array{y, x}}) {
    for (const double u : {a, 1.0 - a}) {
      for (const double v : {b, 1.0 - b}) {
        const std::array image{u, v};
        if (u < 1.0 && v < 1.0 && std::find(images.begin(), images.end(), image) == images.end()) {
          images.push_back(image);
        }
      }
    }
  }
  return images;
}

/// The heights at a place and around it, of all places of a row of patches.
void addRow(const HeightsAt& heightsAt, double mean, int row, int patches, double step, double pitch,
            PlaceSums& sums) {
  std::vector<Position> places;
  for (int column = 0; column < patches; ++column) {
    for (const auto& [u, v] : sums.images) {
      const Position place{.i = column, .j = row, .u = u, .v = v};
      places.push_back(place);
      for (const double side : {-step, step}) {
        places.push_back(moved(place, side, 0.0, pitch));
        places.push_back(moved(place, 0.0, side, pitch));
      }
    }
  }
  std::vector<double> heights(places.size());
  heightsAt(places, heights);
  for (std::size_t k = 0; k < heights.size(); k += 5) {
    const double east = (heights[k + 3] - heights[k + 1]) / (2.0 * step);
    const double north = (heights[k + 4] - heights[k + 2]) / (2.0 * step);
    sums.squares += (heights[k] - mean) * (heights[k] - mean);
    sums.slopes += east * east + north * north;
    sums.count += 1.0;
  }
}

}  // namespace

std::vector<double> creaseAngles(const HeightsAt& heightsAt, std::span<const Position> places, Across across,
                                 double step, double pitch) {
  std::vector<Position> around;
  around.reserve(5 * places.size());
  for (const Position& place : places) {
    for (const double steps : {0.0, 1.0, 2.0, -1.0, -2.0}) {
      const double way = steps * step;
      around.push_back(across == Across::east ? moved(place, way, 0.0, pitch)
                                              : moved(place, 0.0, way, pitch));
    }
  }
  std::vector<double> heights(around.size());
  heightsAt(around, heights);
  std::vector<double> angles;
  angles.reserve(places.size());
  for (std::size_t k = 0; k < heights.size(); k += 5) {
    const double* h = &heights[k];
    const double ahead = (4.0 * (h[1] - h[0]) - (h[2] - h[0])) / (2.0 * step);
    const double behind = (4.0 * (h[0] - h[3]) - (h[0] - h[4])) / (2.0 * step);
    angles.push_back(kDegrees * std::fabs(std::atan(ahead) - std::atan(behind)));
  }
  return angles;
}

Result<std::vector<PlaceVariation>> variationAcross(const HeightsAt& heightsAt, double mean, int patches,
                                                    int parts, double step, double pitch, const GoOn& goOn) {
  std::vector<PlaceVariation> places;
  std::vector<PlaceSums> sums;
  for (int across = 0; across <= parts; ++across) {
    for (int along = 0; along <= across; ++along) {
      places.push_back({0.5 * across / parts, 0.5 * along / parts, 0.0, 0.0});
      sums.push_back({imagesOf(places.back().across, places.back().along)});
    }
  }
  for (int row = 0; row < patches; ++row) {
    if (!goOn()) return Error{"interrupted"};
    for (PlaceSums& place : sums) addRow(heightsAt, mean, row, patches, step, pitch, place);
  }
  for (std::size_t k = 0; k < places.size(); ++k) {
    places[k].deviation = std::sqrt(sums[k].squares / sums[k].count);
    places[k].slope = std::sqrt(sums[k].slopes / sums[k].count);
  }
  return places;
}

double rippleOf(std::span<const double> values) {
  if (values.empty()) return 0.0;
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum == 0.0 ? 0.0 : (*most - *least) * static_cast<double>(values.size()) / sum;
}

}  // namespace teren
