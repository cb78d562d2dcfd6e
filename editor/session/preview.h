#pragma once

// The camera view: a recording or a live camera, tracked and composited on a separate thread with
// an OpenGL context of its own, so that the interface never waits.

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

#include "editor/document/project.h"
#include "editor/session/onion_skin.h"
#include "editor/session/point_trails.h"
#include "shared/capture/frame_source.h"
#include "shared/core/log.h"
#include "shared/core/mailbox.h"
#include "shared/core/status.h"
#include "shared/geometry/camera_model.h"
#include "shared/geometry/transform.h"
#include "shared/show/show_content.h"
#include "shared/vision/scene_database.h"
#include "shared/vision/tracked_frame.h"

namespace lararium::editor {

// The pose of an object at the beginning of the drama.
struct PreviewObject {
  std::string name;
  stage::Pose stage_from_object;
};

struct PreviewRequest {
  int64_t frame = 0;  // Frame of the recording; a live camera gives its newest frame.
  double time = 0.0;  // Time of the drama, seconds.
  // The present text of the drama; nullptr: unchanged.
  std::shared_ptr<const std::string> script;
  // The present staging; nullptr: unchanged.
  std::shared_ptr<const stage::Place> place;
  std::vector<PreviewObject> objects;  // Objects that are missing keep their pose.
  // No obstacle or object is being dragged, so the paths of people can be computed again.
  bool settled = false;
  bool compare = false;  // Also returns PreviewPicture::plain and ::coverage.
  std::optional<OnionSkin> onion;
  bool evidence = false;      // Draws the colours of the evidence view.
  bool descriptions = false;  // Shows and plays audio descriptions.
  bool sound = false;         // The recording plays and its sound is audible.
};

struct PreviewActor {
  std::shared_ptr<const human::Human> human;
  glm::mat4 stage_from_actor = glm::mat4(1.0f);
  std::vector<glm::mat4> skin;
};

struct PreviewPicture {
  int64_t frame = -1;
  double time = 0.0;  // Time of the drama, seconds.
  cv::Mat bgr;        // The composite with onion skins; without a pose, the camera's image.
  // Set only where PreviewRequest::compare asked for them: the camera's image alone (bgr), and the
  // share of each pixel that people and objects cover (CV_8UC1).
  cv::Mat plain;
  cv::Mat coverage;
  geometry::CameraModel display;  // The pinhole camera of the picture.
  std::string name;               // The frame's name; see FrameSource::FrameName.
  geometry::CameraModel camera;   // The camera of the original frame.
  cv::Mat grey;                   // The original frame, CV_8UC1.
  vision::TrackState state = vision::TrackState::kSearching;
  vision::TrackReason reason = vision::TrackReason::kNone;
  int inliers = 0;
  bool followed = false;    // Tracked from the previous frame; false: relocalised without a prior.
  float confidence = 0.0f;  // See vision::TrackedFrame.
  std::optional<geometry::Rigid3> camera_from_map;
  std::optional<geometry::Rigid3> camera_from_stage;
  std::array<float, 3> gain = {1.0f, 1.0f, 1.0f};  // Factors that people were drawn with.
  std::vector<PreviewActor> actors;                // The actors on stage at this moment.
  std::vector<PointTrail> trails;                  // Trails of the points that determine the pose.
};

// Properties of the recording, known once it is open.
struct PreviewSource {
  int64_t frames = 0;  // An estimate until the end was reached.
  double frames_per_second = 30.0;
  bool live = false;  // A camera, which has no choice of frames.
};

class Preview {
 public:
  // Opens the source of the images; called once, on the preview's thread.
  using Opener = std::function<Result<std::unique_ptr<capture::FrameSource>>()>;

  // The detail of people (AssembleOptions::finest) for pictures as wide as those of the map's
  // training. A person who is seen from nearer is read again in more detail.
  static float FinestDetail(const vision::SceneDatabase& map);

  // Starts to open everything. log must outlive the preview.
  Preview(Opener open, show::ShowContent content, Log& log);
  // Stops the thread and waits for it.
  ~Preview();
  Preview(const Preview&) = delete;
  Preview& operator=(const Preview&) = delete;

  // The newest request replaces earlier ones. With a live camera, each image is drawn with the
  // newest request. A frame beyond the end gives no picture; source() has the exact number
  // afterwards.
  void Request(PreviewRequest request) { requests_.Put(std::move(request)); }
  // Returns the newest picture once; nullopt where there is no new one.
  std::optional<std::shared_ptr<const PreviewPicture>> TakePicture() { return pictures_.TryTake(); }

  std::optional<PreviewSource> source() const;
  // The source could not be opened or the camera has ended; no more pictures follow.
  bool failed() const { return failed_; }
  // Errors of the recording and the drama since the last call.
  std::vector<Status> TakeProblems();

 private:
  class Worker;

  void Run(std::stop_token stop);
  // The next request to draw, after drawn; nullopt: the thread ends.
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

}  // namespace lararium::editor
