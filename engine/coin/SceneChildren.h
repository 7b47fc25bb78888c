// The hidden children of a SoTerrain: one shape for each mesh of the snapshot it shows.
#pragma once

#include <memory>

#include <Inventor/SbBox3f.h>
#include <Inventor/misc/SoChildList.h>

#include "teren/Scene.h"

#include "coin/MovedVertices.h"
#include "coin/ScenePlacement.h"

class SoAction;
class SoNode;

namespace teren {

/// Child k shows mesh k of the scene, always. The parent outlives this object.
class SceneChildren {
 public:
  explicit SceneChildren(SoNode& parent);
  ~SceneChildren();
  SceneChildren(const SceneChildren&) = delete;
  SceneChildren& operator=(const SceneChildren&) = delete;

  /// Never null.
  const std::shared_ptr<const Scene>& scene() const noexcept { return scene_; }
  SoChildList* list() noexcept { return &list_; }

  /// Shows another snapshot of the same engine: makes and drops only what differs. Notifies nobody.
  void show(std::shared_ptr<const Scene> next);

  /// How vertices were in the last picture, for what is picked.
  void setMoved(const MovedVertices& moved) { *moved_ = moved; }
  const MovedVertices& moved() const noexcept { return *moved_; }

  /// Around all meshes, on their measured heights; empty without any.
  SbBox3f box(const ScenePlacement& placement) const;

  /// Applies an action to the children its path leads through, or to all, each moved into its place.
  void traverse(SoAction* action, const ScenePlacement& placement);
  void traverseChild(SoAction* action, int index, const ScenePlacement& placement);
  /// How far a child is moved.
  SbVec3f offset(int index, const ScenePlacement& placement) const;

 private:
  SoNode& parent_;
  std::shared_ptr<const Scene> scene_;
  SoChildList list_;
  std::shared_ptr<MovedVertices> moved_ = std::make_shared<MovedVertices>();  // a child may live longer
};

}  // namespace teren
