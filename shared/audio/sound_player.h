#pragma once

// Plays a show's sound in real time, on a thread of its own.

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <stop_token>
#include <thread>

#include "shared/audio/audio_out.h"
#include "shared/audio/mixer.h"
#include "shared/audio/sound_scene.h"
#include "shared/core/log.h"

namespace lararium::audio {

// The drama's time of the samples that are mixed now, from the moments at which scenes
// were shown. Small differences (clocks drift, frames come unevenly) are evened out;
// large ones are seeks.
class SoundClock {
 public:
  // The drama's time of samples that are to be heard at a moment; shown: when scene_time
  // was seen.
  double Next(double scene_time,
              std::chrono::steady_clock::time_point shown,
              std::chrono::steady_clock::time_point heard,
              double block_seconds);

 private:
  std::optional<double> next_;
};

class SoundPlayer {
 public:
  using OpenOut = std::function<Result<std::unique_ptr<AudioOut>>()>;

  // Starts. While no output can be opened, and after one was lost, the show goes on in
  // silence, and open is asked again every two seconds. The log has one line for each
  // change. Borrows log.
  SoundPlayer(std::unique_ptr<Mixer> mixer, OpenOut open, Log& log);
  // Stops and waits.
  ~SoundPlayer();
  SoundPlayer(const SoundPlayer&) = delete;
  SoundPlayer& operator=(const SoundPlayer&) = delete;

  // What is to be heard from now on; it is seen at this moment. Without a new scene for
  // a third of a second only what is heard all around goes on. Any thread; allocates
  // nothing once the player has held as many voices.
  void Show(const SoundScene& scene);

  // How loud all of it is, 0 to 1, without a click. Any thread.
  void SetVolume(float volume) { volume_ = volume; }

 private:
  void Run(const std::stop_token& stop);
  void Open();
  void ApplyVolume(std::span<float> stereo);
  // The newest scene, silenced where it is old; none: nothing was shown yet.
  bool TakeScene(std::chrono::steady_clock::time_point now);

  std::unique_ptr<Mixer> mixer_;
  OpenOut open_;
  Log& log_;
  std::mutex mutex_;
  SoundScene newest_;  // with the mutex
  std::chrono::steady_clock::time_point newest_shown_;
  bool any_ = false;
  std::atomic<float> volume_ = 1.0f;
  // Of the thread.
  float heard_volume_ = 1.0f;  // at the end of the last block
  SoundScene scene_;
  std::chrono::steady_clock::time_point shown_;
  std::unique_ptr<AudioOut> out_;
  bool silent_ = true;        // out_ stands in
  bool told_silent_ = false;  // the log has it
  std::chrono::steady_clock::time_point asked_;
  SoundClock clock_;
  std::jthread thread_;
};

}  // namespace lararium::audio
