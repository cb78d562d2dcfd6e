// tracker_reference SCENE.larscene VIDEO FOLDER
// Tracks a video in one thread, with the lens of the map and with a lens that it has to find.
// Writes what the test of the same tracker in WebAssembly compares: FOLDER/frames.grey (the
// luminance of all frames in their order) and FOLDER/reference.json.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "shared/capture/frame_source.h"
#include "shared/core/file.h"
#include "shared/core/json.h"
#include "shared/core/parallel.h"
#include "shared/vision/scene_database.h"
#include "shared/vision/tracker.h"

namespace lararium::vision {
namespace {

using Map = std::shared_ptr<const SceneDatabase>;

Json NumbersOf(const geometry::CameraModel& c) {
  return {{"width", c.width}, {"height", c.height}, {"fx", c.fx}, {"fy", c.fy}, {"cx", c.cx},
          {"cy", c.cy},       {"k1", c.k1},         {"k2", c.k2}, {"p1", c.p1}, {"p2", c.p2}};
}

Json Described(const TrackedFrame& tracked,
               const PoseSource& poses,
               const SceneDatabase& map,
               double milliseconds) {
  Json json = {{"milliseconds", milliseconds}, {"camera", NumbersOf(tracked.camera)}};
  if (!tracked.camera_from_map) {
    return json;
  }
  const Eigen::Quaterniond& q = tracked.camera_from_map->rotation;
  const Eigen::Vector3d& t = tracked.camera_from_map->translation;
  json["rotation"] = {q.x(), q.y(), q.z(), q.w()};
  json["translation"] = {t.x(), t.y(), t.z()};
  json["followed"] = tracked.followed;
  json["confidence"] = tracked.confidence;
  json["inliers"] = tracked.inliers;
  std::vector<SeenPoint> seen;
  poses.Seen(seen);
  json["points"] = Json::array();
  for (size_t i = 0; i < seen.size(); i += 8) {
    const Eigen::Vector3f& point = map.points[seen[i].point];
    json["points"].push_back({point.x(), point.y(), point.z()});
  }
  return json;
}

// Two triangles through three points of the map and their middle, which hide points of the map.
OccluderMesh SomethingInTheWay(const SceneDatabase& map) {
  OccluderMesh mesh;
  const size_t count = map.points.size();
  for (const size_t point : {size_t{0}, count / 3, 2 * count / 3, count / 2}) {
    mesh.positions.push_back(map.points[point]);
  }
  mesh.indices = {0, 1, 2, 2, 1, 3};
  return mesh;
}

Json Described(const OccluderMesh& mesh) {
  Json json = {{"positions", Json::array()}, {"indices", mesh.indices}};
  for (const Eigen::Vector3f& position : mesh.positions) {
    json["positions"].insert(json["positions"].end(), {position.x(), position.y(), position.z()});
  }
  return json;
}

// find: each frame is located without a prior, after the first one. occluders: of the map.
Result<Json> Track(const Map& map,
                   std::span<const geometry::Frame> frames,
                   bool known_camera,
                   bool find,
                   std::span<const OccluderMesh> occluders = {}) {
  const geometry::CameraModel camera =
      map->camera.GuessForImages(frames[0].grey.cols, frames[0].grey.rows);
  TrackerOptions options;
  options.threads = 1;
  options.known_camera = known_camera;
  LARARIUM_ASSIGN_OR_RETURN(const auto poses, CreateTracker({map}, camera, options));
  poses->SetOccluders(0, occluders);
  Json tracked = Json::array();
  for (const geometry::Frame& frame : frames) {
    if (find) {
      poses->Relocalize();
    }
    const auto start = std::chrono::steady_clock::now();
    const TrackedFrame result = poses->Track(frame);
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
    tracked.push_back(Described(result, *poses, *map, time.count()));
  }
  return tracked;
}

Status WriteReference(const std::filesystem::path& scene,
                      const std::filesystem::path& video,
                      const std::filesystem::path& folder) {
  LARARIUM_ASSIGN_OR_RETURN(SceneDatabase database, LoadSceneDatabase(scene));
  const Map map = std::make_shared<const SceneDatabase>(std::move(database));
  LARARIUM_ASSIGN_OR_RETURN(const auto source, capture::OpenVideo(video));
  std::vector<geometry::Frame> frames;
  std::ofstream grey(folder / "frames.grey", std::ios::binary);
  Json seconds = Json::array();
  for (;;) {
    LARARIUM_ASSIGN_OR_RETURN(std::optional<geometry::Frame> frame, source->Next());
    if (!frame) {
      break;
    }
    frame->bgr.release();  // A page hands over luminance only.
    grey.write(frame->grey.ptr<char>(), static_cast<std::streamsize>(frame->grey.total()));
    seconds.push_back(frame->capture_time);
    frames.push_back(std::move(*frame));
  }
  if (frames.empty() || !grey.flush()) {
    return Status::Error(video.string(), "has no frames, or they cannot be written");
  }
  Json reference = {
      {"width", source->width()},
      {"height", source->height()},
      {"seconds", seconds},
      {"camera", NumbersOf(map->camera.GuessForImages(source->width(), source->height()))}};
  LARARIUM_ASSIGN_OR_RETURN(reference["known"], Track(map, frames, true, false));
  for (int again = 0; again < 2; ++again) {  // Other work of the machine makes times longer.
    LARARIUM_ASSIGN_OR_RETURN(const Json repeated, Track(map, frames, true, false));
    for (size_t i = 0; i < frames.size(); ++i) {
      Json& best = reference["known"][i]["milliseconds"];
      best = std::min(best.get<double>(), repeated[i]["milliseconds"].get<double>());
    }
  }
  LARARIUM_ASSIGN_OR_RETURN(reference["unknown"], Track(map, frames, false, false));
  const OccluderMesh occluder = SomethingInTheWay(*map);
  reference["occluder"] = Described(occluder);
  LARARIUM_ASSIGN_OR_RETURN(reference["hidden"],
                            Track(map, frames, true, false, std::span(&occluder, 1)));
  const size_t found = std::min<size_t>(frames.size(), 20);
  LARARIUM_ASSIGN_OR_RETURN(reference["found"],
                            Track(map, std::span(frames).first(found), true, true));
  return WriteFileAtomically(folder / "reference.json", reference.dump());
}

}  // namespace
}  // namespace lararium::vision

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: tracker_reference SCENE.larscene VIDEO FOLDER\n");
    return 2;
  }
  const lararium::ThreadLimit one(1);
  const lararium::Status status = lararium::vision::WriteReference(argv[1], argv[2], argv[3]);
  if (!status.ok()) {
    std::fprintf(stderr, "%s\n", status.message().c_str());
    return 1;
  }
  return 0;
}
