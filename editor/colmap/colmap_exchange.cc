#include "editor/colmap/colmap_exchange.h"

#include <stdlib.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <set>

#include "editor/train/database_builder.h"
#include "editor/train/image_mapping.h"
#include "editor/train/tracks.h"
#include "shared/capture/exif.h"
#include "shared/capture/frame_source.h"
#include "shared/core/file.h"
#include "shared/core/lower_case.h"
#include "shared/core/parallel.h"
#include "shared/core/srgb.h"
#include "shared/geometry/resampling.h"
#include "shared/image/decode.h"
#include "shared/image/encode.h"

namespace lararium::train {
namespace {

namespace fs = std::filesystem;
using geometry::CameraModel;

constexpr std::string_view kImport = "import from COLMAP";
constexpr size_t kMinPoints = 30;  // Fewer points are not enough to locate an image.

// ------------------------------------------------------------------- export

// The sRGB byte of a linear value. Negative values, which mean unknown, give 0.
uint8_t SrgbByte(float linear) {
  const double v = std::clamp(static_cast<double>(linear), 0.0, 1.0);
  return static_cast<uint8_t>(std::lround(255.0 * SrgbFromLinear(v)));
}

// A relative path that stays inside its folder and has the suffix of an image. It contains no
// blanks, because COLMAP's text reader ends names at them.
std::string FileNameOf(const vision::Keyframe& keyframe) {
  std::string name = keyframe.name;
  for (char& c : name) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '_' ||
                       c == '-' || c == '/' || static_cast<signed char>(c) < 0;
    c = plain ? c : '_';
  }
  const fs::path path = fs::path(name).lexically_normal();
  if (path.empty() || path.is_absolute() || *path.begin() == ".." || !path.has_filename()) {
    name = capture::NumberedFrameName(keyframe.frame_index);
  }
  static const std::set<std::string> kExtensions = {".png", ".jpg", ".jpeg"};
  return kExtensions.contains(fs::path(name).extension().string()) ? name : name + ".png";
}

// [keyframes]: Unique file names; frames of two sessions often have the same name.
std::vector<std::string> FileNames(const vision::SceneDatabase& database) {
  std::vector<std::string> names;
  std::set<std::string> taken;
  for (const vision::Keyframe& keyframe : database.keyframes) {
    const std::string wanted = FileNameOf(keyframe);
    std::string name = wanted;
    for (int attempt = 0; !taken.insert(name).second; ++attempt) {
      name = "session" + std::to_string(keyframe.session) +
             (attempt > 0 ? "-" + std::to_string(attempt) : "") + "/" + wanted;
    }
    names.push_back(std::move(name));
  }
  return names;
}

// Fills in COLMAP's ERROR, the mean error of each point, without observations behind the camera.
void FillErrors(const vision::SceneDatabase& database, ColmapModel& model) {
  std::vector<double> sums(database.points.size(), 0.0);
  std::vector<int> counts(database.points.size(), 0);
  for (const vision::Observation& o : database.observations) {
    const auto pixel = database.camera.Project(database.keyframes[o.keyframe].camera_from_map *
                                               database.points[o.point].cast<double>());
    if (pixel) {
      sums[o.point] += (*pixel - Eigen::Vector2d(o.x, o.y)).norm();
      ++counts[o.point];
    }
  }
  for (size_t i = 0; i < sums.size(); ++i) {
    model.points[i].error = counts[i] > 0 ? sums[i] / counts[i] : -1.0;
  }
}

// A temporary folder that is removed with its content unless it was moved away.
class HalfWrittenFolder {
 public:
  static Result<HalfWrittenFolder> Beside(const fs::path& folder) {
    constexpr size_t kLongest = 200;  // Bytes; names of files have at most 255.
    std::string name =
        (folder.parent_path() / folder.filename().string().substr(0, kLongest)).string() +
        ".XXXXXX";
    if (::mkdtemp(name.data()) == nullptr) {
      return Status::Error(folder.string(), "cannot make a folder beside it",
                           "name a folder below one that exists and may be written to");
    }
    return HalfWrittenFolder(name);
  }
  HalfWrittenFolder(HalfWrittenFolder&& other) noexcept : path_(std::move(other.path_)) {
    other.path_.clear();
  }
  HalfWrittenFolder& operator=(HalfWrittenFolder&&) = delete;
  ~HalfWrittenFolder() {
    if (!path_.empty()) {
      std::error_code ignored;
      fs::remove_all(path_, ignored);
    }
  }

