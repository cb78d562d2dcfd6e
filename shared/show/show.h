#pragma once

// One running drama: advances the stage to the time of a tracked frame, places it in the frame's
// map, and returns what has to be drawn over the image.

#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "shared/audio/sound_library.h"
#include "shared/core/log.h"
#include "shared/core/status.h"
#include "shared/drama/drama.h"
#include "shared/show/cast_stage.h"
#include "shared/show/drama_group.h"
#include "shared/show/light_director.h"
#include "shared/show/pose_stage.h"
#include "shared/show/show_content.h"
#include "shared/show/sound_director.h"
#include "shared/show/staged_frame.h"
#include "shared/show/visitor_input.h"
#include "shared/stage/stage.h"

namespace lararium::show {

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

  // Visitor input besides the pose.
  VisitorInput& input() { return input_; }
  // Quality and levels of detail of people.
  CastDetail& detail() { return cast_->detail(); }

  // Continues another show between two frames, at the same time of the drama and with its frame
  // count for sound. The drama replays the visitor's past actions if they were recorded. Call
  // before the first frame. Plays the drama up to that time, except what PrepareAt() has already
  // played.
  Status ResumeFrom(const Show& before);
  // As VisitorInput::RestartAt(), but plays the drama up to that time immediately. Call before the
  // first frame.
  Status PrepareAt(double seconds);

  // From the next frame on, the show plays its drama together with others. Until it is where they
  // are, people are hidden. Call it before the first frame. Borrows the group.
  void Join(DramaGroup& group);
  // Plays the drama of a group to where it is now, so that the first frame need not.
  Status CatchUpWithGroup();

  // For interactive staging: changes the transform, nudge, light or occluders of places[index]. Do
  // not call while a frame is being staged.
  void SetPlace(size_t index, stage::Place place);

  // Changes the initial pose of content().objects[index]. If nothing has moved the object since the
  // beginning, it moves there at once. Do not call while a frame is being staged.
  void PlaceObject(size_t index, const stage::Pose& stage_from_object);

  // Replays the drama with the floor and objects that SetPlace() and PlaceObject() changed. Until
  // then people walk around the old obstacles and reach for the old positions. Costs nothing if
  // nothing has changed, otherwise as much as playing up to the present time. Do not call while a
  // frame is being staged. Fails if no floor is left to walk on; the drama continues.
  Status LayFloor();

  // Gives a member of the cast its body, of which only the motion was known (LoadCastMember()), or
  // the objects what is drawn of them (LoadObjects()). The drama does not notice. Do not call while
  // a frame is being staged, like SetSounds().
  void SetPerson(size_t cast, CastMember member);
  void SetObjects(const std::vector<StageObject>& objects);

  // Takes the sounds of `content`, of which some had not arrived before. Its lines and sounds are
  // those of this show. sounds() is another library afterwards. Borrows log.
  Status SetSounds(const ShowContent& content, Log& log);

  // From now on people fade while tracking is lost, and the visitor is guided. Without this call
  // they vanish together with the pose. Do not call while a frame is being staged.
  void SetTrackingLossFader(const TrackingLossFaderOptions& options) { poses_.SetFader(options); }

  // Advances the drama to `time` (seconds, at least 0) and fills `staged`. The drama runs in ticks
  // of 1/120 s; positions between two ticks are interpolated. A step back, or a step far ahead,
  // seeks. The drama does not depend on the place: it continues while frames move from one place to
  // another, or to none. A script may hold the drama while tracking is lost; its time then falls
  // behind `time`.
  void StageFrame(vision::TrackedFrame tracked, double time, StagedFrame& staged);

  // Stages people and objects at another time of the drama (at least 0, to the nearest tick), with
  // the camera of the frame that StageFrame() filled last. Lines and sounds are left out; hair and
  // cloth are at rest. The show stays at its time, and later frames do not change.
  Status StageAtTime(double time, const StagedFrame& now, StagedFrame& other);

 private:
  explicit Show(ShowContent content) : content_(std::move(content)) {}

  Status FillStage(Log& log);
  void ReleaseSoundData();
  Status PrepareFloor();
  void PlaceAtBeginning(size_t index);
  // Moves the objects that stand on `base`, recursively.
  void MoveRiders(stage::ObjectId base, const stage::Pose& moved);
  void ShowTick();
  void AdvanceTo(double time);
  void TickOnce();
  PoseStage::Located Locate(const vision::TrackedFrame& tracked) const;
  static drama::Visitor VisitorOf(const VisitorInput::Values& input,
                                  const std::optional<geometry::Rigid3>& camera_from_stage);
  // Time of the drama for a frame of a show that has joined a group.
  double GroupTime(const VisitorInput::Values& input,
                   const std::optional<geometry::Rigid3>& camera_from_stage,
                   double time);
  // Converts the frames' time into the drama's time: seconds since the drama's start, less the time
  // for which it was held. held: by the staff.
  double DramaTime(double time, bool held);
  // Fills people, things and light from drawn_, the camera and the time in `staged`.
  void StagePeopleAndThings(StagedFrame& staged);
  // Replaces the mesh of a person whose finer detail has been read since the last frame.
  void SwapFinishedLods();
  void StageThings(double time, const PlaceLight& light, StagedThings& things) const;
  void StageLines(double behind, bool describes, std::vector<StagedLine>& lines) const;
  // time: of the drama; capture_time: of the image; seconds.
  void StageSounds(double time,
                   double capture_time,
                   const StagedCamera& camera,
                   bool describes,
                   audio::SoundScene& scene);
  std::optional<glm::vec3> PlaceOf(const stage::StageSound& sound) const;
  stage::Pose DrawnObjectPose(const stage::StageSnapshot::ObjectEntry& entry) const;

  ShowContent content_;
  stage::Stage stage_;
  std::vector<stage::ObjectId> object_ids_;  // Parallel to ShowContent::objects.
  std::unique_ptr<drama::Drama> drama_;
  std::unique_ptr<GroupSeat> seat_;  // nullptr: the show plays alone.
  bool floor_changed_ = false;       // True if something has changed since LayFloor().
  VisitorInput input_;
  float picture_hour_ = -1.0f;  // VisitorInput::Values::hour of the current frame.
  double start_ = 0.0;          // Time of the frames at which the drama's time is 0.
  double last_time_ = 0.0;      // Time of the last frame.
  double held_seconds_ = 0.0;
  int64_t tick_ = 0;               // The tick of current_.
  stage::StageSnapshot previous_;  // The snapshot one tick before current_.
  stage::StageSnapshot current_;
  stage::StageSnapshot drawn_;  // Interpolation between previous_ and current_.
  PoseStage poses_;
  std::optional<CastStage> cast_;  // Set by Create(), like the directors.
  std::optional<LightDirector> light_;
  std::optional<SoundDirector> sound_;
};

}  // namespace lararium::show
