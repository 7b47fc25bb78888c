// The meshes that are drawn now, kept so that a snapshot of them costs little.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "teren/MeshList.h"

namespace teren {

/// A list of meshes by id that can change. Pages that a snapshot has are never written again: a change makes
/// a copy of the page it touches, once until the next snapshot. Not thread-safe.
class MeshPages {
 public:
  /// With a greater id than any before.
  void add(std::shared_ptr<const Mesh> mesh);
  /// One that is there. O(log pages), and a page.
  void remove(std::uint64_t id);
  /// All there are now. O(pages): a tenth of a microsecond for each, of which there are at most a quarter as
  /// many as meshes and one more, and mostly a tenth.
  MeshList snapshot();

  std::size_t size() const noexcept { return size_; }
  std::size_t pages() const noexcept { return pages_.size(); }

 private:
  using Page = MeshList::Page;

  Page& writable(std::size_t page);
  void uniteWithNext(std::size_t page);

  std::vector<std::shared_ptr<Page>> pages_;  // none of them empty
  std::size_t size_ = 0;
  std::uint64_t edition_ = 1;  // of pages that no snapshot has
};

}  // namespace teren
