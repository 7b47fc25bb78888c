#include "generators/sand/SandPublisher.h"

#include <array>
#include <cmath>
#include <utility>

namespace teren {
namespace {

using Arrow = std::array<double, 3>;

/// The angle [rad] whose cosine is given, within 7e-5 (Abramowitz and Stegun 1964, 4.4.45).
double angleOf(double cosine) noexcept {
  constexpr double kPi = 3.14159265358979323846;
  const double x = std::fmin(std::fabs(cosine), 1.0);
  const double angle = std::sqrt(1.0 - x) * (1.5707288 + x * (-0.2121144 + x * (0.0742610 - x * 0.0187293)));
  return cosine < 0.0 ? kPi - angle : angle;
}

double lengthOf(const Arrow& a) noexcept {
  return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}

/// Upwards where there is no direction.
std::array<std::int16_t, 2> packed(const Arrow& sum) noexcept {
  const double length = lengthOf(sum);
  if (!(length > 0.0)) return {0, 0};
  const auto part = [length](double of) {
    return static_cast<std::int16_t>(std::floor(of / length * 32767.0 + 0.5));
  };
  return {part(sum[0]), part(sum[1])};
}

/// The mean of the normals of the faces at v, weighted by their angles there, but for faces too thin to have
/// any.
std::array<std::int16_t, 2> normalAt(const SandSurface& surface, VertexId v) {
  const Triangulation& mesh = surface.mesh();
  const LatticePoint p = mesh.point(v);
  const double height = mesh.height(v), step = surface.step();
  const auto arrowTo = [&](VertexId n) {
    const LatticePoint q = mesh.point(n);
    return Arrow{(q.x - p.x) * step, (q.y - p.y) * step, mesh.height(n) - height};
  };
  Arrow sum{0.0, 0.0, 0.0};
  mesh.forEachCorner(v, [&](Link at) {
    const std::array<VertexId, 3>& corners = mesh.corners(at.triangle());
    const Arrow b = arrowTo(corners[following(at.side())]), c = arrowTo(corners[preceding(at.side())]);
    const Arrow cross{b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0]};
    const double doubledArea = lengthOf(cross);
    if (!(doubledArea > 0.0)) return;
    const double cosine = (b[0] * c[0] + b[1] * c[1] + b[2] * c[2]) / (lengthOf(b) * lengthOf(c));
    const double weight = angleOf(cosine) / doubledArea;
    for (std::size_t i = 0; i < 3; ++i) sum[i] += weight * cross[i];
  });
  return packed(sum);
}

/// A vertex but for its normal.
SandVertex plainVertex(const SandSurface& surface, VertexId v) {
  if (!surface.mesh().isVertex(v)) return {};
  return {surface.mesh().point(v),
          static_cast<float>(surface.mesh().height(v)),
          static_cast<float>(metresFromTicks(surface.loose(v))),
          {}};
}

/// A triangle as a page of them has it.
struct Copy {
  std::array<VertexId, 3> corners{0, 0, 0};
  std::uint8_t flags = 0;
  friend bool operator==(const Copy&, const Copy&) = default;
};

Copy copyOf(const Triangulation& mesh, TriangleId t) {
  if (!mesh.isTriangle(t)) return {};
  Copy copy{mesh.corners(t), SandTrianglePage::kIsThere};
  for (int i = 0; i < 3; ++i) {
    if (mesh.isConstrained(t, i)) copy.flags |= static_cast<std::uint8_t>(1 << i);
  }
  return copy;
}

/// The page and the place in it of a slot.
template <class Page>
struct At {
  explicit At(std::size_t id) noexcept : page(id / Page::kSlots), slot(id % Page::kSlots) {}
  std::size_t page, slot;
};

/// How many pages so many slots need.
template <class Page>
std::size_t pagesFor(std::size_t slots) noexcept {
  return (slots + Page::kSlots - 1) / Page::kSlots;
}

}  // namespace

std::shared_ptr<const SandSnapshot> SandPublisher::publish(Sandbox& sandbox) {
  if (!last_) return publishAll(sandbox);
  if (sandbox.changedTriangles().ids().empty() && sandbox.changedVertices().ids().empty()) return last_;
  const Triangulation& mesh = sandbox.surface().mesh();
  for (const TriangleId t : sandbox.changedTriangles().ids()) take(mesh, t);
  for (const VertexId v : sandbox.changedVertices().ids()) refreshed_.add(v);
  return finish(sandbox);
}

