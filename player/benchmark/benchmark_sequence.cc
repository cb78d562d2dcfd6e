#include "player/benchmark/benchmark_sequence.h"

#include <algorithm>
#include <array>
#include <sstream>

#include "shared/core/file.h"
#include "shared/core/json.h"
#include "shared/core/json_fields.h"
#include "shared/core/plain_text.h"
#include "shared/vision/poses_file.h"

namespace lararium::player {
namespace {

namespace fs = std::filesystem;

constexpr size_t kMaxPoints = 10'000'000;
constexpr double kSamePose = 1e-9;

// The sorted content of a folder; empty if it cannot be read.
std::vector<fs::path> Entries(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> entries;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    entries.push_back(it->path());
  }
  std::sort(entries.begin(), entries.end());
  return entries;
}

bool IsFolder(const fs::path& path) {
  std::error_code error;
  return fs::is_directory(path, error);
}

bool IsFile(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

Result<Eigen::Vector3d> ReadPoint(const JsonView& view) {
  // A point is [x, y, z], or an object whose field "xyz" has these numbers.
  JsonView xyz = view;
  if (view.Has("xyz")) {
    LARARIUM_ASSIGN_OR_RETURN(xyz, view.Field("xyz"));
  }
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<double> p, xyz.Numbers(3));
  return Eigen::Vector3d(p[0], p[1], p[2]);
}

Result<std::vector<Eigen::Vector3d>> LoadJsonPoints(const fs::path& file) {
  LARARIUM_ASSIGN_OR_RETURN(const Json json, LoadJson(file));
  JsonView list(json, file.string());
  if (list.Has("points")) {
    LARARIUM_ASSIGN_OR_RETURN(list, list.Field("points"));
  }
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<JsonView> views, list.Array(kMaxPoints));
  std::vector<Eigen::Vector3d> points;
  for (const JsonView& view : views) {
    LARARIUM_ASSIGN_OR_RETURN(points.emplace_back(), ReadPoint(view));
  }
  return points;
}

// Each line is "x y z"; the rest of a line is ignored. Comments start with #.
Result<std::vector<Eigen::Vector3d>> LoadTextPoints(const fs::path& file) {
  LARARIUM_ASSIGN_OR_RETURN(const std::string text, ReadText(file));
  std::vector<Eigen::Vector3d> points;
  std::istringstream lines(PlainText(text));
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    const size_t first = line.find_first_not_of(" \t\r");
    if (first == std::string::npos || line[first] == '#') {
      continue;
    }
    std::istringstream words(line);
    Eigen::Vector3d point;
    if (!(words >> point.x() >> point.y() >> point.z()) || !point.allFinite()) {
      return Status::Error(file.string() + ":" + std::to_string(number), "expected x y z");
    }
    points.push_back(point);
  }
  return points;
}

Result<std::vector<Eigen::Vector3d>> LoadPoints(const fs::path& folder) {
  for (const fs::path& place : {folder, folder.parent_path()}) {
    for (const char* name : {"points.json", "points.txt"}) {
      const fs::path file = place / name;
      if (!IsFile(file)) {
        continue;
      }
      auto points = file.extension() == ".json" ? LoadJsonPoints(file) : LoadTextPoints(file);
      if (points.ok() && points->empty()) {
        return Status::Error(file.string(), "contains no points");
      }
      return points;
    }
  }
  return Status::Error(folder.string(), "has no points to measure the registration at",
                       "put points.json or points.txt there or beside it");
}

Result<std::vector<TrueImage>> LoadTrueImages(const fs::path& file) {
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<vision::PoseRecord> records, vision::LoadPoses(file));
  LARARIUM_ASSIGN_OR_RETURN(const Json json, LoadJson(file));
  std::vector<TrueImage> images;
  const auto describe = [&](Fields& fields) {
    // k1, k2, p1 and p2 of the images that have no distortion of their own.
    std::array<double, 4> shared = {};
    fields.Numbers(Optional("distortion"), shared);
    auto record = records.begin();
    fields.List("images", images, records.size(), [&](Fields& entry, TrueImage& image) {
      image.file = fs::path(record->file).filename().string();
      image.camera = record->camera;
      if (!entry.Has("distortion")) {
        image.camera.k1 = shared[0];
        image.camera.k2 = shared[1];
        image.camera.p1 = shared[2];
        image.camera.p2 = shared[3];
      }
      image.camera_from_world = record++->camera_from_world;
      entry.Number(Optional("visible_fraction"), image.visible_fraction, 0.0, 1.0);
      entry.Number(Optional("gain_ev"), image.gain_ev, -64.0, 64.0);
    });
  };
  LARARIUM_RETURN_IF_ERROR(
      ReadFields(JsonView(json, file.string()), describe, UnknownFields::kIgnore));
  return images;
}

