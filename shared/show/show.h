#pragma once

// One running drama: advances the stage to the time of a tracked frame, places it in the frame's
// map, and returns what has to be drawn over the image.

#include <array>
#include <atomic>
#include <chrono>
#include <glm/mat4x4.hpp>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shared/audio/sound_library.h"
#include "shared/audio/sound_scene.h"
#include "shared/core/log.h"
#include "shared/core/status.h"
#include "shared/drama/drama.h"
#include "shared/geometry/transform.h"
#include "shared/human/animator.h"
#include "shared/render/detail.h"
#include "shared/render/quality.h"
#include "shared/show/camera_motion.h"
#include "shared/show/character_instance.h"
#include "shared/show/gain_filter.h"
#include "shared/show/lamp_shade.h"
#include "shared/show/lod_streamer.h"
#include "shared/show/lost_guide.h"
#include "shared/show/picture_camera.h"
#include "shared/show/show_content.h"
#include "shared/show/sound_director.h"
#include "shared/show/stage_light.h"
#include "shared/show/thing_light.h"
#include "shared/show/tracking_loss_fader.h"
#include "shared/stage/stage.h"
#include "shared/vision/tracked_frame.h"

namespace lararium::show {

// A visible actor at the moment of a frame.
struct StagedActor {
  uint32_t cast = 0;  // Index into ShowContent::cast.
  // The human that is drawn: the cast's own, or one read at a finer detail.
  std::shared_ptr<const human::Human> figure;
  glm::mat4 stage_from_actor = glm::mat4(1.0f);
  uint32_t skin_begin = 0;  // First matrix in StagedFrame::skin.
  uint32_t skin_count = 0;
  uint32_t mesh_begin = 0;  // First mesh in StagedFrame::meshes.
  uint32_t mesh_count = 0;
  uint32_t light_begin = 0;  // First vertex in StagedFrame::irradiance.
  uint32_t light_count = 0;  // 0: lit without shadows.
  light::ProbeLight light;   // Light at the actor's position, stage axes.
  // Error in metres by which the drawn level may differ from the finest one (see
  // human::ErrorShare). Only the vertices of that level have irradiance.
  float detail = 0.0f;
};

// A mesh of an actor whose vertices differ from the bind pose: a speaking face, or cloth.
struct StagedMesh {
  CharacterInstance::MovingMesh mesh;
  uint32_t vertex_begin = 0;  // Index into StagedFrame::positions and ::normals.
  uint32_t vertex_count = 0;
};

// A line that is spoken at the moment of a frame, or whose caption is still shown.
struct StagedLine {
  static constexpr uint32_t kNobody = ~0u;
  static constexpr uint32_t kDescription = ~0u - 1;

