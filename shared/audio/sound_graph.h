#pragma once

// Renders sounds for two ears: OpenAL Soft on a loopback device, which renders into memory on
// request. Head-related transfer functions (HRTF), distance, occlusion and reverberation are
// therefore the same for headphones and for files, and do not depend on a sound card.
//
// In browsers Web Audio renders (web/sound_graph.cc), into the node that a page gives as
// `Module.audioOut`. There the samples of Render() are silence, and what they would contain is
// scheduled at the context's time, from that of Create() on. A page has one graph at a time.
//
// Distance model: inverse; the reference distance is 1 m, and nearer sources are not louder.
// The axes are those of the stage: Y up, -Z forward, metres.

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "shared/audio/sound_library.h"
#include "shared/audio/sound_scene.h"
#include "shared/core/status.h"

namespace lararium::audio {

// State of a source.
struct SourceState {
  float gain = 1.0f;                     // Factor of the amplitude.
  glm::vec3 position = glm::vec3(0.0f);  // Stage axes, metres; unused for head-locked sources.
  glm::vec3 facing = glm::vec3(0.0f);    // Direction of a mouth; zero: omnidirectional.
  float obstruction = 0.0f;              // 0: unobstructed; 1: behind an occluder.
};

class SoundGraph {
 public:
  static constexpr int kRate = 48'000;  // Samples per second of the output.
  static constexpr size_t kSources = 48;
  // Delay of the output: the look-ahead of one millisecond of the limiter that keeps peaks below
  // full scale.
  static constexpr size_t kDelayFrames = 48;

  // hrtf: for headphones; otherwise for two loudspeakers.
  static Result<std::unique_ptr<SoundGraph>> Create(std::shared_ptr<const SoundLibrary> library,
                                                    bool hrtf);
  ~SoundGraph();
  SoundGraph(const SoundGraph&) = delete;
  SoundGraph& operator=(const SoundGraph&) = delete;

  const SoundLibrary& library() const { return *library_; }
  // False if no HRTF data are installed. Browsers have their own.
  bool hrtf() const { return hrtf_; }

  // Starts a clip at one of its frames, with the next sample that is rendered. Stops what the
  // source played before. Returns false if a file is damaged.
  bool Start(size_t source, int clip, int64_t frame, bool loops, bool head_locked);
  void Stop(size_t source);
  // Returns false once the clip has ended.
  bool Playing(size_t source);

  // Set the state of a source and of the listener; both persist until the next call.
  void Set(size_t source, const SourceState& state);
  void SetListener(const Listener& listener);
  // Sets the room's reverberation. db: level relative to typical rooms of its kind.
  void SetReverb(stage::Reverb reverb, float db);

  // Renders the next samples: left, right, left, ... State that was set before is reached at their
  // end: a change is a ramp over one call.
  void Render(std::span<float> stereo);

 private:
  struct Device;
  struct Source;
  struct Buffers {
    uint32_t mono = 0;
    uint32_t stereo = 0;
  };

  SoundGraph(std::shared_ptr<const SoundLibrary> library, std::unique_ptr<Device> device);
  uint32_t BufferOf(int clip, bool head_locked);
  bool StartStream(Source& source, const Clip& clip, int64_t frame);
  // Queues the next pieces of a streamed sound.
  void Feed(Source& source);

  std::shared_ptr<const SoundLibrary> library_;
  std::unique_ptr<Device> device_;
  bool hrtf_ = false;
  std::vector<Buffers> buffers_;  // Buffers of each clip; 0: not created yet.
  std::vector<Source> sources_;
};

}  // namespace lararium::audio
