// All that the future of a sandbox depends on, as a few sections of plain bytes: what archives and undo are
// made of.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "teren/Result.h"

#include "generators/sand/Sandbox.h"

namespace teren {

/// Two sandboxes with equal sections become the same, bit for bit, under the same calls: heights, thickness,
/// the triangulation with its slots, its free ones and where its searches begin, constraints with their ids,
/// what waits to slide and to be looked at, carried errors, the account, counters, settings. What is kept
/// only so that nothing is allocated is not among them, nor what has changed since somebody looked. Boxes
/// with a fence are not archived (assert).
///
/// Sections are little endian, as memory is on the machines that Teren runs on.
class SandState {
 public:
  /// All single numbers, then the arrays. Their order is the archive's.
  enum Section : std::size_t {
    kNumbers,
    kVertices,
    kTriangles,
    kHeights,
    kLoose,
    kConstraints,
    kCells,
    kErrors,
    kSlidingNow,
    kSlidingNext,
    kToClean,
    kRims,
    kInsides,
    kSections
  };
  using Sections = std::array<std::span<const std::byte>, kSections>;

  /// Sections are compared and kept in pages of so many bytes: whole vertices, triangles, heights.
  static constexpr std::size_t kPageBytes = 768;

  /// Views of a sandbox; good until it changes, moves or goes. O(1).
  explicit SandState(const Sandbox& sandbox);
  SandState(const SandState&) = delete;
  SandState& operator=(const SandState&) = delete;
  const Sections& sections() const noexcept { return sections_; }

  /// A sandbox with these sections, whatever bytes they are: refused with one sentence unless all promises of
  /// all its parts hold, so that no later call can go wrong. Holds at most a few times their bytes. O(n).
  /// Nothing is in the lists of what changed: whoever draws begins anew.
  static Result<Sandbox> sandboxOf(const Sections& sections);

  /// Gives a sandbox the sections of another state of the same box, as a SandState had them. Slots that lie
  /// on pages that differ are added to its lists of what changed, those that are no more and the triangles at
  /// such vertices included. O(bytes) to compare, and to copy O(pages that differ).
  static void assign(Sandbox& sandbox, const Sections& sections);

 private:
  /// The account first, for its alignment; no gaps.
  struct Numbers {
    SixfoldVolume owed = 0, moved = 0;
    LatticeFrame frame;
    SandSettings settings;
    SlideCount slides;
    CleanUpCount cleanUp;
    std::uint64_t slidingPosition = 0, removable = 0;
    std::uint64_t freeVertices = 0, freeTriangles = 0, constraints = 0;
    std::uint32_t freeVertex = 0, freeTriangle = 0;
    std::int32_t cellShift = 0;
    std::uint32_t nextId = 0, near = 0, keptId = 0;
    std::uint32_t cleaningRound = 0, unsettled = 0;
  };
  static_assert(sizeof(Numbers) == 256 && sizeof(SandSettings) == 56, "a new number is a new format");

  template <class Self, class Visitor>
  static void forEachArray(Self& sandbox, Visitor&& visit);
  static Numbers numbersOf(const Sandbox& sandbox);
  static void assignNumbers(Sandbox& sandbox, const Numbers& numbers);
  template <class Array>
  static void assignArray(Sandbox& sandbox, Array& array, Section section, std::span<const std::byte> bytes);
  static void noteSlots(Sandbox& sandbox, Section section, std::size_t from, std::size_t end);
  static void copy(Sandbox& sandbox, const Sections& sections);
  static void noteStars(Sandbox& sandbox);
  static bool mark(Sandbox& sandbox);

  // SandStateCheck.cpp
  static Result<void> checkNumbers(const Numbers& numbers, const Sections& sections);
  static Result<void> checkSizes(const Numbers& numbers, const Sections& sections);
  static Result<void> checkLists(const Numbers& numbers, const Sections& sections);
  static Result<void> checkVertices(const SandSurface& surface);
  static Result<void> checkTriangles(const TriangleMesh& mesh);
  static Result<void> checkFree(const TriangleMesh& mesh);
  static Result<void> checkConstraints(const Triangulation& mesh, std::uint32_t nextId);
  static Result<void> checkCells(const Triangulation& mesh);
  static Result<void> check(const Sandbox& sandbox);

  Numbers numbers_;
  Sections sections_;
};

}  // namespace teren
