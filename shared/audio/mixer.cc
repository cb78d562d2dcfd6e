#include "shared/audio/mixer.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "shared/audio/decibels.h"
#include "shared/core/check.h"

namespace lararium::audio {
namespace {

constexpr float kFadeOutSeconds = 0.03f;
// Time constants of positions and obstruction, and the distance beyond which a motion is a jump.
constexpr float kFollowSeconds = 0.02f;
constexpr float kObstructionSeconds = 0.08f;
constexpr float kLeapMetres = 1.5f;
constexpr float kDuckSeconds = 0.12f;
constexpr float kRecoverSeconds = 0.7f;
// Level of speech at which buses are lowered completely; below it, less.
constexpr float kDuckingLevel = 0.3f;
// A clip whose voice has ended this close to the clip's end plays to its end: it lags by that time.
constexpr double kRingOutSeconds = 0.25;

// Share of a difference that a first-order lag covers in some time.
float Share(float seconds, float time_constant) {
  return 1.0f - std::exp(-seconds / time_constant);
}

glm::vec3 Towards(const glm::vec3& from, const glm::vec3& to, float share) {
  return glm::distance(from, to) > kLeapMetres ? to : from + share * (to - from);
}

// Approximate loudness at the listener; the quietest voices are left out.
float Loudness(const Voice& voice, const Listener& listener) {
  const float distance =
      voice.head_locked ? 1.0f : std::max(glm::distance(voice.position, listener.position), 1.0f);
  return voice.gain / distance * (1.0f - 0.5f * voice.obstruction);
}

}  // namespace

Status MixerOptions::Validate() const {
  if (!(max_lead > 0.0 && max_lag > 0.0 && late_start >= 0.0 && late_start <= max_lag &&
        block_frames > 0)) {
    return Status::Error("sound",
                         "max_lead, max_lag and block_frames must be positive, and late_start "
                         "must be 0 to max_lag");
  }
  return Status();
}

Result<std::unique_ptr<Mixer>> Mixer::Create(std::shared_ptr<const SoundLibrary> library,
                                             const MixerOptions& options) {
  CHECK(library != nullptr);
  LARARIUM_RETURN_IF_ERROR(options.Validate());
  LARARIUM_ASSIGN_OR_RETURN(std::unique_ptr<SoundGraph> graph,
                            SoundGraph::Create(std::move(library), options.hrtf));
  std::unique_ptr<Mixer> mixer(new Mixer(std::move(graph), options));
  mixer->onsets_.reserve(SoundGraph::kSources);
  return mixer;
}

size_t Mixer::playing() const {
  return static_cast<size_t>(
      std::count_if(slots_.begin(), slots_.end(), [](const Slot& slot) { return slot.used; }));
}

double Mixer::Seconds(int clip) const {
  return graph_->library().clips()[static_cast<size_t>(clip)].seconds();
}

// Returns the voice that the slot plays in time; nullptr: none.
const Voice* Mixer::VoiceOf(const Slot& slot, const SoundScene& scene, double begin) const {
  for (const Voice& voice : scene.voices) {
    if (voice.source == slot.source && voice.clip == slot.clip && voice.loops == slot.loops &&
        voice.head_locked == slot.head_locked) {
      const double lead = slot.position - (begin - voice.began);
      return lead <= options_.max_lead && -lead <= options_.max_lag ? &voice : nullptr;
    }
  }
  return nullptr;
}

// Whether the voice has ended because its clip is over: a late clip may end late.
bool Mixer::RingsOut(const Slot& slot, double begin) const {
  const double seconds = Seconds(slot.clip);
  return !slot.loops && seconds - slot.position <= kRingOutSeconds &&
         begin - slot.began >= seconds - options_.max_lead;
}

void Mixer::Follow(const Voice& voice, float seconds, Slot& slot) const {
  const float share = Share(seconds, kFollowSeconds);
  slot.began = voice.began;
  slot.gain = voice.gain;
  slot.bus = voice.bus;
  slot.state.position = Towards(slot.state.position, voice.position, share);
  slot.state.facing += share * (voice.facing - slot.state.facing);
  slot.state.obstruction += Share(seconds, kObstructionSeconds) *
                            (std::clamp(voice.obstruction, 0.0f, 1.0f) - slot.state.obstruction);
}

void Mixer::Plan(const Voice& voice, double begin, size_t frames) {
  const double late = begin - voice.began;
  const bool over = !voice.loops && late >= Seconds(voice.clip);
  // Its first sample, relative to this block.
  const double first = std::ceil(-late * kRate - 1e-6);
  if (over || first >= static_cast<double>(frames) || onsets_.size() == onsets_.capacity()) {
    return;
  }
  onsets_.push_back({first > 0.0 ? static_cast<size_t>(first) : 0, &voice});
}

void Mixer::Reconcile(const SoundScene& scene, double begin, size_t frames) {
  const float seconds = static_cast<float>(frames) / kRate;
  onsets_.clear();
  std::array<bool, SoundGraph::kSources> goes_on = {};
  for (size_t i = 0; i < slots_.size(); ++i) {
    Slot& slot = slots_[i];
    if (!slot.used || slot.leaving) {
      continue;
    }
    if (scene.held) {
      slot.leaving = slot.bus != Bus::kAmbience;
      goes_on[i] = !slot.leaving;
      continue;
    }
    if (const Voice* voice = VoiceOf(slot, scene, begin)) {
      Follow(*voice, seconds, slot);
      goes_on[i] = true;
    } else if (slot.ended) {
      Release(slot);
    } else {
      slot.leaving = !RingsOut(slot, begin);
    }
  }
  if (scene.held) {
    return;
  }
  for (const Voice& voice : scene.voices) {
    const auto plays = [&](const Slot& slot) {
      return goes_on[static_cast<size_t>(&slot - slots_.data())] && slot.source == voice.source;
    };
    if (voice.clip >= 0 && voice.gain > 0.0f && std::none_of(slots_.begin(), slots_.end(), plays)) {
      Plan(voice, begin, frames);
    }
  }
  std::sort(onsets_.begin(), onsets_.end(),
            [](const Onset& a, const Onset& b) { return a.frame < b.frame; });
}

// Returns a free slot, or else the quietest one if it is quieter than the voice, or nullptr.
Mixer::Slot* Mixer::FreeSlot(const Voice& voice) {
  const auto loudness = [this](const Slot& slot) {
    Voice played;
    played.head_locked = slot.head_locked;
    played.position = slot.state.position;
    played.obstruction = slot.state.obstruction;
    played.gain = slot.used ? slot.gain * slot.level : -1.0f;
    return Loudness(played, listener_);
  };
  Slot* quietest = &slots_[0];
  for (Slot& slot : slots_) {
    if (loudness(slot) < loudness(*quietest)) {
      quietest = &slot;
    }
  }
  return loudness(*quietest) < Loudness(voice, listener_) ? quietest : nullptr;
}

void Mixer::Start(const Voice& voice, double begin) {
  Slot* slot = FreeSlot(voice);
  if (slot == nullptr) {
    return;
  }
  Release(*slot);
  const bool from_beginning = begin - voice.began <= options_.late_start;
  const double seconds = Seconds(voice.clip);
  const int rate = graph_->library().clips()[static_cast<size_t>(voice.clip)].rate;
  slot->position = from_beginning ? 0.0 : begin - voice.began;
  const double within = voice.loops ? std::fmod(slot->position, seconds) : slot->position;
  const auto frames = static_cast<int64_t>(std::llround(seconds * rate));
  const int64_t frame = std::min<int64_t>(std::llround(within * rate), frames - 1);
  const auto index = static_cast<size_t>(slot - slots_.data());
  slot->used = graph_->Start(index, voice.clip, frame, voice.loops, voice.head_locked);
  slot->leaving = false;
  slot->ended = false;
  slot->source = voice.source;
  slot->clip = voice.clip;
  slot->loops = voice.loops;
  slot->head_locked = voice.head_locked;
  slot->level = 1.0f;
  slot->began = voice.began;
  slot->gain = voice.gain;
  slot->bus = voice.bus;
  slot->state = {0.0f, voice.position, voice.facing, voice.obstruction};
}

void Mixer::Release(Slot& slot) {
  if (slot.used) {
    graph_->Stop(static_cast<size_t>(&slot - slots_.data()));
    slot.used = false;
  }
}

// Lowers the buses during speech, by its loudness at the listener.
void Mixer::Duck(float seconds) {
  float heard = 0.0f;
  bool described = false;
  for (const Slot& slot : slots_) {
    const bool sounds = slot.used && !slot.leaving && !slot.ended;
    described = described || (sounds && slot.bus == Bus::kDescription);
    if (sounds && slot.bus == Bus::kSpeech) {
      const float distance =
          slot.head_locked ? 1.0f
                           : std::max(glm::distance(slot.state.position, listener_.position), 1.0f);
      heard = std::max(heard, slot.gain / distance);
    }
  }
  const float depth = std::min(heard / kDuckingLevel, 1.0f);
  for (size_t bus = 0; bus < duck_db_.size(); ++bus) {
    const float wanted = std::min(depth * kDuckDb[bus], described ? kDescribedDb[bus] : 0.0f);
    const float pace = wanted < duck_db_[bus] ? kDuckSeconds : kRecoverSeconds;
    duck_db_[bus] += Share(seconds, pace) * (wanted - duck_db_[bus]);
  }
}

void Mixer::MoveListener(const Listener& listener, float seconds) {
  const float share = placed_ ? Share(seconds, kFollowSeconds) : 1.0f;
  placed_ = true;
  listener_.position = Towards(listener_.position, listener.position, share);
  listener_.forward =
      glm::normalize(listener_.forward + share * (listener.forward - listener_.forward) +
                     1e-6f * listener.forward);
  const glm::vec3 up = listener_.up + share * (listener.up - listener_.up) + 1e-6f * listener.up;
  listener_.up = glm::normalize(up);
  graph_->SetListener(listener_);
}

// Renders the playing slots up to the next onset.
void Mixer::RenderPart(std::span<float> stereo) {
  if (stereo.empty()) {
    return;
  }
  const double seconds = static_cast<double>(stereo.size() / 2) / kRate;
  for (size_t i = 0; i < slots_.size(); ++i) {
    Slot& slot = slots_[i];
    if (!slot.used) {
      continue;
    }
    if (slot.leaving) {
      slot.level = std::max(slot.level - static_cast<float>(seconds) / kFadeOutSeconds, 0.0f);
    }
    slot.state.gain =
        slot.gain * slot.level * AmplitudeFromDecibels(duck_db_[static_cast<size_t>(slot.bus)]);
    graph_->Set(i, slot.state);
  }
  graph_->Render(stereo);
  for (size_t i = 0; i < slots_.size(); ++i) {
    Slot& slot = slots_[i];
    if (!slot.used) {
      continue;
    }
    slot.position += seconds;
    slot.ended = slot.ended || !graph_->Playing(i);
    if (slot.leaving && (slot.ended || slot.level == 0.0f)) {
      Release(slot);
    }
  }
}

void Mixer::RenderBlock(const SoundScene& scene, double begin, std::span<float> stereo) {
  const size_t frames = stereo.size() / 2;
  const float seconds = static_cast<float>(frames) / kRate;
  MoveListener(scene.listener, seconds);
  graph_->SetReverb(scene.reverb, scene.reverb_db);
  Reconcile(scene, begin, frames);
  Duck(seconds);
  size_t done = 0;
  for (const Onset& onset : onsets_) {
    RenderPart(stereo.subspan(2 * done, 2 * (onset.frame - done)));
    done = onset.frame;
    Start(*onset.voice, begin + static_cast<double>(done) / kRate);
  }
  RenderPart(stereo.subspan(2 * done));
}

void Mixer::Render(const SoundScene& scene, double begin, std::span<float> stereo) {
  for (size_t frame = 0; frame < stereo.size() / 2; frame += options_.block_frames) {
    const size_t count = std::min(options_.block_frames, stereo.size() / 2 - frame);
    RenderBlock(scene, begin + static_cast<double>(frame) / kRate,
                stereo.subspan(2 * frame, 2 * count));
  }
}

}  // namespace lararium::audio
