#include "shared/drama/drama.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "shared/drama/recording.h"
#include "shared/drama/sandbox.h"
#include "shared/drama/script_runtime.h"
#include "shared/drama/timeline_text.h"

namespace lararium::drama {
namespace {

constexpr size_t kMaxScriptBytes = 16 << 20;
constexpr size_t kMaxErrors = 100;  // Kept in memory; the log has all of them.
constexpr size_t kMaxTaskRecords = 100'000;
// The state is first saved for seeking every kSaveTicks. When there are more than kMaxSaved states,
// every other one is dropped and the interval doubles.
constexpr int64_t kSaveTicks = int64_t{2} * Drama::kTicksPerSecond;
constexpr size_t kMaxSaved = 1200;

// A list of events that survives seeking backwards: events later than the present are hidden and
// appear again when they happen again.
template <typename T>
class History {
 public:
  explicit History(size_t limit) : limit_(limit) {}

  // Returns false if the event was already in the list.
  bool Add(T item) {
    if (count_ < items_.size()) {
      ++count_;
      return false;
    }
    if (items_.size() < limit_) {
      items_.push_back(std::move(item));
      ++count_;
    }
    return true;
  }
  size_t count() const { return count_; }
  void GoTo(size_t count) { count_ = count; }
  void Truncate() { items_.resize(count_); }
  std::span<const T> items() const { return std::span(items_).first(count_); }

 private:
  std::vector<T> items_;
  size_t count_ = 0;
  size_t limit_;
};

// A saved state for seeking.
struct Moment {
  int64_t tick = 0;
  stage::Stage::Checkpoint stage;
  RunState run;
  Recording::Position script;
  size_t errors = 0;
  size_t tasks = 0;
};

class LuaDrama : public Drama {
 public:
  LuaDrama(std::string_view script,
           std::string where,
           stage::Stage& stage,
           const DramaOptions& options,
           Log& log)
      : script_(script), place_(std::move(where)), stage_(stage), options_(options), log_(log) {}

  // Starts from the beginning and forgets the past.
  Status Begin() {
    LARARIUM_ASSIGN_OR_RETURN(std::unique_ptr<Sandbox> sandbox, MakeSandbox());
    stage_.Reset();
    script_of_coroutines_.reset();
    recording_ = {};
    if (forgets()) {
      recording_.Close();
    }
    cues_ = {};
    changes_ = 0;
    errors_ = History<ScriptError>(kMaxErrors);
    tasks_ = History<TaskRecord>(forgets() ? 0 : kMaxTaskRecords);
    moments_.clear();
    save_ticks_ = kSaveTicks;
    run_ = MakeRun(std::move(sandbox));
    if (const Status status = run_->Begin(script_, place_); !status.ok()) {
      run_.reset();
      return status;
    }
    played_until_ = std::max<int64_t>(played_until_, 0);
    Save();
    return Status();
  }

  void Tick() override {
    run_->Tick(VisitorOf(run_->tick() + 1));
    ++ticks_;
    if (recording_.changes() != changes_) {
      changes_ = recording_.changes();
      ForgetFuture();
    }
    played_until_ = std::max(played_until_, run_->tick());
    Save();
  }

  void SetVisitor(const Visitor& visitor) override {
    std::string keys = std::move(visitor_.keys);  // Keys that the drama has not seen yet.
    visitor_ = visitor;
    if (!visitor.tracked) {
      visitor_.position = last_seen_.position;
      visitor_.direction = last_seen_.direction;
    }
    last_seen_ = visitor_;
    std::string_view more = visitor.keys;
    for (std::string_view key = TakeKey(more); !key.empty(); key = TakeKey(more)) {
      AddKey(key, keys);
    }
    visitor_.keys = std::move(keys);
  }

  void SetVisitorLog(VisitorLog log) override {
    visitors_ = std::move(log);
    follows_log_ = true;
    const double now = time();
    if (Begin().ok()) {
      (void)Seek(now).ok();
    }
  }
  Status ReviseVisitorLog(int64_t tick, std::span<const VisitorLog::Entry> entries) override {
    CHECK(follows_log_ && tick >= 1);
    Status status;
    if (run_->tick() >= tick) {
      status = Seek(TimeOf(tick - 1));
      ForgetFuture();
    } else {
      while (moments_.size() > 1 && moments_.back().tick >= tick) {
        moments_.pop_back();  // A future that will not come.
      }
    }
    visitors_.Truncate(tick - 1);
    for (const VisitorLog::Entry& entry : entries) {
      visitors_.Set(entry.tick, entry.visitor);
    }
    return status;
  }
  void SetPastVisitor(VisitorLog log, double until) override {
    if (follows_log_ || forgets()) {
      return;
    }
    CHECK(run_->tick() == 0);
    visitors_ = std::move(log);
    visited_until_ = std::llround(until * kTicksPerSecond);
  }
  const VisitorLog& visitor_log() const override { return visitors_; }

