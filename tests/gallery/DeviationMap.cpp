// deviation-map ID [NAME=VALUE]...: how far the heights of a generator's maps deviate from its mean, place by
// place, over 1,000 seeds and in parts of the deviation it promises. doc/gallery/make plots it.
//
// Prints a line for each sample along a side: its place in pitches from the lattice point, -1 ... 1, and the
// deviation there in the middle row, in the southern rim and on the diagonal from the south-west. A generator
// that promises no deviation is answered with nothing. Ends with 2 and one sentence where the generator
// cannot be made.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "teren/Hash.h"
#include "teren/Parameter.h"
#include "teren/PluginRegistry.h"

namespace teren {
namespace {

constexpr int kSamples = 65, kSeeds = 1000;

/// What lies between the heights at one sample and the promised mean, over all seeds.
struct Spread {
  double square = 0.0, fourth = 0.0;  // means of its powers

  double deviation() const { return std::sqrt(square); }
  /// Of deviation(), to first order.
  double error() const {
    return square > 0.0 ? 0.5 * std::sqrt(std::fmax(fourth - square * square, 0.0) / kSeeds / square) : 0.0;
  }
};

std::vector<Spread> spreadOf(const Generator& generator) {
  std::vector<Spread> spread(std::size_t{kSamples} * kSamples);
  HeightMap map(kSamples, kSamples);
  const double mean = generator.range().mean;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const auto task = generator.begin({.seed = mixBits(seed), .samples = kSamples}, map.view());
    while (!task->step(Slice::unlimited())) continue;
    for (std::size_t n = 0; n < spread.size(); ++n) {
      const double away = static_cast<double>(map.samples()[n]) - mean, square = away * away;
      spread[n].square += square / kSeeds;
      spread[n].fourth += square * square / kSeeds;
    }
  }
  return spread;
}

void print(const Generator& generator) {
  const double promised = generator.range().deviation;
  if (!(promised > 0.0)) return;
  const std::vector<Spread> spread = spreadOf(generator);
  const auto at = [&](int column, int row) {
    return spread[static_cast<std::size_t>(row * kSamples + column)];
  };
  constexpr int kMiddle = kSamples / 2;
  for (int sample = 0; sample < kSamples; ++sample) {
    const Spread places[] = {at(sample, kMiddle), at(sample, 0), at(sample, sample)};
    std::printf("%g", static_cast<double>(sample - kMiddle) / kMiddle);
    for (const Spread& place : places) std::printf(" %.4f", place.deviation() / promised);
    for (const Spread& place : places) std::printf(" %.4f", place.error() / promised);
    std::printf("\n");
  }
}

Result<std::shared_ptr<const Generator>> make(const std::string& id, const std::vector<std::string>& texts) {
  const auto registry = PluginRegistry::standard();
  std::vector<Values::Entry> entries;
  const PluginInfo* plugin = registry->find(id);
  if (plugin == nullptr) return registry->makeGenerator(id, entries);
  for (const std::string& text : texts) {
    Result<Values::Entry> entry = parseAssignment(plugin->parameters, text);
    if (!entry) return entry.error();
    entries.push_back(std::move(entry).value());
  }
  return registry->makeGenerator(id, entries);
}

int run(const std::vector<std::string>& arguments) {
  const std::string id = arguments.empty() ? "" : arguments.front();
  const auto generator = make(id, {arguments.begin() + (arguments.empty() ? 0 : 1), arguments.end()});
  if (!generator) {
    std::fprintf(stderr, "deviation-map: %s\n", generator.error().message.c_str());
    return 2;
  }
  print(**generator);
  return 0;
}

}  // namespace
}  // namespace teren

int main(int argc, char** argv) {
  return teren::run({argv + 1, argv + argc});
}
