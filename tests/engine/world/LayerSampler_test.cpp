#include "world/LayerSampler.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Hash.h"

#include "tests/engine/world/HashNoise.h"
#include "tests/engine/world/TestLayer.h"

namespace teren {
namespace {

std::uint64_t bits(double value) {
  return std::bit_cast<std::uint64_t>(value);
}
double uniform(RandomSequence& random) {
  return std::ldexp(static_cast<double>(random.nextBits(53)), -53);
}
int below(RandomSequence& random, int end) {
  return static_cast<int>(random.next() % static_cast<unsigned>(end));
}

LayerShape randomShape(RandomSequence& random) {
  LayerShape shape;
  shape.seed = random.next();
  shape.worldBits = 1 + below(random, 5);
  shape.pitchShift = below(random, 5);
  shape.layerBits = below(random, 6);  // 0: maps of 3 samples
  shape.kernel = below(random, 2) == 0 ? BlendKernel::linear : BlendKernel::smooth;
  shape.preserveVariance = below(random, 2) == 0;
  return shape;
}

testing::Message describe(const LayerShape& shape) {
  return testing::Message() << "seed " << shape.seed << ", worldBits " << shape.worldBits << ", pitchShift "
                            << shape.pitchShift << ", layerBits " << shape.layerBits << ", "
                            << (shape.kernel == BlendKernel::linear ? "linear" : "smooth")
                            << ", preserveVariance " << shape.preserveVariance;
}

/// The maps of a layer at one level, made once.
class Maps {
 public:
  Maps(const Layer& layer, int mapLevel) : layer_(layer), mapLevel_(mapLevel) {}
  CellMaps cell(std::int64_t i, std::int64_t j) {
    return {at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)};
  }
  BaseMap at(std::int64_t i, std::int64_t j) {
    BaseMap& map = made_[{i, j}];
    if (!map) map = makeMap(layer_, i, j, mapLevel_);
    return map;
  }

