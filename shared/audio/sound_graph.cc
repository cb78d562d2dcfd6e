#include "shared/audio/sound_graph.h"

#define AL_ALEXT_PROTOTYPES
#include <AL/al.h>
#include <AL/alc.h>
#include <AL/alext.h>
#include <AL/efx.h>

#include <algorithm>
#include <optional>

#include "shared/audio/clip_stream.h"
#include "shared/audio/decibels.h"
#include "shared/audio/sound_damping.h"
#include "shared/core/check.h"

namespace lararium::audio {
namespace {

constexpr size_t kPieces = 3;  // Pieces of a streamed sound that are queued in advance.

// Makes our context current on the calling thread, within a scope.
class Entered {
 public:
  explicit Entered(ALCcontext* context) { alcSetThreadContext(context); }
  ~Entered() { alcSetThreadContext(nullptr); }
  Entered(const Entered&) = delete;
  Entered& operator=(const Entered&) = delete;
};

void SetEffect(ALuint effect, const EFXEAXREVERBPROPERTIES& p, float db) {
  alEffecti(effect, AL_EFFECT_TYPE, AL_EFFECT_EAXREVERB);
  alEffectf(effect, AL_EAXREVERB_DENSITY, p.flDensity);
  alEffectf(effect, AL_EAXREVERB_DIFFUSION, p.flDiffusion);
  alEffectf(effect, AL_EAXREVERB_GAIN, std::min(p.flGain * AmplitudeFromDecibels(db), 1.0f));
  alEffectf(effect, AL_EAXREVERB_GAINHF, p.flGainHF);
  alEffectf(effect, AL_EAXREVERB_GAINLF, p.flGainLF);
  alEffectf(effect, AL_EAXREVERB_DECAY_TIME, p.flDecayTime);
  alEffectf(effect, AL_EAXREVERB_DECAY_HFRATIO, p.flDecayHFRatio);
  alEffectf(effect, AL_EAXREVERB_DECAY_LFRATIO, p.flDecayLFRatio);
  alEffectf(effect, AL_EAXREVERB_REFLECTIONS_GAIN, p.flReflectionsGain);
  alEffectf(effect, AL_EAXREVERB_REFLECTIONS_DELAY, p.flReflectionsDelay);
  alEffectfv(effect, AL_EAXREVERB_REFLECTIONS_PAN, p.flReflectionsPan);
  alEffectf(effect, AL_EAXREVERB_LATE_REVERB_GAIN, p.flLateReverbGain);
  alEffectf(effect, AL_EAXREVERB_LATE_REVERB_DELAY, p.flLateReverbDelay);
  alEffectfv(effect, AL_EAXREVERB_LATE_REVERB_PAN, p.flLateReverbPan);
  alEffectf(effect, AL_EAXREVERB_ECHO_TIME, p.flEchoTime);
  alEffectf(effect, AL_EAXREVERB_ECHO_DEPTH, p.flEchoDepth);
  alEffectf(effect, AL_EAXREVERB_MODULATION_TIME, p.flModulationTime);
  alEffectf(effect, AL_EAXREVERB_MODULATION_DEPTH, p.flModulationDepth);
  alEffectf(effect, AL_EAXREVERB_AIR_ABSORPTION_GAINHF, p.flAirAbsorptionGainHF);
  alEffectf(effect, AL_EAXREVERB_HFREFERENCE, p.flHFReference);
  alEffectf(effect, AL_EAXREVERB_LFREFERENCE, p.flLFReference);
  alEffectf(effect, AL_EAXREVERB_ROOM_ROLLOFF_FACTOR, p.flRoomRolloffFactor);
  alEffecti(effect, AL_EAXREVERB_DECAY_HFLIMIT, p.iDecayHFLimit);
}

Channels ChannelsOf(bool head_locked) { return head_locked ? Channels::kStereo : Channels::kMono; }

void GiveSamples(ALuint buffer,
                 std::span<const int16_t> samples,
                 const Clip& clip,
                 bool head_locked) {
  alBufferData(buffer, head_locked ? AL_FORMAT_STEREO16 : AL_FORMAT_MONO16, samples.data(),
               static_cast<ALsizei>(samples.size_bytes()), clip.rate);
}

}  // namespace

struct SoundGraph::Device {
  ALCdevice* device = nullptr;
  ALCcontext* context = nullptr;
  ALuint direct_filter = 0;
  ALuint send_filter = 0;
  ALuint effect = 0;
  ALuint effect_slot = 0;
  std::optional<std::pair<stage::Reverb, float>> reverb;

