#pragma once

// One run of a script from its beginning: the Lua state, its coroutines, and the
// functions that lua/std calls. Private to the room.

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

// When a coroutine's first behaviour reaches its points.
struct SyncRecord {
  Scheduler::TaskId coroutine = 0;
  stage::TaskId task = 0;  // of the stage, which decides; 0: the ticks are known
  std::array<int64_t, stage::kSyncPoints> ticks = {};  // kUnknown: not yet
  static constexpr int64_t kUnknown = -1;
};

// All that a run remembers besides its coroutines; plain values.
struct RunState {
  TimelineState timeline;
  std::vector<Trigger> triggers;
  int64_t last_trigger = 0;
  std::vector<SyncRecord> sync;
  Visitor visitor;
  // The last message of each address: its arguments, as Message has them.
  std::map<std::string, std::string, std::less<>> heard;
  int64_t lost_ticks = 0;  // since when tracking is lost
};

// Which triggers a script has armed, and which of them fired.
struct CueLog {
  static constexpr size_t kMost = 1000;

  std::vector<CueRecord> cues;
  std::map<std::string, size_t, std::less<>> known;  // places in there

  // The place of a trigger in there; it is new or was armed before. kMost: there are too
  // many to remember.
  size_t Find(CueRecord cue);
};

// What a script says of itself while it loads. The same whenever it is run.
struct Declared {
  Timeline timeline;
  DramaSettings settings;
};

// Its private functions are the table `host` of lua/std, and raise Lua errors. Those that
// ask or change anything but coroutines are recorded, and not called when the script is
// only run again.
class Run {
 public:
  using OnError = std::function<void(int64_t tick, const LuaError&)>;
  using OnTask = std::function<void(TaskRecord)>;

  // Borrows stage, recording, cues.
  Run(std::unique_ptr<Sandbox> sandbox,
      stage::Stage& stage,
      Recording& recording,
      CueLog& cues,
      OnError on_error,
      OnTask on_task);
  Run(const Run&) = delete;  // Lua knows its address
  Run& operator=(const Run&) = delete;

  // Compiles the script and plays tick 0.
  Status Begin(std::string_view script, const std::string& place);
  void Tick(const Visitor& visitor);

  // Compiles the script, to be run again up to a position by FollowTo(). declared: of the
  // run that was recorded.
  Status BeginAgain(std::string_view script,
                    const std::string& place,
                    std::shared_ptr<const Declared> declared);
  // Runs coroutines as recorded, without the stage; false where they do not do again
  // what they did. The recording's position is then anywhere.
  bool FollowTo(const Recording::Position& position);
  Recording::Position followed() const { return followed_; }

  const RunState& state() const { return state_; }
  // The stage has been brought to a tick, and the coroutines to its position.
  void Restore(const RunState& state, int64_t tick);

  std::shared_ptr<const Declared> declared() const { return declared_; }
  int64_t tick() const { return tick_; }

 private:
  Status LoadStd();
  Status StartChunk(std::string_view script, const std::string& place);
  void StartMain();
  void ApplyTracks();
  void UpdateTriggers();
  void HearMessages();
  void UpdateSync();

  // ---- the table `host`; what each takes and gives is written where it is defined ----

  template <int (Run::*kMethod)(lua_State*)>
  static int Call(lua_State* lua);  // recorded
  template <int (Run::*kMethod)(lua_State*)>
  static int Own(lua_State* lua);  // only coroutines and time: run again
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

  // words_timeline.cc
  int AddSegment(lua_State* lua);
  int AddLane(lua_State* lua);
  std::vector<TrackSegment>& SegmentsOf(stage::ActorId id);
  Cue CheckItem(lua_State* lua, const CueLane& lane, int64_t index);
  Cue CheckCue(lua_State* lua, const CueLane& lane);
  void CheckMotion(lua_State* lua, Cue& cue);
  void CheckUse(lua_State* lua, Cue& cue);
  stage::ObjectId CheckObjectNamed(lua_State* lua, const char* key);
  stage::Attention::Choice CheckGaze(lua_State* lua);

  // words_visitor.cc
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

  // words_actor.cc: what people do by themselves
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

  // words_object.cc: what they do with objects and each other
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

  // words_light.cc: time of day and lamps
  int SetHour(lua_State* lua);
  int PushHour(lua_State* lua);
  int PushHasLight(lua_State* lua);
  int PushLightLevel(lua_State* lua);
  int SetLightLevel(lua_State* lua);
  int SetLightColour(lua_State* lua);
  int SetLightTemperature(lua_State* lua);

  // words_sound.cc: what is played by itself
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
  std::vector<Scheduler::TaskId> attempts_;  // tasks within attempt(), once for each
  std::shared_ptr<Declared> declaring_;      // while the script loads for the first time
  std::shared_ptr<const Declared> declared_;
  RunState state_;
  std::vector<std::string> passed_;  // markers of this tick
  int64_t tick_ = 0;
  bool loading_ = false;
  bool following_ = false;  // the recording
  Recording::Position followed_;
  Scheduler::TaskId chunk_ = 0;
};

inline double TimeOf(int64_t tick) { return static_cast<double>(tick) / Drama::kTicksPerSecond; }

// Ids cross to Lua as one integer.
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
