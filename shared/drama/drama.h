#pragma once

// A running drama: the curator's Lua script, which moves the actors of a stage
// in ticks of a 120th of a second. The script runs in a sandbox (sandbox.h) and
// speaks the words of lua/std.

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/log.h"
#include "shared/core/status.h"
#include "shared/stage/stage.h"

namespace lararium::drama {

struct DramaOptions {
  uint64_t seed = 1;                    // of math.random
  size_t memory_limit = 64 << 20;       // bytes that the script may hold
  int64_t instruction_limit = 1 << 20;  // that the script may run in one tick

  Status Validate() const;
};

// What went wrong in a script, and when. An error ended the coroutine that it
// happened in (a place that cannot be reached does not); the show went on.
struct ScriptError {
  double time = 0.0;      // of the drama, seconds
  std::string message;    // "drama.lua:12: ..."
  std::string traceback;  // one call per line; may be empty
};

// One thing that somebody was told to do with its body, and how it ended. What was
// stopped before its end is not told.
struct TaskRecord {
  double began = 0.0;  // of the drama, seconds
  double ended = 0.0;
  std::string where;   // "drama.lua:12"
  std::string actor;   // who
  std::string action;  // "walk_to", "take", "use stir", ...
  std::string object;  // with what; may be empty
  bool failed = false;
  bool expected = false;  // within attempt(): it may fail
  std::string message;    // why it failed; of a done one, what was not quite as asked
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

  // To the tick nearest to a time: the stage is then exactly as if the drama had
  // played until there, but for gazes at a visitor who moved. What coroutines did is
  // played again without drawing; a drama of tracks alone goes on from a checkpoint.
  virtual Status Seek(double time) = 0;

  virtual double time() const = 0;                          // seconds since the beginning
  virtual std::span<const ScriptError> errors() const = 0;  // until time(), oldest first
  // Likewise, in the order in which they ended; those that the script caught too.
  virtual std::span<const TaskRecord> tasks() const = 0;
};

}  // namespace lararium::drama