  const fs::path& path() const { return path_; }

  Status MoveTo(const fs::path& folder) {
    std::error_code error;
    fs::permissions(path_, fs::perms(0755), error);
    fs::rename(path_, folder, error);
    if (error) {
      return Status::Error(folder.string(), "cannot be put in place: " + error.message(),
                           "name a folder that does not exist yet");
    }
    path_.clear();
    return Status();
  }

 private:
  explicit HalfWrittenFolder(fs::path path) : path_(std::move(path)) {}
  fs::path path_;
};

Status WriteImage(const fs::path& file, const cv::Mat& grey) {
  constexpr int kJpegQuality = 95;
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  return image::WriteImage(file, grey, kJpegQuality);
}

// ------------------------------------------------------------------- import

// An image of the model that is being imported.
struct Import {
  const ColmapImage* image = nullptr;
  std::string file;  // Relative to the image folder.
  int64_t frame_index = -1;
  const CameraModel* own_camera = nullptr;  // Set if the image must be resampled.
};

bool ProjectAlike(const CameraModel& a, const CameraModel& b) {
  if (a.width != b.width || a.height != b.height) {
    return false;
  }
  constexpr int kSteps = 8;
  constexpr double kMaxShiftPx = 0.01;
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; j <= kSteps; ++j) {
      const Eigen::Vector2d pixel((a.width - 1.0) * i / kSteps, (a.height - 1.0) * j / kSteps);
      if (!((a.PixelFromPlane(b.PlaneFromPixel(pixel)) - pixel).norm() < kMaxShiftPx)) {
        return false;
      }
    }
  }
  return true;
}

// Resamples an image of camera `from` to that which camera `to` would have taken.
cv::Mat Resample(const cv::Mat& image, const CameraModel& from, const CameraModel& to) {
  cv::Mat resampled;
  cv::remap(image, resampled, geometry::PixelsSeenBy(from, to), cv::noArray(), cv::INTER_CUBIC);
  return resampled;
}

Result<cv::Mat> ReadImage(const fs::path& file, const ColmapCamera& camera) {
  LARARIUM_ASSIGN_OR_RETURN(cv::Mat bgr, image::ReadImage(file, image::Channels::kBgr));
  const auto size = [](auto width, auto height) {
    return std::to_string(width) + "x" + std::to_string(height);
  };
  if (static_cast<uint64_t>(bgr.cols) != camera.width ||
      static_cast<uint64_t>(bgr.rows) != camera.height) {
    return Status::Error(file.string(),
                         "is " + size(bgr.cols, bgr.rows) + ", its camera in the model " +
                             size(camera.width, camera.height),
                         "name the images that the model was made of");
  }
  return bgr;
}

// Finds the feature of an image that is nearest to a position, by a grid.
class FeatureGrid {
 public:
  FeatureGrid(const vision::Features& features, double radius_px)
      : features_(features), radius_(radius_px) {
    for (uint32_t i = 0; i < features.size(); ++i) {
      const vision::Keypoint& keypoint = features.keypoints[i];
      order_.emplace_back(Cell(keypoint.x, keypoint.y), i);
    }
    std::sort(order_.begin(), order_.end());
  }

  // The nearest feature within the radius; the first one if several are equally near (one position
  // with several orientations).
  std::optional<uint32_t> Nearest(const Eigen::Vector2d& pixel) const {
    std::optional<uint32_t> nearest;
    double best = radius_ * radius_;
    const auto [row, column] = Cell(pixel.x(), pixel.y());
    for (int64_t r = row - 1; r <= row + 1; ++r) {
      const std::pair<CellIndex, uint32_t> first = {{r, column - 1}, 0};
      for (auto at = std::lower_bound(order_.begin(), order_.end(), first);
           at != order_.end() && at->first <= CellIndex(r, column + 1); ++at) {
        const vision::Keypoint& keypoint = features_.keypoints[at->second];
        const double distance = (Eigen::Vector2d(keypoint.x, keypoint.y) - pixel).squaredNorm();
        if (distance < best || (distance == best && nearest && at->second < *nearest)) {
          best = distance;
          nearest = at->second;
        }
      }
    }
    return nearest;
  }

 private:
  using CellIndex = std::pair<int64_t, int64_t>;  // row, column

