#include "teren/EditedGround.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "teren/Bake.h"
#include "teren/Hash.h"
#include "teren/HeightMapOperations.h"

#include "edits/GroundCheckpoint.h"
#include "tests/engine/edits/CountedBowls.h"
#include "tests/engine/edits/TestDeformers.h"

namespace teren {
namespace {

/// Patches of 64 m with samples 4 m apart; two layers, one as coarse as 1 km.
std::shared_ptr<const World> testWorld() {
  static const std::shared_ptr<const World> world = [] {
    WorldDescription description;
    description.seed = 5;
    description.samples = 33;
    LayerDescription layer;
    layer.generator = "fault";
    layer.parameters = {{"faults", std::int64_t{20}}};
    layer.samples = 33;
    description.layers.push_back(layer);
    layer.pitch = 1024.0;
    description.layers.push_back(layer);
    auto made = World::create(description, *PluginRegistry::standard());
    EXPECT_TRUE(made) << (made ? "" : made.error().message);
    return *made;
  }();
  return world;
}

Edit bowl(double x, double y, double size = 20.0, std::uint64_t steps = 0, const std::string& kind = "bowl") {
  return {kind, x, y, 0.0, size, 3.0, 7, steps, {}};
}

/// Overlapping and far, of two kinds, across patches, with all kinds of pauses.
std::vector<Edit> randomEdits(std::uint64_t seed, int count, double east, double north) {
  RandomSequence random(seed);
  std::vector<Edit> edits;
  for (int k = 0; k < count; ++k) {
    Edit edit = bowl(east + static_cast<double>(random.nextBits(12)) * 0.125,
                     north + static_cast<double>(random.nextBits(12)) * 0.125,
                     5.0 + static_cast<double>(random.nextBits(6)), random.next() % 9,
                     random.nextBits(2) == 0 ? "other-bowl" : "bowl");
    edit.seed = random.next();
    edits.push_back(edit);
  }
  return edits;
}

std::unique_ptr<EditedGround> applied(const std::vector<Edit>& edits, const EditWork& work = {}) {
  auto ground = std::make_unique<EditedGround>(testWorld(), testDeformer);
  for (const Edit& edit : edits) {
    const Result<void> done = ground->apply(edit, work);
    EXPECT_TRUE(done) << (done ? "" : done.error().message);
  }
  const Result<void> rested = ground->rest(work);
  EXPECT_TRUE(rested) << (rested ? "" : rested.error().message);
  return ground;
}

HeightMap baked(const BakeRegion& region, const EditedGround* edits, int workers = 0,
                std::uint64_t visits = 0) {
  BakeOptions options;
  options.edits = edits;
  options.workers = workers;
  options.visitSeed = visits;
  Result<HeightMap> map = bake(*testWorld(), region, options);
  EXPECT_TRUE(map) << (map ? "" : map.error().message);
  return *std::move(map);
}

bool sameBits(const HeightMap& a, const HeightMap& b) {
  return std::equal(
      a.samples().begin(), a.samples().end(), b.samples().begin(), b.samples().end(),
      [](float x, float y) { return std::bit_cast<std::uint32_t>(x) == std::bit_cast<std::uint32_t>(y); });
}

TEST(EditedGround, IsTheSameForAnySlicing) {
  const std::vector<Edit> edits = randomEdits(3, 40, -100.0, 50.0);
  const auto whole = applied(edits);
  int asked = 0;
  const auto sliced = applied(edits, {std::chrono::microseconds(1), [&] { return ++asked > 0; }});
  EXPECT_GT(asked, 200);
  EXPECT_EQ(whole->hash(), sliced->hash());
  const BakeRegion region{-4, -1, 12, 12, 0};
  EXPECT_TRUE(sameBits(baked(region, whole.get()), baked(region, sliced.get(), 2, 99)));
}

TEST(EditedGround, IsTheSameInWhateverOrderItIsAsked) {
  const auto ground = applied(randomEdits(4, 30, 0.0, 0.0));
  const HeightMap whole = baked({-1, -1, 10, 10, 0}, ground.get());
  for (const std::int64_t i : {7, 0, 3, -1}) {
    const HeightMap part = baked({i, 2, 1, 3, 0}, ground.get());
    const int n = testWorld()->intervals();
    for (int y = 0; y < part.rows(); ++y) {
      for (int x = 0; x < part.columns(); ++x) {
        ASSERT_EQ(part(x, y), whole(static_cast<int>(i + 1) * n + x, 3 * n + y)) << x << ' ' << y;
      }
    }
  }
}

TEST(EditedGround, RemembersTheOrderAndTheStepsOfItsEdits) {
  const std::vector<Edit> edits = {bowl(30.0, 30.0), bowl(40.0, 36.0, 20.0, 3), bowl(35.0, 30.0, 12.0, 2)};
  std::set<std::uint64_t> hashes = {applied(edits)->hash()};
  std::vector<Edit> other = edits;
  std::swap(other[1].x, other[2].x);
  hashes.insert(applied(other)->hash());
  other = edits;
  other[2].steps = 3;
  hashes.insert(applied(other)->hash());
  other = edits;
  other[1].seed = 8;
  hashes.insert(applied(other)->hash());
  other = edits;
  other[1].parameters = {{"rough", 0.5}};
  hashes.insert(applied(other)->hash());
  EXPECT_EQ(hashes.size(), 5U);
}

TEST(EditedGround, IsTheSamePlayedFromItsText) {
  const std::vector<Edit> edits = randomEdits(5, 30, 12.0, -700.0);
  std::string text;
  for (const Edit& edit : edits) text += editText(edit) + "\n";
  const Result<std::vector<Edit>> read = parseEdits(text, "text");
  ASSERT_TRUE(read);
  EXPECT_EQ(applied(edits)->hash(), applied(*read)->hash());
}

TEST(EditedGround, IsAskedBetweenEditsWithoutATrace) {
  std::vector<Edit> edits = randomEdits(6, 12, 0.0, 0.0);
  EditedGround asked(testWorld(), testDeformer);
  for (std::size_t k = 0; k < edits.size(); ++k) {
    edits[k].steps = std::max(edits[k].steps, asked.stepsSinceEdit());
    ASSERT_TRUE(asked.apply(edits[k]));
    EXPECT_FALSE(asked.atRest());
    if (k % 3 == 2) {
      ASSERT_TRUE(asked.rest());
      baked({0, 0, 2, 2, 0}, &asked);
    }
  }
  ASSERT_TRUE(asked.rest());
  EXPECT_EQ(asked.hash(), applied(edits)->hash());
  // A list that says it came before the ground was at rest is another one.
  Edit early = bowl(100.0, 100.0);
  ASSERT_GT(asked.stepsSinceEdit(), 0U);
  const Result<void> refused = asked.apply(early);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message, "STEPS is 0 but the ground has done " +
                                         std::to_string(asked.stepsSinceEdit()) + " since the edit before");
  early.steps = asked.stepsSinceEdit();
  EXPECT_TRUE(asked.apply(early));
}

TEST(EditedGround, IsDugWhereTheEditSaysAndNowhereElse) {
  const auto ground = applied({bowl(100.0, 260.0, 30.0)});
  const BakeRegion region{-1, 2, 6, 5, 0};
  const HeightMap before = baked(region, nullptr), after = baked(region, ground.get());
  const double spacing = testWorld()->spacing(0);
  int dug = 0;
  for (int y = 0; y < after.rows(); ++y) {
    for (int x = 0; x < after.columns(); ++x) {
      const double dx = x * spacing - 64.0 - 100.0, dy = y * spacing + 128.0 - 260.0;
      if (dx * dx + dy * dy >= 900.0) {
        EXPECT_EQ(std::bit_cast<std::uint32_t>(after(x, y)), std::bit_cast<std::uint32_t>(before(x, y)));
      } else if (dx * dx + dy * dy < 400.0) {
        EXPECT_LT(after(x, y), before(x, y));
        ++dug;
      }
    }
  }
  EXPECT_GT(dug, 60);
}

TEST(EditedGround, IsSampledByEveryLevel) {
  const auto ground = applied(randomEdits(8, 20, -200.0, -200.0));
  const HeightMap finest = baked({-8, -8, 16, 16, 0}, ground.get());
  const HeightMap finestBefore = baked({-8, -8, 16, 16, 0}, nullptr);
  for (int level = 1; level <= testWorld()->topLevel(); ++level) {
    const HeightMap coarse = baked({-8, -8, 16, 16, level}, ground.get());
    const HeightMap before = baked({-8, -8, 16, 16, level}, nullptr);
    int changed = 0;
    for (int y = 0; y < coarse.rows(); ++y) {
      for (int x = 0; x < coarse.columns(); ++x) {
        const bool wasChanged = finest(x << level, y << level) != finestBefore(x << level, y << level);
        changed += wasChanged ? 1 : 0;
        EXPECT_EQ(coarse(x, y), wasChanged ? finest(x << level, y << level) : before(x, y)) << level;
      }
    }
    EXPECT_GT(changed, level < 4 ? 1 : -1);
  }
  EXPECT_GT(testWorld()->topLevel(), 3);
}

TEST(EditedGround, IsTheSameNearTheWorldsEndWhereverPlacesAreExact) {
  const std::int64_t far = std::int64_t{1} << 40;
  const double x = static_cast<double>(far) * 64.0;
  std::vector<Edit> edits = randomEdits(9, 25, 0.0, 0.0);
  for (Edit& edit : edits) edit.x = x + edit.x, edit.y -= x;  // multiples of 1/8 m: exact there
  int asked = 0;
  const auto whole = applied(edits);
  const auto sliced = applied(edits, {std::chrono::microseconds(1), [&] { return ++asked > 0; }});
  EXPECT_EQ(whole->hash(), sliced->hash());
  const BakeRegion region{far - 1, -far - 1, 10, 10, 0};
  const HeightMap before = baked(region, nullptr), after = baked(region, whole.get());
  EXPECT_FALSE(sameBits(before, after));
  EXPECT_TRUE(sameBits(after, baked(region, sliced.get(), 0, 3)));
  // The same bowl on flat differences: as deep there as here.
  const auto depths = [](double middleX, double middleY, const BakeRegion& around) {
    const auto ground = applied({bowl(middleX, middleY, 25.0)});
    const HeightMap was = baked(around, nullptr), is = baked(around, ground.get());
    std::vector<bool> dug;
    for (std::size_t k = 0; k < was.samples().size(); ++k) dug.push_back(was.samples()[k] != is.samples()[k]);
    return dug;
  };
  EXPECT_EQ(depths(37.125, 61.5, {-1, -1, 4, 4, 0}),
            depths(x + 37.125, 61.5 - x, {far - 1, -far - 1, 4, 4, 0}));
}

TEST(EditedGround, AnswersQueriesAsItIsDrawnAndAsTheWorldDoesElsewhere) {
  const auto world = testWorld();
  const auto ground = applied({bowl(100.0, 260.0, 30.0), bowl(64.0, 256.0, 9.0)});
  const HeightMap drawn = baked({0, 3, 3, 3, 0}, ground.get());
  RandomSequence random(10);
  std::vector<Position> places;
  std::vector<std::array<double, 2>> metres;
  for (int k = 0; k < 2000; ++k) {
    const double x = static_cast<double>(random.nextBits(20)) * 0x1p-20 * 190.0;
    const double y = 192.0 + static_cast<double>(random.nextBits(20)) * 0x1p-20 * 190.0;
    metres.push_back({x, y});
    places.push_back(*Position::fromMetres(x, y, world->pitch()));
  }
  std::vector<SurfacePoint> points(places.size()), own(places.size());
  ground->query(places, points);
  world->query(places, own);
  int changed = 0;
  for (std::size_t k = 0; k < places.size(); ++k) {
    EXPECT_LE(std::fabs(points[k].height - points[k].drawn), points[k].error);
    const double gx = metres[k][0] / 4.0, gy = (metres[k][1] - 192.0) / 4.0;
    const int x = static_cast<int>(gx), y = static_cast<int>(gy);
    const double u = gx - x, v = gy - y;
    const double low = drawn(x, y), high = drawn(x + 1, y + 1);
    const double side = u >= v ? drawn(x + 1, y) : drawn(x, y + 1);
    const double triangle =
        u >= v ? low + u * (side - low) + v * (high - side) : low + v * (side - low) + u * (high - side);
    EXPECT_NEAR(points[k].drawn, triangle, 1e-9);
    if (std::hypot(metres[k][0] - 100.0, metres[k][1] - 260.0) > 36.0 &&
        std::hypot(metres[k][0] - 64.0, metres[k][1] - 256.0) > 16.0) {
      EXPECT_EQ(points[k].height, own[k].height);
      EXPECT_EQ(points[k].normal, own[k].normal);
      EXPECT_EQ(points[k].error, own[k].error);
    } else {
      changed += points[k].height < own[k].height ? 1 : 0;
    }
  }
  EXPECT_GT(changed, 100);
}

TEST(EditedGround, JoinsTheGroundOfBowlsOfOneKindAsOneSurface) {
  // Two far bowls, then one between that needs the patches of both: one surface goes on with what is there.
  const auto ground = applied({bowl(20.0, 20.0), bowl(300.0, 20.0), bowl(160.0, 20.0, 150.0, 2)});
  const HeightMap before = baked({-3, -3, 12, 8, 0}, nullptr),
                  after = baked({-3, -3, 12, 8, 0}, ground.get());
  const int y = (192 + 20) / 4;
  for (const int x : {(192 + 20) / 4, (192 + 300) / 4}) EXPECT_LT(after(x, y), before(x, y) - 2.0F);
}

/// The patches of a region, baked, with edits or without.
HeightMap groundOf(const DeformRegion& region, const EditedGround* edits) {
  return baked({region.i, region.j, region.columns, region.rows, 0}, edits);
}

Stamp stampIn(const DeformRegion& region, const Edit& edit, std::span<const Parameter> table) {
  return {edit.x - static_cast<double>(region.i) * 64.0,
          edit.y - static_cast<double>(region.j) * 64.0,
          edit.z,
          edit.size,
          edit.depth,
          edit.seed,
          Values::check(table, edit.parameters, edit.kind).value()};
}

/// The samples of one surface over the whole region when it has come to rest after each of some edits.
HeightMap bySurface(const DeformerKind& kind, const DeformRegion& region, const HeightMap& ground,
                    const std::vector<Edit>& edits) {
  const auto surface = kind.deformer->begin(region, ground.view()).value();
  for (const Edit& edit : edits) {
    EXPECT_TRUE(surface->apply(stampIn(region, edit, kind.parameters)));
    EXPECT_TRUE(surface->step(Slice::unlimited(), kMostEditSteps));
  }
  HeightMap heights(region.sampleColumns(), region.sampleRows());
  surface->snapshot()->samples({0, 0, heights.columns(), heights.rows()}, heights.view());
  return heights;
}

constexpr DeformRegion kAround{-4, -4, 12, 9, 16, 4.0};

TEST(EditedGround, GrowsASurfaceAsIfItHadBegunOverAllOfIt) {
  const DeformerSource source = deformersOf(PluginRegistry::standard());
  for (const std::string kind : {"sand", "crater"}) {
    EditedGround ground(testWorld(), source);
    std::vector<Edit> edits;
    for (const auto& [x, y, depth] : {std::tuple(30.0, 30.0, -8.0), std::tuple(75.0, 40.0, 5.0),
                                      std::tuple(160.5, 20.0, 6.0), std::tuple(-70.0, -40.0, 4.0)}) {
      edits.push_back({kind, x, y, 0.0, 12.0, depth, 3, ground.stepsSinceEdit(), {}});
      ASSERT_TRUE(ground.apply(edits.back()));
      ASSERT_TRUE(ground.rest());
      EXPECT_TRUE(sameBits(groundOf(kAround, &ground),
                           bySurface(*source(kind), kAround, groundOf(kAround, nullptr), edits)))
          << kind << " " << edits.size();
    }
  }
}

TEST(EditedGround, GrowsOverWhatOtherKindsHaveLeft) {
  // The third edit needs the patches of both surfaces: that of its kind grows, and the other ends.
  const std::vector<Edit> edits = {bowl(20.0, 20.0), bowl(250.0, 20.0, 20.0, 9, "other-bowl"),
                                   bowl(160.0, 20.0, 100.0, 9)};
  const auto other = applied({edits[1]});
  EXPECT_TRUE(sameBits(
      groundOf(kAround, applied(edits).get()),
      bySurface(*testDeformer("bowl"), kAround, groundOf(kAround, other.get()), {edits[0], edits[2]})));
}

TEST(EditedGround, MakesOneOfAllSurfacesOfItsKindInTheWay) {
  constexpr DeformRegion kWest{-3, -3, 7, 7, 16, 4.0}, kEast{5, -3, 7, 7, 16, 4.0},
      kBoth{-3, -5, 15, 11, 16, 4.0};
  const DeformerSource source = deformersOf(PluginRegistry::standard());
  const DeformerKind sand = *source("sand");
  std::vector<Edit> edits = {{"sand", 30.0, 30.0, 0.0, 12.0, -8.0, 3, 0, {}},
                             {"sand", 542.0, 30.0, 0.0, 12.0, -8.0, 4, 0, {}},
                             {"sand", 286.5, 30.0, 0.0, 40.0, 4.0, 5, 0, {}}};
  EditedGround ground(testWorld(), source);
  for (Edit& edit : edits) {
    edit.steps = ground.stepsSinceEdit();
    ASSERT_TRUE(ground.apply(edit));
    ASSERT_TRUE(ground.rest());
  }
  const auto press = [&](LiveSurface& surface, const DeformRegion& region, const Edit& edit) {
    const Result<void> pressed = surface.apply(stampIn(region, edit, sand.parameters));
    EXPECT_TRUE(pressed) << (pressed ? "" : pressed.error().message);
    EXPECT_TRUE(surface.step(Slice::unlimited(), kMostEditSteps));
  };
  const auto west = sand.deformer->begin(kWest, groundOf(kWest, nullptr).view()).value();
  const auto east = sand.deformer->begin(kEast, groundOf(kEast, nullptr).view()).value();
  press(*west, kWest, edits[0]);
  press(*east, kEast, edits[1]);
  LiveSurface* const others[] = {east.get()};
  ASSERT_TRUE(west->merge(kBoth, groundOf(kBoth, nullptr).view(), others));
  press(*west, kBoth, edits[2]);
  HeightMap heights(kBoth.sampleColumns(), kBoth.sampleRows());
  west->snapshot()->samples({0, 0, heights.columns(), heights.rows()}, heights.view());
  EXPECT_TRUE(sameBits(groundOf(kBoth, &ground), heights));
}

/// A steep heap of damp sand, `between` small holes far from it, then others, and a hole at its foot that
/// lets dry sand slide.
std::vector<Edit> undermined(std::size_t between, const std::vector<Edit>& then = {}) {
  std::vector<Edit> edits = {{"sand", 30.0, 30.0, 0.0, 16.0, -14.0, 0, kMostEditSteps, {{"repose", 45.0}}}};
  for (std::size_t k = 0; k < between; ++k) {
    edits.push_back(
        {"sand", 2030.0, 30.0 + static_cast<double>(k % 8), 0.0, 4.0, 1.0, k, kMostEditSteps, {}});
  }
  edits.insert(edits.end(), then.begin(), then.end());
  edits.push_back({"sand", 44.0, 30.0, 0.0, 10.0, 6.0, 0, kMostEditSteps, {{"repose", 25.0}}});
  return edits;
}

TEST(EditedGround, KeepsLooseWhatIsLooseWhereSurfacesHaveEnded) {
  constexpr std::size_t kPause = EditedGround::kMostEditsTogether;
  const DeformerSource source = deformersOf(PluginRegistry::standard());
  const auto heights = [&](std::span<const Edit> edits) {
    EditedGround ground(testWorld(), source);
    EXPECT_TRUE(ground.replay(edits));
    EXPECT_TRUE(ground.rest());
    return groundOf({-1, -1, 4, 4, 16, 4.0}, &ground);
  };
  /// [m] How far the heap falls, behind its top, where no tool came.
  const auto falls = [&](const std::vector<Edit>& edits) {
    const HeightMap before = heights(std::span(edits).first(edits.size() - 1)), after = heights(edits);
    float most = 0.0F;
    for (int y = 0; y < after.rows(); ++y) {
      for (int x = 0; x < 16 + 7; ++x) most = std::max(most, before(x, y) - after(x, y));
    }
    return most;
  };
  const float atOnce = falls(undermined(0));
  EXPECT_GT(atOnce, 1.0F);
  EXPECT_NEAR(falls(undermined(kPause)), atOnce, 0.5);
  // A surface that grows over the heap.
  EXPECT_NEAR(falls(undermined(kPause, {{"sand", 200.0, 30.0, 0.0, 8.0, 2.0, 0, kMostEditSteps, {}}})),
              atOnce, 0.5);
  // One that knows nothing loose has changed all of it.
  EXPECT_LT(falls(undermined(kPause, {{"crater", 30.0, 30.0, 0.0, 40.0, 2.0, 0, kMostEditSteps, {}}})), 0.1F);
}

TEST(EditedGround, IsLooseAsTheListSaysHoweverItCameThere) {
  constexpr std::size_t kPause = EditedGround::kMostEditsTogether;
  const DeformerSource source = deformersOf(PluginRegistry::standard());
  const std::vector<Edit> first = undermined(kPause - 1);  // and the hole at the foot
  const std::vector<Edit> heap(first.begin(), first.end() - 1);
  ASSERT_EQ(heap.size(), kPause);
  // Another kind of surface makes solid what it changes.
  std::vector<Edit> more = heap;
  more.push_back({"crater", 30.0, 30.0, 0.0, 24.0, 2.0, 0, kMostEditSteps, {}});
  more.insert(more.end(), heap.begin() + 1, heap.end());
  more.push_back(more.back());
  EditedGround expected(testWorld(), source), undone(testWorld(), source), begun(testWorld(), source);
  ASSERT_TRUE(expected.replay(first));
  ASSERT_TRUE(undone.replay(more));
  ASSERT_TRUE(undone.rest());
  ASSERT_GT(undone.checkpoint()->mark().edits, kPause);
  ASSERT_TRUE(undone.replay(heap));
  ASSERT_TRUE(undone.apply(first.back()));
  ASSERT_TRUE(expected.rest());
  ASSERT_TRUE(undone.rest());
  EXPECT_EQ(undone.hash(), expected.hash());
  auto left = GroundCheckpoint::read(expected.checkpoint()->mark(), expected.checkpoint()->text());
  ASSERT_TRUE(left.ok());
  EXPECT_FALSE(left->loose().empty());
  ASSERT_TRUE(*begun.adopt(std::make_shared<const GroundCheckpoint>(*std::move(left)), first));
  ASSERT_TRUE(begun.replay(first));
  ASSERT_TRUE(begun.rest());
  EXPECT_EQ(begun.hash(), expected.hash());
}

/// Applied one by one, each after what was there before it had come to rest.
std::unique_ptr<EditedGround> played(std::vector<Edit>& edits, const std::shared_ptr<const World>& world,
                                     const DeformerSource& source) {
  auto ground = std::make_unique<EditedGround>(world, source);
  for (Edit& edit : edits) {
    edit.steps = ground->stepsSinceEdit();
    EXPECT_TRUE(ground->apply(edit));
    EXPECT_TRUE(ground->rest());
  }
  return ground;
}

TEST(EditedGround, LetsSurfacesSpreadBeyondTheirPatches) {
  const HeightMap before = baked({-6, -2, 10, 5, 0}, nullptr);
  const auto ground = applied({bowl(30.0, 30.0, 20.0, 0, "creeps")});
  const HeightMap after = baked({-6, -2, 10, 5, 0}, ground.get());
  const auto fallsAt = [&](double x) {
    const int column = static_cast<int>(x / 4.0) + 6 * 16, row = 7 + 2 * 16;
    return before(column, row) - after(column, row);
  };
  EXPECT_GT(fallsAt(30.0), 1.0F);
  EXPECT_GT(fallsAt(30.0 - 160.0), 1.0F);
  EXPECT_EQ(fallsAt(30.0 - 80.0), 0.0F);
}

TEST(EditedGround, SpreadsWithTheStepThatComesAfterRest) {
  const auto hashAfter = [](std::uint64_t steps) {
    return applied({bowl(30.0, 30.0, 20.0, 0, "creeps"),
                    bowl(30.0 - 8.0 * 20.0 + 5.0, 30.0, 20.0, steps, "other-bowl")})
        ->hash();
  };
  constexpr std::uint64_t kRest = BowlSurface::kSteps;
  EXPECT_EQ(hashAfter(kRest), hashAfter(0)) << "the other bowl comes first";
  EXPECT_NE(hashAfter(kRest + 1), hashAfter(kRest));
  EXPECT_EQ(hashAfter(kMostEditSteps), hashAfter(kRest + 1));
}

TEST(EditedGround, SpreadsAfterTheSameStepsHoweverItIsPlayed) {
  // The second one spreads into the first, which has done no step since; the third comes where that was.
  std::vector<Edit> edits = {bowl(30.0, 30.0, 20.0, 0, "bowl"),       bowl(30.0, 30.0, 20.0, 0, "creeps"),
                             bowl(230.0, 30.0, 20.0, 0, "creeps"),    bowl(80.0, 40.0, 20.0, 0, "creeps"),
                             bowl(75.0, 30.0, 24.0, 0, "other-bowl"), bowl(500.0, 30.0, 20.0, 0, "creeps"),
                             bowl(340.0, 24.0, 20.0, 0, "creeps")};
  const auto one = played(edits, testWorld(), testDeformer);
  EditedGround other(testWorld(), testDeformer);
  ASSERT_TRUE(other.replay(edits));
  ASSERT_TRUE(other.rest());
  EXPECT_EQ(other.hash(), one->hash());
  EXPECT_GT(edits[3].steps, static_cast<std::uint64_t>(BowlSurface::kSteps)) << "it has spread";
}

/// Planes of up to 60 degrees, over kilometres.
std::shared_ptr<const World> steepWorld() {
  WorldDescription description;
  description.seed = 3;
  description.samples = 33;
  description.pitch = 64.0;
  LayerDescription layer;
  layer.generator = "slope";
  layer.parameters = {{"east", 3000.0}, {"north", 1500.0}};
  layer.samples = 33;
  layer.pitch = 2048.0;
  description.layers.push_back(layer);
  return *World::create(description, *PluginRegistry::standard());
}

TEST(EditedGround, LetsSandRunDownSteepGroundBeyondItsReachHoweverItIsPlayed) {
  const DeformerSource source = deformersOf(PluginRegistry::standard());
  const auto world = steepWorld();
  std::vector<Edit> edits;
  for (int k = 0; k < 6; ++k) {
    const double x = 300.0 + 90.0 * (k % 3);
    edits.push_back({"sand", x, 700.0 + 150.0 * (k / 3), 0.0, 8.0, -8.0, 0, 0, {}});
  }
  edits.push_back({"crater", 420.0, 760.0, 0.0, 30.0, 8.0, 0, 0, {}});
  edits.push_back({"sand", 400.0, 800.0, 0.0, 6.0, 4.0, 0, 0, {}});
  const auto one = played(edits, world, source);
  EditedGround other(world, source);
  ASSERT_TRUE(other.replay(edits));
  ASSERT_TRUE(other.rest());
  EXPECT_EQ(other.hash(), one->hash());
}

TEST(EditedGround, DoesNotSpreadToMoreThanASurfaceMayHave) {
  constexpr double kRadius = 1000.0;
  const auto ground = applied({bowl(30.0, 30.0, kRadius, 0, "creeps")});
  const auto isChangedAt = [&](double x) {
    const BakeRegion patch{static_cast<std::int64_t>(std::floor(x / 64.0)), 0, 1, 1, 0};
    return !sameBits(baked(patch, nullptr), baked(patch, ground.get()));
  };
  EXPECT_TRUE(isChangedAt(30.0));
  EXPECT_FALSE(isChangedAt(30.0 - BowlSurface::kCreep * kRadius));
  EXPECT_EQ(ground->stepsSinceEdit(), static_cast<std::uint64_t>(BowlSurface::kSteps));
}

TEST(EditedGround, GrowsTheFirstWhereSurfacesDoNotMerge) {
  BowlCounts counts;
  EditedGround ground(testWorld(), countedBowls(counts));
  const std::vector<Edit> edits = {bowl(20.0, 20.0), bowl(300.0, 20.0, 20.0, 9), bowl(160.0, 20.0, 150.0, 9),
                                   bowl(20.0, 20.0, 20.0, 9), bowl(400.0, 20.0, 20.0, 9)};
  for (const Edit& edit : edits) ASSERT_TRUE(ground.apply(edit));
  ASSERT_TRUE(ground.rest());
  EXPECT_EQ(counts.begun, 2);
  EXPECT_EQ(counts.grown, 2);
  EXPECT_EQ(ground.hash(), applied(edits)->hash());
}

TEST(EditedGround, BeginsAnotherSurfaceWhereOneDoesNotGrow) {
  const std::vector<Edit> edits = {bowl(20.0, 20.0, 20.0, 0, "small"), bowl(80.0, 20.0, 20.0, 9, "small")};
  const auto before = applied({edits[0]});
  EXPECT_TRUE(
      sameBits(groundOf(kAround, applied(edits).get()),
               bySurface(*testDeformer("small"), kAround, groundOf(kAround, before.get()), {edits[1]})));
}

TEST(EditedGround, TellsWhatWasLostWhereSurfacesEnded) {
  std::vector<Edit> edits = {bowl(20.0, 20.0), bowl(20.0, 25.0, 20.0, 9)};
  EXPECT_EQ(applied(edits)->ended(), EndedSurfaces()) << "what is at rest lives on";
  edits.push_back(bowl(20.0, 20.0, 20.0, 9, "other-bowl"));  // ends the one of two bowls
  EXPECT_EQ(applied(edits)->ended(), (EndedSurfaces{1, -0.5, 0.5}));
  edits.push_back(bowl(20.0, 20.0, 20.0, 9));
  EXPECT_EQ(applied(edits)->ended(), (EndedSurfaces{2, -0.25, 0.75}));
  edits.push_back(bowl(20.0, 20.0, 20.0, 9, "small"));
  edits.push_back(bowl(80.0, 20.0, 20.0, 9, "small"));  // does not grow
  EXPECT_EQ(applied(edits)->ended(), (EndedSurfaces{4, 0.25, 1.25}));
  while (edits.size() < EditedGround::kMostEditsTogether) edits.push_back(bowl(500.0, 500.0, 20.0, 9));
  EXPECT_EQ(applied(edits)->ended().surfaces, 6U) << "and everything ends then";
}

TEST(EditedGround, TellsTheVolumeThatSandWinsOrLosesAtItsEnd) {
  EditedGround ground(testWorld(), deformersOf(PluginRegistry::standard()));
  const Edit dig{"sand", 30.0, 30.0, 0.0, 12.0, 4.0, 3, 0, {}};
  ASSERT_TRUE(ground.apply(dig));
  ASSERT_TRUE(ground.rest());
  const HeightMap before = groundOf(kAround, nullptr), after = groundOf(kAround, &ground);
  double sum = 0.0, moved = 0.0;  // the rim stays, so a square for each sample
  for (std::size_t k = 0; k < before.samples().size(); ++k) {
    const double change = 16.0 * (static_cast<double>(after.samples()[k]) - before.samples()[k]);
    sum += change;
    moved += std::fabs(change);
  }
  Edit other{"crater", 30.0, 30.0, 0.0, 12.0, 1.0, 3, ground.stepsSinceEdit(), {}};
  ASSERT_TRUE(ground.apply(other));
  ASSERT_TRUE(ground.rest());
  EXPECT_GT(moved, 100.0);
  EXPECT_NE(ground.ended().error, 0.0);
  EXPECT_NEAR(ground.ended().error, sum, 1e-5 * moved) << "as nothing was poured";
}

TEST(EditedGround, GrowsNoSurfaceBeyondTheMostJoinedSamples) {
  BowlCounts counts;
  EditedGround ground(testWorld(), countedBowls(counts));
  std::vector<Edit> edits;
  for (int k = 0; k < 6; ++k) {
    edits.push_back(bowl(1900.0 * k, 0.0, 1000.0, 9));
    ASSERT_TRUE(ground.apply(edits.back()));
  }
  ASSERT_TRUE(ground.rest());
  EXPECT_EQ(counts.begun, 2);
  EXPECT_EQ(counts.grown, 4);
  EXPECT_EQ(ground.hash(), applied(edits)->hash());
}

TEST(EditedGround, RefusesWhatTheListAloneTellsAndStaysAsItWas) {
  EditedGround ground(testWorld(), testDeformer);
  ASSERT_TRUE(ground.apply(bowl(0.0, 0.0)));
  const auto complaint = [&](Edit edit, auto change) {
    change(edit);
    const Result<void> refused = ground.apply(edit);
    return refused ? std::string("none") : refused.error().message;
  };
  const Edit good = bowl(10.0, 0.0);
  EXPECT_EQ(complaint(good, [](Edit& edit) { edit.kind = "spade"; }), "there is no deformer \"spade\"");
  EXPECT_EQ(complaint(good, [](Edit& edit) { edit.x = std::nan(""); }),
            "X is \"nan\" but must be a finite number of metres");
  EXPECT_NE(complaint(good,
                      [](Edit& edit) {
                        edit.parameters = {{"deep", 1.0}};
                      })
                .find("deep"),
            std::string::npos);
  EXPECT_NE(complaint(good,
                      [](Edit& edit) {
                        edit.parameters = {{"rough", 99.0}};
                      })
                .find("99"),
            std::string::npos);
  EXPECT_NE(complaint(good, [](Edit& edit) { edit.x = 1e300; }).find("beyond the world"), std::string::npos);
  const double end = static_cast<double>(kMaxPatch) * 64.0 - 64.0;
  EXPECT_NE(
      complaint(good, [&](Edit& edit) { edit.x = end, edit.size = 100.0; }).find("reaches beyond the world"),
      std::string::npos);
  EXPECT_NE(complaint(good, [](Edit& edit) { edit.size = 1e5; }).find("most"), std::string::npos);
  EXPECT_NE(complaint(good, [](Edit& edit) { edit.size = 1e6; }).find("reaches 1e+06 m"), std::string::npos);
  ASSERT_TRUE(ground.rest());
  EXPECT_EQ(ground.hash(), applied({bowl(0.0, 0.0)})->hash());
}

TEST(EditedGround, NamesADeformerThatBreaksItsPromises) {
  const auto failure = [](const std::string& kind) {
    EditedGround ground(testWorld(), testDeformer);
    EXPECT_TRUE(ground.apply(bowl(500.0, 500.0)));
    Result<void> done = ground.apply(bowl(0.0, 0.0, 10.0, 0, kind));
    if (done) done = ground.apply(bowl(0.0, 0.0, 10.0, 2, kind));
    if (done) done = ground.rest();
    if (done) return std::string("none");
    // And it is no list's ground any more.
    const Result<void> next = ground.apply(bowl(0.0, 0.0));
    EXPECT_FALSE(next);
    EXPECT_EQ(next ? "" : next.error().message, done.error().message);
    return done.error().message;
  };
  EXPECT_EQ(failure("bowl"), "none");
  EXPECT_EQ(failure("refuses"), "this bowl cannot be dug");
  EXPECT_EQ(failure("throws"), "the deformer \"throws\" threw \"no sand left\"");
  EXPECT_EQ(failure("not-finite"), "the deformer \"not-finite\" made a height that is not finite");
  EXPECT_EQ(failure("collar"), "the deformer \"collar\" changed the collar around its region");
  EXPECT_EQ(failure("never-rests"),
            "the deformer \"never-rests\" has not come to rest after 1000000 logical steps");
  EXPECT_EQ(failure("never-steps"),
            "the deformer \"never-steps\" has not completed a logical step in 407616 slices");
  EXPECT_EQ(failure("never-spreads"),
            "the deformer \"never-spreads\" says that it would spread, and does not");
  EXPECT_EQ(failure("nowhere"), "the deformer \"nowhere\" would spread to where no ground is");
  EXPECT_EQ(failure("nothing"), "the deformer \"nothing\" began no surface");
  EXPECT_EQ(failure("overshoots"), "the deformer \"overshoots\" did 5 logical steps where 2 were asked for");
}

TEST(EditedGround, OfAListNamesTheEditThatFailsAndCanBeCancelled) {
  const std::vector<Edit> edits = {bowl(0.0, 0.0), bowl(9.0, 0.0), bowl(0.0, 0.0, 10.0, 0, "spade")};
  const auto failed = editedGround(testWorld(), testDeformer, edits);
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().message, "edit 3: there is no deformer \"spade\"");
  const std::vector<Edit> good = {bowl(0.0, 0.0), bowl(9.0, 0.0)};
  std::size_t most = 0;
  const auto ground =
      editedGround(testWorld(), testDeformer, good, [&](std::size_t done, std::size_t wanted) {
        EXPECT_EQ(wanted, 2U);
        most = std::max(most, done);
        return true;
      });
  ASSERT_TRUE(ground);
  EXPECT_EQ(most, 2U);
  EXPECT_EQ((*ground)->hash(), applied(good)->hash());
  const auto cancelled =
      editedGround(testWorld(), testDeformer, good, [](std::size_t done, std::size_t) { return done < 1; });
  ASSERT_FALSE(cancelled);
  EXPECT_NE(cancelled.error().message.find("cancelled"), std::string::npos);
  // Between edits, too, that need no work to be cut up.
  const std::vector<Edit> many(50, bowl(0.0, 0.0));
  EXPECT_FALSE(editedGround(testWorld(), testDeformer, many,
                            [](std::size_t done, std::size_t) { return done != 20; }));
}

