#include "generators/sand/SandArchive.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "generators/sand/SandPublisher.h"
#include "generators/sand/SandState.h"
#include "tests/generators/sand/RandomGame.h"

namespace teren {
namespace {

using Bytes = std::vector<std::byte>;

constexpr std::size_t kHead = 16 + 8 * SandState::kSections;

/// As the format says: over all that comes before it.
void correctChecksum(Bytes& bytes) {
  const std::size_t size = bytes.size() - 8;
  std::uint64_t hash = hashWith(0, size);
  for (std::size_t i = 0; i < size; i += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + i, std::min<std::size_t>(8, size - i));
    hash = hashWith(hash, word);
  }
  std::memcpy(bytes.data() + size, &hash, 8);
}

/// A game with everything in it: constraints, free slots, slides half done, vertices to be looked at.
RandomGame busyGame(std::uint64_t seed, int operations) {
  static const std::vector<ToolShape> tools = toolbox();
  RandomGame game(seed);
  for (int n = 0; n < operations; ++n) game.play(tools);
  (void)game.sandbox().stamp(tools[0], {0.5, 0.5, 0.0});
  game.sandbox().slide(100);
  return game;
}

bool isOneSentence(const std::string& text) {
  return text.size() > 10 && text.size() < 200 && text.find('\n') == std::string::npos && text.back() != '.';
}

TEST(SandArchive, GoesOnToTheSameBitsWhereverItWasTaken) {
  const std::vector<ToolShape> tools = toolbox();
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    RandomGame original = busyGame(seed, static_cast<int>(seed * 3));
    ASSERT_FALSE(seed == 1 && original.sandbox().slides().atRest()) << "in the middle of a slide";
    const Bytes bytes = archived(original.sandbox());
    Result<Sandbox> sandbox = restored(bytes);
    ASSERT_TRUE(sandbox) << sandbox.error().message << ", seed " << seed;
    ASSERT_EQ(archived(*sandbox), bytes);
    RandomGame copy = original;
    copy.sandbox() = *std::move(sandbox);
    for (int n = 0; n < 100; ++n) {
      original.play(tools);
      copy.play(tools);
      ASSERT_EQ(archived(copy.sandbox()), archived(original.sandbox())) << "after " << n << ", seed " << seed;
    }
    EXPECT_EQ(copy.fault(), "") << "seed " << seed;
    for (Sandbox* each : {&original.sandbox(), &copy.sandbox()}) {
      each->loosenAll();
      each->iterate(20'000);
    }
    EXPECT_EQ(archived(copy.sandbox()), archived(original.sandbox())) << "all loose, seed " << seed;
  }
}

TEST(SandArchive, IsTheSameHoweverSlidesAreSliced) {
  for (std::uint64_t seed = 31; seed <= 36; ++seed) {
    RandomGame whole = busyGame(seed, 20);
    RandomGame sliced = whole;
    whole.sandbox().slide(1'000);
    for (const std::uint64_t steps : {1U, 9U, 90U, 300U, 600U}) sliced.sandbox().slide(steps);
    for (Sandbox* each : {&whole.sandbox(), &sliced.sandbox()}) each->clean();
    EXPECT_EQ(archived(sliced.sandbox()), archived(whole.sandbox())) << "seed " << seed;
  }
}

TEST(SandArchive, KeepsWhatPeopleSee) {
  const RandomGame game = busyGame(7, 60);
  const Sandbox& original = game.sandbox();
  const Result<Sandbox> copy = restored(archived(original));
  ASSERT_TRUE(copy) << copy.error().message;
  const Triangulation &mesh = original.surface().mesh(), &other = copy->surface().mesh();
  ASSERT_EQ(mesh.vertexSlots(), other.vertexSlots());
  ASSERT_EQ(mesh.triangleSlots(), other.triangleSlots());
  EXPECT_GT(mesh.constraintCount(), 10U);
  for (VertexId v = 0; v < mesh.vertexSlots(); ++v) {
    ASSERT_EQ(mesh.isVertex(v), other.isVertex(v));
    if (!mesh.isVertex(v)) continue;
    ASSERT_TRUE(mesh.point(v) == other.point(v));
    ASSERT_EQ(original.surface().height(v), copy->surface().height(v));
    ASSERT_EQ(original.surface().loose(v), copy->surface().loose(v));
  }
  mesh.forEachConstraint([&](VertexId a, VertexId b, std::uint32_t id) {
    EXPECT_EQ(other.constraint(a, b), std::optional(id));
  });
  EXPECT_TRUE(original.surface().owed() == copy->surface().owed() && copy->surface().ledger().due() == 0);
  EXPECT_TRUE(original.surface().volumeMoved() == copy->surface().volumeMoved());
  EXPECT_EQ(original.slides().count().steps, copy->slides().count().steps);
  EXPECT_EQ(original.cleanUp().count().removed, copy->cleanUp().count().removed);
  EXPECT_EQ(original.settings().longestEdge, copy->settings().longestEdge);
  EXPECT_TRUE(original.slides().repose() == copy->slides().repose());
  EXPECT_TRUE(copy->changedVertices().ids().empty() && copy->changedTriangles().ids().empty());
}

TEST(SandArchive, IsRefusedWhereverItIsCut) {
  const Bytes bytes = archived(busyGame(2, 30).sandbox());
  for (std::size_t size = 0; size < bytes.size(); size += size < 1'000 ? 1 : 97) {
    const Result<Sandbox> sandbox = restored(std::span(bytes).first(size));
    ASSERT_FALSE(sandbox) << size;
    ASSERT_TRUE(isOneSentence(sandbox.error().message)) << sandbox.error().message;
    Bytes summed(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
    if (size < kHead + 8) continue;
    correctChecksum(summed);
    ASSERT_FALSE(restored(summed)) << size << ", with the right checksum";
  }
  Bytes longer = bytes;
  longer.push_back(std::byte{0});
  correctChecksum(longer);
  EXPECT_FALSE(restored(longer));
}

TEST(SandArchive, IsRefusedWithAnyBitChanged) {
  const Bytes bytes = archived(busyGame(3, 10).sandbox());
  RandomSequence random(4);
  for (int n = 0; n < 3'000; ++n) {
    Bytes damaged = bytes;
    const std::size_t at = n < 200 ? static_cast<std::size_t>(n) : random.next() % bytes.size();
    damaged[at] ^= std::byte{1} << (random.next() % 8);
    const Result<Sandbox> sandbox = restored(damaged);
    ASSERT_FALSE(sandbox) << at;
    ASSERT_TRUE(isOneSentence(sandbox.error().message)) << sandbox.error().message;
  }
}

TEST(SandArchive, TellsOtherFilesAndOtherVersionsApart) {
  Bytes bytes = archived(busyGame(3, 10).sandbox());
  EXPECT_EQ(restored({}).error().message, "this is no sand of Teren's");
  EXPECT_EQ(restored(Bytes(5'000, std::byte{'T'})).error().message, "this is no sand of Teren's");
  EXPECT_EQ(restored(std::span(bytes).first(9)).error().message, "the sand is cut short");
  bytes[8] = std::byte{2};
  EXPECT_EQ(restored(bytes).error().message, "the sand is of format 2, but this program reads format 1");
}

/// Somebody who knows the format, and the checksum, changes it on purpose.
class Forgery {
 public:
  explicit Forgery(const Bytes& bytes) : bytes_(bytes) {}
  /// Overwrites a number in a section, at a byte counted from its start.
  template <class Number>
  Forgery& put(SandState::Section section, std::size_t at, Number number) {
    std::memcpy(bytes_.data() + begin(section) + at, &number, sizeof number);
    return *this;
  }
  template <class Number>
  Forgery& claim(SandState::Section section, Number bytes) {
    const std::uint64_t size = bytes;
    std::memcpy(bytes_.data() + 16 + 8 * section, &size, 8);
    return *this;
  }
  std::size_t size(SandState::Section section) const {
    std::uint64_t size = 0;
    std::memcpy(&size, bytes_.data() + 16 + 8 * section, 8);
    return size;
  }
  std::size_t begin(SandState::Section section) const {
    std::size_t at = kHead;
    for (std::size_t s = 0; s < section; ++s) at += size(static_cast<SandState::Section>(s));
    return at;
  }
  Bytes& bytes() { return bytes_; }
  Result<Sandbox> read() {
    correctChecksum(bytes_);
    return restored(bytes_);
  }

 private:
  Bytes bytes_;
};

TEST(SandArchive, ClaimsOfArraysThatAreNotThereAllocateNothing) {
  const Bytes bytes = archived(busyGame(5, 20).sandbox());
  for (std::size_t s = 0; s < SandState::kSections; ++s) {
    const auto section = static_cast<SandState::Section>(s);
    for (const std::uint64_t claim : {std::uint64_t{1} << 40, ~std::uint64_t{0}, ~std::uint64_t{0} - 7,
                                      std::uint64_t{bytes.size()}, std::uint64_t{1}}) {
      const Result<Sandbox> sandbox = Forgery(bytes).claim(section, claim).read();
      ASSERT_FALSE(sandbox) << s << " claims " << claim;
      ASSERT_TRUE(isOneSentence(sandbox.error().message)) << sandbox.error().message;
    }
  }
}

TEST(SandArchive, NumbersThatCannotBeAreRefused) {
  const Bytes bytes = archived(busyGame(5, 20).sandbox());
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = HUGE_VAL;
  const auto refused = [&](SandState::Section section, std::size_t at, auto number) {
    const Result<Sandbox> sandbox = Forgery(bytes).put(section, at, number).read();
    EXPECT_FALSE(sandbox) << "section " << section << " at " << at << ": " << number;
  };
  for (const double bad : {nan, infinity, -infinity, 1e300}) {
    for (const std::size_t at : {32U, 40U, 48U}) refused(SandState::kNumbers, at, bad);  // the box
    refused(SandState::kHeights, 8, bad);
    refused(SandState::kHeights, Forgery(bytes).size(SandState::kHeights) - 8, bad);
  }
  for (const double bad : {nan, -1.0}) {
    for (std::size_t at = 80; at < 120; at += 8) refused(SandState::kNumbers, at, bad);  // settings
    refused(SandState::kNumbers, 176, bad);                                              // clean-up's error
  }
  refused(SandState::kNumbers, 48, 0.0);
  for (const std::int32_t side : {0, -1, (1 << 28) + 1}) refused(SandState::kNumbers, 56, side);
  for (const std::int64_t high : {std::int64_t{1} << 50, -(std::int64_t{1} << 50)}) {
    refused(SandState::kNumbers, 8, high);
  }
  refused(SandState::kNumbers, 24, std::int64_t{-1});  // the volume moved
  for (const std::int32_t shift : {-1, 0, 28, 31, 1 << 30}) refused(SandState::kNumbers, 232, shift);
  refused(SandState::kHeights, 8, 1e-13);  // between two ticks
  refused(SandState::kLoose, 8, std::int64_t{-1});
  refused(SandState::kLoose, 8, std::numeric_limits<std::int64_t>::max());
}

TEST(SandArchive, IndicesThatLeadNowhereAreRefused) {
  const Bytes bytes = archived(busyGame(5, 40).sandbox());
  const Sandbox original = *restored(bytes);
  const auto refused = [&](SandState::Section section, std::size_t at, std::uint32_t index) {
    EXPECT_FALSE(Forgery(bytes).put(section, at, index).read()) << section << " at " << at << ": " << index;
  };
  const std::uint32_t vertices = original.surface().mesh().vertexSlots();
  const std::uint32_t triangles = original.surface().mesh().triangleSlots();
  TriangleId t = 0;
  while (!original.surface().mesh().isTriangle(t)) ++t;
  for (const std::uint32_t bad : {vertices, 0xfffffffeU, 0x80000000U}) {
    for (std::size_t corner = 0; corner < 3; ++corner)
      refused(SandState::kTriangles, 24 * t + 4 * corner, bad);
    for (const auto list : {SandState::kToClean, SandState::kRims, SandState::kInsides, SandState::kCells})
      refused(list, 0, bad);
    refused(SandState::kNumbers, 240, bad);  // where the last stamp was
  }
  for (const std::uint32_t link :
       {triangles << 3, 0xffffffffU - 1, 0xfffffff8U, (1U << 3) | 3U, 0x7ffffff0U}) {
    for (std::size_t side = 0; side < 3; ++side) refused(SandState::kTriangles, 24 * t + 12 + 4 * side, link);
    refused(SandState::kVertices, 8, link);
  }
  refused(SandState::kVertices, 8,
          4U | (original.surface().mesh().triangleAt(0) << 3));  // a star with a flag
  ASSERT_GT(Forgery(bytes).size(SandState::kSlidingNext), 0U);
  ASSERT_GT(Forgery(bytes).size(SandState::kToClean), 4U);
  ASSERT_GT(Forgery(bytes).size(SandState::kRims), 0U);
  refused(SandState::kSlidingNext, 0, triangles);
  std::uint32_t first = 0;
  std::memcpy(&first, bytes.data() + Forgery(bytes).begin(SandState::kToClean), 4);
  refused(SandState::kToClean, 4, first);  // waits twice
}

TEST(SandArchive, ConstraintsOfStampsToComeAreRefused) {
  const RandomGame game = busyGame(5, 40);
  const Bytes bytes = archived(game.sandbox());
  std::uint32_t youngest = 0;
  game.sandbox().surface().mesh().forEachConstraint(
      [&](VertexId, VertexId, std::uint32_t id) { youngest = std::max(youngest, id); });
  ASSERT_GT(youngest, 1U);
  constexpr std::size_t kNextId = 236;
  const auto read = [&](std::uint32_t nextId) {
    return Forgery(bytes).put(SandState::kNumbers, kNextId, nextId).read();
  };
  EXPECT_TRUE(read(youngest + 1));
  EXPECT_TRUE(read(0xffff0000U));
  for (const std::uint32_t bad : {0U, 1U, youngest, 0xffff0001U, ~0U}) EXPECT_FALSE(read(bad)) << bad;
}

TEST(SandArchive, FreeSlotsMustFormAChain) {
  RandomGame game = busyGame(5, 40);
  ASSERT_TRUE(game.sandbox().stamp(*ToolShape::disc(0.3, 0.2), {0.5, 0.5, 0.0}));  // takes many away
  const Bytes bytes = archived(game.sandbox());
  const Sandbox original = *restored(bytes);
  const Triangulation& mesh = original.surface().mesh();
  std::vector<VertexId> freeVertices;
  for (VertexId v = 0; v < mesh.vertexSlots(); ++v) {
    if (!mesh.isVertex(v)) freeVertices.push_back(v);
  }
  std::vector<TriangleId> freeTriangles;
  for (TriangleId t = 0; t < mesh.triangleSlots(); ++t) {
    if (!mesh.isTriangle(t)) freeTriangles.push_back(t);
  }
  ASSERT_GT(freeVertices.size(), 2U);
  ASSERT_GT(freeTriangles.size(), 2U);
  for (const std::uint32_t next : {freeVertices[0], freeVertices[1], 5U, mesh.vertexSlots(), 0x90000000U}) {
    const Result<Sandbox> one = Forgery(bytes).put(SandState::kVertices, 16 * freeVertices[1], next).read();
    EXPECT_TRUE(!one || archived(*one) == bytes) << next;
  }
  for (const std::uint32_t next : {freeTriangles[0], freeTriangles[1], mesh.triangleSlots(), 0x90000000U}) {
    const Result<Sandbox> one =
        Forgery(bytes).put(SandState::kTriangles, 24 * freeTriangles[1] + 4, next).read();
    EXPECT_TRUE(!one || archived(*one) == bytes) << next;
  }
  for (const std::size_t at : {200U, 208U, 216U, 224U, 228U}) {  // counts and first ones
    EXPECT_FALSE(Forgery(bytes).put(SandState::kNumbers, at, std::uint32_t{1}).read()) << at;
    EXPECT_FALSE(Forgery(bytes).put(SandState::kNumbers, at, ~std::uint32_t{0}).read()) << at;
  }
}

/// Bits of the state itself changed, with a checksum that says all is well: refused, or as good as any other.
TEST(SandArchive, ForgedAtRandomIsRefusedOrPlaysOn) {
  const std::vector<ToolShape> tools = toolbox();
  RandomSequence random(8);
  int refused = 0, played = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const RandomGame original = busyGame(seed, 40);
    const Bytes bytes = archived(original.sandbox());
    for (int n = 0; n < 250; ++n) {
      Forgery forgery(bytes);
      const auto section = static_cast<SandState::Section>(random.next() % SandState::kSections);
      if (forgery.size(section) == 0) continue;
      for (std::uint64_t flips = 1 + random.next() % 3; flips > 0; --flips) {
        const std::size_t at = forgery.begin(section) + random.next() % forgery.size(section);
        forgery.bytes()[at] ^= std::byte{1} << (random.next() % 8);
      }
      Result<Sandbox> sandbox = forgery.read();
      if (!sandbox) {
        ASSERT_TRUE(isOneSentence(sandbox.error().message)) << sandbox.error().message;
        ++refused;
        continue;
      }
      ++played;
      RandomGame game = original;
      game.sandbox() = *std::move(sandbox);
      SandPublisher publisher;
      const std::shared_ptr<const SandSnapshot> shown = publisher.publish(game.sandbox());
      ASSERT_EQ(shown->triangleCount(), game.sandbox().surface().mesh().triangleCount());
      for (int moves = 0; moves < 20; ++moves) game.play(tools);
      const Result<void> sound = game.sandbox().surface().validate();
      ASSERT_TRUE(sound) << sound.error().message << " after flips in section " << section << ", seed "
                         << seed;
    }
  }
  EXPECT_GT(refused, 500);
  EXPECT_GT(played, 200);
}

}  // namespace
}  // namespace teren
