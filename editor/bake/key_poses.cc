#include "editor/bake/key_poses.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <utility>

#include "shared/human/performance.h"

namespace lararium::bake {
namespace {

using Pose = std::vector<human::JointTransform>;

constexpr float kTick = 1.0f / 60.0f;  // seconds
constexpr float kWalkingSpeed = 1.3f;  // m/s
constexpr float kStartUp = 2.0f;       // seconds until somebody walks evenly
constexpr float kStride = 1.2f;        // seconds
constexpr int kTicksBetween = 6;       // of candidates while walking
constexpr double kBetween = 0.25;      // seconds between candidates in clips
constexpr size_t kMaxCandidates = 400;

// Standing, then walking: what the person does with no clip at all.
void AddLocomotion(const std::shared_ptr<const human::Human>& human, std::vector<Pose>& poses) {
  const auto model = human::MakePerformanceModel(human);
  human::Performer performer(model);
  human::Performance performance;
  glm::vec3 position(0.0f);
  const auto add = [&] {
    performer.Pose(performance);
    poses.emplace_back(performer.pose().begin(), performer.pose().end());
  };
  human::UpdatePerformance(*model, position, 0.0f, kTick, {}, performance);
  add();
  const int ticks = static_cast<int>((kStartUp + kStride) / kTick);
  for (int tick = 0; tick < ticks; ++tick) {
    position.z -= kWalkingSpeed * kTick;
    human::UpdatePerformance(*model, position, 0.0f, kTick, {}, performance);
    if (static_cast<float>(tick) * kTick >= kStartUp && tick % kTicksBetween == 0) {
      add();
    }
  }
}

void AddClips(const human::Human& human, std::vector<Pose>& poses) {
  for (const human::Clip& clip : human.clips) {
    for (double time = 0.0; time <= clip.duration && poses.size() < kMaxCandidates;
         time += kBetween) {
      Pose pose = human.skeleton.rest;
      human::SampleClip(clip, time, pose);
      poses.push_back(std::move(pose));
    }
  }
}

// Places of the joints, seen from the pelvis (the first joint with several children
// would do; the root's own frame is what carries everybody).
std::vector<glm::vec3> JointPlaces(const human::Skeleton& skeleton,
                                   const Pose& pose,
                                   size_t pelvis) {
  std::vector<glm::mat4> actor_from_joint(skeleton.size());
  human::ComputeActorFromJoint(skeleton, pose, actor_from_joint);
  const glm::mat4 pelvis_from_actor =
      glm::inverse(actor_from_joint[pelvis] * skeleton.joint_from_actor[pelvis]);
  std::vector<glm::vec3> places;
  for (const glm::mat4& joint : actor_from_joint) {
    places.emplace_back(pelvis_from_actor * joint[3]);
  }
  return places;
}

float Distance(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b) {
  float sum = 0.0f;
  for (size_t i = 0; i < a.size(); ++i) {
    sum += glm::dot(a[i] - b[i], a[i] - b[i]);
  }
  return sum;
}

}  // namespace

std::vector<Pose> ChooseKeyPoses(std::shared_ptr<const human::Human> human, size_t count) {
  const human::Skeleton& skeleton = human->skeleton;
  std::vector<Pose> candidates = {skeleton.rest};
  const human::Body body = human::MakeBody(skeleton);
  if (body.walks()) {
    AddLocomotion(human, candidates);
  }
  AddClips(*human, candidates);
  const size_t pelvis = body.root == human::kNoJoint ? 0 : static_cast<size_t>(body.root);
  std::vector<std::vector<glm::vec3>> places;
  for (const Pose& pose : candidates) {
    places.push_back(JointPlaces(skeleton, pose, pelvis));
  }
  std::vector<Pose> chosen;
  std::vector<float> distance(candidates.size(), std::numeric_limits<float>::max());
  size_t next = 0;
  while (chosen.size() < count && distance[next] > 1e-4f) {
    chosen.push_back(candidates[next]);
    for (size_t i = 0; i < candidates.size(); ++i) {
      distance[i] = std::min(distance[i], Distance(places[i], places[next]));
    }
    next =
        static_cast<size_t>(std::max_element(distance.begin(), distance.end()) - distance.begin());
  }
  return chosen;
}

}  // namespace lararium::bake