  CellIndex Cell(double x, double y) const {
    return {static_cast<int64_t>(std::floor(y / radius_)),
            static_cast<int64_t>(std::floor(x / radius_))};
  }

  const vision::Features& features_;
  double radius_;
  std::vector<std::pair<CellIndex, uint32_t>> order_;
};

// Finds the files that a model's images are named after: in a folder that was moved, on a system
// that distinguishes capital letters, or converted to another format.
class ImageFiles {
 public:
  explicit ImageFiles(const fs::path& folder) : folder_(folder) {
    if (const auto source = capture::OpenImageFolder(folder); source.ok()) {
      const int64_t count = (*source)->frame_count().value_or(0);
      for (int64_t i = 0; i < count; ++i) {
        const std::string name = (*source)->FrameName(i);
        indices_[name] = i;
        for (const std::string& key : {LowerCase(name), WithoutExtension(LowerCase(name))}) {
          alike_.emplace(key, name);
        }
      }
    }
  }

  // Returns the path of an image relative to the folder, and whether it is the name; nullopt if
  // there is no such file, or if several are alike.
  std::optional<std::pair<std::string, bool>> Find(const std::string& name) const {
    std::string path = name;
    std::replace(path.begin(), path.end(), '\\', '/');
    const bool leads_out = path.starts_with('/') || path.substr(1).starts_with(":/") ||
                           ("/" + path).find("/../") != std::string::npos;
    for (; !path.empty(); path = path.substr(std::min(path.find('/'), path.size() - 1) + 1)) {
      if (!leads_out && FileExists(folder_ / path)) {
        return std::pair(path, path == name);
      }
      if (indices_.contains(path)) {
        return std::pair(path, path == name);
      }
      for (const std::string& key : {LowerCase(path), WithoutExtension(LowerCase(path))}) {
        if (alike_.count(key) == 1) {
          return std::pair(alike_.find(key)->second, false);
        }
      }
      if (!leads_out) {
        break;
      }
    }
    return std::nullopt;
  }

  // The frame index when the folder is opened; -1 if it is not found then.
  int64_t IndexOf(const std::string& file) const {
    const auto known = indices_.find(file);
    return known != indices_.end() ? known->second : -1;
  }

 private:
  static std::string WithoutExtension(std::string name) {
    return name.substr(0, name.size() - fs::path(name).extension().string().size());
  }

  const fs::path& folder_;
  std::map<std::string, int64_t> indices_;
  std::multimap<std::string, std::string> alike_;
};

class Importer {
 public:
  Importer(const ColmapModel& model,
           const fs::path& image_folder,
           const ColmapImportOptions& options,
           Progress& progress,
           Log& log,
           std::vector<std::string>& warnings)
      : model_(model),
        folder_(image_folder),
        options_(options),
        progress_(progress),
        log_(log),
        warnings_(warnings) {}

  Result<vision::SceneDatabase> Run() {
    LARARIUM_RETURN_IF_ERROR(ChooseCamera());
    LARARIUM_RETURN_IF_ERROR(OrderImages());
    LARARIUM_RETURN_IF_ERROR(ReadImages());
    for (const std::string& note : model_.notes) {
      warnings_.push_back("the model: " + note);
    }
    LARARIUM_ASSIGN_OR_RETURN(const Reconstruction reconstruction,
                              HasTracks() ? Tie() : Triangulate());
    DatabaseOptions options;
    options.max_points = options_.max_points;
    options.seed = options_.seed;
    vision::SceneDatabase database = BuildDatabase(reconstruction, images_, options);
    LARARIUM_RETURN_IF_ERROR(database.Validate());
    return database;
  }

 private:
  // Chooses the camera of most images; the first one if several have equally many.
  Status ChooseCamera() {
    std::map<uint32_t, size_t> uses;
    for (const ColmapImage& image : model_.images) {
      ++uses[image.camera];
    }
    if (uses.size() < 1 || model_.images.size() < 2) {
      return Status::Error(kImport, "the model has fewer than two images",
                           "reconstruct the place from more images");
    }
    size_t most = 0;
    for (const ColmapCamera& camera : model_.cameras) {
      if (!uses.contains(camera.id)) {
        continue;
      }
      LARARIUM_ASSIGN_OR_RETURN(const CameraModel ours, CameraFromColmap(camera));
      cameras_.emplace(camera.id, ours);
      if (uses[camera.id] > most) {
        most = uses[camera.id];
        camera_ = ours;
      }
    }
    return Status();
  }

