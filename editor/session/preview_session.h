#pragma once

// The camera view of the current place: opens the show in the background, opens it again when its
// inputs change, and requests pictures of the present moment. Use it from the interface thread
// only.

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "editor/jobs/background_task.h"
#include "editor/session/cached.h"
#include "editor/session/cast_session.h"
#include "editor/session/frame_to_pick.h"
#include "editor/session/live_camera.h"
#include "editor/session/map_session.h"
#include "editor/session/message_log.h"
#include "editor/session/playback.h"
#include "editor/session/preview.h"
#include "editor/session/project_session.h"
#include "shared/core/log.h"
#include "shared/stage/place.h"

namespace lararium::editor {

// What the camera view shows besides the composite.
struct PreviewLook {
  bool camera_traits = true;       // People are drawn with the camera's noise and blur.
  bool compare = false;            // See PreviewRequest::compare.
  std::optional<OnionSkin> onion;  // nullopt: none. There are none while the drama plays.
  bool evidence = false;           // The colours of the evidence view.
  bool descriptions = false;       // Audio descriptions are shown and played.

  friend bool operator==(const PreviewLook&, const PreviewLook&) = default;
};

class PreviewSession {
 public:
  enum class ViewSource { kRecording, kTraining, kLive };

  // baking: locked while the project is baked. The other arguments must outlive the session.
  PreviewSession(ProjectSession& project,
                 const MapSession& map,
                 const CastSession& cast,
                 Playback& playback,
                 TaskList& tasks,
                 MessageLog& messages,
                 Log& log,
                 std::shared_ptr<std::mutex> baking);
  PreviewSession(const PreviewSession&) = delete;
  PreviewSession& operator=(const PreviewSession&) = delete;

  // The newest picture; nullptr before the first.
  const std::shared_ptr<const PreviewPicture>& picture() const { return picture_; }
  // The first image of the place's recording, bgr and small, for as long as there is no picture:
  // while the place is not trained, and while the show is being opened. nullptr: not read yet.
  std::shared_ptr<const cv::Mat> first_image() const;
  // What people should know of that recording (capture::FrameSource::Notes).
  std::vector<std::string> recording_notes() const;
  // The frame in the camera view as an image for picks.
  FrameToPick frame_to_pick() const;
  // The place as staged, with occluder meshes for drawing; nullptr before the show is open.
  const std::shared_ptr<const stage::Place>& staged() const { return staged_; }
  // Whether plain figures, or outdated ones, stand in for some people.
  bool has_stand_ins() const { return stand_ins_ > 0; }
  // Whether the first picture is there, or none is expected.
  bool ready() const { return picture_ != nullptr || !(stale_ || awaiting_picture_); }
  // Whether the picture changes without input.
  bool busy() const { return awaiting_picture_ || view_source_ == ViewSource::kLive; }

  // Changes take effect at the next Update().
  PreviewLook& look() { return look_; }
  const PreviewLook& look() const { return look_; }

  // The source of the camera view. It is not saved: each place starts with its recording.
  void SetViewSource(ViewSource source);
  ViewSource view_source() const { return view_source_; }
  // Shows a live camera by its number, or a recording that is played like a camera (live_camera.h).
  // The drama then runs by its own clock. Where the camera cannot be opened or ends, the view
  // returns to the recording and a message tells why.
  void PreviewLiveCamera(const std::string& camera);
  const std::string& live_camera() const { return live_camera_; }
  // False while the live camera is unplugged.
  bool camera_is_there() const { return *camera_presence_; }
  // Whether the place has a recording for the camera view that differs from the training recording.
  bool has_own_recording() const;

  // Opens the show again at the next Update().
  void Reopen();
  // Opens the show again at the next Update() where its inputs, such as files, changed.
  void DetectChangedInputs() { stale_ = true; }

  // Call once for each frame of the interface. seconds: since the last call.
  void Update(double seconds);

 private:
  // What the last request asked for.
  struct Asked {
    int64_t frame = -1;
    double time = -1.0;
    bool sound = false;
    bool settled = false;
    int64_t script = -1;  // The revision.
    PreviewLook look;

    friend bool operator==(const Asked&, const Asked&) = default;
  };

  // Identifies the inputs of the show, which opens again when they change.
  std::string Key() const;
  void Open();
  void Close();
  Preview::Opener ViewOpener();
  // A recording as far as its first image shows it.
  struct FirstLook {
    cv::Mat image;  // bgr and small
    std::vector<std::string> notes;
  };
  static Result<FirstLook> LookAt(const ProjectPaths& paths, const SourceDocument& recording);
  // The recording of first_image().
  SourceDocument FirstRecording() const;
  // Reads first_image() and recording_notes().
  void ReadFirstImage();
  // Whether the preview shows a stage that is about to be replaced, for example because a person
  // was added whom the drama already uses.
  bool StageIsOutdated() const;
  // Applies the edits of the place that do not need the show to be opened again.
  void Restage();
  void Request();
  void Collect();

  ProjectSession& project_;
  const MapSession& map_;
  const CastSession& cast_;
  Playback& playback_;
  TaskList& tasks_;
  MessageLog& messages_;
  Log& log_;
  std::shared_ptr<std::mutex> baking_;

  ViewSource view_source_ = ViewSource::kRecording;
  std::string live_camera_;
  std::shared_ptr<CameraPresence> camera_presence_ = std::make_shared<CameraPresence>(true);

  bool stale_ = false;          // The inputs have to be compared with key_.
  std::string key_;             // The inputs of the last attempt to open the show.
  size_t stand_ins_ = 0;        // The number of people who are drawn as a replacement.
  int64_t opened_script_ = -1;  // Revision of the script with which the show was opened.
  int64_t map_revision_ = 0;    // MapSession::revision() at the last Update().
  std::unique_ptr<Preview> preview_;

  std::shared_ptr<const stage::Place> staged_;
  // The probes when the show was opened, and their light. Edits apply rotation and brightness to it
  // immediately.
  std::vector<ProbeDocument> baked_probes_;
  std::vector<light::PlacedProbe> baked_light_;

  PreviewLook look_;
  bool place_changed_ = true;  // The place has to be staged again.
  double since_edit_ = 0.0;    // Seconds since the document was edited.
  Asked asked_;
  std::shared_ptr<const std::string> asked_text_;  // The script in the last request.
  bool awaiting_picture_ = false;
  std::shared_ptr<const PreviewPicture> picture_;
  Cached<std::string, FirstLook> first_look_;  // The key is the recording's path.
  // Problems that were reported since there was a picture.
  std::set<std::string> told_;
};

}  // namespace lararium::editor
