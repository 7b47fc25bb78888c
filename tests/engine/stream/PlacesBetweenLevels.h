// Where meshes of several levels meet: what tests of edited ground dig at.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "teren/Scene.h"

namespace teren::test {

using SamplePlace = std::pair<std::int64_t, std::int64_t>;  ///< column, row in level-0 samples

inline SamplePlace placeOf(const Mesh& mesh, const SurfaceVertex& vertex) {
  return {mesh.originColumn + (std::int64_t{vertex.column} << mesh.level),
          mesh.originRow + (std::int64_t{vertex.row} << mesh.level)};
}

/// The places of vertices that meshes of nodes of different levels share.
inline std::vector<SamplePlace> placesBetweenLevels(const Scene& scene) {
  std::map<SamplePlace, std::set<int>> levels;
  for (const auto& mesh : scene.meshes())
    for (const SurfaceVertex& vertex : mesh->vertices) levels[placeOf(*mesh, vertex)].insert(mesh->nodeLevel);
  std::vector<SamplePlace> places;
  for (const auto& [place, there] : levels)
    if (there.size() > 1) places.push_back(place);
  return places;
}

}  // namespace teren::test
