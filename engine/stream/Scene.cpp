#include "teren/Scene.h"

#include <span>

namespace teren {

namespace {

/// A mesh of a list, found by its page.
class Cursor {
 public:
  explicit Cursor(const MeshList& meshes) : pages_(meshes.pages()) {}

  bool isAtEnd() const noexcept { return page_ == pages_.size(); }
  std::uint64_t id() const noexcept { return pages_[page_].page->ids[at_]; }
  const std::shared_ptr<const Mesh>& mesh() const noexcept { return pages_[page_].page->meshes[at_]; }
  void goOn() noexcept {
    if (++at_ == pages_[page_].page->count) goToNextPage();
  }
  void goToNextPage() noexcept {
    ++page_;
    at_ = 0;
  }
  /// Whether both are about to read the same page.
  friend bool beginTheSame(const Cursor& a, const Cursor& b) noexcept {
    return a.at_ == 0 && b.at_ == 0 && a.pages_[a.page_].page == b.pages_[b.page_].page;
  }

 private:
  std::span<const MeshList::Place> pages_;
  std::size_t page_ = 0, at_ = 0;
};

}  // namespace

std::size_t Scene::triangles() const noexcept {
  std::size_t sum = 0;
  for (const auto& mesh : meshes_) sum += mesh->indices->size() / 3;
  return sum;
}

SceneDifference difference(const Scene& before, const Scene& after) {
  SceneDifference result;
  Cursor old(before.meshes()), now(after.meshes());
  while (!old.isAtEnd() || !now.isAtEnd()) {
    if (now.isAtEnd() || (!old.isAtEnd() && old.id() < now.id())) {
      result.removed.push_back(old.id());
      old.goOn();
    } else if (old.isAtEnd() || now.id() < old.id()) {
      result.added.push_back(now.mesh());
      now.goOn();
    } else if (beginTheSame(old, now)) {
      old.goToNextPage();
      now.goToNextPage();
    } else {
      old.goOn();
      now.goOn();
    }
  }
  return result;
}

}  // namespace teren
