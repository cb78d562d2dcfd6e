#include "shared/vision/background_finder.h"

namespace lararium::vision {

using geometry::CameraModel;

BackgroundFinder::BackgroundFinder(Finder& finder, int threads) : finder_(finder) {
  if (threads != 1) {
    thread_ = std::jthread([this](const std::stop_token& stop) { Work(stop); });
  }
}

void BackgroundFinder::Begin(const cv::Mat& grey, const CameraModel& camera) {
  const std::lock_guard lock(mutex_);
  grey_ = grey;
  camera_ = camera;
  located_.reset();
  busy_ = true;
  changed_.notify_all();
}

std::optional<Located> BackgroundFinder::Take(bool wait) {
  std::unique_lock lock(mutex_);
  if (!thread_.joinable()) {
    located_ = finder_.Find(grey_, camera_);
  } else if (wait) {
    changed_.wait(lock, [this] { return located_.has_value(); });
  }
  if (located_) {
    EndLocked();
  }
  return located_;
}

void BackgroundFinder::Drop() {
  std::unique_lock lock(mutex_);
  if (busy_ && thread_.joinable()) {
    changed_.wait(lock, [this] { return located_.has_value(); });
  }
  EndLocked();
}

void BackgroundFinder::EndLocked() {
  busy_ = false;
  grey_.release();
}

void BackgroundFinder::Work(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (changed_.wait(lock, stop, [this] { return busy_ && !located_; })) {
    const cv::Mat grey = grey_;
    const CameraModel camera = camera_;
    lock.unlock();
    const Located located = finder_.Find(grey, camera);
    lock.lock();
    located_ = located;
    changed_.notify_all();
  }
}

}  // namespace lararium::vision
