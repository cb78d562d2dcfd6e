#pragma once

// Records the results of all calls of a script into the host and the order in which its coroutines
// resumed. Coroutines cannot be copied; with the recording they are brought to an earlier state by
// running the script again without a stage: every call returns its recorded result, and every
// coroutine resumes when it did.

#include <cstdint>
#include <string>
#include <vector>

struct lua_State;

namespace lararium::drama {

class Recording {
 public:
  static constexpr size_t kMaxBytes = 64 << 20;

  // Progress of a run.
  struct Position {
    size_t bytes = 0;    // Offset into the recorded calls.
    size_t resumes = 0;  // Index into the recorded resumes.
    friend bool operator==(const Position&, const Position&) = default;
  };
  struct Resume {
    int64_t tick = 0;
    int64_t task = 0;
    friend bool operator==(const Resume&, const Resume&) = default;
  };

  // ---- while the drama is played ----
  //
  // A time that was played before is compared with the recording. At the first difference a new
  // future begins: the rest of the recording is dropped.

  // Record the topmost `results` values as the results of a call, or the error on top of the stack.
  void NoteCall(lua_State* lua, int function, int results);
  void NoteError(lua_State* lua, int function);
  void NoteResume(int64_t tick, int64_t task);
  // Whether recording has stopped: the memory is full, or a call ended in a way that cannot be
  // repeated.
  bool closed() const { return closed_; }
  // Stops recording until Truncate().
  void Close() { closed_ = true; }
  // Number of times that a new future has begun.
  int changes() const { return changes_; }

  // ---- while the script is run again ----

  Position position() const { return at_; }
  void GoTo(const Position& position) { at_ = position; }
  // Drops everything after the position.
  void Truncate();
  const Resume& NextResume() { return resumes_[at_.resumes++]; }
  // Pushes the recorded results of a call, or raises its recorded error. If the script calls
  // another function than before, sets diverged() and raises an error.
  int Replay(lua_State* lua, int function);
  bool diverged() const { return diverged_; }
  void ForgetDivergence() { diverged_ = false; }

 private:
  void Append();
  void AppendText(const char* text, size_t size);

  std::vector<uint8_t> calls_;
  std::vector<Resume> resumes_;
  std::vector<uint8_t> entry_;  // The entry that is being written.
  Position at_;
  bool closed_ = false;
  bool diverged_ = false;
  int changes_ = 0;
};

}  // namespace lararium::drama
