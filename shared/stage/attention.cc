#include "shared/stage/attention.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace lararium::stage {
namespace {

using Target = Attention::Target;
using Choice = Attention::Choice;

constexpr float kNotice = 5.0f;     // Metres; others are noticed up to this distance.
constexpr float kInView = 1.4f;     // Half angle of the field of view, radians.
constexpr float kListenFor = 8.0f;  // Metres; speech attracts attention up to this distance.
constexpr size_t kMaxPeople = 64;

glm::vec3 EyesOf(const Actor& actor) { return StageFromUpperBody(actor) * actor.model->gaze.eyes; }

// Whether a point lies in front of the actor and nearer than `within` metres.
bool IsInView(const Actor& actor, const glm::vec3& point, float within) {
  const glm::vec2 way = glm::vec2(point.x, point.z) - actor.place();
  return glm::length(way) < within &&
         std::abs(TurnBetween(actor.state.heading, HeadingOf(way))) < kInView;
}

// The nearest actor who speaks within hearing distance; none: an empty id.
ActorId SpeakerFor(const World& world, ActorId listener) {
  ActorId nearest;
  float distance = kListenFor;
  const Actor& actor = *world.actors.Find(listener);
  for (const ActorId id : world.actor_ids) {
    const Actor& other = *world.actors.Find(id);
    const float away = glm::distance(other.place(), actor.place());
    if (id != listener && other.state.visible && other.state.utterance.speaking &&
        away < distance) {
      nearest = id;
      distance = away;
    }
  }
  return nearest;
}

// Draws a random target for a few seconds: an actor in view, the visitor, or nothing. Nearer actors
// are more likely.
Choice Choose(const World& world, ActorId id, Random& random) {
  const Actor& actor = *world.actors.Find(id);
  std::array<Choice, kMaxPeople> choices;
  std::array<float, kMaxPeople> weights;
  size_t count = 0;
  float total = 0.0f;
  const auto add = [&](const Choice& choice, float weight) {
    if (count < kMaxPeople) {
      choices[count] = choice;
      weights[count++] = weight;
      total += weight;
    }
  };
  add({}, actor.state.utterance.speaking ? 0.3f : 1.0f);
  for (const ActorId other_id : world.actor_ids) {
    const Actor& other = *world.actors.Find(other_id);
    if (other_id != id && other.state.visible && IsInView(actor, EyesOf(other), kNotice)) {
      const float away = glm::distance(other.place(), actor.place());
      add({Target::kActor, {}, other_id, {}}, 2.0f / (1.0f + away));
    }
  }
  const std::optional<glm::vec3> visitor = world.VisitorFor(id);
  if (visitor && IsInView(actor, *visitor, kNotice)) {
    add({Target::kVisitor, {}, {}, {}}, 0.8f);
  }
  auto chance = static_cast<float>(random.Uniform()) * total;
  for (size_t i = 0; i < count; ++i) {
    chance -= weights[i];
    if (chance < 0.0f) {
      return choices[i];
    }
  }
  return {};
}

Choice Decide(const World& world, const Tasks& tasks, ActorId id, Actor& actor, float seconds) {
  Attention& attention = actor.attention;
  if (attention.told) {
    return *attention.told;
  }
  if (!attention.automatic) {
    return {};
  }
  if (const auto object = tasks.ObjectOf(id)) {
    return {Target::kObject, {}, {}, *object};
  }
  if (actor.walk.phase == Walk::Phase::kGo) {
    return {};  // Looks where it walks.
  }
  if (!actor.state.utterance.speaking) {
    if (const ActorId speaker = SpeakerFor(world, id)) {
      return {Target::kActor, {}, speaker, {}};
    }
  }
  attention.seconds_left -= seconds;
  if (attention.seconds_left <= 0.0f) {
    attention.chosen = Choose(world, id, attention.random);
    attention.seconds_left = static_cast<float>(attention.random.Uniform(1.5, 6.0));
  }
  return attention.chosen;
}

void LookAt(const World& world, ActorId id, const Choice& choice, human::Gaze& gaze) {
  gaze.kind = human::GazeKind::kNothing;
  if (choice.target == Target::kPoint) {
    gaze.kind = human::GazeKind::kObject;
    gaze.target = choice.point;
  } else if (choice.target == Target::kVisitor && !world.visitors.empty()) {
    gaze.kind = human::GazeKind::kPerson;
    gaze.target = *world.VisitorFor(id);
  } else if (choice.target == Target::kActor) {
    const Actor* other = world.actors.Find(choice.actor);
    if (other != nullptr && other->state.visible) {
      gaze.kind = human::GazeKind::kPerson;
      gaze.target = EyesOf(*other);
    }
  } else if (choice.target == Target::kObject) {
    const Object* object = world.objects.Find(choice.object);
    if (object != nullptr && object->state.visible) {
      gaze.kind = human::GazeKind::kObject;
      gaze.target = object->state.stage_from_object * object->model->centre();
    }
  }
}

}  // namespace

void DirectAttention(World& world, const Tasks& tasks, float seconds) {
  for (const ActorId id : world.actor_ids) {
    Actor& actor = world.actor(id);
    if (!actor.state.visible) {
      continue;
    }
    human::Gaze& gaze = actor.state.animation_state.gaze;
    LookAt(world, id, Decide(world, tasks, id, actor, seconds), gaze);
    gaze.speaking = actor.state.utterance.speaking;
  }
}

}  // namespace lararium::stage
