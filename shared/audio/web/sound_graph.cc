#include "shared/audio/sound_graph.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>

#include "shared/audio/clip_stream.h"
#include "shared/audio/decibels.h"
#include "shared/audio/sound_damping.h"
#include "shared/audio/web/web_audio.h"
#include "shared/core/check.h"
#include "shared/core/random.h"

// web_audio.js. Times are seconds of the context.
extern "C" {
double lararium_audio_open();  // Returns the sample rate; 0: the page has no output.
void lararium_audio_close();
uint32_t lararium_audio_buffer(const int16_t* samples, size_t frames, int channels, int rate);
void lararium_audio_play(size_t source, uint32_t buffer, double seconds, bool loops);
void lararium_audio_queue(
    size_t source, const int16_t* samples, size_t frames, int channels, int rate, double when);
void lararium_audio_place(size_t source, bool placed);
void lararium_audio_stop(size_t source);
void lararium_audio_set(size_t source, const float* values, double seconds);
void lararium_audio_reverb(const float* samples, size_t frames);
void lararium_audio_advance(double seconds);
void lararium_audio_times(double* head_now_latency);
}

namespace lararium::audio {
namespace {

// Streams are queued so far ahead that a busy page does not interrupt them, several pieces at once.
constexpr double kStreamAhead = 1.5;
constexpr int kPiecesAtOnce = 8;
// Changes below this are not handed over: factors, decibels and parts of a unit vector.
constexpr float kLeastChange = 5e-4f;
constexpr float kLongestReverb = 3.0f;  // Seconds.
// Factors that make the levels of panners and of a room's answer those of OpenAL, from
// tests/web/sound_test.mjs in Chromium.
constexpr float kPannerLevel = 1.38f;
constexpr float kLateLevel = 0.4f;
constexpr float kEarlyLevel = 0.5f;
constexpr float kQuarter = std::numbers::pi_v<float> / 2.0f;

// What one source is given: the parameters of web_audio.js, in its order.
struct Values {
  float gain = 0.0f;
  glm::vec3 direction = glm::vec3(0.0f, 0.0f, -1.0f);  // Axes of the listener.
  float high_db = 0.0f;
  float reverb_gain = 0.0f;
  float reverb_high_db = 0.0f;
};
constexpr size_t kValues = sizeof(Values) / sizeof(float);

bool Differ(const Values& a, const Values& b) {
  const auto* x = &a.gain;
  const auto* y = &b.gain;
  return !std::equal(x, x + kValues, y,
                     [](float p, float q) { return std::abs(p - q) <= kLeastChange; });
}

// OpenAL gives the level of what is high at the filter's frequency, which is the middle of its
// slope; Web Audio gives it beyond the slope.
constexpr float kBeyondSlope = 2.0f;

// Share, 0 to 1, of the attenuation behind a speaker's head that a listener gets.
float BehindShare(const glm::vec3& facing, const glm::vec3& listener_from_source) {
  const float length = glm::length(facing) * glm::length(listener_from_source);
  if (length < 1e-6f) {
    return 0.0f;
  }
  constexpr float kInner = kMouthConeDeg / 180.0f * kQuarter;  // Half of the cone.
  const float angle =
      std::acos(std::clamp(glm::dot(facing, listener_from_source) / length, -1.0f, 1.0f));
  return std::clamp((angle - kInner) / (2.0f * kQuarter - kInner), 0.0f, 1.0f);
}

Values ValuesOf(const SourceState& state, bool head_locked, const Listener& listener) {
  Values values;
  values.gain = std::clamp(state.gain, 0.0f, kMaxGain);
  if (head_locked) {
    return values;
  }
  const glm::vec3 offset = state.position - listener.position;
  const float distance = glm::length(offset);
  if (distance > 1e-3f) {
    values.direction =
        glm::vec3(glm::dot(offset, glm::cross(listener.forward, listener.up)),
                  glm::dot(offset, listener.up), -glm::dot(offset, listener.forward)) /
        distance;
  }
  const float behind = BehindShare(state.facing, -offset);
  const float blocked = std::clamp(state.obstruction, 0.0f, 1.0f);
  // OpenAL's cone is linear in its factors.
  const float cone = 1.0f + behind * (AmplitudeFromDecibels(kBehindDb) - 1.0f);
  const float cone_high_db =
      20.0f * std::log10(1.0f + behind * (AmplitudeFromDecibels(kBehindHighDb) - 1.0f));
  const float near = std::clamp(distance, kReferenceDistance, kMaxDistance);
  values.reverb_gain = values.gain * cone * AmplitudeFromDecibels(0.5f * blocked * kObstructedDb);
  values.reverb_high_db = kBeyondSlope * (cone_high_db + 0.5f * blocked * kObstructedHighDb);
  values.gain *= kPannerLevel * kReferenceDistance / near * cone *
                 AmplitudeFromDecibels(blocked * kObstructedDb);
  values.high_db = kBeyondSlope * (cone_high_db + blocked * kObstructedHighDb);
  return values;
}

// A room's answer to a click: early reflections, then noise whose high part decays sooner. Left
// ear, then right ear.
std::vector<float> ResponseOf(const EFXEAXREVERBPROPERTIES& p, float db, double rate) {
  const float seconds = std::min(p.flDecayTime, kLongestReverb);
  const auto first = static_cast<size_t>(rate * p.flReflectionsDelay);
  const size_t late = first + static_cast<size_t>(rate * p.flLateReverbDelay);
  const size_t frames = late + static_cast<size_t>(rate * seconds);
  const float gain = std::min(p.flGain * AmplitudeFromDecibels(db), 1.0f);
  // First-order low-pass that divides the noise at the reference frequency.
  const auto mix = static_cast<float>(1.0 - std::exp(-4.0 * kQuarter * p.flHFReference / rate));
  const auto fade = [rate](float decay) {
    return static_cast<float>(std::pow(10.0, -3.0 / (decay * rate)));
  };
  const float low_fade = fade(p.flDecayTime);
  const float high_fade = fade(std::max(p.flDecayTime * p.flDecayHFRatio, 0.1f));
  std::vector<float> response(2 * frames);
  for (size_t ear = 0; ear < 2; ++ear) {
    Random random(ear + 1);
    const std::span<float> out = std::span(response).subspan(ear * frames, frames);
    float low = 0.0f;
    float low_gain = 1.0f;
    float high_gain = p.flGainHF;
    double energy = 0.0;  // Energy of the noise before GainHF.
    for (size_t i = late; i < frames; ++i) {
      const auto noise = static_cast<float>(random.Uniform(-1.0, 1.0));
      low += mix * (noise - low);
      out[i] = low_gain * low + high_gain * (noise - low);
      energy += static_cast<double>(low_gain) * static_cast<double>(low_gain) / 3.0;
      low_gain *= low_fade;
      high_gain *= high_fade;
    }
    const float scale = kLateLevel * gain * p.flLateReverbGain /
                        static_cast<float>(std::sqrt(std::max(energy, 1e-12)));
    for (float& sample : out) {
      sample *= scale;
    }
    constexpr int kReflections = 4;
    const float reflection = kEarlyLevel * gain * p.flReflectionsGain;
    for (int i = 0; i < kReflections; ++i) {
      const double at = random.Uniform(0.0, std::max<double>(p.flLateReverbDelay, 0.003) * rate);
      out[first + static_cast<size_t>(at)] += i % 2 == 0 ? reflection : -reflection;
    }
  }
  return response;
}

}  // namespace

WebAudioTimes ReadWebAudioTimes() {
  double times[3] = {};
  lararium_audio_times(times);
  return {times[0], times[1], times[2]};
}

struct SoundGraph::Device {
  double rate = 0.0;
  double head = 0.0;   // Seconds that were rendered.
  double begin = 0.0;  // Time of the context at Create().
  Listener listener;
  std::optional<std::pair<stage::Reverb, float>> reverb;

