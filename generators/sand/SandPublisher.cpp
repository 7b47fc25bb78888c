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

std::array<std::int16_t, 2> packed(const Arrow& sum) noexcept {
  const double length = lengthOf(sum);
  const auto part = [length](double of) {
    return static_cast<std::int16_t>(std::floor(of / length * 32767.0 + 0.5));
  };
  return {part(sum[0]), part(sum[1])};
}

/// The mean of the normals of the faces at v, weighted by their angles there.
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
    const double cosine = (b[0] * c[0] + b[1] * c[1] + b[2] * c[2]) / (lengthOf(b) * lengthOf(c));
    const double weight = angleOf(cosine) / lengthOf(cross);
    for (std::size_t i = 0; i < 3; ++i) sum[i] += weight * cross[i];
  });
  return packed(sum);
}

SandVertex vertexOf(const SandSurface& surface, VertexId v) {
  if (!surface.mesh().isVertex(v)) return {};
  return {surface.mesh().point(v), static_cast<float>(surface.mesh().height(v)),
          static_cast<float>(metresFromTicks(surface.loose(v))), normalAt(surface, v)};
}

void copyTriangle(const Triangulation& mesh, TriangleId t, SandTrianglePage& page) {
  const std::size_t slot = t % SandTrianglePage::kSlots;
  page.corners[slot] = {0, 0, 0};
  page.flags[slot] = 0;
  if (!mesh.isTriangle(t)) return;
  page.corners[slot] = mesh.corners(t);
  page.flags[slot] = SandTrianglePage::kIsThere;
  for (int i = 0; i < 3; ++i) {
    if (mesh.isConstrained(t, i)) page.flags[slot] |= static_cast<std::uint8_t>(1 << i);
  }
}

/// How many pages so many slots need.
template <class Page>
std::size_t pagesFor(std::size_t slots) noexcept {
  return (slots + Page::kSlots - 1) / Page::kSlots;
}

/// Writes a page unless that is what is there.
template <class Page>
void replace(PageEditor<Page>& editor, std::size_t i, const Page& page) {
  if (i >= editor.table().size() || !(editor.table()[i] == page)) editor.edit(i) = page;
}

}  // namespace

std::shared_ptr<const SandSnapshot> SandPublisher::publish(Sandbox& sandbox) {
  if (!published_) return publishAll(sandbox);
  const SandSurface& surface = sandbox.surface();
  const Triangulation& mesh = surface.mesh();
  for (const TriangleId t : sandbox.changedTriangles().ids()) {
    copyTriangle(mesh, t, triangles_.edit(t / SandTrianglePage::kSlots));
    if (!mesh.isTriangle(t)) continue;
    for (const VertexId v : mesh.corners(t)) refreshed_.add(v);
  }
  for (const VertexId v : sandbox.changedVertices().ids()) refreshed_.add(v);
  for (const VertexId v : refreshed_.ids()) {
    vertices_.edit(v / SandVertexPage::kSlots).vertices[v % SandVertexPage::kSlots] = vertexOf(surface, v);
  }
  refreshed_.clear();
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
  for (std::size_t i = 0; i < vertexPages; ++i) {
    SandVertexPage page;
    for (std::size_t k = 0; k < SandVertexPage::kSlots; ++k) {
      page.vertices[k] = vertexOf(surface, static_cast<VertexId>(i * SandVertexPage::kSlots + k));
    }
    replace(vertices_, i, page);
  }
  for (std::size_t i = 0; i < trianglePages; ++i) {
    SandTrianglePage page;
    for (std::size_t k = 0; k < SandTrianglePage::kSlots; ++k) {
      copyTriangle(mesh, static_cast<TriangleId>(i * SandTrianglePage::kSlots + k), page);
    }
    replace(triangles_, i, page);
  }
  for (std::size_t i = 0; i < trianglePages; ++i)
    bound(i);  // heights may have changed where triangles did not
  published_ = true;
  return finish(sandbox);
}

/// Takes the bounds of a page's triangles anew, and, where they changed, those of all pages beside it.
void SandPublisher::bound(std::size_t trianglePage) {
  const SandTrianglePage& page = triangles_.table()[trianglePage];
  SandBounds bounds;
  for (std::size_t k = 0; k < SandTrianglePage::kSlots; ++k) {
    if (page.flags[k] == 0) continue;
    for (const VertexId v : page.corners[k]) {
      bounds.extendBy(vertices_.table()[v / SandVertexPage::kSlots].vertices[v % SandVertexPage::kSlots]);
    }
  }
  const std::size_t i = trianglePage / SandBoundsPage::kSlots, k = trianglePage % SandBoundsPage::kSlots;
  if (i < bounds_.table().size() && bounds_.table()[i].pages[k] == bounds) return;
  SandBoundsPage& all = bounds_.edit(i);
  all.pages[k] = bounds;
  all.all = {};
  for (const SandBounds& one : all.pages) all.all.extendBy(one);
}

std::shared_ptr<const SandSnapshot> SandPublisher::finish(Sandbox& sandbox) {
  for (const std::size_t page : triangles_.edited()) bound(page);
  const Triangulation& mesh = sandbox.surface().mesh();
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
  return snapshot;
}

std::size_t SandPublisher::bytes() const noexcept {
  return vertices_.bytes() + triangles_.bytes() + bounds_.bytes() + refreshed_.bytes();
}

}  // namespace teren
