#include "editor/import/model/vrm.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "shared/core/lower_case.h"

namespace lararium::import {
namespace {

constexpr size_t kMaxExpressions = 512, kMaxSprings = 1024, kMaxColliders = 1024;
constexpr size_t kMaxChain = 64;

const Json& Nothing() {
  static const Json kNothing;
  return kNothing;
}

const Json& Field(const Json& json, const char* key) {
  if (!json.is_object()) {
    return Nothing();
  }
  const auto found = json.find(key);
  return found == json.end() ? Nothing() : *found;
}

float NumberOr(const Json& json, const char* key, float instead) {
  const Json& value = Field(json, key);
  const float number = value.is_number() ? value.get<float>() : instead;
  return std::isfinite(number) ? number : instead;
}

std::string TextOf(const Json& json, const char* key) {
  const Json& value = Field(json, key);
  return value.is_string() ? value.get<std::string>().substr(0, 256) : std::string();
}

std::optional<size_t> IndexOf(const Json& value, size_t count) {
  if (!value.is_number_integer() || value.get<int64_t>() < 0 || value.get<uint64_t>() >= count) {
    return std::nullopt;
  }
  return value.get<size_t>();
}

// The H-Anim joint of a VRM bone; empty if there is none.
std::string JointOf(const std::string& bone) {
  static const std::map<std::string, std::string> kMiddle = {
      {"hips", "humanoid_root"},   {"spine", "vl5"}, {"chest", "vt10"},
      {"upperChest", "vt4"},       {"neck", "vc4"},  {"head", "skullbase"},
      {"jaw", "temporomandibular"}};
  static const std::map<std::string, std::string> kPaired = {{"Eye", "eyeball_joint"},
                                                             {"Shoulder", "sternoclavicular"},
                                                             {"UpperArm", "shoulder"},
                                                             {"LowerArm", "elbow"},
                                                             {"Hand", "wrist"},
                                                             {"UpperLeg", "hip"},
                                                             {"LowerLeg", "knee"},
                                                             {"Foot", "ankle"},
                                                             {"Toes", "midtarsal"},
                                                             {"ThumbMetacarpal", "thumb1"},
                                                             {"IndexProximal", "index1"},
                                                             {"IndexIntermediate", "index2"},
                                                             {"IndexDistal", "index3"},
                                                             {"MiddleProximal", "middle1"},
                                                             {"MiddleIntermediate", "middle2"},
                                                             {"MiddleDistal", "middle3"},
                                                             {"RingProximal", "ring1"},
                                                             {"RingIntermediate", "ring2"},
                                                             {"RingDistal", "ring3"},
                                                             {"LittleProximal", "pinky1"},
                                                             {"LittleIntermediate", "pinky2"},
                                                             {"LittleDistal", "pinky3"},
                                                             {"ThumbIntermediate", "thumb2"},
                                                             {"ThumbDistal", "thumb3"}};
  if (const auto found = kMiddle.find(bone); found != kMiddle.end()) {
    return found->second;
  }
  for (const auto& [prefix, side] : {std::pair{"left", "l_"}, std::pair{"right", "r_"}}) {
    const std::string_view start(prefix);
    if (bone.starts_with(start)) {
      const auto found = kPaired.find(bone.substr(start.size()));
      return found == kPaired.end() ? std::string() : side + found->second;
    }
  }
  return {};
}

// Converts the preset names of VRM 0.x.
std::string PresetName(const std::string& name) {
  static const std::map<std::string, std::string> kOld = {{"a", "aa"},
                                                          {"i", "ih"},
                                                          {"u", "ou"},
                                                          {"e", "ee"},
                                                          {"o", "oh"},
                                                          {"joy", "happy"},
                                                          {"sorrow", "sad"},
                                                          {"fun", "relaxed"},
                                                          {"blink_l", "blinkLeft"},
                                                          {"blink_r", "blinkRight"},
                                                          {"lookup", "lookUp"},
                                                          {"lookdown", "lookDown"},
                                                          {"lookleft", "lookLeft"},
                                                          {"lookright", "lookRight"}};
  const auto found = kOld.find(LowerCase(name));
  return found == kOld.end() ? name : found->second;
}

class Reader {
 public:
  explicit Reader(const GltfDocument& document) : json_(document.json) {
    nodes_ = CountOf("nodes");
    meshes_ = CountOf("meshes");
  }

