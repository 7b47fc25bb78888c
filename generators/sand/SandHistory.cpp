#include "generators/sand/SandHistory.h"

#include <algorithm>
#include <cstring>
#include <span>
#include <utility>

namespace teren {
namespace {

constexpr std::size_t kPage = SandState::kPageBytes;

/// What of a page lies within a section of so many bytes.
std::span<const std::byte> pageOf(std::span<const std::byte> section, std::size_t page) {
  const std::size_t from = std::min(page * kPage, section.size());
  return section.subspan(from, std::min(kPage, section.size() - from));
}

std::span<const std::byte> all(const CompactArray<std::byte>& section) {
  return {section.data(), section.size()};
}

void put(std::span<const std::byte> bytes, CompactArray<std::byte>& section, std::size_t page) {
  if (!bytes.empty()) std::memcpy(&section[page * kPage], bytes.data(), bytes.size());
}

bool equal(std::span<const std::byte> one, std::span<const std::byte> other) {
  return one.size() == other.size() &&
         (one.empty() || std::memcmp(one.data(), other.data(), one.size()) == 0);
}

}  // namespace

std::size_t SandHistory::Action::bytes() const noexcept {
  std::size_t sum = sizeof *this;
  for (const SectionChange& change : sections) {
    sum += change.pages.capacity() * sizeof(std::uint32_t) + change.content.capacity();
  }
  return sum;
}

/// Brings the image up to the sandbox and keeps what it was before, if it was different.
void SandHistory::record(const Sandbox& sandbox) {
  const SandState state(sandbox);
  Action action;
  action.isAfterUndo = !acted_;
  bool differs = false;
  for (std::size_t s = 0; s < image_.size(); ++s) {
    const std::span<const std::byte> now = state.sections()[s];
    CompactArray<std::byte>& image = image_[s];
    SectionChange& change = action.sections[s];
    change.size = image.size();
    for (std::size_t page = 0; page * kPage < std::max(image.size(), now.size()); ++page) {
      const std::span<const std::byte> before = pageOf(all(image), page);
      if (equal(before, pageOf(now, page))) continue;
      change.pages.push_back(static_cast<std::uint32_t>(page));
      change.content.insert(change.content.end(), before.begin(), before.end());
    }
    image.resize(now.size(), std::byte{});
    for (const std::uint32_t page : change.pages) put(pageOf(now, page), image, page);
    change.pages.shrink_to_fit();
    change.content.shrink_to_fit();
    differs = differs || !change.pages.empty();
  }
  if (differs) past_.push_back(std::move(action));
}

/// The image's and the action's bytes change places.
void SandHistory::exchange(Action& action) {
  for (std::size_t s = 0; s < image_.size(); ++s) {
    SectionChange& change = action.sections[s];
    CompactArray<std::byte>& image = image_[s];
    std::vector<std::byte> former;
    for (const std::uint32_t page : change.pages) {
      const std::span<const std::byte> bytes = pageOf(all(image), page);
      former.insert(former.end(), bytes.begin(), bytes.end());
    }
    const std::size_t size = std::exchange(change.size, image.size());
    image.resize(size, std::byte{});
    std::span<const std::byte> content = change.content;
    for (const std::uint32_t page : change.pages) {
      const std::size_t length = pageOf(all(image), page).size();
      put(content.first(length), image, page);
      content = content.subspan(length);
    }
    former.shrink_to_fit();
    change.content = std::move(former);
  }
}

void SandHistory::restore(Sandbox& sandbox) const {
  SandState::Sections sections;
  for (std::size_t s = 0; s < sections.size(); ++s) sections[s] = all(image_[s]);
  SandState::assign(sandbox, sections);
}

/// Drops the oldest actions beyond the limit, and then those that would be redone last. What happened after
/// an action goes with it.
void SandHistory::forget() {
  std::size_t sum = 0;
  for (const Action& action : past_) sum += action.bytes();
  for (const Action& action : future_) sum += action.bytes();
  const auto drop = [&sum](std::deque<Action>& actions) {
    sum -= actions.front().bytes();
    actions.pop_front();
  };
  while (!past_.empty() && (sum > mostBytes_ || past_.front().isAfterUndo)) drop(past_);
  while (!future_.empty() && sum > mostBytes_) drop(future_);
}

void SandHistory::note(const Sandbox& sandbox) {
  if (image_[SandState::kNumbers].size() == 0) {
    const SandState state(sandbox);
    for (std::size_t s = 0; s < image_.size(); ++s) {
      image_[s].resize(state.sections()[s].size(), std::byte{});
      put(state.sections()[s], image_[s], 0);
    }
  } else {
    record(sandbox);
  }
  future_.clear();
  acted_ = true;
  forget();
}

bool SandHistory::undo(Sandbox& sandbox) {
  if (acted_) record(sandbox);
  forget();
  if (past_.empty()) return false;
  acted_ = false;
  for (bool isAfterUndo = true; isAfterUndo;) {
    exchange(past_.back());
    isAfterUndo = past_.back().isAfterUndo;
    future_.push_back(std::move(past_.back()));
    past_.pop_back();
  }
  restore(sandbox);
  forget();
  return true;
}

bool SandHistory::redo(Sandbox& sandbox) {
  if (future_.empty()) return false;
  do {
    exchange(future_.back());
    past_.push_back(std::move(future_.back()));
    future_.pop_back();
  } while (!future_.empty() && future_.back().isAfterUndo);
  restore(sandbox);
  forget();
  return true;
}

std::size_t SandHistory::bytes() const noexcept {
  std::size_t sum = sizeof *this;
  for (const CompactArray<std::byte>& section : image_) sum += section.bytes();
  for (const Action& action : past_) sum += action.bytes();
  for (const Action& action : future_) sum += action.bytes();
  return sum;
}

}  // namespace teren
