// Deformers for the tests of edited ground: one that settles slowly and in ways that depend on everything it
// may depend on, and some that break their promises.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "teren/EditedGround.h"
#include "teren/Hash.h"
#include "teren/HeightMapOperations.h"

namespace teren {

/// How a test deformer misbehaves.
enum class Fault {
  none,
  refuses,
  throwsAtStep,
  notFinite,
  touchesCollar,
  neverRests,
  neverSteps,
  beginsNothing,
  overshoots,
  doesNotGrow,  // no fault: another one begins
  restores,     // no fault, but what is pressed downwards brings the first ground back, exactly
  creeps,       // no fault: each bowl spreads once, kCreep radii westwards
  neverSpreads,
  spreadsNowhere
};

class BowlGround final : public DeformedGround {
 public:
  BowlGround(HeightMap heights, const SampleRectangle& changed)
      : heights_(std::move(heights)), changed_(changed) {}
  double height(double, double) const override { return 0.0; }
  void samples(const SampleRectangle& part, HeightView out) const override {
    copyHeights(heights_.view().part(part.column, part.row, part.columns, part.rows), out);
  }
  SampleRectangle changed() const override { return changed_; }

 private:
  HeightMap heights_;
  SampleRectangle changed_;
};

/// Digs a bowl with a rough bottom, which then smooths itself: in each logical step, every bowl that is not
/// yet at rest (after kSteps) once, row by row, the oldest first. Bowls that overlap thus depend on their
/// order and on the steps between them.
class BowlSurface final : public LiveSurface {
 public:
  static constexpr int kSteps = 6;
  static constexpr double kCreep = 8.0;

  BowlSurface(const DeformRegion& region, ConstHeightView ground, Fault fault)
      : region_(region), spacing_(region.spacing), fault_(fault), heights_(ground.columns(), ground.rows()) {
    copyHeights(ground, heights_.view());
  }

  Result<void> apply(const Stamp& stamp) override {
    if (const Result<void> fits = checkPlace(region_, stamp, stamp.size); !fits) return fits;
    if (fault_ == Fault::refuses) return Error{"this bowl cannot be dug"};
    Bowl bowl{stamp.east, stamp.north, stamp.size, 0};
    if (fault_ == Fault::restores) return restore(bowl, stamp.depth);
    ++pressed_;
    RandomSequence random(stamp.seed);
    forEach(bowl, [&](int x, int y, double part) {
      const double rough = static_cast<double>(random.nextBits(10)) * 0x1p-10 * stamp.values.real("rough");
      heights_(x, y) =
          static_cast<float>(static_cast<double>(heights_(x, y)) - stamp.depth * (1.0 - part) - rough);
    });
    if (fault_ == Fault::notFinite) heights_(10, 10) = std::numeric_limits<float>::infinity();
    if (fault_ == Fault::touchesCollar) heights_(10, kCollarCells) += 1.0F;
    if (fault_ != Fault::none && fault_ != Fault::doesNotGrow && fault_ != Fault::creeps)
      touched_ = {0, 0, heights_.columns(), heights_.rows()};
    bowls_.push_back(bowl);
    if (fault_ == Fault::creeps)
      creeping_.push_back({bowl.east - kCreep * bowl.size, bowl.north, bowl.size, 0});
    return {};
  }

  SampleRectangle spreadsTo() const override {
    if (fault_ == Fault::neverSpreads) return {10, 10, 4, 4};
    if (fault_ == Fault::spreadsNowhere) return {1 << 30, 0, 4, 4};
    return creeping_.empty() ? SampleRectangle{} : around(creeping_.front());
  }
  void spread() override {
    if (creeping_.empty() || !region_.changeable().contains(around(creeping_.front()))) return;
    bowls_.push_back(creeping_.front());
    creeping_.erase(creeping_.begin());
    forEach(bowls_.back(),
            [&](int x, int y, double part) { heights_(x, y) -= 3.0F * static_cast<float>(1.0 - part); });
  }

  bool step(const Slice& slice, std::uint64_t upTo) override {
    if (fault_ == Fault::throwsAtStep) throw std::runtime_error("no sand left");
    if (fault_ == Fault::overshoots) upTo += 3;
    if (fault_ == Fault::neverSteps) return false;
    while (steps_ < upTo && !atRest()) {
      smoothNext();
      if (slice.over()) break;
    }
    return steps_ >= upTo || atRest();
  }
  std::uint64_t steps() const noexcept override { return steps_; }
  bool atRest() const noexcept override { return bowls_.empty() && fault_ != Fault::neverRests; }
  std::shared_ptr<const DeformedGround> snapshot() override {
    return std::make_shared<BowlGround>(heights_, touched_);
  }
  std::size_t bytes() const noexcept override { return heights_.bytes(); }
  /// As if every second bowl had less volume than its samples, and one in three more.
  double samplingError() const override { return 0.5 * (pressed_ % 2) - 0.25 * (pressed_ % 3); }
  Result<void> grow(const DeformRegion& region, ConstHeightView ground) override {
    if (fault_ != Fault::none && fault_ != Fault::creeps) return Error{"this bowl does not grow"};
    const SampleRectangle place = region.placeOf(region_);
    for (Bowl& bowl : creeping_) bowl = shifted(bowl, place);
    HeightMap larger(ground.columns(), ground.rows());
    copyHeights(ground, larger.view());
    copyHeights(heights_.view(), larger.view().part(place.column, place.row, place.columns, place.rows));
    heights_ = std::move(larger);
    touched_.column += place.column;
    touched_.row += place.row;
    region_ = region;
    return {};
  }
  Result<void> merge(const DeformRegion& region, ConstHeightView ground,
                     std::span<LiveSurface* const> others) override {
    if (Result<void> grown = grow(region, ground); !grown) return grown;
    for (const LiveSurface* one : others) {
      const auto& other = static_cast<const BowlSurface&>(*one);
      const SampleRectangle place = region.placeOf(other.region_);
      copyHeights(other.heights_.view(),
                  heights_.view().part(place.column, place.row, place.columns, place.rows));
      touched_ = {0, 0, heights_.columns(), heights_.rows()};
      for (const Bowl& bowl : other.creeping_) creeping_.push_back(shifted(bowl, place));
    }
    return {};
  }