  Status Seek(double time) override {
    if (!(time >= 0.0 && time <= kMaxTime)) {
      return Status::Error(place_, "cannot seek to a time outside of the drama",
                           "choose one from 0 s to 24 h");
    }
    const int64_t target = std::llround(time * kTicksPerSecond);
    const Moment* moment = MomentBefore(target);
    if (target < run_->tick() || (moment != nullptr && moment->tick > run_->tick())) {
      if (moment == nullptr) {
        LARARIUM_RETURN_IF_ERROR(Begin());
      } else if (!GoTo(*moment)) {
        // Should not happen. Plays everything again.
        log_.Warn("{}: seeking plays the drama again from its beginning", place_);
        LARARIUM_RETURN_IF_ERROR(Begin());
      }
    }
    seeking_ = true;
    while (run_->tick() < target) {
      Tick();
    }
    seeking_ = false;
    return Status();
  }

  Status Glance(double time, const std::function<void()>& look) override {
    const int64_t now = run_->tick();
    const int64_t known = std::max(played_until_, now);
    CueLog cues = cues_;
    LARARIUM_RETURN_IF_ERROR(Seek(time));
    look();
    if (played_until_ > known) {
      LARARIUM_RETURN_IF_ERROR(Seek(TimeOf(known)));
      ForgetFuture();
    }
    cues_ = std::move(cues);
    return Seek(TimeOf(now));
  }

  Status Reload(std::string_view script) override {
    LARARIUM_RETURN_IF_ERROR(CheckSize(script, place_));
    const double now = time();
    const std::string old = std::exchange(script_, std::string(script));
    played_until_ = -1;
    Status status = Begin();
    if (!status.ok()) {
      script_ = old;
      LARARIUM_RETURN_IF_ERROR(Begin());  // The old script has compiled before.
    }
    LARARIUM_RETURN_IF_ERROR(Seek(now));
    return status;
  }

  Status PlayAgain() override {
    const double now = time();
    played_until_ = -1;
    LARARIUM_RETURN_IF_ERROR(Begin());
    return Seek(now);
  }

  bool holds() const override {
    const double lost = TimeOf(run_->state().lost_ticks);
    return settings().hold_when_lost && !follows_log_ && !visitor_.tracked &&
           lost >= settings().patience;
  }
  const DramaSettings& settings() const override { return run_->declared()->settings; }

  int64_t played_ticks() const override { return ticks_; }
  double time() const override { return TimeOf(run_->tick()); }
  std::span<const ScriptError> errors() const override { return errors_.items(); }
  std::span<const TaskRecord> tasks() const override { return tasks_.items(); }
  std::span<const CueRecord> cues() const override { return cues_.cues; }

  static Status CheckSize(std::string_view script, const std::string& where) {
    return script.size() <= kMaxScriptBytes
               ? Status()
               : Status::Error(where, "the script is longer than 16 MiB");
  }

 private:
  Result<std::unique_ptr<Sandbox>> MakeSandbox() const {
    return Sandbox::Create(options_.memory_limit, options_.instruction_limit, options_.seed);
  }
  std::unique_ptr<ScriptRuntime> MakeRun(std::unique_ptr<Sandbox> sandbox) {
    return std::make_unique<ScriptRuntime>(
        std::move(sandbox), stage_, recording_, cues_,
        [this](int64_t tick, const LuaError& error) { Report(tick, error); },
        [this](TaskRecord record) { tasks_.Add(std::move(record)); });
  }

  bool forgets() const { return options_.past == Past::kForgotten; }

  // The latest saved state that is not after a tick; nullptr: none.
  const Moment* MomentBefore(int64_t tick) const {
    const auto behind =
        std::upper_bound(moments_.begin(), moments_.end(), tick,
                         [](int64_t t, const Moment& moment) { return t < moment.tick; });
    return behind == moments_.begin() ? nullptr : &*(behind - 1);
  }

  // The visitor of a tick: from the log, from the recorded past, or the present visitor. If the
  // present visitor differs from the recorded one, a new future begins.
  Visitor VisitorOf(int64_t tick) {
    const bool is_known = tick <= visited_until_;
    if (follows_log_ || (is_known && (options_.past == Past::kRepeated || seeking_))) {
      return visitors_.At(tick);
    }
    Visitor visitor = visitor_;
    visitor_.keys.clear();
    if (forgets()) {
      return visitor;
    }
    if (is_known && visitors_.At(tick) != visitor) {
      ForgetFuture();
    }
    if (tick > visited_until_) {
      visitors_.Set(tick, visitor);
      visited_until_ = tick;
    }
    return visitor;
  }

  // Drops everything recorded after the present tick.
  void ForgetFuture() {
    const int64_t now = run_->tick();
    recording_.Truncate();
    errors_.Truncate();
    tasks_.Truncate();
    if (!follows_log_) {
      visitors_.Truncate(now);
      visited_until_ = std::min(visited_until_, now);
    }
    while (moments_.size() > 1 && moments_.back().tick > now) {
      moments_.pop_back();
    }
    played_until_ = std::min(played_until_, now);
  }

