#pragma once

// A running drama: the curator's Lua script, which moves the actors of a stage in ticks of 1/120 s.
// The script runs in a sandbox (sandbox.h) and uses the functions of lua/std.

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "shared/core/log.h"
#include "shared/core/status.h"
#include "shared/drama/visitor.h"
#include "shared/stage/stage.h"

namespace lararium::drama {

// What a drama remembers of its past.
enum class Past {
  // Only its errors, so memory does not grow with time. Seeking backwards plays from the beginning.
  kForgotten,
  // Seeking backwards is fast. After it the present visitor counts, as in live play.
  kKept,
  // Like kKept, but the recorded visitor is repeated up to the last moment that was played. For the
  // editor.
  kRepeated,
};

struct DramaOptions {
  uint64_t seed = 1;                    // Seed of math.random.
  size_t memory_limit = 64 << 20;       // Limit of the script's memory, bytes.
  int64_t instruction_limit = 1 << 20;  // Limit of Lua instructions per tick.
  Past past = Past::kKept;

  Status Validate() const;
};

// An error of a script. It ended its coroutine, except for warnings such as an unreachable place;
// the drama continued.
struct ScriptError {
  double time = 0.0;      // Time of the drama, seconds.
  std::string message;    // "drama.lua:12: ..."
  std::string traceback;  // One call per line; may be empty.
};

// Settings of the whole drama, from the script's call drama{...}.
struct DramaSettings {
  bool hold_when_lost = false;  // Time stops while tracking is lost.
  double patience = 1.0;        // Seconds of lost tracking before time stops.
  double length = 0.0;          // Length of the story, seconds; 0: unknown.
};

// One task of an actor and its result, for the scripted part of the timeline. A task that was
// stopped early is recorded only if its length was known at its start (speech, gestures, looks).
struct TaskRecord {
  double began = 0.0;  // Time of the drama, seconds.
  double ended = 0.0;
  std::string where;  // "drama.lua:12"
  std::string actor;
  std::string action;  // "walk_to", "take", "use stir", "say salvete", ...
  std::string object;  // May be empty.
  bool failed = false;
  bool expected = false;       // The task ran within attempt(), so it may fail.
  std::string message;         // Why it failed, or how the result differs from the request.
  bool from_timeline = false;  // The source is an item of track{...}, not a call of the script.
  double waited = 0.0;         // Seconds before the task could start.
};

// A trigger that a line of the script has armed.
struct CueRecord {
  std::string where;   // "drama.lua:12"
  std::string kind;    // "near", "looks_at", "marker", ...
  std::string name;    // Name of the marker or key.
  bool fired = false;  // True if it fired at least once.

  friend bool operator==(const CueRecord&, const CueRecord&) = default;
};

class Drama {
 public:
  static constexpr int kTicksPerSecond = 120;
  static constexpr double kMaxTime = 24 * 3600.0;  // Limit of Seek(), seconds.

  // Runs the script's chunk and then main() up to its first wait. Error: the chunk does not compile
  // (the message has file and line) or the options are invalid. Later problems are in errors().
  // Messages call the script `where`. Borrows stage and log, which must outlive the drama; resets
  // the stage.
  static Result<std::unique_ptr<Drama>> Create(std::string_view script,
                                               std::string where,
                                               stage::Stage& stage,
                                               const DramaOptions& options,
                                               Log& log);
  virtual ~Drama() = default;

  // Plays one tick.
  virtual void Tick() = 0;

  // Sets what the visitor does from the next tick on. Keys count for one tick only.
  virtual void SetVisitor(const Visitor& visitor) = 0;
  // From the beginning on, replaces SetVisitor() by a recorded visitor.
  virtual void SetVisitorLog(VisitorLog log) = 0;
  // Replaces what a visitor log that is followed says from a tick (at least 1) on. If the tick was
  // played already, the drama seeks to the one before it. For a drama that several devices play
  // together: news of the past are late, and change it.
  virtual Status ReviseVisitorLog(int64_t tick, std::span<const VisitorLog::Entry> entries) = 0;
  // Sets what the visitor did until a time (seconds), as recorded by another drama. Seeking up to
  // there repeats it; afterwards SetVisitor() counts. Call it before anything is played. No effect
  // while a visitor log is followed or with Past::kForgotten.
  virtual void SetPastVisitor(VisitorLog log, double until) = 0;
  // The visitor so far; empty with Past::kForgotten.
  virtual const VisitorLog& visitor_log() const = 0;

  // Goes to the tick nearest to a time. The stage is then exactly as if the drama had been played
  // to there. Unless the past is forgotten, a time that was played before is reached from a saved
  // state: the stage is restored, the script's coroutines are replayed against recorded results
  // (recording.h), and only the last seconds are played again.
  virtual Status Seek(double time) = 0;

  // Seeks to a time, calls `look` and returns. Leaves no trace: a time that had not been played
  // before is not remembered afterwards. `look` is not called if seeking fails.
  virtual Status Glance(double time, const std::function<void()>& look) = 0;

  // Replaces the script and seeks to the present time. On an error the old script continues.
  virtual Status Reload(std::string_view script) = 0;

  // Plays the script again to the present time, after the stage has changed.
  virtual Status PlayAgain() = 0;

  // Whether time must stop because tracking is lost (DramaSettings::hold_when_lost).
  virtual bool holds() const = 0;
  virtual const DramaSettings& settings() const = 0;

  // Number of ticks that were computed, including those of seeking: a measure of its cost.
  virtual int64_t played_ticks() const = 0;
  virtual double time() const = 0;  // Seconds since the beginning.
  // Errors up to time(), oldest first.
  virtual std::span<const ScriptError> errors() const = 0;
  // Tasks that ended up to time(), in the order of their ends, including failures that the script
  // caught. Empty with Past::kForgotten.
  virtual std::span<const TaskRecord> tasks() const = 0;
  // All triggers that were armed since the script was loaded, one per line and kind. Seeking does
  // not remove any.
  virtual std::span<const CueRecord> cues() const = 0;
};

}  // namespace lararium::drama