  Status OrderImages() {
    const ImageFiles files(folder_);
    bool all_known = true;
    size_t turned = 0;
    size_t renamed = 0;
    std::string example;
    for (const ColmapImage& image : model_.images) {
      const auto found = files.Find(image.name);
      if (!found) {
        LeaveOut(Status::Error((folder_ / image.name).string(), "does not exist",
                               "name the folder of the model's images with --images"));
        continue;
      }
      if (!found->second && renamed++ == 0) {
        example = "\"" + image.name + "\" for " + found->first;
      }
      Import import{.image = &image, .file = found->first};
      const CameraModel& own = cameras_.at(image.camera);
      if (!ProjectAlike(own, camera_)) {
        import.own_camera = &own;
      }
      import.frame_index = files.IndexOf(import.file);
      all_known = all_known && import.frame_index >= 0;
      const Result<MappedFile> file = MappedFile::Open(folder_ / import.file);
      turned += file.ok() && !capture::FindOrientation(file->bytes()).upright() ? 1 : 0;
      imports_.push_back(import);
    }
    LARARIUM_RETURN_IF_ERROR(RequireImages());
    std::sort(imports_.begin(), imports_.end(), [&](const Import& a, const Import& b) {
      return all_known ? a.frame_index < b.frame_index : a.file < b.file;
    });
    for (size_t i = 0; i < imports_.size(); ++i) {
      if (i > 0 && imports_[i].file == imports_[i - 1].file) {
        return Status::Error(kImport,
                             "two images of the model are named \"" + imports_[i].file + "\"",
                             "write the model again with COLMAP");
      }
      imports_[i].frame_index = all_known ? imports_[i].frame_index : static_cast<int64_t>(i);
    }
    if (renamed > 0) {
      warnings_.push_back(std::to_string(renamed) + " of " + std::to_string(imports_.size()) +
                          " images have other names in the model, such as " + example);
    }
    if (turned > 0) {
      log_.Warn(
          "{} images are to be shown turned (EXIF data), but the model is of their stored pixels: "
          "turn the pixels (mogrify -auto-orient) and make the model again",
          turned);
    }
    if (!all_known) {
      log_.Warn(
          "{}: not all images of the model are found again when the folder is opened; to train the "
          "place from them again, put all into the folder itself, or all into subfolders",
          folder_.string());
    }
    const auto resampled = std::count_if(imports_.begin(), imports_.end(),
                                         [](const Import& i) { return i.own_camera != nullptr; });
    if (resampled > 0) {
      warnings_.push_back(std::to_string(resampled) + " of " + std::to_string(imports_.size()) +
                          " images are resampled to one camera of " +
                          std::to_string(camera_.width) + "x" + std::to_string(camera_.height));
    }
    return Status();
  }

  // Reads images and extracts their features, a few at a time.
  Status ReadImages() {
    images_.resize(imports_.size());
    std::vector<Status> problems(imports_.size());
    constexpr size_t kBatch = 8;
    for (size_t begin = 0; begin < imports_.size(); begin += kBatch) {
      if (progress_.Cancelled()) {
        return Status::Error(kImport, "cancelled");
      }
      progress_.Report("features",
                       static_cast<double>(begin) / static_cast<double>(imports_.size()));
      ParallelFor(std::min(kBatch, imports_.size() - begin), [&](size_t offset) {
        problems[begin + offset] = ReadOne(imports_[begin + offset], images_[begin + offset]);
      });
    }
    for (size_t i = imports_.size(); i-- > 0;) {
      if (!problems[i].ok()) {
        LeaveOut(std::move(problems[i]));
        imports_.erase(imports_.begin() + static_cast<std::ptrdiff_t>(i));
        images_.erase(images_.begin() + static_cast<std::ptrdiff_t>(i));
      }
    }
    LARARIUM_RETURN_IF_ERROR(RequireImages());
    for (const Status& problem : left_out_) {
      warnings_.push_back(problem.message() + " (the image is left out)");
    }
    return Status();
  }

  // One image that cannot be read costs that image.
  void LeaveOut(Status problem) { left_out_.push_back(std::move(problem)); }

  // Fails if most of the images were left out.
  Status RequireImages() const {
    const bool enough = imports_.size() >= 2 && left_out_.size() <= imports_.size();
    return enough ? Status() : left_out_.front();
  }

