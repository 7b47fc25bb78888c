// A deformer for tests that counts what is asked of its surfaces.
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "tests/engine/edits/TestDeformers.h"

namespace teren {

/// Counts what is asked of the bowls behind it.
struct BowlCounts {
  std::atomic<int> begun = 0, grown = 0, applied = 0, snapshots = 0;
};

class CountedSurface final : public LiveSurface {
 public:
  CountedSurface(std::unique_ptr<LiveSurface> surface, BowlCounts& counts)
      : surface_(std::move(surface)), counts_(counts) {}
  Result<void> apply(const Stamp& stamp) override { return ++counts_.applied, surface_->apply(stamp); }
  bool step(const Slice& slice, std::uint64_t upTo) override { return surface_->step(slice, upTo); }
  std::uint64_t steps() const noexcept override { return surface_->steps(); }
  bool atRest() const noexcept override { return surface_->atRest(); }
  std::shared_ptr<const DeformedGround> snapshot() override {
    return ++counts_.snapshots, surface_->snapshot();
  }
  std::size_t bytes() const noexcept override { return surface_->bytes(); }
  double samplingError() const override { return surface_->samplingError(); }
  Result<void> grow(const DeformRegion& region, ConstHeightView ground) override {
    return ++counts_.grown, surface_->grow(region, ground);
  }

 private:
  std::unique_ptr<LiveSurface> surface_;
  BowlCounts& counts_;
};

class CountedDeformer final : public Deformer {
 public:
  explicit CountedDeformer(BowlCounts& counts) : counts_(counts) {}
  Result<double> reach(const Stamp& stamp, double spacing) const override {
    return bowls_.reach(stamp, spacing);
  }
  Result<std::unique_ptr<LiveSurface>> begin(const DeformRegion& region,
                                             ConstHeightView ground) const override {
    ++counts_.begun;
    auto surface = *bowls_.begin(region, ground);
    return std::unique_ptr<LiveSurface>(std::make_unique<CountedSurface>(std::move(surface), counts_));
  }

 private:
  BowlDeformer bowls_{Fault::none};
  BowlCounts& counts_;
};

inline DeformerSource countedBowls(BowlCounts& counts, const std::string& version = "1") {
  return [&counts, version](std::string_view) -> Result<DeformerKind> {
    return DeformerKind{std::make_shared<CountedDeformer>(counts), BowlDeformer::parameters(), version};
  };
}

}  // namespace teren
