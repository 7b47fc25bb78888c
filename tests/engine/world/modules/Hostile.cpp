// A generator that lies about its range or throws, and where its promise is sound, does not keep it.
#include <ctime>
#include <exception>
#include <limits>
#include <stdexcept>

#include "tests/engine/world/modules/Promise.h"

namespace {

constexpr std::array<std::string_view, 13> kWork = {
    "nan",          "infinite",      "above",   "below", "throws", "throws-int", "throws-null",
    "begin-throws", "begin-nothing", "endless", "late",  "slow",   "well"};

/// Uses the processor for a while.
void burn(double seconds) {
  const auto now = [] {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  };
  for (const double start = now(); now() - start < seconds;) {
  }
}

class NoText final : public std::exception {
 public:
  const char* what() const noexcept override { return nullptr; }
};

class Hostile final : public teren::Generator {
 public:
  static std::span<const teren::Parameter> parameters() noexcept {
    static constexpr std::array table = {
        teren::Parameter::choice("way", "sound", hostile::kWays, "what is wrong with the promise"),
        teren::Parameter::choice("work", "nan", kWork, "what is wrong with the work")};
    return table;
  }
  explicit Hostile(const teren::Values& values) : way_(values.choice("way")), work_(values.choice("work")) {}
  teren::HeightRange range() const override { return hostile::promise(way_); }
  double residual(int, int, double) const override { return 0.0; }
  std::unique_ptr<teren::GenerationTask> begin(const teren::MapRequest&,
                                               teren::HeightView out) const override {
    if (work_ == "begin-throws") throw std::runtime_error("no\nground");
    if (work_ == "begin-nothing") return nullptr;
    return std::make_unique<Task>(out, work_);
  }

 private:
  /// Even where the promise was sound, the map is not (but for "slow" and "well").
  class Task final : public teren::GenerationTask {
   public:
    Task(teren::HeightView out, const std::string& work) : out_(out), work_(work) {}
    bool step(const teren::Slice&) override {
      if (work_ == "throws") throw std::runtime_error("no\nluck");
      if (work_ == "throws-int") throw 7;
      if (work_ == "throws-null") throw NoText();
      if (work_ == "endless") return false;
      float& last = out_(out_.columns() - 1, out_.rows() - 1);
      if (work_ == "nan") last = std::numeric_limits<float>::quiet_NaN();
      if (work_ == "infinite") last = std::numeric_limits<float>::infinity();
      if (work_ == "above") last = 1.5F;
      if (work_ == "below") last = -1e30F;
      if (work_ == "slow") burn(0.03);
      if (work_ == "late" && ++steps_ < 3) return false;
      if (work_ == "late") throw std::logic_error("tired");
      return true;
    }

   private:
    teren::HeightView out_;
    std::string work_;
    int steps_ = 0;
  };
  std::string way_, work_;
};

}  // namespace

TEREN_GENERATOR_PLUGIN(Hostile, "hostile", "1.0", "a generator that breaks its promises")
