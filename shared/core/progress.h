#pragma once

// How long work reports to whoever started it (a progress bar, a panel), and
// how it learns that it should stop.

#include <string_view>

namespace lararium {

class Progress {
 public:
  virtual ~Progress() = default;

  // fraction of the named step that is done, 0..1. Called from the thread that
  // does the work; cheap enough to call often.
  virtual void Report(std::string_view step, double fraction) = 0;

  // True once the work should end early, leaving nothing half written.
  virtual bool Cancelled() const = 0;
};

// Says nothing and never cancels.
class NoProgress : public Progress {
 public:
  void Report(std::string_view, double) override {}
  bool Cancelled() const override { return false; }
};

}  // namespace lararium
