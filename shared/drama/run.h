#pragma once

// One run of a script from its beginning: the Lua state, its tasks and tracks, and the
// functions that lua/std calls. Private to the room.

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/embedded_text.h"
#include "shared/core/status.h"
#include "shared/drama/drama.h"
#include "shared/drama/sandbox.h"
#include "shared/drama/scheduler.h"
#include "shared/drama/track.h"
#include "shared/stage/stage.h"

namespace lararium::drama {

// Its private functions are the table `host` of lua/std, and raise Lua errors.
class Run {
 public:
  using OnError = std::function<void(int64_t tick, const LuaError&)>;

  using OnTask = std::function<void(TaskRecord)>;

  Run(std::unique_ptr<Sandbox> sandbox, stage::Stage& stage, OnError on_error, OnTask on_task);
  Run(const Run&) = delete;  // Lua knows its address
  Run& operator=(const Run&) = delete;

  // Compiles the script and plays tick 0.
  Status Begin(std::string_view script, const std::string& place);
  void Tick();
  // The stage has been brought to a tick at which only tracks decide what is to be seen.
  void ContinueFrom(int64_t tick) { tick_ = tick; }

  bool only_tracks() const { return only_tracks_; }
  int64_t tick() const { return tick_; }

 private:
  Status StartChunk(std::string_view script, const std::string& place);
  void StartMain();
  Status LoadStd(const EmbeddedText& script);
  void ApplyTracks();

  // ---- the table `host`; what each takes and gives is written where it is defined ----

  template <int (Run::*kMethod)(lua_State*)>
  static int Call(lua_State* lua);
  void PushHost(lua_State* lua);

  // run.cc: time and tasks
  int PushTime(lua_State* lua);
  int Wait(lua_State* lua);
  int Start(lua_State* lua);
  int Stop(lua_State* lua);
  int Join(lua_State* lua);
  int Warn(lua_State* lua);
  int Attempt(lua_State* lua);
  int NoteTask(lua_State* lua);
  int AddSegment(lua_State* lua);

  // words_actor.cc: what people do by themselves
  stage::ActorId CheckActorId(lua_State* lua, int argument);
  stage::Actor& CheckActor(lua_State* lua, int argument = 1);
  stage::Actor& CheckFreeActor(lua_State* lua);
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

  std::vector<TrackSegment>& SegmentsOf(stage::ActorId id);

  std::unique_ptr<Sandbox> sandbox_;
  stage::Stage& stage_;
  OnError on_error_;
  OnTask on_task_;
  Scheduler scheduler_;
  std::vector<Scheduler::TaskId> attempts_;  // tasks within attempt(), once for each
  std::vector<Track> tracks_;
  int64_t tick_ = 0;
  bool loading_ = false;
  Scheduler::TaskId chunk_ = 0;
  bool only_tracks_ = true;  // no task and no command has changed the stage
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