// The folder of the images: that of ground_truth.json or one below it.
Result<fs::path> ImageFolder(const fs::path& folder) {
  LARARIUM_ASSIGN_OR_RETURN(const auto records, vision::LoadPoses(folder / "ground_truth.json"));
  const fs::path relative = records.empty() ? fs::path() : fs::path(records.front().file);
  const bool escapes =
      relative.is_absolute() ||
      std::any_of(relative.begin(), relative.end(), [](const fs::path& p) { return p == ".."; });
  if (escapes) {
    return Status::Error((folder / "ground_truth.json").string(),
                         "names images outside its own folder");
  }
  return folder / relative.parent_path();
}

Result<BenchmarkSequence> LoadSequence(const fs::path& folder) {
  BenchmarkSequence sequence;
  sequence.folder = folder;
  sequence.name = folder.filename().string();
  LARARIUM_ASSIGN_OR_RETURN(sequence.images, LoadTrueImages(folder / "ground_truth.json"));
  if (sequence.images.empty()) {
    return Status::Error((folder / "ground_truth.json").string(), "lists no images");
  }
  LARARIUM_ASSIGN_OR_RETURN(sequence.points, LoadPoints(folder));
  return sequence;
}

}  // namespace

const TrueImage* BenchmarkSequence::Find(const std::string& file) const {
  const auto found = std::find_if(images.begin(), images.end(),
                                  [&](const TrueImage& image) { return image.file == file; });
  return found == images.end() ? nullptr : &*found;
}

bool BenchmarkSequence::HasPoses() const {
  return std::any_of(images.begin(), images.end(),
                     [](const TrueImage& image) { return image.camera_from_world.has_value(); });
}

bool BenchmarkSequence::IsStill() const {
  const auto& first = images.front().camera_from_world;
  return first && images.size() > 1 &&
         std::all_of(images.begin(), images.end(), [&](const TrueImage& image) {
           const auto& pose = image.camera_from_world;
           return pose && pose->rotation.angularDistance(first->rotation) < kSamePose &&
                  (pose->translation - first->translation).norm() < kSamePose;
         });
}

Result<std::vector<BenchmarkSequence>> LoadBenchmarkSequences(const fs::path& directory) {
  // Removes a slash at the end, so that the last component is the name of the folder.
  const fs::path base = fs::absolute(directory / "x").lexically_normal().parent_path();
  std::vector<fs::path> folders;
  if (IsFile(base / "ground_truth.json")) {
    folders = {base};
  } else {
    for (const fs::path& entry : Entries(base)) {
      if (IsFolder(entry) && IsFile(entry / "ground_truth.json")) {
        folders.push_back(entry);
      }
    }
  }
  if (folders.empty()) {
    return Status::Error(directory.string(), "contains no sequence with a ground_truth.json");
  }
  std::vector<BenchmarkSequence> sequences;
  for (const fs::path& folder : folders) {
    LARARIUM_ASSIGN_OR_RETURN(sequences.emplace_back(), LoadSequence(folder));
  }
  return sequences;
}

Result<std::unique_ptr<capture::FrameSource>> OpenSequence(const BenchmarkSequence& sequence) {
  if (IsFile(sequence.folder / "video.mp4")) {
    return capture::OpenVideo(sequence.folder / "video.mp4");
  }
  LARARIUM_ASSIGN_OR_RETURN(const fs::path images, ImageFolder(sequence.folder));
  return capture::OpenImageFolder(images);
}

Result<std::unique_ptr<capture::FrameSource>> OpenForeign(const fs::path& path) {
  if (IsFile(path)) {
    return capture::OpenVideo(path);
  }
  if (IsFile(path / "video.mp4")) {
    return capture::OpenVideo(path / "video.mp4");
  }
  return capture::OpenImageFolder(IsFolder(path / "images") ? path / "images" : path);
}

}  // namespace lararium::player
