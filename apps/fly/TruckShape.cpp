#include "apps/fly/TruckShape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace teren {
namespace {

using Colour = std::array<float, 3>;

constexpr Colour kPaint{0.92F, 0.66F, 0.10F}, kWhite{0.93F, 0.94F, 0.95F};
constexpr Colour kGlass{0.10F, 0.16F, 0.22F}, kRubber{0.10F, 0.10F, 0.11F}, kSteel{0.45F, 0.46F, 0.48F};

/// A box from corner to corner, narrower by `taper` [m] on all sides at its top.
ModelPart box(const Colour& colour, const ModelPoint& low, const ModelPoint& high, float taper = 0.0F) {
  ModelPart part{colour, 0.4F};
  for (const bool top : {false, true}) {
    const float in = top ? taper : 0.0F, z = top ? high[2] : low[2];
    part.points.push_back({low[0] + in, low[1] + in, z});
    part.points.push_back({high[0] - in, low[1] + in, z});
    part.points.push_back({high[0] - in, high[1] - in, z});
    part.points.push_back({low[0] + in, high[1] - in, z});
  }
  const auto face = [&part](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    part.triangles.push_back({a, b, c});
    part.triangles.push_back({a, c, d});
  };
  face(0, 3, 2, 1);
  face(4, 5, 6, 7);
  face(0, 1, 5, 4);
  face(1, 2, 6, 5);
  face(2, 3, 7, 6);
  face(3, 0, 4, 7);
  return part;
}

/// Lies across, its middle at `y` ahead and `radius` above the ground.
ModelPart wheel(const Colour& colour, float left, float right, float y, float middle, float radius) {
  constexpr std::uint32_t kSides = 20;
  ModelPart part{colour, 0.2F};
  for (const float x : {left, right}) {
    for (std::uint32_t side = 0; side < kSides; ++side) {
      const float turn = 2.0F * std::numbers::pi_v<float> * static_cast<float>(side) / kSides;
      part.points.push_back({x, y + radius * std::cos(turn), middle + radius * std::sin(turn)});
    }
  }
  part.points.push_back({left, y, middle});
  part.points.push_back({right, y, middle});
  for (std::uint32_t side = 0; side < kSides; ++side) {
    const std::uint32_t next = (side + 1) % kSides;
    part.triangles.push_back({side, side + kSides, next + kSides});
    part.triangles.push_back({side, next + kSides, next});
    part.triangles.push_back({2 * kSides, side, next});
    part.triangles.push_back({2 * kSides + 1, next + kSides, side + kSides});
  }
  return part;
}

}  // namespace

Model truckShape() {
  Model model{"truck", {}};
  model.parts.push_back(box(kSteel, {-1.1F, -3.3F, 0.9F}, {1.1F, 3.3F, 1.4F}));
  model.parts.push_back(box(kPaint, {-1.7F, -3.5F, 1.4F}, {1.7F, 1.0F, 2.5F}));
  model.parts.push_back(box(kSteel, {-1.4F, -3.2F, 2.5F}, {1.4F, 0.7F, 2.52F}));
  model.parts.push_back(box(kPaint, {-1.6F, 1.2F, 1.3F}, {1.6F, 3.5F, 2.4F}));
  model.parts.push_back(box(kGlass, {-1.52F, 1.4F, 2.4F}, {1.52F, 3.2F, 3.1F}, 0.22F));
  model.parts.push_back(box(kWhite, {-1.34F, 1.58F, 3.1F}, {1.34F, 3.02F, 3.3F}, 0.1F));
  for (const float sign : {-1.0F, 1.0F}) {
    for (const float y : {-2.2F, 2.2F}) {
      const float inner = sign * 1.15F, outer = sign * 1.85F, hub = sign * 1.88F;
      model.parts.push_back(wheel(kRubber, std::min(inner, outer), std::max(inner, outer), y, 1.0F, 1.0F));
      model.parts.push_back(wheel(kWhite, std::min(outer, hub), std::max(outer, hub), y, 1.0F, 0.45F));
    }
  }
  return model;
}

}  // namespace teren
