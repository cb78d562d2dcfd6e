#include "shared/drama/drama.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "shared/drama/lua_binding.h"
#include "shared/drama/sandbox.h"
#include "shared/drama/scheduler.h"
#include "shared/drama/std_scripts.h"
#include "shared/drama/track.h"

namespace lararium::drama {
namespace {

constexpr size_t kMaxScriptBytes = 1 << 20;
constexpr size_t kMaxErrors = 100;  // kept; the log has them all
constexpr size_t kMaxSegments = 10'000;
constexpr double kTickSeconds = 1.0 / Drama::kTicksPerSecond;

double TimeOf(int64_t tick) { return static_cast<double>(tick) / Drama::kTicksPerSecond; }

// Actor ids cross to Lua as one integer.
lua_Integer PackId(stage::ActorId id) {
  return static_cast<lua_Integer>(uint64_t{id.generation} << 32 | id.index);
}
stage::ActorId UnpackId(lua_Integer packed) {
  const auto bits = static_cast<uint64_t>(packed);
  return {static_cast<uint32_t>(bits), static_cast<uint32_t>(bits >> 32)};
}

int FindClip(const human::Human& human, std::string_view name) {
  const auto found = std::find_if(human.clips.begin(), human.clips.end(),
                                  [name](const human::Clip& clip) { return clip.name == name; });
  return found == human.clips.end() ? stage::Animation::kNoClip
                                    : static_cast<int>(found - human.clips.begin());
}

// One run of a script from its beginning: the Lua state, its tasks and tracks.
// Its private functions are the table `host` of lua/std, and raise Lua errors.
class Performance {
 public:
  using OnError = std::function<void(int64_t tick, const LuaError&)>;

  Performance(std::unique_ptr<Sandbox> sandbox, stage::Stage& stage, OnError on_error)
      : sandbox_(std::move(sandbox)),
        stage_(stage),
        on_error_(std::move(on_error)),
        scheduler_(*sandbox_, [this](const LuaError& error) { on_error_(tick_, error); }) {}
  Performance(const Performance&) = delete;  // Lua knows its address
  Performance& operator=(const Performance&) = delete;

  // Compiles the script and plays tick 0.
  Status Begin(std::string_view script, const std::string& place) {
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
    return Status();
  }

  void Tick() {
    ++tick_;
    sandbox_->limits().Refill();
    stage_.Advance(kTickSeconds);
    scheduler_.Run(tick_);
    ApplyTracks();
  }

  // To any tick, where only tracks decide what is to be seen.
  void JumpTo(int64_t tick) {
    CHECK(only_tracks_);
    tick_ = tick;
    ApplyTracks();
  }

  bool only_tracks() const { return only_tracks_; }
  int64_t tick() const { return tick_; }

 private:
  Status StartChunk(std::string_view script, const std::string& place) {
    Status status;
    const bool done = Protected(sandbox_->lua(), [&](lua_State* lua) {
      status = sandbox_->Compile(script, place);
      if (status.ok()) {
        chunk_ = scheduler_.Start(lua);
      }
    });
    return done ? status : TooLittleMemory();
  }

  void StartMain() {
    Protected(sandbox_->lua(), [this](lua_State* lua) {
      if (lua_getglobal(lua, "main") == LUA_TFUNCTION) {
        only_tracks_ = false;
        scheduler_.Start(lua);
      }
    });
  }

