// The meshes of a snapshot: a list that shares with the one before what has not changed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <memory>
#include <span>
#include <vector>

namespace teren {

struct Mesh;

/// Meshes in the order of their ids, which are increasing; in pages, most of which successive snapshots have
/// in common, so that a snapshot costs what has changed and O(pages). Immutable: any thread may read it.
class MeshList {
 public:
  using value_type = std::shared_ptr<const Mesh>;

  /// A few meshes and their ids, never none.
  struct Page {
    static constexpr std::size_t kMost = 16;
    std::array<value_type, kMost> meshes;
    std::array<std::uint64_t, kMost> ids{};
    std::size_t count = 0;
    std::uint64_t edition = 0;  ///< of whoever makes pages
  };
  struct Place {
    std::shared_ptr<const Page> page;
    std::size_t first = 0;  ///< how many meshes lie before it
  };

  class Iterator {
   public:
    using iterator_category = std::forward_iterator_tag;
    using value_type = MeshList::value_type;
    using difference_type = std::ptrdiff_t;
    using pointer = const value_type*;
    using reference = const value_type&;

    Iterator() = default;
    explicit Iterator(const Place* place) noexcept : place_(place) {}
    reference operator*() const noexcept { return place_->page->meshes[at_]; }
    pointer operator->() const noexcept { return &**this; }
    Iterator& operator++() noexcept {
      if (++at_ == place_->page->count) {
        ++place_;
        at_ = 0;
      }
      return *this;
    }
    Iterator operator++(int) noexcept {
      const Iterator before = *this;
      ++*this;
      return before;
    }
    friend bool operator==(const Iterator&, const Iterator&) = default;

   private:
    const Place* place_ = nullptr;
    std::size_t at_ = 0;  // in the page
  };
  using const_iterator = Iterator;

  MeshList() = default;
  /// Of meshes sorted by id.
  MeshList(std::span<const value_type> meshes);
  MeshList(const std::vector<value_type>& meshes) : MeshList(std::span<const value_type>(meshes)) {}
  MeshList(std::initializer_list<value_type> meshes) : MeshList(std::vector<value_type>(meshes)) {}
  /// Of pages sorted by id, each with one mesh or more.
  explicit MeshList(std::span<const std::shared_ptr<Page>> pages);

  bool empty() const noexcept { return size_ == 0; }
  std::size_t size() const noexcept { return size_; }
  Iterator begin() const noexcept { return Iterator(places_.data()); }
  Iterator end() const noexcept { return Iterator(places_.data() + places_.size()); }
  const value_type& front() const noexcept { return places_.front().page->meshes.front(); }
  const value_type& back() const noexcept {
    return places_.back().page->meshes[places_.back().page->count - 1];
  }
  /// O(log pages).
  const value_type& operator[](std::size_t index) const noexcept;

  /// Two lists with the same page have all that is on it in common.
  std::span<const Place> pages() const noexcept { return places_; }

 private:
  std::vector<Place> places_;
  std::size_t size_ = 0;
};

}  // namespace teren
