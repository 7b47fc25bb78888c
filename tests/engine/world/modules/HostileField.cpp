// Value noise that lies about itself, or does not keep its promise.
#include <limits>
#include <stdexcept>

#include "teren/Plugin.h"

#include "tests/engine/world/ValueNoise.h"

namespace {

constexpr std::array<std::string_view, 6> kWays = {"sound",     "traits-throw",   "error-throws",
                                                   "error-nan", "error-negative", "error-idle"};
constexpr std::array<std::string_view, 10> kWork = {
    "well", "nan",          "above",         "unwritten", "throws",
    "late", "begin-throws", "begin-nothing", "endless",   "here-and-there"};

class Endless final : public teren::GenerationTask {
 public:
  bool step(const teren::Slice&) override { return false; }
};

class HostileField final : public teren::ValueNoise {
 public:
  static std::span<const teren::Parameter> parameters() noexcept {
    static constexpr std::array table = {
        teren::Parameter::choice("way", "sound", kWays, "what is wrong with the promise"),
        teren::Parameter::choice("work", "well", kWork, "what is wrong with the work")};
    return table;
  }
  explicit HostileField(const teren::Values& values)
      : ValueNoise(100.0, 10.0, 64.0), way_(values.choice("way")), work_(values.choice("work")) {}

  teren::Traits traits() const override {
    if (way_ == "traits-throw") throw std::runtime_error("no\ntraits");
    return ValueNoise::traits();
  }
  double fieldError(double spacing) const override {
    if (way_ == "error-throws") throw 7;
    if (way_ == "error-nan") return std::numeric_limits<double>::quiet_NaN();
    if (way_ == "error-negative") return -1.0;
    if (way_ == "error-idle") return 1e20;
    return ValueNoise::fieldError(spacing);
  }

  std::unique_ptr<teren::GenerationTask> beginField(const teren::FieldRequest& request,
                                                    teren::HeightView out) const override {
    if (work_ == "begin-throws") throw std::runtime_error("no\nfield");
    if (work_ == "here-and-there" && ((request.i ^ request.j) & 1) != 0) throw 7;
    if (work_ == "begin-nothing") return nullptr;
    if (work_ == "endless") return std::make_unique<Endless>();
    return teren::makeRowTask(out, [this, request, out, rows = 0](int row) mutable {
      for (int column = 0; column < out.columns(); ++column) {
        const float height = sample(request, column, row);
        // High places only: where it goes wrong is a function of the position too.
        if (work_ == "unwritten" && height > 103.0F) continue;
        out(column, row) = height;
        if (work_ == "nan" && height > 103.0F) out(column, row) = std::numeric_limits<float>::quiet_NaN();
        if (work_ == "above" && height > 103.0F) out(column, row) = 1000.0F;
      }
      if (work_ == "throws") throw std::runtime_error("no\nluck");
      if (work_ == "late" && ++rows == out.rows()) throw std::logic_error("tired");
    });
  }

 private:
  std::string way_, work_;
};

}  // namespace

TEREN_GENERATOR_PLUGIN(HostileField, "hostile-field", "1.0",
                       "a continuous generator that breaks its promises")
