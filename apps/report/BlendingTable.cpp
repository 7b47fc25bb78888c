#include "apps/report/BlendingTable.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "teren/Hash.h"
#include "teren/World.h"

#include "apps/report/Crease.h"
#include "apps/report/Statistics.h"
#include "apps/report/Stopwatch.h"

namespace teren {
namespace {

constexpr int kParts = 4;                       // places to a patch's half
constexpr int kRaster = 64, kTimedPatches = 2;  // samples a patch's side, patches a side
constexpr double kCreaseStep = 1.0 / 1024.0, kSlopeStep = 1.0 / 64.0;  // of the samples' distance

struct Subject {
  std::string generator;
  BlendKernel kernel;
  bool preserve;
  std::shared_ptr<const World> world;
  std::vector<double> times;  // [ns] a sample

  std::string kernelName() const { return kernel == BlendKernel::linear ? "linear" : "smooth"; }
  std::string name() const { return generator + " " + kernelName() + (preserve ? " preserved" : ""); }
  HeightsAt heights() const {
    return [world = world](std::span<const Position> places, std::span<double> heights) {
      world->heights(places, heights);
    };
  }
};

Result<std::vector<Subject>> subjectsOf(const PluginRegistry& registry,
                                        std::span<const char* const> generators) {
  std::vector<Subject> subjects;
  for (const char* generator : generators) {
    if (registry.find(generator) == nullptr) continue;
    for (const BlendKernel kernel : {BlendKernel::linear, BlendKernel::smooth}) {
      for (const bool preserve : {false, true}) {
        WorldDescription description;
        description.layers.resize(1);
        description.layers[0].generator = generator;
        description.layers[0].blend = kernel;
        description.layers[0].preserveVariance = preserve;
        Result<std::shared_ptr<const World>> world = World::create(description, registry);
        if (!world) return world.error();
        subjects.push_back({generator, kernel, preserve, *std::move(world), {}});
      }
    }
  }
  return subjects;
}

std::vector<Position> raster() {
  std::vector<Position> places;
  for (int row = 0; row < kRaster * kTimedPatches; ++row) {
    for (int column = 0; column < kRaster * kTimedPatches; ++column) {
      places.push_back({.i = column / kRaster,
                        .j = row / kRaster,
                        .u = (column % kRaster + 0.5) / kRaster,
                        .v = (row % kRaster + 0.5) / kRaster});
    }
  }
  return places;
}

/// The kernels in turn, so that what the machine does meanwhile is shared among them.
Result<void> timeAll(std::vector<Subject>& subjects, std::size_t repetitions, const GoOn& goOn) {
  const std::vector<Position> places = raster();
  std::vector<double> heights(places.size());
  for (const Subject& subject : subjects) subject.world->heights(places, heights);  // makes the maps
  for (std::size_t k = 0; k < repetitions; ++k) {
    for (Subject& subject : subjects) {
      if (!goOn()) return Error{"interrupted"};
      const double seconds = processorSecondsOf([&] { subject.world->heights(places, heights); });
      subject.times.push_back(1e9 * seconds / static_cast<double>(places.size()));
    }
  }
  return {};
}

/// Angles at random places on the lattice lines of a square of patches, and, if `inside`, in the patches'
/// middle.
Result<std::vector<double>> creasesOf(const Subject& subject, const Effort& effort, bool inside,
                                      const GoOn& goOn) {
  const double step = kCreaseStep * subject.world->spacing(0);
  RandomSequence random(7);
  std::vector<double> angles;
  for (int row = 0; row < effort.blendingPatches; ++row) {
    if (!goOn()) return Error{"interrupted"};
    for (const Across across : {Across::east, Across::north}) {
      std::vector<Position> places;
      for (int place = 0; place < effort.blendingPatches * effort.creasePlaces; ++place) {
        const double along = static_cast<double>(random.nextBits(32)) * 0x1p-32, at = inside ? 0.5 : 0.0;
        places.push_back({.i = place / effort.creasePlaces,
                          .j = row,
                          .u = across == Across::east ? at : along,
                          .v = across == Across::east ? along : at});
      }
      const std::vector<double> some =
          creaseAngles(subject.heights(), places, across, step, subject.world->pitch());
      angles.insert(angles.end(), some.begin(), some.end());
    }
  }
  return angles;
}

std::vector<Column> columns() {
  return {
      {"generator", "", "of the world's only layer; pitch 64 m, 65 samples, default parameters"},
      {"kernel", "", "BlendKernel"},
      {"preserve variance", "", "whether the deviation from the mean is divided by sqrt(sum w^2)"},
      {"time median", "ns",
       "processor time a sample of World::heights, maps kept: interpolation and blending"},
      {"time p99", "ns", "the same"},
      {"time spread", "", "interquartile range over median of the same"},
      {"crease median", "degree", "angle between the land on both sides of a lattice line, at random places"},
      {"crease p99", "degree", "the same"},
      {"crease max", "degree", "the same"},
      {"inside p99", "degree",
       "the same along the samples' line through the patches' middle: the measure's zero"},
      {"ripple of deviation", "%",
       "(largest - smallest) / mean of the standard deviation over the places of a patch"},
      {"ripple of slope", "%", "the same of the root mean square slope"},
      {"patches", "", "that deviation and slope are taken over"},
      {"crease places", "", "that the angles are taken at"},
      {"repetitions", "", "of the timing"}};
}

Result<void> addRows(const Subject& subject, const Effort& effort, BlendingFigures& figures,
                     const GoOn& goOn) {
  const Result<std::vector<double>> creases = creasesOf(subject, effort, false, goOn);
  if (!creases) return creases.error();
  const Result<std::vector<double>> inside = creasesOf(subject, effort, true, goOn);
  if (!inside) return inside.error();
  const World& world = *subject.world;
  const Result<std::vector<PlaceVariation>> places =
      variationAcross(subject.heights(), world.mean(), effort.blendingPatches, kParts,
                      kSlopeStep * world.spacing(0), world.pitch(), goOn);
  if (!places) return places.error();
  std::vector<double> deviations, slopes;
  for (const PlaceVariation& place : *places) {
    deviations.push_back(place.deviation);
    slopes.push_back(place.slope);
    figures.places.add({subject.name(), place.across, place.along, place.deviation, place.slope});
  }
  const Summary time = summaryOf(subject.times), crease = summaryOf(*creases);
  figures.table.add({subject.generator, subject.kernelName(), std::string(subject.preserve ? "yes" : "no"),
                     time.median, time.p99, time.spread, crease.median, crease.p99, crease.max,
                     quantile(*inside, 0.99), 100.0 * rippleOf(deviations), 100.0 * rippleOf(slopes),
                     static_cast<double>(effort.blendingPatches) * effort.blendingPatches,
                     static_cast<double>(crease.count), static_cast<double>(time.count)});
  return {};
}

}  // namespace

Result<BlendingFigures> measureBlending(const PluginRegistry& registry,
                                        std::span<const char* const> generators, const Effort& effort,
                                        const GoOn& goOn) {
  Result<std::vector<Subject>> subjects = subjectsOf(registry, generators);
  if (!subjects) return subjects.error();
  if (const Result<void> timed = timeAll(*subjects, effort.repetitions, goOn); !timed) return timed.error();
  BlendingFigures figures{
      Table(
          "blending", "Blending kernels",
          "What it costs to blend the four base maps that meet in a patch, and what the kernel leaves to be "
          "seen: creases along the lattice lines, and land that varies more at one place of a patch than at "
          "another.",
          columns()),
      Table("blending-places", "Variation across a patch",
            "Standard deviation and slope at places of a patch, mirrored ones taken together.",
            {{"world", "", "generator, kernel, and whether variance is preserved"},
             {"across", "patches", "distance from the nearer lattice line of one axis"},
             {"along", "patches", "of the other; at most as far"},
             {"deviation", "m", "root mean square of height - mean over the patches"},
             {"slope", "", "root mean square of the gradient over the patches"}})};
  for (const Subject& subject : *subjects) {
    if (const Result<void> done = addRows(subject, effort, figures, goOn); !done) return done.error();
  }
  return figures;
}

std::vector<Plot> plotsOfBlending(const BlendingFigures& figures) {
  Plot deviation{"blending-deviation", "Standard deviation from a patch's corner to its middle",
                 "distance from both lattice lines [patches]", "of that at the corner"};
  Plot slope{"blending-slope", "Slope from a patch's corner to its middle",
             "distance from both lattice lines [patches]", "of that at the corner"};
  double cornerDeviation = 0.0, cornerSlope = 0.0;
  for (std::size_t row = 0; row < figures.places.rows().size(); ++row) {
    const std::string world = figures.places.text(row, "world");
    const double across = figures.places.number(row, "across"), along = figures.places.number(row, "along");
    if (across != along) continue;
    if (deviation.curves.empty() || deviation.curves.back().title != world) {
      deviation.curves.push_back({world, {}});
      slope.curves.push_back({world, {}});
      cornerDeviation = figures.places.number(row, "deviation");
      cornerSlope = figures.places.number(row, "slope");
    }
    if (cornerDeviation == 0.0 || cornerSlope == 0.0) continue;
    deviation.curves.back().points.emplace_back(across,
                                                figures.places.number(row, "deviation") / cornerDeviation);
    slope.curves.back().points.emplace_back(across, figures.places.number(row, "slope") / cornerSlope);
  }
  return {deviation, slope};
}

}  // namespace teren
