#include "shared/drama/script_runtime.h"

#include <algorithm>
#include <cmath>

#include "shared/core/check.h"
#include "shared/drama/host_bindings.h"
#include "shared/drama/lua_binding.h"
#include "shared/drama/std_scripts.h"

namespace lararium::drama {
namespace {

// Actors look at the next visitor of a group after this time.
constexpr int64_t kTurnTicks = int64_t{6} * Drama::kTicksPerSecond;
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

ScriptRuntime::ScriptRuntime(std::unique_ptr<Sandbox> sandbox,
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

Status ScriptRuntime::Begin(std::string_view script, const std::string& where) {
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

void ScriptRuntime::Tick(const Visitor& visitor) {
  ++tick_;
  sandbox_->limits().Refill();
  SetVisitor(visitor);
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

void ScriptRuntime::SetVisitor(const Visitor& visitor) {
  state_.visitor = visitor;
  seen_.clear();
  const int64_t turn = tick_ / kTurnTicks;
  if (visitor.group != nullptr) {
    TakeTurns(turn);
  } else if (visitor.tracked) {
    seen_.push_back(visitor.position);
  }
  state_.lost_ticks = state_.visitor.tracked ? 0 : state_.lost_ticks + 1;
  stage_.SetVisitors(seen_, static_cast<size_t>(turn));
}

// Visitors who are tracked when a turn begins, or as the first ones after all were lost, are looked
// at until it ends, also if they are lost meanwhile.
void ScriptRuntime::TakeTurns(int64_t turn) {
  Visitor& visitor = state_.visitor;
  std::vector<int>& looked_at = state_.turn;
  if (tick_ % kTurnTicks == 0 || looked_at.empty()) {
    looked_at.clear();
    ForEachTracked(visitor, [&](const GroupVisitor& one) { looked_at.push_back(one.number); });
  }
  std::erase_if(looked_at, [&](int number) {
    return std::none_of(visitor.group->begin(), visitor.group->end(),
                        [&](const GroupVisitor& one) { return one.number == number; });
  });
  const size_t first = looked_at.empty() ? 0 : static_cast<size_t>(turn) % looked_at.size();
  visitor.tracked = false;
  for (const GroupVisitor& one : *visitor.group) {
    visitor.tracked = visitor.tracked || one.tracked;
    if (std::find(looked_at.begin(), looked_at.end(), one.number) == looked_at.end()) {
      continue;
    }
    if (seen_.size() == first) {
      visitor.position = one.position;
      visitor.direction = one.direction;
    }
    seen_.push_back(one.position);
  }
}

Status ScriptRuntime::StartChunk(std::string_view script, const std::string& where) {
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

void ScriptRuntime::StartMain() {
  sandbox_->limits().Refill();
  Protected(sandbox_->lua(), [this](lua_State* lua) {
    if (lua_getglobal(lua, "main") == LUA_TFUNCTION) {
      scheduler_.Start(lua);
    }
  });
}

Status ScriptRuntime::LoadStd() {
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

void ScriptRuntime::ApplyTracks() {
  for (const Track& track : declared_->timeline.tracks) {
    if (stage::Actor* actor = stage_.Find(track.actor)) {
      ApplyTrack(track.segments, TimeOf(tick_), actor->state);
    }
  }
}

void ScriptRuntime::UpdateTriggers() {
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

void ScriptRuntime::HearMessages() {
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

Status ScriptRuntime::BeginAgain(std::string_view script,
                                 const std::string& where,
                                 std::shared_ptr<const Declared> declared) {
  LARARIUM_RETURN_IF_ERROR(LoadStd());
  declared_ = std::move(declared);
  LARARIUM_RETURN_IF_ERROR(StartChunk(script, where));
  loading_ = true;
  return Status();
}

bool ScriptRuntime::FollowTo(const Recording::Position& position) {
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

void ScriptRuntime::Restore(const RunState& state, int64_t tick) {
  state_ = state;
  tick_ = tick;
}

// ---- the host ----

void ScriptRuntime::PushHost(lua_State* lua) {
  lua_newtable(lua);
  HostTable table(*this, lua);
  AddTaskBindings(table);
  AddTimelineBindings(table);
  AddVisitorBindings(table);
  AddActorBindings(table);
  AddObjectBindings(table);
  AddLightBindings(table);
  AddSoundBindings(table);
}

int ScriptRuntime::CallRecorded(lua_State* lua, int index, HostFunction function) {
  if (following_) {
    return recording_.Replay(lua, index);
  }
  int results = 0;
  try {
    results = function(*this, lua);
  } catch (...) {  // Lua raises its errors as exceptions.
    recording_.NoteError(lua, index);
    throw;
  }
  recording_.NoteCall(lua, index, results);
  return results;
}

void HostTable::Push(const char* name, lua_CFunction function) {
  CHECK(count_ <= 255);  // The recording stores the function in a byte.
  lua_pushlightuserdata(lua_, &runtime_);
  lua_pushinteger(lua_, count_++);
  lua_pushcclosure(lua_, function, 2);
  lua_setfield(lua_, -2, name);
}

// ---- what the bindings call ----

int64_t ScriptRuntime::PointTick(Scheduler::TaskId id, SyncPoint point) const {
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

SyncRecord* ScriptRuntime::BeginSync() {
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

void ScriptRuntime::NoteSync(const SyncTimes& times) {
  if (SyncRecord* record = BeginSync()) {
    for (size_t i = 0; i < times.size(); ++i) {
      record->ticks[i] = tick_ + std::llround(times[i] * Drama::kTicksPerSecond);
    }
  }
}

void ScriptRuntime::NoteTaskSync(stage::TaskId task) {
  if (SyncRecord* record = BeginSync()) {
    record->task = task;
    record->ticks.fill(SyncRecord::kUnknown);
  }
}

void ScriptRuntime::UpdateSync() {
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

std::string ScriptRuntime::PlaceNow(lua_State* lua) const {
  std::string place = PlaceOf(lua);
  return place.empty() ? scheduler_.StartedAt() : place;
}

void ScriptRuntime::NoteBlock(lua_State* lua,
                              const stage::Actor& actor,
                              std::string action,
                              double seconds) {
  TaskRecord record;
  record.began = TimeOf(tick_);
  record.ended = record.began + seconds;
  record.where = PlaceNow(lua);
  record.actor = actor.name;
  record.action = std::move(action);
  on_task_(std::move(record));
}

int64_t ScriptRuntime::BeginAttempt() {
  attempts_.push_back(scheduler_.running());
  return scheduler_.running();
}

void ScriptRuntime::EndAttempt(int64_t attempt) {
  const auto found = std::find(attempts_.begin(), attempts_.end(), attempt);
  if (found != attempts_.end()) {
    attempts_.erase(found);
  }
}

bool ScriptRuntime::IsAttempting() const {
  return std::find(attempts_.begin(), attempts_.end(), scheduler_.running()) != attempts_.end();
}

}  // namespace lararium::drama
