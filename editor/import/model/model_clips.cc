#include "editor/import/model/model_clips.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <utility>

#include "editor/import/model/model_matrix.h"
#include "shared/human/finite.h"

namespace lararium::import {
namespace {

using human::JointTransform;
using human::Skeleton;

constexpr double kMaxSeconds = 3600.0;       // Longest clip.
constexpr size_t kMaxKeys = 8'000'000;       // Joints times keys, in all clips.
constexpr size_t kMaxSamples = 400'000'000;  // Nodes times keys, in all clips.

std::string NameOf(const aiAnimation& animation, const std::vector<human::Clip>& clips) {
  std::string name = animation.mName.C_Str();
  if (const size_t bar = name.rfind('|'); bar != std::string::npos) {
    name.erase(0, bar + 1);
  }
  name = name.empty() ? "clip " + std::to_string(clips.size() + 1) : name.substr(0, 256);
  const auto is_taken = [&](const human::Clip& clip) { return clip.name == name; };
  while (std::any_of(clips.begin(), clips.end(), is_taken)) {
    name += "'";
  }
  return name;
}

JointTransform Local(const Skeleton& skeleton,
                     const std::vector<JointTransform>& globals,
                     size_t joint) {
  const int16_t parent = skeleton.parents[joint];
  if (parent == Skeleton::kNoParent) {
    return globals[joint];
  }
  const JointTransform& above = globals[static_cast<size_t>(parent)];
  const JointTransform& global = globals[joint];
  const glm::quat back = glm::conjugate(above.rotation);
  const float scale = std::max(above.scale.x, 1e-6f);
  return {glm::normalize(back * global.rotation),
          back * (global.translation - above.translation) / scale, global.scale / scale};
}

bool EndsWhereItBegins(const human::Clip& clip, size_t joint_count) {
  const size_t last = clip.keys.size() - joint_count;
  for (size_t joint = 0; joint < joint_count; ++joint) {
    const JointTransform& a = clip.keys[joint];
    const JointTransform& b = clip.keys[last + joint];
    if (!(std::abs(glm::dot(a.rotation, b.rotation)) > 1.0f - 1e-5f) ||
        !(glm::distance(a.translation, b.translation) < 1e-3f)) {
      return false;
    }
  }
  return last > 0;
}

class ClipSampler {
 public:
  ClipSampler(const ModelScene& model,
              const BindPose& bind,
              const ModelSkeleton& skeleton,
              float keys_per_second)
      : model_(model), bind_(bind), skeleton_(skeleton), keys_per_second_(keys_per_second) {}

  Result<std::vector<human::Clip>> Sample(std::vector<std::string>& notes) {
    for (unsigned i = 0; i < model_.scene->mNumAnimations; ++i) {
      const aiAnimation& animation = *model_.scene->mAnimations[i];
      if (animation.mNumMeshChannels > 0 || animation.mNumMorphMeshChannels > 0) {
        notes.push_back("clip '" + std::string(animation.mName.C_Str()) +
                        "': the motion of its morph targets is left out");
      }
      LARARIUM_RETURN_IF_ERROR(AddClip(*model_.scene->mAnimations[i]));
    }
    return std::move(clips_);
  }

 private:
  Status AddClip(const aiAnimation& animation) {
    const SceneNodes& nodes = model_.nodes;
    const AnimationSampler sampler(animation, nodes);
    const double duration = sampler.duration();
    human::Clip clip;
    clip.name = NameOf(animation, clips_);
    if (!std::isfinite(duration) || duration < 0.0 || duration > kMaxSeconds) {
      return Status::Error(model_.place(), "clip '" + clip.name + "' has an impossible duration");
    }
    const auto intervals =
        static_cast<size_t>(std::max(1.0, std::round(duration * keys_per_second_)));
    const size_t keys = duration > 0.0 ? intervals + 1 : 1;
    key_count_ += keys * skeleton_.joints.size();
    sample_count_ += keys * nodes.size();
    if (key_count_ > kMaxKeys || sample_count_ > kMaxSamples) {
      return Status::Error(model_.place(), "the clips are too long", "split or shorten them");
    }
    clip.duration = static_cast<float>(duration);
    clip.keys_per_second = duration > 0.0
                               ? static_cast<float>(static_cast<double>(intervals) / duration)
                               : keys_per_second_;
    std::vector<glm::mat4> local = nodes.local, scene_from_node(nodes.size());
    for (size_t key = 0; key < keys; ++key) {
      const double at =
          keys > 1 ? duration * static_cast<double>(key) / static_cast<double>(intervals) : 0.0;
      sampler.Sample(at, local);
      nodes.Globals(local, scene_from_node);
      LARARIUM_RETURN_IF_ERROR(AddKey(scene_from_node, clip));
    }
    clip.loops = EndsWhereItBegins(clip, skeleton_.joints.size());
    clips_.push_back(std::move(clip));
    return Status();
  }

  // Converts one pose of the nodes in the file to transforms between our joints.
  Status AddKey(const std::vector<glm::mat4>& scene_from_node, human::Clip& clip) const {
    const std::vector<JointTransform> globals = ActorFromJoints(scene_from_node);
    for (size_t joint = 0; joint < globals.size(); ++joint) {
      clip.keys.push_back(Local(skeleton_.joints, globals, joint));
      if (!human::Valid(clip.keys.back())) {
        return Status::Error(model_.place(),
                             "clip '" + clip.name + "': joint '" + skeleton_.joints.names[joint] +
                                 "' has an impossible key",
                             "export the clip again");
      }
    }
    return Status();
  }

  // A joint has the frame of the actor, moved to the position of the joint in the bind pose,
  // and then moves as the node does from its bind pose.
  std::vector<JointTransform> ActorFromJoints(const std::vector<glm::mat4>& scene_from_node) const {
    const glm::mat4& actor_from_scene = skeleton_.actor_from_scene;
    const glm::mat4 scene_from_actor = glm::inverse(actor_from_scene);
    std::vector<JointTransform> globals(skeleton_.joints.size());
    for (size_t joint = 0; joint < globals.size(); ++joint) {
      const size_t node = skeleton_.node_of_joint[joint];
      const glm::mat4& bound = bind_.scene_from_node[node];
      JointTransform& global = globals[joint];
      if (IsUsable(bound)) {
        const glm::mat4 motion =
            actor_from_scene * scene_from_node[node] * glm::inverse(bound) * scene_from_actor;
        global = Decompose(motion * glm::translate(glm::mat4(1.0f), skeleton_.positions[joint]));
      } else {
        global.translation = Apply(actor_from_scene, glm::vec3(scene_from_node[node][3]));
      }
      if (std::abs(global.scale.x - 1.0f) < 1e-4f) {
        global.scale = glm::vec3(1.0f);
      }
    }
    return globals;
  }

  const ModelScene& model_;
  const BindPose& bind_;
  const ModelSkeleton& skeleton_;
  const float keys_per_second_;
  size_t key_count_ = 0, sample_count_ = 0;
  std::vector<human::Clip> clips_;
};

}  // namespace

Result<std::vector<human::Clip>> SampleClips(const ModelScene& model,
                                             const BindPose& bind,
                                             const ModelSkeleton& skeleton,
                                             float keys_per_second,
                                             std::vector<std::string>& notes) {
  return ClipSampler(model, bind, skeleton, keys_per_second).Sample(notes);
}

}  // namespace lararium::import