  // Index into ShowContent::cast of the speaker; kNobody: caption without speech; kDescription:
  // audio description.
  uint32_t cast = 0;
  uint32_t line = 0;      // Index into ShowContent::speech.
  double seconds = 0.0;   // Time since the line began.
  bool speaking = false;  // False: the speech has ended.
};

// A visible object at the moment of a frame.
struct StagedObject {
  uint32_t object = 0;      // Index into ShowContent::objects.
  uint32_t part_begin = 0;  // Index into StagedFrame::stage_from_part and ::part_shown.
  uint32_t part_count = 0;
  light::ProbeLight light;   // Light at the object's position, stage axes.
  float glow = 1.0f;         // Factor of the emission of its meshes.
  uint32_t light_begin = 0;  // First vertex in StagedFrame::irradiance.
  uint32_t light_count = 0;  // 0: lit without shadows.
};

// A tracked image and the stage at its moment. Buffers are reused from frame to frame, so that
// steady play allocates nothing here.
struct StagedFrame {
  vision::TrackedFrame tracked;
  // Index into ShowContent::places. Without a pose it is the place of the last pose.
  uint32_t place = 0;
  // Rigid, in metres. Set while tracking, and while the fader holds people without a pose
  // (tracking_loss_fader.h).
  std::optional<geometry::Rigid3> camera_from_stage;
  float opacity = 1.0f;  // Opacity of people and of their effect on light.
  TrackingLossFader::State state = TrackingLossFader::State::kShown;
  double lost_seconds = 0.0;  // Time since the last pose; 0 while there is one.
  StagedGuide guide;          // Guide for a visitor whose tracking is lost.
  // The tracker's gain after GainFilter; linear R, G, B.
  std::array<float, 3> gain = {1.0f, 1.0f, 1.0f};
  std::optional<CameraMotion> motion;  // Empty: unknown.
  double time = 0.0;                   // Time of the drama, seconds.
  // Light on the real surfaces in view, stage axes. All people and objects use its sun.
  light::ProbeLight light;
  // The sky at the hour when the image was taken; set only if the drama uses another hour.
  std::optional<light::ShRgb> picture_light;
  // Blending weight of each probe of the place, for the real surfaces in view.
  std::vector<float> probe_weights;
  std::chrono::steady_clock::time_point arrival;  // When the image arrived.
  std::chrono::steady_clock::time_point located;  // When its pose was estimated.
  std::chrono::steady_clock::time_point staged;   // When staging was finished.
  double stage_ms = 0.0;                          // Duration of staging.
  std::vector<StagedActor> actors;
  // Data of all actors and objects, concatenated.
  std::vector<glm::mat4> skin;
  std::vector<StagedMesh> meshes;
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
  // Irradiance of the vertices of lit actors and objects that are drawn.
  std::vector<glm::vec3> irradiance;
  // Burning lamps, stage axes; the brightest light::kMaxLamps of them.
  std::vector<light::Lamp> lamps;
  std::vector<StagedLine> lines;
  // Spheres that cast soft shadows: centre and radius, stage axes.
  std::vector<glm::vec4> blockers;
  std::vector<StagedObject> objects;
  std::vector<glm::mat4> stage_from_part;
  std::vector<uint8_t> part_shown;
  audio::SoundScene sound;  // Sounds at this moment.
  // CPU milliseconds that other threads spent on this frame.
  double helpers_cpu_ms = 0.0;
};

class Show {
 public:
  // Fails if the script does not compile or if two names are equal. Later script errors are in
  // drama().errors() and do not stop the show. Borrows log.
  static Result<std::unique_ptr<Show>> Create(ShowContent content,
                                              const drama::DramaOptions& options,
                                              Log& log);

  // The content without sound data, which only the sound library keeps.
  const ShowContent& content() const { return content_; }
  const drama::Drama& drama() const { return *drama_; }
  // The clips that StagedFrame::sound refers to.
  const std::shared_ptr<const audio::SoundLibrary>& sounds() const { return sound_->library(); }
  drama::Drama& drama() { return *drama_; }

  // Replaces the script and seeks to the same time of the drama. On an error the old script
  // continues.
  Status Reload(std::string_view script);

  // Visitor input besides the pose: a key press ("space", "a", ...) or a received message
  // (drama::Message), and the local hour of day. From any thread.
  void PressKey(std::string_view key);
  void SetHour(float hour);
  // Turns audio descriptions on or off. This does not change the drama. From any thread.
  void SetDescriptions(bool on) { describes_ = on; }
  // Avoids gliding corrections for visitors who are sensitive to motion: people fade instead. From
  // any thread.
  void SetReducedMotion(bool on) { reduced_motion_ = on; }
  // Quality of simulation, light and drawing of people from the next frame on.
  void SetQuality(const render::Quality& quality);

  // Continues another show between two frames, at the same time of the drama and with its frame
  // count for sound. The drama replays the visitor's past actions if they were recorded. Call
  // before the first frame. Plays the drama up to that time, except what PrepareAt() has already
  // played.
  Status ResumeFrom(const Show& before);
  // As RestartAt(), but plays the drama up to that time immediately. Call before the first frame.
  Status PrepareAt(double seconds);

  // The next frame continues the drama from this time (seconds): for the next visitor, or after a
  // restart. People appear only after tracking has found a pose again. From any thread.
  void RestartAt(double seconds);

  // Treats the next frame's pose as unrelated to the previous ones and does not smooth it. The
  // drama continues. From any thread.
  void ForgetPose();

