#pragma once

// Playback of the declarative part of a drama: the items of its lanes start when their time has
// come. Its state is plain values, so seeking can restore it.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "shared/drama/drama.h"
#include "shared/drama/timeline_lanes.h"
#include "shared/drama/track.h"
#include "shared/human/face.h"
#include "shared/stage/stage.h"

namespace lararium::drama {

// One item of a lane. Which members are used depends on the kind of the lane.
struct Cue {
  enum class Act : uint8_t { kNone, kWalk, kHide, kUse, kTake, kPut, kGive, kStand };

  double at = 0.0;      // Time of the drama, seconds.
  double length = 0.0;  // Seconds; 0: as long as the action takes.
  std::string id;       // Used in messages.
  Act act = Act::kNone;
  int index = -1;  // Index of the clip, the speech or the expression.
  human::BodyPart part = human::BodyPart::kUpper;
  float value = 0.0f;  // Walking speed (m/s) or intensity of an expression.
  float fade = 0.0f;   // Seconds.
  Ease ease = Ease::kLinear;
  std::string name;  // Name of the action, the surface or the marker.
  stage::ObjectId object;
  stage::ObjectId other;  // kPut: the object to put it on.
  stage::ActorId partner;
  bool places = false;  // Place the actor at `from` first.
  glm::vec3 from = glm::vec3(0.0f);
  float from_heading = 0.0f;
  glm::vec3 to = glm::vec3(0.0f);
  std::optional<float> heading;  // Radians.
  stage::Attention::Choice gaze;
};

struct CueLane {
  LaneKind kind = LaneKind::kMarkers;
  stage::ActorId actor;   // Zero: a lane of the stage.
  std::string where;      // "drama.lua:12"
  std::vector<Cue> cues;  // Sorted by `at`.
};

struct Timeline {
  std::vector<Track> tracks;  // One for each actor that is led by a track.
  std::vector<CueLane> lanes;
};

// Playback state of a timeline.
struct TimelineState {
  struct Pending {
    stage::TaskId task = 0;
    size_t cue = 0;
    double began = 0.0;
  };
  struct Lane {
    size_t next = 0;               // Index of the next cue to start.
    std::optional<double> ends;    // Time at which the effect of the last cue ends.
    std::vector<Pending> pending;  // Tasks that are not over.
  };
  std::vector<Lane> lanes;
};

// Plays a timeline on a stage, tick by tick.
class TimelinePlayer {
 public:
  using OnTask = std::function<void(TaskRecord)>;
  using OnProblem = std::function<void(std::string)>;

  // Borrows the stage.
  TimelinePlayer(stage::Stage& stage, OnTask on_task, OnProblem on_problem)
      : stage_(stage), on_task_(std::move(on_task)), on_problem_(std::move(on_problem)) {}

  // Starts and ends the items that are due. Times must not decrease. Appends the names of passed
  // markers to `passed`.
  void Advance(const Timeline& timeline,
               double time,
               TimelineState& state,
               std::vector<std::string>& passed);

 private:
  void Begin(const CueLane& lane, size_t cue, double time, TimelineState::Lane& state);
  void End(const CueLane& lane, TimelineState::Lane& state);
  void Follow(const CueLane& lane, double time, TimelineState::Lane& state);
  Result<stage::TaskId> BeginTask(const CueLane& lane, const Cue& cue);
  Result<stage::TaskId> Put(const CueLane& lane, const Cue& cue);
  TaskRecord RecordOf(const CueLane& lane, const Cue& cue, double began, double ended) const;
  void Fail(const CueLane& lane, const Cue& cue, double began, double time, std::string problem);

  stage::Stage& stage_;
  OnTask on_task_;
  OnProblem on_problem_;
};

}  // namespace lararium::drama
