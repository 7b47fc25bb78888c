#include "apps/report/GroundSample.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "teren/Hash.h"

namespace teren {
namespace {

double uniform(RandomSequence& random) {
  return static_cast<double>(random.nextBits(48)) * 0x1p-48;
}

/// [m] From the centre.
double distanceOf(RandomSequence& random, double farthest, bool byDistance) {
  const double share = uniform(random);
  if (!byDistance) return farthest * std::sqrt(share);
  return kNearestPlace * std::pow(farthest / kNearestPlace, share);
}

}  // namespace

Result<GroundSample> sampleGround(const World& world, const Position& centre, double distance,
                                  std::size_t places, std::size_t around, const GoOn& goOn) {
  GroundSample sample;
  sample.distance = distance;
  RandomSequence random(11);
  for (std::size_t k = 0; k < places; ++k) {
    if (k == places / 2) sample.byDistance = sample.places.size();
    const double angle = 2.0 * std::numbers::pi * uniform(random);
    const double way = distanceOf(random, distance, k < places / 2);
    const Result<Position> there =
        centre.movedBy(way * std::cos(angle), way * std::sin(angle), world.pitch());
    if (!there) return there.error();
    for (std::size_t n = 0; n < around; ++n) {
      sample.places.push_back({.i = there->i, .j = there->j, .u = uniform(random), .v = uniform(random)});
    }
  }
  sample.heights.resize(sample.places.size());
  constexpr std::size_t kBatch = 4096;
  std::vector<SurfacePoint> points(kBatch);
  for (std::size_t first = 0; first < sample.places.size(); first += kBatch) {
    if (!goOn()) return Error{"interrupted"};
    const std::size_t count = std::min(kBatch, sample.places.size() - first);
    world.query(std::span(sample.places).subspan(first, count), std::span(points).first(count));
    for (std::size_t k = 0; k < count; ++k) sample.heights[first + k] = points[k].drawn;
  }
  return sample;
}

SurfaceErrors errorsOf(const SceneQuery& query, const GroundSample& sample, const Eye& eye, double pitch) {
  SurfaceErrors errors;
  std::vector<DrawnPoint> drawn(sample.places.size());
  query.seenFrom({eye.position, eye.height}).points(sample.places, drawn);
  for (std::size_t k = 0; k < drawn.size(); ++k) {
    if (!drawn[k].there) continue;
    const double error = std::fabs(drawn[k].height - sample.heights[k]);
    const Offset way = offset(eye.position, sample.places[k], pitch);
    const double up = sample.heights[k] - eye.height;
    const double distance = std::sqrt(way.east * way.east + way.north * way.north + up * up);
    const double pixels = error / std::max(distance, kNearestGround) * eye.lensPixels;
    errors.maxMetres = std::max(errors.maxMetres, error);
    errors.maxPixels = std::max(errors.maxPixels, pixels);
    if (k < sample.byDistance) {
      errors.pixels.push_back(pixels);
    } else {
      errors.metres.push_back(error);
    }
    ++errors.places;
    if (drawn[k].level == 0) ++errors.finest;
    const double rounding = (kDrawnPointError + kMorphRounding) * std::fabs(drawn[k].height);
    if (error > drawn[k].error + rounding) ++errors.beyondPromise;
  }
  return errors;
}

}  // namespace teren
