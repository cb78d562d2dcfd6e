#pragma once

// Plays a show's sound in real time on its own thread.

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
#include "shared/audio/sound_clock.h"
#include "shared/audio/sound_scene.h"
#include "shared/core/log.h"

namespace lararium::audio {

class SoundPlayer {
 public:
  using OpenOut = std::function<Result<std::unique_ptr<AudioOut>>()>;

  // Starts the thread. While no output can be opened, and after one was lost, the show continues
  // silently, and `open` is called again every two seconds. The log has one line for each change.
  // Borrows log.
  SoundPlayer(std::unique_ptr<Mixer> mixer, OpenOut open, Log& log);
  // Stops the thread and waits for it.
  ~SoundPlayer();
  SoundPlayer(const SoundPlayer&) = delete;
  SoundPlayer& operator=(const SoundPlayer&) = delete;

  // Plays a scene from now on; it is seen at this moment. Without a new scene for a third of a
  // second, only head-locked voices continue. Any thread; allocates nothing once the player has
  // held as many voices.
  void Show(const SoundScene& scene);

  // Overall volume, 0 to 1; changes without a click. Any thread.
  void SetVolume(float volume) { volume_ = volume; }

 private:
  void Run(const std::stop_token& stop);
  void Open();
  void ApplyVolume(std::span<float> stereo);
  // Takes the newest scene, and silences it if it is old; returns false if there was no scene yet.
  bool TakeScene(std::chrono::steady_clock::time_point now);

  std::unique_ptr<Mixer> mixer_;
  OpenOut open_;
  Log& log_;
  std::mutex mutex_;
  SoundScene newest_;  // Guarded by mutex_, like the next two.
  std::chrono::steady_clock::time_point newest_shown_;
  bool any_ = false;
  std::atomic<float> volume_ = 1.0f;
  // Used by the thread only.
  float heard_volume_ = 1.0f;  // Volume at the end of the last block.
  SoundScene scene_;
  std::chrono::steady_clock::time_point shown_;
  std::unique_ptr<AudioOut> out_;
  bool silent_ = true;        // True if out_ is the silent replacement.
  bool told_silent_ = false;  // True if the log reports the silence already.
  std::chrono::steady_clock::time_point asked_;
  SoundClock clock_;
  std::jthread thread_;
};

}  // namespace lararium::audio
