#pragma once

// Progress of subcommands on a terminal: a progress bar with the remaining time, or plain lines
// if the output is piped; Ctrl-C cancels.

#include <chrono>
#include <cstdio>
#include <mutex>
#include <string>

#include "shared/core/progress.h"

namespace lararium::editor {

// Writes to stderr, because results go to stdout.
class TerminalProgress : public Progress {
 public:
  // Handles SIGINT and SIGTERM from now on; a second signal ends the program as usual. Create
  // only one, in the main thread.
  TerminalProgress();
  // Ends the line of the bar.
  ~TerminalProgress() override;
  TerminalProgress(const TerminalProgress&) = delete;
  TerminalProgress& operator=(const TerminalProgress&) = delete;

  void Report(std::string_view step, double fraction) override;
  bool Cancelled() const override;

  // Clears the bar, so that a message can be printed on its own line.
  void Clear();

 private:
  using Clock = std::chrono::steady_clock;

  void DrawBar(double fraction, double elapsed);
  void PrintLine(double fraction, double elapsed);

  bool terminal_;
  std::mutex mutex_;
  std::string step_;
  Clock::time_point step_start_ = Clock::now();
  Clock::time_point last_output_;
  double last_fraction_ = -1.0;
  bool bar_shown_ = false;
};

// The text of a progress bar with `width` cells: "matching  [####------]  40 %  1 min 5 s
// left".
std::string FormatBar(std::string_view step, double fraction, double elapsed_seconds, int width);

}  // namespace lararium::editor
