#pragma once

// One running drama: brings the stage to the moment of a tracked frame, puts it
// where that frame's place has it, and hands out what is to be drawn over it.

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
#include "shared/human/performance.h"
#include "shared/render/detail.h"
#include "shared/render/quality.h"
#include "shared/show/body.h"
#include "shared/show/camera_motion.h"
#include "shared/show/finer_cast.h"
#include "shared/show/gain_filter.h"
#include "shared/show/lamp_shade.h"
#include "shared/show/lost_guide.h"
#include "shared/show/lost_ladder.h"
#include "shared/show/picture_camera.h"
#include "shared/show/show_content.h"
#include "shared/show/sound_director.h"
#include "shared/show/stage_light.h"
#include "shared/show/thing_light.h"
#include "shared/stage/stage.h"
#include "shared/vision/tracked_frame.h"

namespace lararium::show {

// A visible actor at the moment of a frame.
struct StagedActor {
  uint32_t cast = 0;  // index into ShowContent::cast
  // As whom they are drawn: the cast's human, or the same in more detail.
  std::shared_ptr<const human::Human> figure;
  glm::mat4 stage_from_actor = glm::mat4(1.0f);
  uint32_t skin_begin = 0;  // its matrices in StagedFrame::skin
  uint32_t skin_count = 0;
  uint32_t mesh_begin = 0;  // its moving meshes in StagedFrame::meshes
  uint32_t mesh_count = 0;
  uint32_t light_begin = 0;  // its vertices in StagedFrame::irradiance
  uint32_t light_count = 0;  // 0: light as it is without shadows
  light::ProbeLight light;   // where the actor stands, stage axes
  // Metres by which what is drawn may differ from the finest level of detail; light is
  // worked out for no other vertices.
  float detail = 0.0f;
};

// A mesh of an actor whose vertices are not those of the bind pose: a face that
// speaks, cloth.
struct StagedMesh {
  Body::MovingMesh mesh;
  uint32_t vertex_begin = 0;  // in StagedFrame::positions and normals
  uint32_t vertex_count = 0;
};

// A line that somebody says at the moment of a frame, or that can still be read.
struct StagedLine {
  static constexpr uint32_t kNobody = ~0u;
  static constexpr uint32_t kDescription = ~0u - 1;

  // Index into ShowContent::cast: who says it; kNobody: it is only read; kDescription: it is
  // described.
  uint32_t cast = 0;
  uint32_t line = 0;      // index into ShowContent::speech
  double seconds = 0.0;   // since it began
  bool speaking = false;  // false: said to its end
};

// A visible object at the moment of a frame.
struct StagedObject {
  uint32_t object = 0;      // index into ShowContent::objects
  uint32_t part_begin = 0;  // in StagedFrame::stage_from_part and part_shown
  uint32_t part_count = 0;
  light::ProbeLight light;   // where the object is, stage axes
  float glow = 1.0f;         // times the emission of its meshes
  uint32_t light_begin = 0;  // its vertices in StagedFrame::irradiance
  uint32_t light_count = 0;  // 0: light as it is without shadows
};

// A tracked image with the stage as it stands at its moment. Reused from frame
// to frame, so that steady play allocates nothing here.
struct StagedFrame {
  vision::TrackedFrame tracked;
  // Index into ShowContent::places: where the pose lies; without a pose, where the
  // last one lay.
  uint32_t place = 0;
  // Rigid, metric; set when tracking, and while people are held without a pose (lost_ladder.h).
  std::optional<geometry::Rigid3> camera_from_stage;
  float opacity = 1.0f;  // of people and what they do to the light
  LostLadder::Rung rung = LostLadder::Rung::kShown;
  double lost_seconds = 0.0;  // without a pose
  StagedGuide guide;          // what tells a visitor who has lost the place where to look
  std::array<float, 3> gain = {1.0f, 1.0f, 1.0f};  // of tracked, steadied by GainFilter
  std::optional<CameraMotion> motion;              // none: not known
  double time = 0.0;                               // of the drama, seconds
  light::ProbeLight light;  // on real surfaces in view, stage axes; its sun is everybody's
  // The sky at the hour of the image, where the drama has set another hour.
  std::optional<light::ShRgb> picture_light;
  std::vector<float> probe_weights;               // of each probe of the place, likewise
  std::chrono::steady_clock::time_point arrival;  // when the image was there
  std::chrono::steady_clock::time_point located;  // when its pose was
  std::chrono::steady_clock::time_point staged;   // when all of this was
  double stage_ms = 0.0;                          // that staging it took
  std::vector<StagedActor> actors;
  // Of all actors and objects, one after the other.
  std::vector<glm::mat4> skin;
  std::vector<StagedMesh> meshes;
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<glm::vec3> irradiance;  // of all vertices of lit actors and objects that are drawn
  std::vector<light::Lamp> lamps;     // that burn, stage axes; the brightest of them
  std::vector<StagedLine> lines;
  std::vector<glm::vec4> blockers;  // balls that shade: centre and radius, stage axes
  std::vector<StagedObject> objects;
  std::vector<glm::mat4> stage_from_part;
  std::vector<uint8_t> part_shown;
  audio::SoundScene sound;  // what is heard
  // Processor milliseconds that other threads spent on it.
  double helpers_cpu_ms = 0.0;
};

class Show {
 public:
  // Fails only where the script does not compile or two things have one name; later
  // script errors are in drama().errors() and the show goes on. Borrows log.
  static Result<std::unique_ptr<Show>> Create(ShowContent content,
                                              const drama::DramaOptions& options,
                                              Log& log);

