#pragma once

// Makes what sounds equal to what is to be heard (sound_scene.h): starts and stops
// clips, keeps them in time with the drama, lowers what would drown speech.

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
  // How far sound may lead or lag what is seen before it is put right, seconds. Of
  // ITU-R BT.1359-1: what viewers begin to notice.
  double max_lead = 0.045;
  double max_lag = 0.125;
  // What is heard of for the first time so soon after its beginning is played from
  // there, so that it keeps its onset. At most max_lag.
  double late_start = 0.1;

  // For files, whose samples are rendered up to a moment that is known: every sample is
  // where it belongs.
  static MixerOptions ForFiles() { return {.max_lead = 0.002, .max_lag = 0.002, .late_start = 0}; }

  Status Validate() const;
};

// Decibels by which a bus is lowered while somebody speaks nearby.
inline constexpr std::array<float, 4> kDuckDb = {0.0f, -4.0f, -9.0f, 0.0f};  // by Bus
// At least, while something is described.
inline constexpr std::array<float, 4> kDescribedDb = {-6.0f, -8.0f, -9.0f, 0.0f};

class Mixer {
 public:
  static constexpr int kRate = SoundGraph::kRate;
  static constexpr size_t kBlockFrames = 480;  // within which gains and places are ramps

  static Result<std::unique_ptr<Mixer>> Create(std::shared_ptr<const SoundLibrary> library,
                                               const MixerOptions& options);

  // The samples (left, right, ...) of the drama's time from begin on. A voice of the
  // scene that began within them starts at its own sample. Jumps of begin are seeks.
  // Where more is to be heard at once than there are sources, the quietest is not.
  // Allocates nothing in steady state but what OpenAL may.
  void Render(const SoundScene& scene, double begin, std::span<float> stereo);

  bool hrtf() const { return graph_->hrtf(); }
  // How many voices sound.
  size_t playing() const;

 private:
  struct Slot {
    bool used = false;
    bool leaving = false;  // fades out
    bool ended = false;    // the clip is over, its voice is not yet
    uint64_t source = 0;
    int clip = -1;
    Bus bus = Bus::kEffects;
    bool loops = false;
    bool head_locked = false;
    double began = 0.0;     // as its voice says
    double position = 0.0;  // seconds of the clip that were played, of all its loops
    float level = 1.0f;     // of the fade
    float gain = 1.0f;
    SourceState state;  // of the source, smoothed
  };
  // A voice that begins within a block.
  struct Onset {
    size_t frame = 0;
    const Voice* voice = nullptr;
  };

  Mixer(std::unique_ptr<SoundGraph> graph, const MixerOptions& options)
      : graph_(std::move(graph)), options_(options) {}

  double Seconds(int clip) const;
  // The slots that go on, those that fade out, and what has to begin: in onsets_.
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
  std::array<float, 4> duck_db_ = {};  // of each bus now
  Listener listener_;
  bool placed_ = false;  // listener_ was set
};

}  // namespace lararium::audio
