#include "editor/bake/key_poses.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <utility>

#include "shared/human/animator.h"
#include "shared/human/skinning.h"

namespace lararium::bake {
namespace {

using JointPose = std::vector<human::JointTransform>;

constexpr float kTick = 1.0f / 60.0f;  // seconds
constexpr float kWalkingSpeed = 1.3f;  // m/s
constexpr float kStartUp = 2.0f;       // Seconds until a person walks evenly.
constexpr float kStride = 1.2f;        // seconds
constexpr int kTicksBetween = 6;       // Ticks between candidates while walking.
constexpr double kBetween = 0.25;      // Seconds between candidates in clips.
constexpr size_t kMaxCandidates = 400;
// Sum over blockers of radius^2 times distance^2, m^4. Poses that differ by less are the same.
constexpr float kSamePose = 1e-6f;

// Adds standing and walking, which the person can do without a clip.
void AddLocomotion(const std::shared_ptr<const human::Human>& human,
                   std::vector<JointPose>& poses) {
  const auto model = human::MakeAnimationRig(human);
  human::Animator animator(model);
  human::AnimationState animation_state;
  glm::vec3 position(0.0f);
  const auto add = [&] {
    animator.Pose(animation_state);
    poses.emplace_back(animator.pose().begin(), animator.pose().end());
  };
  human::UpdateAnimationState(*model, position, 0.0f, kTick, {}, animation_state);
  add();
  const int ticks = static_cast<int>((kStartUp + kStride) / kTick);
  for (int tick = 0; tick < ticks; ++tick) {
    position.z -= kWalkingSpeed * kTick;
    human::UpdateAnimationState(*model, position, 0.0f, kTick, {}, animation_state);
    if (static_cast<float>(tick) * kTick >= kStartUp && tick % kTicksBetween == 0) {
      add();
    }
  }
}

void AddClips(const human::Human& human, std::vector<JointPose>& poses) {
  for (const human::Clip& clip : human.clips) {
    for (double time = 0.0; time <= clip.duration && poses.size() < kMaxCandidates;
         time += kBetween) {
      JointPose pose = human.skeleton.rest;
      human::SampleClip(clip, time, pose);
      poses.push_back(std::move(pose));
    }
  }
}

// Positions of the blockers relative to the pelvis.
std::vector<glm::vec3> BlockerPlaces(const human::Skeleton& skeleton,
                                     std::span<const human::LightTransfer::Blocker> blockers,
                                     const JointPose& pose,
                                     size_t pelvis) {
  const std::vector<glm::mat4> skin = human::SkinOfPose(skeleton, pose);
  const glm::mat4 pelvis_from_actor = glm::inverse(skin[pelvis]);
  std::vector<glm::vec3> places;
  for (const human::LightTransfer::Blocker& blocker : blockers) {
    places.emplace_back(pelvis_from_actor * skin[blocker.joint] * glm::vec4(blocker.centre, 1.0f));
  }
  return places;
}

}  // namespace

std::vector<JointPose> ChooseKeyPoses(std::shared_ptr<const human::Human> human,
                                      std::span<const human::LightTransfer::Blocker> blockers,
                                      size_t count) {
  const human::Skeleton& skeleton = human->skeleton;
  std::vector<JointPose> candidates;
  const human::BodyRig body = human::MakeBodyRig(skeleton);
  if (body.walks()) {
    AddLocomotion(human, candidates);
  }
  const size_t rest = candidates.size();
  candidates.push_back(skeleton.rest);
  AddClips(*human, candidates);
  const size_t pelvis = body.root == human::kNoJoint ? 0 : static_cast<size_t>(body.root);
  std::vector<std::vector<glm::vec3>> places;
  for (const JointPose& pose : candidates) {
    places.push_back(BlockerPlaces(skeleton, blockers, pose, pelvis));
  }
  const auto apart = [&](size_t a, size_t b) {
    float sum = 0.0f;
    for (size_t i = 0; i < blockers.size(); ++i) {
      const glm::vec3 moved = places[a][i] - places[b][i];
      sum += blockers[i].radius * blockers[i].radius * glm::dot(moved, moved);
    }
    return sum;
  };
  std::vector<JointPose> chosen;
  std::vector<float> distance(candidates.size(), std::numeric_limits<float>::max());
  size_t next = 0;
  while (chosen.size() < count && distance[next] > kSamePose) {
    chosen.push_back(candidates[next]);
    for (size_t i = 0; i < candidates.size(); ++i) {
      distance[i] = std::min(distance[i], apart(i, next));
    }
    const auto farthest = std::max_element(distance.begin(), distance.end());
    const bool rest_is_next = chosen.size() == 1 && distance[rest] > kSamePose;
    next = rest_is_next ? rest : static_cast<size_t>(farthest - distance.begin());
  }
  return chosen;
}

}  // namespace lararium::bake
