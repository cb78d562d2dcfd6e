#include "shared/vision/background/background_relocalizer.h"

#include "shared/vision/background/joined_search.h"

namespace lararium::vision {

std::unique_ptr<BackgroundSearch> MakeBackgroundSearch(Relocalizer& relocalizer, int threads) {
  if (threads == 1) {
    return std::make_unique<JoinedSearch>(relocalizer);
  }
  return std::make_unique<BackgroundRelocalizer>(relocalizer);
}

BackgroundRelocalizer::BackgroundRelocalizer(Relocalizer& relocalizer)
    : relocalizer_(relocalizer), thread_([this](const std::stop_token& stop) { Work(stop); }) {}

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
  if (wait) {
    changed_.wait(lock, [this] { return located_.has_value(); });
  }
  if (located_) {
    map_ = located_->map;
    EndLocked();
  }
  return located_;
}

void BackgroundRelocalizer::Drop() {
  std::unique_lock lock(mutex_);
  if (busy_) {
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
