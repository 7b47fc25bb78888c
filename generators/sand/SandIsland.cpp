#include "generators/sand/SandIsland.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "generators/numbers/Turn.h"

namespace teren {
namespace {

constexpr int kShift = std::countr_zero(static_cast<std::uint32_t>(SandIsland::kStepsASpacing));
constexpr int kMostCells = kLatticeSide >> kShift;
constexpr std::int64_t kMostInAll = std::int64_t{1} << 30;
/// A unit of work: some tens of microseconds.
constexpr std::uint64_t kUnitFaces = 8;
constexpr std::size_t kUnitVertices = 4;
constexpr int kUnitCorners = 64;
constexpr int kTeeth = 3;
constexpr double kLooks = 8.0;         // times n^1.5
constexpr double kThinnestWall = 8.5;  // [steps], a little more than Stamper asks for
/// What a tool of no depth moves, its berm included, and how far sand runs out from a berm's top.
constexpr double kReachOfTool = 2.0, kReachOfDepth = 3.0, kReachOfSpacing = 3.0;
/// How much farther it may run down a slope: so many times as far, but no more than some spacings.
constexpr double kRunOut = 2.0, kMostRunOut = 96.0;

Error wrong(const char* field, double value, const std::string& expected) {
  return {std::string(field) + " is " + metresText(value) + ", expected " + expected};
}

Result<ToolShape> shapeOf(const std::string& tool, double size, double depth) {
  if (tool == "square") return ToolShape::square(2.0 * size, depth);
  if (tool == "rake") return ToolShape::rake(2.0 * size, depth, kTeeth);
  if (tool == "wedge") return ToolShape::wedge(2.0 * size, depth);
  if (tool == "ball") return ToolShape::ball(size, depth);
  return ToolShape::disc(size, depth);
}

/// A lattice as large as can be, with the region in its middle, whose corner has the place (0, 0) m.
OpenCells cellsOf(const DeformRegion& region) {
  const int columns = region.sampleColumns() - 1, rows = region.sampleRows() - 1;
  const auto corner = [](int squares) { return (kMostCells - squares) / 2 << kShift; };
  return {{corner(columns), corner(rows)}, columns, rows, kShift};
}

SandSettings settingsFor(double spacing) {
  SandSettings settings;
  settings.longestEdge = spacing;
  settings.flatness = SandIsland::kTolerance * spacing;
  settings.stamp.fit = spacing / 256.0;
  settings.stamp.loosening = spacing / 4.0;
  return settings;
}

SandSurface closedSurface(const DeformRegion& region, ConstHeightView ground) {
  const OpenCells cells = cellsOf(region);
  const double step = region.spacing / SandIsland::kStepsASpacing;
  const LatticeFrame frame{.x = -step * cells.corner().x, .y = -step * cells.corner().y, .step = step};
  SandSurface surface(frame, ground(0, 0), 0.0);
  surface.fence(cells);
  return surface;
}

/// [m^3]
double volumeOf(SixfoldVolume volume, double step) {
  return asDouble(volume) * kMetresPerTick * step * step / 6.0;
}

Result<void> checkSize(const DeformRegion& region) {
  const int columns = region.sampleColumns() - 1, rows = region.sampleRows() - 1;
  if (columns > kMostCells || rows > kMostCells || std::int64_t{columns} * rows > kMostInAll) {
    return Error{"sand cannot hold a region of " + std::to_string(columns) + " x " + std::to_string(rows) +
                 " squares: at most " + std::to_string(kMostCells) + " along a side and " +
                 std::to_string(kMostInAll) + " in all"};
  }
  return {};
}

Result<void> checkHeights(ConstHeightView ground) {
  const double highest = metresFromTicks(kHighestTick);
  for (int y = 0; y < ground.rows(); ++y) {
    for (int x = 0; x < ground.columns(); ++x) {
      if (std::fabs(ground(x, y)) <= highest) continue;
      return Error{"sand cannot hold ground at " + metresText(ground(x, y)) + ", only from " +
                   metresText(-highest) + " to " + metresText(highest)};
    }
  }
  return {};
}

HeightMap copyOf(ConstHeightView ground) {
  HeightMap map(ground.columns(), ground.rows());
  for (int y = 0; y < ground.rows(); ++y) std::copy_n(ground.row(y), ground.columns(), map.view().row(y));
  return map;
}

}  // namespace

Result<SandPress> SandIsland::read(const Stamp& stamp, double spacing) {
  const double largest = kMostSpacings * spacing;
  if (!(stamp.size > 0.0 && stamp.size <= largest)) {
    return wrong("size", stamp.size, "a radius above 0 and up to " + metresText(largest));
  }
  if (!(std::fabs(stamp.depth) <= stamp.size) || stamp.depth == 0.0) {
    return wrong("depth", stamp.depth, "at most the size, down or, to heap up, negative, and not 0");
  }
  const double step = spacing / kStepsASpacing;
  SandPress press;
  double wall = stamp.size / 20.0, tool = stamp.size;
  if (stamp.depth > 0.0) {
    Result<ToolShape> shape = shapeOf(stamp.values.choice("tool"), stamp.size, stamp.depth);
    if (!shape) return shape.error();
    for (const ToolPart& part : shape->parts()) wall = std::min(wall, part.wall);
    tool = shape->reach();
    press.tool = *std::move(shape);
  }
  if (!(wall >= kThinnestWall * step)) {
    return wrong("size", stamp.size,
                 "at least " + metresText(stamp.size * kThinnestWall * step / wall) +
                     " of this tool on ground of samples " + metresText(spacing) + " apart");
  }
  press.radius = stamp.size;
  press.height = -stamp.depth;
  press.dryAngle = stamp.values.real("repose");
  press.moisture = stamp.values.real("moisture");
  if (stamp.values.boolean("push")) {
    const SineCosine way = sineCosineOfTurn(stamp.values.real("direction") / 360.0);
    press.pushX = way.cosine;
    press.pushY = way.sine;
  }
  press.opens = kReachOfTool * tool + kReachOfDepth * std::fabs(stamp.depth) + kReachOfSpacing * spacing;
  press.reach = press.opens + std::min(kRunOut * press.opens, kMostRunOut * spacing);
  return press;
}

Result<std::unique_ptr<LiveSurface>> SandIsland::begin(const DeformRegion& region, ConstHeightView ground) {
  if (Result<void> fits = checkSize(region); !fits) return fits.error();
  if (Result<void> held = checkHeights(ground); !held) return held.error();
  return std::unique_ptr<LiveSurface>(new SandIsland(region, ground));
}

SandIsland::SandIsland(const DeformRegion& region, ConstHeightView ground)
    : ground_(copyOf(ground)),
      grid_(region, ground),
      sandbox_(closedSurface(region, ground), settingsFor(region.spacing)),
      reached_(cellsOf(region)) {}

Result<void> SandIsland::apply(const Stamp& stamp) {
  const Result<SandPress> press = read(stamp, grid_.region().spacing);
  if (!press) return press.error();
  if (Result<void> place = checkPlace(grid_.region(), stamp, press->reach); !place) return place;
  if (Result<void> room = SandSurface::hasRoom(surface().mesh().vertexCount()); !room) return room;
  while (begun_) work();
  takeGroundIn(stamp, *press);
  sandbox_.setReposeOfWhatMoves(press->dryAngle, press->moisture);
  if (press->tool) {
    const LatticePoint middle = *surface().mesh().frame().snap(stamp.east, stamp.north);
    const double height = metresFromTicks(surface().heightAt(middle, kNoTriangle));
    const auto report =
        sandbox_.stamp(*press->tool, {stamp.east, stamp.north, height, press->pushX, press->pushY});
    if (!report) return report.error();
    return {};
  }
  const SixfoldVolume before = surface().entered();
  sandbox_.pour(stamp.east, stamp.north, press->radius, press->height);
  poured_ += volumeOf(surface().entered() - before, surface().step());
  return {};
}

void SandIsland::takeGroundIn(const Stamp& stamp, const SandPress& press) {
  const auto forEachCell = [&](double distance, const auto& visit) {
    forEachCellWithin(surface(), stamp.east, stamp.north, distance, visit);
  };
  forEachCell(press.reach, [&](Opening::Cell cell) { reached_.open(cell.column, cell.row); });
  cells_.clear();
  forEachCell(press.opens, [&](Opening::Cell cell) {
    if (!surface().cells().isOpen(cell.column, cell.row)) cells_.push_back(cell);
  });
  sandbox_.open(ground_.view(), loose_.view(), cells_);
  sandbox_.forgetLeanedOn();
  leanedSeen_ = 0;  // more may give way now
  const double across = press.opens / grid_.region().spacing;
  squares_ = std::numbers::pi * across * across;
  limitLooks();
  allowLooks(static_cast<std::uint64_t>(kLooks * squares_ * std::sqrt(squares_)));
}

/// From now on there are no more of them than there ever may be at once.
void SandIsland::limitLooks() {
  const std::uint64_t done = sandbox_.slides().count().steps;
  slidesUntil_ = std::max(slidesUntil_, done);
  slidesMost_ = done + kMostLooks;
}

void SandIsland::allowLooks(std::uint64_t looks) {
  slidesUntil_ = std::min(slidesUntil_ + looks, slidesMost_);
}

/// What n^1.5 grows by with so many squares more.
std::uint64_t SandIsland::looksFor(double more) const noexcept {
  return static_cast<std::uint64_t>(1.5 * kLooks * std::sqrt(squares_) * more);
}

std::uint64_t SandIsland::looksLeft() const noexcept {
  const std::uint64_t done = sandbox_.slides().count().steps;
  return std::max(slidesUntil_, done) - done;
}

bool SandIsland::step(const Slice& slice, std::uint64_t upTo) {
  while (!atRest() && steps_ < upTo) {
    work();
    if (slice.over()) break;
  }
  return atRest() || steps_ >= upTo;
}

/// A unit of the current step.
void SandIsland::work() {
  begun_ = true;
  if (sandbox_.slides().count().steps >= slidesUntil_) sandbox_.stopSliding();
  if (faces_ < kStepFaces && !sandbox_.slides().atRest()) {
    sandbox_.slide(kUnitFaces);
    faces_ += kUnitFaces;
    return;
  }
  faces_ = kStepFaces;  // what the clean-up unsettles is the next step's
  if (vertices_ < kStepVertices) {
    sandbox_.clean(kUnitVertices);
    vertices_ = sandbox_.hasToClean() ? vertices_ + kUnitVertices : kStepVertices;
    if (vertices_ < kStepVertices) return;
  }
  if (runOut()) return;
  faces_ = 0;
  vertices_ = 0;
  begun_ = false;
  ++steps_;
}

/// The closed squares around a corner to which sand may run.
void SandIsland::findWayOut(LatticePoint corner) {
  const OpenCells& cells = surface().cells();
  const int east = cells.columnOf(corner.x), north = cells.rowOf(corner.y);
  cells_.clear();
  for (int row = north - kRunOutCells; row < north + kRunOutCells; ++row) {
    for (int column = east - kRunOutCells; column < east + kRunOutCells; ++column) {
      if (reached_.isOpen(column, row) && !cells.isOpen(column, row)) cells_.push_back({column, row});
    }
  }
}

/// A unit: opens squares around the next corner of the fence that sand leans on. False: there is none.
bool SandIsland::runOut() {
  const auto corners = sandbox_.slides().leanedOn().ids();
  for (int unit = 0; leanedSeen_ < corners.size() && looksLeft() > 0; ++unit) {
    if (unit == kUnitCorners) return true;
    const VertexId corner = corners[leanedSeen_++];
    assert(surface().mesh().isVertex(corner));
    findWayOut(surface().mesh().point(corner));
    if (cells_.empty()) continue;
    sandbox_.open(ground_.view(), loose_.view(), cells_);
    const double more = static_cast<double>(cells_.size());
    allowLooks(looksFor(more));
    squares_ += more;
    return runsOut_ = true;
  }
  if (std::exchange(runsOut_, false)) {
    sandbox_.forgetLeanedOn();
    leanedSeen_ = sandbox_.slides().leanedOn().ids().size();
  }
  return false;
}

/// Calls visit(samples) for what lies around each corner of the fence that sand leans on.
template <class Visitor>
void SandIsland::forEachSpread(Visitor&& visit) const {
  assert(atRest());
  if (sandbox_.slides().count().steps >= slidesMost_) return;
  const std::int64_t film = ticksFromMetres(kFilm * grid_.region().spacing);
  for (const VertexId corner : sandbox_.slides().leanedOn().ids()) {
    if (!sandbox_.slides().leansOn(surface(), corner, film)) continue;
    const LatticePoint p = surface().mesh().point(corner);
    const int column = surface().cells().columnOf(p.x), row = surface().cells().rowOf(p.y);
    visit(SampleRectangle{column - kSpreadCells, row - kSpreadCells, 2 * kSpreadCells + 1,
                          2 * kSpreadCells + 1});
  }
}

SampleRectangle SandIsland::spreadsTo() const {
  SampleRectangle all;
  forEachSpread([&](const SampleRectangle& part) { all = all.joinedWith(part); });
  return all;
}

void SandIsland::spread() {
  const SampleRectangle changeable = grid_.region().changeable();
  bool mayGoOn = false;
  forEachSpread([&](const SampleRectangle& part) {
    if (!changeable.contains(part)) return;
    mayGoOn = true;
    allowLooks(looksFor(4 * kRunOutCells * kRunOutCells));
    for (int row = part.row; row < part.row + part.rows - 1; ++row) {
      for (int column = part.column; column < part.column + part.columns - 1; ++column) {
        reached_.open(column, row);
      }
    }
  });
  if (!mayGoOn) return;
  leanedSeen_ = 0;
  begun_ = true;  // a step that looks for ways out
}

Result<void> SandIsland::grow(const DeformRegion& region, ConstHeightView ground) {
  assert(atRest());
  if (Result<void> fits = checkSize(region); !fits) return fits;
  const auto [west, south, ownColumns, ownRows] = region.placeOf(grid_.region());
  const LatticePoint corner = surface().cells().point(-west, -south);
  const int columns = region.sampleColumns() - 1, rows = region.sampleRows() - 1;
  const auto fits = [](std::int32_t from, int squares) {
    return from >= 0 && (from >> kShift) + squares <= kMostCells;
  };
  if (!fits(corner.x, columns) || !fits(corner.y, rows)) {
    return Error{"sand cannot grow to a region of " + std::to_string(columns) + " x " + std::to_string(rows) +
                 " squares: its lattice of " + std::to_string(kMostCells) + " along a side ends before"};
  }
  if (Result<void> held = checkHeights(ground); !held) return held;
  grid_.grow(region, ground);
  ground_ = copyOf(ground);
  loose_ = HeightMap();
  sandbox_.grow(west, south, columns, rows);
  reached_ = reached_.grown(west, south, columns, rows);
  return {};
}

Result<void> SandIsland::merge(const DeformRegion& region, ConstHeightView ground,
                               std::span<LiveSurface* const> others) {
  std::size_t vertices = surface().mesh().vertexCount();
  for (LiveSurface* other : others) {
    vertices += static_cast<SandIsland&>(*other).surface().mesh().vertexCount();
  }
  if (Result<void> room = SandSurface::hasRoom(vertices); !room) return room;
  if (Result<void> grown = grow(region, ground); !grown) return grown;
  for (LiveSurface* other : others) take(static_cast<SandIsland&>(*other));
  return {};
}

/// Samples come as they were, whatever rounding says of the same triangles now.
void SandIsland::take(SandIsland& other) {
  assert(other.atRest());
  (void)other.snapshot();
  grid_.take(other.grid_);
  const SampleRectangle place = grid_.region().placeOf(other.grid_.region());
  sandbox_.take(other.sandbox_, place.column, place.row);
  reached_.take(other.reached_, place.column, place.row);
  limitLooks();
  allowLooks(other.looksLeft());
  poured_ += other.poured_;
}

/// Calls visit(x, y, p) for the samples in a triangle that may change.
template <class Visitor>
void SandIsland::forEachSample(TriangleId t, Visitor&& visit) const {
  if (!surface().isOpen(t)) return;
  const Triangulation& mesh = surface().mesh();
  const OpenCells& cells = surface().cells();
  const std::array<VertexId, 3>& corners = mesh.corners(t);
  const LatticePoint a = mesh.point(corners[0]), b = mesh.point(corners[1]), c = mesh.point(corners[2]);
  const auto [west, east] = std::minmax({a.x, b.x, c.x});
  const auto [south, north] = std::minmax({a.y, b.y, c.y});
  constexpr std::int32_t kUp = kStepsASpacing - 1;
  for (int y = cells.rowOf(south + kUp); y <= cells.rowOf(north); ++y) {
    for (int x = cells.columnOf(west + kUp); x <= cells.columnOf(east); ++x) {
      const LatticePoint p = cells.point(x, y);
      if (orientation(a, b, p) < 0 || orientation(b, c, p) < 0 || orientation(c, a, p) < 0) continue;
      if (!cells.isFixed(p)) visit(x, y, p);
    }
  }
}

/// Takes the TIN's heights at the samples within a triangle.
void SandIsland::sample(TriangleId t) {
  forEachSample(t, [&](int x, int y, LatticePoint p) {
    const double ground = ground_(x, y), height = surface().mesh().heightAt(p, t);
    const double now = std::fabs(height - ground) <= tolerance() ? ground : height;
    if (grid_(x, y) != now) grid_.set(x, y, now);
  });
}

void SandIsland::layLoose(ConstHeightView depths) {
  assert(atRest() && depths.columns() == ground_.columns() && depths.rows() == ground_.rows());
  loose_ = copyOf(depths);
}

bool SandIsland::loose(HeightView depths) const {
  assert(atRest());
  for (int y = 0; y < depths.rows(); ++y) {
    if (loose_.rows() > 0) {
      std::copy_n(loose_.view().row(y), depths.columns(), depths.row(y));
    } else {
      std::fill_n(depths.row(y), depths.columns(), 0.0F);
    }
  }
  const Triangulation& mesh = surface().mesh();
  for (TriangleId t = 0; t < mesh.triangleSlots(); ++t) {
    if (!mesh.isTriangle(t)) continue;
    forEachSample(t, [&](int x, int y, LatticePoint p) {
      depths(x, y) = static_cast<float>(metresFromTicks(surface().looseAt(p, t)));
    });
  }
  return true;
}

std::shared_ptr<const DeformedGround> SandIsland::snapshot() {
  for (const TriangleId t : sandbox_.changedTriangles().ids()) {
    if (surface().mesh().isTriangle(t)) sample(t);
  }
  sandbox_.forgetChanges();
  return grid_.snapshot();
}

/// [m^3] Of the TIN above a height.
double SandIsland::volumeOverOpenSquares(double from) const {
  const Triangulation& mesh = surface().mesh();
  double sum = 0.0;  // [m steps^2], sixfold
  for (TriangleId t = 0; t < mesh.triangleSlots(); ++t) {
    if (!mesh.isTriangle(t) || !surface().isOpen(t)) continue;
    const std::array<VertexId, 3>& corners = mesh.corners(t);
    const auto twice = static_cast<double>(
        orientation(mesh.point(corners[0]), mesh.point(corners[1]), mesh.point(corners[2])));
    sum += twice * (mesh.height(corners[0]) + mesh.height(corners[1]) + mesh.height(corners[2]) - 3.0 * from);
  }
  return sum * surface().step() * surface().step() / 6.0;
}

/// [m^3] The same, of the grid's triangles on the samples, as they are given out.
double SandIsland::volumeUnderSamples(double from) const {
  const OpenCells& cells = surface().cells();
  const auto height = [&](int x, int y) {
    return static_cast<double>(static_cast<float>(grid_(x, y))) - from;
  };
  double sum = 0.0;  // [m squares], sixfold
  for (int y = 0; y < cells.rows(); ++y) {
    for (int x = 0; x < cells.columns(); ++x) {
      if (!cells.isOpen(x, y)) continue;
      sum += 2.0 * (height(x, y) + height(x + 1, y + 1)) + height(x + 1, y) + height(x, y + 1);
    }
  }
  return sum * grid_.region().spacing * grid_.region().spacing / 6.0;
}

double SandIsland::samplingError() const {
  assert(atRest());
  const auto heights = ground_.samples();
  const double from = *std::min_element(heights.begin(), heights.end());
  return volumeUnderSamples(from) - volumeOverOpenSquares(from);
}

std::size_t SandIsland::bytes() const noexcept {
  return sizeof(*this) - sizeof(grid_) - sizeof(sandbox_) + grid_.bytes() + sandbox_.bytes() +
         reached_.bytes() + cells_.capacity() * sizeof(Opening::Cell) + loose_.bytes() +
         ground_.samples().size() * sizeof(float);
}

}  // namespace teren