  Status ReadOne(const Import& import, TrainingImage& image) const {
    const fs::path file = folder_ / import.file;
    const auto camera =
        std::find_if(model_.cameras.begin(), model_.cameras.end(),
                     [&](const ColmapCamera& c) { return c.id == import.image->camera; });
    image.frame_index = import.frame_index;
    image.name = import.file;
    LARARIUM_ASSIGN_OR_RETURN(image.bgr, ReadImage(file, *camera));
    if (import.own_camera != nullptr) {
      image.bgr = Resample(image.bgr, *import.own_camera, camera_);
    }
    cv::cvtColor(image.bgr, image.grey, cv::COLOR_BGR2GRAY);
    vision::FeatureOptions options;
    options.contrast_threshold = 0.02f;  // The same as in training.
    options.max_features = options_.max_features;
    auto features = vision::ExtractFeatures(image.grey, options);
    if (!features.ok()) {
      return features.status().At(file.string());
    }
    image.features = std::move(features).value();
    return Status();
  }

  // Converts the position of a model feature to our pixel convention and camera.
  Eigen::Vector2d PixelOf(const Import& import, const ColmapFeature& feature) const {
    const Eigen::Vector2d pixel(feature.x - 0.5, feature.y - 0.5);
    return import.own_camera == nullptr
               ? pixel
               : camera_.PixelFromPlane(import.own_camera->PlaneFromPixel(pixel));
  }

  // For each point of the model, our features that show it, in order of images. If several points
  // are near a feature, it shows the nearest.
  Tracks FindTracks() const {
    struct Tie {
      double distance;
      uint32_t feature;
      uint64_t point;
    };
    std::vector<std::vector<Tie>> ties(imports_.size());
    ParallelFor(imports_.size(), [&](size_t i) {
      const FeatureGrid grid(images_[i].features, options_.radius_px);
      std::vector<Tie>& of_image = ties[i];
      for (const ColmapFeature& feature : imports_[i].image->features) {
        if (feature.point == ColmapFeature::kNoPoint) {
          continue;
        }
        const Eigen::Vector2d pixel = PixelOf(imports_[i], feature);
        if (const auto nearest = grid.Nearest(pixel)) {
          const vision::Keypoint& keypoint = images_[i].features.keypoints[*nearest];
          of_image.push_back(
              {(Eigen::Vector2d(keypoint.x, keypoint.y) - pixel).norm(), *nearest, feature.point});
        }
      }
      std::sort(of_image.begin(), of_image.end(), [](const Tie& a, const Tie& b) {
        return std::tie(a.distance, a.feature, a.point) < std::tie(b.distance, b.feature, b.point);
      });
      std::set<uint32_t> features;
      std::set<uint64_t> points;
      std::erase_if(of_image, [&](const Tie& tie) {
        if (features.contains(tie.feature) || points.contains(tie.point)) {
          return true;
        }
        features.insert(tie.feature);
        points.insert(tie.point);
        return false;
      });
    });
    std::map<uint64_t, std::vector<TrackElement>> observations;
    for (uint32_t i = 0; i < ties.size(); ++i) {
      for (const Tie& tie : ties[i]) {
        observations[tie.point].push_back({i, tie.feature});
      }
    }
    Tracks tracks;
    for (const ColmapPoint& point : model_.points) {
      if (const auto found = observations.find(point.id); found != observations.end()) {
        tracks.elements.insert(tracks.elements.end(), found->second.begin(), found->second.end());
      }
      tracks.begin.push_back(static_cast<uint32_t>(tracks.elements.size()));
    }
    return tracks;
  }

  // The model's poses, with our features and some tracks of them.
  Reconstruction Located(Tracks tracks) const {
    std::vector<std::vector<Eigen::Vector2d>> pixels(images_.size());
    for (size_t i = 0; i < images_.size(); ++i) {
      for (const vision::Keypoint& keypoint : images_[i].features.keypoints) {
        pixels[i].emplace_back(keypoint.x, keypoint.y);
      }
    }
    Reconstruction reconstruction(camera_, std::move(pixels), std::move(tracks));
    for (uint32_t i = 0; i < imports_.size(); ++i) {
      reconstruction.Locate(i, imports_[i].image->camera_from_map);
    }
    return reconstruction;
  }

  bool HasTracks() const {
    return std::any_of(model_.points.begin(), model_.points.end(),
                       [](const ColmapPoint& point) { return !point.observations.empty(); });
  }

