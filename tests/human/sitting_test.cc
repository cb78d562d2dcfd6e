#include "shared/human/sitting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "shared/human/animator.h"
#include "shared/human/turns.h"
#include "tests/human/full_body.h"

namespace lararium::human {
namespace {

constexpr float kSeatTick = 1.0f / 120.0f;
constexpr float kStool = 0.46f;  // metres

// The same body, smaller or larger.
std::shared_ptr<const AnimationRig> Scaled(float scale, uint64_t axes) {
  Human human = FullBody(0.6f, axes);
  for (JointTransform& joint : human.skeleton.rest) {
    joint.translation *= scale;
  }
  for (glm::mat4& joint_from_actor : human.skeleton.joint_from_actor) {
    joint_from_actor[3] = glm::vec4(scale * glm::vec3(joint_from_actor[3]), 1.0f);
  }
  return MakeAnimationRig(std::make_shared<const Human>(std::move(human)));
}

class Sitter {
 public:
  explicit Sitter(std::shared_ptr<const AnimationRig> model)
      : model_(std::move(model)), animator_(model_) {
    performance_.idle_intensity = 0.0f;
    Tick(2.0f);
  }

  void Down(float height) {
    const float before = StandBeforeSeat(model_->sitting, height, 0.18f);
    SitDown(performance_.sitting, {0.0f, height, before}, 1.9f);
  }
  void Up() { StandUp(performance_.sitting, 1.9f); }

  // Advances the time and measures the motion of all joints.
  void Tick(float seconds) {
    for (float t = 0.0f; t < seconds; t += kSeatTick) {
      UpdateAnimationState(*model_, glm::vec3(0.0f), 0.0f, kSeatTick, {}, performance_);
      const std::vector<JointTransform> before(animator_.pose().begin(), animator_.pose().end());
      animator_.Pose(performance_);
      Watch(before);
    }
  }

  glm::vec3 At(JointIndex joint) const {
    return ActorFromJoint(model_->human->skeleton, animator_.pose(), joint).position;
  }
  glm::vec3 Hips() const { return 0.5f * (At(Leg(0).hip) + At(Leg(1).hip)); }
  const BodyRig::Leg& Leg(size_t side) const { return model_->sitting.body.legs[side]; }
  const BodyRig& body() const { return model_->sitting.body; }
  const SittingModel& sitting() const { return model_->sitting; }
  std::vector<JointTransform> pose() const {
    return {animator_.pose().begin(), animator_.pose().end()};
  }
  bool IsEye(size_t joint) const {
    return static_cast<JointIndex>(joint) == body().eyes[0] ||
           static_cast<JointIndex>(joint) == body().eyes[1];
  }
  float fastest() const { return fastest_; }  // fastest joint against its parent, rad/s
  void Forget() { fastest_ = 0.0f; }

 private:
  void Watch(const std::vector<JointTransform>& before) {
    for (size_t i = 0; watched_ && i < before.size(); ++i) {
      if (IsEye(i)) {
        continue;  // Eyes may jump.
      }
      const float cosine = std::abs(glm::dot(before[i].rotation, animator_.pose()[i].rotation));
      fastest_ = std::max(fastest_, 2.0f * std::acos(std::min(cosine, 1.0f)) / kSeatTick);
    }
    watched_ = true;
  }

