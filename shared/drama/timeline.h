#pragma once

// The declarative part of a drama as it is played: items of lanes, begun when their time
// has come. What it remembers are plain values, so that seeking need not play it.

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "shared/drama/drama.h"
#include "shared/drama/timeline_lanes.h"
#include "shared/drama/track.h"
#include "shared/human/face.h"
#include "shared/stage/stage.h"

namespace lararium::drama {

// What an item of a lane tells its actor. Which members count depends on the lane.
struct Cue {
  enum class Act : uint8_t { kNone, kWalk, kHide, kUse, kTake, kPut, kGive, kStand };

  double at = 0.0;      // seconds of the drama
  double length = 0.0;  // seconds; 0: as long as it takes
  std::string id;       // for messages
  Act act = Act::kNone;
  int index = -1;  // the clip, the speech or the expression
  human::BodyPart part = human::BodyPart::kUpper;
  float value = 0.0f;  // metres per second, or the intensity
  float fade = 0.0f;   // seconds
  Ease ease = Ease::kLinear;
  std::string name;  // of the action, the surface or the marker
  stage::ObjectId object;
  stage::ObjectId other;  // on which it is put
  stage::ActorId partner;
  bool places = false;  // at `from` first
  glm::vec3 from = glm::vec3(0.0f);
  float from_heading = 0.0f;
  glm::vec3 to = glm::vec3(0.0f);
  std::optional<float> heading;  // radians
  stage::Attention::Choice gaze;
};

struct CueLane {
  LaneKind kind = LaneKind::kMarkers;
  stage::ActorId actor;   // zero: the stage's
  std::string where;      // "drama.lua:12"
  std::vector<Cue> cues;  // `at` increases
};

struct Timeline {
  std::vector<Track> tracks;  // of actors who are led
  std::vector<CueLane> lanes;
};

// How far a timeline has been played.
struct TimelineState {
  struct Pending {
    stage::TaskId task = 0;
    size_t cue = 0;
    double began = 0.0;
  };
  struct Lane {
    size_t next = 0;               // cue that has not begun
    std::optional<double> ends;    // when what the last one set is set back
    std::vector<Pending> pending;  // tasks that are not over
  };
  std::vector<Lane> lanes;
};

// Plays a timeline on a stage, tick by tick.
class TimelinePlayer {
 public:
  using OnTask = std::function<void(TaskRecord)>;
  using OnProblem = std::function<void(std::string)>;

  // Borrows all of it.
  TimelinePlayer(stage::Stage& stage, OnTask on_task, OnProblem on_problem)
      : stage_(stage), on_task_(std::move(on_task)), on_problem_(std::move(on_problem)) {}

  // Begins and ends what is due at a time that is not before the last one. passed: gets
  // the names of the markers that it passes.
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
