#include "shared/stage/stage.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <numbers>

namespace lararium::stage {
namespace {

// A step this long in one tick is no motion but a change of place: 30 m/s.
constexpr float kJump = 0.25f;

float MixAngles(float a, float b, float alpha) {
  const float turn = std::remainder(b - a, 2.0f * std::numbers::pi_v<float>);
  return a + alpha * turn;
}

Animation Mix(const Animation& a, const Animation& b, float alpha) {
  const bool continues =
      a.clip == b.clip && a.previous_clip == b.previous_clip && a.clip_time <= b.clip_time;
  if (!continues) {
    return b;
  }
  Animation mixed = b;
  mixed.clip_time = a.clip_time + alpha * (b.clip_time - a.clip_time);
  mixed.previous_time = a.previous_time + alpha * (b.previous_time - a.previous_time);
  mixed.weight = glm::mix(a.weight, b.weight, alpha);
  return mixed;
}

ActorState Mix(const ActorState& a, const ActorState& b, float alpha) {
  ActorState mixed = b;
  if (a.visible == b.visible && glm::distance(a.position, b.position) < kJump) {
    mixed.position = glm::mix(a.position, b.position, alpha);
    mixed.heading = MixAngles(a.heading, b.heading, alpha);
    mixed.animation = Mix(a.animation, b.animation, alpha);
  }
  return mixed;
}

void SamplePose(const human::Human& human,
                int clip,
                double time,
                std::span<human::JointTransform> pose) {
  if (clip == Animation::kNoClip) {
    std::copy(human.skeleton.rest.begin(), human.skeleton.rest.end(), pose.begin());
    return;
  }
  CHECK(clip >= 0 && static_cast<size_t>(clip) < human.clips.size());
  human::SampleClip(human.clips[static_cast<size_t>(clip)], time, pose);
}

}  // namespace

void StartClip(Animation& animation, int clip, double rate, float fade_seconds) {
  animation.previous_clip = animation.clip;
  animation.previous_time = animation.clip_time;
  animation.previous_rate = animation.rate;
  animation.clip = clip;
  animation.clip_time = 0.0;
  animation.rate = rate;
  const bool fades = fade_seconds > 0.0f;
  animation.weight = fades ? 0.0f : 1.0f;
  animation.weight_per_second = fades ? 1.0f / fade_seconds : 0.0f;
}

Result<ActorId> Stage::Add(std::string name, std::shared_ptr<const human::Human> human) {
  CHECK(human != nullptr);
  if (Find(name).has_value()) {
    return Status::Error("stage", "two actors are called '" + name + "'", "rename one of them");
  }
  const ActorId id = actors_.Add({std::move(name), std::move(human), ActorState()});
  order_ = actors_.ids();
  return id;
}

bool Stage::Remove(ActorId id) {
  const bool removed = actors_.Remove(id);
  order_ = actors_.ids();
  return removed;
}

std::optional<ActorId> Stage::Find(std::string_view name) const {
  const auto found = std::find_if(order_.begin(), order_.end(),
                                  [&](ActorId id) { return actors_.Find(id)->name == name; });
  return found == order_.end() ? std::nullopt : std::optional(*found);
}

void Stage::Advance(double seconds) {
  for (const ActorId id : order_) {
    Animation& animation = actors_.Find(id)->state.animation;
    if (animation.clip == Animation::kNoClip) {
      continue;
    }
    animation.clip_time += seconds * animation.rate;
    if (animation.weight < 1.0f) {
      animation.previous_time += seconds * animation.previous_rate;
      const float step = static_cast<float>(seconds) * animation.weight_per_second;
      animation.weight = std::min(1.0f, animation.weight + step);
    }
  }
}

void Stage::Reset() {
  for (const ActorId id : order_) {
    actors_.Find(id)->state = ActorState();
  }
}

void Stage::Capture(StageSnapshot& snapshot) const {
  snapshot.actors.clear();
  for (const ActorId id : order_) {
    snapshot.actors.push_back({id, actors_.Find(id)->state});
  }
}

void Interpolate(const StageSnapshot& previous,
                 const StageSnapshot& current,
                 float alpha,
                 StageSnapshot& result) {
  result.actors.clear();
  auto before = previous.actors.begin();  // both lists are in the order of slots
  for (const StageSnapshot::Entry& now : current.actors) {
    while (before != previous.actors.end() && before->actor.index < now.actor.index) {
      ++before;
    }
    const bool known = before != previous.actors.end() && before->actor == now.actor;
    result.actors.push_back({now.actor, known ? Mix(before->state, now.state, alpha) : now.state});
  }
}

glm::mat4 StageFromActor(const ActorState& state) {
  const glm::mat4 moved = glm::translate(glm::mat4(1.0f), state.position);
  return glm::rotate(moved, state.heading, glm::vec3(0.0f, 1.0f, 0.0f));
}

Poser::Poser(std::shared_ptr<const human::Human> human) : human_(std::move(human)) {
  const size_t joints = human_->skeleton.size();
  pose_.resize(joints);
  faded_in_.resize(joints);
  actor_from_joint_.resize(joints, glm::mat4(1.0f));
  skin_.resize(joints, glm::mat4(1.0f));
}

void Poser::Pose(const Animation& animation) {
  if (animation.weight < 1.0f) {
    SamplePose(*human_, animation.previous_clip, animation.previous_time, pose_);
    SamplePose(*human_, animation.clip, animation.clip_time, faded_in_);
    human::BlendPose(pose_, faded_in_, animation.weight);
  } else {
    SamplePose(*human_, animation.clip, animation.clip_time, pose_);
  }
  human::ComputeActorFromJoint(human_->skeleton, pose_, actor_from_joint_);
  human::ComputeSkinMatrices(human_->skeleton, actor_from_joint_, skin_);
}

}  // namespace lararium::stage
