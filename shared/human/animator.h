#pragma once

// The complete animation state of one person, and the class that poses the body from it.

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "shared/human/animation.h"
#include "shared/human/blend.h"
#include "shared/human/compressed_clip.h"
#include "shared/human/face.h"
#include "shared/human/gaze.h"
#include "shared/human/hand_pose.h"
#include "shared/human/idle_motion.h"
#include "shared/human/locomotion.h"
#include "shared/human/reach.h"
#include "shared/human/sitting.h"

namespace lararium::human {

struct Human;

// Plain values that can be copied, compared and interpolated between two ticks. Each member's
// header says what may be set from outside and which functions change it (StartClip, SitDown,
// StartReach, SetHandPose, SetExpression, ...).
struct AnimationState {
  uint64_t seed = 0;            // Seed of all differences between people; set once.
  double time = 0.0;            // seconds since the state began
  float idle_intensity = 1.0f;  // Intensity of idle motion, 0..1.
  Animation animation;
  Locomotion locomotion;
  Sitting sitting;
  Gaze gaze;
  std::array<Reach, 2> reaches;  // Index by side: kRight, kLeft.
  std::array<HandState, 2> hands;
  Face face;

  friend bool operator==(const AnimationState&, const AnimationState&) = default;
};

// Constants of one human for animation. Build once; actors and threads share it.
struct AnimationRig {
  std::shared_ptr<const Human> human;
  // Parallel to Human::clips.
  std::vector<CompressedClip> clips;
  std::vector<std::vector<float>> turned;  // TurnedFromFirst() of each clip
  LocomotionModel locomotion;
  SittingModel sitting;
  GazeModel gaze;
  ReachModel reach;
  HandModel hands;
  FaceModel face;
  JointMasks masks;
};
std::shared_ptr<const AnimationRig> MakeAnimationRig(std::shared_ptr<const Human> human);
// Takes a human that has no other owner. The original keys of its clips are released; the rig holds
// compressed clips that need a fraction of the memory.
std::shared_ptr<const AnimationRig> MakeAnimationRig(Human human);

// Advances one tick, after the root has moved to position and heading (stage frame). Allocates
// nothing. Set gaze.kind, gaze.target and face.visemes, and move the grips, before the call.
void UpdateAnimationState(const AnimationRig& model,
                          const glm::vec3& position,
                          float heading,
                          float seconds,
                          const FloorHeight& floor,
                          AnimationState& animation_state);

// Interpolates between two neighbouring ticks, alpha 0..1.
AnimationState Interpolate(const AnimationState& previous,
                           const AnimationState& current,
                           float alpha);

// Poses one person repeatedly without allocating. Each thread needs its own Animator.
class Animator {
 public:
  explicit Animator(std::shared_ptr<const AnimationRig> model);

  const AnimationRig& model() const { return *model_; }
  const Human& human() const { return *model_->human; }

  // Applies clip or gait and seat, then idle motion, posture, gaze, reach, fingers and face, in
  // this order.
  void Pose(const AnimationState& animation_state);

  // Results of the last Pose(), parallel to the skeleton's joints.
  std::span<const JointTransform> pose() const { return pose_; }
  std::span<const glm::mat4> actor_from_joint() const { return actor_from_joint_; }
  std::span<const glm::mat4> skin() const { return skin_; }
  // Result of the last Pose(), parallel to Human::morphs.
  std::span<const float> morph_weights() const { return morph_weights_; }

 private:
  void PoseBody(const AnimationState& animation_state, const IdleMotionSample& idle_motion);
  void LayClip(int clip, double time, BodyPart part, std::span<JointTransform> pose);

  std::shared_ptr<const AnimationRig> model_;
  std::vector<JointTransform> pose_;
  std::vector<JointTransform> previous_pose_;
  std::vector<JointTransform> clip_pose_;
  std::vector<glm::mat4> actor_from_joint_;
  std::vector<glm::mat4> skin_;
  std::vector<float> face_weights_;
  std::vector<float> morph_weights_;
};

}  // namespace lararium::human