std::shared_ptr<const SandSnapshot> SandPublisher::publishAll(Sandbox& sandbox) {
  const SandSurface& surface = sandbox.surface();
  const Triangulation& mesh = surface.mesh();
  const std::size_t vertexPages = pagesFor<SandVertexPage>(mesh.vertexSlots());
  const std::size_t trianglePages = pagesFor<SandTrianglePage>(mesh.triangleSlots());
  vertices_.shrink(vertexPages);
  triangles_.shrink(trianglePages);
  bounds_.shrink(pagesFor<SandBoundsPage>(trianglePages));
  const std::size_t boundsSlots = bounds_.table().size() * SandBoundsPage::kSlots;
  for (std::size_t page = trianglePages; page < boundsSlots; ++page) setBounds(page, {});
  for (TriangleId t = 0; t < trianglePages * SandTrianglePage::kSlots; ++t) {
    const At<SandTrianglePage> at(t);
    if (at.page < triangles_.table().size()) {
      const SandTrianglePage& page = triangles_.table()[at.page];
      if (Copy{page.corners[at.slot], page.flags[at.slot]} == copyOf(mesh, t)) continue;
    }
    take(mesh, t);
  }
  const bool sameStep = last_ && last_->frame().step == surface.step();
  for (VertexId v = 0; v < vertexPages * SandVertexPage::kSlots; ++v) {
    const At<SandVertexPage> at(v);
    if (at.page < vertices_.table().size()) {
      SandVertex last = vertices_.table()[at.page].vertices[at.slot];
      last.normal = {};
      if (sameStep && last == plainVertex(surface, v)) continue;
    }
    refreshed_.add(v);
    if (!last_ || !mesh.isVertex(v)) continue;
    mesh.forEachCorner(v, [&](Link corner) { take(mesh, corner.triangle()); });
  }
  std::shared_ptr<const SandSnapshot> snapshot = finish(sandbox);
  refreshed_ = {};  // as long as the mesh perhaps
  return snapshot;
}

/// Copies a triangle; its corners may look different.
void SandPublisher::take(const Triangulation& mesh, TriangleId t) {
  const At<SandTrianglePage> at(t);
  SandTrianglePage& page = triangles_.edit(at.page);
  const Copy copy = copyOf(mesh, t);
  page.corners[at.slot] = copy.corners;
  page.flags[at.slot] = copy.flags;
  if (copy.flags == 0) return;
  for (const VertexId v : copy.corners) refreshed_.add(v);
}

/// Takes the bounds of a page's triangles anew.
void SandPublisher::bound(std::size_t trianglePage) {
  const SandTrianglePage& page = triangles_.table()[trianglePage];
  SandBounds bounds;
  for (std::size_t k = 0; k < SandTrianglePage::kSlots; ++k) {
    if (page.flags[k] == 0) continue;
    for (const VertexId v : page.corners[k]) {
      bounds.extendBy(vertices_.table()[v / SandVertexPage::kSlots].vertices[v % SandVertexPage::kSlots]);
    }
  }
  setBounds(trianglePage, bounds);
}

/// Where a page's bounds are others than before, takes those of all pages beside it anew too.
void SandPublisher::setBounds(std::size_t trianglePage, const SandBounds& bounds) {
  const std::size_t i = trianglePage / SandBoundsPage::kSlots, k = trianglePage % SandBoundsPage::kSlots;
  if (i < bounds_.table().size() && bounds_.table()[i].pages[k] == bounds) return;
  SandBoundsPage& all = bounds_.edit(i);
  all.pages[k] = bounds;
  all.all = {};
  for (const SandBounds& one : all.pages) all.all.extendBy(one);
}

std::shared_ptr<const SandSnapshot> SandPublisher::finish(Sandbox& sandbox) {
  const SandSurface& surface = sandbox.surface();
  const Triangulation& mesh = surface.mesh();
  for (const VertexId v : refreshed_.ids()) {
    const At<SandVertexPage> at(v);
    SandVertex& copy = vertices_.edit(at.page).vertices[at.slot];
    copy = plainVertex(surface, v);
    if (copy.isThere()) copy.normal = normalAt(surface, v);
  }
  refreshed_.clear();
  for (const std::size_t page : triangles_.edited()) bound(page);
  auto snapshot = std::make_shared<SandSnapshot>();
  snapshot->frame_ = mesh.frame();
  snapshot->vertexCount_ = mesh.vertexCount();
  snapshot->triangleCount_ = mesh.triangleCount();
  snapshot->vertexSlots_ = mesh.vertexSlots();
  snapshot->triangleSlots_ = mesh.triangleSlots();
  snapshot->vertices_ = vertices_.table();
  snapshot->triangles_ = triangles_.table();
  snapshot->bounds_ = bounds_.table();
  vertices_.seal();
  triangles_.seal();
  bounds_.seal();
  sandbox.forgetChanges();
  last_ = std::move(snapshot);
  return last_;
}

std::size_t SandPublisher::bytes() const noexcept {
  return vertices_.bytes() + triangles_.bytes() + bounds_.bytes() + refreshed_.bytes();
}

}  // namespace teren
