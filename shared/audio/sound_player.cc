#include "shared/audio/sound_player.h"

#include <algorithm>
#include <array>

namespace lararium::audio {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kAskAgain(2);
constexpr std::chrono::milliseconds kStale(333);

}  // namespace

SoundPlayer::SoundPlayer(std::unique_ptr<Mixer> mixer, OpenOut open, Log& log)
    : mixer_(std::move(mixer)),
      open_(std::move(open)),
      log_(log),
      thread_([this](const std::stop_token& stop) { Run(stop); }) {}

SoundPlayer::~SoundPlayer() {
  thread_.request_stop();
  thread_.join();
}

void SoundPlayer::Show(const SoundScene& scene) {
  const std::lock_guard lock(mutex_);
  newest_ = scene;
  newest_shown_ = Clock::now();
  any_ = true;
}

bool SoundPlayer::TakeScene(Clock::time_point now) {
  {
    const std::lock_guard lock(mutex_);
    if (!any_) {
      return false;
    }
    scene_ = newest_;
    shown_ = newest_shown_;
  }
  if (now - shown_ > kStale) {
    std::erase_if(scene_.voices, [](const Voice& voice) { return !voice.head_locked; });
  }
  return true;
}

void SoundPlayer::Open() {
  asked_ = Clock::now();
  Result<std::unique_ptr<AudioOut>> opened = open_();
  silent_ = !opened.ok();
  if (opened.ok()) {
    out_ = std::move(*opened);
    told_silent_ = false;
    log_.Info("sound goes to {}", out_->name());
    return;
  }
  if (out_ == nullptr) {
    out_ = std::move(*CreateAudioOut(AudioOutKind::kNone));
  }
  if (!told_silent_) {
    log_.Warn("{}; the show goes on in silence", opened.message());
    told_silent_ = true;
  }
}

// Ramps over the block. Perceived loudness is about logarithmic; the square of the volume
// approximates that.
void SoundPlayer::ApplyVolume(std::span<float> stereo) {
  const float wanted = std::clamp(volume_.load(), 0.0f, 1.0f);
  if (wanted == 1.0f && heard_volume_ == 1.0f) {
    return;
  }
  const float step = (wanted - heard_volume_) / static_cast<float>(stereo.size());
  for (float& sample : stereo) {
    heard_volume_ += step;
    sample *= heard_volume_ * heard_volume_;
  }
  heard_volume_ = wanted;
}

void SoundPlayer::Run(const std::stop_token& stop) {
  std::array<float, 2 * Mixer::kBlockFrames> block = {};
  constexpr double kBlockSeconds = static_cast<double>(Mixer::kBlockFrames) / Mixer::kRate;
  while (!stop.stop_requested()) {
    if (out_ == nullptr || (silent_ && Clock::now() - asked_ > kAskAgain)) {
      Open();
    }
    const Clock::time_point now = Clock::now();
    const auto heard = now + std::chrono::duration_cast<Clock::duration>(
                                 std::chrono::duration<double>(out_->latency()));
    if (TakeScene(now)) {
      const double begin =
          scene_.held ? scene_.time : clock_.Next(scene_.time, shown_, heard, kBlockSeconds);
      mixer_->Render(scene_, begin, block);
      ApplyVolume(block);
    }
    if (const Status status = out_->Write(block); !status.ok()) {
      log_.Warn("{}; the show goes on in silence", status.message());
      told_silent_ = true;
      silent_ = true;
      asked_ = now;
      out_ = std::move(*CreateAudioOut(AudioOutKind::kNone));
    }
  }
}

}  // namespace lararium::audio
