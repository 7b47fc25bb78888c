#include "stream/MeshPages.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "teren/Scene.h"

namespace teren {

MeshList::Page& MeshPages::writable(std::size_t page) {
  std::shared_ptr<Page>& held = pages_[page];
  if (held->edition != edition_) {
    held = std::make_shared<Page>(*held);
    held->edition = edition_;
  }
  return *held;
}

void MeshPages::add(std::shared_ptr<const Mesh> mesh) {
  if (pages_.empty() || pages_.back()->count == Page::kMost) {
    pages_.push_back(std::make_shared<Page>());
    pages_.back()->edition = edition_;
  }
  Page& page = writable(pages_.size() - 1);
  assert(page.count == 0 || page.ids[page.count - 1] < mesh->id);
  page.ids[page.count] = mesh->id;
  page.meshes[page.count++] = std::move(mesh);
  ++size_;
}

void MeshPages::remove(std::uint64_t id) {
  const auto beyond = std::upper_bound(
      pages_.begin(), pages_.end(), id,
      [](std::uint64_t wanted, const std::shared_ptr<Page>& page) { return wanted < page->ids[0]; });
  assert(beyond != pages_.begin());
  const auto index = static_cast<std::size_t>(beyond - pages_.begin()) - 1;
  Page& page = writable(index);
  const auto ids = page.ids.begin();
  const auto at = std::lower_bound(ids, ids + static_cast<std::ptrdiff_t>(page.count), id) - ids;
  assert(static_cast<std::size_t>(at) < page.count && page.ids[static_cast<std::size_t>(at)] == id);
  const auto last = static_cast<std::ptrdiff_t>(page.count);
  std::move(ids + at + 1, ids + last, ids + at);
  std::move(page.meshes.begin() + at + 1, page.meshes.begin() + last, page.meshes.begin() + at);
  page.meshes[--page.count].reset();
  --size_;
  if (page.count == 0) {
    pages_.erase(pages_.begin() + static_cast<std::ptrdiff_t>(index));
  } else {
    uniteWithNext(index);
  }
  if (index > 0) uniteWithNext(index - 1);
}

/// Where both together are half a page at most: so there are never more pages than a quarter of the meshes.
void MeshPages::uniteWithNext(std::size_t page) {
  if (page + 1 >= pages_.size() || pages_[page]->count + pages_[page + 1]->count > Page::kMost / 2) return;
  Page& into = writable(page);
  const Page& from = *pages_[page + 1];
  for (std::size_t k = 0; k < from.count; ++k) {
    into.ids[into.count] = from.ids[k];
    into.meshes[into.count++] = from.meshes[k];
  }
  pages_.erase(pages_.begin() + static_cast<std::ptrdiff_t>(page) + 1);
}

MeshList MeshPages::snapshot() {
  ++edition_;
  return MeshList(std::span<const std::shared_ptr<Page>>(pages_));
}

}  // namespace teren
