#include "shared/human/animator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "shared/human/finite.h"
#include "shared/human/turns.h"
#include "tests/human/full_body.h"
#include "tests/human/two_joint_human.h"

namespace lararium::human {
namespace {

constexpr float kTick = 1.0f / 120.0f;

std::shared_ptr<const AnimationRig> ModelOf(Human human) {
  return MakeAnimationRig(std::make_shared<Human>(std::move(human)));
}

// A clip of half a second that raises the right arm and turns the left knee.
Clip Gesture(const Skeleton& skeleton) {
  Clip clip{"gesture", 0.5f, 30.0f, true, 0.0f, {}};
  for (int key = 0; key <= 15; ++key) {
    std::vector<JointTransform> pose = skeleton.rest;
    TurnInActor(skeleton, static_cast<JointIndex>(*skeleton.Find("r_shoulder")), TurnX(1.0f), pose);
    TurnInActor(skeleton, static_cast<JointIndex>(*skeleton.Find("l_knee")), TurnX(-1.0f), pose);
    clip.keys.insert(clip.keys.end(), pose.begin(), pose.end());
  }
  return clip;
}

// The mesh of a face: vertex 0 at the mouth, vertex 1 at the brow.
Human WithFace() {
  Human human = FullBody(0.7f, 0);
  SkinnedMesh mesh;
  mesh.name = "face";
  mesh.positions = {{0.0f, 1.55f, -0.1f}, {0.0f, 1.68f, -0.1f}};
  mesh.normals.assign(2, glm::vec3(0, 0, -1));
  mesh.albedo.assign(2, glm::vec3(0.5f));
  mesh.joints.assign(2, {8, 0, 0, 0});
  mesh.weights.assign(2, glm::vec4(1, 0, 0, 0));
  human.meshes.push_back(mesh);
  const auto morph = [&](const char* name, uint32_t vertex) {
    human.morphs.push_back({name, {{0, {vertex}, {glm::vec3(0, 0.01f, 0)}, {glm::vec3(0)}}}});
  };
  morph("lips", 0);
  morph("smile", 0);
  morph("brows", 1);
  morph("lids", 1);
  const auto jaw = static_cast<uint32_t>(*human.skeleton.Find("temporomandibular"));
  human.face = {{"aa", {{0, 0.5f}}, {{jaw, TurnX(-0.4f)}}},
                {"PP", {{0, 1.0f}}, {}},
                {"joy", {{1, 1.0f}, {2, 0.5f}}, {}},
                {"blink_l", {{3, 1.0f}}, {}}};
  return human;
}

struct Placed {
  std::vector<glm::mat4> actor_from_joint;
  glm::vec3 At(size_t joint) const { return glm::vec3(actor_from_joint[joint][3]); }
};

Placed Show(const std::shared_ptr<const AnimationRig>& model,
            const AnimationState& animation_state) {
  Animator animator(model);
  animator.Pose(animation_state);
  return {{animator.actor_from_joint().begin(), animator.actor_from_joint().end()}};
}

TEST(BodyRig, IsFoundInSkeletonsWithAnyAxes) {
  for (const uint64_t axes : {0u, 1u, 2u}) {
    const Human human = FullBody(0.5f, axes);
    ASSERT_TRUE(human.skeleton.Validate("here").ok());
    const BodyRig body = MakeBodyRig(human.skeleton);
    EXPECT_TRUE(body.walks());
    EXPECT_NEAR(body.hip_height, 0.90f, 1e-4f);
    EXPECT_NEAR(body.arms[kRight].upper_length, body.arms[kLeft].upper_length, 1e-4f);
    EXPECT_EQ(body.spine.size(), 4u);
    EXPECT_EQ(body.neck.size(), 3u);
    EXPECT_EQ(body.legs[kLeft].toes.size(), 1u);
    EXPECT_NEAR(body.legs[kRight].ankle_height, 0.08f, 1e-4f);
    EXPECT_LT(body.legs[kRight].toe_out, 0.0f);  // turned right
    EXPECT_GT(body.legs[kLeft].toe_out, 0.0f);
    EXPECT_EQ(body.arms[kLeft].forearm_twist.size(), 1u);
  }
}

TEST(BodyRig, DoesNotWalkWithItsHipsBelowTheGround) {
  constexpr float kSunk = 0.95f;
  Human human = FullBody(0.5f, 0);
  human.skeleton.rest[0].translation.y -= kSunk;
  for (glm::mat4& joint_from_actor : human.skeleton.joint_from_actor) {
    joint_from_actor = glm::translate(joint_from_actor, glm::vec3(0.0f, kSunk, 0.0f));
  }
  EXPECT_FALSE(MakeBodyRig(human.skeleton).walks());
  const auto model = ModelOf(std::move(human));
  AnimationState animation_state;
  UpdateAnimationState(*model, glm::vec3(0.0f), 0.0f, kTick, {}, animation_state);
  for (const glm::mat4& joint : Show(model, animation_state).actor_from_joint) {
    EXPECT_TRUE(Finite(joint));
  }
}

TEST(BodyRig, OfAnythingElseIsEmpty) {
  const BodyRig body = MakeBodyRig(TwoJointHuman().skeleton);
  EXPECT_FALSE(body.walks());
  EXPECT_FALSE(body.arms[kLeft].whole());
}

TEST(Animator, LeavesWhatIsNoBodyAtRest) {
  const auto model = ModelOf(TwoJointHuman());
  AnimationState animation_state;
  UpdateAnimationState(*model, glm::vec3(0.0f), 0.0f, kTick, {}, animation_state);
  const Placed shown = Show(model, animation_state);
  EXPECT_LT(glm::distance(shown.At(1), glm::vec3(1.0f, 1.0f, 0.0f)), 1e-6f);
}

TEST(AnimationRig, OfItsOwnHumanPlaysClipsWhoseKeysItLetGo) {
  Human human = FullBody(0.5f, 0);
  human.clips = {Gesture(human.skeleton)};
  const auto whole = ModelOf(human);
  const auto lean = MakeAnimationRig(std::move(human));
  EXPECT_TRUE(lean->human->clips[0].keys.empty());
  EXPECT_EQ(lean->human->clips[0].duration, 0.5f);
  EXPECT_EQ(lean->turned, whole->turned);
  EXPECT_EQ(lean->turned[0].size(), 16u);
  AnimationState animation_state;
  StartClip(animation_state.animation, 0, 1.0, 0.0f, BodyPart::kWhole);
  animation_state.animation.clip_time = 0.2;
  EXPECT_EQ(Show(lean, animation_state).actor_from_joint,
            Show(whole, animation_state).actor_from_joint);
}

TEST(Animator, PosesBodiesThatLackAnyOneJoint) {
  const Human whole = FullBody(0.5f, 3);
  for (size_t missing = 0; missing < whole.skeleton.size(); ++missing) {
    Human human = whole;
    human.skeleton.names[missing] = "unknown";
    const auto model = ModelOf(human);
    AnimationState animation_state;
    animation_state.gaze.kind = GazeKind::kObject;
    animation_state.gaze.target = {1.0f, 1.0f, -1.0f};
    StartReach(animation_state.reaches[kRight], {{0.2f, 0.9f, -0.4f}, kNoTurn}, 0.0f);
    StartReach(animation_state.reaches[kLeft], {{-0.2f, 0.9f, -0.4f}, kNoTurn}, 0.0f);
    for (int tick = 1; tick < 60; ++tick) {
      const glm::vec3 at(0.0f, 0.0f, -0.01f * static_cast<float>(tick));
      UpdateAnimationState(*model, at, 0.0f, kTick, {}, animation_state);
    }
    for (const glm::mat4& joint : Show(model, animation_state).actor_from_joint) {
      for (int column = 0; column < 4; ++column) {
        EXPECT_TRUE(std::isfinite(glm::dot(joint[column], joint[column])))
            << whole.skeleton.names[missing];
      }
      EXPECT_LT(glm::length(glm::vec3(joint[3])), 3.0f) << whole.skeleton.names[missing];
    }
  }
}

TEST(Animator, LetsArmsHangWhateverTheRestPose) {
  for (const float lowered : {0.0f, 0.5f, 1.2f}) {
    const auto model = ModelOf(FullBody(lowered, 4));
    AnimationState animation_state;
    animation_state.idle_intensity = 0.0f;
    UpdateAnimationState(*model, glm::vec3(0.0f), 0.0f, kTick, {}, animation_state);
    const Placed shown = Show(model, animation_state);
    for (const BodyRig::Arm& arm : model->locomotion.body.arms) {
      const glm::vec3 way = glm::normalize(shown.At(static_cast<size_t>(arm.wrist)) -
                                           shown.At(static_cast<size_t>(arm.shoulder)));
      EXPECT_LT(way.y, -0.95f);
    }
  }
}

TEST(Animator, LaysAClipOverPartsOfTheBody) {
  Human human = FullBody(0.5f, 4);
  human.clips.push_back(Gesture(human.skeleton));
  const auto model = ModelOf(human);
  const auto shown = [&](int clip, BodyPart part) {
    AnimationState animation_state;
    animation_state.idle_intensity = 0.0f;
    StartClip(animation_state.animation, clip, 1.0, 0.0f, part);
    UpdateAnimationState(*model, glm::vec3(0.0f), 0.0f, kTick, {}, animation_state);
    return Show(model, animation_state);
  };
  const Placed none = shown(Animation::kNoClip, BodyPart::kWhole);
  const Placed whole = shown(0, BodyPart::kWhole);
  const Placed upper = shown(0, BodyPart::kUpper);
  const size_t hand = *human.skeleton.Find("r_wrist"), foot = *human.skeleton.Find("l_ankle");
  EXPECT_GT(glm::distance(whole.At(hand), none.At(hand)), 0.2f);
  EXPECT_GT(glm::distance(upper.At(hand), none.At(hand)), 0.2f);
  EXPECT_GT(glm::distance(whole.At(foot), none.At(foot)), 0.2f);
  EXPECT_LT(glm::distance(upper.At(foot), none.At(foot)), 1e-5f);
}

TEST(Animator, FadesBetweenClipsAndBackWithoutAJump) {
  Human human = FullBody(0.5f, 4);
  human.clips.push_back(Gesture(human.skeleton));
  const auto model = ModelOf(human);
  Animator animator(model);
  AnimationState animation_state;
  animation_state.idle_intensity = 0.0f;
  std::vector<glm::mat4> before;
  float furthest = 0.0f;
  for (int tick = 0; tick < 360; ++tick) {
    if (tick == 30) {
      StartClip(animation_state.animation, 0, 1.0, 0.4f, BodyPart::kUpper);
    } else if (tick == 120) {
      StartClip(animation_state.animation, 0, 1.0, 0.4f, BodyPart::kWhole);
    } else if (tick == 240) {
      StartClip(animation_state.animation, Animation::kNoClip, 1.0, 0.4f);
    }
    UpdateAnimationState(*model, glm::vec3(0.0f), 0.0f, kTick, {}, animation_state);
    animator.Pose(animation_state);
    for (size_t i = 0; i < before.size(); ++i) {
      furthest = std::max(furthest, glm::distance(before[i][3], animator.actor_from_joint()[i][3]));
    }
    before.assign(animator.actor_from_joint().begin(), animator.actor_from_joint().end());
  }
  EXPECT_LT(furthest, 0.04f);
  EXPECT_GT(furthest, 0.005f);
}

TEST(Animator, ShowsTheSameForTheSamePerformance) {
  const auto model = ModelOf(WithFace());
  AnimationState animation_state;
  animation_state.seed = 9;
  for (int tick = 0; tick < 200; ++tick) {
    UpdateAnimationState(*model, glm::vec3(0.0f, 0.0f, -0.01f * static_cast<float>(tick)), 0.0f,
                         kTick, {}, animation_state);
  }
  Animator a(model), b(model);
  b.Pose(AnimationState());  // The previous pose must not matter.
  a.Pose(animation_state);
  b.Pose(animation_state);
  for (size_t i = 0; i < a.pose().size(); ++i) {
    EXPECT_EQ(a.pose()[i].rotation, b.pose()[i].rotation);
  }
}

TEST(Animator, InterpolatesBetweenTicks) {
  const auto model = ModelOf(FullBody(0.5f, 0));
  AnimationState a, b;
  for (int tick = 0; tick < 300; ++tick) {
    a = b;
    UpdateAnimationState(*model, glm::vec3(0.0f, 0.0f, -0.01f * static_cast<float>(tick)), 0.0f,
                         kTick, {}, b);
  }
  const Placed from = Show(model, a), to = Show(model, b);
  const Placed middle = Show(model, Interpolate(a, b, 0.5f));
  for (size_t i = 0; i < from.actor_from_joint.size(); ++i) {
    EXPECT_LT(glm::distance(middle.At(i), 0.5f * (from.At(i) + to.At(i))), 0.001f);
  }
}

TEST(Animator, BeginsAnewWithoutMixingOldAndNew) {
  AnimationState old, fresh;
  old.time = 100.0;
  fresh.time = 0.5;
  EXPECT_EQ(Interpolate(old, fresh, 0.5f), fresh);
}

TEST(Animator, KeepsTheHandOnItsGripWhileWalkingAndLookingAway) {
  const auto model = ModelOf(FullBody(0.5f, 7));
  AnimationState animation_state;
  animation_state.gaze.kind = GazeKind::kObject;
  animation_state.gaze.target = {-8.0f, 1.6f, -1.0f};  // a person on the other side
  const GripFrame grip{{0.25f, 1.1f, -0.55f}, TurnZ(-1.0f)};
  StartReach(animation_state.reaches[kRight], grip, 0.5f);
  for (int tick = 0; tick < 480; ++tick) {
    UpdateAnimationState(*model, glm::vec3(0.0f, 0.0f, -0.01f * static_cast<float>(tick)), 0.0f,
                         kTick, {}, animation_state);
    if (tick > 60) {
      Animator animator(model);
      animator.Pose(animation_state);
      const GripFrame palm =
          ActorFromPalm(model->reach, model->human->skeleton, animator.pose(), kRight);
      EXPECT_LT(glm::distance(palm.position, grip.position), 0.005f);
    }
  }
}

TEST(Hands, CloseTowardsThePalmWhateverTheAxes) {
  for (const uint64_t axes : {0u, 5u}) {
    const auto model = ModelOf(FullBody(0.4f, axes));
    const Skeleton& skeleton = model->human->skeleton;
    const auto tip = [&](HandPose pose, int side) {
      AnimationState animation_state;
      animation_state.idle_intensity = 0.0f;
      for (HandState& hand : animation_state.hands) {
        SetHandPose(hand, pose, 0.0f);
      }
      UpdateAnimationState(*model, glm::vec3(0.0f), 0.0f, kTick, {}, animation_state);
      Animator animator(model);
      animator.Pose(animation_state);
      const GripFrame palm = ActorFromPalm(model->reach, skeleton, animator.pose(), side);
      const auto joint = *skeleton.Find(side == kRight ? "r_middle4" : "l_middle4");
      return glm::conjugate(palm.rotation) *
             (glm::vec3(animator.actor_from_joint()[joint][3]) - palm.position);
    };
    for (const int side : {kRight, kLeft}) {
      EXPECT_LT(tip(HandPose::kFlat, side).z, -0.07f);   // ahead
      EXPECT_GT(tip(HandPose::kFist, side).z, -0.045f);  // rolled in
      EXPECT_LT(tip(HandPose::kCylinder, side).y, -0.02f);
      EXPECT_LT(tip(HandPose::kFlat, kRight).x - tip(HandPose::kFlat, kLeft).x, 0.02f);
    }
  }
}

TEST(Hands, GoFromPoseToPoseWithoutAJump) {
  HandState hand;
  SetHandPose(hand, HandPose::kFist, 0.4f);
  float before = 0.0f;
  for (int tick = 0; tick < 24; ++tick) {
    UpdateHand(hand, kTick);
  }
  before = hand.shares[static_cast<size_t>(HandPose::kFist)];
  EXPECT_NEAR(before, 0.5f, 0.01f);
  SetHandPose(hand, HandPose::kPoint, 0.4f);
  UpdateHand(hand, kTick);
  EXPECT_NEAR(hand.shares[static_cast<size_t>(HandPose::kFist)], before, 0.03f);
  for (int tick = 0; tick < 60; ++tick) {
    UpdateHand(hand, kTick);
  }
  EXPECT_EQ(hand.shares[static_cast<size_t>(HandPose::kPoint)], 1.0f);
  EXPECT_EQ(hand.shares[static_cast<size_t>(HandPose::kFist)], 0.0f);
}

TEST(Hands, KnowTheirPosesByName) {
  for (int pose = 0; pose < kHandPoseCount; ++pose) {
    EXPECT_EQ(HandPoseNamed(NameOf(static_cast<HandPose>(pose))), static_cast<HandPose>(pose));
  }
  EXPECT_EQ(HandPoseNamed("claw"), std::nullopt);
}

VisemeTrack Track() {
  VisemeTrack track;
  track.keys = {{0.1f, Viseme::kAa, 1.0f}, {0.25f, Viseme::kPP, 1.0f}, {0.35f, Viseme::kAa, 0.8f}};
  track.duration = 0.5f;
  return track;
}

TEST(SampleVisemes, RunIntoOneAnother) {
  const VisemeTrack track = Track();
  const auto at = [&](double time, Viseme viseme) {
    return SampleVisemes(track, time)[static_cast<size_t>(viseme)];
  };
  EXPECT_GT(at(0.30, Viseme::kPP), 0.75f);  // lips meet
  EXPECT_GT(at(0.30, Viseme::kAa), 0.05f);  // still between the vowels
  EXPECT_GT(at(0.17, Viseme::kAa), 0.5f);
  EXPECT_GT(at(0.22, Viseme::kPP), at(0.15, Viseme::kPP));  // anticipated
  EXPECT_GT(at(-0.5, Viseme::kSil), 0.95f);
  EXPECT_GT(at(1.5, Viseme::kSil), 0.95f);
}

TEST(SampleVisemes, SumToAtMostOneAndMoveSmoothly) {
  const VisemeTrack track = Track();
  auto before = SampleVisemes(track, -1.0);
  for (double time = -1.0; time < 2.0; time += 1.0 / 120.0) {
    const auto now = SampleVisemes(track, time);
    float sum = 0.0f;
    for (size_t i = 0; i < now.size(); ++i) {
      sum += now[i];
      EXPECT_GE(now[i], 0.0f);
      EXPECT_LT(std::abs(now[i] - before[i]), 0.16f);
    }
    EXPECT_LT(sum, 1.0001f);
    before = now;
  }
}

TEST(VisemeTrackValidate, RefusesWhatCannotBeSaid) {
  EXPECT_TRUE(Track().Validate("here").ok());
  VisemeTrack track = Track();
  track.keys[1].time = 0.05f;
  EXPECT_FALSE(track.Validate("here").ok());
  track = Track();
  track.keys[2].strength = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(track.Validate("here").ok());
  track = Track();
  track.duration = 0.2f;
  EXPECT_FALSE(track.Validate("here").ok());
  track = Track();
  track.keys[0].viseme = static_cast<Viseme>(99);
  EXPECT_FALSE(track.Validate("here").ok());
}

TEST(Face, GivesTheMouthToSpeechAndLeavesTheRestToFeeling) {
  const Human human = WithFace();
  const FaceModel model = MakeFaceModel(human);
  EXPECT_NEAR(model.mouth_share[1], 1.0f, 1e-5f);
  EXPECT_NEAR(model.mouth_share[2], 0.0f, 1e-5f);
  std::vector<float> shapes(human.face.size()), morphs(human.morphs.size());
  Face face;
  SetExpression(face, Expression::kJoy, 1.0f, 0.0f);
  UpdateFace(face, kTick);
  ComputeFaceWeights(model, human, face, 0.0f, shapes, morphs);
  EXPECT_NEAR(morphs[1], 1.0f, 1e-5f);  // smiles
  EXPECT_NEAR(morphs[2], 0.5f, 1e-5f);
  face.mouth[static_cast<size_t>(Viseme::kPP)] = 1.0f;
  ComputeFaceWeights(model, human, face, 0.7f, shapes, morphs);
  EXPECT_NEAR(morphs[0], 1.0f, 1e-5f);  // lips closed
  EXPECT_NEAR(morphs[1], 0.0f, 1e-5f);  // smile suppressed
  EXPECT_NEAR(morphs[2], 0.5f, 1e-5f);  // brows unaffected
  EXPECT_NEAR(morphs[3], 0.7f, 1e-5f);  // lids blink
}

TEST(Face, OpensTheJawWithTheVowel) {
  const auto model = ModelOf(WithFace());
  AnimationState animation_state;
  animation_state.face.mouth[static_cast<size_t>(Viseme::kAa)] = 1.0f;
  Animator animator(model);
  animator.Pose(animation_state);
  const auto jaw = static_cast<size_t>(model->locomotion.body.jaw);
  const glm::quat turned = animator.pose()[jaw].rotation;
  EXPECT_NEAR(std::abs(glm::dot(turned, model->human->skeleton.rest[jaw].rotation * TurnX(-0.4f))),
              1.0f, 1e-5f);
  EXPECT_NEAR(animator.morph_weights()[0], 0.5f, 1e-5f);
}

TEST(Face, DoesNotJumpWhenSpeechBreaksOff) {
  Face face;
  const auto aa = static_cast<size_t>(Viseme::kAa);
  face.visemes[aa] = 1.0f;
  for (int tick = 0; tick < 10; ++tick) {
    UpdateFace(face, kTick);
  }
  EXPECT_EQ(face.mouth[aa], 1.0f);
  face.visemes = {};
  UpdateFace(face, kTick);
  EXPECT_GT(face.mouth[aa], 0.8f);
  for (int tick = 0; tick < 10; ++tick) {
    UpdateFace(face, kTick);
  }
  EXPECT_EQ(face.mouth[aa], 0.0f);
}

TEST(Face, ChangesExpressionOverTime) {
  Face face;
  SetExpression(face, Expression::kAnger, 0.8f, 0.5f);
  for (int tick = 0; tick < 24; ++tick) {
    UpdateFace(face, kTick);
  }
  EXPECT_NEAR(face.expressions[static_cast<size_t>(Expression::kAnger)], 0.4f, 0.01f);
  SetExpression(face, Expression::kJoy, 1.0f, 0.5f);
  for (int tick = 0; tick < 60; ++tick) {
    UpdateFace(face, kTick);
  }
  EXPECT_EQ(face.expressions[static_cast<size_t>(Expression::kAnger)], 0.0f);
  EXPECT_NEAR(face.expressions[static_cast<size_t>(Expression::kJoy)], 1.0f, 1e-4f);
}

TEST(IdleMotion, IsAFunctionOfSeedAndTime) {
  const IdleMotionSample a = SampleIdleMotion(3, 12.34), b = SampleIdleMotion(3, 12.34),
                         c = SampleIdleMotion(4, 12.34);
  EXPECT_EQ(a.head, b.head);
  EXPECT_NE(a.head, c.head);
  EXPECT_NE(a.breath, c.breath);
  EXPECT_EQ(SampleIdleMotion(3, 12.34, 0.0f).head, glm::vec3(0.0f));
}

TEST(IdleMotion, BreathesTwelveToEighteenTimesAMinute) {
  for (uint64_t seed = 1; seed < 6; ++seed) {
    int breaths = 0;
    float before = 0.0f;
    for (double time = 0.0; time < 300.0; time += 0.05) {
      const float now = SampleIdleMotion(seed, time).breath;
      breaths += before < 0.0f && now >= 0.0f ? 1 : 0;
      before = now;
    }
    EXPECT_GE(breaths, 5 * 12 - 3) << seed;
    EXPECT_LE(breaths, 5 * 18 + 3) << seed;
  }
}

TEST(IdleMotion, NeverJumps) {
  IdleMotionSample before = SampleIdleMotion(1, 0.0);
  for (double time = 0.0; time < 60.0; time += 1.0 / 120.0) {
    const IdleMotionSample now = SampleIdleMotion(1, time);
    EXPECT_LT(std::abs(now.breath - before.breath), 0.05f);
    EXPECT_LT(std::abs(now.weight_shift - before.weight_shift), 0.03f);
    EXPECT_LT(glm::distance(now.head, before.head), 0.004f);
    before = now;
  }
}

TEST(BlendPose, FollowsItsMask) {
  std::vector<JointTransform> pose(2), other(2);
  other[0].rotation = other[1].rotation = TurnY(1.0f);
  const JointMask mask = {0.0f, 0.5f};
  BlendPose(pose, other, 1.0f, mask);
  EXPECT_EQ(pose[0].rotation, kNoTurn);
  EXPECT_NEAR(std::abs(glm::dot(pose[1].rotation, TurnY(0.5f))), 1.0f, 1e-6f);
}

}  // namespace
}  // namespace lararium::human
