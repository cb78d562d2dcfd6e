#include "shared/human/locomotion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <vector>

#include "shared/human/animator.h"
#include "shared/human/gait.h"
#include "shared/human/turns.h"
#include "tests/human/full_body.h"

namespace lararium::human {
namespace {

constexpr float kWalkTick = 1.0f / 120.0f;

// A person who walks as a test says, tick by tick, and the drawn pose.
class Walk {
 public:
  explicit Walk(const Human& human, FloorHeight floor = {})
      : model_(MakeAnimationRig(std::make_shared<Human>(human))),
        animator_(model_),
        floor_(std::move(floor)) {
    performance_.seed = 7;
    Step(0.0f, 0.0f);
  }

  // Advances one tick; speed is forward, in m/s, and turn_rate in rad/s.
  void Step(float speed, float turn_rate) {
    previous_ = performance_;
    heading_ += turn_rate * kWalkTick;
    position_ += speed * kWalkTick * (TurnY(heading_) * glm::vec3(0.0f, 0.0f, -1.0f));
    UpdateAnimationState(*model_, position_, heading_, kWalkTick, floor_, performance_);
  }

  // Draws the pose between the last two ticks.
  void Draw(float alpha) {
    shown_ = Interpolate(previous_, performance_, alpha);
    animator_.Pose(shown_);
  }

  glm::vec3 Stage(const glm::vec3& actor) const {
    const Locomotion& at = shown_.locomotion;
    return at.position + TurnY(at.heading) * actor;
  }
  glm::vec3 InActor(JointIndex joint) const {
    return glm::vec3(animator_.actor_from_joint()[static_cast<size_t>(joint)][3]);
  }
  glm::vec3 InStage(JointIndex joint) const { return Stage(InActor(joint)); }

  const BodyRig& body() const { return model_->locomotion.body; }
  const AnimationRig& model() const { return *model_; }
  const AnimationState& shown() const { return shown_; }
  AnimationState& animation_state() { return performance_; }
  const Animator& animator() const { return animator_; }
  float walked() const { return glm::length(position_); }
  glm::vec3 position() const { return position_; }

 private:
  std::shared_ptr<const AnimationRig> model_;
  Animator animator_;
  AnimationState performance_, previous_, shown_;
  FloorHeight floor_;
  glm::vec3 position_ = glm::vec3(0.0f);
  float heading_ = 0.0f;
};

// Records the slide of each planted foot from landing to leaving: at the joint of the ball while
// the toes are down, and at the ankle while the sole is flat.
class SlideMeter {
 public:
  void Look(const Walk& walk) {
    for (int side = 0; side < 2; ++side) {
      const auto s = static_cast<size_t>(side);
      const Locomotion::Foot& foot = walk.shown().locomotion.feet[s];
      const BodyRig::Leg& leg = walk.body().legs[s];
      if (!foot.planted) {
        ball_[s].Lift(slides_);
        ankle_[s].Lift(slides_);
        continue;
      }
      if (foot.pitch <= 0.0f) {
        ball_[s].Touch(walk.InStage(leg.toes[0]));
      }
      if (std::abs(foot.pitch) < 1e-6f) {
        ankle_[s].Touch(walk.InStage(leg.ankle));
      }
    }
  }

  size_t steps() const { return slides_.size() / 2; }
  float worst() const {
    return slides_.empty() ? 0.0f : *std::max_element(slides_.begin(), slides_.end());
  }

 private:
  class Contact {
   public:
    void Touch(const glm::vec3& at) {
      if (!touches_) {
        first_ = at;
        touches_ = true;
      }
      slide_ = std::max(slide_, glm::distance(at, first_));
    }
    void Lift(std::vector<float>& slides) {
      if (touches_) {
        slides.push_back(slide_);
      }
      touches_ = false;
      slide_ = 0.0f;
    }

