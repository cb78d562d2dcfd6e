#include "shared/vision/background_relocalizer.h"

namespace lararium::vision {

BackgroundRelocalizer::BackgroundRelocalizer(Relocalizer& relocalizer, int threads)
    : relocalizer_(relocalizer) {
  if (threads != 1) {
    thread_ = std::jthread([this](const std::stop_token& stop) { Work(stop); });
  }
}

void BackgroundRelocalizer::Begin(const cv::Mat& grey, const CameraGuess& guess) {
  const std::lock_guard lock(mutex_);
  grey_ = grey;
  guess_ = guess;
  located_.reset();
  busy_ = true;
  changed_.notify_all();
}

std::optional<Located> BackgroundRelocalizer::Take(bool wait) {
  std::unique_lock lock(mutex_);
  if (!thread_.joinable()) {
    located_ = relocalizer_.Find(grey_, guess_);
  } else if (wait) {
    changed_.wait(lock, [this] { return located_.has_value(); });
  }
  if (located_) {
    EndLocked();
  }
  return located_;
}

void BackgroundRelocalizer::Drop() {
  std::unique_lock lock(mutex_);
  if (busy_ && thread_.joinable()) {
    changed_.wait(lock, [this] { return located_.has_value(); });
  }
  EndLocked();
}

void BackgroundRelocalizer::EndLocked() {
  busy_ = false;
  grey_.release();
}

void BackgroundRelocalizer::Work(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (changed_.wait(lock, stop, [this] { return busy_ && !located_; })) {
    const cv::Mat grey = grey_;
    const CameraGuess guess = guess_;
    lock.unlock();
    const Located located = relocalizer_.Find(grey, guess);
    lock.lock();
    located_ = located;
    changed_.notify_all();
  }
}

}  // namespace lararium::vision
