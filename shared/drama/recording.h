#pragma once

// What a script was told and when it went on, so that its coroutines, which cannot be
// copied, can be brought to where they were by running the script again without a stage:
// every call into the host gives what it gave, and every coroutine goes on when it did.

#include <cstdint>
#include <string>
#include <vector>

struct lua_State;

namespace lararium::drama {

class Recording {
 public:
  static constexpr size_t kMaxBytes = 64 << 20;

  // Up to where a run has come.
  struct Position {
    size_t bytes = 0;    // of calls
    size_t resumes = 0;  // of coroutines
    friend bool operator==(const Position&, const Position&) = default;
  };
  struct Resume {
    int64_t tick = 0;
    int64_t task = 0;
    friend bool operator==(const Resume&, const Resume&) = default;
  };

  // ---- while the drama is played ----
  //
  // Where it has been played before, what happens is compared with what is recorded; if
  // it is anything else, a new future begins: what was recorded behind it is dropped.

  // The topmost results of a call, or the error on top of the stack.
  void NoteCall(lua_State* lua, int function, int results);
  void NoteError(lua_State* lua, int function);
  void NoteResume(int64_t tick, int64_t task);
  // From here on it cannot be played again: its memory is full, or a call ended in a way
  // that cannot be repeated.
  bool closed() const { return closed_; }
  // Nothing is recorded, until what was is forgotten.
  void Close() { closed_ = true; }
  // How often a new future has begun.
  int changes() const { return changes_; }

  // ---- while the script is run again ----

  Position position() const { return at_; }
  void GoTo(const Position& position) { at_ = position; }
  // Forgets what lies behind the position.
  void Truncate();
  const Resume& NextResume() { return resumes_[at_.resumes++]; }
  // Pushes what a call gave, or raises its error. A script that calls something else
  // than it did is an error that sets diverged().
  int Replay(lua_State* lua, int function);
  bool diverged() const { return diverged_; }
  void ForgetDivergence() { diverged_ = false; }

 private:
  void Append();
  void AppendText(const char* text, size_t size);

  std::vector<uint8_t> calls_;
  std::vector<Resume> resumes_;
  std::vector<uint8_t> entry_;  // being written
  Position at_;
  bool closed_ = false;
  bool diverged_ = false;
  int changes_ = 0;
};

}  // namespace lararium::drama
