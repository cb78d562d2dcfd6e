#pragma once

// The camera view's picture: a recording or a live camera, tracked and composited on a thread of
// its own with an OpenGL context of its own, so that the interface never waits.

#include <array>
#include <atomic>
#include <functional>
#include <glm/mat4x4.hpp>
#include <memory>
#include <mutex>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "editor/app/onion_skin.h"
#include "editor/app/point_trails.h"
#include "editor/app/project.h"
#include "shared/capture/frame_source.h"
#include "shared/core/log.h"
#include "shared/core/mailbox.h"
#include "shared/core/status.h"
#include "shared/geometry/camera_model.h"
#include "shared/geometry/transform.h"
#include "shared/show/show_content.h"
#include "shared/vision/scene_database.h"
#include "shared/vision/tracked_frame.h"

namespace lararium::app {

// Where an object of the stage is at the beginning of the drama.
struct PreviewObject {
  std::string name;
  stage::Pose stage_from_object;
};

struct PreviewRequest {
  int64_t frame = 0;  // of the recording; a live camera gives its newest
  double time = 0.0;  // of the drama, seconds
  // The drama as it is written now; nullptr: as it was.
  std::shared_ptr<const std::string> script;
  // Staged as it is now; nullptr: as it was.
  std::shared_ptr<const stage::Place> place;
  std::vector<PreviewObject> objects;  // those that are missing stay where they were
  // Nobody is moving what is in people's way or used: they go round it, and to it.
  bool settled = false;
  bool compare = false;  // the picture without people, and where they are, besides
  std::optional<OnionSkin> onion;
  bool evidence = false;      // people and things in the colours of how certain they are
  bool descriptions = false;  // of what is to be seen are read and heard
  bool sound = false;         // the recording plays, and is to be heard
};

struct PreviewActor {
  std::shared_ptr<const human::Human> human;
  glm::mat4 stage_from_actor = glm::mat4(1.0f);
  std::vector<glm::mat4> skin;
};

struct PreviewPicture {
  int64_t frame = -1;
  double time = 0.0;  // of the drama, seconds
  cv::Mat bgr;        // the composite with onion skins, or the plain image without a pose
  // Where they were asked for, else empty: the camera's image alone (bgr), and how much of
  // each pixel people and props hide (CV_8UC1).
  cv::Mat plain;
  cv::Mat coverage;
  geometry::CameraModel display;  // the pinhole that it was drawn with
  std::string name;               // of the frame, as FrameSource::FrameName
  geometry::CameraModel camera;   // of the frame as it was taken
  cv::Mat grey;                   // the frame as it was taken, CV_8UC1
  vision::TrackState state = vision::TrackState::kSearching;
  vision::TrackReason reason = vision::TrackReason::kNone;
  int inliers = 0;
  bool followed = false;    // from the frame before; otherwise found without a prior
  float confidence = 0.0f;  // see vision::TrackedFrame
  std::optional<geometry::Rigid3> camera_from_map;
  std::optional<geometry::Rigid3> camera_from_stage;
  std::array<float, 3> gain = {1.0f, 1.0f, 1.0f};  // that people were drawn with
  std::vector<PreviewActor> actors;                // those that the drama shows at this moment
  std::vector<PointTrail> trails;                  // of the points that the pose stands on
};

// What the recording is like, once it is open.
struct PreviewSource {
  int64_t frames = 0;  // an estimate until the end was seen
  double frames_per_second = 30.0;
  bool live = false;  // a camera, which has no frames to choose from
};

class Preview {
 public:
  // Of what the pictures are; called once, on the preview's thread.
  using Opener = std::function<Result<std::unique_ptr<capture::FrameSource>>()>;

  // What to read of people for pictures as wide as those that the map was trained on
  // (AssembleOptions): who is seen nearer is read again.
  static float FinestDetail(const vision::SceneDatabase& map);

  // Starts opening everything. Borrows log.
  Preview(Opener open, show::ShowContent content, Log& log);
  // Stops the thread and waits.
  ~Preview();
  Preview(const Preview&) = delete;
  Preview& operator=(const Preview&) = delete;

  // The newest request wins; of a live camera each image is drawn as was asked for last. Frames
  // beyond the end give no picture; source() knows better afterwards.
  void Request(PreviewRequest request) { requests_.Put(std::move(request)); }
  // The newest picture, once.
  std::optional<std::shared_ptr<const PreviewPicture>> TakePicture() { return pictures_.TryTake(); }

  std::optional<PreviewSource> source() const;
  // It could not be opened, or the camera has ended, and will give no picture any more.
  bool failed() const { return failed_; }
  // What went wrong since the last call, in the recording or in the drama.
  std::vector<Status> TakeProblems();

 private:
  class Worker;

  void Run(std::stop_token stop);
  // What is to be drawn next, after drawn; nullopt: nothing any more.
  std::optional<PreviewRequest> NextRequest(const std::optional<PreviewRequest>& drawn,
                                            const Worker& worker,
                                            std::stop_token stop);
  void AddProblem(Status problem);

  Opener open_;
  show::ShowContent content_;
  Log& log_;
  Mailbox<PreviewRequest> requests_;
  Mailbox<std::shared_ptr<const PreviewPicture>> pictures_;
  mutable std::mutex mutex_;
  std::vector<Status> problems_;
  std::optional<PreviewSource> source_;
  std::atomic<bool> failed_ = false;
  std::jthread thread_;
};

}  // namespace lararium::app
