#pragma once

// A value that a task makes in the background from some input, and makes again when the input
// changes.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "editor/jobs/background_task.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"

namespace lararium::editor {

// Key: identifies the input; values can be compared. Use it from the interface thread only. It must
// outlive the polling of its tasks.
template <typename Key, typename Value>
class Cached {
 public:
  using Make = std::function<Result<Value>(Progress&)>;
  using Failed = std::function<void(const Status& status, bool cancelled)>;

  // Whether the last attempt to make a value had another key, or none was made since Forget().
  bool Stale(const Key& key) const { return attempted_ != key; }
  // The next Refresh() makes the value again. The present value stays until then.
  void Forget() { attempted_.reset(); }

  // Starts a task that makes the value for a stale key. Does nothing while another task of this
  // kind is running, so call it regularly. After a failure the former value stays, and the same key
  // is not attempted again.
  void Refresh(
      const Key& key,
      TaskKind kind,
      TaskList& tasks,
      Make make,
      Failed failed = [](const Status&, bool) {}) {
    if (!Stale(key)) {
      return;
    }
    const auto made = std::make_shared<std::optional<Value>>();
    const auto work = [made, make = std::move(make)](Progress& progress) {
      LARARIUM_ASSIGN_OR_RETURN(*made, make(progress));
      return Status();
    };
    const auto done = [this, made, key, failed = std::move(failed)](const Status& status,
                                                                    bool cancelled) {
      problem_ = status;
      if (status.ok()) {
        ++number_;
        value_ = std::shared_ptr<const Value>(made, &**made);
        key_ = key;
      } else {
        failed(status, cancelled);
      }
    };
    if (tasks.Start(kind, work, done)) {
      attempted_ = key;
      problem_ = Status();
    }
  }

  // The newest value, which may be that of an earlier key; nullptr before the first.
  const std::shared_ptr<const Value>& newest() const { return value_; }
  // The value of this key; nullptr where the newest value is not.
  const Value* Find(const Key& key) const { return key_ == key ? value_.get() : nullptr; }
  // Changes with each value.
  int64_t number() const { return number_; }
  // Why the last attempt failed. Success while it is running.
  const Status& problem() const { return problem_; }

 private:
  std::optional<Key> attempted_;
  std::optional<Key> key_;  // The key of value_.
  std::shared_ptr<const Value> value_;
  int64_t number_ = 0;
  Status problem_;
};

}  // namespace lararium::editor