  ~Device() { lararium_audio_close(); }
};

struct SoundGraph::Source {
  size_t index = 0;
  int clip = -1;
  bool head_locked = false;
  bool fresh = false;  // Nothing was handed over since it was started.
  double end = 0.0;    // Time of Device::head at which it has ended.
  SourceState state;
  Values values;
  std::optional<ClipStream> stream;
  double queued = 0.0;  // Time of Device::head up to which the stream is queued.
  std::vector<int16_t> pieces;
};

SoundGraph::SoundGraph(std::shared_ptr<const SoundLibrary> library, std::unique_ptr<Device> device)
    : library_(std::move(library)),
      device_(std::move(device)),
      buffers_(library_->clips().size()),
      sources_(kSources) {
  for (size_t i = 0; i < kSources; ++i) {
    sources_[i].index = i;
  }
}

SoundGraph::~SoundGraph() = default;

// Without HRTF, as for loudspeakers, browsers would pan by level only; a page always has it.
Result<std::unique_ptr<SoundGraph>> SoundGraph::Create(std::shared_ptr<const SoundLibrary> library,
                                                       bool /*hrtf*/) {
  const double rate = lararium_audio_open();
  if (rate <= 0.0) {
    return Status::Error("sound", "the page has no output for it", "play without sound");
  }
  auto device = std::make_unique<Device>();
  device->rate = rate;
  device->begin = ReadWebAudioTimes().head;
  std::unique_ptr<SoundGraph> graph(new SoundGraph(std::move(library), std::move(device)));
  graph->hrtf_ = true;
  return graph;
}

uint32_t SoundGraph::BufferOf(int clip, bool head_locked) {
  Buffers& buffers = buffers_[static_cast<size_t>(clip)];
  const Clip& source = library_->clips()[static_cast<size_t>(clip)];
  uint32_t& buffer = head_locked ? buffers.stereo : buffers.mono;
  if (buffer == 0) {
    std::vector<int16_t> samples;
    Convert(source.samples, source, head_locked ? Channels::kStereo : Channels::kMono, samples);
    buffer = lararium_audio_buffer(samples.data(), static_cast<size_t>(source.frames),
                                   head_locked ? 2 : 1, source.rate);
  }
  return buffer;
}

bool SoundGraph::StartStream(Source& source, const Clip& clip, int64_t frame) {
  // The clip's end is known from the stream's.
  const bool loops = source.end == HUGE_VAL;
  source.stream = ClipStream::Open(clip, frame, loops,
                                   source.head_locked ? Channels::kStereo : Channels::kMono);
  if (!source.stream) {
    return false;
  }
  source.queued = device_->head;
  source.pieces.reserve(2 * kPiecesAtOnce * ClipStream::kPieceFrames);
  Feed(source);
  return true;
}

bool SoundGraph::Start(size_t index, int clip, int64_t frame, bool loops, bool head_locked) {
  CHECK(clip >= 0 && static_cast<size_t>(clip) < library_->clips().size());
  Stop(index);
  Source& source = sources_[index];
  const Clip& played = library_->clips()[static_cast<size_t>(clip)];
  const double seconds = static_cast<double>(frame) / played.rate;
  source.clip = clip;
  source.head_locked = head_locked;
  source.fresh = true;
  source.end = loops ? HUGE_VAL : device_->head + played.seconds() - seconds;
  lararium_audio_place(index, !head_locked);
  if (played.samples.empty()) {
    return StartStream(source, played, frame);
  }
  lararium_audio_play(index, BufferOf(clip, head_locked), seconds, loops);
  return true;
}

void SoundGraph::Stop(size_t index) {
  Source& source = sources_[index];
  if (source.clip >= 0) {
    lararium_audio_stop(index);
    source.stream.reset();
    source.clip = -1;
  }
}

bool SoundGraph::Playing(size_t index) {
  return sources_[index].clip >= 0 && device_->head < sources_[index].end;
}

void SoundGraph::Set(size_t index, const SourceState& state) { sources_[index].state = state; }

void SoundGraph::SetListener(const Listener& listener) { device_->listener = listener; }

void SoundGraph::SetReverb(stage::Reverb reverb, float db) {
  if (device_->reverb == std::pair(reverb, db)) {
    return;
  }
  device_->reverb = {reverb, db};
  std::vector<float> response;
  if (reverb != stage::Reverb::kNone) {
    response = ResponseOf(PresetOf(reverb), db, device_->rate);
  }
  lararium_audio_reverb(response.data(), response.size() / 2);
}

void SoundGraph::Feed(Source& source) {
  const Clip& clip = library_->clips()[static_cast<size_t>(source.clip)];
  const size_t channels = source.head_locked ? 2 : 1;
  while (source.queued < std::min(device_->head + kStreamAhead, source.end)) {
    source.pieces.clear();
    for (int i = 0; i < kPiecesAtOnce; ++i) {
      const std::span<const int16_t> piece = source.stream->Next();
      source.pieces.insert(source.pieces.end(), piece.begin(), piece.end());
    }
    const size_t frames = source.pieces.size() / channels;
    if (frames == 0) {
      source.end = source.queued;
      return;
    }
    lararium_audio_queue(source.index, source.pieces.data(), frames, static_cast<int>(channels),
                         clip.rate, device_->begin + source.queued);
    source.queued += static_cast<double>(frames) / clip.rate;
  }
}

void SoundGraph::Render(std::span<float> stereo) {
  std::fill(stereo.begin(), stereo.end(), 0.0f);
  const double seconds = static_cast<double>(stereo.size() / 2) / kRate;
  for (Source& source : sources_) {
    if (source.clip < 0) {
      continue;
    }
    if (source.stream) {
      Feed(source);
    }
    const Values values = ValuesOf(source.state, source.head_locked, device_->listener);
    if (source.fresh || Differ(values, source.values)) {
      lararium_audio_set(source.index, &values.gain, seconds);
      source.values = values;
      source.fresh = false;
    }
  }
  lararium_audio_advance(seconds);
  device_->head += seconds;
}

}  // namespace lararium::audio
