#pragma once

// Triggers: conditions that a drama waits for, such as an action of the visitor or a marker of its
// timeline. Plain values, updated once per tick; each counts how often it fired.

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
    // Where there are several visitors, a condition holds if it holds for any of them.
    kNear,       // The visitor comes within `metres`; fires again after going beyond `leave`.
    kLeaves,     // The visitor goes beyond `leave` after having been within `metres`.
    kLooksAt,    // The visitor looks within `angle` of the target for `seconds`; fires again after
                 // looking away.
    kLooksAway,  // The visitor looks elsewhere for `seconds` after having looked at the target.
    kStays,    // The visitor moves at most `metres` for `seconds`, or stays within `metres` of the
               // target.
    kTimeout,  // `seconds` have passed; fires once.
    kLost,     // Tracking has been lost for `seconds`.
    kBack,     // Tracking is back.
    kKey,      // The key `text` is pressed.
    kClock,    // The local time of day is `seconds`.
    kMarker,   // The timeline passes the marker `text`.
    kMessage,  // A message arrives whose address, or address and first arguments, are `text`.
  };
  static constexpr int kKinds = 12;
  enum class Target : uint8_t { kNone, kActor, kObject, kPoint };

  Kind kind = Kind::kTimeout;
  Target target = Target::kNone;
  stage::ActorId actor;
  stage::ObjectId object;
  glm::vec3 point = glm::vec3(0.0f);  // Stage frame.
  float metres = 0.0f;
  float leave = 0.0f;  // Metres, at least `metres`: hysteresis.
  float angle = 0.0f;  // Radians.
  float seconds = 0.0f;
  std::string text;

  Status Validate() const;
};

struct Trigger {
  int64_t id = 0;
  TriggerSpec spec;
  size_t cue = 0;     // Index into CueLog::cues.
  int64_t fired = 0;  // Number of times that it fired.
  // State that depends on the kind, such as near, looking, or past the hour.
  bool on = false;
  float held = 0.0f;  // Seconds that the state has lasted.

  // kStays: where each visitor stopped, and for how long that one has stayed.
  struct Stay {
    int number = 0;  // GroupVisitor::number
    glm::vec3 from = glm::vec3(0.0f);
    float held = 0.0f;  // Seconds.
    bool fired = false;
  };
  std::vector<Stay> stays;
};

// Input of UpdateTrigger() in one tick.
struct TriggerContext {
  const stage::Stage& stage;
  const Visitor& visitor;
  float lost_seconds = 0.0f;                // Seconds since tracking was lost.
  const std::vector<std::string>& markers;  // Markers that the timeline passes in this tick.
  float passed = 0.0f;                      // Seconds since the tick before.
};

void UpdateTrigger(const TriggerContext& now, Trigger& trigger);

// Distance on the floor between a trigger's target and the nearest visitor who is tracked, metres;
// none: there is no such visitor, or the target is not there.
std::optional<float> DistanceTo(const stage::Stage& stage,
                                const TriggerSpec& spec,
                                const Visitor& visitor);

}  // namespace lararium::drama
