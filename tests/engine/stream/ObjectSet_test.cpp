#include "stream/ObjectSet.h"

#include <bit>
#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "teren/Hash.h"
#include "teren/Script.h"

#include "tests/engine/stream/PatchGround.h"

namespace teren {
namespace {

constexpr double kPitch = 64.0;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The ground as objects ask for it; these do not.
class Unasked final : public Ground {
 public:
  std::optional<double> height(const Position&) const override { return std::nullopt; }
  double pitch() const noexcept override { return kPitch; }
};
const Unasked kUnasked;

/// Flies straight on and remembers what it touched.
class Ball final : public Object {
 public:
  Ball(double x, double y, double z, double radius) {
    motion_.position = *Position::fromMetres(x, y, kPitch);
    motion_.height = z;
    sphere_ = CollisionSphere{radius};
  }
  std::string name() const override { return "ball"; }
  void update(double dt, const Ground&) override {
    ++updates;
    if (frozen) return;
    const auto next = motion_.position.movedBy(motion_.east * dt, motion_.north * dt, kPitch);
    if (next) motion_.position = *next;
    motion_.height += motion_.up * dt;
  }
  Motion motion() const override { return motion_; }
  void place(const Motion& motion) override { motion_ = motion; }
  std::optional<CollisionSphere> collisionSphere() const override { return sphere_; }
  void collided(const Contact& contact) override {
    contacts.push_back(contact);
    if (stops) Object::collided(contact);
  }
  bool handle(const InputEvent& event) override {
    heard.emplace_back(event.name);
    return true;
  }
  void letGo() override { heard.emplace_back("let go"); }

  Ball& fly(double east, double north, double up) {
    motion_.east = east, motion_.north = north, motion_.up = up;
    return *this;
  }
  double x() const { return motion_.position.x(kPitch); }
  double y() const { return motion_.position.y(kPitch); }
  double z() const { return motion_.height; }

