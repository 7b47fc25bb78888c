// One iteration of a dragged tool on meshes of 10^4, 10^5 and 10^6 vertices, in turns in one run: medians of
// CPU time in all and per part, their ratio, and bytes per vertex.
//   bench-sand [ITERATIONS [VERTICES]...]
// The tool is a disc of 12 corners whose radius is 6 times the mean distance of vertices, so that it covers
// about 110 of them in every mesh; it is as deep as half its radius, and stamps a third of its radius apart.
// All ground is loose. An iteration is one stamp, at most 20,000 steps of slides, the clean-up, and
// publishing; a second line says what publishing takes, and the bytes by which a snapshot differs from the
// last one, which go to the graphics card. The bound is latency: stars and queues of a few thousand faces,
// scattered over a large mesh.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <vector>

#include "generators/sand/LevelSand.h"
#include "generators/sand/SandPublisher.h"
#include "generators/sand/Sandbox.h"
#include "tests/bench/Timing.h"

namespace teren {
namespace {

constexpr std::uint64_t kSteps = 20'000;

/// What iterations cost [s], and how many vertices and triangles changed.
struct Samples {
  std::vector<double> all, stamp, slide, clean, publish, changed, uploaded;
};

double highest(const std::vector<double>& values) {
  return values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
}

class Drag {
 public:
  explicit Drag(int count)
      : count_(count),
        spacing_(1.0 / std::sqrt(count)),
        tool_(*ToolShape::disc(6.0 * spacing_, 3.0 * spacing_)),
        sandbox_(levelSand(count, 1.0, static_cast<std::size_t>(count - 4) / 64), settings(spacing_)),
        start_(static_cast<double>(sandbox_.surface().mesh().vertexCount())),
        bytesAtStart_(static_cast<double>(sandbox_.bytes())),
        published_(publisher_.publish(sandbox_)) {}

  void iterate() {
    const double x = 0.5 + 0.25 * std::cos(angle_), y = 0.5 + 0.25 * std::sin(angle_);
    const StampPlace place{x, y, 0.0, -std::sin(angle_), std::cos(angle_)};
    angle_ += 2.0 * spacing_ / 0.25;
    const double begin = processorSeconds();
    (void)*sandbox_.stamp(tool_, place);
    const double stamped = processorSeconds();
    sandbox_.slide(kSteps);
    const double slid = processorSeconds();
    sandbox_.clean();
    const double cleaned = processorSeconds();
    samples_.changed.push_back(static_cast<double>(sandbox_.changedVertices().ids().size() +
                                                   sandbox_.changedTriangles().ids().size()));
    const std::shared_ptr<const SandSnapshot> next = publisher_.publish(sandbox_);
    const double ended = processorSeconds();
    samples_.uploaded.push_back(static_cast<double>(bytesBetween(*published_, *next)));
    published_ = next;
    samples_.all.push_back(ended - begin);
    samples_.publish.push_back(ended - cleaned);
    samples_.stamp.push_back(stamped - begin);
    samples_.slide.push_back(slid - stamped);
    samples_.clean.push_back(cleaned - slid);
  }

  void print() const {
    const SandSurface& surface = sandbox_.surface();
    const double vertices = static_cast<double>(surface.mesh().vertexCount());
    std::printf(
        "%8d: iteration %.3f ms (largest %.2f), stamp %.3f, slide %.3f, clean-up %.3f; changed %.0f; "
        "bytes per vertex %.1f at first, %.1f after; vertices %+.0f; %s\n",
        count_, 1e3 * median(samples_.all), 1e3 * highest(samples_.all), 1e3 * median(samples_.stamp),
        1e3 * median(samples_.slide), 1e3 * median(samples_.clean), median(samples_.changed),
        bytesAtStart_ / start_, static_cast<double>(sandbox_.bytes()) / vertices, vertices - start_,
        sandbox_.slides().atRest() ? "at rest" : "still sliding");
    std::printf(
        "%8d: publishing %.3f ms (largest %.2f), %.0f kB uploaded (largest %.0f); snapshot %.1f bytes per "
        "vertex\n",
        count_, 1e3 * median(samples_.publish), 1e3 * highest(samples_.publish),
        1e-3 * median(samples_.uploaded), 1e-3 * highest(samples_.uploaded),
        static_cast<double>(published_->bytes()) / vertices);
  }
  double medianTime() const { return median(samples_.all); }
  double medianPublishing() const { return median(samples_.publish); }

 private:
  static SandSettings settings(double spacing) {
    SandSettings settings;
    settings.longestEdge = 4.0 * spacing;
    settings.flatness = 0.02 * spacing;
    settings.stamp.fit = 0.2 * spacing;
    return settings;
  }

  static std::size_t bytesBetween(const SandSnapshot& last, const SandSnapshot& next) {
    std::size_t bytes = 0;
    next.vertexPages().forEachDifference(last.vertexPages(),
                                         [&](std::size_t) { bytes += sizeof(SandVertexPage); });
    next.trianglePages().forEachDifference(last.trianglePages(),
                                           [&](std::size_t) { bytes += sizeof(SandTrianglePage::corners); });
    return bytes;
  }

  int count_;
  double spacing_;
  ToolShape tool_;
  Sandbox sandbox_;
  double start_;
  double bytesAtStart_;
  SandPublisher publisher_;
  std::shared_ptr<const SandSnapshot> published_;
  double angle_ = 0.0;
  Samples samples_;
};

}  // namespace
}  // namespace teren

int main(int argc, char** argv) {
  const int iterations = argc > 1 ? std::atoi(argv[1]) : 200;
  std::vector<int> counts{10'000, 100'000, 1'000'000};
  if (argc > 2) counts.clear();
  for (int k = 2; k < argc; ++k) counts.push_back(std::max(std::atoi(argv[k]), 100));
  std::vector<std::unique_ptr<teren::Drag>> drags;
  for (const int count : counts) drags.push_back(std::make_unique<teren::Drag>(count));
  for (int n = 0; n < iterations; ++n) {
    for (const auto& drag : drags) drag->iterate();
  }
  for (const auto& drag : drags) drag->print();
  if (drags.size() > 1) {
    std::printf("median at %d / median at %d = %.2f (wanted: below 2)\n", counts.back(), counts.front(),
                drags.back()->medianTime() / drags.front()->medianTime());
    std::printf("publishing at %d / at %d = %.2f\n", counts.back(), counts.front(),
                drags.back()->medianPublishing() / drags.front()->medianPublishing());
  }
}
