// What the deformers of the checker's tests have in common: one that keeps its contract. Each broken one then
// breaks one property of it.
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "teren/DeformGrid.h"
#include "teren/Hash.h"
#include "teren/Plugin.h"

namespace sound {

/// Lowers the ground under a round tool: by half of the depth at once, by an eighth in each of four steps.
class Pressing : public teren::LiveSurface {
 public:
  Pressing(const teren::DeformRegion& region, teren::ConstHeightView ground) : grid_(region, ground) {}

  static teren::Result<double> reachOf(const teren::Stamp& stamp) {
    if (!(stamp.size > 0.0 && stamp.size <= 1000.0)) return teren::Error{"its size is not 0 to 1000 m"};
    if (!(std::fabs(stamp.depth) <= 1000.0)) return teren::Error{"its depth is not within 1000 m"};
    return stamp.size;
  }

  teren::Result<void> apply(const teren::Stamp& stamp) override {
    const teren::Result<double> reach = reachOf(stamp);
    if (!reach) return reach.error();
    if (teren::Result<void> place = teren::checkPlace(grid_.region(), stamp, *reach); !place) return place;
    press(stamp);
    return {};
  }
  bool step(const teren::Slice& slice, std::uint64_t upTo) override {
    while (!atRest() && steps_ < upTo) {
      work();
      if (slice.over()) break;
    }
    return atRest() || steps_ >= upTo;
  }
  std::uint64_t steps() const noexcept override { return steps_; }
  bool atRest() const noexcept override { return settling_.empty(); }
  std::shared_ptr<const teren::DeformedGround> snapshot() override { return grid_.snapshot(); }
  std::size_t bytes() const noexcept override {
    return sizeof(*this) - sizeof(grid_) + grid_.bytes() + settling_.capacity() * sizeof(Settling);
  }

 protected:
  void press(const teren::Stamp& stamp) {
    while (isWithinStep()) work();
    for (int row = 0; row < grid_.region().sampleRows(); ++row) lower(stamp, row, 0.5);
    settling_.push_back({stamp, 4});
  }
  bool isWithinStep() const { return current_ > 0 || row_ > 0; }

  teren::DeformGrid grid_;

 private:
  struct Settling {
    teren::Stamp stamp;
    int steps;
  };

  void lower(const teren::Stamp& stamp, int row, double part) {
    const double spacing = grid_.region().spacing;
    const teren::SampleRectangle changeable = grid_.region().changeable();
    for (int column = 0; column < grid_.region().sampleColumns(); ++column) {
      const double east = column * spacing - stamp.east, north = row * spacing - stamp.north;
      if (std::sqrt(east * east + north * north) >= stamp.size || !changeable.contains(column, row)) continue;
      const std::uint64_t hash =
          teren::hashWith(stamp.seed, static_cast<std::uint64_t>(column * 10000 + row));
      const double change =
          part * stamp.depth * stamp.values.real("strength") * (1.0 + 0x1p-67 * static_cast<double>(hash));
      grid_.set(column, row, grid_(column, row) - change);
    }
  }

  /// One row of one stamp of the current step.
  void work() {
    lower(settling_[current_].stamp, row_, 0.125);
    if (++row_ < grid_.region().sampleRows()) return;
    row_ = 0;
    --settling_[current_].steps;
    if (++current_ < settling_.size()) return;
    current_ = 0;
    ++steps_;
    std::erase_if(settling_, [](const Settling& settling) { return settling.steps == 0; });
  }

  std::vector<Settling> settling_;
  std::size_t current_ = 0;
  int row_ = 0;
  std::uint64_t steps_ = 0;
};

template <class Surface>
class Press : public teren::Deformer {
 public:
  static std::span<const teren::Parameter> parameters() noexcept {
    static constexpr teren::Parameter table[] = {
        teren::Parameter::real("strength", 1.0, 0.5, 2.0, "", "What the depth is multiplied with")};
    return table;
  }
  teren::Result<double> reach(const teren::Stamp& stamp, double) const override {
    return Surface::reachOf(stamp);
  }
  teren::Result<std::unique_ptr<teren::LiveSurface>> begin(const teren::DeformRegion& region,
                                                           teren::ConstHeightView ground) const override {
    return std::unique_ptr<teren::LiveSurface>(std::make_unique<Surface>(region, ground));
  }
};

/// A snapshot that another one is behind.
class Behind : public teren::DeformedGround {
 public:
  explicit Behind(std::shared_ptr<const teren::DeformedGround> ground) : ground_(std::move(ground)) {}
  double height(double east, double north) const override { return ground_->height(east, north); }
  void samples(const teren::SampleRectangle& rectangle, teren::HeightView out) const override {
    ground_->samples(rectangle, out);
  }
  teren::SampleRectangle changed() const override { return ground_->changed(); }

 protected:
  std::shared_ptr<const teren::DeformedGround> ground_;
};

/// Whose snapshots are Ground, each with a sound one behind.
template <class Ground>
class Showing : public Pressing {
 public:
  using Pressing::Pressing;
  std::shared_ptr<const teren::DeformedGround> snapshot() override {
    return std::make_shared<Ground>(Pressing::snapshot());
  }
};

}  // namespace sound

#define SOUND_DEFORMER(Surface, id)            \
  using SoundDeformer = sound::Press<Surface>; \
  TEREN_DEFORMER_PLUGIN(SoundDeformer, id, "1.0", "A deformer of the checker's tests")
