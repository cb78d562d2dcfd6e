#include "web/tracker/tracker_session.h"

#include <algorithm>
#include <utility>

#include "shared/geometry/similar_camera.h"
#include "shared/vision/follow_map.h"

namespace lararium::web {

using geometry::CameraModel;

namespace {

std::vector<double> NumbersOf(const vision::TrackedFrame& tracked) {
  const geometry::Rigid3 pose = tracked.camera_from_map.value_or(geometry::Rigid3());
  const Eigen::Quaterniond& q = pose.rotation;
  const Eigen::Vector3d& t = pose.translation;
  const CameraModel& c = tracked.camera;
  return {static_cast<double>(tracked.state),
          static_cast<double>(tracked.reason),
          static_cast<double>(tracked.followed),
          static_cast<double>(tracked.map),
          static_cast<double>(tracked.confidence),
          static_cast<double>(tracked.inliers),
          q.x(),
          q.y(),
          q.z(),
          q.w(),
          t.x(),
          t.y(),
          t.z(),
          static_cast<double>(c.width),
          static_cast<double>(c.height),
          c.fx,
          c.fy,
          c.cx,
          c.cy,
          c.k1,
          c.k2,
          c.p1,
          c.p2};
}

}  // namespace

Status TrackerSession::AddMap(std::span<const std::byte> larscene) {
  LARARIUM_ASSIGN_OR_RETURN(vision::SceneDatabase map, vision::ParseSceneDatabase(larscene, "map"));
  maps_.push_back(std::make_shared<const vision::SceneDatabase>(std::move(map)));
  occluders_.emplace_back();
  return Status();
}

Status TrackerSession::AddOccluder(size_t map, vision::OccluderMesh mesh) {
  const auto in_range = [&mesh](uint32_t index) { return index < mesh.positions.size(); };
  const auto finite = [](const Eigen::Vector3f& position) { return position.allFinite(); };
  if (map >= maps_.size() || mesh.indices.size() % 3 != 0 ||
      !std::all_of(mesh.indices.begin(), mesh.indices.end(), in_range) ||
      !std::all_of(mesh.positions.begin(), mesh.positions.end(), finite)) {
    return Status::Error("occluder", "is not a mesh of triangles in one of the maps",
                         "give three indices of finite positions for each triangle");
  }
  occluders_[map].push_back(std::move(mesh));
  if (poses_) {
    poses_->SetOccluders(static_cast<uint32_t>(map), occluders_[map]);
  }
  return Status();
}

Status TrackerSession::SetIntrinsics(std::span<const double> numbers, int width, int height) {
  LARARIUM_ASSIGN_OR_RETURN(camera_, CameraModel::FromNumbers(numbers, width, height));
  return Status();
}

void TrackerSession::Prepare() {
  if (prepared_.empty()) {
    for (const auto& map : maps_) {
      prepared_.push_back(std::make_shared<const vision::TrackedMap>(map));
    }
  }
}

Status TrackerSession::WarmUp() {
  constexpr size_t kImages = 3;  // A browser compiles for speed what has run for about this long.
  TrackerSession rehearsal(false);
  Prepare();
  rehearsal.maps_ = maps_;
  rehearsal.prepared_ = prepared_;
  size_t images = 0;
  for (const auto& map : maps_) {
    for (const vision::Keyframe& keyframe : map->keyframes) {
      if (images < kImages && !keyframe.grey.empty()) {
        rehearsal.grey_ = keyframe.grey;
        rehearsal.Relocalize();
        LARARIUM_RETURN_IF_ERROR(rehearsal.Track(static_cast<double>(images++)));
      }
    }
  }
  return Status();
}

// Nothing but the background search keeps former images, so each gets pixels of its own.
uint8_t* TrackerSession::NewImage(int width, int height) {
  grey_ = cv::Mat(height, width, CV_8UC1);
  return grey_.data;
}

Status TrackerSession::Start() {
  if (maps_.empty()) {
    return Status::Error("tracker", "has no map", "add a map before the first image");
  }
  vision::TrackerOptions options;
  options.threads = 1;
  options.known_camera = camera_.has_value();
  CameraModel camera;
  if (camera_) {
    LARARIUM_ASSIGN_OR_RETURN(camera, camera_->ForImages(grey_.cols, grey_.rows));
  } else {
    const auto camera_of = [](const auto& map) -> const CameraModel& { return map->camera; };
    const auto& similar = geometry::FindSimilarCamera(maps_, camera_of, grey_.cols, grey_.rows);
    camera = similar->camera.GuessForImages(grey_.cols, grey_.rows);
  }
  std::unique_ptr<PostedSearch> search;
  if (posted_) {
    std::vector<size_t> points;
    for (const auto& map : maps_) {
      points.push_back(map->points.size());
    }
    search = std::make_unique<PostedSearch>(std::move(points));
    options.background = vision::BackgroundWork::kFree;
  }
  PostedSearch* const borrowed = search.get();
  Prepare();
  LARARIUM_ASSIGN_OR_RETURN(poses_,
                            vision::CreateTracker(prepared_, camera, options, std::move(search)));
  search_ = borrowed;
  for (size_t map = 0; map < maps_.size(); ++map) {
    poses_->SetOccluders(static_cast<uint32_t>(map), occluders_[map]);
  }
  return Status();
}

Status TrackerSession::Track(double seconds) {
  if (grey_.empty()) {
    return Status::Error("tracker", "has no image", "fill in an image first");
  }
  if (!poses_) {
    LARARIUM_RETURN_IF_ERROR(Start());
  }
  geometry::Frame frame;
  frame.index = index_++;
  frame.capture_time = seconds;
  frame.grey = std::move(grey_);
  grey_.release();
  numbers_ = NumbersOf(poses_->Track(frame));
  return Status();
}

std::span<const double> TrackerSession::seen() {
  numbers_.clear();
  if (poses_) {
    poses_->Seen(seen_);
    for (const vision::SeenPoint& seen : seen_) {
      numbers_.insert(numbers_.end(),
                      {static_cast<double>(seen.point), static_cast<double>(seen.pixel.x()),
                       static_cast<double>(seen.pixel.y())});
    }
  }
  return numbers_;
}

void TrackerSession::Relocalize() {
  if (poses_) {
    poses_->Relocalize();
  }
}

Status TrackerSession::Find(std::span<const double> question) {
  if (maps_.empty() || grey_.empty()) {
    return Status::Error("search", "has no map or no image", "give it both first");
  }
  LARARIUM_ASSIGN_OR_RETURN(const SearchQuestion asked, ParseQuestion(question));
  LARARIUM_RETURN_IF_ERROR(asked.guess.prior.model.Validate());
  for (const CameraModel& candidate : asked.guess.candidates) {
    LARARIUM_RETURN_IF_ERROR(candidate.Validate());
  }
  if (!relocalizer_) {
    relocalizer_ = std::make_unique<vision::Relocalizer>(maps_, vision::TrackerOptions());
  }
  SearchAnswer answer{asked.number, relocalizer_->Find(grey_, asked.guess), {}};
  grey_.release();
  if (answer.located.location.camera_from_map) {
    const auto points = relocalizer_->points(answer.located.map);
    answer.points.assign(points.begin(), points.end());
  }
  numbers_ = Numbers(answer);
  return Status();
}

}  // namespace lararium::web