 private:
  const Layer& layer_;
  int mapLevel_;
  std::map<std::pair<std::int64_t, std::int64_t>, BaseMap> made_;
};

/// Where level-0 sample `sample` lies in its cell, as World::height counts.
double across(const Layer& layer, std::int64_t sample) {
  const std::int64_t cell = std::int64_t{1} << layer.cellBits();
  return static_cast<double>(sample & (cell - 1)) / static_cast<double>(cell);
}

TEST(LayerSampler, GivesEveryGridPointTheBitsOfThePointwiseFunction) {
  constexpr std::uint64_t kSeed = 51;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomSequence random(kSeed);
  const auto noise = std::make_shared<HashNoise>(100.0, 7.0);
  for (int trial = 0; trial < 150; ++trial) {
    const LayerShape shape = randomShape(random);
    const Layer layer = makeTestLayer(shape, noise);
    const int level = below(random, layer.cutLevel() + 1);
    SCOPED_TRACE(describe(shape) << ", level " << level);
    const int mapLevel = layer.mapLevel(level);
    Maps maps(layer, mapLevel);
    const std::int64_t step = std::int64_t{1} << level;
    const std::int64_t bias = trial % 3 == 0   ? 0
                              : trial % 3 == 1 ? -(std::int64_t{1} << 30)
                                               : std::int64_t{1} << 52;
    const std::int64_t west = (bias + below(random, 200)) * step, south = (bias - below(random, 200)) * step;
    const int across_ = 2 + below(random, 60), up = 2 + below(random, 40);
    const std::vector<CellRun> columns = cellRuns(layer, mapLevel, west, step, across_);
    const std::vector<CellRun> rows = cellRuns(layer, mapLevel, south, step, up);
    for (const CellRun& row : rows) {
      for (const CellRun& column : columns) {
        CellBlock block(layer, column, row, maps.cell(column.cell, row.cell));
        std::vector<int> order(static_cast<std::size_t>(row.count));
        std::iota(order.begin(), order.end(), 0);
        for (std::size_t k = order.size(); k > 1 && trial % 2 == 1; --k) {  // every other time out of order
          std::swap(order[k - 1], order[random.next() % k]);
        }
        for (const int y : order) {
          std::vector<double> sums(static_cast<std::size_t>(column.count), 0.0);
          block.addRow(y, sums);
          for (int x = 0; x < column.count; ++x) {
            const std::int64_t sampleX = west + (column.first + x) * step,
                               sampleY = south + (row.first + y) * step;
            const double point =
                layerHeight(layer, linePlace(layer, mapLevel, across(layer, sampleX)),
                            linePlace(layer, mapLevel, across(layer, sampleY)),
                            maps.cell(sampleX >> layer.cellBits(), sampleY >> layer.cellBits()));
            ASSERT_EQ(bits(sums[static_cast<std::size_t>(x)]), bits(point))
                << "sample " << sampleX << ", " << sampleY;
          }
        }
      }
    }
  }
}

TEST(LayerSampler, AddsToTheSumsItIsGiven) {
  const Layer layer = makeTestLayer({}, std::make_shared<HashNoise>(5.0, 1.0));
  const std::vector<CellRun> runs = cellRuns(layer, 0, 0, 1, 33);
  ASSERT_EQ(runs.size(), 1U);
  CellBlock block(layer, runs[0], runs[0], makeCellMaps(layer, 0, 0));
  std::vector<double> once(33, 0.0), twice(33, 1000.0);
  block.addRow(7, once);
  block.addRow(7, twice);
  for (std::size_t x = 0; x < 33; ++x) EXPECT_EQ(twice[x], 1000.0 + once[x]);
}

TEST(LayerSampler, SplitsLinesIntoRunsThatCoverEachLineOnce) {
  constexpr std::uint64_t kSeed = 52;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomSequence random(kSeed);
  for (int trial = 0; trial < 500; ++trial) {
    const LayerShape shape = randomShape(random);
    const Layer layer = makeTestLayer(shape, std::make_shared<HashNoise>(0.0, 1.0));
    const int level = below(random, layer.cutLevel() + 1);
    const std::int64_t step = std::int64_t{1} << level, first = (below(random, 400) - 200) * step;
    const int count = 1 + below(random, 100);
    SCOPED_TRACE(describe(shape) << ", level " << level << ", first " << first << ", count " << count);
    int next = 0;
    std::int64_t before = 0;
    for (const CellRun& run : cellRuns(layer, layer.mapLevel(level), first, step, count)) {
      ASSERT_EQ(run.first, next);
      ASSERT_EQ(run.places.size(), static_cast<std::size_t>(run.count));
      if (next > 0) {
        ASSERT_EQ(run.cell, before + 1);
      }
      for (int line = 0; line < run.count; ++line) {
        const std::int64_t sample = first + (run.first + line) * step;
        const bool last = run.first + line == count - 1;
        const std::int64_t cell = std::int64_t{1} << layer.cellBits();
        ASSERT_GE(sample, run.cell * cell);
        ASSERT_LE(sample, (run.cell + 1) * cell);
        // Only the very last line may lie on the far border of its cell.
        ASSERT_EQ(sample == (run.cell + 1) * cell, last && count > 1 && sample % cell == 0);
      }
      next += run.count;
      before = run.cell;
    }
    ASSERT_EQ(next, count);
  }
}

TEST(LayerSampler, GivesASharedBorderEqualBitsFromEitherCell) {
  constexpr std::uint64_t kSeed = 53;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomSequence random(kSeed);
  const auto noise = std::make_shared<HashNoise>(-40.0, 9.0);
  for (int trial = 0; trial < 200; ++trial) {
    const LayerShape shape = randomShape(random);
    SCOPED_TRACE(describe(shape));
    const Layer layer = makeTestLayer(shape, noise);
    const std::int64_t i = below(random, 100) - 50, j = (std::int64_t{1} << 40) + below(random, 100);
    Maps maps(layer, 0);
    for (int k = 0; k < 20; ++k) {
      const double t = k == 0 ? 0.0 : k == 1 ? 1.0 : uniform(random);
      const LinePlace along = linePlace(layer, 0, t), far = linePlace(layer, 0, 1.0),
                      near = linePlace(layer, 0, 0.0);
      ASSERT_EQ(bits(layerHeight(layer, far, along, maps.cell(i, j))),
                bits(layerHeight(layer, near, along, maps.cell(i + 1, j))));
      ASSERT_EQ(bits(layerHeight(layer, along, far, maps.cell(i, j))),
                bits(layerHeight(layer, along, near, maps.cell(i, j + 1))));
    }
  }
}

TEST(LayerSampler, IsTheMapsOwnSampleAtALatticePoint) {
  for (const bool preserve : {false, true}) {
    for (const BlendKernel kernel : {BlendKernel::linear, BlendKernel::smooth}) {
      const Layer layer = makeTestLayer({.layerBits = 3, .kernel = kernel, .preserveVariance = preserve},
                                        std::make_shared<HashNoise>(0.0, 9.0));
      const LinePlace at = linePlace(layer, 0, 0.0);
      EXPECT_EQ(layerHeight(layer, at, at, makeCellMaps(layer, 4, -4)), (*makeMap(layer, 4, -4))(8, 8));
    }
  }
}

/// Catmull-Rom along one axis, straight from Keys' formula, in long double; rims continued linearly.
long double referenceCubic(const std::function<long double(int)>& sample, int samples, long double s) {
  const int first = std::min(static_cast<int>(std::floor(s)), samples - 2);
  const long double f = s - first;
  const auto at = [&](int k) {
    if (k < 0) return 2.0L * sample(0) - sample(1);
    if (k > samples - 1) return 2.0L * sample(samples - 1) - sample(samples - 2);
    return sample(k);
  };
  const long double a = at(first - 1), b = at(first), c = at(first + 1), d = at(first + 2);
  return b + 0.5L * f * (c - a + f * (2 * a - 5 * b + 4 * c - d + f * (3 * (b - c) + d - a)));
}

/// Law 0 as DESIGN.md writes it, in long double.
long double referenceHeight(const Layer& layer, Maps& maps, std::int64_t i, std::int64_t j, long double t,
                            long double s) {
  const auto weight = [&](long double x) {
    return layer.kernel() == BlendKernel::linear ? x : x * x * x * (x * (x * 6 - 15) + 10);
  };
  const long double mean = layer.range().mean;
  long double sum = 0, squares = 0;
  for (int north = 0; north < 2; ++north) {
    for (int east = 0; east < 2; ++east) {
      const long double w = (east ? weight(t) : 1 - weight(t)) * (north ? weight(s) : 1 - weight(s));
      const BaseMap map = maps.at(i + east, j + north);
      const int samples = map->columns();
      const long double intervals = (samples - 1) / 2;
      const auto row = [&](int y) {
        return referenceCubic([&](int x) { return static_cast<long double>((*map)(x, y)); }, samples,
                              (east ? t : t + 1) * intervals);
      };
      sum += w * (referenceCubic(row, samples, (north ? s : s + 1) * intervals) - mean);
      squares += w * w;
    }
  }
  return mean + (layer.preserveVariance() ? sum / std::sqrt(squares) : sum);
}

TEST(LayerSampler, AgreesWithLawZeroInLongDouble) {
  constexpr std::uint64_t kSeed = 54;
  RecordProperty("seed", static_cast<int>(kSeed));
  RandomSequence random(kSeed);
  const auto noise = std::make_shared<HashNoise>(100.0, 7.0);
  for (int trial = 0; trial < 100; ++trial) {
    const LayerShape shape = randomShape(random);
    SCOPED_TRACE(describe(shape));
    const Layer layer = makeTestLayer(shape, noise);
    Maps maps(layer, 0);
    for (int k = 0; k < 50; ++k) {
      const double t = uniform(random), s = uniform(random);
      const double height =
          layerHeight(layer, linePlace(layer, 0, t), linePlace(layer, 0, s), maps.cell(3, -2));
      ASSERT_NEAR(height, static_cast<double>(referenceHeight(layer, maps, 3, -2, t, s)), 1e-11)
          << t << ", " << s;
    }
  }
}

}  // namespace
}  // namespace teren