TEST(EditedGround, TakesManyStampsInOnePlaceWithoutGrowing) {
  EditedGround ground(testWorld(), testDeformer);
  for (int k = 0; k < 2000; ++k) ASSERT_TRUE(ground.apply(bowl(30.0, 30.0, 6.0, 1)));
  const std::size_t bytes = ground.bytes();
  for (int k = 0; k < 2000; ++k) ASSERT_TRUE(ground.apply(bowl(30.0, 30.0, 6.0, 1)));
  EXPECT_LT(ground.bytes(), 2 * bytes);
  ASSERT_TRUE(ground.rest());
}

TEST(EditedGround, WritesOnlySurfacesThatMovedSinceTheyWereWritten) {
  BowlCounts counts;
  EditedGround ground(testWorld(), countedBowls(counts));
  for (int k = 0; k < 10; ++k) ASSERT_TRUE(ground.apply(bowl(1000.0 * k, 0.0)));
  ASSERT_TRUE(ground.rest());
  EXPECT_EQ(counts.begun, 10);
  EXPECT_EQ(counts.snapshots, 10);
  ASSERT_TRUE(ground.rest());
  EXPECT_EQ(counts.snapshots, 10);
  ASSERT_TRUE(ground.apply(bowl(3000.0, 0.0, 20.0, 6)));
  ASSERT_TRUE(ground.rest());
  EXPECT_EQ(counts.begun, 10);
  EXPECT_EQ(counts.snapshots, 11);
}