  // Without the bytes of sounds.
  const ShowContent& content() const { return content_; }
  const drama::Drama& drama() const { return *drama_; }
  // What StagedFrame::sound speaks of.
  const std::shared_ptr<const audio::SoundLibrary>& sounds() const { return sound_->library(); }
  drama::Drama& drama() { return *drama_; }

  // Another script, at the same time of the drama. On an error the old one goes on.
  Status Reload(std::string_view script);

  // What the drama hears of its visitor besides where they are: a key that was pressed
  // ("space", "a", ...) or a message that came (drama::Message), the hour of the day there.
  // From any thread.
  void PressKey(std::string_view key);
  void SetHour(float hour);
  // Whether the visitor hears and reads what is described. The drama is the same either way.
  // From any thread.
  void SetDescriptions(bool on) { describes_ = on; }
  // For visitors whom motion makes unwell: nothing glides that can fade. From any thread.
  void SetReducedMotion(bool on) { reduced_motion_ = on; }
  // How finely people are shaped, lit and drawn from the next frame on.
  void SetQuality(const render::Quality& quality);

  // Takes the place of another show between two frames, at the same time of the drama: pictures
  // are counted on, and the drama knows what the visitor did so far where that is kept. Before the
  // first frame; plays the drama until there, but for what PrepareAt has played.
  Status GoOnFrom(const Show& before);
  // As RestartAt, but the drama is played until there at once. Before the first frame.
  Status PrepareAt(double seconds);

  // The next frame shows the drama at this time of its own (seconds), and from there on: for the
  // next visitor, or after a restart. Nobody is seen before they are found again.
  // From any thread.
  void RestartAt(double seconds);

  // The next frame's pose has nothing to do with those before and is taken as it is. The drama
  // goes on. From any thread.
  void ForgetPose();

  // For interactive staging: another transform, nudge, light or occluders of
  // places[index]. Not while a frame is being staged.
  void SetPlace(size_t index, stage::Place place) {
    sound_->SetPlace(index, place);
    lamp_shades_[index] = LampShade(place.occluders);
    floor_changed_ |= !stage::BlockWalkingAlike(content_.places[index].stage, place);
    content_.places[index].stage = std::move(place);
    camera_motion_.Reset();  // poses of before mean another stage
  }

  // Likewise where content().objects[index] is at the beginning of the drama. It is seen there at
  // once where nobody has moved it since.
  void PlaceObject(size_t index, const stage::Pose& stage_from_object);

  // After SetPlace() and PlaceObject() people still go round what was in their way before, and
  // reach for things where they were. From here on the drama is as if all had always been where it
  // is. Costs nothing where that is so; otherwise as much as to play until now. Not while a frame
  // is being staged. Fails where no floor is left to walk on; the drama goes on.
  Status LayFloor();

  // From now on people fade while tracking is lost, and the visitor is guided; without it they
  // are gone with the pose. Not while a frame is being staged.
  void SetLostLadder(const LostLadderOptions& options) { ladder_.emplace(options); }

  // How large pictures will be drawn, and what of the view they show, which decides on levels of
  // detail; as large as the camera's images unless set. Not while a frame is being staged.
  void SetPictureSize(int width, int height, const ViewPart& part = {}) {
    picture_width_ = width;
    picture_height_ = height;
    picture_part_ = part;
  }

  // People are also seen past the borders of the camera's picture: by eyes that see more than it.
  // Not while a frame is being staged.
  void SetSeenAround(bool around) { seen_around_ = around; }

  // Brings the drama to time (seconds, at least 0) and fills staged. The drama
  // runs in ticks of 1/120 s; what lies between two ticks is interpolated. Going
  // back, or far ahead, seeks. The drama does not depend on the place: it runs on
  // while frames go from one to another, or to none; there its author may have it hold,
  // and its time is then behind.
  void StageFrame(vision::TrackedFrame tracked, double time, StagedFrame& staged);

