#include "teren/Scene.h"

namespace teren {

std::size_t Scene::triangles() const noexcept {
  std::size_t sum = 0;
  for (const auto& mesh : meshes_) sum += mesh->indices->size() / 3;
  return sum;
}

SceneDifference difference(const Scene& before, const Scene& after) {
  SceneDifference result;
  auto old = before.meshes().begin();
  auto now = after.meshes().begin();
  while (old != before.meshes().end() || now != after.meshes().end()) {
    if (now == after.meshes().end() || (old != before.meshes().end() && (*old)->id < (*now)->id)) {
      result.removed.push_back((*old++)->id);
    } else if (old == before.meshes().end() || (*now)->id < (*old)->id) {
      result.added.push_back(*now++);
    } else {
      ++old;
      ++now;
    }
  }
  return result;
}

}  // namespace teren
