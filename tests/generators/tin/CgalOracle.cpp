#include "tests/generators/tin/CgalOracle.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <algorithm>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace teren::test {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<VertexId, Kernel>;
using FaceBase = CGAL::Constrained_triangulation_face_base_2<Kernel>;
using Oracle =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel,
                                               CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>>;

std::string edgeName(VertexId a, VertexId b) {
  return std::to_string(a) + " - " + std::to_string(b);
}

/// The corners opposite the edge between corners i + 1 and i + 2 of t lie on one circle with its ends.
bool isTie(const Triangulation& mesh, TriangleId t, int i) {
  const TriangleId u = mesh.neighbour(t, i);
  if (u == kNoTriangle) return false;
  const std::array<VertexId, 3>& here = mesh.corners(t);
  VertexId opposite = kNoVertex;
  for (const VertexId v : mesh.corners(u)) {
    if (v != here[following(i)] && v != here[preceding(i)]) opposite = v;
  }
  return inCircleDeterminant(mesh.point(here[0]), mesh.point(here[1]), mesh.point(here[2]),
                             mesh.point(opposite)) == 0;
}

}  // namespace

std::string differenceFromCgal(const Triangulation& mesh) {
  Oracle oracle;
  std::vector<Oracle::Vertex_handle> handles(mesh.vertexSlots());
  const auto insert = [&](VertexId v, Oracle::Face_handle hint) {
    handles[v] = oracle.insert({mesh.point(v).x, mesh.point(v).y}, hint);
    handles[v]->info() = v;
    return handles[v]->face();
  };
  Oracle::Face_handle hint;
  for (VertexId corner = 0; corner < 4; ++corner) hint = insert(corner, hint);
  for (VertexId v = mesh.vertexSlots(); v-- > 4;) {  // not in the order in which they came
    if (mesh.isVertex(v)) hint = insert(v, hint);
  }
  mesh.forEachConstraint(
      [&](VertexId a, VertexId b, std::uint32_t) { oracle.insert_constraint(handles[a], handles[b]); });
  if (oracle.number_of_vertices() != mesh.vertexCount()) return "another number of vertices";
  if (oracle.number_of_faces() != mesh.triangleCount()) return "another number of triangles";
  std::unordered_map<std::uint64_t, bool> constrained;  // by edge
  const auto key = [](VertexId a, VertexId b) {
    return (static_cast<std::uint64_t>(std::min(a, b)) << 32) | std::max(a, b);
  };
  for (const Oracle::Edge& edge : oracle.finite_edges()) {
    const auto& [face, side] = edge;
    constrained[key(face->vertex(oracle.cw(side))->info(), face->vertex(oracle.ccw(side))->info())] =
        face->is_constrained(side);
  }
  for (TriangleId t = 0; t < mesh.triangleSlots(); ++t) {
    if (!mesh.isTriangle(t)) continue;
    for (int i = 0; i < 3; ++i) {
      const VertexId a = mesh.corners(t)[following(i)], b = mesh.corners(t)[preceding(i)];
      const auto found = constrained.find(key(a, b));
      if (found == constrained.end()) {
        if (mesh.constraint(a, b) || !isTie(mesh, t, i)) return "no edge " + edgeName(a, b);
      } else if (found->second != mesh.constraint(a, b).has_value()) {
        return "another constraint " + edgeName(a, b);
      }
    }
  }
  return {};
}

}  // namespace teren::test
