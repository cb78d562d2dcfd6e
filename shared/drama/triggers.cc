#include "shared/drama/triggers.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string_view>

namespace lararium::drama {
namespace {

using TriggerKind = TriggerSpec::Kind;

constexpr float kLookAwayShare =
    1.3f;                        // Share of the angle; hysteresis between looking and looking away.
constexpr float kGlance = 0.3f;  // Seconds; shorter looks elsewhere are ignored.

// A vertical line that represents a target; for a person, from the knees to the eyes.
struct Upright {
  glm::vec3 low;
  glm::vec3 high;
};

std::optional<Upright> UprightOf(const stage::Stage& stage, const TriggerSpec& spec) {
  switch (spec.target) {
    case TriggerSpec::Target::kActor: {
      const stage::Actor* actor = stage.Find(spec.actor);
      if (actor == nullptr || !actor->state.visible) {
        return std::nullopt;
      }
      const glm::vec3& feet = actor->state.position;
      const float eyes = actor->eye_height();
      return Upright{feet + glm::vec3(0.0f, 0.3f * eyes, 0.0f), feet + glm::vec3(0.0f, eyes, 0.0f)};
    }
    case TriggerSpec::Target::kObject: {
      const stage::Object* object = stage.Find(spec.object);
      if (object == nullptr || !object->state.visible) {
        return std::nullopt;
      }
      const glm::vec3& at = object->state.stage_from_object.position;
      return Upright{at, at};
    }
    case TriggerSpec::Target::kPoint:
      return Upright{spec.point, spec.point};
    default:
      return std::nullopt;
  }
}

float FloorDistance(const glm::vec3& a, const glm::vec3& b) {
  return std::hypot(a.x - b.x, a.z - b.z);
}

// The smallest angle between a visitor's viewing direction and a target, radians.
std::optional<float> AngleTo(const TriggerContext& now, const TriggerSpec& spec) {
  const auto upright = UprightOf(now.stage, spec);
  if (!upright) {
    return std::nullopt;
  }
  constexpr int kSamples = 8;
  std::optional<float> best;  // Cosine of the smallest angle.
  ForEachTracked(now.visitor, [&](const GroupVisitor& visitor) {
    for (int i = 0; i <= kSamples; ++i) {
      const float share = static_cast<float>(i) / kSamples;
      const glm::vec3 way =
          (1.0f - share) * upright->low + share * upright->high - visitor.position;
      const float length = glm::length(way);
      best = length > 1e-4f
                 ? std::max(best.value_or(-1.0f), glm::dot(way, visitor.direction) / length)
                 : 1.0f;
    }
  });
  return best ? std::optional(std::acos(std::clamp(*best, -1.0f, 1.0f))) : std::nullopt;
}

void Fire(Trigger& trigger) { ++trigger.fired; }

void UpdateNear(const TriggerContext& now, Trigger& trigger) {
  const auto distance = DistanceTo(now.stage, trigger.spec, now.visitor);
  if (!distance) {
    return;
  }
  const bool was_near = trigger.on;
  trigger.on = *distance < trigger.spec.metres || (was_near && *distance <= trigger.spec.leave);
  if (trigger.on != was_near && trigger.on == (trigger.spec.kind == TriggerKind::kNear)) {
    Fire(trigger);
  }
}

// `on`: the visitor looks at the target. `held`: seconds for which the opposite of `on` has been
// true.
void UpdateLook(const TriggerContext& now, Trigger& trigger) {
  const auto angle = AngleTo(now, trigger.spec);
  if (!angle) {
    return;
  }
  const bool fires_on_look = trigger.spec.kind == TriggerKind::kLooksAt;
  const float limit = trigger.on ? kLookAwayShare * trigger.spec.angle : trigger.spec.angle;
  const bool looks = *angle <= limit;
  trigger.held = looks != trigger.on ? trigger.held + now.passed : 0.0f;
  const float needed = trigger.on == fires_on_look ? kGlance : trigger.spec.seconds;
  if (looks != trigger.on && trigger.held >= needed) {
    trigger.on = looks;
    trigger.held = 0.0f;
    if (looks == fires_on_look) {
      Fire(trigger);
    }
  }
}

Trigger::Stay& StayOf(Trigger& trigger, int number, const glm::vec3& position) {
  const auto found = std::find_if(trigger.stays.begin(), trigger.stays.end(),
                                  [&](const Trigger::Stay& stay) { return stay.number == number; });
  if (found != trigger.stays.end()) {
    return *found;
  }
  trigger.stays.push_back({number, position});
  return trigger.stays.back();
}

void UpdateStay(const TriggerContext& now, Trigger& trigger) {
  const TriggerSpec& spec = trigger.spec;
  const bool has_target = spec.target != TriggerSpec::Target::kNone;
  const auto upright = UprightOf(now.stage, spec);
  ForEachTracked(now.visitor, [&](const GroupVisitor& visitor) {
    Trigger::Stay& stay = StayOf(trigger, visitor.number, visitor.position);
    const bool stays = has_target
                           ? upright && FloorDistance(upright->low, visitor.position) < spec.metres
                           : FloorDistance(stay.from, visitor.position) < spec.metres;
    if (!stays) {
      stay = {visitor.number, visitor.position};
      return;
    }
    stay.held += now.passed;
    if (!stay.fired && stay.held >= spec.seconds) {
      stay.fired = true;
      Fire(trigger);
    }
  });
}

void UpdateTimeout(const TriggerContext& now, Trigger& trigger) {
  trigger.held += now.passed;
  if (!trigger.on && trigger.held >= trigger.spec.seconds - 0.5f * now.passed) {
    trigger.on = true;
    Fire(trigger);
  }
}

bool HasKey(std::string_view keys, std::string_view key) {
  for (std::string_view word = TakeKey(keys); !word.empty(); word = TakeKey(keys)) {
    if (word == key) {
      return true;
    }
  }
  return false;
}

// Counts the messages that match. Only whole arguments match: the requested text must end where an
// argument of the message ends.
int64_t CountMessages(std::string_view keys, std::string_view asked) {
  int64_t count = 0;
  for (std::string_view word = TakeKey(keys); !word.empty(); word = TakeKey(keys)) {
    const bool begins = word.starts_with('/') && word.starts_with(asked);
    count += begins && (word.size() == asked.size() || word[asked.size()] == ',') ? 1 : 0;
  }
  return count;
}

// kLost fires when tracking has been lost for `seconds`; kBack fires when it returns after that.
void UpdateTracking(const TriggerContext& now, Trigger& trigger) {
  const bool was_lost = trigger.on;
  trigger.on = !now.visitor.tracked && now.lost_seconds >= trigger.spec.seconds;
  if (trigger.on != was_lost && trigger.on == (trigger.spec.kind == TriggerKind::kLost)) {
    Fire(trigger);
  }
}

void UpdateClock(const TriggerContext& now, Trigger& trigger) {
  if (now.visitor.hour < 0.0f) {
    return;
  }
  // The half day after the hour counts as after it. `held`: whether the time was ever before the
  // hour.
  const float behind = std::remainder(now.visitor.hour - trigger.spec.seconds / 3600.0f, 24.0f);
  const bool was_before = trigger.held > 0.0f && !trigger.on;
  trigger.on = behind >= 0.0f;
  trigger.held = 1.0f;
  if (trigger.on && was_before) {
    Fire(trigger);
  }
}

}  // namespace

Status TriggerSpec::Validate() const {
  const auto within = [](float value, float low, float high) {
    return value >= low && value <= high;
  };
  if (!within(metres, 0.0f, 1000.0f) || !within(leave, 0.0f, 10000.0f) ||
      !within(angle, 0.0f, 3.2f) || !within(seconds, 0.0f, 86400.0f)) {
    return Status::Error("trigger", "a distance, an angle or a time is out of range");
  }
  const bool has_target = target != Target::kNone;
  const bool needs_target = kind == TriggerKind::kNear || kind == TriggerKind::kLeaves ||
                            kind == TriggerKind::kLooksAt || kind == TriggerKind::kLooksAway;
  if (needs_target && !has_target) {
    return Status::Error("trigger", "name an actor, an object or a point");
  }
  return Status();
}

std::optional<float> DistanceTo(const stage::Stage& stage,
                                const TriggerSpec& spec,
                                const Visitor& visitor) {
  std::optional<float> nearest;
  if (const auto upright = UprightOf(stage, spec)) {
    ForEachTracked(visitor, [&](const GroupVisitor& one) {
      const float distance = FloorDistance(upright->low, one.position);
      nearest = std::min(nearest.value_or(distance), distance);
    });
  }
  return nearest;
}

void UpdateTrigger(const TriggerContext& now, Trigger& trigger) {
  switch (trigger.spec.kind) {
    case TriggerKind::kNear:
    case TriggerKind::kLeaves:
      return UpdateNear(now, trigger);
    case TriggerKind::kLooksAt:
    case TriggerKind::kLooksAway:
      return UpdateLook(now, trigger);
    case TriggerKind::kStays:
      return UpdateStay(now, trigger);
    case TriggerKind::kTimeout:
      return UpdateTimeout(now, trigger);
    case TriggerKind::kLost:
    case TriggerKind::kBack:
      return UpdateTracking(now, trigger);
    case TriggerKind::kKey:
      if (HasKey(now.visitor.keys, trigger.spec.text)) {
        Fire(trigger);
      }
      return;
    case TriggerKind::kClock:
      return UpdateClock(now, trigger);
    case TriggerKind::kMarker:
      trigger.fired += std::count(now.markers.begin(), now.markers.end(), trigger.spec.text);
      return;
    case TriggerKind::kMessage:
      trigger.fired += CountMessages(now.visitor.keys, trigger.spec.text);
      return;
  }
}

}  // namespace lararium::drama