  // Whether somebody is being read in more detail: the next frame shows who has been.
  FinerCast::Reading reading_finer() const { return finer_->reading(); }

  // People and things as they are at another time of the drama (at least 0, to the nearest tick),
  // seen as in the frame that StageFrame() has filled last, without lines and sounds; hair and
  // cloth at rest. The show stays at its moment: frames after it are what they would have been.
  Status StageOther(double time, const StagedFrame& now, StagedFrame& other);

 private:
  explicit Show(ShowContent content) : content_(std::move(content)) {}

  Status FillStage();
  void DropSounds();
  Status PrepareFloor();
  void PlaceAtBeginning(size_t index);
  // What stands on an object, and on that.
  void MoveRiders(stage::ObjectId base, const stage::Pose& moved);
  void ShowTick();
  void AdvanceTo(double time);
  void TickOnce();
  void TellOfVisitor(const std::optional<geometry::Rigid3>& camera_from_stage);
  void TakeRestart(double time);
  void ResetPose();
  // The drama's time at a time of the frames: since it began, less what it was held.
  double DramaTime(double time);
  // Fills what of staged depends on where the camera is.
  void Locate(vision::TrackedFrame tracked, StagedFrame& staged);
  LostLadder::View Climb(const vision::TrackedFrame& tracked,
                         const std::optional<geometry::Rigid3>& camera_from_stage,
                         uint32_t place);
  // What of each visible actor is simulated, and how finely it is drawn, by how it is seen.
  void ChooseDetails(const StagedFrame& staged);
  // Who was read in more detail since the last frame is drawn so.
  void TakeFiner();
  // From drawn_ and what staged says of the camera.
  void StagePeopleAndThings(double time, StagedFrame& staged);
  // Bodies step, then write what moves; people are spread over the cores.
  void StageActors(double time, StagedFrame& staged);
  void LayOutActors(StagedFrame& staged);
  // The probes of the frame's place, blended at its time of day.
  light::ProbeLight LightAt(const StagedFrame& staged, const glm::vec3& position) const;
  // At which an image of a place was taken: the visitor's; where that is not known, that of the
  // first probe.
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
  std::vector<stage::ActorId> actor_ids_;                 // of each cast member
  std::vector<Body> bodies_;                              // likewise
  std::vector<Body> other_bodies_;                        // likewise, of StageOther(), once used
  std::vector<BodyDetail> details_;                       // likewise
  std::vector<std::vector<render::DetailLevel>> levels_;  // likewise
  std::vector<render::DetailRequest> requests_;           // likewise
  render::DetailChooser detail_chooser_;
  std::optional<FinerCast> finer_;  // set when created
  int picture_width_ = 0;           // 0: the camera's
  int picture_height_ = 0;          // likewise
  ViewPart picture_part_;
  bool seen_around_ = false;
  std::vector<stage::ObjectId> object_ids_;  // of each object
  std::unique_ptr<drama::Drama> drama_;
  bool floor_changed_ = false;  // since LayFloor()
  uint32_t place_ = 0;          // of the last pose
  std::mutex input_mutex_;
  std::string keys_;    // pressed since the last frame
  float hour_ = -1.0f;  // of the day; below 0: unknown
  std::atomic<bool> describes_ = false;
  std::atomic<bool> reduced_motion_ = false;
  std::optional<double> restart_;
  bool forget_pose_ = false;
  double start_ = 0.0;  // of the drama, in the time of the frames
  render::DetailOptions detail_options_;
  float picture_hour_ = -1.0f;  // hour_ as of the frame
  double last_time_ = 0.0;      // of the frames
  double held_seconds_ = 0.0;
  GainFilter gain_filter_;
  std::array<float, 3> gain_ = {1.0f, 1.0f, 1.0f};  // while there was a pose
  std::optional<LostLadder> ladder_;
  LostGuide guide_;
  CameraMotionTracker camera_motion_;
  int64_t tick_ = 0;               // that current_ shows
  stage::StageSnapshot previous_;  // one tick before
  stage::StageSnapshot current_;
  stage::StageSnapshot drawn_;  // between the two
  // Visible actors of drawn_: index into cast, and state.
  struct Visible {
    uint32_t cast = 0;
    const stage::ActorState* state = nullptr;
  };
  std::vector<Visible> visible_;
  std::optional<StageLight> light_;
  std::vector<LampShade> lamp_shades_;  // of each place
  // Of each object: its figure, as a member of light_'s cast after the people.
  struct Thing {
    std::vector<glm::mat4> skin;        // of the frame
    std::vector<glm::vec3> irradiance;  // as last worked out
    ThingMemory memory;
  };
  std::vector<Thing> things_;
  std::optional<SoundDirector> sound_;
  std::vector<LitActor> lit_;
};

}  // namespace lararium::show