TEST(EditedGround, TellsWhereItChangedSinceItWasLastAskedAndNoMore) {
  EditedGround ground(testWorld(), testDeformer);
  EXPECT_TRUE(ground.snapshot().changed.empty());
  ASSERT_TRUE(ground.apply(bowl(150.0, 30.0, 10.0)));
  ASSERT_TRUE(ground.apply(bowl(-90.0, 30.0, 10.0)));
  ASSERT_TRUE(ground.rest());
  EXPECT_GE(ground.snapshot().changed.size(), 2U);
  EXPECT_TRUE(ground.snapshot().changed.empty());
  ASSERT_TRUE(ground.apply(bowl(0.5, 0.5, 10.0, 20)));  // where four patches meet
  ASSERT_TRUE(ground.rest());
  const std::vector<SampleBox> changed = ground.snapshot().changed;
  ASSERT_EQ(changed.size(), 1U);
  EXPECT_EQ(changed[0], (SampleBox{-2, -2, 2, 2})) << "samples less than 10 m from 0.5 m, 4 m apart";
}

TEST(EditedGround, IsTheSameReplayedFromAnyLengthAndAppliesFewEditsAgain) {
  constexpr int kMany = 3 * static_cast<int>(EditedGround::kMostEditsTogether) + 20;
  const std::vector<Edit> edits = randomEdits(12, kMany, 0.0, 0.0);
  const auto beginning = [&](std::size_t count) {
    return std::vector<Edit>(edits.begin(), edits.begin() + static_cast<std::ptrdiff_t>(count));
  };
  BowlCounts counts, others;
  EditedGround ground(testWorld(), countedBowls(counts));
  const auto endedBy = [&](const std::vector<Edit>& list) {
    EditedGround other(testWorld(), countedBowls(others));
    EXPECT_TRUE(other.replay(list));
    EXPECT_TRUE(other.rest());
    return other.ended();
  };
  for (const Edit& edit : edits) ASSERT_TRUE(ground.apply(edit));
  ASSERT_TRUE(ground.rest());
  EXPECT_EQ(counts.applied, kMany);
  for (const std::size_t count : {edits.size() - 1, edits.size() - 20, edits.size() - 21, std::size_t{129},
                                  std::size_t{128}, std::size_t{5}, std::size_t{0}, edits.size()}) {
    const int before = counts.applied;
    ASSERT_TRUE(ground.replay(beginning(count)));
    EXPECT_FALSE(ground.atRest() && count % EditedGround::kMostEditsTogether != 0);
    ASSERT_TRUE(ground.rest());
    EXPECT_EQ(ground.hash(), applied(beginning(count))->hash()) << count;
    EXPECT_TRUE(ground.ended() == endedBy(beginning(count))) << count;
    if (count < edits.size()) {
      EXPECT_LE(counts.applied - before, static_cast<int>(EditedGround::kMostEditsTogether));
    }
  }
}

