// What CGAL makes of the same vertices and the same constrained edges.
#pragma once

#include <string>

#include "generators/tin/Triangulation.h"

namespace teren::test {

/// Builds CGAL's constrained Delaunay triangulation from a mesh's vertices and constrained edges, in an order
/// of its own, and compares the edges: they must be the same, except that where four vertices lie on one
/// circle either diagonal is right. Empty, or what differs.
std::string differenceFromCgal(const Triangulation& mesh);

}  // namespace teren::test
