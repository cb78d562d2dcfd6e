#pragma once

// Interface through which long tasks report progress to their caller (a progress bar, a panel) and
// learn that they should stop.

#include <string_view>

namespace lararium {

class Progress {
 public:
  virtual ~Progress() = default;

  // Reports the completed fraction of the named step, 0..1. Called from the thread that does the
  // work; cheap enough to call often.
  virtual void Report(std::string_view step, double fraction) = 0;

  // True if the work should end early, without leaving incomplete files.
  virtual bool Cancelled() const = 0;
};

// Ignores reports and never cancels.
class NoProgress : public Progress {
 public:
  void Report(std::string_view, double) override {}
  bool Cancelled() const override { return false; }
};

}  // namespace lararium
