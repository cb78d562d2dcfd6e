#include "tests/human/full_body.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_inverse.hpp>
#include <string>

#include "shared/core/random.h"

namespace lararium::human {
namespace {

struct Joint {
  const char* name;
  const char* parent;
  glm::vec3 position;  // rest position, actor frame; right side of pairs
};

constexpr Joint kMiddle[] = {
    {"humanoid_root", "", {0.0f, 0.95f, 0.0f}},
    {"sacroiliac", "humanoid_root", {0.0f, 0.96f, 0.01f}},
    {"vl5", "humanoid_root", {0.0f, 1.01f, 0.025f}},
    {"vl1", "vl5", {0.0f, 1.10f, 0.020f}},
    {"vt10", "vl1", {0.0f, 1.18f, 0.030f}},
    {"vt4", "vt10", {0.0f, 1.32f, 0.045f}},
    {"vc7", "vt4", {0.0f, 1.44f, 0.040f}},
    {"vc4", "vc7", {0.0f, 1.48f, 0.030f}},
    {"skullbase", "vc4", {0.0f, 1.54f, 0.015f}},
    {"temporomandibular", "skullbase", {0.0f, 1.55f, -0.010f}},
};

constexpr Joint kPaired[] = {
    {"hip", "sacroiliac", {0.095f, 0.90f, 0.0f}},
    {"knee", "hip", {0.100f, 0.49f, -0.010f}},
    {"ankle", "knee", {0.105f, 0.08f, 0.030f}},
    {"midtarsal", "ankle", {0.118f, 0.025f, -0.105f}},
    {"eyeball_joint", "skullbase", {0.032f, 1.63f, -0.080f}},
    {"sternoclavicular", "vt4", {0.020f, 1.41f, -0.030f}},
};

// The arm along +X from the shoulder, palm down; it is lowered afterwards.
constexpr glm::vec3 kShoulder(0.17f, 1.41f, 0.01f);
constexpr Joint kArm[] = {
    {"shoulder", "sternoclavicular", kShoulder},
    {"elbow", "shoulder", {0.45f, 1.41f, 0.025f}},
    {"forearm_roll", "elbow", {0.57f, 1.41f, 0.020f}},
    {"wrist", "forearm_roll", {0.70f, 1.41f, 0.010f}},
};

class BodyMaker {
 public:
  BodyMaker(float arms_lowered, uint64_t axes_seed)
      : lowered_(glm::angleAxis(-arms_lowered, glm::vec3(0, 0, 1))),
        random_(axes_seed),
        turned_(axes_seed != 0) {}

  Human Make() {
    human_.name = "full body";
    human_.credits = "made for the tests";
    for (const Joint& joint : kMiddle) {
      Append(joint.name, joint.parent, joint.position);
    }
    for (const float side : {1.0f, -1.0f}) {
      AppendSide(side);
    }
    return std::move(human_);
  }

 private:
  void AppendSide(float side) {
    const std::string prefix = side > 0.0f ? "r_" : "l_";
    const auto parent_of = [&](const Joint& joint) {
      const std::string paired = prefix + joint.parent;
      return human_.skeleton.Find(paired).has_value() ? paired : std::string(joint.parent);
    };
    const auto mirrored = [side](const glm::vec3& p) { return glm::vec3(side * p.x, p.y, p.z); };
    for (const Joint& joint : kPaired) {
      Append(prefix + joint.name, parent_of(joint), mirrored(joint.position));
    }
    const auto lowered = [&](const glm::vec3& p) {
      return mirrored(kShoulder + lowered_ * (p - kShoulder));
    };
    for (const Joint& joint : kArm) {
      Append(prefix + joint.name, parent_of(joint), lowered(joint.position));
    }
    constexpr const char* kFingers[] = {"index", "middle", "ring", "pinky"};
    for (int finger = 0; finger < 4; ++finger) {
      const float z = -0.015f + 0.020f * static_cast<float>(finger);
      std::string parent = prefix + "wrist";
      for (int i = 1; i <= 4; ++i) {
        const float x = 0.79f + 0.028f * static_cast<float>(i - 1);
        const std::string name = prefix + kFingers[finger] + std::to_string(i);
        Append(name, parent, lowered({x, 1.408f - 0.002f * static_cast<float>(i), z}));
        parent = name;
      }
    }
    std::string parent = prefix + "wrist";
    for (int i = 1; i <= 4; ++i) {
      const float along = 0.028f * static_cast<float>(i - 1);
      const std::string name = prefix + "thumb" + std::to_string(i);
      Append(name, parent,
             lowered({0.725f + 0.7f * along, 1.395f - 0.4f * along, -0.015f - 0.6f * along}));
      parent = name;
    }
  }

  void Append(const std::string& name, const std::string& parent, const glm::vec3& position) {
    Skeleton& skeleton = human_.skeleton;
    glm::mat4 actor_from_joint = glm::mat4_cast(turned_ ? RandomTurn() : glm::quat(1, 0, 0, 0));
    actor_from_joint[3] = glm::vec4(position, 1.0f);
    glm::mat4 parent_from_joint = actor_from_joint;
    int16_t index = Skeleton::kNoParent;
    if (!parent.empty()) {
      index = static_cast<int16_t>(*skeleton.Find(parent));
      parent_from_joint = skeleton.joint_from_actor[static_cast<size_t>(index)] * actor_from_joint;
    }
    skeleton.names.push_back(name);
    skeleton.parents.push_back(index);
    skeleton.rest.push_back({glm::quat_cast(glm::mat3(parent_from_joint)),
                             glm::vec3(parent_from_joint[3]), glm::vec3(1.0f)});
    skeleton.joint_from_actor.push_back(glm::affineInverse(actor_from_joint));
  }

  glm::quat RandomTurn() {
    return glm::normalize(
        glm::quat{static_cast<float>(random_.Normal()), static_cast<float>(random_.Normal()),
                  static_cast<float>(random_.Normal()), static_cast<float>(random_.Normal())});
  }

  glm::quat lowered_;
  Random random_;
  bool turned_;
  Human human_;
};

}  // namespace

Human FullBody(float arms_lowered, uint64_t axes_seed) {
  return BodyMaker(arms_lowered, axes_seed).Make();
}

}  // namespace lararium::human
