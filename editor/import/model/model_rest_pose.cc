#include "editor/import/model/model_rest_pose.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>

namespace lararium::import {
namespace {

constexpr float kUpright = 0.85f;      // Share of the length of legs and trunk that is height.
constexpr float kStretched = 0.6f;     // Least such share at which the direction of a pose counts.
constexpr float kSameWay = 0.5f;       // Cosine between two directions that count as one.
constexpr size_t kMostPoses = 600;     // Poses that are looked at.
constexpr float kFeetTogether = 0.3f;  // Weight of the distance between the ankles.

constexpr std::array<const char*, 2> kSides = {"r_", "l_"};

// Finds how a pose stands. Shares are 1 where all bones are straight and point upwards.
class StanceFinder {
 public:
  explicit StanceFinder(const ModelRig& rig) : rig_(rig) {}

  size_t NodeOf(const std::string& joint) const {
    return static_cast<size_t>(rig_.node_of_bone[rig_.map.Find(joint)->bone]);
  }

  // Returns the vector from the ankles to the head, in lengths of trunk and leg.
  glm::vec3 Rise(const std::vector<glm::mat4>& pose) const {
    return (At(pose, "skullbase") - 0.5f * (At(pose, "r_ankle") + At(pose, "l_ankle"))) /
           (Length("skullbase", "humanoid_root") + Length("r_ankle", "r_hip"));
  }
  float Trunk(const std::vector<glm::mat4>& pose, const glm::vec3& up) const {
    return glm::dot(At(pose, "skullbase") - At(pose, "humanoid_root"), up) /
           Length("skullbase", "humanoid_root");
  }
  float Leg(const std::vector<glm::mat4>& pose, const glm::vec3& up, size_t side) const {
    const std::string of = kSides[side];
    return glm::dot(At(pose, of + "hip") - At(pose, of + "ankle"), up) /
           Length(of + "ankle", of + "hip");
  }
  // The smallest share of the trunk and both legs.
  float Upright(const std::vector<glm::mat4>& pose, const glm::vec3& up) const {
    return std::min({Trunk(pose, up), Leg(pose, up, 0), Leg(pose, up, 1)});
  }
  // Distance of the ankles in lengths of a leg.
  float Apart(const std::vector<glm::mat4>& pose) const {
    return glm::distance(At(pose, "r_ankle"), At(pose, "l_ankle")) / Length("r_ankle", "r_hip");
  }

 private:
  glm::vec3 At(const std::vector<glm::mat4>& pose, const std::string& joint) const {
    return glm::vec3(pose[NodeOf(joint)][3]);
  }

  // Length of the bones between two joints.
  float Length(const std::string& lower, const std::string& upper) const {
    const auto top = static_cast<int>(rig_.map.Find(upper)->bone);
    float length = 0.0f;
    for (auto bone = static_cast<int>(rig_.map.Find(lower)->bone);
         bone != top && rig_.bones.parents[static_cast<size_t>(bone)] != Rig::kNoParent;) {
      const int parent = rig_.bones.parents[static_cast<size_t>(bone)];
      length += glm::distance(rig_.bones.positions[static_cast<size_t>(bone)],
                              rig_.bones.positions[static_cast<size_t>(parent)]);
      bone = parent;
    }
    return std::max(length, 1e-6f);
  }

  const ModelRig& rig_;
};

glm::vec3 Direction(const glm::vec3& vector) {
  return glm::length(vector) > 0.0f ? glm::normalize(vector) : vector;
}

// The best pose of a part of the body.
struct Best {
  float score = std::numeric_limits<float>::lowest();
  double time = 0.0;
  std::vector<glm::mat4> local;

  void Offer(float its_score, double its_time, const std::vector<glm::mat4>& its_local) {
    if (its_score > score) {
      score = its_score;
      time = its_time;
      local = its_local;
    }
  }
};

// Calls `use` with the time, and the local and global transforms of the nodes, of many poses.
void ForPoses(
    const SceneNodes& nodes,
    const AnimationSampler& sampler,
    const std::function<void(double, const std::vector<glm::mat4>&, const std::vector<glm::mat4>&)>&
        use) {
  std::vector<glm::mat4> local = nodes.local, pose(nodes.size());
  for (size_t i = 0; i < kMostPoses; ++i) {
    const double time = sampler.duration() * static_cast<double>(i) / (kMostPoses - 1);
    sampler.Sample(time, local);
    nodes.Globals(local, pose);
    use(time, local, pose);
  }
}

}  // namespace

std::optional<std::vector<glm::mat4>> FindRestInMotion(const ModelScene& model,
                                                       const ModelRig& rig,
                                                       std::vector<std::string>& notes) {
  if (!rig.map.IsHuman() || model.scene->mNumAnimations == 0) {
    return std::nullopt;
  }
  std::vector<AnimationSampler> samplers;
  for (unsigned i = 0; i < model.scene->mNumAnimations; ++i) {
    samplers.emplace_back(*model.scene->mAnimations[i], model.nodes);
  }
  const AnimationSampler& longest =
      *std::max_element(samplers.begin(), samplers.end(),
                        [](const auto& a, const auto& b) { return a.duration() < b.duration(); });
  const SceneNodes& nodes = model.nodes;
  const StanceFinder finder(rig);
  std::vector<glm::mat4> rest(nodes.size());
  nodes.Globals(nodes.local, rest);
  const glm::vec3 up_at_rest = Direction(finder.Rise(rest));
  const bool stands_at_rest = finder.Upright(rest, up_at_rest) > kUpright;
  glm::vec3 sum(0.0f);
  size_t standing = 0, as_at_rest = 0;
  ForPoses(nodes, longest, [&](double, const auto&, const auto& pose) {
    const glm::vec3 rise = finder.Rise(pose);
    if (finder.Upright(pose, Direction(rise)) > kStretched) {
      sum += rise;
      ++standing;
      as_at_rest += glm::dot(Direction(rise), up_at_rest) > kSameWay ? 1 : 0;
    }
  });
  const size_t least = stands_at_rest ? kMostPoses / 2 : 1;
  if (standing < least || (stands_at_rest && 20 * as_at_rest > standing)) {
    return std::nullopt;
  }
  const glm::vec3 up = Direction(sum);
  Best trunk;
  std::array<Best, 2> legs;
  ForPoses(nodes, longest, [&](double time, const auto& local, const auto& pose) {
    trunk.Offer(finder.Trunk(pose, up) - kFeetTogether * finder.Apart(pose), time, local);
    for (size_t side = 0; side < 2; ++side) {
      legs[side].Offer(finder.Leg(pose, up, side), time, local);
    }
  });
  for (size_t side = 0; side < 2; ++side) {
    const size_t hip = finder.NodeOf(std::string(kSides[side]) + "hip");
    std::vector<bool> is_leg(nodes.size(), false);
    for (size_t n = hip; n < nodes.size(); ++n) {
      is_leg[n] = n == hip || (n > hip && is_leg[static_cast<size_t>(nodes.parents[n])]);
      trunk.local[n] = is_leg[n] ? legs[side].local[n] : trunk.local[n];
    }
  }
  nodes.Globals(trunk.local, rest);
  char text[200];
  std::snprintf(text, sizeof(text),
                "its zero pose does not show a person who stands as in its motion; its pose at "
                "rest is taken from it, at %.2f s, and its legs at %.2f s and %.2f s",
                trunk.time, legs[0].time, legs[1].time);
  notes.emplace_back(text);
  return rest;
}

}  // namespace lararium::import
