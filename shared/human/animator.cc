#include "shared/human/animator.h"

#include <algorithm>

#include "shared/core/release.h"
#include "shared/human/human.h"

namespace lararium::human {

std::shared_ptr<const AnimationRig> MakeAnimationRig(std::shared_ptr<const Human> human) {
  CHECK(human != nullptr);
  auto model = std::make_shared<AnimationRig>();
  const BodyRig body = MakeBodyRig(human->skeleton);
  model->locomotion = MakeLocomotionModel(*human, body);
  model->sitting = MakeSittingModel(*human, body);
  model->gaze = MakeGazeModel(body);
  model->reach = MakeReachModel(body);
  model->hands = MakeHandModel(human->skeleton, body);
  model->face = MakeFaceModel(*human);
  model->masks = MakeJointMasks(human->skeleton, body);
  for (const Clip& clip : human->clips) {
    model->clips.emplace_back(clip, human->skeleton.size());
    model->turned.push_back(TurnedFromFirst(clip, human->skeleton.size()));
  }
  model->human = std::move(human);
  return model;
}

std::shared_ptr<const AnimationRig> MakeAnimationRig(Human human) {
  const auto shared = std::make_shared<Human>(std::move(human));
  std::shared_ptr<const AnimationRig> model =
      MakeAnimationRig(std::shared_ptr<const Human>(shared));
  for (Clip& clip : shared->clips) {
    Release(clip.keys);
  }
  return model;
}

void UpdateAnimationState(const AnimationRig& model,
                          const glm::vec3& position,
                          float heading,
                          float seconds,
                          const FloorHeight& floor,
                          AnimationState& animation_state) {
  animation_state.time += static_cast<double>(seconds);
  UpdateAnimation(animation_state.animation, static_cast<double>(seconds));
  UpdateLocomotion(model.locomotion, position, heading, seconds, floor, animation_state.locomotion);
  UpdateSitting(animation_state.sitting, seconds);
  UpdateGaze(model.gaze, position, heading, animation_state.seed, seconds, animation_state.gaze);
  for (size_t side = 0; side < 2; ++side) {
    UpdateReach(animation_state.reaches[side], seconds);
    UpdateHand(animation_state.hands[side], seconds);
  }
  UpdateFace(animation_state.face, seconds);
}

AnimationState Interpolate(const AnimationState& previous,
                           const AnimationState& current,
                           float alpha) {
  if (previous.seed != current.seed || previous.time > current.time) {
    return current;  // Another person, or a restart.
  }
  AnimationState mixed = current;
  mixed.time = previous.time + static_cast<double>(alpha) * (current.time - previous.time);
  mixed.animation = Interpolate(previous.animation, current.animation, alpha);
  mixed.locomotion = Interpolate(previous.locomotion, current.locomotion, alpha);
  mixed.sitting = Interpolate(previous.sitting, current.sitting, alpha);
  mixed.gaze = Interpolate(previous.gaze, current.gaze, alpha);
  for (size_t side = 0; side < 2; ++side) {
    mixed.reaches[side] = Interpolate(previous.reaches[side], current.reaches[side], alpha);
    mixed.hands[side] = Interpolate(previous.hands[side], current.hands[side], alpha);
  }
  mixed.face = Interpolate(previous.face, current.face, alpha);
  return mixed;
}

Animator::Animator(std::shared_ptr<const AnimationRig> model) : model_(std::move(model)) {
  const size_t joints = human().skeleton.size();
  pose_.resize(joints);
  previous_pose_.resize(joints);
  clip_pose_.resize(joints);
  actor_from_joint_.resize(joints, glm::mat4(1.0f));
  skin_.resize(joints, glm::mat4(1.0f));
  face_weights_.resize(human().face.size());
  morph_weights_.resize(human().morphs.size());
}

void Animator::Pose(const AnimationState& animation_state) {
  const Skeleton& skeleton = human().skeleton;
  const BodyRig& body = model_->locomotion.body;
  const Locomotion& at = animation_state.locomotion;
  const IdleMotionSample idle_motion =
      SampleIdleMotion(animation_state.seed, animation_state.time, animation_state.idle_intensity);
  PoseBody(animation_state, idle_motion);
  ApplyIdleMotion(skeleton, body, idle_motion, pose_);
  ApplyReachPosture(model_->reach, skeleton, animation_state.reaches,
                    SeatedShare(animation_state.sitting), pose_);
  Gaze gaze = animation_state.gaze;
  for (const Reach& reach : animation_state.reaches) {
    gaze.torso *= 1.0f - 0.8f * Goal(reach).weight;  // Reaching has priority.
  }
  ApplyGaze(model_->gaze, skeleton, gaze, at.position, at.heading, pose_);
  for (const int side : {kRight, kLeft}) {
    ApplyReach(model_->reach, skeleton, animation_state.reaches[static_cast<size_t>(side)], side,
               pose_);
    ApplyHand(model_->hands, animation_state.hands[static_cast<size_t>(side)], idle_motion, side,
              pose_);
  }
  ComputeFaceWeights(model_->face, human(), animation_state.face, animation_state.gaze.lids,
                     face_weights_, morph_weights_);
  ApplyFaceTurns(human(), face_weights_, pose_);
  ComputeActorFromJoint(skeleton, pose_, actor_from_joint_);
  ComputeSkinMatrices(skeleton, actor_from_joint_, skin_);
}

// Clips are layered over the procedural motion; a clip that moves the whole body hides it.
void Animator::PoseBody(const AnimationState& animation_state,
                        const IdleMotionSample& idle_motion) {
  const Animation& animation = animation_state.animation;
  const bool fades = animation.weight < 1.0f;
  const bool hidden =
      !fades && animation.clip != Animation::kNoClip && animation.part == BodyPart::kWhole;
  if (!hidden) {
    Locomotion standing = animation_state.locomotion;
    standing.settled *= 1.0f - animation_state.sitting.amount;  // The seat bears it.
    ApplyLocomotion(model_->locomotion, human().skeleton, standing, idle_motion, pose_);
    ApplySitting(model_->sitting, model_->reach, human().skeleton, animation_state.sitting, pose_);
  }
  if (fades) {
    std::copy(pose_.begin(), pose_.end(), previous_pose_.begin());
    LayClip(animation.previous_clip, animation.previous_time, animation.previous_part,
            previous_pose_);
  }
  LayClip(animation.clip, animation.clip_time, animation.part, pose_);
  if (fades) {
    BlendPose(pose_, previous_pose_, 1.0f - animation.weight);
  }
}

void Animator::LayClip(int clip, double time, BodyPart part, std::span<JointTransform> pose) {
  if (clip == Animation::kNoClip) {
    return;
  }
  CHECK(clip >= 0 && static_cast<size_t>(clip) < model_->clips.size());
  const CompressedClip& source = model_->clips[static_cast<size_t>(clip)];
  if (part == BodyPart::kWhole) {
    source.Sample(time, pose);
    return;
  }
  source.Sample(time, clip_pose_);
  BlendPose(pose, clip_pose_, 1.0f, model_->masks[static_cast<size_t>(part)]);
}

}  // namespace lararium::human
