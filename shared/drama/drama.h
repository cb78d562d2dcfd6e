#pragma once

// A running drama: the curator's Lua script, which moves the actors of a stage
// in ticks of a 120th of a second. The script runs in a sandbox (sandbox.h) and
// speaks the words of lua/std.

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/log.h"
#include "shared/core/status.h"
#include "shared/drama/visitor.h"
#include "shared/stage/stage.h"

namespace lararium::drama {

// What a drama knows of what was.
enum class Past {
  // Nothing but its errors: it takes no more memory however long it plays. Going back plays again
  // from the beginning.
  kForgotten,
  // Going back is quick, and the visitor does there what they do now.
  kKept,
  // The visitor does again what they did, until the last moment that was played: for whoever edits.
  kRepeated,
};

struct DramaOptions {
  uint64_t seed = 1;                    // of math.random
  size_t memory_limit = 64 << 20;       // bytes that the script may hold
  int64_t instruction_limit = 1 << 20;  // that the script may run in one tick
  Past past = Past::kKept;

  Status Validate() const;
};

// What went wrong in a script, and when. An error ended the coroutine that it
// happened in (a place that cannot be reached does not); the show went on.
struct ScriptError {
  double time = 0.0;      // of the drama, seconds
  std::string message;    // "drama.lua:12: ..."
  std::string traceback;  // one call per line; may be empty
};

// What a script says of its drama as a whole: drama{...}.
struct DramaSettings {
  bool hold_when_lost = false;  // time stands still while tracking is lost
  double patience = 1.0;        // seconds that it may be lost before that
  double length = 0.0;          // seconds after which the story is told; 0: nobody said
};

// One thing that somebody was told to do, and how it ended: what a timeline shows of the
// scripted part. What was stopped before its end is told only where its length is known
// when it begins (speech, gestures, looks).
struct TaskRecord {
  double began = 0.0;  // of the drama, seconds
  double ended = 0.0;
  std::string where;   // "drama.lua:12"
  std::string actor;   // who
  std::string action;  // "walk_to", "take", "use stir", "say salvete", ...
  std::string object;  // with what; may be empty
  bool failed = false;
  bool expected = false;       // within attempt(): it may fail
  std::string message;         // why it failed; of a done one, what was not quite as asked
  bool from_timeline = false;  // an item of track{...} told it; else the script
  double waited = 0.0;         // seconds until it was its turn
};

// What a script has waited for: a trigger that one of its lines armed.
struct CueRecord {
  std::string where;   // "drama.lua:12"
  std::string kind;    // "near", "looks_at", "marker", ...
  std::string name;    // of the marker or the key
  bool fired = false;  // at least once

  friend bool operator==(const CueRecord&, const CueRecord&) = default;
};

class Drama {
 public:
  static constexpr int kTicksPerSecond = 120;
  static constexpr double kMaxTime = 24 * 3600.0;  // seconds, of Seek()

  // Runs the script's chunk and main() up to its first wait. Fails only where
  // the chunk does not compile (the message has file and line) or options are
  // wrong; what goes wrong later is in errors(). place: what messages call the
  // script. Borrows stage and log, which must outlive it; resets the stage.
  static Result<std::unique_ptr<Drama>> Create(std::string_view script,
                                               std::string place,
                                               stage::Stage& stage,
                                               const DramaOptions& options,
                                               Log& log);
  virtual ~Drama() = default;

  // The next tick.
  virtual void Tick() = 0;

  // What the visitor does from the next tick on. Keys count in one tick.
  virtual void SetVisitor(const Visitor& visitor) = 0;
  // Instead of all that: a recorded visitor, from the beginning on.
  virtual void SetVisitorLog(VisitorLog log) = 0;
  // What they have done until a time (seconds), as another drama noted it: seeking until there
  // plays it, and from then on they are what SetVisitor says. Before anything is played; does
  // nothing where a recorded visitor is followed or the past is forgotten.
  virtual void SetPastVisitor(VisitorLog log, double until) = 0;
  // What they have done so far; of a past that is forgotten, nothing.
  virtual const VisitorLog& visitor_log() const = 0;

  // To the tick nearest to a time: the stage is then exactly as it was, or as if the drama
  // had played until there. What was played before is, unless the past is forgotten, not played
  // again but for the last seconds before a time: the stage is restored, and the script's
  // coroutines are run again against what they were told (recording.h).
  virtual Status Seek(double time) = 0;

  // Seeks to a time, calls look and comes back, and it is as if nothing had been: what was never
  // played before is not known afterwards either. Where it cannot be sought, look is not called.
  virtual Status Glance(double time, const std::function<void()>& look) = 0;

  // Another script, sought to the same time. On an error the old one goes on.
  virtual Status Reload(std::string_view script) = 0;

  // The same script to the same time, on a stage that is another now: as if it always had been.
  virtual Status PlayAgain() = 0;

  // Whether time is to stand still: tracking is lost, and the author wants that.
  virtual bool holds() const = 0;
  virtual const DramaSettings& settings() const = 0;

  // How often the stage went on by a tick since it was made: what playing and seeking cost.
  virtual int64_t played_ticks() const = 0;
  virtual double time() const = 0;                          // seconds since the beginning
  virtual std::span<const ScriptError> errors() const = 0;  // until time(), oldest first
  // Likewise, in the order in which they ended; those that the script caught too. None where the
  // past is forgotten.
  virtual std::span<const TaskRecord> tasks() const = 0;
  // Whatever was armed since the script began, once for each line and kind, whatever was
  // played since.
  virtual std::span<const CueRecord> cues() const = 0;
};

}  // namespace lararium::drama
