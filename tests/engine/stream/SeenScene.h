// A snapshot as an eye sees it, every vertex moved by a plain replica of what the vertex shader does.
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "teren/Morph.h"
#include "teren/Scene.h"

namespace teren::test {

/// An eye in metres from the world's middle.
struct EyePoint {
  double east = 0.0, north = 0.0, height = 0.0;
};

/// A level-0 sample.
using SamplePlace = std::pair<std::int64_t, std::int64_t>;

inline SamplePlace placeOf(const Mesh& mesh, const SurfaceVertex& vertex) {
  const std::int64_t stride = std::int64_t{1} << mesh.level;
  return {mesh.originColumn + vertex.column * stride, mesh.originRow + vertex.row * stride};
}

/// As the shader computes it, from the sample next to the eye.
inline float distanceTo(const Scene& scene, const EyePoint& eye, const SamplePlace& place, float height) {
  const auto spacing = static_cast<float>(scene.spacing());
  const auto column = static_cast<std::int64_t>(std::floor(eye.east / scene.spacing()));
  const auto row = static_cast<std::int64_t>(std::floor(eye.north / scene.spacing()));
  const auto east = static_cast<float>(eye.east - static_cast<double>(column) * scene.spacing());
  const auto north = static_cast<float>(eye.north - static_cast<double>(row) * scene.spacing());
  const float x = static_cast<float>(place.first - column) * spacing - east;
  const float y = static_cast<float>(place.second - row) * spacing - north;
  const float z = height - static_cast<float>(eye.height);
  return std::sqrt(x * x + y * y + z * z);
}

inline float drawnHeight(const Scene& scene, const EyePoint& eye, const Mesh& mesh,
                         const SurfaceVertex& vertex, const Morph& morph) {
  return morph.height(vertex, distanceTo(scene, eye, placeOf(mesh, vertex), vertex.height));
}
inline float drawnHeight(const Scene& scene, const EyePoint& eye, const Mesh& mesh,
                         const SurfaceVertex& vertex) {
  return drawnHeight(scene, eye, mesh, vertex, scene.morph());
}

/// The scene with every vertex lying where it is drawn.
inline std::shared_ptr<const Scene> sceneSeenFrom(const Scene& scene, const EyePoint& eye,
                                                  const Morph& morph) {
  std::vector<std::shared_ptr<const Mesh>> meshes;
  for (const auto& mesh : scene.meshes()) {
    auto moved = std::make_shared<Mesh>(*mesh);
    for (SurfaceVertex& vertex : moved->vertices) {
      vertex.coarserHeight = vertex.height = drawnHeight(scene, eye, *mesh, vertex, morph);
    }
    meshes.push_back(std::move(moved));
  }
  return std::make_shared<const Scene>(scene.serial(), scene.spacing(), std::move(meshes));
}
inline std::shared_ptr<const Scene> sceneSeenFrom(const Scene& scene, const EyePoint& eye) {
  return sceneSeenFrom(scene, eye, scene.morph());
}

}  // namespace teren::test
