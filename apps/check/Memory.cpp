#include "apps/check/Counterexample.h"
#include "apps/check/HeapUse.h"
#include "apps/check/MapMaker.h"
#include "apps/check/Properties.h"
#include "apps/check/Subject.h"

namespace teren::check {
namespace {

/// What is kept for later stops growing; what is lost grows in every round.
constexpr int kRounds = 5;

class Memory final : public Property {
 public:
  std::string_view name() const noexcept override { return "memory"; }
  std::string_view demand() const noexcept override {
    return "The memory in use does not grow with the number of maps that were made.";
  }

 protected:
  std::string holds(const Subject& subject, const Effort&) const override {
    int maps = 0;
    for (const Setting& setting : subject.settings()) {
      const bool defaults = setting.empty();
      maps += manyMaps(subject, setting, defaults ? 64 : 8, defaults ? 33 : 9);
    }
    return std::to_string(maps) + " maps";
  }

 private:
  static int manyMaps(const Subject& subject, const Setting& setting, int count, int samples) {
    int next = 0;
    const auto round = [&] {
      const MapMaker maker = subject.maker(setting);
      for (int n = 0; n < count; ++n) maker.make(requestOf(next++, samples));
    };
    round();  // what is made once, and kept, is made here
    const std::size_t before = heapBytes();
    std::size_t last = before;
    for (int n = 0; n < kRounds; ++n) {
      round();
      const std::size_t now = heapBytes();
      if (now < last + static_cast<std::size_t>(count)) return next;
      last = now;
    }
    const int maps = kRounds * count;
    throw Counterexample{"with " + textOf(setting) + ": after " + std::to_string(maps) + " maps " +
                         std::to_string(last - before) + " bytes more are in use, and " +
                         std::to_string((last - before) / static_cast<std::size_t>(maps)) +
                         " more after each further map"};
  }
};

}  // namespace

PropertyPointer makeMemory() {
  return std::make_unique<Memory>();
}

}  // namespace teren::check