  Status LoadStd(const EmbeddedText& script) {
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

  static Status TooLittleMemory() {
    return Status::Error("drama", "the limits are too low to begin with", "raise them");
  }

  void ApplyTracks() {
    for (const Track& track : tracks_) {
      if (stage::Actor* actor = stage_.Find(track.actor)) {
        actor->state = EvaluateTrack(track.segments, TimeOf(tick_));
      }
    }
  }

  // ---- what the table `host` holds ----

  template <int (Performance::*kMethod)(lua_State*)>
  static int Call(lua_State* lua) {
    auto* self = static_cast<Performance*>(lua_touserdata(lua, lua_upvalueindex(1)));
    return (self->*kMethod)(lua);
  }

  void PushHost(lua_State* lua) {
    constexpr luaL_Reg kFunctions[] = {
        {"time", Call<&Performance::PushTime>},      {"wait", Call<&Performance::Wait>},
        {"start", Call<&Performance::Start>},        {"stop", Call<&Performance::Stop>},
        {"join", Call<&Performance::Join>},          {"actor", Call<&Performance::PushActor>},
        {"clip", Call<&Performance::PushClip>},      {"playing", Call<&Performance::PushPlaying>},
        {"play", Call<&Performance::Play>},          {"pose", Call<&Performance::PushPose>},
        {"place", Call<&Performance::PlaceActor>},   {"show", Call<&Performance::Show>},
        {"segment", Call<&Performance::AddSegment>}, {nullptr, nullptr}};
    lua_newtable(lua);
    lua_pushlightuserdata(lua, this);
    luaL_setfuncs(lua, kFunctions, 1);
  }

  // time() -> seconds
  int PushTime(lua_State* lua) {
    lua_pushnumber(lua, TimeOf(tick_));
    return 1;
  }

  // wait(seconds)
  int Wait(lua_State* lua) {
    if (loading_ && scheduler_.running() == chunk_) {
      return luaL_error(lua, "the script cannot wait while it loads; wait in main()");
    }
    const double seconds = std::min(CheckFinite(lua, 1, "the time"), Drama::kMaxTime);
    return scheduler_.Wait(lua, std::llround(seconds * Drama::kTicksPerSecond));
  }

  // start(function) -> task
  int Start(lua_State* lua) {
    lua_settop(lua, 1);
    only_tracks_ = false;
    lua_pushinteger(lua, scheduler_.Start(lua));
    return 1;
  }

  // stop(task)
  int Stop(lua_State* lua) {
    scheduler_.Stop(lua, luaL_checkinteger(lua, 1));
    return 0;
  }

  // join(tasks, any)
  int Join(lua_State* lua) {
    luaL_checktype(lua, 1, LUA_TTABLE);
    std::vector<Scheduler::TaskId> tasks;
    for (lua_Integer i = 1; lua_rawgeti(lua, 1, i) == LUA_TNUMBER; ++i) {
      tasks.push_back(lua_tointeger(lua, -1));
      lua_pop(lua, 1);
    }
    return scheduler_.Join(lua, std::move(tasks), lua_toboolean(lua, 2) != 0);
  }

  // actor(name) -> id or nil
  int PushActor(lua_State* lua) {
    const std::optional<stage::ActorId> id = stage_.Find(CheckText(lua, 1));
    if (id) {
      lua_pushinteger(lua, PackId(*id));
    } else {
      lua_pushnil(lua);
    }
    return 1;
  }

  stage::Actor& CheckActor(lua_State* lua) {
    stage::Actor* actor = stage_.Find(UnpackId(luaL_checkinteger(lua, 1)));
    if (actor == nullptr) {
      luaL_error(lua, "the actor has left the stage");
    }
    return *actor;
  }

  // The same, for commands: a track would undo them.
  stage::Actor& CheckFreeActor(lua_State* lua) {
    stage::Actor& actor = CheckActor(lua);
    const stage::ActorId id = UnpackId(luaL_checkinteger(lua, 1));
    for (const Track& track : tracks_) {
      if (track.actor == id) {
        luaL_error(lua, "'%s' is led by a track", actor.name.c_str());
      }
    }
    only_tracks_ = false;
    return actor;
  }

  // clip(actor, name) -> duration, stride; or nil
  int PushClip(lua_State* lua) {
    const human::Human& human = *CheckActor(lua).human;
    const int clip = lua_type(lua, 2) == LUA_TSTRING ? FindClip(human, CheckText(lua, 2))
                                                     : stage::Animation::kNoClip;
    if (clip == stage::Animation::kNoClip) {
      lua_pushnil(lua);
      return 1;
    }
    lua_pushnumber(lua, human.clips[static_cast<size_t>(clip)].duration);
    lua_pushnumber(lua, human.clips[static_cast<size_t>(clip)].stride);
    return 2;
  }

  int CheckClip(lua_State* lua, const stage::Actor& actor, int argument) {
    const int clip = FindClip(*actor.human, CheckText(lua, argument));
    if (clip == stage::Animation::kNoClip) {
      luaL_error(lua, "'%s' has no clip '%s'", actor.name.c_str(), lua_tostring(lua, argument));
    }
    return clip;
  }

  // playing(actor) -> name of its clip, or nil
  int PushPlaying(lua_State* lua) {
    const stage::Actor& actor = CheckActor(lua);
    const int clip = actor.state.animation.clip;
    if (clip == stage::Animation::kNoClip) {
      lua_pushnil(lua);
    } else {
      PushText(lua, actor.human->clips[static_cast<size_t>(clip)].name);
    }
    return 1;
  }

  // play(actor, clip, fade, rate)
  int Play(lua_State* lua) {
    stage::Actor& actor = CheckFreeActor(lua);
    const int clip = CheckClip(lua, actor, 2);
    const auto fade = static_cast<float>(CheckFinite(lua, 3, "fade"));
    const double rate = CheckFinite(lua, 4, "rate");
    stage::Animation& animation = actor.state.animation;
    const bool goes_on = animation.clip == clip && animation.rate == rate &&
                         actor.human->clips[static_cast<size_t>(clip)].loops;
    if (!goes_on) {
      stage::StartClip(animation, clip, rate, fade);
    }
    return 0;
  }

  // pose(actor) -> x, y, z, heading
  int PushPose(lua_State* lua) {
    const stage::ActorState& state = CheckActor(lua).state;
    for (const float value :
         {state.position.x, state.position.y, state.position.z, state.heading}) {
      lua_pushnumber(lua, value);
    }
    return 4;
  }

  // place(actor, x, y, z, heading)
  int PlaceActor(lua_State* lua) {
    stage::ActorState& state = CheckFreeActor(lua).state;
    state.position = {CheckFinite(lua, 2, "x"), CheckFinite(lua, 3, "y"), CheckFinite(lua, 4, "z")};
    state.heading = static_cast<float>(CheckFinite(lua, 5, "heading"));
    return 0;
  }

  // show(actor, visible)
  int Show(lua_State* lua) {
    CheckFreeActor(lua).state.visible = lua_toboolean(lua, 2) != 0;
    return 0;
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

  std::vector<TrackSegment>& SegmentsOf(stage::ActorId id) {
    const auto found = std::find_if(tracks_.begin(), tracks_.end(),
                                    [id](const Track& track) { return track.actor == id; });
    if (found != tracks_.end()) {
      return found->segments;
    }
    tracks_.push_back({id, {}});
    return tracks_.back().segments;
  }

  // segment(actor, begin, length, clip, rate, fade, from, to, heading)
  int AddSegment(lua_State* lua) {
    if (!loading_) {
      return luaL_error(lua, "track: only while the script loads, not within main()");
    }
    const stage::Actor& actor = CheckActor(lua);
    TrackSegment segment;
    segment.begin = CheckFinite(lua, 2, "at");
    segment.length = CheckFinite(lua, 3, "length");
    segment.clip = CheckClip(lua, actor, 4);
    segment.rate = CheckFinite(lua, 5, "rate");
    segment.fade = CheckFinite(lua, 6, "fade");
    segment.from = CheckPoint(lua, 7);
    segment.to = CheckPoint(lua, 8);
    segment.heading = static_cast<float>(CheckFinite(lua, 9, "heading"));
    std::vector<TrackSegment>& segments = SegmentsOf(UnpackId(luaL_checkinteger(lua, 1)));
    if (segments.size() >= kMaxSegments) {
      return luaL_error(lua, "track: too many clips");
    }
    if (!segments.empty() && segment.begin < segments.back().begin) {
      return luaL_error(lua, "track: '%s' has a track already, and this one begins before its end",
                        actor.name.c_str());
    }
    segments.push_back(segment);
    return 0;
  }

  std::unique_ptr<Sandbox> sandbox_;
  stage::Stage& stage_;
  OnError on_error_;
  Scheduler scheduler_;
  std::vector<Track> tracks_;
  int64_t tick_ = 0;
  bool loading_ = false;
  Scheduler::TaskId chunk_ = 0;
  bool only_tracks_ = true;  // no task and no command has changed the stage
};

class LuaDrama : public Drama {
 public:
  LuaDrama(std::string_view script,
           std::string place,
           stage::Stage& stage,
           const DramaOptions& options,
           Log& log)
      : script_(script), place_(std::move(place)), stage_(stage), options_(options), log_(log) {}

  // From the beginning.
  Status Begin() {
    LARARIUM_ASSIGN_OR_RETURN(
        std::unique_ptr<Sandbox> sandbox,
        Sandbox::Create(options_.memory_limit, options_.instruction_limit, options_.seed));
    stage_.Reset();
    errors_.clear();
    auto performance = std::make_unique<Performance>(
        std::move(sandbox), stage_,
        [this](int64_t tick, const LuaError& error) { Report(tick, error); });
    LARARIUM_RETURN_IF_ERROR(performance->Begin(script_, place_));
    performance_ = std::move(performance);
    played_until_ = std::max(played_until_, performance_->tick());
    return Status();
  }

  void Tick() override {
    performance_->Tick();
    played_until_ = std::max(played_until_, performance_->tick());
  }

  Status Seek(double time) override {
    if (!(time >= 0.0 && time <= kMaxTime)) {
      return Status::Error(place_, "cannot seek to a time outside of the drama",
                           "choose one from 0 s to 24 h");
    }
    const int64_t target = std::llround(time * kTicksPerSecond);
    if (performance_->only_tracks()) {
      performance_->JumpTo(target);
      return Status();
    }
    if (target < performance_->tick()) {
      LARARIUM_RETURN_IF_ERROR(Begin());
    }
    while (performance_->tick() < target) {
      Tick();
    }
    return Status();
  }

  double time() const override { return TimeOf(performance_->tick()); }
  std::span<const ScriptError> errors() const override { return errors_; }

 private:
  void Report(int64_t tick, const LuaError& error) {
    // Playing again to seek meets the same errors: they were logged before.
    if (tick > played_until_) {
      log_.error("{}\n{}", error.message, error.traceback);
    }
    if (errors_.size() < kMaxErrors) {
      errors_.push_back({TimeOf(tick), error.message, error.traceback});
    }
  }

  std::string script_;
  std::string place_;
  stage::Stage& stage_;
  DramaOptions options_;
  Log& log_;
  std::unique_ptr<Performance> performance_;
  std::vector<ScriptError> errors_;
  int64_t played_until_ = -1;  // the last tick whose errors were logged
};

}  // namespace

Status DramaOptions::Validate() const {
  if (memory_limit < (1 << 20) || memory_limit > (size_t{1} << 32)) {
    return Status::Error("drama", "the memory limit must lie between 1 MiB and 4 GiB");
  }
  if (instruction_limit < 100'000 || instruction_limit > (int64_t{1} << 40)) {
    return Status::Error("drama", "the instruction limit must be at least 100000");
  }
  return Status();
}

Result<std::unique_ptr<Drama>> Drama::Create(std::string_view script,
                                             std::string place,
                                             stage::Stage& stage,
                                             const DramaOptions& options,
                                             Log& log) {
  LARARIUM_RETURN_IF_ERROR(options.Validate());
  if (script.size() > kMaxScriptBytes) {
    return Status::Error(place, "the script is longer than 1 MiB");
  }
  auto drama = std::make_unique<LuaDrama>(script, std::move(place), stage, options, log);
  LARARIUM_RETURN_IF_ERROR(drama->Begin());
  return std::unique_ptr<Drama>(std::move(drama));
}

}  // namespace lararium::drama
