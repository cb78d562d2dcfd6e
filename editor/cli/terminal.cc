#include "editor/cli/terminal.h"

#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <optional>

#include "editor/jobs/background_task.h"

namespace lararium::editor {

namespace {

// A signal handler can only use a global variable.
volatile std::sig_atomic_t g_interrupted = 0;

extern "C" void OnInterrupt(int signal) {
  g_interrupted = 1;
  std::signal(signal, SIG_DFL);
}

constexpr int kBarCells = 24;
constexpr auto kBarInterval = std::chrono::milliseconds(100);
constexpr auto kLineInterval = std::chrono::seconds(5);

}  // namespace

std::string FormatBar(std::string_view step, double fraction, double elapsed_seconds, int width) {
  const int filled = static_cast<int>(std::clamp(fraction, 0.0, 1.0) * width + 0.5);
  std::string text(step);
  text += "  [" + std::string(static_cast<size_t>(filled), '#') +
          std::string(static_cast<size_t>(width - filled), '-') + "]  " +
          std::to_string(static_cast<int>(fraction * 100.0 + 0.5)) + " %";
  const std::optional<double> left = EstimateSecondsLeft(fraction, elapsed_seconds);
  if (left && fraction < 1.0) {
    text += "  " + FormatDuration(*left) + " left";
  }
  return text;
}

TerminalProgress::TerminalProgress() : terminal_(::isatty(STDERR_FILENO) == 1) {
  g_interrupted = 0;
  std::signal(SIGINT, OnInterrupt);
  std::signal(SIGTERM, OnInterrupt);
}

TerminalProgress::~TerminalProgress() {
  Clear();
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

bool TerminalProgress::Cancelled() const { return g_interrupted != 0; }

void TerminalProgress::Report(std::string_view step, double fraction) {
  const std::lock_guard lock(mutex_);
  const Clock::time_point now = Clock::now();
  const bool new_step = step != step_;
  if (new_step) {
    step_ = step;
    step_start_ = now;
    last_fraction_ = -1.0;
  }
  const auto interval = terminal_ ? Clock::duration(kBarInterval) : Clock::duration(kLineInterval);
  const bool finished = fraction >= 1.0 && last_fraction_ < 1.0;
  if (!new_step && !finished && now - last_output_ < interval) {
    return;
  }
  last_output_ = now;
  last_fraction_ = fraction;
  const double elapsed = std::chrono::duration<double>(now - step_start_).count();
  terminal_ ? DrawBar(fraction, elapsed) : PrintLine(fraction, elapsed);
}

void TerminalProgress::DrawBar(double fraction, double elapsed) {
  std::fprintf(stderr, "\r\033[K%s", FormatBar(step_, fraction, elapsed, kBarCells).c_str());
  std::fflush(stderr);
  bar_shown_ = true;
}

void TerminalProgress::PrintLine(double fraction, double elapsed) {
  const std::optional<double> left = EstimateSecondsLeft(fraction, elapsed);
  std::fprintf(stderr, "%s: %d %%%s\n", step_.c_str(), static_cast<int>(fraction * 100.0 + 0.5),
               left && fraction < 1.0 ? (", " + FormatDuration(*left) + " left").c_str() : "");
}

void TerminalProgress::Clear() {
  const std::lock_guard lock(mutex_);
  if (bar_shown_) {
    std::fputs("\r\033[K", stderr);
    std::fflush(stderr);
    bar_shown_ = false;
  }
}

}  // namespace lararium::editor
