#include "shared/drama/run.h"

#include <algorithm>
#include <cmath>

#include "shared/drama/lua_binding.h"
#include "shared/drama/std_scripts.h"

namespace lararium::drama {
namespace {

constexpr size_t kMaxSegments = 10'000;

Status TooLittleMemory() {
  return Status::Error("drama", "the limits are too low to begin with", "raise them");
}

glm::vec3 CheckPoint(lua_State* lua, int argument) {
  constexpr const char* kAxes[] = {"x", "y", "z"};
  luaL_checktype(lua, argument, LUA_TTABLE);
  glm::vec3 point;
  for (int axis = 0; axis < 3; ++axis) {
    lua_getfield(lua, argument, kAxes[axis]);
    point[axis] = static_cast<float>(CheckFinite(lua, -1, kAxes[axis]));
    lua_pop(lua, 1);
  }
  return point;
}

}  // namespace

Run::Run(std::unique_ptr<Sandbox> sandbox, stage::Stage& stage, OnError on_error, OnTask on_task)
    : sandbox_(std::move(sandbox)),
      stage_(stage),
      on_error_(std::move(on_error)),
      on_task_(std::move(on_task)),
      scheduler_(*sandbox_, [this](const LuaError& error) { on_error_(tick_, error); }) {}

Status Run::Begin(std::string_view script, const std::string& place) {
  for (const EmbeddedText& std_script : StdScripts()) {
    LARARIUM_RETURN_IF_ERROR(LoadStd(std_script));
  }
  LARARIUM_RETURN_IF_ERROR(StartChunk(script, place));
  loading_ = true;
  scheduler_.Run(0);
  loading_ = false;
  StartMain();
  scheduler_.Run(0);
  ApplyTracks();
  stage_.Perform();
  return Status();
}

void Run::Tick() {
  ++tick_;
  sandbox_->limits().Refill();
  stage_.Advance();
  scheduler_.Run(tick_);
  ApplyTracks();
  stage_.Perform();
}

Status Run::StartChunk(std::string_view script, const std::string& place) {
  Status status;
  const bool done = Protected(sandbox_->lua(), [&](lua_State* lua) {
    status = sandbox_->Compile(script, place);
    if (status.ok()) {
      chunk_ = scheduler_.Start(lua);
    }
  });
  return done ? status : TooLittleMemory();
}

void Run::StartMain() {
  Protected(sandbox_->lua(), [this](lua_State* lua) {
    if (lua_getglobal(lua, "main") == LUA_TFUNCTION) {
      only_tracks_ = false;
      scheduler_.Start(lua);
    }
  });
}

Status Run::LoadStd(const EmbeddedText& script) {
  Status status;
  const bool done = Protected(sandbox_->lua(), [&](lua_State* lua) {
    status = sandbox_->Compile(script.text, "std/" + std::string(script.name));
    if (status.ok()) {
      PushHost(lua);
      lua_call(lua, 1, 0);
    }
  });
  return done ? status : TooLittleMemory();
}

void Run::ApplyTracks() {
  for (const Track& track : tracks_) {
    if (stage::Actor* actor = stage_.Find(track.actor)) {
      ApplyTrack(track.segments, TimeOf(tick_), actor->state);
    }
  }
}

template <int (Run::*kMethod)(lua_State*)>
int Run::Call(lua_State* lua) {
  auto* self = static_cast<Run*>(lua_touserdata(lua, lua_upvalueindex(1)));
  return (self->*kMethod)(lua);
}

void Run::PushHost(lua_State* lua) {
  constexpr luaL_Reg kFunctions[] = {{"time", Call<&Run::PushTime>},
                                     {"wait", Call<&Run::Wait>},
                                     {"start", Call<&Run::Start>},
                                     {"stop", Call<&Run::Stop>},
                                     {"join", Call<&Run::Join>},
                                     {"warn", Call<&Run::Warn>},
                                     {"attempt", Call<&Run::Attempt>},
                                     {"note_task", Call<&Run::NoteTask>},
                                     {"segment", Call<&Run::AddSegment>},
                                     {"actor", Call<&Run::PushActor>},
                                     {"clip", Call<&Run::PushClip>},
                                     {"playing", Call<&Run::PushPlaying>},
                                     {"play", Call<&Run::Play>},
                                     {"gesture", Call<&Run::Gesture>},
                                     {"pose", Call<&Run::PushPose>},
                                     {"place", Call<&Run::PlaceActor>},
                                     {"show", Call<&Run::Show>},
                                     {"look", Call<&Run::Look>},
                                     {"attend", Call<&Run::Attend>},
                                     {"express", Call<&Run::Express>},
                                     {"say", Call<&Run::Say>},
                                     {"gait", Call<&Run::SetGait>},
                                     {"task", Call<&Run::PushTaskState>},
                                     {"stop_task", Call<&Run::StopTask>},
                                     {"walk", Call<&Run::Walk>},
                                     {"turn", Call<&Run::Turn>},
                                     {"stand_up", Call<&Run::StandUp>},
                                     {"use", Call<&Run::Use>},
                                     {"take", Call<&Run::Take>},
                                     {"put", Call<&Run::Put>},
                                     {"give", Call<&Run::Give>},
                                     {"object", Call<&Run::PushObject>},
                                     {"object_pose", Call<&Run::PushObjectPose>},
                                     {"place_object", Call<&Run::PlaceObject>},
                                     {"place_object_on", Call<&Run::PlaceObjectOn>},
                                     {"show_object", Call<&Run::ShowObject>},
                                     {"object_state", Call<&Run::PushObjectState>},
                                     {"set_object_state", Call<&Run::SetObjectState>},
                                     {"holder", Call<&Run::PushHolder>},
                                     {"set_hour", Call<&Run::SetHour>},
                                     {"hour", Call<&Run::PushHour>},
                                     {"has_light", Call<&Run::PushHasLight>},
                                     {"light_level", Call<&Run::PushLightLevel>},
                                     {"set_light_level", Call<&Run::SetLightLevel>},
                                     {"set_light_colour", Call<&Run::SetLightColour>},
                                     {"set_light_temperature", Call<&Run::SetLightTemperature>},
                                     {"sound", Call<&Run::PushSound>},
                                     {"play_sound", Call<&Run::PlaySound>},
                                     {"stop_sound", Call<&Run::StopSound>},
                                     {nullptr, nullptr}};
  lua_newtable(lua);
  lua_pushlightuserdata(lua, this);
  luaL_setfuncs(lua, kFunctions, 1);
}

// time() -> seconds
int Run::PushTime(lua_State* lua) {
  lua_pushnumber(lua, TimeOf(tick_));
  return 1;
}

// wait(seconds)
int Run::Wait(lua_State* lua) {
  if (loading_ && scheduler_.running() == chunk_) {
    return luaL_error(lua, "the script cannot wait while it loads; wait in main()");
  }
  const double seconds = std::min(CheckFinite(lua, 1, "the time"), Drama::kMaxTime);
  return scheduler_.Wait(lua, std::llround(seconds * Drama::kTicksPerSecond));
}

// start(function) -> task
int Run::Start(lua_State* lua) {
  lua_settop(lua, 1);
  only_tracks_ = false;
  lua_pushinteger(lua, scheduler_.Start(lua));
  return 1;
}

// stop(task)
int Run::Stop(lua_State* lua) {
  scheduler_.Stop(lua, luaL_checkinteger(lua, 1));
  return 0;
}

// join(tasks, any)
int Run::Join(lua_State* lua) {
  luaL_checktype(lua, 1, LUA_TTABLE);
  std::vector<Scheduler::TaskId> tasks;
  for (lua_Integer i = 1; lua_rawgeti(lua, 1, i) == LUA_TNUMBER; ++i) {
    tasks.push_back(lua_tointeger(lua, -1));
    lua_pop(lua, 1);
  }
  return scheduler_.Join(lua, std::move(tasks), lua_toboolean(lua, 2) != 0);
}

// warn(message): to the author, about the line that called the function that calls this
int Run::Warn(lua_State* lua) {
  luaL_where(lua, 2);
  const std::string where(CheckText(lua, -1));
  on_error_(tick_, {where + std::string(CheckText(lua, 1)), ""});
  return 0;
}

// attempt() -> a number: what the calling task does may fail from now on; attempt(number): no
// longer
int Run::Attempt(lua_State* lua) {
  if (lua_isnoneornil(lua, 1)) {
    attempts_.push_back(scheduler_.running());
    lua_pushinteger(lua, scheduler_.running());
    return 1;
  }
  const auto found = std::find(attempts_.begin(), attempts_.end(), luaL_checkinteger(lua, 1));
  if (found != attempts_.end()) {
    attempts_.erase(found);
  }
  return 0;
}

// note_task(actor, action, object's name or nil, when it began, whether it failed, message):
// one has ended, of the line that called the function that calls the function that calls this
int Run::NoteTask(lua_State* lua) {
  const stage::Actor& actor = CheckActor(lua);
  const std::string_view action = CheckText(lua, 2);
  const std::string_view object = lua_isnil(lua, 3) ? std::string_view() : CheckText(lua, 3);
  const double began = CheckFinite(lua, 4, "the time");
  const std::string_view message = CheckText(lua, 6);
  luaL_where(lua, 3);
  std::string_view where = CheckText(lua, -1);  // "drama.lua:12: "
  where = where.substr(0, where.find_last_not_of(": ") + 1);
  const bool expected =
      std::find(attempts_.begin(), attempts_.end(), scheduler_.running()) != attempts_.end();
  on_task_({began, TimeOf(tick_), std::string(where), actor.name, std::string(action),
            std::string(object), lua_toboolean(lua, 5) != 0, expected, std::string(message)});
  return 0;
}

std::vector<TrackSegment>& Run::SegmentsOf(stage::ActorId id) {
  const auto found = std::find_if(tracks_.begin(), tracks_.end(),
                                  [id](const Track& track) { return track.actor == id; });
  if (found != tracks_.end()) {
    return found->segments;
  }
  tracks_.push_back({id, {}});
  return tracks_.back().segments;
}

// segment(actor, begin, length, clip, rate, fade, from, to, heading)
int Run::AddSegment(lua_State* lua) {
  if (!loading_) {
    return luaL_error(lua, "track: only while the script loads, not within main()");
  }
  stage::Actor& actor = CheckActor(lua);
  TrackSegment segment;
  segment.begin = CheckFinite(lua, 2, "at");
  segment.length = CheckFinite(lua, 3, "length");
  segment.clip = CheckClip(lua, actor, 4);
  segment.rate = CheckFinite(lua, 5, "rate");
  segment.fade = CheckFinite(lua, 6, "fade");
  segment.from = CheckPoint(lua, 7);
  segment.to = CheckPoint(lua, 8);
  segment.heading = static_cast<float>(CheckFinite(lua, 9, "heading"));
  std::vector<TrackSegment>& segments = SegmentsOf(CheckActorId(lua, 1));
  if (segments.size() >= kMaxSegments) {
    return luaL_error(lua, "track: too many clips");
  }
  if (!segments.empty() && segment.begin < segments.back().begin) {
    return luaL_error(lua, "track: '%s' has a track already, and this one begins before its end",
                      actor.name.c_str());
  }
  segments.push_back(segment);
  actor.led = true;
  return 0;
}

}  // namespace lararium::drama