  ~Device() {
    if (context != nullptr) {
      alcDestroyContext(context);  // Also destroys all objects of the context.
    }
    if (device != nullptr) {
      alcCloseDevice(device);
    }
  }
};

struct SoundGraph::Source {
  ALuint id = 0;
  int clip = -1;
  bool loops = false;
  bool head_locked = false;
  // Used by streamed clips only.
  std::optional<ClipStream> stream;
  std::array<ALuint, kPieces> pieces = {};
  bool drained = false;  // The stream has ended.

  // Queues the next piece of the stream; the stream has ended if there is none.
  void Fill(const Clip& played, ALuint buffer) {
    const std::span<const int16_t> piece = stream->Next();
    drained = piece.empty();
    if (!drained) {
      GiveSamples(buffer, piece, played, head_locked);
      alSourceQueueBuffers(id, 1, &buffer);
    }
  }
};

SoundGraph::SoundGraph(std::shared_ptr<const SoundLibrary> library, std::unique_ptr<Device> device)
    : library_(std::move(library)),
      device_(std::move(device)),
      buffers_(library_->clips().size()),
      sources_(kSources) {}

// OpenAL's objects are destroyed with their device.
SoundGraph::~SoundGraph() = default;

Result<std::unique_ptr<SoundGraph>> SoundGraph::Create(std::shared_ptr<const SoundLibrary> library,
                                                       bool hrtf) {
  constexpr const char* kWhat = "sound";
  constexpr const char* kRemedy = "install libopenal1 1.19 or later";
  auto device = std::make_unique<Device>();
  if (alcIsExtensionPresent(nullptr, "ALC_SOFT_loopback") == ALC_FALSE) {
    return Status::Error(kWhat, "this OpenAL cannot render into memory", kRemedy);
  }
  device->device = alcLoopbackOpenDeviceSOFT(nullptr);
  if (device->device == nullptr) {
    return Status::Error(kWhat, "OpenAL does not start", kRemedy);
  }
  const ALCint attributes[] = {ALC_FORMAT_CHANNELS_SOFT,
                               ALC_STEREO_SOFT,
                               ALC_FORMAT_TYPE_SOFT,
                               ALC_FLOAT_SOFT,
                               ALC_FREQUENCY,
                               kRate,
                               ALC_HRTF_SOFT,
                               hrtf ? ALC_TRUE : ALC_FALSE,
                               ALC_OUTPUT_LIMITER_SOFT,
                               ALC_TRUE,
                               ALC_MAX_AUXILIARY_SENDS,
                               1,
                               ALC_MONO_SOURCES,
                               static_cast<ALCint>(kSources),
                               ALC_STEREO_SOURCES,
                               static_cast<ALCint>(kSources),
                               0};
  device->context = alcCreateContext(device->device, attributes);
  if (device->context == nullptr) {
    return Status::Error(kWhat, "OpenAL cannot mix stereo at 48 kHz", kRemedy);
  }
  std::unique_ptr<SoundGraph> graph(new SoundGraph(std::move(library), std::move(device)));
  Device& d = *graph->device_;
  ALCint heads = ALC_FALSE;
  alcGetIntegerv(d.device, ALC_HRTF_SOFT, 1, &heads);
  graph->hrtf_ = heads == ALC_TRUE;

  const Entered entered(d.context);
  alDistanceModel(AL_INVERSE_DISTANCE_CLAMPED);
  alDopplerFactor(0.0f);  // Poses jump when the tracker corrects itself.
  alGenFilters(1, &d.direct_filter);
  alGenFilters(1, &d.send_filter);
  alFilteri(d.direct_filter, AL_FILTER_TYPE, AL_FILTER_LOWPASS);
  alFilteri(d.send_filter, AL_FILTER_TYPE, AL_FILTER_LOWPASS);
  alGenEffects(1, &d.effect);
  alGenAuxiliaryEffectSlots(1, &d.effect_slot);
  // The best resampler that is not wasteful; only clips of other rates are resampled.
  const ALint resamplers = alGetInteger(AL_NUM_RESAMPLERS_SOFT);
  const ALint resampler = std::clamp(3, 0, std::max(resamplers - 1, 0));
  for (Source& source : graph->sources_) {
    alGenSources(1, &source.id);
    alSourcef(source.id, AL_REFERENCE_DISTANCE, kReferenceDistance);
    alSourcef(source.id, AL_MAX_DISTANCE, kMaxDistance);
    alSourcef(source.id, AL_MAX_GAIN, kMaxGain);
    alSourcei(source.id, AL_SOURCE_RESAMPLER_SOFT, resampler);
    alGenBuffers(kPieces, source.pieces.data());
  }
  if (alGetError() != AL_NO_ERROR) {
    return Status::Error(kWhat, "OpenAL lacks sources, filters or effects", kRemedy);
  }
  return graph;
}

uint32_t SoundGraph::BufferOf(int clip, bool head_locked) {
  Buffers& buffers = buffers_[static_cast<size_t>(clip)];
  uint32_t& buffer = head_locked ? buffers.stereo : buffers.mono;
  if (buffer == 0) {
    const Clip& source = library_->clips()[static_cast<size_t>(clip)];
    std::vector<int16_t> samples;
    Convert(source.samples, source, ChannelsOf(head_locked), samples);
    alGenBuffers(1, &buffer);
    GiveSamples(buffer, samples, source, head_locked);
  }
  return buffer;
}

bool SoundGraph::StartStream(Source& source, const Clip& clip, int64_t frame) {
  source.stream = ClipStream::Open(clip, frame, source.loops, ChannelsOf(source.head_locked));
  if (!source.stream) {
    return false;
  }
  source.drained = false;
  for (const ALuint piece : source.pieces) {
    if (!source.drained) {
      source.Fill(clip, piece);
    }
  }
  return true;
}

bool SoundGraph::Start(size_t index, int clip, int64_t frame, bool loops, bool head_locked) {
  CHECK(clip >= 0 && static_cast<size_t>(clip) < library_->clips().size());
  Stop(index);
  const Entered entered(device_->context);
  Source& source = sources_[index];
  const Clip& played = library_->clips()[static_cast<size_t>(clip)];
  source.clip = clip;
  source.loops = loops;
  source.head_locked = head_locked;
  const bool streamed = played.samples.empty();
  alSourcei(source.id, AL_SOURCE_RELATIVE, head_locked ? AL_TRUE : AL_FALSE);
  alSourcei(source.id, AL_DIRECT_CHANNELS_SOFT, head_locked ? AL_TRUE : AL_FALSE);
  alSourcei(source.id, AL_LOOPING, loops && !streamed ? AL_TRUE : AL_FALSE);
  if (streamed) {
    if (!StartStream(source, played, frame)) {
      return false;
    }
  } else {
    alSourcei(source.id, AL_BUFFER, static_cast<ALint>(BufferOf(clip, head_locked)));
    if (frame > 0) {
      alSourcei(source.id, AL_SAMPLE_OFFSET, static_cast<ALint>(frame));
    }
  }
  alSourcePlay(source.id);
  return true;
}

void SoundGraph::Stop(size_t index) {
  const Entered entered(device_->context);
  Source& source = sources_[index];
  alSourceRewind(source.id);
  alSourcei(source.id, AL_BUFFER, 0);
  source.stream.reset();
  source.clip = -1;
}

bool SoundGraph::Playing(size_t index) {
  const Entered entered(device_->context);
  ALint state = AL_STOPPED;
  alGetSourcei(sources_[index].id, AL_SOURCE_STATE, &state);
  return state == AL_PLAYING;
}

void SoundGraph::Set(size_t index, const SourceState& state) {
  const Entered entered(device_->context);
  const Source& source = sources_[index];
  const Device& d = *device_;
  alSourcef(source.id, AL_GAIN, std::clamp(state.gain, 0.0f, kMaxGain));
  if (source.head_locked) {
    alSource3f(source.id, AL_POSITION, 0.0f, 0.0f, 0.0f);
    alSource3f(source.id, AL_DIRECTION, 0.0f, 0.0f, 0.0f);
    alSourcei(source.id, AL_DIRECT_FILTER, AL_FILTER_NULL);
    alSource3i(source.id, AL_AUXILIARY_SEND_FILTER, AL_EFFECTSLOT_NULL, 0, AL_FILTER_NULL);
    return;
  }
  alSourcefv(source.id, AL_POSITION, &state.position.x);
  const bool faces = state.facing != glm::vec3(0.0f);
  alSourcefv(source.id, AL_DIRECTION, &state.facing.x);
  alSourcef(source.id, AL_CONE_INNER_ANGLE, faces ? kMouthConeDeg : 360.0f);
  alSourcef(source.id, AL_CONE_OUTER_GAIN, AmplitudeFromDecibels(kBehindDb));
  alSourcef(source.id, AL_CONE_OUTER_GAINHF, AmplitudeFromDecibels(kBehindHighDb));
  const float blocked = std::clamp(state.obstruction, 0.0f, 1.0f);
  alFilterf(d.direct_filter, AL_LOWPASS_GAIN, AmplitudeFromDecibels(blocked * kObstructedDb));
  alFilterf(d.direct_filter, AL_LOWPASS_GAINHF, AmplitudeFromDecibels(blocked * kObstructedHighDb));
  alSourcei(source.id, AL_DIRECT_FILTER, static_cast<ALint>(d.direct_filter));
  alFilterf(d.send_filter, AL_LOWPASS_GAIN, AmplitudeFromDecibels(0.5f * blocked * kObstructedDb));
  alFilterf(d.send_filter, AL_LOWPASS_GAINHF,
            AmplitudeFromDecibels(0.5f * blocked * kObstructedHighDb));
  alSource3i(source.id, AL_AUXILIARY_SEND_FILTER, static_cast<ALint>(d.effect_slot), 0,
             static_cast<ALint>(d.send_filter));
}

void SoundGraph::SetListener(const Listener& listener) {
  const Entered entered(device_->context);
  const float orientation[] = {listener.forward.x, listener.forward.y, listener.forward.z,
                               listener.up.x,      listener.up.y,      listener.up.z};
  alListenerfv(AL_POSITION, &listener.position.x);
  alListenerfv(AL_ORIENTATION, orientation);
}

void SoundGraph::SetReverb(stage::Reverb reverb, float db) {
  Device& d = *device_;
  if (d.reverb == std::pair(reverb, db)) {
    return;
  }
  const Entered entered(d.context);
  d.reverb = {reverb, db};
  if (reverb == stage::Reverb::kNone) {
    alAuxiliaryEffectSloti(d.effect_slot, AL_EFFECTSLOT_EFFECT, AL_EFFECT_NULL);
    return;
  }
  SetEffect(d.effect, PresetOf(reverb), db);
  alAuxiliaryEffectSloti(d.effect_slot, AL_EFFECTSLOT_EFFECT, static_cast<ALint>(d.effect));
}

void SoundGraph::Feed(Source& source) {
  ALint played = 0;
  alGetSourcei(source.id, AL_BUFFERS_PROCESSED, &played);
  for (; played > 0; --played) {
    ALuint buffer = 0;
    alSourceUnqueueBuffers(source.id, 1, &buffer);
    if (!source.drained) {
      source.Fill(library_->clips()[static_cast<size_t>(source.clip)], buffer);
    }
  }
}

void SoundGraph::Render(std::span<float> stereo) {
  const Entered entered(device_->context);
  for (Source& source : sources_) {
    if (source.stream) {
      Feed(source);
    }
  }
  alcRenderSamplesSOFT(device_->device, stereo.data(), static_cast<ALCsizei>(stereo.size() / 2));
}

}  // namespace lararium::audio