   private:
    bool touches_ = false;
    glm::vec3 first_;
    float slide_ = 0.0f;
  };
  std::array<Contact, 2> ball_, ankle_;
  std::vector<float> slides_;
};

// Walks twenty metres with curves to both sides, a turn on the spot and all speeds.
template <typename Each>
void WalkTwentyMetres(Walk& walk, const Each& each) {
  struct Leg {
    float seconds, speed, turn_rate;
  };
  constexpr Leg kLegs[] = {{1.0f, 0.0f, 0.0f},  {3.0f, 1.3f, 0.0f},  {1.5f, 1.0f, 1.0f},
                           {2.0f, 1.5f, 0.0f},  {2.5f, 0.7f, -1.2f}, {1.5f, 0.0f, 2.0f},
                           {1.0f, 0.0f, 0.0f},  {3.0f, 0.3f, 0.3f},  {2.0f, 2.0f, 0.0f},
                           {2.0f, 1.2f, -0.8f}, {3.0f, 1.0f, 0.4f},  {1.5f, 0.0f, 0.0f}};
  float speed = 0.0f, turn_rate = 0.0f;
  for (const Leg& leg : kLegs) {
    for (float time = 0.0f; time < leg.seconds; time += kWalkTick) {
      speed += std::clamp(leg.speed - speed, -2.5f * kWalkTick, 2.5f * kWalkTick);
      turn_rate += std::clamp(leg.turn_rate - turn_rate, -8.0f * kWalkTick, 8.0f * kWalkTick);
      walk.Step(speed, turn_rate);
      each();
    }
  }
}

TEST(Locomotion, PlantedFeetDoNotSlideOverTwentyMetresWithTurns) {
  for (const uint64_t axes : {0u, 3u}) {
    Walk walk(FullBody(0.6f, axes));
    SlideMeter meter;
    int tick = 0;
    float length = 0.0f;
    glm::vec3 before = walk.position();
    WalkTwentyMetres(walk, [&] {
      length += glm::distance(walk.position(), before);
      before = walk.position();
      walk.Draw(0.25f * static_cast<float>(++tick % 4));
      meter.Look(walk);
    });
    EXPECT_GT(meter.steps(), 25u);
    EXPECT_GT(length, 20.0f);
    EXPECT_LT(meter.worst(), 0.005f);
    RecordProperty("worst_slide_micrometres", static_cast<int>(1e6f * meter.worst()));
  }
}

TEST(Locomotion, StepsAreAsLongAsTheSpeedAsks) {
  // Walk ratio (Sekiya & Nagasaki, 1998): step length over cadence, about 6.4 mm per step
  // a minute for grown people at any speed.
  for (const float speed : {0.4f, 0.8f, 1.3f, 1.8f}) {
    Walk walk(FullBody(0.6f, 0));
    for (int tick = 0; tick < 3 * 120; ++tick) {
      walk.Step(speed, 0.0f);
    }
    int steps = 0;
    std::array<bool, 2> stood = {true, true};
    const float begin = walk.walked();
    constexpr float kSeconds = 12.0f;
    for (float time = 0.0f; time < kSeconds; time += kWalkTick) {
      walk.Step(speed, 0.0f);
      for (size_t side = 0; side < 2; ++side) {
        const bool stands = walk.animation_state().locomotion.feet[side].planted;
        steps += stands && !stood[side] ? 1 : 0;
        stood[side] = stands;
      }
    }
    const float length = (walk.walked() - begin) / static_cast<float>(steps);
    const float cadence = 60.0f * static_cast<float>(steps) / kSeconds;
    EXPECT_NEAR(length / cadence, 0.0064f, 0.0010f) << speed;
  }
}

TEST(Locomotion, BendsKneesOnlyBackwardsAndLikeWalkers) {
  Walk walk(FullBody(0.6f, 5));
  float most = 0.0f;
  for (int tick = 0; tick < 8 * 120; ++tick) {
    walk.Step(std::min(1.3f, 2.0f * kWalkTick * static_cast<float>(tick)), 0.0f);
    walk.Draw(1.0f);
    for (const BodyRig::Leg& leg : walk.body().legs) {
      const glm::vec3 hip = walk.InActor(leg.hip), knee = walk.InActor(leg.knee);
      const glm::vec3 ankle = walk.InActor(leg.ankle);
      const glm::vec3 bend = glm::cross(knee - hip, ankle - knee);
      EXPECT_LT(bend.x, 1e-3f);  // shanks go back
      const float flexion = std::asin(std::clamp(
          glm::length(bend) / glm::distance(hip, knee) / glm::distance(knee, ankle), 0.0f, 1.0f));
      most = std::max(most, flexion);
    }
  }
  // 60 degrees in swing (Perry & Burnfield, 2010).
  EXPECT_GT(most, 0.80f);
  EXPECT_LT(most, 1.35f);
}

TEST(Locomotion, KeepsToesOffTheFloorInSwing) {
  for (const float speed : {0.3f, 0.9f, 1.3f, 1.9f}) {
    Walk walk(FullBody(0.6f, 0));
    float lowest = 1.0f;
    for (int tick = 0; tick < 6 * 120; ++tick) {
      walk.Step(std::min(speed, 2.0f * kWalkTick * static_cast<float>(tick)), 0.0f);
      walk.Draw(1.0f);
      for (size_t side = 0; side < 2; ++side) {
        const Locomotion::Foot& foot = walk.shown().locomotion.feet[side];
        if (!foot.planted && foot.swing > 0.3f && foot.swing < 0.9f) {
          const BodyRig::Leg& leg = walk.body().legs[side];
          lowest = std::min(lowest, walk.InStage(leg.toes[0]).y - leg.ball.y);
        }
      }
    }
    EXPECT_GT(lowest, 0.004f) << speed;
    EXPECT_LT(lowest, 0.05f) << speed;  // not marching
  }
}

TEST(Locomotion, SwingsArmsAgainstLegsAndClearOfTheBody) {
  Walk walk(FullBody(0.6f, 2));
  float together = 0.0f;
  for (int tick = 0; tick < 8 * 120; ++tick) {
    walk.Step(1.3f, 0.0f);
    walk.Draw(1.0f);
    if (tick < 240) {
      continue;
    }
    const auto ahead = [&](JointIndex joint) { return -walk.InActor(joint).z; };
    const auto& body = walk.body();
    const float arms = ahead(body.arms[kRight].wrist) - ahead(body.arms[kLeft].wrist);
    const float legs = ahead(body.legs[kRight].ankle) - ahead(body.legs[kLeft].ankle);
    together += arms * legs;
    for (const int side : {kRight, kLeft}) {
      const JointIndex wrist = body.arms[static_cast<size_t>(side)].wrist;
      EXPECT_GT(SideSign(side) * walk.InActor(wrist).x, 0.16f);
    }
  }
  EXPECT_LT(together, -1.0f);
}

TEST(Locomotion, StandsStillWithBothFeetFlatUnderTheHips) {
  Walk walk(FullBody(0.6f, 0));
  for (int tick = 0; tick < 240; ++tick) {
    walk.Step(1.2f, 0.0f);
  }
  for (int tick = 0; tick < 360; ++tick) {
    walk.Step(0.0f, 0.0f);
  }
  const Locomotion before = walk.animation_state().locomotion;
  walk.Step(0.0f, 0.0f);
  const Locomotion after = walk.animation_state().locomotion;
  EXPECT_FALSE(after.stepping);
  for (size_t side = 0; side < 2; ++side) {
    EXPECT_TRUE(after.feet[side].planted);
    EXPECT_EQ(after.feet[side].ankle, before.feet[side].ankle);
    EXPECT_NEAR(after.feet[side].pitch, 0.0f, 1e-3f);
    const glm::vec3 from_root = after.feet[side].print.position - after.position;
    EXPECT_LT(std::abs(from_root.z), 0.09f);
  }
}

TEST(Locomotion, TurnsOnTheSpotInSteps) {
  Walk walk(FullBody(0.6f, 0));
  SlideMeter meter;
  for (int tick = 0; tick < 4 * 120; ++tick) {
    walk.Step(0.0f, tick < 180 ? 2.0f : 0.0f);
    walk.Draw(0.5f);
    meter.Look(walk);
    for (const Locomotion::Foot& foot : walk.shown().locomotion.feet) {
      const float turned =
          std::remainder(foot.print.heading - walk.shown().locomotion.heading, 2.0f * kPiF);
      EXPECT_LT(std::abs(turned), 1.1f);  // No leg is twisted.
    }
  }
  EXPECT_GE(meter.steps(), 4u);
  EXPECT_LT(meter.worst(), 0.005f);
}

TEST(Locomotion, FollowsAFloorThatIsNotLevel) {
  const FloorHeight floor = [](float x, float z) { return 0.04f * std::sin(2.0f * z) + 0.1f * x; };
  Walk walk(FullBody(0.6f, 0), floor);
  SlideMeter meter;
  for (int tick = 0; tick < 6 * 120; ++tick) {
    walk.Step(1.1f, 0.0f);
    walk.Draw(1.0f);
    meter.Look(walk);
    for (size_t side = 0; side < 2; ++side) {
      const Locomotion::Foot& foot = walk.shown().locomotion.feet[side];
      if (foot.planted && std::abs(foot.pitch) < 1e-6f) {
        const BodyRig::Leg& leg = walk.body().legs[side];
        const glm::vec3 ball = walk.InStage(leg.toes[0]);
        EXPECT_NEAR(ball.y - leg.ball.y, floor(ball.x, ball.z), 0.012f);
      }
    }
  }
  EXPECT_LT(meter.worst(), 0.005f);
}

TEST(Locomotion, PutsTheFeetDownAnewAfterATeleport) {
  const auto model = MakeAnimationRig(std::make_shared<Human>(FullBody(0.6f, 0)));
  Locomotion state;
  UpdateLocomotion(model->locomotion, glm::vec3(0.0f), 0.0f, kWalkTick, {}, state);
  const Locomotion before = state;
  const glm::vec3 there(3.0f, 0.0f, -4.0f);
  UpdateLocomotion(model->locomotion, there, 1.0f, kWalkTick, {}, state);
  for (const Locomotion::Foot& foot : state.feet) {
    EXPECT_TRUE(foot.planted);
    EXPECT_LT(glm::distance(foot.print.position, there), 0.2f);
  }
  EXPECT_EQ(state.velocity, glm::vec3(0.0f));
  EXPECT_EQ(Interpolate(before, state, 0.3f), state);
}

TEST(Locomotion, LooksTheSameWhereverOneSeeks) {
  Walk played(FullBody(0.6f, 0)), replayed(FullBody(0.6f, 0));
  WalkTwentyMetres(played, [] {});
  WalkTwentyMetres(replayed, [] {});
  EXPECT_EQ(played.animation_state(), replayed.animation_state());
}

// The greatest acceleration of a joint over a walk, m/s^2.
class JoltMeter {
 public:
  void Look(const glm::vec3& at) {
    if (++looks_ > 2) {
      worst_ = std::max(worst_, glm::length(at - 2.0f * last_ + before_) / (kWalkTick * kWalkTick));
    }
    before_ = last_;
    last_ = at;
  }
  float worst() const { return worst_; }