  std::optional<Vrm> Read() {
    const Json& extensions = Field(json_, "extensions");
    if (const Json& vrm = Field(extensions, "VRMC_vrm"); vrm.is_object()) {
      ReadBones(Field(Field(vrm, "humanoid"), "humanBones"));
      ReadExpressions(Field(Field(vrm, "expressions"), "preset"));
      ReadExpressions(Field(Field(vrm, "expressions"), "custom"));
      ReadSprings(Field(extensions, "VRMC_springBone"));
      const Json& meta = Field(vrm, "meta");
      const Json& authors = Field(meta, "authors");
      SetCredits(TextOf(meta, "name"),
                 authors.is_array() && !authors.empty() && authors[0].is_string()
                     ? authors[0].get<std::string>().substr(0, 256)
                     : std::string(),
                 TextOf(meta, "licenseUrl"));
      return std::move(vrm_);
    }
    if (const Json& vrm = Field(extensions, "VRM"); vrm.is_object()) {
      ReadOldBones(Field(Field(vrm, "humanoid"), "humanBones"));
      ReadOldExpressions(Field(Field(vrm, "blendShapeMaster"), "blendShapeGroups"));
      ReadOldSprings(Field(vrm, "secondaryAnimation"));
      const Json& meta = Field(vrm, "meta");
      SetCredits(TextOf(meta, "title"), TextOf(meta, "author"), TextOf(meta, "licenseName"));
      return std::move(vrm_);
    }
    return std::nullopt;
  }

 private:
  size_t CountOf(const char* list) const {
    const Json& entries = Field(json_, list);
    return entries.is_array() ? entries.size() : 0;
  }

  void SetCredits(const std::string& title, const std::string& author, const std::string& licence) {
    for (const std::string& part : {title, author, licence}) {
      if (!part.empty()) {
        vrm_.credits += (vrm_.credits.empty() ? "" : ", ") + part;
      }
    }
  }

  void AddBone(const std::string& bone, const Json& node) {
    std::string joint = JointOf(bone);
    // VRM 1.0 begins the thumb at the metacarpal, 0.x at the next bone.
    if (joint.empty() && bone.ends_with("ThumbProximal")) {
      const std::string side = bone.starts_with("left") ? "l_" : "r_";
      joint = side + (old_ ? "thumb1" : "thumb2");
    }
    if (const auto index = IndexOf(node, nodes_); index && !joint.empty()) {
      vrm_.bones[joint] = *index;
    }
  }

  void ReadBones(const Json& bones) {
    if (bones.is_object()) {
      for (const auto& [bone, entry] : bones.items()) {
        AddBone(bone, Field(entry, "node"));
      }
    }
  }

  void ReadOldBones(const Json& bones) {
    old_ = true;
    if (bones.is_array()) {
      for (const Json& entry : bones) {
        AddBone(TextOf(entry, "bone"), Field(entry, "node"));
      }
    }
  }

  size_t TargetCount(size_t mesh) const {
    const Json& primitives = Field(Field(json_, "meshes")[mesh], "primitives");
    if (!primitives.is_array() || primitives.empty()) {
      return 0;
    }
    const Json& targets = Field(primitives[0], "targets");
    return targets.is_array() ? targets.size() : 0;
  }

  void AddBind(std::optional<size_t> mesh,
               const Json& target,
               float weight,
               Vrm::Expression& expression) const {
    const auto index = mesh ? IndexOf(target, TargetCount(*mesh)) : std::nullopt;
    if (index) {
      expression.binds.push_back({*mesh, *index, std::clamp(weight, 0.0f, 1.0f)});
    }
  }

