#include "apps/report/GeneratorTable.h"

#include <cmath>
#include <memory>
#include <string>

#include "apps/check/MapComparison.h"
#include "apps/check/MapMaker.h"
#include "apps/report/MapRoughness.h"
#include "apps/report/Statistics.h"
#include "apps/report/Stopwatch.h"

namespace teren {
namespace {

constexpr int kSamples = 65;

void make(const Generator& generator, const MapRequest& request, HeightMap& map) {
  const std::unique_ptr<GenerationTask> task = generator.begin(request, map.view());
  while (!task->step(Slice::unlimited())) {
  }
}

HeightMap made(const Generator& generator, int number, int level) {
  const MapRequest request = check::requestOf(number, kSamples, level);
  HeightMap map(request.samples, request.samples);
  make(generator, request, map);
  return map;
}

/// [ns] a sample; each repetition makes other maps.
std::vector<double> timesOf(const Generator& generator, int level, std::size_t repetitions) {
  int number = 0;
  const MapRequest first = check::requestOf(0, kSamples, level);
  HeightMap map(first.samples, first.samples);
  const auto work = [&] { make(generator, check::requestOf(number++, kSamples, level), map); };
  const std::size_t rounds = roundsOf(work);
  const double samples = static_cast<double>(first.samples) * first.samples * static_cast<double>(rounds);
  std::vector<double> times;
  for (std::size_t k = 0; k < repetitions; ++k) {
    const double seconds = processorSecondsOf([&] {
      for (std::size_t round = 0; round < rounds; ++round) work();
    });
    times.push_back(1e9 * seconds / samples);
  }
  return times;
}

std::vector<Column> columns() {
  return {
      {"generator", "", "with default parameters; maps of 65 samples a side at level 0, pitch 64 m"},
      {"level", "", "0 is the finest"},
      {"samples a side", "", "of the level's map"},
      {"time median", "ns", "processor time a sample of the level's map"},
      {"time p99", "ns", "the same"},
      {"time spread", "", "interquartile range over median of the same"},
      {"map", "us", "processor time of a whole map of the level, median"},
      {"residual promised", "m", "Generator::residual"},
      {"residual true", "m",
       "root mean square over all maps of the finest map minus the triangles through the level's samples"},
      {"residual median", "m", "the same of single maps"},
      {"residual p99", "m", "the same"},
      {"residual spread", "", "interquartile range over median of the same"},
      {"promised / true", "", "nothing where both are 0; within 1.5 either way is promised up to level 3"},
      {"roughness error", "%", "root mean square slope of the level's triangles against that of level 0"},
      {"maps", "", "that the residual and the roughness are taken over"},
      {"repetitions", "", "of the timing"}};
}

void addRow(Table& table, const std::string& id, int level, double finestSlope, const LevelResidual& residual,
            const std::vector<double>& times) {
  const Summary time = summaryOf(times), ofMaps = summaryOf(residual.ofMaps);
  const double side = check::requestOf(0, kSamples, level).samples;
  const double truth = rootMeanSquare(residual.ofMaps);
  const double roughness = finestSlope > 0.0 ? 100.0 * (residual.slope / finestSlope - 1.0) : 0.0;
  Cell ratio;
  if (truth > 0.0) ratio.emplace<double>(residual.promised / truth);
  table.add({id, static_cast<double>(level), side, time.median, time.p99, time.spread,
             time.median * side * side / 1e3, residual.promised, truth, ofMaps.median, ofMaps.p99,
             ofMaps.spread, ratio, roughness, static_cast<double>(ofMaps.count),
             static_cast<double>(time.count)});
}

}  // namespace

Result<LevelResidual> residualOf(const Generator& generator, int level, int maps, const GoOn& goOn) {
  LevelResidual residual;
  const double finestSpacing = check::requestOf(0, kSamples).spacing;
  residual.promised = generator.residual(level, kSamples, finestSpacing);
  double slopes = 0.0;
  for (int number = 0; number < maps; ++number) {
    if (!goOn()) return Error{"interrupted"};
    const HeightMap finest = made(generator, number, 0);
    const HeightMap coarse = made(generator, number, level);
    residual.ofMaps.push_back(std::sqrt(check::squaredError(finest, coarse, level)));
    const double slope = slopeOfTriangles(coarse.view(), check::requestOf(0, kSamples, level).spacing);
    slopes += slope * slope;
  }
  if (maps > 0) residual.slope = std::sqrt(slopes / maps);
  return residual;
}

Result<Table> measureGenerators(const PluginRegistry& registry, const Effort& effort, const GoOn& goOn) {
  Table table(
      "generators", "Generators",
      "What a sample costs at each level, and how far the triangles through a coarse map's samples are "
      "from the finest map: as its plugin promises, and as it is.",
      columns());
  for (const PluginInfo& plugin : registry.plugins()) {
    if (plugin.kind != PluginKind::generator) continue;
    const Result<std::shared_ptr<const Generator>> generator = registry.makeGenerator(plugin.id, {});
    if (!generator) return generator.error();
    double finestSlope = 0.0;
    for (int level = 0; level < kResidualLevels; ++level) {
      const Result<LevelResidual> residual = residualOf(**generator, level, effort.residualMaps, goOn);
      if (!residual) return residual.error();
      if (level == 0) finestSlope = residual->slope;
      addRow(table, plugin.id, level, finestSlope, *residual,
             timesOf(**generator, level, effort.repetitions));
    }
  }
  return table;
}

std::vector<Plot> plotsOfGenerators(const Table& table) {
  Plot time{"generators-time",
            "Generators: what a map costs",
            "level",
            "processor time of a map [us]",
            false,
            true};
  Plot residual{"generators-residual",
                "Generators: residual, true and promised (dashed)",
                "level",
                "residual [m]",
                false,
                true};
  for (std::size_t row = 0; row < table.rows().size(); ++row) {
    const std::string id = table.text(row, "generator");
    const double level = table.number(row, "level");
    if (time.curves.empty() || time.curves.back().title != id) {
      time.curves.push_back({id, {}});
      residual.curves.push_back({id, {}});
      residual.curves.push_back({id + ", promised", {}, true});
    }
    time.curves.back().points.emplace_back(level, table.number(row, "map"));
    residual.curves[residual.curves.size() - 2].points.emplace_back(level,
                                                                    table.number(row, "residual true"));
    residual.curves.back().points.emplace_back(level, table.number(row, "residual promised"));
  }
  return {time, residual};
}

}  // namespace teren