TEST(EditedGround, BeginsWithWhatAnotherOneHasLeftWhereThatFitsTheEdits) {
  constexpr std::size_t kMany = 2 * EditedGround::kMostEditsTogether + 20;
  const std::vector<Edit> edits = randomEdits(13, static_cast<int>(kMany), 0.0, 0.0);
  EXPECT_FALSE(applied({bowl(0.0, 0.0)})->checkpoint());
  BowlCounts counts;
  EditedGround first(testWorld(), countedBowls(counts)), second(testWorld(), countedBowls(counts));
  ASSERT_TRUE(first.replay(edits));
  ASSERT_TRUE(first.rest());
  const auto left = first.checkpoint();
  ASSERT_TRUE(left);
  counts.applied = 0;
  ASSERT_TRUE(*second.adopt(left, edits));
  ASSERT_TRUE(second.replay(edits));
  ASSERT_TRUE(second.rest());
  EXPECT_EQ(counts.applied, 20);
  EXPECT_EQ(second.hash(), first.hash());
  EXPECT_GE(first.ended().surfaces, 2U) << "at each pause";
  EXPECT_EQ(second.ended(), first.ended());
  const auto refusal = [&](const std::vector<Edit>& list, const std::string& version = "1") {
    EditedGround ground(testWorld(), countedBowls(counts, version));
    return !*ground.adopt(left, list);
  };
  EXPECT_FALSE(refusal(edits));
  std::vector<Edit> other = edits;
  other[100].depth = 4.0;
  EXPECT_TRUE(refusal(other));
  other = edits;
  other[3].parameters = {{"rough", 0.25}};
  EXPECT_TRUE(refusal(other));
  EXPECT_TRUE(refusal({edits.begin(), edits.begin() + 200})) << "fewer edits than made it";
  EXPECT_TRUE(refusal(edits, "2")) << "another version of the deformer";
  other = edits;
  other.back().depth = 4.0;
  EXPECT_FALSE(refusal(other)) << "that one came after it";
}