  // Builds a reconstruction from the model's poses alone: our features are matched, and the points
  // that they show are triangulated.
  Result<Reconstruction> Triangulate() {
    ImageMappingOptions options;
    options.cameras = {{camera_, true}};
    options.seed = options_.seed;
    LARARIUM_ASSIGN_OR_RETURN(const VerifiedPairs verified,
                              MatchImages(images_, options, progress_, log_));
    std::vector<uint32_t> feature_counts;
    for (const TrainingImage& image : images_) {
      feature_counts.push_back(static_cast<uint32_t>(image.features.size()));
    }
    Reconstruction reconstruction = Located(BuildTracks(feature_counts, verified.pairs));
    const TriangulationOptions triangulation;
    for (uint32_t track = 0; track < reconstruction.tracks().size(); ++track) {
      if (reconstruction.Triangulate(track, triangulation)) {
        reconstruction.Complete(track, triangulation.max_error_px);
        reconstruction.Reintersect(track);
        reconstruction.Filter(track, triangulation);
      }
    }
    const size_t found = reconstruction.PointCount();
    if (found < kMinPoints) {
      return Status::Error(kImport,
                           "the model has no tracks, and only " + std::to_string(found) +
                               " points could be triangulated from the images of " +
                               folder_.string(),
                           "run `colmap point_triangulator` and import what it writes");
    }
    warnings_.push_back("the model has no tracks; " + std::to_string(found) +
                        " points were triangulated from its images and poses");
    return reconstruction;
  }

  // Builds a reconstruction from the model's poses and points, with our features as observations.
  Result<Reconstruction> Tie() {
    progress_.Report("points", 0.0);
    Reconstruction reconstruction = Located(FindTracks());
    // The model's points are trusted, so narrow angles are accepted.
    TriangulationOptions triangulation;
    triangulation.min_angle = 1e-4;
    for (uint32_t track = 0; track < model_.points.size(); ++track) {
      if (reconstruction.Triangulate(track, triangulation)) {
        reconstruction.MovePoint(track, model_.points[track].position);
        reconstruction.Complete(track, triangulation.max_error_px);
        reconstruction.Filter(track, triangulation);
      }
    }
    const size_t found = reconstruction.PointCount();
    log_.Info("{} of the model's {} points were found again in its images", found,
              model_.points.size());
    if (found < kMinPoints) {
      return Status::Error(kImport,
                           "only " + std::to_string(found) + " of the model's " +
                               std::to_string(model_.points.size()) +
                               " points were found again in the images of " + folder_.string(),
                           "name the images that the model was made of");
    }
    return reconstruction;
  }

  const ColmapModel& model_;
  const fs::path& folder_;
  ColmapImportOptions options_;
  Progress& progress_;
  Log& log_;
  std::vector<std::string>& warnings_;
  CameraModel camera_;
  std::map<uint32_t, CameraModel> cameras_;  // Key: camera id.
  std::vector<Import> imports_;
  std::vector<TrainingImage> images_;  // Parallel to imports_.
  std::vector<Status> left_out_;       // Why images of the model are not imported.
};

}  // namespace

ColmapModel ColmapFromDatabase(const vision::SceneDatabase& database) {
  ColmapModel model;
  model.cameras.push_back(ColmapFromCamera(database.camera, 1));
  const std::vector<std::string> names = FileNames(database);
  for (size_t i = 0; i < database.keyframes.size(); ++i) {
    ColmapImage& image = model.images.emplace_back();
    image.id = static_cast<uint32_t>(i + 1);
    image.camera = 1;
    image.camera_from_map = database.keyframes[i].camera_from_map;
    image.camera_from_map.rotation.normalize();
    image.name = names[i];
  }
  const bool has_colours = database.colours.size() == database.points.size();
  for (size_t i = 0; i < database.points.size(); ++i) {
    ColmapPoint& point = model.points.emplace_back();
    point.id = i + 1;
    point.position = database.points[i].cast<double>();
    for (int c = 0; c < 3 && has_colours; ++c) {
      point.colour[c] = SrgbByte(database.colours[i][c]);
    }
  }
  for (const vision::Observation& o : database.observations) {
    std::vector<ColmapFeature>& features = model.images[o.keyframe].features;
    model.points[o.point].observations.push_back(
        {o.keyframe + 1, static_cast<uint32_t>(features.size())});
    features.push_back({o.x + 0.5, o.y + 0.5, uint64_t{o.point} + 1});
  }
  FillErrors(database, model);
  return model;
}

