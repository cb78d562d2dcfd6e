#include "web/page/page_sound.h"

#include <chrono>
#include <utility>

#include "shared/audio/web/web_audio.h"

namespace lararium::web {
namespace {

using Clock = std::chrono::steady_clock;

// About the time from image to image: parameters of Web Audio change once for each.
constexpr size_t kBlockFrames = 1920;
constexpr double kBlockSeconds = static_cast<double>(kBlockFrames) / audio::Mixer::kRate;

}  // namespace

PageSound::PageSound(std::unique_ptr<audio::Mixer> mixer)
    : mixer_(std::move(mixer)), silence_(2 * kBlockFrames) {}

Result<std::unique_ptr<PageSound>> PageSound::Create(
    std::shared_ptr<const audio::SoundLibrary> library) {
  audio::MixerOptions options;
  options.block_frames = kBlockFrames;
  LARARIUM_ASSIGN_OR_RETURN(std::unique_ptr<audio::Mixer> mixer,
                            audio::Mixer::Create(std::move(library), options));
  return std::unique_ptr<PageSound>(new PageSound(std::move(mixer)));
}

void PageSound::Show(const audio::SoundScene& scene) {
  const Clock::time_point shown = Clock::now();
  const audio::WebAudioTimes times = audio::ReadWebAudioTimes();
  for (double head = times.head; head < times.now + kBlockSeconds; head += kBlockSeconds) {
    const std::chrono::duration<double> until_heard(head - times.now + times.latency);
    const double begin =
        scene.held ? scene.time
                   : clock_.Next(scene.time, shown,
                                 shown + std::chrono::duration_cast<Clock::duration>(until_heard),
                                 kBlockSeconds);
    mixer_->Render(scene, begin, silence_);
  }
}

}  // namespace lararium::web
