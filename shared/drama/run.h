#pragma once

// One run of a script from its beginning: the Lua state, its coroutines, and the host functions
// that lua/std calls. Internal to shared/drama.

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/embedded_text.h"
#include "shared/core/status.h"
#include "shared/drama/drama.h"
#include "shared/drama/recording.h"
#include "shared/drama/sandbox.h"
#include "shared/drama/scheduler.h"
#include "shared/drama/sync_points.h"
#include "shared/drama/timeline.h"
#include "shared/drama/track.h"
#include "shared/drama/triggers.h"
#include "shared/drama/visitor.h"
#include "shared/stage/stage.h"

namespace lararium::drama {

// Ticks at which the first action of a coroutine reaches its synchronisation points.
struct SyncRecord {
  Scheduler::TaskId coroutine = 0;
  stage::TaskId task = 0;  // Task of the stage that determines the ticks; 0: they are known.
  std::array<int64_t, stage::kSyncPoints> ticks = {};  // kUnknown: not reached yet.
  static constexpr int64_t kUnknown = -1;
};

// The complete state of a run except its coroutines. Plain values.
struct RunState {
  TimelineState timeline;
  std::vector<Trigger> triggers;
  int64_t last_trigger = 0;
  std::vector<SyncRecord> sync;
  Visitor visitor;
  // Arguments of the last message of each address, in the form of Message::arguments.
  std::map<std::string, std::string, std::less<>> heard;
  int64_t lost_ticks = 0;  // Ticks since tracking was lost.
};

// The triggers that a script has armed, and whether they fired.
struct CueLog {
  static constexpr size_t kMost = 1000;

  std::vector<CueRecord> cues;
  std::map<std::string, size_t, std::less<>> known;  // Indices into `cues`.

  // Index of a trigger in `cues`, added if it is new. kMost: the log is full.
  size_t Find(CueRecord cue);
};

// What a script declares while it loads. The same in every run.
struct Declared {
  Timeline timeline;
  DramaSettings settings;
};

// The private functions form the table `host` of lua/std and raise Lua errors. Functions that read
// or change anything but coroutines are recorded, and are not called while the script is replayed.
class Run {
 public:
  using OnError = std::function<void(int64_t tick, const LuaError&)>;
  using OnTask = std::function<void(TaskRecord)>;

  // Borrows stage, recording and cues.
  Run(std::unique_ptr<Sandbox> sandbox,
      stage::Stage& stage,
      Recording& recording,
      CueLog& cues,
      OnError on_error,
      OnTask on_task);
  Run(const Run&) = delete;  // Lua keeps its address.
  Run& operator=(const Run&) = delete;

  // Compiles the script and plays tick 0.
  Status Begin(std::string_view script, const std::string& where);
  void Tick(const Visitor& visitor);

  // Compiles the script for a replay by FollowTo(). `declared` is that of the recorded run.
  Status BeginAgain(std::string_view script,
                    const std::string& where,
                    std::shared_ptr<const Declared> declared);
  // Replays coroutines up to a position, without the stage. Returns false if they behave
  // differently; the position of the recording is then undefined.
  bool FollowTo(const Recording::Position& position);
  Recording::Position followed() const { return followed_; }

  const RunState& state() const { return state_; }
  // Sets state and tick, after the stage and the coroutines were brought to that tick.
  void Restore(const RunState& state, int64_t tick);

  std::shared_ptr<const Declared> declared() const { return declared_; }
  int64_t tick() const { return tick_; }

 private:
  Status LoadStd();
  Status StartChunk(std::string_view script, const std::string& where);
  void StartMain();
  void ApplyTracks();
  void UpdateTriggers();
  void HearMessages();
  void UpdateSync();

  // ---- the table `host`; arguments and results are documented at the definitions ----

  template <int (Run::*kMethod)(lua_State*)>
  static int Call(lua_State* lua);  // Records the call.
  template <int (Run::*kMethod)(lua_State*)>
  static int Own(lua_State* lua);  // Only coroutines and time: called again in a replay.
  void PushHost(lua_State* lua);

  // run.cc: time and tasks
  int PushTime(lua_State* lua);
  int Wait(lua_State* lua);
  int WaitUntilTime(lua_State* lua);
  int Start(lua_State* lua);
  int Stop(lua_State* lua);
  int Join(lua_State* lua);
  int Await(lua_State* lua);
  int AwaitPoint(lua_State* lua);
  int PushOutcome(lua_State* lua);
  int WarnAuthor(lua_State* lua);
  int Attempt(lua_State* lua);
  int NoteTask(lua_State* lua);
  int Configure(lua_State* lua);
  void NoteBlock(lua_State* lua, const stage::Actor& actor, std::string action, double seconds);
  void NoteSync(const SyncTimes& times);
  void NoteTaskSync(stage::TaskId task);
  SyncRecord* BeginSync();
  std::string PlaceNow(lua_State* lua) const;
  int64_t PointTick(Scheduler::TaskId id, SyncPoint point) const;