Status ExportColmap(const vision::SceneDatabase& database,
                    const fs::path& folder,
                    ColmapFormat format,
                    bool with_images) {
  LARARIUM_RETURN_IF_ERROR(database.Validate());
  const ColmapModel model = ColmapFromDatabase(database);
  LARARIUM_RETURN_IF_ERROR(model.Validate());
  std::error_code ignored;
  if (FileExists(folder) && !fs::is_empty(folder, ignored)) {
    return Status::Error(folder.string(), "exists already",
                         "name a new folder, or remove this one");
  }
  const fs::path plain = folder.has_filename() ? folder : folder.parent_path();
  LARARIUM_ASSIGN_OR_RETURN(HalfWrittenFolder half, HalfWrittenFolder::Beside(plain));
  const ColmapFiles files = SerializeColmapModel(model, format);
  const std::string extension = format == ColmapFormat::kText ? ".txt" : ".bin";
  const auto write = [&](const char* stem, const std::string& content) {
    return WriteFileAtomically(half.path() / (stem + extension), std::string_view(content));
  };
  LARARIUM_RETURN_IF_ERROR(write("cameras", files.cameras));
  LARARIUM_RETURN_IF_ERROR(write("images", files.images));
  LARARIUM_RETURN_IF_ERROR(write("points3D", files.points));
  for (size_t i = 0; i < model.images.size() && with_images; ++i) {
    if (!database.keyframes[i].grey.empty()) {
      LARARIUM_RETURN_IF_ERROR(
          WriteImage(half.path() / "images" / model.images[i].name, database.keyframes[i].grey));
    }
  }
  return half.MoveTo(plain);
}

Status ColmapImportOptions::Validate() const {
  if (!(radius_px > 0.0 && radius_px <= 10.0)) {
    return Status::Error(kImport, "radius_px must lie above 0 and up to 10");
  }
  if (max_features < 100 || max_features > 50'000) {
    return Status::Error(kImport, "max_features must lie between 100 and 50000");
  }
  if (max_points < 100 || max_points > 10'000'000) {
    return Status::Error(kImport, "max_points must lie between 100 and 10000000");
  }
  return Status();
}

Result<ColmapFolders> FindColmapFolders(const fs::path& model, const fs::path& images) {
  std::error_code ignored;
  ColmapFolders folders;
  for (const fs::path& candidate :
       {model, model / "sparse" / "0", model / "sparse", model / "colmap" / "sparse" / "0"}) {
    if (folders.model.empty() &&
        (FileExists(candidate / "cameras.bin") || FileExists(candidate / "cameras.txt"))) {
      folders.model = candidate;
    }
  }
  if (folders.model.empty()) {
    return Status::Error(model.string(), "has no cameras.bin or cameras.txt",
                         "name the folder of a COLMAP model, such as sparse/0");
  }
  folders.images = images;
  const fs::path base = fs::absolute(folders.model, ignored).lexically_normal();
  for (fs::path at = base; folders.images.empty() && at != at.root_path(); at = at.parent_path()) {
    if (fs::is_directory(at / "images", ignored)) {
      folders.images = at / "images";
    }
    // In a project, the model is at most three folders deep (colmap/sparse/0).
    if (at == base.parent_path().parent_path().parent_path()) {
      break;
    }
  }
  if (!fs::is_directory(folders.images, ignored)) {
    return Status::Error(
        images.empty() ? model.string() : images.string(),
        images.empty() ? "has no folder images in or beside it" : "is not a folder",
        "name the folder of the model's images with --images");
  }
  return folders;
}

Result<vision::SceneDatabase> ImportColmap(const fs::path& model,
                                           const fs::path& images,
                                           const ColmapImportOptions& options,
                                           Progress& progress,
                                           Log& log,
                                           std::vector<std::string>& warnings) {
  LARARIUM_RETURN_IF_ERROR(options.Validate());
  LARARIUM_ASSIGN_OR_RETURN(const ColmapFolders folders, FindColmapFolders(model, images));
  LARARIUM_ASSIGN_OR_RETURN(const ColmapModel parsed, LoadColmapModel(folders.model));
  return Importer(parsed, folders.images, options, progress, log, warnings).Run();
}

}  // namespace lararium::train
