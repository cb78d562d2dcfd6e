#include "shared/stage/object.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace lararium::stage {
namespace {

// Metres in one tick. A longer step (30 m/s) is a jump, which must not be interpolated.
constexpr float kObjectJump = 0.25f;

// parent_from_part with the part's joints at their present values.
Pose ParentFromPart(const ObjectModel& model, std::span<const float> joints, size_t part) {
  Pose pose = model.prop().parts[part].parent_from_part;
  const std::vector<ObjectJoint>& all = model.use().joints;
  for (size_t i = 0; i < all.size(); ++i) {
    if (static_cast<size_t>(all[i].part) != part) {
      continue;
    }
    if (all[i].kind == ObjectJoint::Kind::kHinge) {
      pose.rotation = glm::normalize(pose.rotation * glm::angleAxis(joints[i], all[i].axis));
    } else {
      pose.position += pose.rotation * (joints[i] * all[i].axis);
    }
  }
  return pose;
}

}  // namespace

Pose Mix(const Pose& a, const Pose& b, float weight) {
  return {glm::mix(a.position, b.position, weight), glm::slerp(a.rotation, b.rotation, weight)};
}

glm::mat4 ToMatrix(const Pose& pose) {
  glm::mat4 matrix = glm::mat4_cast(pose.rotation);
  matrix[3] = glm::vec4(pose.position, 1.0f);
  return matrix;
}

Pose Object::Held::now() const {
  if (time >= duration) {
    return to;
  }
  // Minimum jerk (Flash & Hogan, J. Neurosci. 5, 1985).
  const float t = time / duration;
  return Mix(from, to, t * t * t * (10.0f + t * (6.0f * t - 15.0f)));
}

ObjectState InitialState(const Object& object) {
  ObjectState state;
  state.stage_from_object = object.initial_pose;
  const std::vector<ObjectJoint>& joints = object.use().joints;
  for (size_t i = 0; i < joints.size(); ++i) {
    state.joints[i] = joints[i].rest;
  }
  return state;
}

Pose ObjectFromPart(const ObjectModel& model, std::span<const float> joints, int part) {
  Pose pose;
  for (int at = part; at >= 0; at = model.prop().parts[static_cast<size_t>(at)].parent) {
    pose = ParentFromPart(model, joints, static_cast<size_t>(at)) * pose;
  }
  return pose;
}

Pose ObjectFromGrip(const ObjectModel& model, std::span<const float> joints, int grip) {
  const Grip& of = model.use().grips[static_cast<size_t>(grip)];
  return ObjectFromPart(model, joints, of.part) * of.part_from_hand;
}

Pose ObjectFromSpot(
    const ObjectModel& model, std::span<const float> joints, int surface, int spot, float turn) {
  const Spot& of =
      model.use().surfaces[static_cast<size_t>(surface)].spots[static_cast<size_t>(spot)];
  const Pose turned = {glm::vec3(0.0f), glm::angleAxis(turn, glm::vec3(0.0f, 1.0f, 0.0f))};
  return ObjectFromPart(model, joints, of.part) * of.part_from_spot * turned;
}

Pose DrawnPose(const ObjectModel& model,
               const ObjectState& state,
               const glm::mat4& stage_from_holder,
               const human::GripFrame& holder_from_palm) {
  if (state.hand < 0 || state.in_hand <= 0.0f) {
    return state.stage_from_object;
  }
  const Pose stage_from_actor = {glm::vec3(stage_from_holder[3]),
                                 glm::normalize(glm::quat_cast(stage_from_holder))};
  const Pose palm = {holder_from_palm.position, holder_from_palm.rotation};
  const int grip = state.hands[static_cast<size_t>(state.hand)];
  const Pose in_palm =
      stage_from_actor * palm * ObjectFromGrip(model, state.joints, grip).Inverse();
  return Mix(state.stage_from_object, in_palm, state.in_hand);
}

