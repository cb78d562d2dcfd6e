#pragma once

// Says what of a stage is to be heard: who speaks, what is done with things, what the
// place is full of, what the drama plays.

#include <memory>
#include <optional>
#include <vector>

#include "shared/audio/obstruction.h"
#include "shared/audio/sound_library.h"
#include "shared/audio/sound_scene.h"
#include "shared/core/log.h"
#include "shared/core/status.h"
#include "shared/geometry/transform.h"
#include "shared/show/body.h"
#include "shared/show/show_content.h"
#include "shared/stage/object.h"
#include "shared/stage/sounds.h"

namespace lararium::show {

class SoundDirector {
 public:
  // Decodes or opens every sound. What is asked for and not there is silent, and the log
  // says so.
  static Result<SoundDirector> Create(const ShowContent& content, Log& log);

  const std::shared_ptr<const audio::SoundLibrary>& library() const { return library_; }
  // The sounds that a drama can play, for its stage.
  Status Teach(stage::Sounds& sounds) const;
  // Another way in which a place is.
  void SetPlace(size_t index, const stage::Place& place);

  // Goes on from another one's pictures: frame_time is counted from its first.
  void GoOnFrom(const SoundDirector& before) { first_capture_ = before.first_capture_; }

  // A moment: first Begin, then what is heard, then Finish. Allocates nothing once the
  // scene has held as many voices.
  //
  // The ears are at the camera; without a pose they stay where they were.
  void Begin(double time,
             size_t place,
             const std::optional<geometry::Rigid3>& camera_from_stage,
             audio::SoundScene& scene);
  // capture_time: of its picture. Where pictures go on and the drama does not, it is held.
  void BeginFrame(double capture_time, audio::SoundScene& scene);
  // The mouth in stage axes.
  void AddLine(
      size_t actor, size_t line, double began, const Mouth& mouth, audio::SoundScene& scene);
  // In the middle of the listener's head.
  void AddDescription(size_t line, double began, audio::SoundScene& scene) const;
  // tick_time: of the drama, when the state is so.
  void AddObject(size_t object,
                 const stage::ObjectState& state,
                 const stage::Pose& stage_from_object,
                 double tick_time,
                 audio::SoundScene& scene);
  // at: where it is; none: around the listener.
  void AddSound(const stage::StageSound& sound,
                const std::optional<glm::vec3>& at,
                double tick_time,
                audio::SoundScene& scene);
  // Finds what is hidden.
  void Finish(size_t place, audio::SoundScene& scene) const;

 private:
  // Clips of what a thing does; -1: silent.
  struct ObjectClips {
    std::shared_ptr<const stage::ObjectModel> model;
    std::vector<int> actions;  // parallel to ObjectUse::actions
    std::vector<int> sounds;   // parallel to ObjectUse::sounds
  };
  struct PlaceSound {
    stage::Acoustics acoustics;
    std::vector<int> ambience;  // parallel to Acoustics::ambience
    audio::SoundBlockers blockers;
  };

  SoundDirector() = default;
  int ClipOf(const std::string& name, const std::string& who, Log& log) const;
  double Seconds(int clip) const { return library_->clips()[static_cast<size_t>(clip)].seconds(); }
  PlaceSound SoundOf(const stage::Place& place) const;
  void AddAmbience(size_t place, audio::SoundScene& scene) const;

  std::shared_ptr<const audio::SoundLibrary> library_;
  std::vector<int> lines_;         // clip of each line
  std::vector<int> drama_sounds_;  // clip of each of the stage's sounds
  std::vector<ObjectClips> objects_;
  std::vector<PlaceSound> places_;
  audio::Listener listener_;
  std::optional<double> first_capture_;
  std::optional<double> last_time_;  // of the drama
};

}  // namespace lararium::show
