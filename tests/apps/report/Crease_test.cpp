// Creases and ripple of landscapes that are known.
#include "apps/report/Crease.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "teren/World.h"

#include "apps/report/Statistics.h"
#include "tests/apps/report/SmallWorld.h"

namespace teren {
namespace {

using test::always;

constexpr double kPitch = 64.0, kStep = 2.0 / 1024.0;
constexpr double kDegree = std::numbers::pi / 180.0;

/// A landscape by its formula, in metres.
template <class Formula>
HeightsAt landscape(const Formula& formula) {
  return [formula](std::span<const Position> places, std::span<double> heights) {
    for (std::size_t k = 0; k < places.size(); ++k) {
      heights[k] = formula(places[k].x(kPitch), places[k].y(kPitch));
    }
  };
}

HeightsAt landscape(const std::shared_ptr<const World>& world) {
  return [world](std::span<const Position> places, std::span<double> heights) {
    world->heights(places, heights);
  };
}

std::shared_ptr<const World> blended(BlendKernel kernel, bool preserve) {
  WorldDescription description;
  description.layers.resize(1);
  description.layers[0].generator = "fault";
  description.layers[0].blend = kernel;
  description.layers[0].preserveVariance = preserve;
  const auto world = World::create(description, *PluginRegistry::standard());
  EXPECT_TRUE(world) << world.error().message;
  return *world;
}

/// On the lattice lines of some patches, where the axis that is crossed is 0.
std::vector<Position> linePlaces(Across across) {
  std::vector<Position> places;
  for (int i = 0; i < 4; ++i) {
    for (int k = 1; k < 16; ++k) {
      const double along = k / 16.0;
      places.push_back({.i = i,
                        .j = 3,
                        .u = across == Across::east ? 0.0 : along,
                        .v = across == Across::east ? along : 0.0});
    }
  }
  return places;
}

TEST(Crease, OfAPlaneIsNone) {
  const HeightsAt plane = landscape([](double x, double y) { return 500.0 + 0.7 * x - 1.3 * y; });
  for (const Across across : {Across::east, Across::north}) {
    for (const double angle : creaseAngles(plane, linePlaces(across), across, kStep, kPitch)) {
      EXPECT_LT(angle, 1e-6);
    }
  }
}

TEST(Crease, OfAParabolaIsNone) {
  const HeightsAt bowl = landscape([](double x, double y) { return 0.01 * x * x - 0.02 * x * y; });
  for (const double angle : creaseAngles(bowl, linePlaces(Across::east), Across::east, kStep, kPitch)) {
    EXPECT_LT(angle, 1e-5);
  }
}

TEST(Crease, OfARoofIsTheAngleBetweenItsSides) {
  const double west = std::tan(20.0 * kDegree), east = std::tan(-35.0 * kDegree);
  const HeightsAt roof = landscape([=](double x, double) {
    const double line = std::floor(x / kPitch + 0.5) * kPitch;  // the nearest lattice line
    return x < line ? west * (x - line) : east * (x - line);
  });
  for (const double angle : creaseAngles(roof, linePlaces(Across::east), Across::east, kStep, kPitch)) {
    EXPECT_NEAR(angle, 55.0, 1e-6);
  }
  for (const double angle : creaseAngles(roof, linePlaces(Across::north), Across::north, kStep, kPitch)) {
    EXPECT_NEAR(angle, 0.0, 1e-6) << "along the ridge there is nothing to be seen";
  }
}

TEST(Crease, IsLeftByLinearBlendingAndNotBySmooth) {
  for (const bool preserve : {false, true}) {
    for (const Across across : {Across::east, Across::north}) {
      const auto of = [&](BlendKernel kernel) {
        return summaryOf(
            creaseAngles(landscape(blended(kernel, preserve)), linePlaces(across), across, kStep, kPitch));
      };
      EXPECT_GT(of(BlendKernel::linear).median, 1.0);
      EXPECT_LT(of(BlendKernel::smooth).max, 0.01);
    }
  }
}

TEST(Variation, OfAPlaneIsItsSlopeEverywhere) {
  const HeightsAt plane = landscape([](double x, double y) { return 0.3 * x - 0.4 * y; });
  const auto places = variationAcross(plane, 0.0, 3, 4, 0.03, kPitch, always);
  ASSERT_TRUE(places);
  EXPECT_EQ(places->size(), 15U);
  for (const PlaceVariation& place : *places) EXPECT_NEAR(place.slope, 0.5, 1e-9);
}

TEST(Variation, TellsPlacesOfAPatchApart) {
  // Nothing on the lattice lines, and a hill in the middle of each patch.
  const HeightsAt hills = landscape([](double x, double y) {
    const auto across = [](double t) { return std::sin(std::numbers::pi * t / kPitch); };
    return 7.0 + std::pow(across(x) * across(y), 2.0);
  });
  const auto places = variationAcross(hills, 7.0, 2, 4, 0.03, kPitch, always);
  ASSERT_TRUE(places);
  for (const PlaceVariation& place : *places) {
    const auto across = [](double t) { return std::pow(std::sin(std::numbers::pi * t), 2.0); };
    EXPECT_NEAR(place.deviation, across(place.across) * across(place.along), 1e-9)
        << place.across << " " << place.along;
  }
}

TEST(Variation, IsEvenerWherePreserved) {
  const auto rippleWith = [](bool preserve) {
    const auto world = blended(BlendKernel::smooth, preserve);
    const auto places =
        variationAcross(landscape(world), world->mean(), 12, 2, world->spacing(0) / 64.0, kPitch, always);
    std::vector<double> deviations;
    for (const PlaceVariation& place : *places) deviations.push_back(place.deviation);
    return rippleOf(deviations);
  };
  EXPECT_GT(rippleWith(false), 0.4) << "four equal weights halve the deviation";
  EXPECT_LT(rippleWith(true), 0.2);
}

TEST(Variation, EndsWhenItIsAskedTo) {
  const HeightsAt plane = landscape([](double, double) { return 0.0; });
  const auto places = variationAcross(plane, 0.0, 3, 4, 0.03, kPitch, [] { return false; });
  ASSERT_FALSE(places);
  EXPECT_EQ(places.error().message, "interrupted");
}

TEST(Ripple, IsTheRangeOverTheMean) {
  EXPECT_DOUBLE_EQ(rippleOf(std::vector<double>{1.0, 2.0, 3.0}), 1.0);
  EXPECT_EQ(rippleOf(std::vector<double>{5.0, 5.0}), 0.0);
  EXPECT_EQ(rippleOf({}), 0.0);
}

}  // namespace
}  // namespace teren
