#include "world/ErrorBound.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Hash.h"

#include "height/Surface.h"
#include "tests/engine/world/HashNoise.h"
#include "tests/engine/world/RandomDraws.h"
#include "tests/engine/world/TestLayer.h"
#include "tests/engine/world/TestWorld.h"

namespace teren {
namespace {

// ---- The bound of a whole world, by brute force ----

WorldDescription randomWorld(RandomSequence& random) {
  WorldDescription world;
  world.seed = random.next();
  world.samples = (2 << below(random, 5)) * 2 + 1;  // 5 ... 65
  const int count = 1 + below(random, 3);
  for (int k = 0; k < count; ++k) {
    LayerDescription layer;
    layer.generator = below(random, 2) == 0 ? "fault" : "hash-noise";
    layer.parameters = {{"deviation", std::ldexp(1.0, below(random, 9))}};
    layer.pitch = world.pitch * (1 << below(random, 6));
    layer.samples = (1 << (1 + below(random, 7))) + 1;  // 3 ... 129: coarser and finer than the grid
    layer.blend = below(random, 2) == 0 ? BlendKernel::linear : BlendKernel::smooth;
    layer.preserveVariance = below(random, 2) == 0;
    if (below(random, 3) == 0) layer.filters = {{"band", {}}};
    world.layers.push_back(layer);
  }
  return world;
}

struct Squares {
  std::vector<double> ratios;  ///< bound / true maximum, a square each
  int checked = 0;
};

/// Asks densely all over one grid square, its rims and both sides of its diagonal included.
void checkSquare(const World& world, const Position& southWest, RandomSequence& random, Squares& squares) {
  const double side = 1.0 / world.intervals();
  double worst = 0.0, bound = 0.0;
  constexpr int kSteps = 9;
  for (int y = 0; y <= kSteps; ++y) {
    for (int x = 0; x <= kSteps; ++x) {
      const auto along = [&](int step) {
        return std::clamp((step + uniform(random) - 0.5) / kSteps, 0.0, 1.0 - 0x1p-40);
      };
      Position at = southWest;
      at.u += along(x) * side;
      at.v += (x == y ? at.u - southWest.u : along(y) * side);
      const SurfacePoint point = world.query(at);
      worst = std::max(worst, std::fabs(point.height - point.drawn));
      bound = point.error;
      ASSERT_LE(std::fabs(point.height - point.drawn), point.error) << "u " << at.u << ", v " << at.v;
    }
  }
  ++squares.checked;
  if (worst > 1e-4) squares.ratios.push_back(bound / worst);
}

TEST(ErrorBound, HoldsAllOverRandomSquaresOfRandomWorldsAndIsNotFarFromTheTruth) {
  constexpr std::uint64_t kSeed = 61;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomSequence random(kSeed);
  Squares squares;
  for (int trial = 0; trial < 120; ++trial) {
    const WorldDescription description = randomWorld(random);
    SCOPED_TRACE(testing::Message() << "trial " << trial << ", world seed " << description.seed);
    const auto world = makeTestWorld(description);
    for (int square = 0; square < 4; ++square) {
      const std::int64_t bias = square == 3 ? std::int64_t{1} << 40 : 0;
      const int n = world->intervals();
      const Position at{bias + below(random, 100) - 50, below(random, 100) - 50 - bias,
                        below(random, n) / static_cast<double>(n), below(random, n) / static_cast<double>(n)};
      checkSquare(*world, at, random, squares);
      if (HasFatalFailure()) return;
    }
  }
  ASSERT_GE(squares.ratios.size(), 300U);
  std::sort(squares.ratios.begin(), squares.ratios.end());
  const double median = squares.ratios[squares.ratios.size() / 2];
  RecordProperty("median_bound_over_truth_percent", static_cast<int>(100.0 * median));
  RecordProperty("worst_bound_over_truth_percent", static_cast<int>(100.0 * squares.ratios.back()));
  EXPECT_LE(median, 20.0);
}

TEST(ErrorBound, IsTheSameAllOverASquare) {
  const auto world = makeTestWorld(WorldDescription::standard());
  const double bound = world->query({3, -2, 0.25, 0.5}).error;
  for (const double across : {1e-9, 0.3, 0.999}) {
    EXPECT_EQ(world->query({3, -2, 0.25 + across / 32.0, 0.5}).error, bound);
    EXPECT_EQ(world->query({3, -2, 0.25, 0.5 + across / 32.0}).error, bound);
  }
}

TEST(ErrorBound, IsZeroButForRoundingWhereTheGroundIsFlat) {
  WorldDescription flat;
  LayerDescription layer;
  layer.generator = "hash-noise";
  layer.parameters = {{"mean", 10.0}, {"deviation", 0.0}};
  flat.layers = {layer};
  EXPECT_LE(makeTestWorld(flat)->query({0, 0, 0.3, 0.7}).error, 2e-6);
}

// ---- Each term alone, where the truth is known ----

/// Maps that are a given function of the lattice point and the place [pitches] from it.
class FieldGenerator final : public Generator {
 public:
  using Field = std::function<double(std::int64_t i, std::int64_t j, double x, double y)>;
  explicit FieldGenerator(Field field) : field_(std::move(field)) {}
  HeightRange range() const override { return {0.0, 1.0, -1e6, 1e6}; }
  double residual(int, int, double) const override { return 0.0; }
  std::unique_ptr<GenerationTask> begin(const MapRequest& request, HeightView out) const override {
    for (int y = 0; y < out.rows(); ++y) {
      for (int x = 0; x < out.columns(); ++x) {
        const double half = (request.samples - 1) / 2;
        out(x, y) = static_cast<float>(field_(request.i, request.j, (x - half) / half, (y - half) / half));
      }
    }
    class Done final : public GenerationTask {
      bool step(const Slice&) override { return true; }
    };
    return std::make_unique<Done>();
  }

