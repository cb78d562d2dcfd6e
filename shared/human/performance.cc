#include "shared/human/performance.h"

#include <algorithm>

#include "shared/core/memory.h"
#include "shared/human/human.h"

namespace lararium::human {

std::shared_ptr<const PerformanceModel> MakePerformanceModel(std::shared_ptr<const Human> human) {
  CHECK(human != nullptr);
  auto model = std::make_shared<PerformanceModel>();
  const Body body = MakeBody(human->skeleton);
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

std::shared_ptr<const PerformanceModel> MakePerformanceModel(Human human) {
  const auto shared = std::make_shared<Human>(std::move(human));
  std::shared_ptr<const PerformanceModel> model =
      MakePerformanceModel(std::shared_ptr<const Human>(shared));
  for (Clip& clip : shared->clips) {
    Release(clip.keys);
  }
  return model;
}

void UpdatePerformance(const PerformanceModel& model,
                       const glm::vec3& position,
                       float heading,
                       float seconds,
                       const FloorHeight& floor,
                       Performance& performance) {
  performance.time += static_cast<double>(seconds);
  UpdateAnimation(performance.animation, static_cast<double>(seconds));
  UpdateLocomotion(model.locomotion, position, heading, seconds, floor, performance.locomotion);
  UpdateSitting(performance.sitting, seconds);
  UpdateGaze(model.gaze, position, heading, performance.seed, seconds, performance.gaze);
  for (size_t side = 0; side < 2; ++side) {
    UpdateReach(performance.reaches[side], seconds);
    UpdateHand(performance.hands[side], seconds);
  }
  UpdateFace(performance.face, seconds);
}

Performance Interpolate(const Performance& previous, const Performance& current, float alpha) {
  if (previous.seed != current.seed || previous.time > current.time) {
    return current;  // somebody else, or begun anew
  }
  Performance mixed = current;
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

Performer::Performer(std::shared_ptr<const PerformanceModel> model) : model_(std::move(model)) {
  const size_t joints = human().skeleton.size();
  pose_.resize(joints);
  previous_pose_.resize(joints);
  clip_pose_.resize(joints);
  actor_from_joint_.resize(joints, glm::mat4(1.0f));
  skin_.resize(joints, glm::mat4(1.0f));
  face_weights_.resize(human().face.size());
  morph_weights_.resize(human().morphs.size());
}

void Performer::Pose(const Performance& performance) {
  const Skeleton& skeleton = human().skeleton;
  const Body& body = model_->locomotion.body;
  const Locomotion& at = performance.locomotion;
  const LifeSample life = SampleLife(performance.seed, performance.time, performance.vigour);
  PoseBody(performance, life);
  ApplyLife(skeleton, body, life, pose_);
  ApplyReachPosture(model_->reach, skeleton, performance.reaches, SeatedShare(performance.sitting),
                    pose_);
  Gaze gaze = performance.gaze;
  for (const Reach& reach : performance.reaches) {
    gaze.torso *= 1.0f - 0.8f * Goal(reach).weight;  // the trunk serves the hands first
  }
  ApplyGaze(model_->gaze, skeleton, gaze, at.position, at.heading, pose_);
  for (const int side : {kRight, kLeft}) {
    ApplyReach(model_->reach, skeleton, performance.reaches[static_cast<size_t>(side)], side,
               pose_);
    ApplyHand(model_->hands, performance.hands[static_cast<size_t>(side)], life, side, pose_);
  }
  ComputeFaceWeights(model_->face, human(), performance.face, performance.gaze.lids, face_weights_,
                     morph_weights_);
  ApplyFaceTurns(human(), face_weights_, pose_);
  ComputeActorFromJoint(skeleton, pose_, actor_from_joint_);
  ComputeSkinMatrices(skeleton, actor_from_joint_, skin_);
}

// Clips lie over what the body does by itself; one that moves all of it hides it.
void Performer::PoseBody(const Performance& performance, const LifeSample& life) {
  const Animation& animation = performance.animation;
  const bool fades = animation.weight < 1.0f;
  const bool hidden =
      !fades && animation.clip != Animation::kNoClip && animation.part == BodyPart::kWhole;
  if (!hidden) {
    Locomotion standing = performance.locomotion;
    standing.settled *= 1.0f - performance.sitting.amount;  // a seat bears the weight
    ApplyLocomotion(model_->locomotion, human().skeleton, standing, life, pose_);
    ApplySitting(model_->sitting, model_->reach, human().skeleton, performance.sitting, pose_);
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

void Performer::LayClip(int clip, double time, BodyPart part, std::span<JointTransform> pose) {
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
