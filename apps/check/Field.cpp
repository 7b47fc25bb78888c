#include <cstdint>

#include "apps/check/Counterexample.h"
#include "apps/check/MapComparison.h"
#include "apps/check/MapMaker.h"
#include "apps/check/Properties.h"
#include "apps/check/Subject.h"

namespace teren::check {
namespace {

constexpr int kSide = 33;  // samples

class Field final : public Property {
 public:
  std::string_view name() const noexcept override { return "field"; }
  std::string_view demand() const noexcept override {
    return "A sample of a continuous field has the same bits whatever rectangle asks for it, from whichever "
           "lattice point, and however sliced.";
  }

 protected:
  std::string holds(const Subject& subject, const Effort&) const override {
    int rectangles = 0;
    for (const Setting& setting : subject.settings()) {
      const MapMaker maker = subject.maker(setting);
      if (maker.continuous() == nullptr) continue;
      for (const std::int64_t far : {std::int64_t{0}, std::int64_t{1} << 40, std::int64_t{-1} << 52}) {
        FieldRequest whole{.i = far, .j = 7 - far, .u = 0.25, .v = 0.5, .seed = 99};
        whole.pitch = kPitch;
        whole.columns = whole.rows = kSide;
        for (const int level : {0, 2}) {
          whole.level = level;
          whole.spacing = 2.0 * (1 << level);
          rectangles += compareParts(maker, whole);
        }
      }
    }
    return rectangles == 0 ? "no continuous field" : std::to_string(rectangles) + " rectangles";
  }

 private:
  /// The rectangle of samples that begins `x` and `y` samples into another one, counted from the lattice
  /// point it lies at.
  static FieldRequest part(const FieldRequest& whole, int x, int y, int columns, int rows) {
    FieldRequest request = whole;
    const double step = whole.spacing / whole.pitch;
    request.u += x * step;
    request.v += y * step;
    for (; request.u >= 1.0; request.u -= 1.0) ++request.i;
    for (; request.v >= 1.0; request.v -= 1.0) ++request.j;
    request.columns = columns;
    request.rows = rows;
    return request;
  }

  static int compareParts(const MapMaker& maker, const FieldRequest& whole) {
    const HeightMap field = maker.field(whole);
    const auto same = [&](int x, int y, int columns, int rows) {
      const FieldRequest request = part(whole, x, y, columns, rows);
      const HeightMap piece = maker.field(request, shortestSlice());
      compare(maker, request, piece, field.view().part(x, y, columns, rows));
      return 1;
    };
    int rectangles = same(0, 0, kSide, kSide);
    // Two halves that share a line, both ways; then pieces and single samples here and there.
    for (const int at : {0, 16}) rectangles += same(at, 0, 17, kSide) + same(0, at, kSide, 17);
    for (const int at : {1, 5, 20}) rectangles += same(at, 2 * at % 30, 3, 2) + same(at, 32 - at, 1, 1);
    return rectangles + (whole.level == 0 ? compareSpacings(maker, whole, field) : 0);
  }

  /// At level 0 the spacing does not matter.
  static int compareSpacings(const MapMaker& maker, const FieldRequest& whole, const HeightMap& field) {
    FieldRequest coarse = whole;
    coarse.spacing *= 4.0;
    coarse.columns = coarse.rows = (kSide - 1) / 4 + 1;
    compare(maker, coarse, maker.field(coarse), subsampled(field, 2).view());
    return 1;
  }

  static void compare(const MapMaker& maker, const FieldRequest& request, const HeightMap& piece,
                      ConstHeightView expected) {
    const std::string differs = difference(piece.view(), "in this rectangle", expected, "in a larger one");
    if (!differs.empty()) throw Counterexample{maker.place(request) + ": " + differs};
  }
};

}  // namespace

PropertyPointer makeField() {
  return std::make_unique<Field>();
}

}  // namespace teren::check
