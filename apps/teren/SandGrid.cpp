#include "apps/teren/SandGrid.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace teren {

SandGrid::SandGrid(int side, double loose)
    : side_(side),
      spacing_(1.0 / (side - 1)),
      samples_(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), {0, ticksFromMetres(loose)}) {
}

/// Twice the area of the triangles at a sample: 6 inside, 3 on a side, 2 or 1 in a corner.
std::int64_t SandGrid::weight(Place p) const noexcept {
  const bool west = p.column == 0, east = p.column == side_ - 1, south = p.row == 0,
             north = p.row == side_ - 1;
  if ((west && south) || (east && north)) return 2;
  if ((west && north) || (east && south)) return 1;
  return west || east || south || north ? 3 : 6;
}

void SandGrid::addSquare(int column, int row) {
  if (column < 0 || row < 0 || column >= side_ - 1 || row >= side_ - 1) return;
  const auto square = static_cast<std::uint32_t>(row * (side_ - 1) + column);
  for (const std::uint32_t face : {2 * square, 2 * square + 1}) {
    if (waiting_.insert(face)) next_.push_back(face);
  }
}

void SandGrid::addAround(Place p) {
  for (const int row : {p.row - 1, p.row}) {
    addSquare(p.column - 1, row);
    addSquare(p.column, row);
  }
}

void SandGrid::raise(Place p, std::int64_t ticks) {
  Sample& sample = samples_[at(p)];
  sample.height += ticks;
  sample.loose = std::max<std::int64_t>(sample.loose + ticks, 0);
  ledger_.enter(static_cast<WideInteger>(weight(p)) * ticks);
  addAround(p);
}

template <class Visitor>
void SandGrid::forEachWithin(double x, double y, double reach, Visitor&& visit) {
  const auto low = [&](double middle) {
    return std::max(static_cast<int>(std::floor((middle - reach) / spacing_)), 0);
  };
  const auto high = [&](double middle) {
    return std::min(static_cast<int>(std::floor((middle + reach) / spacing_)) + 1, side_ - 1);
  };
  for (int row = low(y); row <= high(y); ++row) {
    for (int column = low(x); column <= high(x); ++column) {
      const double dx = column * spacing_ - x, dy = row * spacing_ - y;
      const double distance = std::sqrt(dx * dx + dy * dy);
      if (distance <= reach) visit(Place{column, row}, distance);
    }
  }
}

void SandGrid::stamp(double x, double y, double radius, double bottom, double bermWidth) {
  const std::int64_t deep = ticksFromMetres(bottom);
  forEachWithin(x, y, radius, [&](Place p, double) {
    const std::int64_t height = samples_[at(p)].height;
    if (height > deep) raise(p, deep - height);
  });
  double weights = 0.0;
  Place any;
  const auto share = [&](double distance) { return 1.0 - (distance - radius) / bermWidth; };
  forEachWithin(x, y, radius + bermWidth, [&](Place p, double distance) {
    if (distance <= radius) return;
    weights += share(distance) * static_cast<double>(weight(p));
    any = p;
  });
  if (weights == 0.0) return;
  const double rise = asDouble(ledger_.owed()) / weights;
  forEachWithin(x, y, radius + bermWidth, [&](Place p, double distance) {
    if (distance > radius) raise(p, static_cast<std::int64_t>(std::floor(rise * share(distance) + 0.5)));
  });
  raise(any, ledger_.balance(0, weight(any)));
}

void SandGrid::look(std::uint32_t face, const Repose& repose) {
  const int square = static_cast<int>(face / 2), column = square % (side_ - 1), row = square / (side_ - 1);
  const Place southWest{column, row}, northEast{column + 1, row + 1};
  const std::array<Place, 3> places =
      face % 2 == 0 ? std::array<Place, 3>{southWest, Place{column + 1, row}, northEast}
                    : std::array<Place, 3>{southWest, northEast, Place{column, row + 1}};
  Face corners;
  for (std::size_t i = 0; i < 3; ++i) {
    const Sample& sample = samples_[at(places[i])];
    corners[i] = {{places[i].column, places[i].row}, sample.height, sample.loose, weight(places[i])};
  }
  const auto move = slideFace(corners, repose, spacing_, ledger_);
  if (!move) return;
  for (std::size_t i = 0; i < 3; ++i) {
    if ((*move)[i] != 0) raise(places[i], (*move)[i]);
  }
}

bool SandGrid::slide(const Repose& repose, std::uint64_t steps) {
  for (; steps > 0; --steps) {
    if (position_ == now_.size()) {
      if (next_.empty()) return true;
      now_.clear();
      now_.swap(next_);
      position_ = 0;
    }
    const std::uint32_t face = now_[position_++];
    waiting_.erase(face);
    look(face, repose);
  }
  return position_ == now_.size() && next_.empty();
}

std::size_t SandGrid::bytes() const noexcept {
  return sizeof(*this) + samples_.capacity() * sizeof(Sample) + waiting_.bytes() +
         (now_.capacity() + next_.capacity()) * sizeof(std::uint32_t);
}

}  // namespace teren
