#pragma once

// All that one person does at once, and the body that shows it.

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
#include "shared/human/life.h"
#include "shared/human/locomotion.h"
#include "shared/human/reach.h"
#include "shared/human/sitting.h"

namespace lararium::human {

struct Human;

// Plain values: copy it, compare it, interpolate between two ticks of it. Where a
// member is to be set from outside, its header says so; the functions there change it
// (StartClip, SitDown, StartReach, SetHandPose, SetExpression, ...).
struct Performance {
  uint64_t seed = 0;    // of everything that differs between people: set once
  double time = 0.0;    // seconds of life
  float vigour = 1.0f;  // of life, 0..1
  Animation animation;
  Locomotion locomotion;
  Sitting sitting;
  Gaze gaze;
  std::array<Reach, 2> reaches;  // by side: kRight, kLeft
  std::array<HandState, 2> hands;
  Face face;

  friend bool operator==(const Performance&, const Performance&) = default;
};

// What performing knows of one human; build once, share between actors and threads.
struct PerformanceModel {
  std::shared_ptr<const Human> human;
  // Parallel to Human::clips.
  std::vector<CompressedClip> clips;
  std::vector<std::vector<float>> turned;  // TurnedFromFirst
  LocomotionModel locomotion;
  SittingModel sitting;
  GazeModel gaze;
  ReachModel reach;
  HandModel hands;
  FaceModel face;
  JointMasks masks;
};
std::shared_ptr<const PerformanceModel> MakePerformanceModel(std::shared_ptr<const Human> human);
// The same of a human that nobody else needs: its clips lose their keys, which are here as they are
// played, in a fraction of the memory.
std::shared_ptr<const PerformanceModel> MakePerformanceModel(Human human);

// One tick: the root has come to position and heading (stage frame). Allocates nothing.
// Set gaze.kind and gaze.target, face.visemes, and move grips before it.
void UpdatePerformance(const PerformanceModel& model,
                       const glm::vec3& position,
                       float heading,
                       float seconds,
                       const FloorHeight& floor,
                       Performance& performance);

// Between two neighbouring ticks, alpha 0..1.
Performance Interpolate(const Performance& previous, const Performance& current, float alpha);

// Poses one person again and again without allocating. Threads: one performer each.
class Performer {
 public:
  explicit Performer(std::shared_ptr<const PerformanceModel> model);

  const PerformanceModel& model() const { return *model_; }
  const Human& human() const { return *model_->human; }

  // Clip or gait and seat, life, posture, gaze, reach, fingers, face, in this order.
  void Pose(const Performance& performance);

  // Of the last pose, parallel to the skeleton's joints.
  std::span<const JointTransform> pose() const { return pose_; }
  std::span<const glm::mat4> actor_from_joint() const { return actor_from_joint_; }
  std::span<const glm::mat4> skin() const { return skin_; }
  // Parallel to Human::face and Human::morphs.
  std::span<const float> face_weights() const { return face_weights_; }
  std::span<const float> morph_weights() const { return morph_weights_; }

 private:
  void PoseBody(const Performance& performance, const LifeSample& life);
  void LayClip(int clip, double time, BodyPart part, std::span<JointTransform> pose);

  std::shared_ptr<const PerformanceModel> model_;
  std::vector<JointTransform> pose_;
  std::vector<JointTransform> previous_pose_;
  std::vector<JointTransform> clip_pose_;
  std::vector<glm::mat4> actor_from_joint_;
  std::vector<glm::mat4> skin_;
  std::vector<float> face_weights_;
  std::vector<float> morph_weights_;
};

}  // namespace lararium::human
