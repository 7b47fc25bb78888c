#include "teren/MeshList.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "teren/Scene.h"

namespace teren {

MeshList::MeshList(std::span<const value_type> meshes) : size_(meshes.size()) {
  places_.reserve((meshes.size() + Page::kMost - 1) / Page::kMost);
  for (std::size_t first = 0; first < meshes.size(); first += Page::kMost) {
    auto page = std::make_shared<Page>();
    page->count = std::min(Page::kMost, meshes.size() - first);
    for (std::size_t k = 0; k < page->count; ++k) {
      page->meshes[k] = meshes[first + k];
      page->ids[k] = meshes[first + k]->id;
    }
    places_.push_back({std::move(page), first});
  }
}

MeshList::MeshList(std::span<const std::shared_ptr<Page>> pages) {
  places_.reserve(pages.size());
  for (const std::shared_ptr<Page>& page : pages) {
    assert(page->count > 0);
    places_.push_back({page, size_});
    size_ += page->count;
  }
}

const MeshList::value_type& MeshList::operator[](std::size_t index) const noexcept {
  assert(index < size_);
  const auto beyond =
      std::upper_bound(places_.begin(), places_.end(), index,
                       [](std::size_t wanted, const Place& place) { return wanted < place.first; });
  const Place& place = *std::prev(beyond);
  return place.page->meshes[index - place.first];
}

}  // namespace teren
