#include "shared/human/gaze.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>

#include "shared/core/units.h"
#include "shared/human/animator.h"
#include "shared/human/turns.h"
#include "tests/human/full_body.h"

namespace lararium::human {
namespace {

constexpr float kGazeTick = 1.0f / 120.0f;

// A person who looks at targets, posed as drawn.
class Looker {
 public:
  explicit Looker(uint64_t axes = 8, uint64_t seed = 1)
      : human_(std::make_shared<Human>(FullBody(0.7f, axes))),
        model_(MakeAnimationRig(human_)),
        animator_(model_) {
    performance_.seed = seed;
  }

  void Look(GazeKind kind, const glm::vec3& target) {
    performance_.gaze.kind = kind;
    performance_.gaze.target = target;
  }
  void Wait(float seconds) {
    for (float time = 0.0f; time < seconds; time += kGazeTick) {
      Tick();
    }
  }
  void Tick() {
    UpdateAnimationState(*model_, position_, heading_, kGazeTick, {}, performance_);
    animator_.Pose(performance_);
  }
  void Move(const glm::vec3& position, float heading) {
    position_ = position;
    heading_ = heading;
  }

  // Angle between the direction of an eye and a point of the stage.
  float Error(int side, const glm::vec3& target) const {
    const JointFrame eye = Frame(body().eyes[static_cast<size_t>(side)]);
    const glm::vec3 in_actor = TurnY(-heading_) * (target - position_);
    const glm::vec3 wanted = glm::normalize(in_actor - eye.position);
    return std::acos(std::clamp(glm::dot(GazeDirection(side), wanted), -1.0f, 1.0f));
  }
  // Direction of an eye, in the actor frame and in the head's.
  glm::vec3 GazeDirection(int side) const {
    return Turned(body().eyes[static_cast<size_t>(side)]) * glm::vec3(0, 0, -1);
  }
  glm::vec3 GazeInHead(int side) const {
    return glm::conjugate(Turned(body().head)) * GazeDirection(side);
  }
  glm::vec3 HeadInChest() const {
    return glm::conjugate(Turned(body().chest())) * (Turned(body().head) * glm::vec3(0, 0, -1));
  }

  Gaze& gaze() { return performance_.gaze; }
  AnimationState& animation_state() { return performance_; }

 private:
  const BodyRig& body() const { return model_->locomotion.body; }
  JointFrame Frame(JointIndex joint) const {
    return ActorFromJoint(human_->skeleton, animator_.pose(), joint);
  }
  glm::quat Turned(JointIndex joint) const {
    return Frame(joint).rotation * glm::conjugate(body().rest[static_cast<size_t>(joint)].rotation);
  }