  void Save() {
    const int64_t now = run_->tick();
    if (now % kSaveTicks != 0) {
      return;
    }
    stage_.Settle();  // Also if nothing is saved, so that saving does not change the result.
    const bool is_known = !moments_.empty() && moments_.back().tick >= now;
    if (now % save_ticks_ != 0 || is_known || recording_.closed()) {
      return;
    }
    moments_.push_back(
        {now, stage_.Save(), run_->state(), run_->followed(), errors_.count(), tasks_.count()});
    if (moments_.size() > kMaxSaved) {
      save_ticks_ *= 2;
      std::erase_if(moments_,
                    [this](const Moment& moment) { return moment.tick % save_ticks_ != 0; });
    }
  }

  // The script that is replayed to restore coroutines: without the timeline items, which the host
  // has already read and plays itself.
  const std::string& ScriptOfCoroutines() {
    if (!script_of_coroutines_) {
      std::vector<LaneKind> of_host;
      for (const LaneSpec& lane : LaneSpecs()) {
        if (lane.by_host) {
          of_host.push_back(lane.kind);
        }
      }
      const Result<TimelineText> text = TimelineText::Read(script_, place_);
      script_of_coroutines_ = text.ok() ? text->WithoutItems(of_host) : script_;
    }
    return *script_of_coroutines_;
  }

  // Coroutines only run forward: to go back, the script is replayed from its beginning.
  bool BringScriptTo(const Recording::Position& position) {
    if (run_->followed() == position) {
      recording_.GoTo(position);
      return true;
    }
    if (run_->followed().resumes < position.resumes && run_->FollowTo(position)) {
      return true;
    }
    Result<std::unique_ptr<Sandbox>> sandbox = MakeSandbox();
    if (!sandbox.ok()) {
      return false;
    }
    std::unique_ptr<ScriptRuntime> run = MakeRun(*std::move(sandbox));
    if (!run->BeginAgain(ScriptOfCoroutines(), place_, run_->declared()).ok() ||
        !run->FollowTo(position)) {
      return false;
    }
    run_ = std::move(run);
    return true;
  }

  bool GoTo(const Moment& moment) {
    if (!BringScriptTo(moment.script)) {
      return false;
    }
    stage_.Restore(moment.stage);
    run_->Restore(moment.run, moment.tick);
    errors_.GoTo(moment.errors);
    tasks_.GoTo(moment.tasks);
    return true;
  }

  void Report(int64_t tick, const LuaError& error) {
    const bool is_new = errors_.Add({TimeOf(tick), error.message, error.traceback});
    if (is_new && tick > played_until_) {
      log_.Error("{}\n{}", error.message, error.traceback);
    }
  }

  std::string script_;
  std::optional<std::string> script_of_coroutines_;
  std::string place_;
  stage::Stage& stage_;
  DramaOptions options_;
  Log& log_;
  Recording recording_;
  CueLog cues_;
  int changes_ = 0;  // Last value of Recording::changes().
  std::unique_ptr<ScriptRuntime> run_;
  std::vector<Moment> moments_;  // Sorted by tick.
  int64_t save_ticks_ = kSaveTicks;
  History<ScriptError> errors_{kMaxErrors};
  History<TaskRecord> tasks_{kMaxTaskRecords};
  int64_t ticks_ = 0;          // played_ticks()
  int64_t played_until_ = -1;  // Latest tick that has been played.
  Visitor visitor_;            // The present visitor.
  Visitor last_seen_;
  VisitorLog visitors_;        // The recorded visitor, or the log that is followed.
  int64_t visited_until_ = 0;  // Latest tick with a recorded visitor.
  bool follows_log_ = false;
  bool seeking_ = false;
};

}  // namespace

Status DramaOptions::Validate() const {
  if (memory_limit < (1 << 20) || uint64_t{memory_limit} > (uint64_t{1} << 32)) {
    return Status::Error("drama", "the memory limit must lie between 1 MiB and 4 GiB");
  }
  if (instruction_limit < 100'000 || instruction_limit > (int64_t{1} << 40)) {
    return Status::Error("drama", "the instruction limit must be at least 100000");
  }
  return Status();
}

Result<std::unique_ptr<Drama>> Drama::Create(std::string_view script,
                                             std::string where,
                                             stage::Stage& stage,
                                             const DramaOptions& options,
                                             Log& log) {
  LARARIUM_RETURN_IF_ERROR(options.Validate());
  LARARIUM_RETURN_IF_ERROR(LuaDrama::CheckSize(script, where));
  auto drama = std::make_unique<LuaDrama>(script, std::move(where), stage, options, log);
  LARARIUM_RETURN_IF_ERROR(drama->Begin());
  return std::unique_ptr<Drama>(std::move(drama));
}

}  // namespace lararium::drama