TEST(EditedGround, ProvesWhatAnotherOneHasLeft) {
  const std::vector<Edit> edits =
      randomEdits(14, static_cast<int>(EditedGround::kMostEditsTogether) + 3, 0.0, 0.0);
  const auto left = applied(edits)->checkpoint();
  ASSERT_TRUE(left);
  EditedGround ground(testWorld(), testDeformer);
  const Result<void> proved = ground.prove(*left, edits);
  EXPECT_TRUE(proved) << proved.error().message;
  ASSERT_TRUE(ground.replay(edits));
  ASSERT_TRUE(ground.rest());
  EXPECT_EQ(ground.hash(), applied(edits)->hash());
  std::string text = left->text();
  text[text.size() - 6] ^= 1;  // a height
  const auto wrong = GroundCheckpoint::read(left->mark(), text);
  ASSERT_TRUE(wrong.ok());
  EXPECT_FALSE(ground.prove(*wrong, edits));
  std::vector<Edit> other = edits;
  other[5].seed ^= 1;
  EditedGround fresh(testWorld(), testDeformer);
  EXPECT_TRUE(fresh.prove(*left, other)) << "which is no fault of the ground's: it is other edits'";
  EXPECT_EQ(fresh.edits(), 0U);
}

TEST(EditedGround, BeginsWithNothingThatWasLeftOnOtherTerrain) {
  const std::vector<Edit> edits =
      randomEdits(15, static_cast<int>(EditedGround::kMostEditsTogether), 0.0, 0.0);
  const auto left = applied(edits)->checkpoint();
  ASSERT_TRUE(left);
  // As if a generator had said otherwise then, of one patch.
  std::string text = left->text();
  for (std::size_t at = text.size() - 12; at + 12 > text.size() - 36; at -= 12) text[at + 8] ^= 1;
  auto read = GroundCheckpoint::read(left->mark(), text);
  ASSERT_TRUE(read.ok());
  const auto other = std::make_shared<const GroundCheckpoint>(*std::move(read));
  EditedGround ground(testWorld(), testDeformer);
  EXPECT_FALSE(*ground.adopt(other, edits));
  EXPECT_TRUE(ground.prove(*other, edits)) << "neither proved nor wrong";
  const auto cancelled = ground.adopt(left, edits, {{}, [] { return false; }});
  ASSERT_FALSE(cancelled);
  EXPECT_EQ(cancelled.error().message, "cancelled");
  EXPECT_TRUE(*ground.adopt(left, edits));
  ASSERT_TRUE(ground.replay(edits));
  EXPECT_EQ(ground.hash(), applied(edits)->hash());
}

