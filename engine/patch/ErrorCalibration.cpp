#include "patch/ErrorCalibration.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "teren/Hash.h"

#include "patch/NodeGap.h"

namespace teren {

namespace {

/// Room for the maps that the finer nodes of one sample share; with less they would be made twice.
constexpr std::size_t kMapBytes = std::size_t{2} << 20;

/// The largest of m values that scatter as Gumbel's law says lies sqrt(6) / pi ln m deviations higher.
double largestOf(int down, double spread) {
  constexpr double kPerDoubling = 0.7796968012336761 * 0.6931471805599453;
  return 1.0 + spread * kPerDoubling * (2 * down);
}

/// A straight line through points, none of its numbers negative.
struct Line {
  double at0 = 0.0, slope = 0.0;
  double at(double x) const noexcept { return at0 + slope * x; }
};

/// error ~ line(bend), with the least sum of squared relative errors.
struct RelativeFit {
  double u = 0.0, v = 0.0, uu = 0.0, uv = 0.0, vv = 0.0;

  void add(double bend, double error) noexcept {
    const double one = 1.0 / error, x = bend / error;
    u += one;
    v += x;
    uu += one * one;
    uv += one * x;
    vv += x * x;
  }
  Line line() const noexcept {
    const double determinant = uu * vv - uv * uv;
    const Line flat{u / uu, 0.0};
    if (!(determinant > 1e-9 * uu * vv)) return flat;
    const Line both{(u * vv - v * uv) / determinant, (v * uu - u * uv) / determinant};
    if (both.slope <= 0.0) return flat;
    return both.at0 >= 0.0 ? both : Line{0.0, v / vv};
  }
};

struct Moments {
  double mean = 0.0, deviation = 0.0;
};

template <class Value>
Moments momentsOf(int count, const Value& value) {
  Moments moments;
  for (int k = 0; k < count; ++k) moments.mean += value(k) / count;
  double squares = 0.0;
  for (int k = 0; k < count; ++k) squares += (value(k) - moments.mean) * (value(k) - moments.mean);
  moments.deviation = std::sqrt(squares / (count - 1));
  return moments;
}

}  // namespace

ErrorCalibration::ErrorCalibration(const World& world)
    : world_(world), errors_(world.nodeErrors()), maps_(kMapBytes), level_(errors_.nextToCalibrate()) {
  samples_.reserve(kSamples);
}

std::size_t ErrorCalibration::mostBytes(const World& world) noexcept {
  std::size_t node = 0;
  for (int level = 0; level <= world.topLevel(); ++level) {
    node = std::max(node, NodeTask::mostBytes(world, level));
  }
  return kMapBytes + 2 * node + sizeof(ErrorCalibration) + kSamples * sizeof(Sample);
}

NodeKey ErrorCalibration::sampleNode(int level, int sample) noexcept {
  // Inside the world at every level, and no farther from its middle than 2^20 nodes.
  const int bits = std::clamp(51 - level, 1, 20);
  const std::uint64_t mask = (std::uint64_t{1} << (bits + 1)) - 1;
  const std::uint64_t hash = hashWith(static_cast<std::uint64_t>(level), static_cast<std::uint64_t>(sample));
  const auto place = [&](std::uint64_t part) {
    return static_cast<std::int64_t>(part & mask) - (std::int64_t{1} << bits);
  };
  return {level, place(hash), place(hash >> 32)};
}

bool ErrorCalibration::step(const Slice& slice) {
  while (level_ <= world_.topLevel()) {
    if (!stepNode(slice)) return false;
    if (static_cast<int>(samples_.size()) == kSamples && part_ < 0) finishLevel();
    if (slice.over()) break;
  }
  return level_ > world_.topLevel();
}

bool ErrorCalibration::stepNode(const Slice& slice) {
  if (!task_) beginNode();
  if (!task_->step(slice)) return false;
  if (part_ < 0) {
    coarse_ = task_->takeHeights();
    samples_.push_back({largestBend(std::as_const(coarse_).view()), 0.0, 0.0});
  } else {
    compare(task_->heights());
  }
  task_.reset();
  if (++part_ == 1 << (2 * down_)) part_ = -1;
  return true;
}

void ErrorCalibration::beginNode() {
  if (part_ < 0) {
    down_ = std::min(level_, kDepth);
    finerErrors_ = errors_.calibration(level_ - down_);
    task_ = std::make_unique<NodeTask>(world_, sampleNode(level_, static_cast<int>(samples_.size())), maps_);
    return;
  }
  const NodeKey node = sampleNode(level_, static_cast<int>(samples_.size()) - 1);
  const std::int64_t across = std::int64_t{1} << down_;
  const NodeKey finer{level_ - down_, node.i * across + (part_ & (across - 1)),
                      node.j * across + (part_ >> down_)};
  task_ = std::make_unique<NodeTask>(world_, finer, maps_);
}

void ErrorCalibration::compare(const HeightMap& finer) {
  const int across = 1 << down_;
  const NodePart part{down_, part_ & (across - 1), part_ >> down_};
  Sample& sample = samples_.back();
  sample.gap = std::max(sample.gap, largestGap(std::as_const(coarse_).view(), finer.view(), part));
  const double expected = finerErrors_.expected + finerErrors_.perBend * largestBend(finer.view());
  sample.rest = std::max(sample.rest, expected * largestOf(down_, finerErrors_.spread));
}

void ErrorCalibration::finishLevel() {
  const auto error = [this](int k) {
    const Sample& sample = samples_[static_cast<std::size_t>(k)];
    return std::sqrt(sample.gap * sample.gap + sample.rest * sample.rest);
  };
  LevelErrors found;
  const Moments errors = momentsOf(kSamples, error);
  if (errors.mean > 0.0) {
    RelativeFit fit;
    const double least = errors.mean / 8.0;  // next to nothing is not to outweigh all the rest
    for (int k = 0; k < kSamples; ++k) {
      fit.add(samples_[static_cast<std::size_t>(k)].bend, std::max(error(k), least));
    }
    const Line line = fit.line();
    const auto ratio = [&](int k) {
      return error(k) / std::max(line.at(samples_[static_cast<std::size_t>(k)].bend), least);
    };
    const Moments ratios = momentsOf(kSamples, ratio);
    const Moments rests = momentsOf(kSamples, [&](int k) {
      // A flat node has no error of which a part could be inherited.
      const double share = error(k) > 0.0 ? samples_[static_cast<std::size_t>(k)].rest / error(k) : 0.0;
      return share * share;
    });
    // The finer nodes' largest errors scatter too, in proportion to their part.
    const double inherited = finerErrors_.spread * rests.mean;
    found.expected = ratios.mean * line.at0;
    found.perBend = ratios.mean * line.slope;
    found.spread =
        std::sqrt(ratios.deviation * ratios.deviation / (ratios.mean * ratios.mean) + inherited * inherited);
    found.mean = errors.mean;
    found.deviation =
        std::sqrt(errors.deviation * errors.deviation + inherited * inherited * errors.mean * errors.mean);
  }
  errors_.setCalibration(level_, found);
  samples_.clear();
  ++level_;
}

}  // namespace teren
