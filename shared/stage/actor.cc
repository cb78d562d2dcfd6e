#include "shared/stage/actor.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <numbers>

namespace lararium::stage {
namespace {

// Metres in one tick. A longer step (30 m/s) is a jump, which must not be interpolated.
constexpr float kJump = human::kTeleport;

}  // namespace

glm::mat4 StageFromActor(const ActorState& state) {
  const glm::mat4 moved = glm::translate(glm::mat4(1.0f), state.position);
  return glm::rotate(moved, state.heading, glm::vec3(0.0f, 1.0f, 0.0f));
}

Pose StageFromActorPose(const ActorState& state) {
  return {state.position, glm::angleAxis(state.heading, glm::vec3(0.0f, 1.0f, 0.0f))};
}

Pose StageFromUpperBody(const Actor& actor) {
  return StageFromActorPose(actor.state) *
         Pose{human::HipsShift(actor.model->sitting, actor.state.animation_state.sitting)};
}

glm::vec2 Direction(float heading) { return {-std::sin(heading), -std::cos(heading)}; }

float HeadingOf(glm::vec2 direction) { return std::atan2(-direction.x, -direction.y); }

float TurnBetween(float from, float to) {
  return std::remainder(to - from, 2.0f * std::numbers::pi_v<float>);
}

ActorState Interpolate(const ActorState& previous, const ActorState& current, float alpha) {
  const bool goes_on = previous.visible == current.visible &&
                       glm::distance(previous.position, current.position) < kJump;
  if (!goes_on) {
    return current;
  }
  ActorState mixed = current;
  mixed.position = glm::mix(previous.position, current.position, alpha);
  mixed.heading = previous.heading + alpha * TurnBetween(previous.heading, current.heading);
  mixed.animation_state =
      human::Interpolate(previous.animation_state, current.animation_state, alpha);
  return mixed;
}

int FindClip(const human::Human& human, std::string_view name) {
  const auto found = std::find_if(human.clips.begin(), human.clips.end(),
                                  [name](const human::Clip& clip) { return clip.name == name; });
  return found == human.clips.end() ? human::Animation::kNoClip
                                    : static_cast<int>(found - human.clips.begin());
}

}  // namespace lararium::stage