  std::vector<Contact> contacts;
  std::vector<std::string> heard;
  std::optional<CollisionSphere> sphere_;
  Motion motion_;
  bool stops = true, frozen = false;
  int updates = 0;
};

Ball& put(ObjectSet& set, double x, double y, double z, double radius) {
  return static_cast<Ball&>(set.add(std::make_unique<Ball>(x, y, z, radius)));
}

PatchGround flat(double height) {
  PatchGround ground(kPitch, 32, [height](std::int64_t, std::int64_t) { return height; });
  ground.addAround(3);
  return ground;
}

PatchGround nothing() {
  return {kPitch, 32, [](std::int64_t, std::int64_t) { return 0.0; }};
}

TEST(ObjectSet, StopsABallOnTheGround) {
  const PatchGround ground = flat(10.0);
  ObjectSet set(kPitch);
  Ball& ball = put(set, 5.0, 5.0, 30.0, 2.0).fly(3.0, 4.0, -40.0);
  set.advance(1.0, kUnasked, ground);
  ASSERT_EQ(ball.contacts.size(), 1U);
  const Contact& contact = ball.contacts[0];
  EXPECT_EQ(contact.other, nullptr);
  EXPECT_NEAR(contact.seconds, 0.45, 1e-12);
  EXPECT_EQ(contact.normal, (std::array<double, 3>{0.0, 0.0, 1.0}));
  EXPECT_EQ(contact.motion.up, -40.0);
  EXPECT_NEAR(ball.z(), 12.0 + kContactGap, 1e-9);
  EXPECT_NEAR(ball.x(), 5.0 + 3.0 * 0.45, 1e-9);
  EXPECT_EQ(ball.motion_.up, 0.0);
}

TEST(ObjectSet, LetsABallRestAndRollOnTheGroundWithoutMoreContacts) {
  const PatchGround ground = flat(10.0);
  ObjectSet set(kPitch);
  Ball& ball = put(set, 5.0, 5.0, 30.0, 2.0).fly(0.0, 0.0, -40.0);
  set.advance(1.0, kUnasked, ground);
  for (int step = 0; step < 100; ++step) set.advance(0.1, kUnasked, ground);
  EXPECT_EQ(ball.contacts.size(), 1U);
  ball.fly(5.0, 3.0, 0.0);
  for (int step = 0; step < 100; ++step) set.advance(0.1, kUnasked, ground);
  EXPECT_EQ(ball.contacts.size(), 1U);
  EXPECT_NEAR(ball.x(), 55.0, 1e-9);
}

TEST(ObjectSet, NoSpeedAndNoStepTakesABallThroughARidge) {
  PatchGround ground(kPitch, 32,
                     [](std::int64_t column, std::int64_t) { return column == 20 ? 100.0 : 0.0; });
  ground.addAround(3);
  for (const double speed : {10.0, 1e3, 1e4, 1e7, 1e12}) {
    for (const double dt : {1e-3, 1.0 / 60.0, 1.0, 1e4}) {
      ObjectSet set(kPitch);
      Ball& bullet = put(set, 0.0, 13.0, 50.0, 0.1).fly(speed, 0.0, 0.0);
      for (int step = 0; step < 20 && bullet.x() + speed * dt < 39.0; ++step)
        set.advance(dt, kUnasked, ground);
      set.advance(dt, kUnasked, ground);
      ASSERT_LT(bullet.x(), 40.0) << speed << " m/s, " << dt << " s";
    }
  }
}

TEST(ObjectSet, TwoHeadOnAt10KilometresASecondMeetInTheMiddle) {
  for (const double dt : {1.0 / 60.0, 1.0, 10.0}) {
    ObjectSet set(kPitch);
    const double away = 0.7 * 1e4 * dt;
    Ball& east = put(set, away, 7.0, 100.0, 5.0).fly(-1e4, 0.0, 0.0);
    Ball& west = put(set, -away, 7.0, 100.0, 5.0).fly(1e4, 0.0, 0.0);
    set.advance(dt, kUnasked, nothing());
    ASSERT_EQ(east.contacts.size(), 1U);
    ASSERT_EQ(west.contacts.size(), 1U);
    EXPECT_NEAR(east.x(), 5.0 + 0.5 * kContactGap, 1e-6);
    EXPECT_NEAR(west.x(), -5.0 - 0.5 * kContactGap, 1e-6);
    EXPECT_EQ(east.contacts[0].other, &west);
    EXPECT_EQ(west.contacts[0].other, &east);
    EXPECT_EQ(east.contacts[0].normal[0], 1.0);
    EXPECT_EQ(west.contacts[0].normal[0], -1.0);
    EXPECT_EQ(east.contacts[0].otherVelocity[0], 1e4);
    EXPECT_EQ(west.contacts[0].otherVelocity[0], -1e4) << "as it was before it was told";
  }
}

TEST(ObjectSet, CrossingTheSamePlaceAtDifferentTimesIsNoCollision) {
  ObjectSet set(kPitch);
  Ball& first = put(set, -100.0, 0.0, 50.0, 5.0).fly(200.0, 0.0, 0.0);
  Ball& second = put(set, 0.0, -180.0, 50.0, 5.0).fly(0.0, 200.0, 0.0);
  set.advance(1.0, kUnasked, nothing());
  EXPECT_TRUE(first.contacts.empty());
  EXPECT_TRUE(second.contacts.empty());
  EXPECT_NEAR(first.x(), 100.0, 1e-9);
}

TEST(ObjectSet, TheEarliestCollisionOfAStepDecidesTheOthers) {
  ObjectSet set(kPitch);
  // The first would hit the second late, but the third stops it before; then the fourth runs into both.
  Ball& first = put(set, 0.0, 0.0, 50.0, 1.0).fly(100.0, 0.0, 0.0);
  Ball& second = put(set, 90.0, 0.0, 50.0, 1.0);
  Ball& third = put(set, 20.0, 0.0, 50.0, 1.0);
  Ball& fourth = put(set, -50.0, 0.0, 50.0, 1.0).fly(100.0, 0.0, 0.0);
  set.advance(1.0, kUnasked, nothing());
  EXPECT_EQ(first.contacts.size(), 2U);
  EXPECT_EQ(first.contacts[0].other, &third);
  EXPECT_EQ(first.contacts[1].other, &fourth);
  EXPECT_TRUE(second.contacts.empty());
  EXPECT_NEAR(first.x(), 18.0, 2.0 * kContactGap);
  EXPECT_NEAR(fourth.x(), 16.0, 3.0 * kContactGap);
  EXPECT_NEAR(third.x(), 20.0, 1e-12);
}

TEST(ObjectSet, AtEqualTimesTheGroundComesFirstThenTheOrderOfAdding) {
  const PatchGround ground = flat(0.0);
  std::vector<std::string> order;
  class Teller final : public Object {
   public:
    Teller(std::vector<std::string>& log, std::string word, Motion motion)
        : log_(log), word_(std::move(word)), motion_(motion) {}
    void update(double dt, const Ground&) override {
      motion_.position = *motion_.position.movedBy(motion_.east * dt, 0.0, kPitch);
      motion_.height += motion_.up * dt;
    }
    Motion motion() const override { return motion_; }
    void place(const Motion& motion) override { motion_ = motion; }
    std::optional<CollisionSphere> collisionSphere() const override { return CollisionSphere{1.0}; }
    void collided(const Contact& contact) override {
      log_.push_back(word_ + (contact.other ? " object" : " ground"));
      Object::collided(contact);
    }

   private:
    std::vector<std::string>& log_;
    std::string word_;
    Motion motion_;
  };
  ObjectSet set(kPitch);
  const auto add = [&](const char* word, double x, double z, double east, double up) {
    set.add(std::make_unique<Teller>(order, word,
                                     Motion{*Position::fromMetres(x, 8.0, kPitch), z, east, 0.0, up}));
  };
  add("a", 8.0, 50.0, 8.0, 0.0);
  add("b", 18.0, 50.0, 0.0, 0.0);   // touched by a after 1 s
  add("c", -20.0, 9.0, 0.0, -8.0);  // touches the ground after 1 s
  add("d", -40.0, 9.0, 0.0, -8.0);
  set.advance(2.0, kUnasked, ground);
  EXPECT_EQ(order, (std::vector<std::string>{"c ground", "d ground", "a object", "b object"}));
}

TEST(ObjectSet, TwoThatOverlapMayPartButNotComeNearer) {
  ObjectSet set(kPitch);
  Ball& here = put(set, 0.0, 0.0, 50.0, 5.0);
  Ball& there = put(set, 4.0, 0.0, 50.0, 5.0);
  set.advance(1.0, kUnasked, nothing());
  EXPECT_TRUE(here.contacts.empty());
  there.fly(1.0, 0.0, 0.0);
  set.advance(1.0, kUnasked, nothing());
  EXPECT_TRUE(here.contacts.empty());
  EXPECT_NEAR(there.x(), 5.0, 1e-12);
  there.fly(-1.0, 0.0, 0.0);
  set.advance(1.0, kUnasked, nothing());
  EXPECT_EQ(here.contacts.size(), 1U);
  EXPECT_EQ(there.contacts[0].seconds, 0.0);
}

TEST(ObjectSet, GroundThatComesOverAnObjectLiftsIt) {
  ObjectSet set(kPitch);
  Ball& ball = put(set, 5.0, 5.0, -30.0, 2.0);
  set.advance(0.1, kUnasked, nothing());
  EXPECT_TRUE(ball.contacts.empty());
  set.advance(0.1, kUnasked, flat(10.0));
  ASSERT_EQ(ball.contacts.size(), 1U);
  EXPECT_EQ(ball.contacts[0].other, nullptr);
  EXPECT_NEAR(ball.z(), 12.0 + kContactGap, 1e-9);
  set.advance(0.1, kUnasked, flat(10.0));
  EXPECT_EQ(ball.contacts.size(), 1U);
}

TEST(ObjectSet, AJumpBetweenUpdatesIsNoWay) {
  const PatchGround ground = flat(0.0);
  ObjectSet set(kPitch);
  Ball& ball = put(set, -150.0, 0.0, 20.0, 2.0);
  put(set, 0.0, 0.0, 20.0, 2.0);
  set.advance(0.1, kUnasked, ground);
  ball.place({*Position::fromMetres(150.0, 0.0, kPitch), 20.0});
  set.advance(0.1, kUnasked, ground);
  EXPECT_TRUE(ball.contacts.empty());
  EXPECT_NEAR(ball.x(), 150.0, 1e-12);
}

TEST(ObjectSet, WhoHasNoBallTouchesNothing) {
  const PatchGround ground = flat(0.0);
  ObjectSet set(kPitch);
  Ball& ghost = put(set, 0.0, 0.0, 20.0, 2.0).fly(0.0, 0.0, -40.0);
  ghost.sphere_.reset();
  set.advance(1.0, kUnasked, ground);
  EXPECT_TRUE(ghost.contacts.empty());
  EXPECT_EQ(ghost.z(), -20.0);
}

TEST(ObjectSet, WhoWillNotStopIsToldAndGoesOn) {
  ObjectSet set(kPitch);
  Ball& ram = put(set, 0.0, 0.0, 20.0, 1.0).fly(100.0, 0.0, 0.0);
  ram.stops = false;
  Ball& wall = put(set, 50.0, 0.0, 20.0, 1.0);
  set.advance(1.0, kUnasked, nothing());
  EXPECT_EQ(ram.contacts.size(), 1U);
  EXPECT_EQ(wall.contacts.size(), 1U);
  EXPECT_EQ(ram.x(), 100.0);
}

TEST(ObjectSet, MotionThatCannotBeIsRefusedInOneSentenceAndTheOthersFlyOn) {
  const PatchGround ground = flat(0.0);
  const Motion good{{0, 0, 0.5, 0.5}, 50.0};
  const double nan = std::nan("");
  for (const Motion& bad :
       {Motion{{0, 0, nan, 0.5}, 50.0}, Motion{{0, 0, 0.5, 1.0}, 50.0},
        Motion{{kMaxPatch, 0, 0.5, 0.5}, 50.0},
        Motion{{0, std::numeric_limits<std::int64_t>::min(), 0.5, 0.5}, 50.0}, Motion{{}, nan},
        Motion{{}, 1e300}, Motion{{}, 0.0, kInfinity}, Motion{{}, 0.0, 0.0, nan},
        Motion{{}, 0.0, 0.0, 0.0, -kInfinity}, Motion{{}, 0.0, 0.0, 0.0, 0.0, nan}}) {
    ObjectSet set(kPitch);
    Ball& mad = put(set, 32.0, 32.0, 50.0, 1.0);
    Ball& sane = put(set, 0.0, 0.0, 50.0, 1.0).fly(10.0, 0.0, 0.0);
    set.advance(0.1, kUnasked, ground);
    mad.motion_ = bad;
    mad.frozen = true;
    for (int step = 0; step < 3; ++step) set.advance(0.1, kUnasked, ground);
    EXPECT_EQ(set.motions()[0].position, good.position);
    EXPECT_EQ(set.motions()[0].height, 50.0);
    EXPECT_NEAR(sane.x(), 4.0, 1e-12);
    const std::vector<std::string> messages = set.takeMessages();
    ASSERT_EQ(messages.size(), 1U);
    EXPECT_TRUE(messages[0].starts_with("object 1, \"ball\", says it has a ")) << messages[0];
    EXPECT_TRUE(set.takeMessages().empty());
    mad.motion_ = good;
    set.advance(0.1, kUnasked, ground);
    EXPECT_EQ(set.motions()[0].position, good.position);
  }
}

TEST(ObjectSet, SpheresThatCannotBeAreRefusedInOneSentence) {
  const PatchGround ground = flat(0.0);
  for (const CollisionSphere& bad :
       {CollisionSphere{-1.0}, CollisionSphere{std::nan("")}, CollisionSphere{kInfinity},
        CollisionSphere{100.1}, CollisionSphere{60.0, 50.0}, CollisionSphere{1.0, 0.0, std::nan("")}}) {
    ObjectSet set(kPitch);
    Ball& ball = put(set, 0.0, 0.0, 20.0, 1.0).fly(0.0, 0.0, -40.0);
    ball.sphere_ = bad;
    set.advance(1.0, kUnasked, ground);
    EXPECT_TRUE(ball.contacts.empty());
    const std::vector<std::string> messages = set.takeMessages();
    ASSERT_EQ(messages.size(), 1U);
    EXPECT_NE(messages[0].find("object 1, \"ball\", has a collision sphere"), std::string::npos)
        << messages[0];
  }
}

TEST(ObjectSet, TimeThatCannotBeMovesNothing) {
  ObjectSet set(kPitch);
  Ball& ball = put(set, 0.0, 0.0, 20.0, 1.0).fly(1.0, 0.0, 0.0);
  for (const double dt : {std::nan(""), kInfinity, -1.0}) set.advance(dt, kUnasked, nothing());
  EXPECT_EQ(ball.x(), 0.0);
  EXPECT_EQ(ball.updates, 3);
  EXPECT_EQ(set.takeMessages().size(), 1U);
}

TEST(ObjectSet, AnObjectOffItsPositionByItsBallsOffsetTouchesWithTheBall) {
  const PatchGround ground = flat(0.0);
  ObjectSet set(kPitch);
  Ball& ball = put(set, 0.0, 0.0, 20.0, 1.0).fly(0.0, 0.0, -40.0);
  ball.sphere_ = CollisionSphere{1.0, 0.0, 0.0, -3.0};
  set.advance(1.0, kUnasked, ground);
  EXPECT_NEAR(ball.z(), 4.0 + kContactGap, 1e-9);
  EXPECT_EQ(set.motions()[0].reach, 4.0);
}

TEST(ObjectSet, KeysReachTheActiveObjectOnly) {
  ObjectSet set(kPitch);
  EXPECT_FALSE(set.handle({"A", 1.0}));
  Ball& first = put(set, 0.0, 0.0, 0.0, 1.0);
  Ball& second = put(set, 50.0, 0.0, 0.0, 1.0);
  EXPECT_TRUE(set.handle({"A", 1.0}));
  set.setActive(1);
  set.handle({"B", 1.0});
  set.setActive(1);
  set.letGo();
  EXPECT_EQ(first.heard, (std::vector<std::string>{"A", "let go"}));
  EXPECT_EQ(second.heard, (std::vector<std::string>{"B", "let go"}));
}

// ---- Random programs against fine steps in long double

struct Trace {
  Point from, to;
  double stops = 1.0;  // share of the step after which it stands, at `to`
  double radius = 0.0;