TEST(EditedGround, RestsAfterSoManyEditsWhateverTheNextOneSays) {
  std::vector<Edit> edits(EditedGround::kMostEditsTogether + 1, bowl(30.0, 30.0, 12.0, 1));
  const auto hash = applied(edits)->hash();
  edits.back().steps = 4;
  EXPECT_EQ(applied(edits)->hash(), hash);
  edits[edits.size() - 2].steps = 4;
  EXPECT_NE(applied(edits)->hash(), hash);
  BowlCounts counts;
  EditedGround ground(testWorld(), countedBowls(counts));
  for (const Edit& edit : edits) ASSERT_TRUE(ground.apply(edit));
  EXPECT_EQ(counts.begun, 2);
}

TEST(EditedGround, ThatIsTheWorldsOwnAgainIsNobodysChange) {
  const Edit up{"restores", 30.0, 30.0, 0.0, 10.0, -4.0, 0, 0, {}};
  const Edit down{"restores", 30.0, 30.0, 0.0, 10.0, 4.0, 0, 0, {}};
  EditedGround ground(testWorld(), testDeformer);
  const HeightMap before = baked({0, 0, 1, 1, 0}, nullptr);
  ASSERT_TRUE(ground.apply(up));
  ASSERT_TRUE(ground.rest());
  EXPECT_NE(ground.hash(), applied({})->hash());
  ASSERT_FALSE(ground.snapshot().changed.empty());
  ASSERT_TRUE(ground.apply(down));
  ASSERT_TRUE(ground.rest());
  EXPECT_EQ(ground.hash(), applied({})->hash());
  HeightMap nothing(17, 17);
  fillHeights(nothing.view(), -7.0F);
  ground.overlay(0, 0, 0, nothing.view());
  for (const float height : nothing.samples()) EXPECT_EQ(height, -7.0F);
  // But who draws must be told what to draw instead.
  const EditedGround::Snapshot shown = ground.snapshot();
  ASSERT_FALSE(shown.changed.empty());
  HeightMap drawn = baked({0, 0, 1, 1, 0}, nullptr);
  fillHeights(drawn.view().part(5, 5, 6, 6), -7.0F);
  shown.edits->overlay(0, 0, 0, drawn.view());
  EXPECT_EQ(drawn(7, 7), before(7, 7));
}

}  // namespace
}  // namespace teren
