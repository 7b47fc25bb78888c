#include "apps/check/Ensemble.h"

#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "teren/RowTask.h"

namespace teren::check {
namespace {

/// Heights that depend on the lattice point alone: 3 m and 5 m in turn, but for the eastern rim, which lies
/// at 4 m.
class InTurn final : public Generator {
 public:
  HeightRange range() const override { return {.mean = 3.5, .deviation = 1.0, .min = 3.0, .max = 5.0}; }
  double residual(int, int, double) const override { return 0.0; }
  std::unique_ptr<GenerationTask> begin(const MapRequest& request, HeightView out) const override {
    return makeRowTask(out, [out, height = request.i % 2 == 0 ? 3.0f : 5.0f](int row) {
      for (int column = 0; column < out.columns(); ++column)
        out(column, row) = column == out.columns() - 1 ? 4.0f : height;
    });
  }
};

TEST(Ensemble, MeasuresMeansAndDeviationsWithTheirStandardErrors) {
  const MapMaker maker(std::make_shared<InTurn>(), "defaults");
  Ensemble ensemble(maker);
  for (int n = 0; n < 100; ++n) ensemble.add();
  EXPECT_EQ(ensemble.seeds(), 100);
  // At a sample: 1/2 m above the promised mean, +-1 m.
  EXPECT_NEAR(ensemble.meanAt(3, 7).value, 0.5, 1e-12);
  EXPECT_NEAR(ensemble.meanAt(3, 7).error, 1.0 / std::sqrt(99.0), 1e-12);
  EXPECT_NEAR(ensemble.deviationAt(3, 7), std::sqrt(0.5 * (0.25 + 2.25)), 1e-12);
  EXPECT_NEAR(ensemble.meanAt(16, 7).value, 0.5, 1e-12);
  EXPECT_EQ(ensemble.meanAt(16, 7).error, 0.0);
  EXPECT_NEAR(ensemble.deviationAt(16, 7), 0.5, 1e-12);
  // Over the area the rim counts half: 1 / 32 of it.
  EXPECT_NEAR(ensemble.mean().value, 0.5, 1e-12);
  EXPECT_NEAR(ensemble.mean().error, 31.0 / 32.0 / std::sqrt(99.0), 1e-12);
  const double square = 31.0 / 32.0 * 1.25 + 1.0 / 32.0 * 0.25;
  EXPECT_NEAR(ensemble.deviation().value, std::sqrt(square), 1e-12);
  EXPECT_NEAR(ensemble.deviation().error, 31.0 / 32.0 / std::sqrt(99.0) / (2.0 * std::sqrt(square)), 1e-12);
}

}  // namespace
}  // namespace teren::check