  Point at(long double time) const {
    const long double share = time >= stops ? 1.0L : time / stops;
    return {from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1]),
            from[2] + share * (to[2] - from[2])};
  }
};

TEST(ObjectSet, RandomProgramsNeverPassThroughGroundOrEachOther) {
  constexpr double kDt = 1.0 / 30.0;
  int contacts = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    PatchGround ground(16.0, 4, [seed](std::int64_t column, std::int64_t row) {
      const std::uint64_t bits =
          hashWith(hashWith(seed, static_cast<std::uint64_t>(column)), static_cast<std::uint64_t>(row));
      return static_cast<double>(bits % 12'001) / 1000.0;
    });
    ground.addAround(4);
    const GroundSweep sweep(ground, 16.0);
    Dice dice(seed + 100);
    ObjectSet set(16.0);
    std::vector<Ball*> balls;
    for (int k = 0; k < 12; ++k) {
      auto ball = std::make_unique<Ball>(0.0, 0.0, 0.0, dice.between(0.2, 1.5));
      ball->motion_.position = *Position::fromMetres(-24.0 + 16.0 * (k % 4), -24.0 + 16.0 * (k / 4), 16.0);
      ball->motion_.height = 30.0 + k;
      balls.push_back(static_cast<Ball*>(&set.add(std::move(ball))));
    }
    for (int step = 0; step < 120; ++step) {
      std::vector<Trace> traces;
      for (Ball* ball : balls) {
        const double x = ball->motion_.position.x(16.0), y = ball->motion_.position.y(16.0);
        // Towards some place over or under the ground, at 30 m/s or at 3 km/s. Ball::update counts in patches
        // of 64 m.
        const double rate = (dice.between(0.0, 1.0) < 0.3 ? 1.0 : 0.05) / kDt;
        ball->fly(4.0 * rate * (dice.between(-50, 50) - x), 4.0 * rate * (dice.between(-50, 50) - y),
                  rate * (dice.between(-20, 25) - ball->z()));
        ball->contacts.clear();
        traces.push_back({{x, y, ball->z()}, {}, 1.0, ball->sphere_->radius});
      }
      set.advance(kDt, kUnasked, ground);
      for (std::size_t k = 0; k < balls.size(); ++k) {
        Ball& ball = *balls[k];
        contacts += static_cast<int>(ball.contacts.size());
        traces[k].to = {ball.motion_.position.x(16.0), ball.motion_.position.y(16.0), ball.z()};
        if (!ball.contacts.empty()) traces[k].stops = ball.contacts[0].seconds / kDt;
      }
      const double allowed = 2.0 * kContactGap;  // it is put back by one gap along the normal
      for (int look = 0; look <= 100; ++look) {
        const long double time = look / 100.0L;
        for (std::size_t a = 0; a < traces.size(); ++a) {
          const Point at = traces[a].at(time);
          long double above = 1.0L;
          const long double away = ground.distance(at[0], at[1], at[2], traces[a].radius + 0.1, &above);
          ASSERT_GT(above, 0.0L) << "seed " << seed << ", step " << step << ", ball " << a;
          ASSERT_GT(away, traces[a].radius - allowed)
              << "seed " << seed << ", step " << step << ", ball " << a;
          for (std::size_t b = 0; b < a; ++b) {
            ASSERT_GT(length(minus(at, traces[b].at(time))), traces[a].radius + traces[b].radius - allowed)
                << "seed " << seed << ", step " << step << ", balls " << a << " and " << b;
          }
        }
      }
    }
  }
  EXPECT_GT(contacts, 500);
}

