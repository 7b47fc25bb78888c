// The plugin "matrix": the matrix filter (generators/filter).
#include <stdexcept>
#include <utility>

#include "teren/Plugin.h"

#include "generators/filter/MatrixFilter.h"

namespace {

using teren::FilterMatrix;
using teren::MatrixFilter;
using teren::Result;

constexpr teren::Parameter element(const char* name, double weight, const char* doc) {
  return teren::Parameter::real(name, weight, -1000.0, 1000.0, "", doc);
}

class MatrixFilterPlugin final : public teren::Filter {
 public:
  static std::span<const teren::Parameter> parameters() noexcept {
    using teren::Parameter;
    static constexpr Parameter table[] = {
        element("m11", 0.0625, "Weight of the sample to the north-west"),
        element("m12", 0.125, "Weight of the sample to the north"),
        element("m13", 0.0625, "Weight of the sample to the north-east"),
        element("m21", 0.125, "Weight of the sample to the west"),
        element("m22", 0.25, "Weight of the sample itself; the largest, or the map is shifted or spread out"),
        element("m23", 0.125, "Weight of the sample to the east"),
        element("m31", 0.0625, "Weight of the sample to the south-west"),
        element("m32", 0.125, "Weight of the sample to the south"),
        element("m33", 0.0625, "Weight of the sample to the south-east"),
        Parameter::text(
            "matrix", "", 32768,
            "Where it is not empty, the matrix instead of m11 ... m33, of any odd side up to 31: rows "
            "from north to south with ';' between them, as \"1 2 1; 2 4 2; 1 2 1\""),
        Parameter::integer("passes", 1, 1, MatrixFilter::kMaxPasses, "",
                           "How often the matrix is applied; more smooth more and cost proportionally more"),
    };
    return table;
  }

  explicit MatrixFilterPlugin(const teren::Values& values)
      : filter_(
            sound(MatrixFilter::make(sound(matrix(values)), static_cast<int>(values.integer("passes"))))) {}

  teren::HeightRange range(const teren::HeightRange& before) const override { return filter_.range(before); }
  double residual(double before, int level) const override { return filter_.residual(before, level); }
  std::unique_ptr<teren::SlicedTask> begin(const teren::MapRequest&, teren::HeightView inOut) const override {
    return filter_.begin(inOut);
  }

 private:
  static Result<FilterMatrix> matrix(const teren::Values& values) {
    if (!values.text("matrix").empty()) return FilterMatrix::parse(values.text("matrix"));
    std::vector<double> elements;
    for (const char* name : {"m11", "m12", "m13", "m21", "m22", "m23", "m31", "m32", "m33"})
      elements.push_back(values.real(name));
    return FilterMatrix::make(3, std::move(elements));
  }

  /// A constructor has no other way to refuse; the engine turns this into its message.
  template <class T>
  static T sound(Result<T> result) {
    if (!result) throw std::invalid_argument(result.error().message);
    return std::move(result).value();
  }

  MatrixFilter filter_;
};

}  // namespace

TEREN_FILTER_PLUGIN(MatrixFilterPlugin, "matrix", "1.0",
                    "Matrix filter: a weighted mean of the samples around, which smooths or sharpens a map")