  void AddExpression(Vrm::Expression expression) {
    if (!expression.binds.empty() && !expression.name.empty() &&
        vrm_.expressions.size() < kMaxExpressions) {
      vrm_.expressions.push_back(std::move(expression));
    }
  }

  void ReadExpressions(const Json& expressions) {
    if (!expressions.is_object()) {
      return;
    }
    for (const auto& [name, entry] : expressions.items()) {
      Vrm::Expression expression;
      expression.name = name.substr(0, 256);
      if (const Json& binds = Field(entry, "morphTargetBinds"); binds.is_array()) {
        for (const Json& bind : binds) {
          const auto node = IndexOf(Field(bind, "node"), nodes_);
          const auto mesh =
              node ? IndexOf(Field(Field(json_, "nodes")[*node], "mesh"), meshes_) : std::nullopt;
          AddBind(mesh, Field(bind, "index"), NumberOr(bind, "weight", 1.0f), expression);
        }
      }
      AddExpression(std::move(expression));
    }
  }

  void ReadOldExpressions(const Json& groups) {
    if (!groups.is_array()) {
      return;
    }
    for (const Json& group : groups) {
      const std::string preset = TextOf(group, "presetName");
      Vrm::Expression expression;
      expression.name =
          preset.empty() || preset == "unknown" ? TextOf(group, "name") : PresetName(preset);
      if (const Json& binds = Field(group, "binds"); binds.is_array()) {
        for (const Json& bind : binds) {
          AddBind(IndexOf(Field(bind, "mesh"), meshes_), Field(bind, "index"),
                  0.01f * NumberOr(bind, "weight", 100.0f), expression);
        }
      }
      AddExpression(std::move(expression));
    }
  }

  static glm::vec3 VectorOf(const Json& value) {
    glm::vec3 vector(0.0f);
    constexpr std::array kAxes = {"x", "y", "z"};
    for (int axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<size_t>(axis);
      if (value.is_array() && value.size() == 3 && value[i].is_number()) {
        vector[axis] = value[i].get<float>();
      } else {
        vector[axis] = NumberOr(value, kAxes[i], 0.0f);
      }
      vector[axis] = std::isfinite(vector[axis]) ? vector[axis] : 0.0f;
    }
    return vector;
  }

  void AddCollider(const Json& node, const Json& shape, const glm::vec3& a, const glm::vec3& b) {
    const auto index = IndexOf(node, nodes_);
    const float radius = NumberOr(shape, "radius", 0.0f);
    if (index && radius > 0.0f && radius < 10.0f && vrm_.colliders.size() < kMaxColliders) {
      vrm_.colliders.push_back({*index, a, b, radius});
    }
  }

  bool HasChild(size_t node, size_t child) const {
    const Json& children = Field(Field(json_, "nodes")[node], "children");
    return children.is_array() && std::any_of(children.begin(), children.end(), [&](const Json& c) {
             return IndexOf(c, nodes_) == child;
           });
  }

  void AddSpring(Vrm::Spring spring) {
    spring.stiffness = std::clamp(spring.stiffness, 0.0f, 10.0f);
    spring.drag = std::clamp(spring.drag, 0.0f, 0.99f);
    spring.gravity = std::clamp(spring.gravity, 0.0f, 10.0f);
    spring.radius = std::clamp(spring.radius, 0.0f, 1.0f);
    if (spring.nodes.size() >= 2 && vrm_.springs.size() < kMaxSprings) {
      vrm_.springs.push_back(std::move(spring));
    }
  }

