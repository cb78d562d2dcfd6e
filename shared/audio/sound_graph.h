#pragma once

// The graph in which sounds become what two ears hear: OpenAL Soft on a loopback
// device, which renders into memory when it is asked to. Heads' filters (HRTF),
// distance, occlusion and reverberation are therefore the same whether the samples go
// to headphones or to a file, and nothing depends on a sound card.
//
// Distance: inverse, 1 m is the reference and nothing is louder than there.
// OpenAL's axes are those of the stage: Y up, -Z forward, metres.

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "shared/audio/sound_library.h"
#include "shared/audio/sound_scene.h"
#include "shared/core/status.h"

namespace lararium::audio {

// How a source is heard now.
struct SourceState {
  float gain = 1.0f;                     // factor of its amplitude
  glm::vec3 position = glm::vec3(0.0f);  // stage, metres; unless head-locked
  glm::vec3 facing = glm::vec3(0.0f);    // where a mouth points; zero: it sounds all around
  float obstruction = 0.0f;              // 0: heard freely; 1: behind something solid
};

class SoundGraph {
 public:
  static constexpr int kRate = 48'000;  // samples a second that it gives
  static constexpr size_t kSources = 48;
  // By which samples come late: a millisecond in which the limiter of the output, which
  // keeps peaks below full scale, looks ahead.
  static constexpr size_t kDelayFrames = 48;

  // hrtf: for headphones; otherwise for two loudspeakers.
  static Result<std::unique_ptr<SoundGraph>> Create(std::shared_ptr<const SoundLibrary> library,
                                                    bool hrtf);
  ~SoundGraph();
  SoundGraph(const SoundGraph&) = delete;
  SoundGraph& operator=(const SoundGraph&) = delete;

  const SoundLibrary& library() const { return *library_; }
  // False where no data of heads are installed.
  bool hrtf() const { return hrtf_; }

  // The clip sounds from one of its frames on, beginning with the next sample that is
  // rendered. Stops what the source played before. False where a file is damaged.
  bool Start(size_t source, int clip, int64_t frame, bool loops, bool head_locked);
  void Stop(size_t source);
  // False once a clip has ended.
  bool Playing(size_t source);

  // How a source is heard, and from where; they hold until they are set anew.
  void Set(size_t source, const SourceState& state);
  void SetListener(const Listener& listener);
  // How the room answers. db: louder than rooms of its kind do.
  void SetReverb(stage::Reverb reverb, float db);

  // The next samples: left, right, left, ... What was set before is reached at the end
  // of them: a change is a ramp over one call.
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
  // Gives OpenAL the next piece of a streamed sound; false at its end.
  bool FillBuffer(Source& source, uint32_t buffer);
  void Feed(Source& source);

  std::shared_ptr<const SoundLibrary> library_;
  std::unique_ptr<Device> device_;
  bool hrtf_ = false;
  std::vector<Buffers> buffers_;  // of each clip; 0: not given to OpenAL yet
  std::vector<Source> sources_;
  std::vector<int16_t> piece_;    // of a stream, as decoded
  std::vector<int16_t> widened_;  // and as OpenAL takes it
};

}  // namespace lararium::audio