 private:
  Field field_;
};

/// Bound over true maximum for the square at (t, s) of the cell north-east of lattice point (0, 0).
double sharpness(const Layer& layer, double t, double s, double side) {
  const CellMaps maps = makeCellMaps(layer, 0, 0);
  const auto height = [&](double x, double y) {
    return layerHeight(layer, linePlace(layer, 0, t + x * side), linePlace(layer, 0, s + y * side), maps);
  };
  const SquareHeights corner{height(0, 0), height(1, 0), height(0, 1), height(1, 1)};
  double worst = 0.0;
  constexpr int kSteps = 64;
  for (int y = 0; y <= kSteps; ++y) {
    for (int x = 0; x <= kSteps; ++x) {
      const double u = x / static_cast<double>(kSteps), v = y / static_cast<double>(kSteps);
      worst = std::max(worst, std::fabs(height(u, v) - sampleTriangle(corner, u, v).height));
    }
  }
  const double bound = triangleError(layer, maps, t, s, side);
  EXPECT_LE(worst, bound * (1.0 + 1e-9));
  return bound / worst;
}

constexpr double kSide = 0x1p-11;
constexpr double kSteepest = 0.5;                    // of the smooth kernel
constexpr double kMostCurved = 0.21132486540518713;  // rounded down to the grid by `onGrid`
double onGrid(double t) {
  return std::floor(t / kSide) * kSide;
}

Layer fieldLayer(FieldGenerator::Field field, BlendKernel kernel, bool preserveVariance) {
  return makeTestLayer(
      {.pitchShift = 6, .layerBits = 5, .kernel = kernel, .preserveVariance = preserveVariance},
      std::make_shared<FieldGenerator>(std::move(field)));
}

TEST(ErrorBound, IsSharpForQuadraticGroundBesideALatticePoint) {
  // There one map has all the weight, and x^2, y^2 and xy err by exactly h^2 / 4 each.
  const auto same = [](auto f) {
    return [f](std::int64_t, std::int64_t, double x, double y) { return f(x, y); };
  };
  const auto ratio = [&](auto f) {
    return sharpness(fieldLayer(same(f), BlendKernel::smooth, false), 0.0, 0.0, kSide);
  };
  EXPECT_LE(ratio([](double x, double) { return x * x; }), 1.05);
  EXPECT_LE(ratio([](double, double y) { return y * y; }), 1.05);
  EXPECT_LE(ratio([](double x, double y) { return x * y; }), 1.05);
  EXPECT_LE(ratio([](double x, double y) { return (x + y) * (x + y); }), 1.05);
  EXPECT_LE(ratio([](double x, double y) { return (x - y) * (x - y); }), 4.05);  // signs are not used
}

TEST(ErrorBound, IsSharpWhereOnlyTheKernelBends) {
  // One map lies a metre high, its neighbours at the mean: the ground is the kernel itself.
  const auto one = [](std::int64_t i, std::int64_t j, double, double) {
    return i == 0 && j == 0 ? 1.0 : 0.0;
  };
  const Layer single = fieldLayer(one, BlendKernel::smooth, false);
  EXPECT_LE(sharpness(single, onGrid(kMostCurved), 0.0, kSide), 1.05);
  EXPECT_LE(sharpness(single, 0.0, onGrid(kMostCurved), kSide), 1.05);
  // At the cell's middle only the mixed derivative of the weights is left.
  EXPECT_LE(sharpness(single, kSteepest, kSteepest, kSide), 1.05);
  EXPECT_LE(sharpness(fieldLayer(one, BlendKernel::linear, false), 0.25, 0.25, kSide), 1.05);
  const auto eastern = [](std::int64_t i, std::int64_t, double, double) { return i == 1 ? 1.0 : 0.0; };
  EXPECT_LE(sharpness(fieldLayer(eastern, BlendKernel::smooth, true), onGrid(kMostCurved), 0.0, kSide), 1.6);
}

TEST(ErrorBound, IsSharpWhereTheKernelAndASlopeMultiply) {
  // x * u(x) * v(y) with the linear kernel: 2 u' x' and the mixed derivative.
  const auto slope = [](std::int64_t i, std::int64_t j, double x, double) {
    return i == 0 && j == 0 ? x : 0.0;
  };
  EXPECT_LE(sharpness(fieldLayer(slope, BlendKernel::linear, false), 0.25, 0.0, kSide), 1.4);
  const auto north = [](std::int64_t i, std::int64_t j, double, double y) {
    return i == 0 && j == 0 ? y : 0.0;
  };
  EXPECT_LE(sharpness(fieldLayer(north, BlendKernel::linear, false), 0.0, 0.25, kSide), 1.4);
}

TEST(ErrorBound, SeesEveryPieceOfAMapFinerThanTheGrid) {
  // A single spike between the corners of a large square, in each of the four quarters of it.
  for (int quarter = 0; quarter < 4; ++quarter) {
    const double x0 = (quarter & 1) == 0 ? 0.3125 : 0.4375, y0 = (quarter & 2) == 0 ? 0.3125 : 0.4375;
    const auto spike = [=](std::int64_t i, std::int64_t j, double x, double y) {
      return i == 0 && j == 0 && x == x0 && y == y0 ? 1.0 : 0.0;
    };
    const Layer layer = makeTestLayer({.worldBits = 2, .pitchShift = 0, .layerBits = 5},
                                      std::make_shared<FieldGenerator>(spike));
    EXPECT_LE(sharpness(layer, 0.25, 0.25, 0.25), 3.0) << "quarter " << quarter;
  }
}

TEST(ErrorBound, HoldsForSingleLayersOfEveryShape) {
  constexpr std::uint64_t kSeed = 62;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomSequence random(kSeed);
  const auto noise = std::make_shared<HashNoise>(50.0, 3.0);
  for (int trial = 0; trial < 150; ++trial) {
    const LayerShape shape{.seed = random.next(),
                           .worldBits = 1 + below(random, 5),
                           .pitchShift = below(random, 6),
                           .layerBits = below(random, 7),
                           .kernel = below(random, 2) == 0 ? BlendKernel::linear : BlendKernel::smooth,
                           .preserveVariance = below(random, 2) == 0};
    SCOPED_TRACE(testing::Message() << "trial " << trial);
    const Layer layer = makeTestLayer(shape, noise);
    const std::int64_t squares = std::int64_t{1} << layer.cellBits();
    const double side = 1.0 / static_cast<double>(squares);
    const auto any = [&] {
      return side * static_cast<double>(random.next() % static_cast<std::uint64_t>(squares));
    };
    sharpness(layer, any(), any(), side);
    sharpness(layer, 1.0 - side, any(), side);  // at the cell's far border
    sharpness(layer, 0.0, 1.0 - side, side);
  }
}

TEST(ErrorBound, HasConstantsThatBoundTheNormalisedWeight) {
  long double first = 0.0L, second = 0.0L;
  constexpr int kSteps = 1'000'000;
  for (int k = 0; k <= kSteps; ++k) {
    const long double w = static_cast<long double>(k) / kSteps, q = w * w + (1 - w) * (1 - w);
    const long double root = std::sqrt(q);
    first = std::max(first, std::fabs((1 - w) / (q * root)));
    second = std::max(second, std::fabs((3 * (1 - w) * (1 - 2 * w) - q) / (q * q * root)));
  }
  // The formulas above against difference quotients, at a few places.
  for (const long double w : {0.1L, 0.36L, 0.5L, 0.63L, 0.9L}) {
    const auto u = [](long double x) { return x / std::sqrt(x * x + (1 - x) * (1 - x)); };
    constexpr long double h = 1e-4L;
    const long double q = w * w + (1 - w) * (1 - w), root = std::sqrt(q);
    EXPECT_NEAR(static_cast<double>((u(w + h) - u(w - h)) / (2 * h)),
                static_cast<double>((1 - w) / (q * root)), 1e-6);
    EXPECT_NEAR(static_cast<double>((u(w + h) - 2 * u(w) + u(w - h)) / (h * h)),
                static_cast<double>((3 * (1 - w) * (1 - 2 * w) - q) / (q * q * root)), 1e-6);
  }
  EXPECT_LE(first, kNormalisedFirst);
  EXPECT_GE(first, 0.99 * kNormalisedFirst);
  EXPECT_LE(second, kNormalisedSecond);
  EXPECT_GE(second, 0.98 * kNormalisedSecond);
}

}  // namespace
}  // namespace teren