  void ReadSprings(const Json& extension) {
    if (const Json& colliders = Field(extension, "colliders"); colliders.is_array()) {
      for (const Json& collider : colliders) {
        const Json& shape = Field(collider, "shape");
        const Json& sphere = Field(shape, "sphere");
        const Json& capsule = Field(shape, "capsule");
        const Json& form = sphere.is_object() ? sphere : capsule;
        const glm::vec3 a = VectorOf(Field(form, "offset"));
        AddCollider(Field(collider, "node"), form, a,
                    sphere.is_object() ? a : VectorOf(Field(form, "tail")));
      }
    }
    const Json& springs = Field(extension, "springs");
    if (!springs.is_array()) {
      return;
    }
    for (const Json& entry : springs) {
      Vrm::Spring spring;
      spring.name = TextOf(entry, "name");
      const Json& joints = Field(entry, "joints");
      for (size_t i = 0; joints.is_array() && i < std::min(joints.size(), kMaxChain); ++i) {
        const auto node = IndexOf(Field(joints[i], "node"), nodes_);
        if (!node || (!spring.nodes.empty() && !HasChild(spring.nodes.back(), *node))) {
          break;
        }
        if (spring.nodes.empty()) {
          spring.stiffness = NumberOr(joints[i], "stiffness", 1.0f);
          spring.drag = NumberOr(joints[i], "dragForce", 0.5f);
          spring.gravity = NumberOr(joints[i], "gravityPower", 0.0f);
          spring.radius = NumberOr(joints[i], "hitRadius", 0.0f);
        }
        spring.nodes.push_back(*node);
      }
      AddSpring(std::move(spring));
    }
  }

  // VRM 0.x names only the first bones of chains; each path down from there is a chain.
  void ReadOldSprings(const Json& secondary) {
    if (const Json& groups = Field(secondary, "colliderGroups"); groups.is_array()) {
      for (const Json& group : groups) {
        if (const Json& colliders = Field(group, "colliders"); colliders.is_array()) {
          for (const Json& collider : colliders) {
            const glm::vec3 at = VectorOf(Field(collider, "offset"));
            AddCollider(Field(group, "node"), collider, at, at);
          }
        }
      }
    }
    const Json& groups = Field(secondary, "boneGroups");
    if (!groups.is_array()) {
      return;
    }
    for (const Json& group : groups) {
      Vrm::Spring spring;
      spring.name = TextOf(group, "comment");
      spring.stiffness = NumberOr(group, "stiffiness", 1.0f);  // The format has this spelling.
      spring.drag = NumberOr(group, "dragForce", 0.4f);
      spring.gravity = NumberOr(group, "gravityPower", 0.0f);
      spring.radius = NumberOr(group, "hitRadius", 0.02f);
      const Json& roots = Field(group, "bones");
      for (size_t i = 0; roots.is_array() && i < std::min(roots.size(), kMaxSprings); ++i) {
        if (const auto root = IndexOf(roots[i], nodes_)) {
          spring.nodes = {*root};
          AddWaysDown(spring);
        }
      }
    }
  }

  // The nodes of the document are a tree of bounded depth (ParseGltf).
  void AddWaysDown(const Vrm::Spring& spring) {
    if (vrm_.springs.size() >= kMaxSprings || spring.nodes.size() >= kMaxChain) {
      return;
    }
    const Json& children = Field(Field(json_, "nodes")[spring.nodes.back()], "children");
    bool first = true;
    for (size_t i = 0; children.is_array() && i < children.size(); ++i) {
      if (const auto child = IndexOf(children[i], nodes_)) {
        Vrm::Spring longer = spring;
        if (!first) {
          longer.nodes.clear();  // The stem before a fork belongs to the first path.
        }
        longer.nodes.push_back(*child);
        AddWaysDown(longer);
        first = false;
      }
    }
    if (first) {
      AddSpring(spring);
    }
  }

  const Json& json_;
  size_t nodes_ = 0, meshes_ = 0;
  bool old_ = false;
  Vrm vrm_;
};

}  // namespace

std::optional<Vrm> ReadVrm(const GltfDocument& document) { return Reader(document).Read(); }

}  // namespace lararium::import
