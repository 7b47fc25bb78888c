// Long arrays that are published again and again with little changed: pages that versions share.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

namespace teren {

/// A version of an array of pages. Immutable, and cheap to copy: versions share pages, and groups of 64 of
/// them, as long as nobody has written to them. Any thread may read it while PageEditor makes the next.
template <class Page>
class PageTable {
 public:
  static constexpr std::size_t kGroup = 64;

  std::size_t size() const noexcept { return size_; }
  const Page& operator[](std::size_t i) const noexcept { return *groups_[i / kGroup]->pages[i % kGroup]; }

  /// visit(i): every page of this table that is not the same object as the other's, or not in it. O(groups +
  /// 64 groups that differ).
  template <class Visitor>
  void forEachDifference(const PageTable& other, Visitor&& visit) const {
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      if (g < other.groups_.size() && groups_[g] == other.groups_[g]) continue;
      for (std::size_t i = g * kGroup; i < size_ && i < (g + 1) * kGroup; ++i) {
        if (i >= other.size_ || &(*this)[i] != &other[i]) visit(i);
      }
    }
  }

  /// Every byte held, those shared with others as well; what the allocator adds is not counted.
  std::size_t bytes() const noexcept {
    return size_ * (sizeof(Page) + kShared) + groups_.size() * (sizeof(Group) + kShared) +
           groups_.capacity() * sizeof(groups_[0]);
  }

 private:
  template <class>
  friend class PageEditor;
  static constexpr std::size_t kShared = 16;  // the counters of a shared_ptr
  struct Group {
    std::array<std::shared_ptr<const Page>, kGroup> pages;
  };

  std::vector<std::shared_ptr<const Group>> groups_;
  std::size_t size_ = 0;
};

/// Makes the next version of a table: pages written to are copied first, once. One thread.
template <class Page>
class PageEditor {
 public:
  /// The version so far; const functions of a table copied from it are safe whatever happens here.
  const PageTable<Page>& table() const noexcept { return table_; }

  /// The page to write to; the table grows to reach it, with pages as `Page{}` is. Valid until seal().
  /// O(page) the first time since seal(), and O(1) from then on.
  Page& edit(std::size_t i) {
    while (table_.size_ <= i) append(std::make_shared<Page>());
    if (own_[i] == nullptr) own(i, std::make_shared<Page>(table_[i]));
    return *own_[i];
  }
  /// Pages that edit() was asked for since seal(), in order.
  const std::vector<std::size_t>& edited() const noexcept { return edited_; }

  /// Drops the pages behind the first so many.
  void shrink(std::size_t pages) {
    seal();
    while (table_.size_ > pages) {
      --table_.size_;
      group(table_.size_).pages[table_.size_ % kGroup] = nullptr;
    }
    table_.groups_.resize((table_.size_ + kGroup - 1) / kGroup);
    own_.resize(table_.size_);
    ownGroups_.resize(table_.groups_.size());
    seal();
  }

  /// From now on the version stays as it is: what is written to is copied again. O(pages edited).
  void seal() {
    for (const std::size_t i : edited_) own_[i] = nullptr;
    edited_.clear();
    for (auto*& group : ownGroups_) group = nullptr;
  }

  std::size_t bytes() const noexcept {
    return table_.bytes() + own_.capacity() * sizeof(Page*) + edited_.capacity() * sizeof(std::size_t) +
           ownGroups_.capacity() * sizeof(Group*);
  }

 private:
  using Group = typename PageTable<Page>::Group;
  static constexpr std::size_t kGroup = PageTable<Page>::kGroup;

  Group& group(std::size_t page) {
    const std::size_t g = page / kGroup;
    if (ownGroups_[g] == nullptr) {
      const auto copy = std::make_shared<Group>(*table_.groups_[g]);
      ownGroups_[g] = copy.get();
      table_.groups_[g] = copy;
    }
    return *ownGroups_[g];
  }
  void own(std::size_t i, const std::shared_ptr<Page>& page) {
    group(i).pages[i % kGroup] = page;
    own_[i] = page.get();
    edited_.push_back(i);
  }
  void append(const std::shared_ptr<Page>& page) {
    if (table_.size_ % kGroup == 0) {
      table_.groups_.push_back(std::make_shared<Group>());
      ownGroups_.push_back(nullptr);
    }
    own_.push_back(nullptr);
    own(table_.size_++, page);
  }

  PageTable<Page> table_;
  std::vector<Page*> own_;  // pages made since seal()
  std::vector<Group*> ownGroups_;
  std::vector<std::size_t> edited_;
};

}  // namespace teren
