// What the deliberately broken modules of the registry's tests have in common: a generator that works and a
// description of it that would be accepted. Each module then breaks exactly one thing.
#pragma once

#include <array>
#include <memory>
#include <span>

#include "teren/Plugin.h"

namespace broken {

/// Fills every map with one height at once.
class Flat final : public teren::Generator {
 public:
  static std::span<const teren::Parameter> parameters() noexcept {
    static constexpr std::array table = {
        teren::Parameter::real("height", 1.0, -1000.0, 1000.0, "m", "height of every sample")};
    return table;
  }
  explicit Flat(const teren::Values& values) : height_(values.real("height")) {}
  teren::HeightRange range() const override { return {height_, 0.0, height_, height_}; }
  double residual(int, int, double) const override { return 0.0; }
  std::unique_ptr<teren::GenerationTask> begin(const teren::MapRequest&,
                                               teren::HeightView out) const override {
    return std::make_unique<Task>(out, height_);
  }

 private:
  class Task final : public teren::GenerationTask {
   public:
    Task(teren::HeightView out, double height) : out_(out), height_(static_cast<float>(height)) {}
    bool step(const teren::Slice& slice) override {
      while (row_ < out_.rows()) {
        for (int column = 0; column < out_.columns(); ++column) out_(column, row_) = height_;
        ++row_;
        if (slice.over()) break;
      }
      return row_ >= out_.rows();
    }

   private:
    teren::HeightView out_;
    float height_;
    int row_ = 0;
  };
  double height_;
};

inline teren::PluginDescription flatDescription(const char* id) {
  return {teren::kPluginMagic,
          std::size(teren::kAbiWords),
          teren::kAbiWords,
          teren::PluginKind::generator,
          id,
          "1.0",
          "one height everywhere",
          &Flat::parameters,
          &teren::makePlugin<Flat, teren::Generator>,
          nullptr,
          nullptr};
}

}  // namespace broken

#define TEREN_BROKEN_ENTRY \
  extern "C" __attribute__((visibility("default"))) const teren::PluginDescription* terenPlugin()
