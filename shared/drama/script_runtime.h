#pragma once

// One run of a script from its beginning: the Lua state, its coroutines and what they wait for.
// Internal to shared/drama.

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
  // Visitors of a group at whom actors look in this turn (ScriptRuntime::TakeTurns).
  std::vector<int> turn;
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

class ScriptRuntime;

// A function of the table `host`: takes and returns values on Lua's stack and raises Lua errors.
using HostFunction = int (*)(ScriptRuntime& run, lua_State* lua);

// One run of a script. A run is either played by Begin() and Tick(), or replayed by BeginAgain()
// and FollowTo(), which resume coroutines and answer recorded calls from the recording. The
// bindings of lua/std (host_bindings.h) use the functions of the second section.
class ScriptRuntime {
 public:
  using OnError = std::function<void(int64_t tick, const LuaError&)>;
  using OnTask = std::function<void(TaskRecord)>;

  // Borrows stage, recording and cues.
  ScriptRuntime(std::unique_ptr<Sandbox> sandbox,
                stage::Stage& stage,
                Recording& recording,
                CueLog& cues,
                OnError on_error,
                OnTask on_task);
  ScriptRuntime(const ScriptRuntime&) = delete;  // Lua keeps its address.
  ScriptRuntime& operator=(const ScriptRuntime&) = delete;

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

  // ---- for bindings ----

  stage::Stage& stage() { return stage_; }
  Scheduler& scheduler() { return scheduler_; }
  CueLog& cues() { return cues_; }
  RunState& state() { return state_; }
  // What the script has declared so far; nullptr: it may not declare anything now.
  Declared* declaring() { return declaring_.get(); }
  // Whether the running coroutine is the script itself while it loads.
  bool IsLoadingChunk() const { return loading_ && scheduler_.running() == chunk_; }

  // Calls a function and records it, or answers the call from the recording in a replay.
  int CallRecorded(lua_State* lua, int index, HostFunction function);

  void Report(const LuaError& error) { on_error_(tick_, error); }
  void Report(TaskRecord record) { on_task_(std::move(record)); }
  // Reports an action whose length in seconds is known when it begins.
  void NoteBlock(lua_State* lua, const stage::Actor& actor, std::string action, double seconds);
  // The line of the script that is running, or that started the running coroutine.
  std::string PlaceNow(lua_State* lua) const;

  // The running coroutine does something whose points are known in advance.
  void NoteSync(const SyncTimes& times);
  // The running coroutine waits for a task of the stage, which determines the points.
  void NoteTaskSync(stage::TaskId task);
  // Tick at which a coroutine reaches a point; SyncRecord::kUnknown: not known yet.
  int64_t PointTick(Scheduler::TaskId id, SyncPoint point) const;

  // Between the two calls, tasks of the running coroutine may fail. Returns the number to end with.
  int64_t BeginAttempt();
  void EndAttempt(int64_t attempt);
  bool IsAttempting() const;

 private:
  Status LoadStd();
  void PushHost(lua_State* lua);
  Status StartChunk(std::string_view script, const std::string& where);
  void StartMain();
  void SetVisitor(const Visitor& visitor);
  void TakeTurns(int64_t turn);
  void ApplyTracks();
  void UpdateTriggers();
  void HearMessages();
  void UpdateSync();
  SyncRecord* BeginSync();  // Null: the running coroutine has a record, or none is running.

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
  std::vector<glm::vec3> seen_;      // Visitors at whom actors may look in this tick.
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
