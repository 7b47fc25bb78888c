// Undo and redo for sand, exact to the last bit.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "generators/sand/SandState.h"

namespace teren {

/// One image of the sandbox as it was when the last action began, and for each action the pages of the image
/// (SandState::kPageBytes) that it changed, as they were before. Undoing exchanges the pages of the image and
/// of the action, which is redone by the same exchange. So memory is one state and what was touched, and the
/// simplest way to find what was touched, comparing everything, costs less than a frame.
///
/// An action is all that happens from one note() to the next: a drag with the slides that follow is one.
/// Undo leads to the sandbox as it was at the note, bit for bit, and from there everything goes on as it did
/// from there before. What happens after an undo or a redo without a note, slides that go on for instance, is
/// forgotten at the next undo or redo, for it happens again by itself; a note makes it the action's past.
///
/// The actions kept have at most `mostBytes` bytes together, their overhead included; the oldest are dropped
/// first. The image comes on top: as many bytes as an archive. At 1,000,000 vertices (81 MB) each of the
/// three takes 5 to 25 ms, and a groove along four fifths of the diagonal 7 to 13 MB. One thread.
class SandHistory {
 public:
  explicit SandHistory(std::size_t mostBytes) noexcept : mostBytes_(mostBytes) {}

  /// An action begins with the sandbox as it is; nothing can be redone any more. Always the same sandbox, or
  /// what undo() and redo() made of it. O(bytes) compared.
  void note(const Sandbox& sandbox);
  /// Back to where the last action that was not undone began. False, and nothing changes, where none is left.
  /// The slots that differ are in the sandbox's lists of what changed. O(bytes) compared.
  bool undo(Sandbox& sandbox);
  /// Forward to where the action last undone had led when it was undone, or the next one began.
  bool redo(Sandbox& sandbox);

  std::size_t actions() const noexcept { return past_.size(); }
  /// Every byte held, the image included.
  std::size_t bytes() const noexcept;

 private:
  using Image = std::array<CompactArray<std::byte>, SandState::kSections>;

  /// Pages of one section, each followed by what it held; the section's size.
  struct SectionChange {
    std::size_t size = 0;
    std::vector<std::uint32_t> pages;
    std::vector<std::byte> content;
  };
  struct Action {
    std::array<SectionChange, SandState::kSections> sections;
    bool isAfterUndo = false;  // what happened by itself between an undo and a note: goes with the one before
    std::size_t bytes() const noexcept;
  };

  void record(const Sandbox& sandbox);
  void exchange(Action& action);
  void restore(Sandbox& sandbox) const;
  void forget();

  std::size_t mostBytes_;
  Image image_;
  std::deque<Action> past_;    // the last one is undone first
  std::deque<Action> future_;  // the last one is redone first
  bool acted_ = false;         // the sandbox has gone on from the image by an action that is not recorded yet
};

}  // namespace teren