  // For interactive staging: changes the transform, nudge, light or occluders of places[index]. Do
  // not call while a frame is being staged.
  void SetPlace(size_t index, stage::Place place) {
    sound_->SetPlace(index, place);
    lamp_shades_[index] = LampShade(place.occluders);
    floor_changed_ |= !stage::BlockWalkingAlike(content_.places[index].stage, place);
    content_.places[index].stage = std::move(place);
    camera_motion_.Reset();  // Earlier poses are relative to another stage.
  }

  // Changes the initial pose of content().objects[index]. If nothing has moved the object since the
  // beginning, it moves there at once. Do not call while a frame is being staged.
  void PlaceObject(size_t index, const stage::Pose& stage_from_object);

  // Replays the drama with the floor and objects that SetPlace() and PlaceObject() changed. Until
  // then people walk around the old obstacles and reach for the old positions. Costs nothing if
  // nothing has changed, otherwise as much as playing up to the present time. Do not call while a
  // frame is being staged. Fails if no floor is left to walk on; the drama continues.
  Status LayFloor();

  // From now on people fade while tracking is lost, and the visitor is guided. Without this call
  // they vanish together with the pose. Do not call while a frame is being staged.
  void SetTrackingLossFader(const TrackingLossFaderOptions& options) { fader_.emplace(options); }

  // Size of the drawn pictures and the part of the view that they show, which decide on levels of
  // detail. Default: the size of the camera's images. Do not call while a frame is being staged.
  void SetPictureSize(int width, int height, const ViewPart& part = {}) {
    picture_width_ = width;
    picture_height_ = height;
    picture_part_ = part;
  }

  // Also simulates people outside the camera's image, for eyes that see more than the camera. Do
  // not call while a frame is being staged.
  void SetSeenAround(bool around) { seen_around_ = around; }

  // Advances the drama to `time` (seconds, at least 0) and fills `staged`. The drama runs in ticks
  // of 1/120 s; positions between two ticks are interpolated. A step back, or a step far ahead,
  // seeks. The drama does not depend on the place: it continues while frames move from one place to
  // another, or to none. A script may hold the drama while tracking is lost; its time then falls
  // behind `time`.
  void StageFrame(vision::TrackedFrame tracked, double time, StagedFrame& staged);

  // State of the level of detail that is being read; when done, the next frame uses it.
  LodStreamer::Reading reading_finer() const { return lod_streamer_->reading(); }

  // Stages people and objects at another time of the drama (at least 0, to the nearest tick), with
  // the camera of the frame that StageFrame() filled last. Lines and sounds are left out; hair and
  // cloth are at rest. The show stays at its time, and later frames do not change.
  Status StageAtTime(double time, const StagedFrame& now, StagedFrame& other);

 private:
  explicit Show(ShowContent content) : content_(std::move(content)) {}

  Status FillStage();
  void ReleaseSoundData();
  Status PrepareFloor();
  void PlaceAtBeginning(size_t index);
  // Moves the objects that stand on `base`, recursively.
  void MoveRiders(stage::ObjectId base, const stage::Pose& moved);
  void ShowTick();
  void AdvanceTo(double time);
  void TickOnce();
  void UpdateVisitor(const std::optional<geometry::Rigid3>& camera_from_stage);
  void TakeRestart(double time);
  void ResetPose();
  // Converts the frames' time into the drama's time: seconds since the drama's start, less the time
  // for which it was held.
  double DramaTime(double time);
  // Fills the fields of `staged` that depend on the camera's pose.
  void Locate(vision::TrackedFrame tracked, StagedFrame& staged);
  TrackingLossFader::View Update(const vision::TrackedFrame& tracked,
                                 const std::optional<geometry::Rigid3>& camera_from_stage,
                                 uint32_t place);
  // Chooses, from its size on screen, which parts of an actor are simulated and at which level of
  // detail it is drawn.
  void ChooseDetails(const StagedFrame& staged);
  // Replaces the mesh of a person whose finer detail has been read since the last frame.
  void SwapFinishedLods();
  // Fills actors, objects and light from drawn_ and the camera in `staged`.
  void StagePeopleAndThings(double time, StagedFrame& staged);
  // Steps the simulation of all bodies, then computes their moving vertices; people run in
  // parallel.
  void StageActors(double time, StagedFrame& staged);
  void LayOutActors(StagedFrame& staged);
  // The probes of the frame's place, blended for a position and for the drama's hour.
  light::ProbeLight LightAt(const StagedFrame& staged, const glm::vec3& position) const;
  // Hour at which the image was taken: the visitor's hour, or the first probe's hour if unknown.
  double PictureHour(std::span<const light::PlacedProbe> probes) const;
  void BlendProbes(StagedFrame& staged) const;
  void LayOutLight(StagedFrame& staged);
  void LightStage(StagedFrame& staged);
  void KeepLightOfThings(const StagedFrame& staged);
  void StageObjects(StagedFrame& staged);
  void StageVisible(uint32_t object,
                    const stage::StageSnapshot::ObjectEntry& entry,
                    StagedFrame& staged);
  void StageLines(double behind, StagedFrame& staged) const;
  void StageSounds(StagedFrame& staged);
  Mouth MouthOf(uint32_t cast, const stage::ActorState& state) const;
  std::optional<glm::vec3> PlaceOf(const stage::StageSound& sound) const;
  stage::Pose DrawnObjectPose(const stage::StageSnapshot::ObjectEntry& entry) const;