TEST(ObjectSet, RandomProgramsEndInTheSameBitsEveryTime) {
  const auto hashOf = [] {
    PatchGround ground(kPitch, 32, [](std::int64_t column, std::int64_t row) {
      return static_cast<double>(
          hashWith(static_cast<std::uint64_t>(column), static_cast<std::uint64_t>(row)) % 7);
    });
    ground.addAround(3);
    ObjectSet set(kPitch);
    Dice dice(3);
    std::vector<Ball*> balls;
    for (int k = 0; k < 8; ++k) balls.push_back(&put(set, 20.0 * k - 80.0, 0.0, 30.0, 2.0));
    std::uint64_t hash = 0;
    for (int step = 0; step < 100; ++step) {
      for (Ball* ball : balls) {
        ball->fly(dice.between(-50, 50) - ball->x(), dice.between(-50, 50) - ball->y(),
                  dice.between(-50, 20));
      }
      set.advance(1.0 / 60.0, kUnasked, ground);
      for (Ball* ball : balls) {
        for (const double value : {ball->x(), ball->y(), ball->z()}) {
          hash = hashWith(hash, std::bit_cast<std::uint64_t>(value));
        }
      }
    }
    return hash;
  };
  EXPECT_EQ(hashOf(), hashOf());
}

}  // namespace
}  // namespace teren
