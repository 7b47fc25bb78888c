#include "apps/fly/AircraftShape.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <utility>

namespace teren {
namespace {

using Color = std::array<float, 3>;

constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kPropellerRate = 40.0F;  // [rad/s]; slow enough to be seen turning
constexpr float kPropellerAhead = 3.2F;  // [m] of the wings
constexpr Color kWhite{0.93F, 0.94F, 0.95F};
constexpr Color kGlass{0.10F, 0.16F, 0.22F};
constexpr Color kDark{0.12F, 0.12F, 0.13F};

/// A cross section of the fuselage: an ellipse at `y` along the aircraft, its middle at height `z`.
struct Section {
  float y, z, halfWidth, halfHeight;
};

/// A corner of a wing's outline, seen from above.
struct Corner {
  float x, y, z;
};

// A body of elliptic sections from tail to nose.
ModelPart body(const Color& color, std::span<const Section> sections) {
  constexpr int kSides = 12;
  ModelPart part{color, 0.5F};
  for (const Section& section : sections) {
    for (int side = 0; side < kSides; ++side) {
      const float turn = 2.0F * kPi * static_cast<float>(side) / kSides;
      part.points.push_back(
          {section.halfWidth * std::cos(turn), section.y, section.z + section.halfHeight * std::sin(turn)});
    }
  }
  for (std::uint32_t ring = 0; ring + 1 < sections.size(); ++ring) {
    for (std::uint32_t side = 0; side < kSides; ++side) {
      const std::uint32_t here = ring * kSides, there = here + kSides, next = (side + 1) % kSides;
      part.triangles.push_back({here + side, here + next, there + next});
      part.triangles.push_back({here + side, there + next, there + side});
    }
  }
  return part;
}

// A wing: its outline, thick in the middle and sharp at the edges, on both sides of the aircraft. `up` is the
// direction of its thickness.
ModelPart wing(const Color& color, std::span<const Corner> outline, const ModelPoint& up, float thickness,
               bool mirrored) {
  ModelPart part{color, 0.4F};
  const auto count = static_cast<std::uint32_t>(outline.size());
  for (const float sign : {1.0F, -1.0F}) {
    if (sign < 0.0F && !mirrored) break;
    const auto first = static_cast<std::uint32_t>(part.points.size());
    ModelPoint above{}, below{};
    for (const Corner& corner : outline) {
      const ModelPoint point{sign * corner.x, corner.y, corner.z};
      part.points.push_back(point);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        above[axis] += point[axis] / static_cast<float>(count);
        below[axis] = above[axis];
      }
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      above[axis] += up[axis] * thickness;
      below[axis] -= up[axis] * thickness;
    }
    part.points.push_back(above);
    part.points.push_back(below);
    for (std::uint32_t corner = 0; corner < count; ++corner) {
      const std::uint32_t here = first + corner, next = first + (corner + 1) % count;
      const bool forwards = (sign > 0.0F) == (up[2] > 0.5F);
      const std::uint32_t a = forwards ? here : next, b = forwards ? next : here;
      part.triangles.push_back({a, b, first + count});
      part.triangles.push_back({b, a, first + count + 1});
    }
  }
  return part;
}

void addFuselage(const Color& paint, Model& model) {
  constexpr std::array<Section, 8> kBody{{{-5.3F, 0.35F, 0.02F, 0.05F},
                                          {-4.9F, 0.32F, 0.12F, 0.22F},
                                          {-3.0F, 0.18F, 0.34F, 0.42F},
                                          {-1.2F, 0.08F, 0.55F, 0.62F},
                                          {0.8F, 0.02F, 0.60F, 0.66F},
                                          {2.2F, 0.0F, 0.52F, 0.52F},
                                          {3.0F, 0.0F, 0.40F, 0.42F},
                                          {3.05F, 0.0F, 0.02F, 0.02F}}};
  constexpr std::array<Section, 4> kBand{{{-3.4F, 0.205F, 0.31F, 0.395F},
                                          {-2.9F, 0.172F, 0.36F, 0.445F},
                                          {-2.3F, 0.14F, 0.43F, 0.51F},
                                          {-2.25F, 0.14F, 0.40F, 0.45F}}};
  constexpr std::array<Section, 5> kCanopy{{{-1.9F, 0.50F, 0.05F, 0.05F},
                                            {-1.2F, 0.62F, 0.36F, 0.32F},
                                            {-0.2F, 0.66F, 0.43F, 0.46F},
                                            {0.8F, 0.55F, 0.40F, 0.34F},
                                            {1.5F, 0.38F, 0.10F, 0.10F}}};
  constexpr std::array<Section, 3> kSpinner{
      {{3.03F, 0.0F, 0.24F, 0.24F}, {3.3F, 0.0F, 0.17F, 0.17F}, {3.55F, 0.0F, 0.01F, 0.01F}}};
  model.parts.push_back(body(kWhite, kBody));
  model.parts.push_back(body(paint, kBand));
  model.parts.push_back(body(kGlass, kCanopy));
  model.parts.push_back(body(paint, kSpinner));
}

void addWings(const Color& paint, Model& model) {
  constexpr std::array<Corner, 4> kWing{
      {{0.3F, 0.95F, -0.28F}, {0.3F, -0.85F, -0.28F}, {4.5F, -0.45F, 0.10F}, {4.5F, 0.62F, 0.10F}}};
  constexpr std::array<Corner, 4> kTip{
      {{4.5F, 0.62F, 0.10F}, {4.5F, -0.45F, 0.10F}, {5.5F, -0.32F, 0.20F}, {5.4F, 0.30F, 0.20F}}};
  constexpr std::array<Corner, 4> kTail{
      {{0.05F, -3.9F, 0.40F}, {0.05F, -4.9F, 0.40F}, {1.9F, -4.95F, 0.45F}, {1.85F, -4.4F, 0.45F}}};
  constexpr std::array<Corner, 4> kFin{
      {{0.0F, -3.5F, 0.5F}, {0.0F, -5.2F, 0.45F}, {0.0F, -5.55F, 2.0F}, {0.0F, -4.75F, 2.0F}}};
  constexpr ModelPoint up{0.0F, 0.0F, 1.0F}, sideways{1.0F, 0.0F, 0.0F};
  model.parts.push_back(wing(kWhite, kWing, up, 0.13F, true));
  model.parts.push_back(wing(paint, kTip, up, 0.05F, true));
  model.parts.push_back(wing(kWhite, kTail, up, 0.06F, true));
  model.parts.push_back(wing(paint, kFin, sideways, 0.08F, false));
}

void addPropeller(Model& model) {
  constexpr std::array<Corner, 6> kBlade{{{0.0F, 0.0F, -0.08F},
                                          {0.45F, 0.04F, -0.11F},
                                          {1.05F, 0.02F, -0.06F},
                                          {1.1F, 0.0F, 0.05F},
                                          {0.45F, -0.04F, 0.10F},
                                          {0.0F, 0.0F, 0.08F}}};
  ModelPart blades = wing(kDark, kBlade, {0.0F, 1.0F, 0.0F}, 0.03F, true);
  for (ModelPoint& point : blades.points) point[1] += kPropellerAhead;
  blades.spin = kPropellerRate;
  blades.hub = {0.0F, kPropellerAhead, 0.0F};
  model.parts.push_back(std::move(blades));
}

}  // namespace

Model aircraftShape(const std::array<float, 3>& paint) {
  Model model{"aircraft", {}};
  addFuselage(paint, model);
  addWings(paint, model);
  addPropeller(model);
  return model;
}

}  // namespace teren