  ShowContent content_;
  stage::Stage stage_;
  std::vector<stage::ActorId> actor_ids_;  // The actor of each cast member.
  std::vector<CharacterInstance> bodies_;  // Parallel to ShowContent::cast.
  // Bodies for StageAtTime(); empty until its first call.
  std::vector<CharacterInstance> other_bodies_;
  std::vector<BodyDetail> details_;                       // Parallel to ShowContent::cast.
  std::vector<std::vector<render::DetailLevel>> levels_;  // Parallel to ShowContent::cast.
  std::vector<render::DetailRequest> requests_;           // Parallel to ShowContent::cast.
  render::DetailChooser detail_chooser_;
  std::optional<LodStreamer> lod_streamer_;  // Set by Create().
  int picture_width_ = 0;                    // 0: as wide as the camera's image.
  int picture_height_ = 0;                   // 0: as high as the camera's image.
  ViewPart picture_part_;
  bool seen_around_ = false;
  std::vector<stage::ObjectId> object_ids_;  // Parallel to ShowContent::objects.
  std::unique_ptr<drama::Drama> drama_;
  bool floor_changed_ = false;  // True if something has changed since LayFloor().
  uint32_t place_ = 0;          // Place of the last pose.
  std::mutex input_mutex_;
  std::string keys_;    // Keys pressed since the last frame.
  float hour_ = -1.0f;  // Hour of the day; negative: unknown.
  std::atomic<bool> describes_ = false;
  std::atomic<bool> reduced_motion_ = false;
  std::optional<double> restart_;
  bool forget_pose_ = false;
  double start_ = 0.0;  // Time of the frames at which the drama's time is 0.
  render::DetailOptions detail_options_;
  float picture_hour_ = -1.0f;  // Value of hour_ for the current frame.
  double last_time_ = 0.0;      // Time of the last frame.
  double held_seconds_ = 0.0;
  GainFilter gain_filter_;
  std::array<float, 3> gain_ = {1.0f, 1.0f, 1.0f};  // Gain of the last frame with a pose.
  std::optional<TrackingLossFader> fader_;
  LostGuide guide_;
  CameraMotionTracker camera_motion_;
  int64_t tick_ = 0;               // The tick of current_.
  stage::StageSnapshot previous_;  // The snapshot one tick before current_.
  stage::StageSnapshot current_;
  stage::StageSnapshot drawn_;  // Interpolation between previous_ and current_.
  // A visible actor of drawn_.
  struct Visible {
    uint32_t cast = 0;
    const stage::ActorState* state = nullptr;
  };
  std::vector<Visible> visible_;
  std::optional<StageLight> light_;
  std::vector<LampShade> lamp_shades_;  // Parallel to ShowContent::places.
  // Lighting state of an object. Its figure follows the people in light_'s cast.
  struct Thing {
    std::vector<glm::mat4> skin;        // Matrices of the current frame.
    std::vector<glm::vec3> irradiance;  // Result of the last lighting.
    ThingMemory memory;
  };
  std::vector<Thing> things_;
  std::optional<SoundDirector> sound_;
  std::vector<LitActor> lit_;
};

}  // namespace lararium::show