  std::shared_ptr<const AnimationRig> model_;
  Animator animator_;
  AnimationState performance_;
  bool watched_ = false;
  float fastest_ = 0.0f;
};

TEST(Sitting, PutsTheHipsOnSeatsOfManyHeightsWhateverTheBody) {
  for (const float scale : {0.65f, 0.9f, 1.1f}) {
    for (const float height : {0.30f, 0.40f, kStool, 0.55f}) {
      Sitter sitter(Scaled(scale, 7));
      sitter.Down(height);
      sitter.Tick(2.0f);
      EXPECT_NEAR(sitter.Hips().y, height + sitter.sitting().seat_to_hips, 0.01f)
          << scale << " on " << height;
    }
  }
}

TEST(Sitting, LeavesTheFeetOfGrownPeopleWhereTheyStand) {
  Sitter sitter(Scaled(1.0f, 3));
  std::array<glm::vec3, 2> stood;
  for (size_t side = 0; side < 2; ++side) {
    stood[side] = sitter.At(sitter.Leg(side).ankle);
  }
  float furthest = 0.0f;
  sitter.Down(kStool);
  for (int tick = 0; tick < 480; ++tick) {
    if (tick == 240) {
      sitter.Up();
    }
    sitter.Tick(kSeatTick);
    for (size_t side = 0; side < 2; ++side) {
      furthest = std::max(furthest, glm::distance(sitter.At(sitter.Leg(side).ankle), stood[side]));
    }
  }
  EXPECT_LT(furthest, 0.005f);
}

TEST(Sitting, BendsKneesAndHipsAsPeopleDoOnAStool) {
  Sitter sitter(Scaled(1.0f, 0));
  sitter.Down(kStool);
  sitter.Tick(2.0f);
  for (size_t side = 0; side < 2; ++side) {
    const glm::vec3 hip = sitter.At(sitter.Leg(side).hip);
    const glm::vec3 knee = sitter.At(sitter.Leg(side).knee);
    const glm::vec3 ankle = sitter.At(sitter.Leg(side).ankle);
    const glm::vec3 thigh = glm::normalize(knee - hip), shank = glm::normalize(ankle - knee);
    EXPECT_LT(thigh.z, -0.85f) << "forwards";
    EXPECT_LT(std::abs(thigh.y), 0.35f) << "nearly level";
    EXPECT_LT(shank.y, -0.85f);
    const float flexion = std::acos(glm::dot(thigh, shank));
    EXPECT_GT(flexion, 1.2f);
    EXPECT_LT(flexion, 2.2f);
  }
  const glm::vec3 chest = sitter.At(sitter.body().chest());
  EXPECT_LT(std::abs(chest.z - sitter.Hips().z), 0.15f) << "upright";
}

TEST(Sitting, LeansForwardOverTheFeetBeforeItLeavesTheSeat) {
  Sitter sitter(Scaled(1.0f, 0));
  sitter.Down(kStool);
  sitter.Tick(2.0f);
  const glm::vec3 seated = sitter.Hips();
  sitter.Up();
  float lean_at_leaving = -1.0f, most = 0.0f;
  for (int tick = 0; tick < 240; ++tick) {
    sitter.Tick(kSeatTick);
    const glm::vec3 trunk = sitter.At(sitter.body().neck.front()) - sitter.Hips();
    const float lean = std::atan2(-trunk.z, trunk.y);
    most = std::max(most, lean);
    if (lean_at_leaving < 0.0f && sitter.Hips().y > seated.y + 0.02f) {
      lean_at_leaving = lean;
    }
  }
  EXPECT_GT(lean_at_leaving, 0.4f);  // radians
  EXPECT_GT(most, 0.5f);
  EXPECT_LT(most, 0.9f);
}

TEST(Sitting, MovesNoJointFasterThanPeopleDo) {
  for (const float scale : {0.65f, 1.0f}) {
    for (const float height : {0.35f, kStool}) {
      Sitter sitter(Scaled(scale, 5));
      sitter.Forget();
      sitter.Down(height);
      sitter.Tick(2.5f);
      sitter.Up();
      sitter.Tick(2.5f);
      EXPECT_LT(sitter.fastest(), 9.0f) << scale << " on " << height;
      EXPECT_GT(sitter.fastest(), 1.0f);
    }
  }
}

TEST(Sitting, TurnsBackHalfwayWithoutAJump) {
  Sitter sitter(Scaled(1.0f, 5));
  sitter.Forget();
  sitter.Down(kStool);
  sitter.Tick(1.0f);
  sitter.Up();
  sitter.Tick(1.5f);
  EXPECT_LT(sitter.fastest(), 9.0f);
}

TEST(Sitting, EndsAsItStoodBefore) {
  Sitter sitter(Scaled(1.0f, 2));
  const std::vector<JointTransform> before = sitter.pose();
  sitter.Down(kStool);
  sitter.Tick(2.5f);
  sitter.Up();
  sitter.Tick(2.5f);
  const std::vector<JointTransform> after = sitter.pose();
  for (size_t i = 0; i < before.size(); ++i) {
    if (sitter.IsEye(i)) {
      continue;
    }
    EXPECT_GT(std::abs(glm::dot(before[i].rotation, after[i].rotation)), 0.9999f) << i;
    EXPECT_LT(glm::distance(before[i].translation, after[i].translation), 1e-3f) << i;
  }
}

TEST(Sitting, LaysTheHandsOnTheThighs) {
  Sitter sitter(Scaled(1.0f, 4));
  sitter.Down(kStool);
  sitter.Tick(2.0f);
  for (size_t side = 0; side < 2; ++side) {
    const glm::vec3 hip = sitter.At(sitter.Leg(side).hip);
    const glm::vec3 knee = sitter.At(sitter.Leg(side).knee);
    const glm::vec3 wrist = sitter.At(sitter.body().arms[side].wrist);
    const float along = glm::dot(wrist - hip, knee - hip) / glm::dot(knee - hip, knee - hip);
    EXPECT_GT(along, 0.2f);
    EXPECT_LT(along, 1.0f);
    EXPECT_GT(wrist.y, 0.5f * (hip.y + knee.y) + 0.5f * sitter.sitting().thigh_radius);
    EXPECT_LT(glm::distance(wrist, hip + along * (knee - hip)), 0.2f);
  }
}

TEST(Sitting, LetsFeetHangThatDoNotReachTheFloor) {
  Sitter girl(Scaled(0.60f, 0));
  girl.Down(kStool);
  girl.Tick(2.0f);
  for (size_t side = 0; side < 2; ++side) {
    const float ankle = girl.At(girl.Leg(side).ankle).y;
    EXPECT_GT(ankle, girl.Leg(side).ankle_height + 0.03f);
    EXPECT_LT(ankle, girl.Hips().y - 0.7f * girl.Leg(side).lower_length);
    const glm::vec3 thigh =
        glm::normalize(girl.At(girl.Leg(side).knee) - girl.At(girl.Leg(side).hip));
    EXPECT_LT(thigh.z, -0.9f);
  }
}

TEST(Sitting, MovesTheUpperBodyAlong) {
  Sitter sitter(Scaled(1.0f, 0));
  const glm::vec3 stood = sitter.Hips();
  sitter.Down(kStool);
  Sitting sat;
  SitDown(sat, {0.0f, kStool, StandBeforeSeat(sitter.sitting(), kStool, 0.18f)}, 1.0f);
  UpdateSitting(sat, 1.0f);
  sitter.Tick(2.0f);
  EXPECT_LT(glm::distance(HipsShift(sitter.sitting(), sat), sitter.Hips() - stood), 0.03f);
  EXPECT_FLOAT_EQ(SeatedShare(sat), 1.0f);
  EXPECT_FLOAT_EQ(SeatedShare(Sitting()), 0.0f);
}

}  // namespace
}  // namespace lararium::human
