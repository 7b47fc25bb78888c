#include <vector>

#include "apps/check/Counterexample.h"
#include "apps/check/MapComparison.h"
#include "apps/check/MapMaker.h"
#include "apps/check/Properties.h"
#include "apps/check/Subject.h"

namespace teren::check {
namespace {

constexpr int kMaps = 8;

/// Requests that differ in one thing only, so that a plugin that forgets to look at it is caught.
std::vector<std::vector<MapRequest>> series(int samples) {
  std::vector<std::vector<MapRequest>> all(4, std::vector<MapRequest>(kMaps, requestOf(0, samples)));
  for (int n = 0; n < kMaps; ++n) {
    all[0][n] = requestOf(n, samples);
    all[1][n].i += n;
    all[2][n].j += n;
    all[3][n].seed += static_cast<std::uint64_t>(n);
  }
  return all;
}

class Order final : public Property {
 public:
  std::string_view name() const noexcept override { return "order"; }
  std::string_view demand() const noexcept override {
    return "A map has the same bits whatever was made before it, and whatever is made in turn with it.";
  }

 protected:
  std::string holds(const Subject& subject, const Effort&) const override {
    int maps = 0;
    for (const Setting& setting : subject.settings()) {
      for (const std::vector<MapRequest>& requests : series(setting.empty() ? 33 : 9)) {
        // Alone: each by an instance that has made nothing else.
        std::vector<HeightMap> alone;
        for (const MapRequest& request : requests)
          alone.push_back(subject.maker(setting).make(request, shortestSlice()));
        inTurn(subject.maker(setting), requests, alone);
        oneAfterTheOther(subject.maker(setting), requests, alone);
        maps += kMaps;
      }
    }
    return std::to_string(maps) + " maps, each alone, after others and in turn with others";
  }

 private:
  static void compare(const MapMaker& maker, const MapRequest& request, const HeightMap& alone,
                      const HeightMap& map, const std::string& how) {
    const std::string differs = difference(alone.view(), "made alone", map.view(), how);
    if (!differs.empty()) throw Counterexample{maker.place(request) + ": " + differs};
  }

  static void oneAfterTheOther(const MapMaker& maker, const std::vector<MapRequest>& requests,
                               const std::vector<HeightMap>& alone) {
    for (int n = kMaps; n-- > 0;) {
      compare(maker, requests[n], alone[n], maker.make(requests[n], shortestSlice()), "made after others");
    }
  }

  static void inTurn(const MapMaker& maker, const std::vector<MapRequest>& requests,
                     const std::vector<HeightMap>& alone) {
    std::vector<HeightMap> maps;
    std::vector<std::unique_ptr<SlicedTask>> tasks;
    for (const MapRequest& request : requests) maps.emplace_back(request.samples, request.samples);
    for (int n = 0; n < kMaps; ++n) maker.prepare(requests[n], maps[n].view());
    for (int n = 0; n < kMaps; ++n) tasks.push_back(maker.begin(requests[n], maps[n].view()));
    for (bool busy = true; busy;) {
      busy = false;
      for (auto& task : tasks) {
        if (task == nullptr) continue;
        if (task->step(shortestSlice())) task.reset();
        busy = true;
      }
    }
    for (int n = 0; n < kMaps; ++n)
      compare(maker, requests[n], alone[n], maps[n], "made in turn with others");
  }
};

}  // namespace

PropertyPointer makeOrder() {
  return std::make_unique<Order>();
}

}  // namespace teren::check