void ComputeParts(const ObjectModel& model,
                  const ObjectState& state,
                  const Pose& stage_from_object,
                  std::span<glm::mat4> stage_from_part,
                  std::span<uint8_t> shown) {
  const std::vector<PropPart>& parts = model.prop().parts;
  CHECK(stage_from_part.size() == parts.size() && shown.size() == parts.size());
  const glm::mat4 stage = ToMatrix(stage_from_object);
  for (size_t i = 0; i < parts.size(); ++i) {
    const bool is_root = parts[i].parent == PropPart::kNoParent;
    const auto parent = static_cast<size_t>(parts[i].parent);
    stage_from_part[i] = (is_root ? stage : stage_from_part[parent]) *
                         ToMatrix(ParentFromPart(model, state.joints, i));
    shown[i] = is_root ? 1 : shown[parent];
    for (const ShownPart& part : model.use().shown) {
      if (static_cast<size_t>(part.part) == i && (part.states >> state.state & 1u) == 0) {
        shown[i] = 0;
      }
    }
  }
}

namespace {

bool Burns(const ObjectLight& light, const ObjectState& state) {
  return (light.states >> state.state & 1u) != 0;
}

// Level times flicker of one of the object's lights.
float BrightnessOf(const Object& object, const ObjectState& state, size_t light, double time) {
  const float flicker = object.use().lights[light].flicker;
  return state.light.level * light::Flicker(object.seed + light, time, flicker);
}

}  // namespace

void AddLamps(const Object& object,
              const ObjectState& state,
              const Pose& stage_from_object,
              double time,
              std::vector<light::Lamp>& lamps) {
  const std::vector<ObjectLight>& lights = object.use().lights;
  for (size_t i = 0; i < lights.size(); ++i) {
    const float brightness = BrightnessOf(object, state, i, time);
    if (!Burns(lights[i], state) || !(lights[i].intensity * brightness > 0.0f)) {
      continue;
    }
    const Pose stage_from_part =
        stage_from_object * ObjectFromPart(*object.model, state.joints, lights[i].part);
    const bool is_set = state.light.colour != glm::vec3(0.0f);
    const glm::vec3& colour = is_set ? state.light.colour : lights[i].colour;
    lamps.push_back({stage_from_part * lights[i].position,
                     lights[i].intensity * brightness * colour, lights[i].radius});
  }
}

float GlowOf(const Object& object, const ObjectState& state, double time) {
  const std::vector<ObjectLight>& lights = object.use().lights;
  float all = 0.0f;
  float glowing = 0.0f;
  for (size_t i = 0; i < lights.size(); ++i) {
    all += lights[i].intensity;
    if (Burns(lights[i], state)) {
      glowing += lights[i].intensity * BrightnessOf(object, state, i, time);
    }
  }
  return all > 0.0f ? glowing / all : 1.0f;
}

ObjectState Interpolate(const ObjectState& previous, const ObjectState& current, float alpha) {
  ObjectState mixed = current;
  const bool goes_on = previous.visible == current.visible &&
                       glm::distance(previous.stage_from_object.position,
                                     current.stage_from_object.position) < kObjectJump;
  if (!goes_on) {
    return mixed;
  }
  mixed.stage_from_object = Mix(previous.stage_from_object, current.stage_from_object, alpha);
  for (size_t i = 0; i < mixed.joints.size(); ++i) {
    mixed.joints[i] = glm::mix(previous.joints[i], current.joints[i], alpha);
  }
  if (previous.hand == current.hand) {
    mixed.in_hand = glm::mix(previous.in_hand, current.in_hand, alpha);
  }
  mixed.light.level = glm::mix(previous.light.level, current.light.level, alpha);
  if (previous.action == current.action && previous.action_time <= current.action_time) {
    mixed.action_time = glm::mix(previous.action_time, current.action_time, alpha);
  }
  return mixed;
}

}  // namespace lararium::stage
