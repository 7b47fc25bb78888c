#include "coin/SceneChildren.h"

#include <cassert>
#include <cstdint>
#include <utility>

#include <Inventor/actions/SoAction.h>
#include <Inventor/elements/SoModelMatrixElement.h>
#include <Inventor/nodes/SoNode.h>

#include "coin/SoTerrainMesh.h"

namespace teren {
namespace {

std::uint64_t idOf(const SoChildList& list, int index) {
  return static_cast<const SoTerrainMesh*>(list[index])->mesh()->id;
}

/// Hundreds of children may change at once; whoever watches the parent need not hear of each.
class Silence {
 public:
  explicit Silence(SoNode& node) : node_(node), before_(node.enableNotify(FALSE)) {}
  ~Silence() { node_.enableNotify(before_); }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  SoNode& node_;
  SbBool before_;
};

}  // namespace

SceneChildren::SceneChildren(SoNode& parent)
    : parent_(parent), scene_(std::make_shared<const Scene>()), list_(&parent) {}

SceneChildren::~SceneChildren() {
  const Silence silence(parent_);
  list_.truncate(0);
}

void SceneChildren::show(std::shared_ptr<const Scene> next) {
  const Silence silence(parent_);
  const SceneDifference change = difference(*scene_, *next);  // in the order of the ids, like the list
  int index = list_.getLength();
  for (auto id = change.removed.rbegin(); id != change.removed.rend(); ++id) {
    do {
      --index;
    } while (idOf(list_, index) != *id);
    list_.remove(index);
  }
  index = 0;
  for (const std::shared_ptr<const Mesh>& mesh : change.added) {
    while (index < list_.getLength() && idOf(list_, index) < mesh->id) ++index;
    list_.insert(new SoTerrainMesh(mesh, next->spacing(), moved_), index);
  }
  scene_ = std::move(next);
  assert(static_cast<std::size_t>(list_.getLength()) == scene_->meshes().size());
}

SbBox3f SceneChildren::box(const ScenePlacement& placement) const {
  SbBox3f box;
  for (const std::shared_ptr<const Mesh>& mesh : scene_->meshes()) box.extendBy(placement.box(*mesh));
  return box;
}

void SceneChildren::traverse(SoAction* action, const ScenePlacement& placement) {
  int count = 0;
  const int* indices = nullptr;
  if (action->getPathCode(count, indices) == SoAction::IN_PATH) {
    for (int k = 0; k < count; ++k) traverseChild(action, indices[k], placement);
    return;
  }
  for (int index = 0; index < list_.getLength() && !action->hasTerminated(); ++index) {
    traverseChild(action, index, placement);
  }
}

void SceneChildren::traverseChild(SoAction* action, int index, const ScenePlacement& placement) {
  SoState* state = action->getState();
  state->push();
  SoModelMatrixElement::translateBy(state, &parent_, offset(index, placement));
  list_.traverse(action, index);
  state->pop();
}

SbVec3f SceneChildren::offset(int index, const ScenePlacement& placement) const {
  const Mesh& mesh = *scene_->meshes()[static_cast<std::size_t>(index)];
  return SbVec3f(placement.position(Sample{mesh.originColumn, mesh.originRow}));
}

}  // namespace teren
