#pragma once

// Collects the sounds of a stage: speech, sounds of objects, ambience of the place, and sounds that
// the drama plays.

#include <memory>
#include <optional>
#include <vector>

#include "shared/audio/obstruction.h"
#include "shared/audio/sound_library.h"
#include "shared/audio/sound_scene.h"
#include "shared/core/log.h"
#include "shared/core/status.h"
#include "shared/geometry/transform.h"
#include "shared/show/character_instance.h"
#include "shared/show/show_content.h"
#include "shared/stage/object.h"
#include "shared/stage/sounds.h"

namespace lararium::show {

class SoundDirector {
 public:
  // Decodes or opens every sound. A missing sound is silent and is reported in the log.
  static Result<SoundDirector> Create(const ShowContent& content, Log& log);

  const std::shared_ptr<const audio::SoundLibrary>& library() const { return library_; }
  // Registers the sounds that the drama can play with its stage.
  Status Teach(stage::Sounds& sounds) const;
  // Updates a place's acoustics and occluders.
  void SetPlace(size_t index, const stage::Place& place);

  // Continues the frame times of another director: frame_time counts from its first frame.
  void ResumeFrom(const SoundDirector& before) { first_capture_ = before.first_capture_; }

  // For each moment call Begin(), then Add...() for each sound, then Finish(). Allocates nothing
  // once the scene has held as many voices.
  //
  // The listener is at the camera; without a pose it stays where it was.
  void Begin(double time,
             size_t place,
             const std::optional<geometry::Rigid3>& camera_from_stage,
             audio::SoundScene& scene);
  // capture_time: of the frame, seconds. If it advances and the drama's time does not, the scene is
  // marked as held.
  void BeginFrame(double capture_time, audio::SoundScene& scene);
  // mouth: stage axes.
  void AddLine(
      size_t actor, size_t line, double began, const Mouth& mouth, audio::SoundScene& scene);
  // Plays a description inside the listener's head.
  void AddDescription(size_t line, double began, audio::SoundScene& scene) const;
  // tick_time: drama time of `state`, seconds.
  void AddObject(size_t object,
                 const stage::ObjectState& state,
                 const stage::Pose& stage_from_object,
                 double tick_time,
                 audio::SoundScene& scene);
  // at: position on stage; empty: around the listener.
  void AddSound(const stage::StageSound& sound,
                const std::optional<glm::vec3>& at,
                double tick_time,
                audio::SoundScene& scene);
  // Computes the obstruction of all voices.
  void Finish(size_t place, audio::SoundScene& scene) const;

 private:
  // Clips of an object's actions and states; -1: silent.
  struct ObjectClips {
    std::shared_ptr<const stage::ObjectModel> model;
    std::vector<int> actions;  // Parallel to ObjectUse::actions.
    std::vector<int> sounds;   // Parallel to ObjectUse::sounds.
  };
  struct PlaceSound {
    stage::Acoustics acoustics;
    std::vector<int> ambience;  // Parallel to Acoustics::ambience.
    audio::SoundBlockers blockers;
  };

  SoundDirector() = default;
  int ClipOf(const std::string& name, const std::string& who, Log& log) const;
  double Seconds(int clip) const { return library_->clips()[static_cast<size_t>(clip)].seconds(); }
  PlaceSound SoundOf(const stage::Place& place) const;
  void AddAmbience(size_t place, audio::SoundScene& scene) const;

  std::shared_ptr<const audio::SoundLibrary> library_;
  std::vector<int> lines_;         // Clip of each line.
  std::vector<int> drama_sounds_;  // Clip of each sound of the stage.
  std::vector<ObjectClips> objects_;
  std::vector<PlaceSound> places_;
  audio::Listener listener_;
  std::optional<double> first_capture_;
  std::optional<double> last_time_;  // Time of the drama in the last frame.
};

}  // namespace lararium::show
