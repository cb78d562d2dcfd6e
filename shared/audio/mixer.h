#pragma once

// Makes the playing sounds match the scene (sound_scene.h): starts and stops clips, keeps them in
// time with the drama, and lowers sounds that would mask speech.

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "shared/audio/sound_graph.h"
#include "shared/audio/sound_library.h"
#include "shared/audio/sound_scene.h"
#include "shared/core/status.h"

namespace lararium::audio {

struct MixerOptions {
  bool hrtf = true;
  // Largest lead or lag of sound against the picture before it is corrected, seconds. Detectability
  // thresholds of ITU-R BT.1359-1.
  double max_lead = 0.045;
  double max_lag = 0.125;
  // A voice that is new within this time after its beginning is played from its beginning, so that
  // it keeps its onset. Seconds, at most max_lag.
  double late_start = 0.1;
  // Gains and positions change linearly within a block of samples.
  size_t block_frames = 480;

  // Options for files, which are rendered up to a known time: every sample is exactly in place.
  static MixerOptions ForFiles() { return {.max_lead = 0.002, .max_lag = 0.002, .late_start = 0}; }

  Status Validate() const;
};

// Change of a bus's level while a nearby actor speaks, decibels.
inline constexpr std::array<float, 4> kDuckDb = {0.0f, -4.0f, -9.0f, 0.0f};  // Indexed by Bus.
// Minimum attenuation during an audio description, decibels.
inline constexpr std::array<float, 4> kDescribedDb = {-6.0f, -8.0f, -9.0f, 0.0f};

class Mixer {
 public:
  static constexpr int kRate = SoundGraph::kRate;
  static constexpr size_t kBlockFrames = MixerOptions().block_frames;

  static Result<std::unique_ptr<Mixer>> Create(std::shared_ptr<const SoundLibrary> library,
                                               const MixerOptions& options);

  // Renders the samples (left, right, ...) of the drama's time from `begin` on. A voice that began
  // within them starts at its own sample. Jumps of `begin` are seeks. If there are more voices than
  // sources, the quietest are left out. In steady state only OpenAL may allocate.
  void Render(const SoundScene& scene, double begin, std::span<float> stereo);

  bool hrtf() const { return graph_->hrtf(); }
  // Number of playing voices.
  size_t playing() const;

 private:
  struct Slot {
    bool used = false;
    bool leaving = false;  // Fades out.
    bool ended = false;    // The clip has ended, its voice has not.
    uint64_t source = 0;
    int clip = -1;
    Bus bus = Bus::kEffects;
    bool loops = false;
    bool head_locked = false;
    double began = 0.0;     // Voice::began.
    double position = 0.0;  // Seconds of the clip played so far, all loops together.
    float level = 1.0f;     // Level of the fade-out.
    float gain = 1.0f;
    SourceState state;  // Smoothed state of the source.
  };
  // A voice that begins within a block, at `frame`.
  struct Onset {
    size_t frame = 0;
    const Voice* voice = nullptr;
  };

  Mixer(std::unique_ptr<SoundGraph> graph, const MixerOptions& options)
      : graph_(std::move(graph)), options_(options) {}

  double Seconds(int clip) const;
  // Decides which slots continue and which fade out, and collects the voices that start in onsets_.
  void Reconcile(const SoundScene& scene, double begin, size_t frames);
  const Voice* VoiceOf(const Slot& slot, const SoundScene& scene, double begin) const;
  bool RingsOut(const Slot& slot, double begin) const;
  void Plan(const Voice& voice, double begin, size_t frames);
  void Start(const Voice& voice, double begin);
  Slot* FreeSlot(const Voice& voice);
  void Follow(const Voice& voice, float seconds, Slot& slot) const;
  void Duck(float seconds);
  void MoveListener(const Listener& listener, float seconds);
  void RenderBlock(const SoundScene& scene, double begin, std::span<float> stereo);
  void RenderPart(std::span<float> stereo);
  void Release(Slot& slot);

  std::unique_ptr<SoundGraph> graph_;
  MixerOptions options_;
  std::array<Slot, SoundGraph::kSources> slots_;
  std::vector<Onset> onsets_;
  std::array<float, 4> duck_db_ = {};  // Present attenuation of each bus.
  Listener listener_;
  bool placed_ = false;  // True after the first MoveListener().
};

}  // namespace lararium::audio
