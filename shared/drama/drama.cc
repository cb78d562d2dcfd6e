#include "shared/drama/drama.h"

#include <algorithm>
#include <cmath>

#include "shared/drama/run.h"
#include "shared/drama/sandbox.h"

namespace lararium::drama {
namespace {

constexpr size_t kMaxScriptBytes = 1 << 20;
constexpr size_t kMaxErrors = 100;  // kept; the log has them all
// Of a drama of tracks: how often the stage is kept for seeking, and how many.
constexpr int64_t kCheckpointTicks = int64_t{10} * Drama::kTicksPerSecond;
constexpr size_t kMaxCheckpoints = 1000;
constexpr size_t kMaxTaskRecords = 4096;

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
    tasks_.clear();
    auto run = std::make_unique<Run>(
        std::move(sandbox), stage_,
        [this](int64_t tick, const LuaError& error) { Report(tick, error); },
        [this](TaskRecord record) {
          if (tasks_.size() < kMaxTaskRecords) {
            tasks_.push_back(std::move(record));
          }
        });
    LARARIUM_RETURN_IF_ERROR(run->Begin(script_, place_));
    run_ = std::move(run);
    played_until_ = std::max(played_until_, run_->tick());
    checkpoints_.clear();
    KeepCheckpoint();
    return Status();
  }

  void Tick() override {
    run_->Tick();
    played_until_ = std::max(played_until_, run_->tick());
    KeepCheckpoint();
  }

  Status Seek(double time) override {
    if (!(time >= 0.0 && time <= kMaxTime)) {
      return Status::Error(place_, "cannot seek to a time outside of the drama",
                           "choose one from 0 s to 24 h");
    }
    const int64_t target = std::llround(time * kTicksPerSecond);
    if (run_->only_tracks()) {
      GoToCheckpoint(target);
    } else if (target < run_->tick()) {
      LARARIUM_RETURN_IF_ERROR(Begin());
    }
    while (run_->tick() < target) {
      Tick();
    }
    return Status();
  }

  double time() const override { return TimeOf(run_->tick()); }
  std::span<const ScriptError> errors() const override { return errors_; }
  std::span<const TaskRecord> tasks() const override { return tasks_; }

 private:
  // Tracks say at any tick what is to be seen, but bodies remember: feet stand where
  // they were put. Coroutines cannot be kept; a drama with tasks is played again.
  void KeepCheckpoint() {
    if (run_->only_tracks() && checkpoints_.size() < kMaxCheckpoints &&
        run_->tick() == static_cast<int64_t>(checkpoints_.size()) * kCheckpointTicks) {
      checkpoints_.push_back(stage_.Save());
    }
  }

  // The last one before target, unless the drama has come nearer.
  void GoToCheckpoint(int64_t target) {
    const int64_t index =
        std::min(target / kCheckpointTicks, static_cast<int64_t>(checkpoints_.size()) - 1);
    const int64_t tick = index * kCheckpointTicks;
    if (run_->tick() > target || run_->tick() < tick) {
      stage_.Restore(checkpoints_[static_cast<size_t>(index)]);
      run_->ContinueFrom(tick);
    }
  }

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
  std::unique_ptr<Run> run_;
  std::vector<stage::Stage::Checkpoint> checkpoints_;  // one for each kCheckpointTicks
  std::vector<ScriptError> errors_;
  std::vector<TaskRecord> tasks_;
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
