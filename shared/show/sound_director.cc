#include "shared/show/sound_director.h"

#include <cmath>
#include <utility>

#include "shared/geometry/glm_convert.h"

namespace lararium::show {
namespace {

using audio::Bus;
using audio::SoundScene;
using audio::Voice;

// Position of the listener before the first pose: in front of the stage.
constexpr glm::vec3 kVisitorsHead = {0.0f, 1.6f, 2.0f};
// As loud as a voice at a distance of two metres.
constexpr float kDescriptionGain = 0.5f;
// Prefix for clips of lines; no sound can have such a name.
constexpr const char* kLinePrefix = "line ";

enum class Kind : uint64_t { kLine = 1, kAction, kState, kAmbience, kDrama, kDescription };

uint64_t SourceId(Kind kind, size_t which, size_t part = 0) {
  return static_cast<uint64_t>(kind) << 56 | static_cast<uint64_t>(which) << 16 |
         static_cast<uint64_t>(part);
}

float FromDb(float db) { return std::pow(10.0f, db / 20.0f); }

// Phase offset, so that objects of one kind do not sound in step.
double Phase(size_t which) { return std::fmod(0.6180339887 * static_cast<double>(which + 1), 1.0); }

}  // namespace

Result<SoundDirector> SoundDirector::Create(const ShowContent& content, Log& log) {
  SoundDirector director;
  director.listener_.position = kVisitorsHead;
  std::vector<audio::SoundData> sounds = content.sounds;
  for (const Speech& line : content.speech) {
    if (!line.sound.empty()) {
      const auto bytes = std::make_shared<const std::vector<std::byte>>(line.sound);
      sounds.push_back({kLinePrefix + line.name, *bytes, bytes});
    }
  }
  LARARIUM_ASSIGN_OR_RETURN(director.library_, audio::SoundLibrary::Load(std::move(sounds)));
  for (const Speech& line : content.speech) {
    director.lines_.push_back(director.library_->Find(kLinePrefix + line.name));
  }
  for (const audio::SoundData& sound : content.sounds) {
    director.drama_sounds_.push_back(director.library_->Find(sound.name));
  }
  for (const StageObject& object : content.objects) {
    ObjectClips& clips = director.objects_.emplace_back();
    clips.model = object.model;
    const std::string who = "object '" + object.name + "'";
    for (const stage::ObjectAction& action : object.model->use().actions) {
      clips.actions.push_back(director.ClipOf(action.sound.name, who, log));
    }
    for (const stage::StateSound& sound : object.model->use().sounds) {
      clips.sounds.push_back(director.ClipOf(sound.name, who, log));
    }
  }
  for (const ShowPlace& place : content.places) {
    for (const stage::Ambience& ambience : place.stage.acoustics.ambience) {
      director.ClipOf(ambience.sound, "place '" + place.stage.name + "'", log);
    }
    director.places_.push_back(director.SoundOf(place.stage));
  }
  return director;
}

// Returns -1 if there is no such sound.
int SoundDirector::ClipOf(const std::string& name, const std::string& who, Log& log) const {
  const int clip = name.empty() ? -1 : library_->Find(name);
  if (!name.empty() && clip < 0) {
    log.Warn("{}: there is no sound '{}'; it is silent", who, name);
  }
  return clip;
}

SoundDirector::PlaceSound SoundDirector::SoundOf(const stage::Place& place) const {
  PlaceSound sound{place.acoustics, {}, audio::SoundBlockers(place.occluders)};
  for (const stage::Ambience& ambience : place.acoustics.ambience) {
    sound.ambience.push_back(library_->Find(ambience.sound));
  }
  return sound;
}

void SoundDirector::SetPlace(size_t index, const stage::Place& place) {
  places_[index] = SoundOf(place);
}

Status SoundDirector::Teach(stage::Sounds& sounds) const {
  for (const int clip : drama_sounds_) {
    LARARIUM_RETURN_IF_ERROR(
        sounds.Add(library_->clips()[static_cast<size_t>(clip)].name, Seconds(clip)));
  }
  return Status();
}

void SoundDirector::Begin(double time,
                          size_t place,
                          const std::optional<geometry::Rigid3>& camera_from_stage,
                          SoundScene& scene) {
  if (camera_from_stage) {
    // The camera looks along its +Z, its +Y points down.
    const Eigen::Quaterniond stage_from_camera = camera_from_stage->rotation.conjugate();
    listener_.position = geometry::ToGlm(camera_from_stage->Center());
    listener_.forward =
        geometry::ToGlm(Eigen::Vector3d(stage_from_camera * Eigen::Vector3d::UnitZ()));
    listener_.up = geometry::ToGlm(Eigen::Vector3d(stage_from_camera * -Eigen::Vector3d::UnitY()));
  }
  scene.time = time;
  scene.listener = listener_;
  scene.reverb = places_[place].acoustics.reverb;
  scene.reverb_db = places_[place].acoustics.reverb_db;
  scene.voices.clear();
  AddAmbience(place, scene);
}

void SoundDirector::BeginFrame(double capture_time, SoundScene& scene) {
  constexpr double kStands = 1e-6;
  first_capture_ = first_capture_.value_or(capture_time);
  scene.frame_time = capture_time - *first_capture_;
  scene.held = last_time_ && std::abs(scene.time - *last_time_) < kStands;
  last_time_ = scene.time;
}

void SoundDirector::AddAmbience(size_t place, SoundScene& scene) const {
  const PlaceSound& sound = places_[place];
  for (size_t i = 0; i < sound.ambience.size(); ++i) {
    if (sound.ambience[i] < 0) {
      continue;
    }
    const stage::Ambience& ambience = sound.acoustics.ambience[i];
    Voice& voice = scene.voices.emplace_back();
    voice.source = SourceId(Kind::kAmbience, place, i);
    voice.clip = sound.ambience[i];
    voice.bus = Bus::kAmbience;
    voice.loops = true;
    voice.gain = FromDb(ambience.gain_db);
    voice.head_locked = !ambience.position.has_value();
    voice.position = ambience.position.value_or(glm::vec3(0.0f));
  }
}

void SoundDirector::AddLine(
    size_t actor, size_t line, double began, const Mouth& mouth, SoundScene& scene) {
  if (lines_[line] < 0) {
    return;
  }
  Voice& voice = scene.voices.emplace_back();
  voice.source = SourceId(Kind::kLine, actor);
  voice.clip = lines_[line];
  voice.bus = Bus::kSpeech;
  voice.began = began;
  voice.position = mouth.position;
  voice.facing = mouth.facing;
}

void SoundDirector::AddDescription(size_t line, double began, SoundScene& scene) const {
  if (lines_[line] < 0) {
    return;
  }
  Voice& voice = scene.voices.emplace_back();
  voice.source = SourceId(Kind::kDescription, 0);
  voice.clip = lines_[line];
  voice.bus = Bus::kDescription;
  voice.began = began;
  voice.gain = kDescriptionGain;
  voice.head_locked = true;
}

void SoundDirector::AddObject(size_t object,
                              const stage::ObjectState& state,
                              const stage::Pose& stage_from_object,
                              double tick_time,
                              SoundScene& scene) {
  const ObjectClips& clips = objects_[object];
  const stage::ObjectUse& use = clips.model->use();
  for (size_t i = 0; i < clips.sounds.size(); ++i) {
    const stage::StateSound& sound = use.sounds[i];
    if (clips.sounds[i] < 0 || (sound.states >> state.state & 1u) == 0) {
      continue;
    }
    Voice& voice = scene.voices.emplace_back();
    voice.source = SourceId(Kind::kState, object, i);
    voice.clip = clips.sounds[i];
    voice.loops = true;
    voice.began = -Phase(object * stage::ObjectUse::kMaxSounds + i) * Seconds(voice.clip);
    voice.gain = FromDb(sound.gain_db);
    voice.position = stage_from_object * sound.position;
  }
  if (state.action < 0 || clips.actions[static_cast<size_t>(state.action)] < 0) {
    return;
  }
  const stage::ActionSound& sound = use.actions[static_cast<size_t>(state.action)].sound;
  if (state.action_time < sound.begin || state.action_time >= sound.end) {
    return;
  }
  Voice& voice = scene.voices.emplace_back();
  voice.source = SourceId(Kind::kAction, object);
  voice.clip = clips.actions[static_cast<size_t>(state.action)];
  voice.loops = sound.loops;
  voice.began = tick_time - static_cast<double>(state.action_time - sound.begin);
  voice.gain = FromDb(sound.gain_db);
  voice.position = stage_from_object * clips.model->centre();
}

void SoundDirector::AddSound(const stage::StageSound& sound,
                             const std::optional<glm::vec3>& at,
                             double tick_time,
                             SoundScene& scene) {
  Voice& voice = scene.voices.emplace_back();
  voice.source = SourceId(Kind::kDrama, sound.number);
  voice.clip = drama_sounds_[static_cast<size_t>(sound.sound)];
  voice.loops = sound.loops;
  voice.began = tick_time - static_cast<double>(sound.ticks) * stage::Sounds::kTickSeconds;
  voice.gain = FromDb(sound.gain_db) * stage::Sounds::Share(sound);
  voice.head_locked = !at.has_value();
  voice.position = at.value_or(glm::vec3(0.0f));
}

void SoundDirector::Finish(size_t place, SoundScene& scene) const {
  for (Voice& voice : scene.voices) {
    if (!voice.head_locked) {
      voice.obstruction =
          places_[place].blockers.Obstruction(scene.listener.position, voice.position);
    }
  }
}

}  // namespace lararium::show
