#include "generators/sand/SandState.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>
#include <type_traits>

namespace teren {

static_assert(std::endian::native == std::endian::little, "sections are memory as it is");

/// visit(section, array) for every array; the only list of them.
template <class Self, class Visitor>
void SandState::forEachArray(Self& sandbox, Visitor&& visit) {
  auto& surface = sandbox.surface_;
  auto& mesh = surface.mesh_;
  visit(kVertices, mesh.mesh_.vertices_);
  visit(kTriangles, mesh.mesh_.triangles_);
  visit(kHeights, mesh.heights_);
  visit(kLoose, surface.loose_);
  visit(kConstraints, mesh.table_.places_);
  visit(kCells, mesh.grid_.cells_);
  visit(kErrors, sandbox.cleanUp_.carried_);
  visit(kSlidingNow, sandbox.slides_.now_);
  visit(kSlidingNext, sandbox.slides_.next_);
  visit(kToClean, sandbox.cleanUp_.queue_);
  visit(kRims, sandbox.stamper_.allRims_.ids_);
  visit(kInsides, sandbox.stamper_.allInside_.ids_);
}

SandState::Numbers SandState::numbersOf(const Sandbox& sandbox) {
  const SandSurface& surface = sandbox.surface_;
  const TriangleMesh& mesh = surface.mesh_.mesh_;
  Numbers numbers;
  numbers.owed = surface.ledger_.owed();
  numbers.moved = surface.moved_;
  numbers.frame = surface.mesh_.frame_;
  numbers.settings = sandbox.settings_;
  numbers.slides = sandbox.slides_.count_;
  numbers.cleanUp = sandbox.cleanUp_.count_;
  numbers.slidingPosition = sandbox.slides_.position_;
  numbers.removable = sandbox.removable_;
  numbers.cleaningRound = static_cast<std::uint32_t>(sandbox.round_);
  numbers.unsettled = sandbox.unsettled_ ? 1 : 0;
  numbers.freeVertices = mesh.freeVertices_;
  numbers.freeTriangles = mesh.freeTriangles_;
  numbers.constraints = surface.mesh_.table_.used_;
  numbers.freeVertex = mesh.freeVertex_;
  numbers.freeTriangle = mesh.freeTriangle_;
  numbers.cellShift = surface.mesh_.grid_.shift_;
  numbers.nextId = sandbox.stamper_.nextId_;
  numbers.near = sandbox.stamper_.near_;
  numbers.keptId = sandbox.keptId_;
  return numbers;
}

void SandState::assignNumbers(Sandbox& sandbox, const Numbers& numbers) {
  SandSurface& surface = sandbox.surface_;
  TriangleMesh& mesh = surface.mesh_.mesh_;
  surface.ledger_ = {};
  surface.ledger_.enter(-numbers.owed);
  surface.moved_ = numbers.moved;
  sandbox.settings_ = numbers.settings;
  sandbox.slides_.setRepose(reposeOf(numbers.settings.dryAngle, numbers.settings.moisture));
  sandbox.slides_.count_ = numbers.slides;
  sandbox.cleanUp_.count_ = numbers.cleanUp;
  sandbox.slides_.position_ = numbers.slidingPosition;
  sandbox.removable_ = numbers.removable;
  sandbox.round_ = numbers.cleaningRound;
  sandbox.unsettled_ = numbers.unsettled != 0;
  mesh.freeVertices_ = numbers.freeVertices;
  mesh.freeTriangles_ = numbers.freeTriangles;
  surface.mesh_.table_.used_ = numbers.constraints;
  mesh.freeVertex_ = numbers.freeVertex;
  mesh.freeTriangle_ = numbers.freeTriangle;
  surface.mesh_.grid_.shift_ = numbers.cellShift;
  surface.mesh_.grid_.columns_ = static_cast<std::size_t>(numbers.frame.width >> numbers.cellShift) + 1;
  sandbox.stamper_.nextId_ = numbers.nextId;
  sandbox.stamper_.near_ = numbers.near;
  sandbox.keptId_ = numbers.keptId;
}

SandState::SandState(const Sandbox& sandbox) : numbers_(numbersOf(sandbox)) {
  assert(!sandbox.surface_.cells_.hasFence());
  sections_[kNumbers] = std::as_bytes(std::span(&numbers_, 1));
  forEachArray(sandbox, [this](Section section, const auto& array) {
    sections_[section] = std::as_bytes(std::span(array.data(), array.size()));
  });
}

void SandState::noteSlots(Sandbox& sandbox, Section section, std::size_t from, std::size_t end) {
  const bool ofVertices = section == kVertices || section == kHeights || section == kLoose;
  if (!ofVertices && section != kTriangles) return;
  ChangeList& list = ofVertices ? sandbox.changedVertices_ : sandbox.changedTriangles_;
  for (std::size_t slot = from; slot < end; ++slot) list.add(static_cast<std::uint32_t>(slot));
}

template <class Array>
void SandState::assignArray(Sandbox& sandbox, Array& array, Section section,
                            std::span<const std::byte> bytes) {
  using Element = std::remove_cvref_t<decltype(array[0])>;
  static_assert(kPageBytes % sizeof(Element) == 0);
  constexpr std::size_t kPage = kPageBytes / sizeof(Element);
  const std::size_t size = bytes.size() / sizeof(Element), before = array.size();
  if constexpr (std::is_same_v<Array, CompactArray<Element>>) {
    array.resize(size, Element{});
  } else {
    array.resize(size);
  }
  for (std::size_t from = 0; from < size; from += kPage) {
    const std::size_t end = std::min(from + kPage, size), length = (end - from) * sizeof(Element);
    const std::byte* page = bytes.data() + from * sizeof(Element);
    if (std::memcmp(&array[from], page, length) == 0) continue;
    std::memcpy(static_cast<void*>(&array[from]), page, length);
    noteSlots(sandbox, section, from, end);
  }
  noteSlots(sandbox, section, size, before);
}

/// Marks what is listed. False where something is listed twice.
bool SandState::mark(Sandbox& sandbox) {
  bool once = true;
  const auto all = [&once](MarkSet& marks, std::span<const std::uint32_t> ids) {
    for (const std::uint32_t id : ids) once = marks.insert(id) && once;
  };
  Slides& slides = sandbox.slides_;
  slides.waiting_ = {};
  all(slides.waiting_, std::span(slides.now_).subspan(slides.position_));
  all(slides.waiting_, slides.next_);
  sandbox.cleanUp_.waiting_ = {};
  all(sandbox.cleanUp_.waiting_, sandbox.cleanUp_.queue_);
  for (ChangeList* list : {&sandbox.stamper_.allRims_, &sandbox.stamper_.allInside_}) {
    list->marks_ = {};
    all(list->marks_, list->ids_);
  }
  return once;
}

/// All but the marks of what is listed.
void SandState::copy(Sandbox& sandbox, const Sections& sections) {
  Numbers numbers;
  std::memcpy(&numbers, sections[kNumbers].data(), sizeof numbers);
  assert(numbers.frame == sandbox.surface_.mesh_.frame_);
  assignNumbers(sandbox, numbers);
  forEachArray(sandbox, [&](Section section, auto& array) {
    assignArray(sandbox, array, section, sections[section]);
  });
}

/// Adds the triangles at changed vertices, as every change does. The mesh must be proved.
void SandState::noteStars(Sandbox& sandbox) {
  const Triangulation& mesh = sandbox.surface_.mesh();
  for (const VertexId v : sandbox.changedVertices().ids()) {
    if (!mesh.isVertex(v)) continue;
    mesh.forEachCorner(v, [&](Link at) { sandbox.changedTriangles_.add(at.triangle()); });
  }
}

void SandState::assign(Sandbox& sandbox, const Sections& sections) {
  copy(sandbox, sections);
  mark(sandbox);
  noteStars(sandbox);
}

Result<Sandbox> SandState::sandboxOf(const Sections& sections) {
  Numbers numbers;
  if (sections[kNumbers].size() != sizeof numbers) return Error{"its numbers are not as many as expected"};
  std::memcpy(&numbers, sections[kNumbers].data(), sizeof numbers);
  for (const auto& checked : {checkNumbers, checkSizes, checkLists}) {
    if (const Result<void> fine = checked(numbers, sections); !fine) return fine.error();
  }
  Sandbox sandbox(SandSurface(numbers.frame, 0.0, 0.0), numbers.settings);
  copy(sandbox, sections);
  sandbox.changedVertices_ = sandbox.changedTriangles_ = {};
  if (!mark(sandbox)) return Error{"something in it waits twice"};
  if (const Result<void> fine = check(sandbox); !fine) return fine.error();
  return sandbox;
}

}  // namespace teren
