// libFuzzer harness: reading any text as an object's use terminates. An accepted one keeps every
// promise of object_use.h and answers the stage's queries.

#include <cmath>
#include <glm/geometric.hpp>
#include <string_view>

#include "shared/core/check.h"
#include "shared/stage/object.h"

namespace lararium::stage {
namespace {

bool IsPossible(const Pose& pose) {
  return std::isfinite(glm::dot(pose.position, pose.position)) &&
         std::abs(glm::length(pose.rotation) - 1.0f) < 1e-3f;
}

bool IsHand(int grip, const ObjectUse& use) {
  return grip >= -1 && grip < static_cast<int>(use.grips.size());
}

void CheckAction(const ObjectAction& action, const ObjectUse& use) {
  CHECK(action.to >= -1 && action.to < static_cast<int>(use.states.size()));
  CHECK(IsHand(action.hands[0], use) && IsHand(action.hands[1], use));
  CHECK(std::isfinite(action.duration) && action.duration >= 0.0f);
  for (const ObjectAction::Move& move : action.moves) {
    CHECK(move.joint >= 0 && move.joint < static_cast<int>(use.joints.size()));
    CHECK(std::isfinite(move.to) && move.begin <= move.end);
  }
  for (size_t i = 0; i < action.path.size(); ++i) {
    CHECK(IsPossible(action.path[i].pose));
    CHECK(i == 0 || action.path[i - 1].time < action.path[i].time);
  }
  if (action.seat) {
    CHECK(!action.held);
    CHECK(std::isfinite(glm::length(action.seat->position) + action.seat->heading));
  }
}

void CheckUse(const ObjectUse& use, int parts) {
  for (const ObjectJoint& joint : use.joints) {
    CHECK(joint.part >= 0 && joint.part < parts);
    CHECK(std::abs(glm::length(joint.axis) - 1.0f) < 1e-3f);
    CHECK(joint.lower <= joint.rest && joint.rest <= joint.upper);
  }
  for (const Grip& grip : use.grips) {
    CHECK(grip.part >= -1 && grip.part < parts && IsPossible(grip.part_from_hand));
  }
  for (const Surface& surface : use.surfaces) {
    for (const Spot& spot : surface.spots) {
      CHECK(spot.part >= -1 && spot.part < parts && IsPossible(spot.part_from_spot));
      CHECK(spot.place >= -1 && spot.place < static_cast<int>(use.places.size()));
    }
  }
  for (const ObjectAction& action : use.actions) {
    CheckAction(action, use);
  }
  CHECK(!use.states.empty() && use.capacity >= 1);
}

}  // namespace
}  // namespace lararium::stage

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace lararium::stage;
  Prop prop;
  prop.parts.resize(2);
  prop.parts[0].name = "body";
  prop.parts[1].name = "lid";
  prop.parts[1].parent = 0;
  prop.use = std::string_view(reinterpret_cast<const char*>(data), size);
  const auto model = ObjectModel::Create(std::move(prop), "fuzz.object.json");
  if (model.ok()) {
    Object object;
    object.model = *model;
    CheckUse(object.use(), 2);
    const ObjectState state = InitialState(object);
    for (size_t grip = 0; grip < object.use().grips.size(); ++grip) {
      CHECK(IsPossible(ObjectFromGrip(**model, state.joints, static_cast<int>(grip))));
    }
  }
  return 0;
}