 private:
  struct Bowl {
    double east, north, size;
    int done;
  };

  Bowl shifted(const Bowl& bowl, const SampleRectangle& place) const {
    return {bowl.east + place.column * spacing_, bowl.north + place.row * spacing_, bowl.size, bowl.done};
  }
  SampleRectangle around(const Bowl& bowl) const {
    const int west = static_cast<int>(std::floor((bowl.east - bowl.size) / spacing_));
    const int south = static_cast<int>(std::floor((bowl.north - bowl.size) / spacing_));
    const int side = static_cast<int>(2.0 * bowl.size / spacing_) + 3;
    return {west, south, side, side};
  }

  Result<void> restore(const Bowl& bowl, double depth) {
    if (first_.samples().empty()) first_ = HeightMap(heights_);
    forEach(bowl, [&](int x, int y, double) {
      heights_(x, y) = depth < 0.0 ? heights_(x, y) - static_cast<float>(depth) : first_(x, y);
    });
    return {};
  }

  template <class Visit>
  void forEach(const Bowl& bowl, const Visit& visit) {
    const auto from = [&](double middle) {
      return static_cast<int>(std::floor((middle - bowl.size) / spacing_));
    };
    const auto to = [&](double middle) {
      return static_cast<int>(std::floor((middle + bowl.size) / spacing_));
    };
    for (int y = from(bowl.north); y <= to(bowl.north); ++y) {
      for (int x = from(bowl.east); x <= to(bowl.east); ++x) {
        const double dx = x * spacing_ - bowl.east, dy = y * spacing_ - bowl.north;
        const double part = (dx * dx + dy * dy) / (bowl.size * bowl.size);
        if (part < 1.0) touch(x, y), visit(x, y, part);
      }
    }
  }
  void touch(int x, int y) {
    if (touched_.columns == 0) touched_ = {x, y, 1, 1};
    const int east = std::max(touched_.column + touched_.columns, x + 1);
    const int north = std::max(touched_.row + touched_.rows, y + 1);
    touched_.column = std::min(touched_.column, x);
    touched_.row = std::min(touched_.row, y);
    touched_.columns = east - touched_.column;
    touched_.rows = north - touched_.row;
  }
  /// One bowl, once; a logical step ends with the last one.
  void smoothNext() {
    if (bowl_ < bowls_.size()) {
      forEach(bowls_[bowl_], [&](int x, int y, double) {
        heights_(x, y) = 0.5F * heights_(x, y) + 0.125F * (heights_(x - 1, y) + heights_(x + 1, y) +
                                                           heights_(x, y - 1) + heights_(x, y + 1));
      });
      ++bowls_[bowl_].done;
    }
    if (++bowl_ < bowls_.size()) return;
    bowl_ = 0;
    ++steps_;
    std::erase_if(bowls_, [](const Bowl& bowl) { return bowl.done >= kSteps; });
  }

  DeformRegion region_;
  double spacing_;
  Fault fault_;
  HeightMap heights_, first_;
  SampleRectangle touched_{};
  std::vector<Bowl> bowls_, creeping_;
  std::size_t bowl_ = 0;
  int pressed_ = 0;
  std::uint64_t steps_ = 0;
};

class BowlDeformer final : public Deformer {
 public:
  static std::span<const Parameter> parameters() noexcept {
    static constexpr std::array table = {Parameter::real("rough", 0.25, 0.0, 10.0, "m", "of the bottom")};
    return table;
  }
  explicit BowlDeformer(Fault fault) : fault_(fault) {}
  Result<double> reach(const Stamp& stamp, double) const override { return stamp.size; }
  Result<std::unique_ptr<LiveSurface>> begin(const DeformRegion& region,
                                             ConstHeightView ground) const override {
    if (fault_ == Fault::beginsNothing) return std::unique_ptr<LiveSurface>();
    return std::unique_ptr<LiveSurface>(std::make_unique<BowlSurface>(region, ground, fault_));
  }

 private:
  Fault fault_;
};

/// "bowl" and "other-bowl" are good, and "creeps", which spreads, and "small", which does not grow; the rest
/// are named after their faults.
inline Result<DeformerKind> testDeformer(std::string_view id) {
  constexpr std::array<std::pair<std::string_view, Fault>, 15> kKinds = {
      {{"bowl", Fault::none},
       {"other-bowl", Fault::none},
       {"refuses", Fault::refuses},
       {"throws", Fault::throwsAtStep},
       {"not-finite", Fault::notFinite},
       {"collar", Fault::touchesCollar},
       {"never-rests", Fault::neverRests},
       {"never-steps", Fault::neverSteps},
       {"nothing", Fault::beginsNothing},
       {"overshoots", Fault::overshoots},
       {"small", Fault::doesNotGrow},
       {"restores", Fault::restores},
       {"creeps", Fault::creeps},
       {"never-spreads", Fault::neverSpreads},
       {"nowhere", Fault::spreadsNowhere}}};
  for (const auto& [name, fault] : kKinds) {
    if (id == name)
      return DeformerKind{std::make_shared<BowlDeformer>(fault), BowlDeformer::parameters(), "1"};
  }
  return Error{"there is no deformer \"" + std::string(id) + "\""};
}

}  // namespace teren
