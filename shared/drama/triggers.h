#pragma once

// What a drama waits for: something that the visitor does, a moment of its timeline.
// Plain values, brought up to date once in a tick; each counts how often it fired.

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "shared/drama/visitor.h"
#include "shared/stage/stage.h"

namespace lararium::drama {

struct TriggerSpec {
  enum class Kind : uint8_t {
    kNear,       // comes within `metres`; again once it was further than `leave`
    kLeaves,     // goes further than `leave`, having been within `metres`
    kLooksAt,    // looks within `angle` of it for `seconds`; again once it looked elsewhere
    kLooksAway,  // having looked at it, looks elsewhere for `seconds`
    kStays,      // moves no further than `metres` for `seconds`; with a target: from that
    kTimeout,    // `seconds` have passed; once
    kLost,       // tracking is lost, for `seconds` already
    kBack,       // tracking is back
    kKey,        // the key `text` is pressed
    kClock,      // it is `seconds` of the day, where the visitor is
    kMarker,     // the timeline passes the marker `text`
    kMessage,    // the message `text` comes: its address, or with its first arguments
  };
  static constexpr int kKinds = 12;
  enum class Target : uint8_t { kNone, kActor, kObject, kPoint };

  Kind kind = Kind::kTimeout;
  Target target = Target::kNone;
  stage::ActorId actor;
  stage::ObjectId object;
  glm::vec3 point = glm::vec3(0.0f);  // stage
  float metres = 0.0f;
  float leave = 0.0f;  // at least metres: between the two nothing changes
  float angle = 0.0f;  // radians
  float seconds = 0.0f;
  std::string text;

  Status Validate() const;
};

struct Trigger {
  int64_t id = 0;
  TriggerSpec spec;
  size_t cue = 0;     // its place in CueLog::cues
  int64_t fired = 0;  // how often
  // Of its kind: near enough, looking, on the other side of an hour.
  bool on = false;
  float held = 0.0f;                 // seconds that it has been so
  glm::vec3 from = glm::vec3(0.0f);  // where the visitor came to a stand
};

// What happens in a tick, for triggers.
struct Happenings {
  const stage::Stage& stage;
  const Visitor& visitor;
  float lost_seconds = 0.0f;                // since when tracking is lost
  const std::vector<std::string>& markers;  // that the timeline passes
  float passed = 0.0f;                      // seconds since the moment before
};

void UpdateTrigger(const Happenings& now, Trigger& trigger);

// Metres on the floor between the visitor and a trigger's target; none: the target is
// not there.
std::optional<float> DistanceTo(const stage::Stage& stage,
                                const TriggerSpec& spec,
                                const glm::vec3& visitor);

}  // namespace lararium::drama
