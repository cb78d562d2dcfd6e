#include "editor/train/reconstruction.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "shared/core/check.h"
#include "shared/geometry/triangulation.h"
#include "shared/vision/rolling_shutter.h"

namespace lararium::train {

using geometry::Rigid3;

Reconstruction::Reconstruction(std::vector<TrainingCamera> cameras,
                               std::vector<uint32_t> camera_of_image,
                               std::vector<std::vector<Eigen::Vector2d>> pixels,
                               Tracks tracks)
    : pixels_(std::move(pixels)),
      tracks_(std::move(tracks)),
      element_track_(tracks_.elements.size()),
      image_elements_(pixels_.size()),
      camera_from_map_(pixels_.size()),
      points_(tracks_.size()),
      observed_(tracks_.elements.size()) {
  for (uint32_t track = 0; track < tracks_.size(); ++track) {
    for (uint32_t element = tracks_.begin[track]; element < tracks_.begin[track + 1]; ++element) {
      CHECK(ImageOf(element) < pixels_.size());
      element_track_[element] = track;
      image_elements_[ImageOf(element)].push_back(element);
    }
  }
  plane_points_.resize(tracks_.elements.size());
  camera_of_image.resize(pixels_.size(), 0);
  SetCameras(std::move(cameras), std::move(camera_of_image));
}

void Reconstruction::SetCameras(std::vector<TrainingCamera> cameras,
                                std::vector<uint32_t> camera_of_image) {
  CHECK(camera_of_image.size() == pixels_.size());
  cameras_ = std::move(cameras);
  camera_of_image_ = std::move(camera_of_image);
  for (uint32_t image = 0; image < image_count(); ++image) {
    CHECK(CameraOf(image) < cameras_.size());
    FillPlanePoints(image);
  }
}

void Reconstruction::SetCamera(uint32_t index, const geometry::CameraModel& camera) {
  const uint32_t lens = LensOf(cameras_, index);
  cameras_[index].model = camera;
  for (uint32_t i = 0; i < cameras_.size(); ++i) {
    if (i != index && LensOf(cameras_, i) == lens) {
      cameras_[i].model = TurnedModel(cameras_[index], cameras_[i]);
    }
  }
  for (uint32_t image = 0; image < image_count(); ++image) {
    if (LensOf(cameras_, CameraOf(image)) == lens) {
      FillPlanePoints(image);
    }
  }
}

void Reconstruction::GiveOwnCamera(uint32_t image, const geometry::CameraModel& camera) {
  TrainingCamera own = cameras_[CameraOf(image)];
  own.model = camera;
  own.lens_of.reset();
  camera_of_image_[image] = static_cast<uint32_t>(cameras_.size());
  cameras_.push_back(own);
  FillPlanePoints(image);
}

void Reconstruction::LetBreathe(std::vector<double> times) {
  CHECK(times.size() == image_count() && times_.empty());
  times_ = std::move(times);
  for (uint32_t image = 0; image < image_count(); ++image) {
    TrainingCamera own = cameras_[CameraOf(image)];
    own.lens_of = LensOf(cameras_, CameraOf(image));
    own.focal_ratio = 1.0;
    camera_of_image_[image] = static_cast<uint32_t>(cameras_.size());
    cameras_.push_back(own);
  }
}

void Reconstruction::SetFocalRatios(std::span<const double> focal_ratios) {
  CHECK(focal_ratios.size() == image_count());
  for (uint32_t image = 0; image < image_count(); ++image) {
    TrainingCamera& of_image = cameras_[CameraOf(image)];
    of_image.focal_ratio = focal_ratios[image];
    of_image.model = TurnedModel(cameras_[*of_image.lens_of], of_image);
    FillPlanePoints(image);
  }
}

void Reconstruction::FillPlanePoints(uint32_t image) {
  for (const uint32_t element : ElementsOf(image)) {
    plane_points_[element] = camera(image).PlaneFromPixel(Pixel(element));
  }
}

uint32_t Reconstruction::MainCamera() const {
  std::vector<size_t> images(cameras_.size(), 0);
  for (const uint32_t image : LocatedImages()) {
    ++images[MeanCamera(cameras_, CameraOf(image))];
  }
  return static_cast<uint32_t>(std::max_element(images.begin(), images.end()) - images.begin());
}

Rigid3 Reconstruction::PoseOf(uint32_t element) const {
  const uint32_t image = ImageOf(element);
  if (motions_.empty()) {
    return camera_from_map(image);
  }
  return vision::PoseAfter(camera_from_map(image), motions_[image],
                           readout_.dot(vision::ReadoutOrder(camera(image), Pixel(element))));
}

std::vector<uint32_t> Reconstruction::LocatedImages() const {
  std::vector<uint32_t> images;
  for (uint32_t image = 0; image < image_count(); ++image) {
    if (Located(image)) {
      images.push_back(image);
    }
  }
  return images;
}

std::vector<uint32_t> Reconstruction::TracksWithPoints() const {
  std::vector<uint32_t> tracks;
  for (uint32_t track = 0; track < points_.size(); ++track) {
    if (HasPoint(track)) {
      tracks.push_back(track);
    }
  }
  return tracks;
}

size_t Reconstruction::ObservationCount(uint32_t track) const {
  const auto first = observed_.begin() + tracks_.begin[track];
  return static_cast<size_t>(std::count(first, observed_.begin() + tracks_.begin[track + 1], 1));
}

size_t Reconstruction::PointCount() const {
  return static_cast<size_t>(
      std::count_if(points_.begin(), points_.end(), [](const auto& p) { return p.has_value(); }));
}

double Reconstruction::SquaredErrorPx(uint32_t element, const Eigen::Vector3d& point) const {
  const std::optional<Eigen::Vector2d> pixel =
      camera(ImageOf(element)).Project(PoseOf(element) * point);
  return pixel ? (*pixel - Pixel(element)).squaredNorm() : std::numeric_limits<double>::infinity();
}

std::vector<uint32_t> Reconstruction::LocatedElements(uint32_t track) const {
  std::vector<uint32_t> elements;
  for (uint32_t element = tracks_.begin[track]; element < tracks_.begin[track + 1]; ++element) {
    if (Located(ImageOf(element))) {
      elements.push_back(element);
    }
  }
  return elements;
}

std::vector<uint32_t> Reconstruction::Observations(uint32_t track) const {
  std::vector<uint32_t> elements;
  for (uint32_t element = tracks_.begin[track]; element < tracks_.begin[track + 1]; ++element) {
    if (Observed(element)) {
      elements.push_back(element);
    }
  }
  return elements;
}

bool Reconstruction::WideEnough(std::span<const uint32_t> elements,
                                const Eigen::Vector3d& point,
                                double min_angle) const {
  for (size_t i = 0; i < elements.size(); ++i) {
    const Eigen::Vector3d center = camera_from_map(ImageOf(elements[i])).Center();
    // Begins at the far end, because neighbours in the source have the narrowest angles.
    for (size_t j = elements.size() - 1; j > i; --j) {
      if (geometry::TriangulationAngle(center, camera_from_map(ImageOf(elements[j])).Center(),
                                       point) >= min_angle) {
        return true;
      }
    }
  }
  return false;
}

std::optional<Eigen::Vector3d> Reconstruction::Intersect(std::span<const uint32_t> elements) const {
  std::vector<Rigid3> cameras;
  std::vector<Eigen::Vector2d> plane_points;
  for (const uint32_t element : elements) {
    cameras.push_back(PoseOf(element));
    plane_points.push_back(PlanePoint(element));
  }
  return geometry::TriangulatePoint(cameras, plane_points);
}

std::vector<uint32_t> Reconstruction::Fitting(std::span<const uint32_t> elements,
                                              const Eigen::Vector3d& point,
                                              double max_error_px) const {
  std::vector<uint32_t> fitting;
  for (const uint32_t element : elements) {
    if (SquaredErrorPx(element, point) <= max_error_px * max_error_px) {
      fitting.push_back(element);
    }
  }
  return fitting;
}

std::vector<uint32_t> Reconstruction::BestConsensus(std::span<const uint32_t> elements,
                                                    const TriangulationOptions& options) const {
  constexpr size_t kMaxHypotheses = 30;
  std::vector<uint32_t> best;
  size_t hypotheses = 0;
  // Tries pairs that are far apart in the source first, because their rays meet at wider angles.
  for (size_t gap = elements.size() - 1; gap > 0 && hypotheses < kMaxHypotheses; --gap) {
    for (size_t i = 0; i + gap < elements.size() && hypotheses < kMaxHypotheses; ++i) {
      ++hypotheses;
      const std::array<uint32_t, 2> pair = {elements[i], elements[i + gap]};
      const std::optional<Eigen::Vector3d> point = Intersect(pair);
      if (!point || !WideEnough(pair, *point, options.min_angle)) {
        continue;
      }
      std::vector<uint32_t> fitting = Fitting(elements, *point, options.max_error_px);
      if (fitting.size() > best.size()) {
        best = std::move(fitting);
      }
    }
  }
  return best;
}

bool Reconstruction::Triangulate(uint32_t track, const TriangulationOptions& options) {
  CHECK(!HasPoint(track));
  std::vector<uint32_t> elements = LocatedElements(track);
  if (elements.size() < 2) {
    return false;
  }
  std::optional<Eigen::Vector3d> point = Intersect(elements);
  if (!point || Fitting(elements, *point, options.max_error_px).size() < elements.size()) {
    elements = elements.size() > 2 ? BestConsensus(elements, options) : std::vector<uint32_t>();
    if (elements.size() < 2) {
      return false;
    }
    point = Intersect(elements);
    if (!point) {
      return false;
    }
    elements = Fitting(elements, *point, options.max_error_px);
  }
  if (elements.size() < 2 || !WideEnough(elements, *point, options.min_angle)) {
    return false;
  }
  points_[track] = *point;
  for (const uint32_t element : elements) {
    observed_[element] = 1;
  }
  return true;
}

void Reconstruction::Reintersect(uint32_t track) {
  const std::optional<Eigen::Vector3d> point = Intersect(Observations(track));
  if (point) {
    points_[track] = *point;
  } else {
    DropPoint(track);
  }
}

void Reconstruction::Complete(uint32_t track, double max_error_px) {
  for (const uint32_t element : LocatedElements(track)) {
    if (!Observed(element) &&
        SquaredErrorPx(element, Point(track)) <= max_error_px * max_error_px) {
      observed_[element] = 1;
    }
  }
}

size_t Reconstruction::Filter(uint32_t track, const TriangulationOptions& options) {
  const std::vector<uint32_t> before = Observations(track);
  const std::vector<uint32_t> kept = Fitting(before, Point(track), options.max_error_px);
  if (kept.size() < 2 || !WideEnough(kept, Point(track), options.min_angle)) {
    DropPoint(track);
    return before.size();
  }
  for (const uint32_t element : before) {
    observed_[element] = 0;
  }
  for (const uint32_t element : kept) {
    observed_[element] = 1;
  }
  return before.size() - kept.size();
}

void Reconstruction::DropIfMoving(uint32_t track) {
  if (2 * ObservationCount(track) <= LocatedElements(track).size()) {
    DropPoint(track);
  }
}

void Reconstruction::DropPoint(uint32_t track) {
  points_[track].reset();
  std::fill(observed_.begin() + tracks_.begin[track], observed_.begin() + tracks_.begin[track + 1],
            0);
}

void Reconstruction::Unlocate(uint32_t image) {
  for (const uint32_t element : ElementsOf(image)) {
    if (Observed(element)) {
      observed_[element] = 0;
      if (ObservationCount(TrackOf(element)) < 2) {
        DropPoint(TrackOf(element));
      }
    }
  }
  camera_from_map_[image].reset();
}

void Reconstruction::Transform(const geometry::Similarity3& new_from_map) {
  const geometry::Similarity3 map_from_new = new_from_map.Inverse();
  for (auto& pose : camera_from_map_) {
    if (pose) {
      // Scales the translation, so that the pose stays rigid in the new unit.
      pose = geometry::CameraFromB(*pose, map_from_new);
    }
  }
  for (ImageMotion& motion : motions_) {
    motion.tail<3>() *= new_from_map.scale;
  }
  for (auto& point : points_) {
    if (point) {
      point = new_from_map * *point;
    }
  }
}

}  // namespace lararium::train