  std::shared_ptr<const Human> human_;
  std::shared_ptr<const AnimationRig> model_;
  Animator animator_;
  AnimationState performance_;
  glm::vec3 position_ = glm::vec3(0.0f);
  float heading_ = 0.0f;
};

float Yaw(const glm::vec3& v) { return std::atan2(-v.x, -v.z); }
float Pitch(const glm::vec3& v) { return std::asin(std::clamp(v.y, -1.0f, 1.0f)); }

TEST(Gaze, IsWithinTwoDegreesOfItsTargetInsideLimits) {
  Looker looker;
  for (const float yaw : {-100.0f, -50.0f, -20.0f, -5.0f, 0.0f, 8.0f, 30.0f, 70.0f, 110.0f}) {
    for (const float pitch : {-35.0f, -10.0f, 0.0f, 20.0f}) {
      const glm::vec3 way = TurnY(yaw * kRadiansPerDegreeF) *
                            (TurnX(pitch * kRadiansPerDegreeF) * glm::vec3(0, 0, -1.5f));
      const glm::vec3 target = glm::vec3(0.0f, 1.63f, 0.0f) + way;
      looker.Look(GazeKind::kObject, target);
      looker.Wait(1.5f);
      float worst = 0.0f;
      for (int tick = 0; tick < 120; ++tick) {
        looker.Tick();
        worst = std::max({worst, looker.Error(kRight, target), looker.Error(kLeft, target)});
      }
      EXPECT_LT(worst, 2.0f * kRadiansPerDegreeF) << yaw << " " << pitch;
    }
  }
}

TEST(Gaze, StaysOnItsTargetWhileTheBodyMoves) {
  Looker looker;
  const glm::vec3 target(0.6f, 1.2f, -4.0f);
  looker.Look(GazeKind::kObject, target);
  looker.Wait(1.5f);
  float worst = 0.0f;
  for (int tick = 0; tick < 240; ++tick) {
    looker.Move(glm::vec3(0.0f, 0.0f, -0.008f * static_cast<float>(tick)),
                0.3f * std::sin(0.02f * static_cast<float>(tick)));
    looker.Tick();
    worst = std::max({worst, looker.Error(kRight, target), looker.Error(kLeft, target)});
  }
  EXPECT_LT(worst, 2.0f * kRadiansPerDegreeF);
}

TEST(Gaze, NeverLeavesAnatomicalLimits) {
  Looker looker(2);
  for (int i = 0; i < 40; ++i) {
    const float angle = 2.4f * static_cast<float>(i);  // all around, high and low
    looker.Look(GazeKind::kPerson,
                glm::vec3(2.0f * std::sin(angle), 0.12f * static_cast<float>(i % 30),
                          2.0f * std::cos(angle)));
    for (int tick = 0; tick < 90; ++tick) {
      looker.Tick();
      for (const int side : {kRight, kLeft}) {
        const glm::vec3 eye = looker.GazeInHead(side);
        EXPECT_LT(std::abs(Yaw(eye)), GazeLimits::kEyeYaw + 0.5f * kRadiansPerDegreeF);
        EXPECT_LT(Pitch(eye), GazeLimits::kEyeUp + 0.5f * kRadiansPerDegreeF);
        EXPECT_GT(Pitch(eye), -GazeLimits::kEyeDown - 0.5f * kRadiansPerDegreeF);
      }
      EXPECT_LT(std::abs(Yaw(looker.HeadInChest())), 75.0f * kRadiansPerDegreeF);
      EXPECT_LT(std::abs(Pitch(looker.HeadInChest())), 50.0f * kRadiansPerDegreeF);
    }
  }
}

TEST(Gaze, MovesTheEyesBeforeTheHead) {
  Looker looker;
  looker.Look(GazeKind::kObject, glm::vec3(0.0f, 1.63f, -2.0f));
  looker.Wait(2.0f);
  const glm::vec3 target = glm::vec3(-1.5f, 1.63f, -1.5f);  // 45 degrees to the left
  looker.Look(GazeKind::kObject, target);
  float eyes = 0.0f, head = 0.0f;  // seconds until half of the motion
  for (int tick = 0; tick < 240; ++tick) {
    looker.Tick();
    const float now = kGazeTick * static_cast<float>(tick);
    eyes = eyes == 0.0f && Yaw(looker.GazeInHead(kRight)) > 15.0f * kRadiansPerDegreeF ? now : eyes;
    head = head == 0.0f && looker.gaze().head.x > 12.0f * kRadiansPerDegreeF ? now : head;
  }
  EXPECT_GT(eyes, 0.0f);
  EXPECT_GT(head, eyes + 0.03f);
}

TEST(Gaze, DoesNotTurnTheHeadForWhatIsNearby) {
  Looker looker;
  looker.Look(GazeKind::kObject, glm::vec3(0.0f, 1.63f, -2.0f) + glm::vec3(0.35f, 0.0f, 0.0f));
  looker.Wait(2.0f);  // 10 degrees
  EXPECT_LT(std::abs(looker.gaze().head.x), 1.0f * kRadiansPerDegreeF);
}

TEST(Gaze, LooksAwayFromEyesNowAndThen) {
  Looker looker;
  looker.Look(GazeKind::kPerson, glm::vec3(0.0f, 1.63f, -1.5f));
  int away = 0, glances = 0;
  bool was_away = false;
  for (int tick = 0; tick < 60 * 120; ++tick) {
    looker.Tick();
    const bool now = looker.Error(kRight, looker.gaze().target) > 4.0f * kRadiansPerDegreeF;
    away += now ? 1 : 0;
    glances += now && !was_away ? 1 : 0;
    was_away = now;
  }
  EXPECT_GT(glances, 8);
  EXPECT_LT(glances, 25);
  EXPECT_LT(away, 60 * 120 / 2);
}

TEST(Gaze, BlinksAsOftenAsPeopleDo) {
  Looker looker;
  int blinks = 0;
  bool closed = false;
  for (int tick = 0; tick < 180 * 120; ++tick) {
    UpdateGaze(MakeGazeModel(BodyRig()), glm::vec3(0.0f), 0.0f, 3, kGazeTick, looker.gaze());
    const bool now = looker.gaze().lids > 0.9f;
    blinks += now && !closed ? 1 : 0;
    closed = now;
  }
  EXPECT_GT(blinks, 3 * 12);  // three minutes
  EXPECT_LT(blinks, 3 * 24);
}

TEST(Gaze, DiffersBetweenPeopleAndRepeatsForOne) {
  Looker a(8, 1), b(8, 2), c(8, 1);
  for (Looker* looker : {&a, &b, &c}) {
    looker->Look(GazeKind::kPerson, glm::vec3(0.3f, 1.6f, -2.0f));
    looker->Wait(5.0f);
  }
  EXPECT_NE(a.gaze().fixation, b.gaze().fixation);
  EXPECT_EQ(a.gaze(), c.gaze());
}

TEST(Gaze, GivesUpOnWhatIsBehind) {
  Looker looker;
  looker.Look(GazeKind::kObject, glm::vec3(0.05f, 1.6f, 2.0f));
  looker.Wait(2.0f);
  EXPECT_LT(std::abs(Yaw(looker.GazeDirection(kRight))), 40.0f * kRadiansPerDegreeF);
}

}  // namespace
}  // namespace lararium::human
