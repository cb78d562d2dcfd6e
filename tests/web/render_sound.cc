// render_sound FILE REVERB
// Mixes scenes of one second each and writes the samples (32-bit floats, left and right by turns).
// REVERB: number of a stage::Reverb. It is compiled for both systems: in a browser, Web Audio
// renders after the program has scheduled everything, so one run has one reverberation.

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "shared/audio/mixer.h"
#include "shared/core/file.h"
#include "tests/web/wav.h"

namespace lararium::audio {
namespace {

constexpr size_t kBlockFrames = 1920;
constexpr int kBlocksPerScene = SoundGraph::kRate / static_cast<int>(kBlockFrames);
constexpr double kScene = 1.0;

std::vector<float> Tone(double seconds, double hertz, int channels) {
  std::vector<float> samples;
  const auto frames = static_cast<int>(seconds * SoundGraph::kRate);
  for (int i = 0; i < frames; ++i) {
    const double phase = 2.0 * std::numbers::pi * hertz * i / SoundGraph::kRate;
    samples.insert(samples.end(), static_cast<size_t>(channels),
                   static_cast<float>(0.2 * std::sin(phase)));
  }
  return samples;
}

std::vector<float> Click() {
  std::vector<float> samples(4800);
  samples[0] = 0.5f;
  return samples;
}

constexpr int kClick = 10;

// What is heard in each scene. The page test (sound_test.mjs) names them in the same order.
void AddVoices(const SoundLibrary& library, int scene, double began, SoundScene& out) {
  const auto add = [&](const char* clip, const glm::vec3& position) -> Voice& {
    Voice& voice = out.voices.emplace_back();
    voice.source = static_cast<uint64_t>(out.voices.size() + 8 * static_cast<size_t>(scene));
    voice.clip = library.Find(clip);
    voice.began = began;
    voice.position = position;
    return voice;
  };
  const glm::vec3 front(0.0f, 0.0f, -1.0f);
  switch (scene) {
    case 0:
      add("noise", {-2.0f, 0.0f, 0.0f});
      break;
    case 1:
      add("noise", {2.0f, 0.0f, 0.0f});
      break;
    case 2:
      add("noise", front);
      break;
    case 3:
      add("noise", 4.0f * front);
      break;
    case 4:
      add("noise", front).obstruction = 1.0f;
      break;
    case 5:
      add("noise", front).facing = front;
      break;
    case 6:
      add("noise", front).head_locked = true;
      break;
    case 7: {  // A stream, from its fifth second on.
      Voice& voice = add("long", front);
      voice.began = began - 5.0;
      voice.loops = true;
      break;
    }
    case 9:  // Speech lowers the ambience.
      add("speech", front).bus = Bus::kSpeech;
      [[fallthrough]];
    case 8: {
      Voice& voice = add("low", front);
      voice.source = 1000;
      voice.bus = Bus::kAmbience;
      voice.head_locked = true;
      voice.loops = true;
      voice.began = 0.0;
      break;
    }
    case kClick:
      add("click", front).began = began + 0.25;
      break;
    default:
      break;
  }
}
constexpr int kScenes = kClick + 1;

Status RenderScenes(const std::filesystem::path& file, stage::Reverb reverb) {
  LARARIUM_ASSIGN_OR_RETURN(
      const std::shared_ptr<const SoundLibrary> library,
      SoundLibrary::Load(
          {test::Wav("noise", 1, test::WavNoise(0.9)), test::Wav("long", 2, Tone(6.0, 1000.0, 2)),
           test::Wav("low", 2, Tone(1.0, 400.0, 2)), test::Wav("speech", 1, Tone(0.9, 2000.0, 1)),
           test::Wav("click", 1, Click())}));
  MixerOptions options;
  options.block_frames = kBlockFrames;
  LARARIUM_ASSIGN_OR_RETURN(std::unique_ptr<Mixer> made, Mixer::Create(library, options));
  // Web Audio renders only after this.
  static const std::unique_ptr<Mixer> mixer = std::move(made);
  std::string samples;
  std::vector<float> block(2 * kBlockFrames);
  for (int i = 0; i < kBlocksPerScene * (kScenes + 1); ++i) {
    SoundScene scene;
    scene.time = i * static_cast<double>(kBlockFrames) / SoundGraph::kRate;
    scene.reverb = reverb;
    const int number = i / kBlocksPerScene;
    // A room answers the click only.
    if (number < kScenes && (reverb == stage::Reverb::kNone || number == kClick)) {
      AddVoices(*library, number, number * kScene, scene);
    }
    mixer->Render(scene, scene.time, block);
    samples.append(reinterpret_cast<const char*>(block.data()), block.size() * sizeof(float));
  }
  return WriteFileAtomically(file, samples);
}

}  // namespace
}  // namespace lararium::audio

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: render_sound FILE REVERB\n");
    return 2;
  }
  const lararium::Status status = lararium::audio::RenderScenes(
      argv[1], static_cast<lararium::stage::Reverb>(std::atoi(argv[2])));
  if (!status.ok()) {
    std::fprintf(stderr, "%s\n", status.message().c_str());
    return 1;
  }
  return 0;
}
