#include "shared/drama/run.h"

#include <algorithm>
#include <cmath>

#include "shared/drama/lua_binding.h"
#include "shared/drama/std_scripts.h"

namespace lararium::drama {
namespace {

constexpr int kLoadingTicks = 64;             // The instruction budget of loading, in ticks.
constexpr Scheduler::TaskId kMainBegins = 0;  // Marks the start of main() in the recording.

Status TooLittleMemory() {
  return Status::Error("drama", "the limits are too low to start a script", "raise them");
}

// Pushes a copy of the table on top of the stack. Tables in it are copied to the given depth.
void PushCopy(lua_State* lua, int depth) {
  luaL_checkstack(lua, 8, "too many tables in tables");
  lua_newtable(lua);
  lua_pushnil(lua);
  while (lua_next(lua, -3) != 0) {
    if (depth > 0 && lua_istable(lua, -1)) {
      PushCopy(lua, depth - 1);
      lua_remove(lua, -2);
    }
    lua_pushvalue(lua, -2);
    lua_insert(lua, -2);
    lua_rawset(lua, -4);
  }
}

// Copies the globals that lua/std has added to the globals of the script.
void ShareNewGlobals(lua_State* lua, int std_globals) {
  lua_pushglobaltable(lua);
  lua_pushnil(lua);
  while (lua_next(lua, std_globals) != 0) {
    lua_pushvalue(lua, -2);
    if (lua_rawget(lua, -4) == LUA_TNIL) {
      lua_pushvalue(lua, -3);
      lua_pushvalue(lua, -3);
      lua_rawset(lua, -6);
    }
    lua_pop(lua, 2);
  }
  lua_pop(lua, 1);
}

}  // namespace

Run::Run(std::unique_ptr<Sandbox> sandbox,
         stage::Stage& stage,
         Recording& recording,
         CueLog& cues,
         OnError on_error,
         OnTask on_task)
    : sandbox_(std::move(sandbox)),
      stage_(stage),
      recording_(recording),
      cues_(cues),
      on_error_(std::move(on_error)),
      on_task_(std::move(on_task)),
      scheduler_(
          *sandbox_,
          [this](const LuaError& error) {
            if (!following_) {
              on_error_(tick_, error);
            }
          },
          [this](Scheduler::TaskId id) {
            if (!following_) {
              recording_.NoteResume(tick_, id);
            }
          }),
      timeline_player_(
          stage_,
          [this](TaskRecord record) { on_task_(std::move(record)); },
          [this](const std::string& problem) {
            on_error_(tick_, {problem, ""});
          }) {}

// ---- playing ----

Status Run::Begin(std::string_view script, const std::string& where) {
  LARARIUM_RETURN_IF_ERROR(LoadStd());
  declaring_ = std::make_shared<Declared>();
  declared_ = declaring_;
  LARARIUM_RETURN_IF_ERROR(StartChunk(script, where));
  loading_ = true;
  scheduler_.Run(0);
  loading_ = false;
  declaring_.reset();
  recording_.NoteResume(0, kMainBegins);
  StartMain();
  timeline_player_.Advance(declared_->timeline, 0.0, state_.timeline, passed_);
  UpdateTriggers();
  scheduler_.Run(0);
  ApplyTracks();
  stage_.Perform();
  followed_ = recording_.position();
  return Status();
}

void Run::Tick(const Visitor& visitor) {
  ++tick_;
  sandbox_->limits().Refill();
  state_.visitor = visitor;
  state_.lost_ticks = visitor.tracked ? 0 : state_.lost_ticks + 1;
  stage_.SetVisitor(visitor.tracked ? std::optional(visitor.position) : std::nullopt);
  stage_.Advance();
  passed_.clear();
  timeline_player_.Advance(declared_->timeline, TimeOf(tick_), state_.timeline, passed_);
  HearMessages();
  UpdateTriggers();
  UpdateSync();
  scheduler_.Run(tick_);
  ApplyTracks();
  stage_.Perform();
  followed_ = recording_.position();
}

Status Run::StartChunk(std::string_view script, const std::string& where) {
  Status status;
  sandbox_->limits().Refill(kLoadingTicks);
  const bool done = Protected(sandbox_->lua(), [&](lua_State* lua) {
    status = sandbox_->Compile(script, where);
    if (status.ok()) {
      chunk_ = scheduler_.Start(lua);
    }
  });
  return done ? status : TooLittleMemory();
}

void Run::StartMain() {
  sandbox_->limits().Refill();
  Protected(sandbox_->lua(), [this](lua_State* lua) {
    if (lua_getglobal(lua, "main") == LUA_TFUNCTION) {
      scheduler_.Start(lua);
    }
  });
}

Status Run::LoadStd() {
  // One table for all files of lua/std, which share functions in it.
  constexpr const char* kHost = "lararium.host";
  // lua/std has its own globals, so that a script cannot change the functions that it calls.
  constexpr const char* kGlobals = "lararium.std";
  const bool made = Protected(sandbox_->lua(), [&](lua_State* lua) {
    PushHost(lua);
    lua_setfield(lua, LUA_REGISTRYINDEX, kHost);
    lua_pushglobaltable(lua);
    PushCopy(lua, 1);
    lua_setfield(lua, LUA_REGISTRYINDEX, kGlobals);
    lua_pop(lua, 1);
  });
  if (!made) {
    return TooLittleMemory();
  }
  for (const EmbeddedText& script : StdScripts()) {
    Status status;
    const bool done = Protected(sandbox_->lua(), [&](lua_State* lua) {
      status = sandbox_->Compile(script.text, "std/" + std::string(script.name));
      if (status.ok()) {
        lua_getfield(lua, LUA_REGISTRYINDEX, kGlobals);
        lua_setupvalue(lua, -2, 1);
        lua_getfield(lua, LUA_REGISTRYINDEX, kHost);
        lua_call(lua, 1, 0);
      }
    });
    LARARIUM_RETURN_IF_ERROR(done ? status : TooLittleMemory());
  }
  const bool shared = Protected(sandbox_->lua(), [&](lua_State* lua) {
    lua_getfield(lua, LUA_REGISTRYINDEX, kGlobals);
    ShareNewGlobals(lua, lua_gettop(lua));
    lua_pop(lua, 1);
  });
  return shared ? Status() : TooLittleMemory();
}

void Run::ApplyTracks() {
  for (const Track& track : declared_->timeline.tracks) {
    if (stage::Actor* actor = stage_.Find(track.actor)) {
      ApplyTrack(track.segments, TimeOf(tick_), actor->state);
    }
  }
}

void Run::UpdateTriggers() {
  const TriggerContext now = {stage_, state_.visitor, static_cast<float>(TimeOf(state_.lost_ticks)),
                              passed_,
                              tick_ > 0 ? static_cast<float>(stage::Stage::kTickSeconds) : 0.0f};
  for (Trigger& trigger : state_.triggers) {
    UpdateTrigger(now, trigger);
    if (trigger.fired > 0 && trigger.cue < cues_.cues.size()) {
      cues_.cues[trigger.cue].fired = true;
    }
  }
}

size_t CueLog::Find(CueRecord cue) {
  const std::string key = cue.where + ' ' + cue.kind + ' ' + cue.name;
  if (const auto found = known.find(key); found != known.end() || cues.size() >= kMost) {
    return found == known.end() ? kMost : found->second;
  }
  known.emplace(key, cues.size());
  cues.push_back(std::move(cue));
  return cues.size() - 1;
}

void Run::HearMessages() {
  constexpr size_t kMaxAddresses = 256;
  std::string_view keys = state_.visitor.keys;
  for (std::string_view word = TakeKey(keys); !word.empty(); word = TakeKey(keys)) {
    const std::optional<Message> message = ParseMessage(word);
    if (!message) {
      continue;
    }
    const auto known = state_.heard.find(message->address);
    if (known != state_.heard.end()) {
      known->second = message->arguments;
    } else if (state_.heard.size() < kMaxAddresses) {
      state_.heard.emplace(message->address, message->arguments);
    }
  }
}

// ---- replaying ----

Status Run::BeginAgain(std::string_view script,
                       const std::string& where,
                       std::shared_ptr<const Declared> declared) {
  LARARIUM_RETURN_IF_ERROR(LoadStd());
  declared_ = std::move(declared);
  LARARIUM_RETURN_IF_ERROR(StartChunk(script, where));
  loading_ = true;
  return Status();
}

bool Run::FollowTo(const Recording::Position& position) {
  following_ = true;
  recording_.ForgetDivergence();
  recording_.GoTo(followed_);
  bool follows = true;
  while (follows && recording_.position().resumes < position.resumes) {
    const Recording::Resume resume = recording_.NextResume();
    if (resume.task == kMainBegins) {
      scheduler_.EndTick();
      loading_ = false;
      StartMain();
      continue;
    }
    if (resume.tick != tick_) {
      scheduler_.EndTick();
      tick_ = resume.tick;
      sandbox_->limits().Refill();
    }
    follows = scheduler_.RunAgain(tick_, resume.task) && !recording_.diverged();
  }
  scheduler_.EndTick();
  following_ = false;
  followed_ = recording_.position();
  return follows && followed_ == position;
}

void Run::Restore(const RunState& state, int64_t tick) {
  state_ = state;
  tick_ = tick;
}

// ---- the host ----

template <int (Run::*kMethod)(lua_State*)>
int Run::Call(lua_State* lua) {
  auto* self = static_cast<Run*>(lua_touserdata(lua, lua_upvalueindex(1)));
  const auto function = static_cast<int>(lua_tointeger(lua, lua_upvalueindex(2)));
  if (self->following_) {
    return self->recording_.Replay(lua, function);
  }
  int results = 0;
  try {
    results = (self->*kMethod)(lua);
  } catch (...) {  // Lua raises its errors as exceptions.
    self->recording_.NoteError(lua, function);
    throw;
  }
  self->recording_.NoteCall(lua, function, results);
  return results;
}

template <int (Run::*kMethod)(lua_State*)>
int Run::Own(lua_State* lua) {
  auto* self = static_cast<Run*>(lua_touserdata(lua, lua_upvalueindex(1)));
  return (self->*kMethod)(lua);
}

void Run::PushHost(lua_State* lua) {
  constexpr luaL_Reg kFunctions[] = {{"time", Own<&Run::PushTime>},
                                     {"wait", Own<&Run::Wait>},
                                     {"wait_until", Own<&Run::WaitUntilTime>},
                                     {"start", Own<&Run::Start>},
                                     {"stop", Own<&Run::Stop>},
                                     {"join", Own<&Run::Join>},
                                     {"await", Own<&Run::Await>},
                                     {"await_point", Own<&Run::AwaitPoint>},
                                     {"await_fired", Own<&Run::AwaitFired>},
                                     {"outcome", Own<&Run::PushOutcome>},
                                     {"attempt", Own<&Run::Attempt>},
                                     {"warn", Call<&Run::WarnAuthor>},
                                     {"note_task", Call<&Run::NoteTask>},
                                     {"configure", Call<&Run::Configure>},
                                     {"segment", Call<&Run::AddSegment>},
                                     {"lane", Call<&Run::AddLane>},
                                     {"trigger", Call<&Run::AddTrigger>},
                                     {"drop_trigger", Call<&Run::DropTrigger>},
                                     {"fired", Call<&Run::PushFired>},
                                     {"heard", Call<&Run::PushHeard>},
                                     {"visitor", Call<&Run::PushVisitor>},
                                     {"distance", Call<&Run::PushDistance>},
                                     {"aside", Call<&Run::PushAside>},
                                     {"foretell", Call<&Run::Foretell>},
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
                                     {"describe", Call<&Run::Describe>},
                                     {nullptr, nullptr}};
  static_assert(std::size(kFunctions) <= 255, "the recording stores the function in a byte");
  lua_newtable(lua);
  for (size_t i = 0; kFunctions[i].name != nullptr; ++i) {
    lua_pushlightuserdata(lua, this);
    lua_pushinteger(lua, static_cast<lua_Integer>(i));
    lua_pushcclosure(lua, kFunctions[i].func, 2);
    lua_setfield(lua, -2, kFunctions[i].name);
  }
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

// wait_until(seconds): waits until a time of the drama
int Run::WaitUntilTime(lua_State* lua) {
  const double seconds = std::clamp(CheckFinite(lua, 1, "the time"), 0.0, Drama::kMaxTime);
  return scheduler_.Wait(lua, std::llround(seconds * Drama::kTicksPerSecond) - tick_);
}

// start(function) -> task
int Run::Start(lua_State* lua) {
  lua_settop(lua, 1);
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

// await(number): waits until a task of the stage is over
int Run::Await(lua_State* lua) {
  const auto task = static_cast<stage::TaskId>(luaL_checkinteger(lua, 1));
  return scheduler_.WaitUntil(lua, "a task", [this, task] {
    const stage::TaskReport report = stage_.tasks().report(task);
    return report.over() || report.state == stage::TaskReport::State::kUnknown;
  });
}

// outcome(task) -> whether it is over, whether it succeeded, error message
int Run::PushOutcome(lua_State* lua) {
  const Scheduler::TaskId id = luaL_checkinteger(lua, 1);
  const Scheduler::Outcome* outcome = scheduler_.OutcomeOf(id);
  lua_pushboolean(lua, scheduler_.Alive(id) ? 0 : 1);
  lua_pushboolean(lua, outcome == nullptr || !outcome->failed ? 1 : 0);
  PushText(lua, outcome == nullptr ? std::string_view() : outcome->message);
  return 3;
}

// await_point(task, point, seconds): waits until `seconds` after the point; negative seconds work
// for points that are known in advance
int Run::AwaitPoint(lua_State* lua) {
  const Scheduler::TaskId id = luaL_checkinteger(lua, 1);
  const auto point = SyncPointNamed(CheckText(lua, 2));
  if (!point) {
    return luaL_error(lua,
                      "there is no point '%s'; use start, ready, stroke_start, stroke, "
                      "stroke_end, relax or end",
                      lua_tostring(lua, 2));
  }
  const double seconds = CheckFinite(lua, 3, "the time");
  if (std::abs(seconds) > Drama::kMaxTime) {
    return luaL_error(lua, "the time is out of range");
  }
  const int64_t offset = std::llround(seconds * Drama::kTicksPerSecond);
  return scheduler_.WaitUntil(lua, "wait_for", [this, id, point = *point, offset] {
    const int64_t tick = PointTick(id, point);
    return tick != SyncRecord::kUnknown && tick + offset <= tick_;
  });
}

// Tick at which a coroutine reaches a point; kUnknown: not known yet.
int64_t Run::PointTick(Scheduler::TaskId id, SyncPoint point) const {
  const auto began = scheduler_.Began(id);
  if (!began) {
    const Scheduler::Outcome* outcome = scheduler_.OutcomeOf(id);
    return outcome == nullptr ? 0 : outcome->tick;
  }
  if (point == SyncPoint::kStart) {
    return *began;
  }
  const auto record = std::find_if(state_.sync.begin(), state_.sync.end(),
                                   [id](const SyncRecord& r) { return r.coroutine == id; });
  return record == state_.sync.end() || point == SyncPoint::kEnd
             ? SyncRecord::kUnknown
             : record->ticks[static_cast<size_t>(point)];
}

// Adds the record of the running coroutine; nullptr: it already has one, or none is running.
SyncRecord* Run::BeginSync() {
  const Scheduler::TaskId id = scheduler_.running();
  const bool has_one = std::any_of(state_.sync.begin(), state_.sync.end(),
                                   [id](const SyncRecord& r) { return r.coroutine == id; });
  if (has_one || id == 0) {
    return nullptr;
  }
  SyncRecord& record = state_.sync.emplace_back();
  record.coroutine = id;
  return &record;
}

// The running coroutine does something whose points are known in advance.
void Run::NoteSync(const SyncTimes& times) {
  if (SyncRecord* record = BeginSync()) {
    for (size_t i = 0; i < times.size(); ++i) {
      record->ticks[i] = tick_ + std::llround(times[i] * Drama::kTicksPerSecond);
    }
  }
}

// The running coroutine waits for a task of the stage, which determines the points.
void Run::NoteTaskSync(stage::TaskId task) {
  if (SyncRecord* record = BeginSync()) {
    record->task = task;
    record->ticks.fill(SyncRecord::kUnknown);
  }
}

void Run::UpdateSync() {
  std::erase_if(state_.sync,
                [this](const SyncRecord& record) { return !scheduler_.Alive(record.coroutine); });
  for (SyncRecord& record : state_.sync) {
    if (record.task == 0) {
      continue;
    }
    const stage::TaskReport report = stage_.tasks().report(record.task);
    const bool is_over = report.over() || report.state == stage::TaskReport::State::kUnknown;
    for (size_t point = 0; point < record.ticks.size(); ++point) {
      const bool reached =
          is_over || (report.reached && point <= static_cast<size_t>(*report.reached));
      if (reached && record.ticks[point] == SyncRecord::kUnknown) {
        record.ticks[point] = tick_;
      }
    }
  }
}

// The line of the script that is running, or that started the running task.
std::string Run::PlaceNow(lua_State* lua) const {
  std::string place = PlaceOf(lua);
  return place.empty() ? scheduler_.StartedAt() : place;
}

// warn(message): reports a message to the author, with the line of the script
int Run::WarnAuthor(lua_State* lua) {
  const std::string where = PlaceNow(lua);
  on_error_(tick_, {where + ": " + std::string(CheckText(lua, 1)), ""});
  return 0;
}

// attempt() -> number: tasks of the calling coroutine may fail from now on; attempt(number): ends
// this
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

// note_task(actor, action, object's name or nil, begin, whether it failed, message, seconds
// waited): records a task that has ended
int Run::NoteTask(lua_State* lua) {
  const stage::Actor& actor = CheckActor(lua);
  const std::string_view action = CheckText(lua, 2);
  const std::string_view object = lua_isnil(lua, 3) ? std::string_view() : CheckText(lua, 3);
  const double began = CheckFinite(lua, 4, "the time");
  const std::string_view message = CheckText(lua, 6);
  const bool expected =
      std::find(attempts_.begin(), attempts_.end(), scheduler_.running()) != attempts_.end();
  TaskRecord record = {began,
                       TimeOf(tick_),
                       PlaceNow(lua),
                       actor.name,
                       std::string(action),
                       std::string(object),
                       lua_toboolean(lua, 5) != 0,
                       expected,
                       std::string(message),
                       false,
                       luaL_optnumber(lua, 7, 0.0)};
  on_task_(std::move(record));
  return 0;
}

// Records an action whose length is known when it begins.
void Run::NoteBlock(lua_State* lua, const stage::Actor& actor, std::string action, double seconds) {
  TaskRecord record;
  record.began = TimeOf(tick_);
  record.ended = record.began + seconds;
  record.where = PlaceNow(lua);
  record.actor = actor.name;
  record.action = std::move(action);
  on_task_(std::move(record));
}

// configure(whether time stops while tracking is lost, patience in seconds, length in seconds)
int Run::Configure(lua_State* lua) {
  if (!declaring_) {
    return luaL_error(lua, "drama: only while the script loads, not within main()");
  }
  declaring_->settings.hold_when_lost = lua_toboolean(lua, 1) != 0;
  declaring_->settings.patience = CheckFinite(lua, 2, "patience");
  declaring_->settings.length = CheckFinite(lua, 3, "length");
  return 0;
}

}  // namespace lararium::drama