  // bindings_timeline.cc
  int AddSegment(lua_State* lua);
  int AddLane(lua_State* lua);
  std::vector<TrackSegment>& SegmentsOf(stage::ActorId id);
  Cue CheckItem(lua_State* lua, const CueLane& lane, int64_t index);
  Cue CheckCue(lua_State* lua, const CueLane& lane);
  void CheckMotion(lua_State* lua, Cue& cue);
  void CheckUse(lua_State* lua, Cue& cue);
  stage::ObjectId CheckObjectNamed(lua_State* lua, const char* key);
  stage::Attention::Choice CheckGaze(lua_State* lua);

  // bindings_visitor.cc
  TriggerSpec CheckTrigger(lua_State* lua, int argument);
  int AddTrigger(lua_State* lua);
  int DropTrigger(lua_State* lua);
  int PushFired(lua_State* lua);
  int PushHeard(lua_State* lua);
  int AwaitFired(lua_State* lua);
  int PushVisitor(lua_State* lua);
  int PushDistance(lua_State* lua);
  int PushAside(lua_State* lua);
  const Trigger* FindTrigger(int64_t id) const;

  // bindings_actor.cc: actors by themselves
  stage::ActorId CheckActorId(lua_State* lua, int argument);
  stage::Actor& CheckActor(lua_State* lua, int argument = 1);
  stage::Actor& CheckFreeActor(lua_State* lua, int argument = 1);
  int CheckClip(lua_State* lua, const stage::Actor& actor, int argument);
  int PushActor(lua_State* lua);
  int PushClip(lua_State* lua);
  int PushPlaying(lua_State* lua);
  int Play(lua_State* lua);
  int Gesture(lua_State* lua);
  int PushPose(lua_State* lua);
  int PlaceActor(lua_State* lua);
  int Show(lua_State* lua);
  int Look(lua_State* lua);
  int Attend(lua_State* lua);
  int Express(lua_State* lua);
  int Say(lua_State* lua);
  int SetGait(lua_State* lua);
  int Foretell(lua_State* lua);

  // bindings_object.cc: actors with objects and with each other
  stage::ObjectId CheckObjectId(lua_State* lua, int argument);
  stage::Object& CheckObject(lua_State* lua, int argument = 1);
  int CheckSurface(lua_State* lua, const stage::Object& object, int argument);
  int PushTask(lua_State* lua, const Result<stage::TaskId>& task);
  int PushTaskState(lua_State* lua);
  int StopTask(lua_State* lua);
  int Walk(lua_State* lua);
  int Turn(lua_State* lua);
  int StandUp(lua_State* lua);
  int Use(lua_State* lua);
  int Take(lua_State* lua);
  int Put(lua_State* lua);
  int Give(lua_State* lua);
  int PushObject(lua_State* lua);
  int PushObjectPose(lua_State* lua);
  int PlaceObject(lua_State* lua);
  int PlaceObjectOn(lua_State* lua);
  int ShowObject(lua_State* lua);
  int PushObjectState(lua_State* lua);
  int SetObjectState(lua_State* lua);
  int PushHolder(lua_State* lua);

  // bindings_light.cc: time of day and lamps
  int SetHour(lua_State* lua);
  int PushHour(lua_State* lua);
  int PushHasLight(lua_State* lua);
  int PushLightLevel(lua_State* lua);
  int SetLightLevel(lua_State* lua);
  int SetLightColour(lua_State* lua);
  int SetLightTemperature(lua_State* lua);

  // bindings_sound.cc: sounds and audio description
  int CheckSound(lua_State* lua);
  int PushSound(lua_State* lua);
  int PlaySound(lua_State* lua);
  int StopSound(lua_State* lua);
  int Describe(lua_State* lua);

  std::unique_ptr<Sandbox> sandbox_;
  stage::Stage& stage_;
  Recording& recording_;
  CueLog& cues_;
  OnError on_error_;
  OnTask on_task_;
  Scheduler scheduler_;
  TimelinePlayer timeline_player_;
  std::vector<Scheduler::TaskId> attempts_;  // Tasks within attempt(), one entry per nesting.
  std::shared_ptr<Declared> declaring_;      // Set only while the script first loads.
  std::shared_ptr<const Declared> declared_;
  RunState state_;
  std::vector<std::string> passed_;  // Markers passed in this tick.
  int64_t tick_ = 0;
  bool loading_ = false;
  bool following_ = false;  // Replaying the recording.
  Recording::Position followed_;
  Scheduler::TaskId chunk_ = 0;
};

inline double TimeOf(int64_t tick) { return static_cast<double>(tick) / Drama::kTicksPerSecond; }

// Ids are passed to Lua as one integer.
template <typename Tag>
int64_t PackId(Id<Tag> id) {
  return static_cast<int64_t>(uint64_t{id.generation} << 32 | id.index);
}
template <typename Tag>
Id<Tag> UnpackId(int64_t packed) {
  const auto bits = static_cast<uint64_t>(packed);
  return {static_cast<uint32_t>(bits), static_cast<uint32_t>(bits >> 32)};
}

}  // namespace lararium::drama