 private:
  int looks_ = 0;
  glm::vec3 last_ = glm::vec3(0.0f), before_ = glm::vec3(0.0f);
  float worst_ = 0.0f;
};

TEST(Locomotion, MovesWithoutJolts) {
  Walk walk(FullBody(0.6f, 0));
  JoltMeter head, ankle;
  WalkTwentyMetres(walk, [&] {
    walk.Draw(1.0f);
    head.Look(walk.InStage(walk.body().head));
    ankle.Look(walk.InStage(walk.body().legs[kLeft].ankle));
  });
  // The walk starts and stops hard, at 2.5 m/s^2.
  EXPECT_LT(head.worst(), 60.0f);
  EXPECT_LT(ankle.worst(), 120.0f);
}

TEST(Locomotion, CarriesTheHeadEvenlyAtAnySpeed) {
  for (const float speed : {0.3f, 0.7f, 1.0f, 1.3f}) {
    Walk walk(FullBody(0.6f, 0));
    walk.animation_state().idle_intensity = 0.0f;
    JoltMeter head;
    float low = 10.0f, high = 0.0f;
    for (int tick = 0; tick < 8 * 120; ++tick) {
      walk.Step(std::min(speed, kWalkTick * static_cast<float>(tick)), 0.0f);
      walk.Draw(1.0f);
      if (tick > 3 * 120) {
        const glm::vec3 at = walk.InStage(walk.body().head);
        head.Look(at);
        low = std::min(low, at.y);
        high = std::max(high, at.y);
      }
    }
    EXPECT_LT(head.worst(), 18.0f) << speed;
    // It rises by 4 to 5 cm at a comfortable speed (Saunders et al., 1953).
    EXPECT_LT(high - low, 0.055f) << speed;
    EXPECT_GT(high - low, speed > 1.2f ? 0.03f : 0.005f) << speed;
  }
}

TEST(Locomotion, LeavesAFigureWithoutLegsAtRest) {
  Human human = FullBody(0.6f, 0);
  human.skeleton.names[*human.skeleton.Find("l_knee")] = "something";
  Walk walk(human);
  walk.Step(1.0f, 0.0f);
  walk.Draw(1.0f);
  const BodyRig& body = walk.body();
  EXPECT_FALSE(body.walks());
  EXPECT_LT(glm::distance(walk.InActor(body.legs[kRight].ankle),
                          body.rest[static_cast<size_t>(body.legs[kRight].ankle)].position),
            1e-5f);
}

TEST(GaitStyleNamed, MakesPeopleWalkDifferentlyWithoutSliding) {
  for (const char* name : {"grown", "child", "stout", "old"}) {
    Walk walk(FullBody(0.6f, 0));
    const auto style = GaitStyleNamed(name);
    ASSERT_TRUE(style.has_value()) << name;
    walk.animation_state().locomotion.style = *style;
    SlideMeter meter;
    for (int tick = 0; tick < 6 * 120; ++tick) {
      walk.Step(std::min(0.9f, kWalkTick * static_cast<float>(tick)), 0.2f);
      walk.Draw(0.5f);
      meter.Look(walk);
    }
    EXPECT_GT(meter.steps(), 6u) << name;
    EXPECT_LT(meter.worst(), 0.005f) << name;
  }
  EXPECT_EQ(GaitStyleNamed("drunk"), std::nullopt);
}

TEST(StrideAt, ChildrenStepFasterThanGrownPeople) {
  const Stride grown = StrideAt(1.0f, 1.0f, 0.0f, 0.9f, {});
  const Stride child = StrideAt(1.0f, 1.0f, 0.0f, 0.6f, {});
  EXPECT_GT(child.per_second, 1.15f * grown.per_second);
  EXPECT_GT(child.amount, grown.amount);
}

TEST(StancePitch, BeginsOnTheHeelRestsFlatAndEndsOnTheToes) {
  EXPECT_GT(StancePitch(0.0f), 0.2f);
  EXPECT_EQ(StancePitch(0.4f), 0.0f);
  EXPECT_LT(StancePitch(1.0f), -0.9f);
}

TEST(SwingAt, GoesFromWhereTheFootLeftToWhereItLands) {
  EXPECT_NEAR(SwingAt(0.0f).progress, 0.0f, 1e-6f);
  EXPECT_NEAR(SwingAt(1.0f).progress, 1.0f, 1e-6f);
  EXPECT_NEAR(SwingAt(0.0f).height, 0.0f, 1e-6f);
  EXPECT_NEAR(SwingAt(1.0f).height, 0.0f, 1e-6f);
  float before = -1.0f;
  for (float swing = 0.0f; swing <= 1.0f; swing += 0.05f) {
    EXPECT_GT(SwingAt(swing).progress, before);
    before = SwingAt(swing).progress;
  }
}

}  // namespace
}  // namespace lararium::human
