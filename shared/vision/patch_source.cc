#include "shared/vision/patch_source.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "shared/vision/rolling_shutter.h"

namespace lararium::vision {
namespace {

using geometry::CameraModel;
using geometry::Rigid3;

// The derivative of the raw pixel by the position on the plane z = 1.
Eigen::Matrix2d PixelFromPlaneSlope(const CameraModel& camera, const Eigen::Vector2d& plane) {
  Eigen::Matrix2d slope;
  camera.PixelFromPlane(plane, slope);
  return slope;
}

// The difference between the camera's view of a point and a keyframe's view: the angle between the
// viewing rays in radians, plus a penalty for the ratio of the distances.
float Unlike(const Rigid3& key_from_map,
             const Eigen::Vector3d& point,
             const Rigid3& camera_from_map) {
  const Eigen::Vector3d to_camera = camera_from_map.Center() - point;
  const Eigen::Vector3d to_keyframe = key_from_map.Center() - point;
  const double near = to_camera.norm();
  const double near_key = to_keyframe.norm();
  const double sine = to_camera.cross(to_keyframe).norm();
  const double angle = std::atan2(sine, to_camera.dot(to_keyframe));
  const double zoom = std::log(near_key / near);
  // A keyframe from farther away shows less detail and is penalised twice as much as a nearer one.
  const double scale = zoom > 0.0 ? 0.6 * zoom : -0.3 * zoom;
  return static_cast<float>(angle + scale);
}

// A plane n . p = 1 in the axes of another camera; nullopt if that one sees it edge-on or from
// behind.
std::optional<Eigen::Vector3d> MovedPlane(const Eigen::Vector3d& plane,
                                          const Rigid3& other_from_this) {
  // The points q = R p + t satisfy (R n) . (q - t) = 1.
  const Eigen::Vector3d turned = other_from_this.rotation * plane;
  const double distance = 1.0 + turned.dot(other_from_this.translation);
  return distance > 1e-3 ? std::optional<Eigen::Vector3d>(turned / distance) : std::nullopt;
}

}  // namespace

float HashedShare(uint32_t a, uint32_t b) {
  uint32_t h = a * 0x9e3779b1u ^ (b + 0x7f4a7c15u) * 0x85ebca6bu;
  h ^= h >> 15;
  h *= 0xc2b2ae35u;
  h ^= h >> 13;
  return static_cast<float>(h >> 8) * 0x1p-24f;
}

bool HasRoomForPatch(const CameraModel& camera, const Eigen::Vector2d& pixel) {
  constexpr double kBorderPx = 6.0;
  return pixel.x() >= kBorderPx && pixel.y() >= kBorderPx &&
         pixel.x() <= camera.width - 1 - kBorderPx && pixel.y() <= camera.height - 1 - kBorderPx;
}

SourcePatch PatchSource::PatchOf(uint32_t point) const {
  SourcePatch patch;
  patch.point = point;
  patch.point_in_map = map_->database().points[point].cast<double>();
  return patch;
}

const ImagePyramid& PatchSource::ImageOf(const SourcePatch& patch) const {
  return patch.source >= kFresh ? fresh_[patch.source - kFresh].image : map_->pyramid(patch.source);
}

// Chooses the keyframe of a patch. Returns false if no keyframe is suitable. A fresh patch is kept
// as long as its view is similar enough.
bool PatchSource::ChooseKeyframe(const Rigid3& camera_from_map, SourcePatch& patch) const {
  constexpr float kMostUnlike = 0.8f;
  if (patch.source >= kFresh) {
    return Unlike(patch.source_from_map, patch.point_in_map, camera_from_map) < kMostUnlike;
  }
  const std::optional<uint32_t> best =
      MostSimilarKeyframe(patch.point, camera_from_map, kMostUnlike);
  if (!best) {
    return false;
  }
  if (*best == patch.source && patch.tangent.squaredNorm() > 0.0) {
    return true;
  }
  const SceneDatabase& db = map_->database();
  const std::optional<Eigen::Vector2d> pixel = db.PixelIn(*best, patch.point_in_map);
  if (!pixel) {
    return false;
  }
  patch.source = *best;
  patch.source_from_map = db.PoseAt(*best, *pixel);
  patch.key_plane = (patch.source_from_map * patch.point_in_map).hnormalized();
  patch.key_pixel = *pixel;
  const auto tangent =
      MovedPlane(map_->PlaneAt(*best, patch.point),
                 patch.source_from_map * db.keyframes[*best].camera_from_map.Inverse());
  if (!tangent) {
    return false;
  }
  patch.tangent = *tangent;
  patch.plane_from_key_pixel = PixelFromPlaneSlope(db.camera, patch.key_plane).inverse();
  return HasRoomForPatch(db.camera, patch.key_pixel);
}

// The keyframe with the most similar view of a point, if the difference is below `most`; otherwise
// none. A small random term spreads points over keyframes of about equal quality, so that the
// errors of the keyframes average out.
std::optional<uint32_t> PatchSource::MostSimilarKeyframe(uint32_t point,
                                                         const Rigid3& camera_from_map,
                                                         float most) const {
  const SceneDatabase& db = map_->database();
  const Eigen::Vector3d p = db.points[point].cast<double>();
  std::optional<uint32_t> best;
  for (const uint32_t keyframe : map_->KeyframesOf(point)) {
    const float unlike = Unlike(db.keyframes[keyframe].camera_from_map, p, camera_from_map) +
                         0.03f * HashedShare(keyframe, point);
    if (unlike < most) {
      most = unlike;
      best = keyframe;
    }
  }
  return best;
}

bool PatchSource::ChooseFresh(uint32_t i, const LocatedPoint& located, SourcePatch& patch) const {
  const FreshImage& frame = fresh_[i];
  const std::optional<uint32_t> keyframe = MostSimilarKeyframe(
      patch.point, frame.camera_from_map, std::numeric_limits<float>::infinity());
  if (!keyframe) {
    return false;
  }
  const auto tangent = MovedPlane(
      map_->PlaneAt(*keyframe, patch.point),
      frame.camera_from_map * map_->database().keyframes[*keyframe].camera_from_map.Inverse());
  if (!tangent) {
    return false;
  }
  patch.tangent = *tangent;
  patch.source = kFresh + i;
  patch.source_from_map = frame.camera_from_map;
  patch.sigma_px = located.sigma_px;
  patch.key_pixel = located.pixel.cast<double>();
  patch.key_plane = frame.camera.PlaneFromPixel(patch.key_pixel);
  patch.plane_from_key_pixel = PixelFromPlaneSlope(frame.camera, patch.key_plane).inverse();
  return HasRoomForPatch(frame.camera, patch.key_pixel);
}

void PatchSource::AllocateFresh(const CameraModel& camera) {
  if (fresh_[0].image.levels() == 0) {
    const cv::Mat blank(camera.height, camera.width, CV_8UC1, cv::Scalar(0));
    for (FreshImage& fresh : fresh_) {
      fresh.image.Build(blank, CoarsestLevel(camera.width) + 2);
    }
  }
}

void PatchSource::SwapFresh(uint32_t i,
                            ImagePyramid& image,
                            const CameraModel& camera,
                            const Rigid3& camera_from_map) {
  std::swap(image, fresh_[i].image);
  fresh_[i].camera = camera;
  fresh_[i].camera_from_map = camera_from_map;
}

bool PatchSource::View(const ExposedCamera& camera,
                       const SourcePatch& patch,
                       PatchView& view) const {
  const CameraModel& model = camera.model;
  const Eigen::Vector3d p = camera.camera_from_map * patch.point_in_map;
  if (p.z() <= 1e-9) {
    return false;
  }
  const Eigen::Vector2d plane = p.hnormalized();
  if (model.FoldsBackAt(plane)) {
    return false;
  }
  Eigen::Matrix2d pixel_slope;
  view.pixel = model.PixelFromPlane(plane, pixel_slope);
  Eigen::Vector2d speed = Eigen::Vector2d::Zero();  // pixels per frame time
  Eigen::Vector2d acceleration = Eigen::Vector2d::Zero();
  if (camera.motion != nullptr) {
    const auto shift = [&](const Rigid3& motion) -> Eigen::Vector2d {
      const auto moved = model.Project(motion * p);
      return moved ? Eigen::Vector2d(*moved - view.pixel) : Eigen::Vector2d::Zero();
    };
    speed = shift(camera.motion->velocity);
    acceleration = shift(camera.motion->acceleration);
  }
  if (!camera.readout.isZero(0.0) && camera.motion != nullptr) {
    // The pixel is that of the time at which it is exposed itself.
    const Eigen::Vector2d of_middle = view.pixel;
    for (int i = 0; i < 3; ++i) {
      const double time = camera.readout.dot(ReadoutOrder(model, view.pixel));
      view.pixel = of_middle + time * speed + 0.5 * time * time * acceleration;
    }
    const Eigen::Vector2d time_slope(camera.readout.x() / model.width,
                                     camera.readout.y() / model.height);
    const Eigen::Matrix2d sheared = Eigen::Matrix2d::Identity() + speed * time_slope.transpose();
    pixel_slope = sheared * pixel_slope;
  }
  if (!HasRoomForPatch(model, view.pixel)) {
    return false;
  }
  // The tangent plane induces the homography R + t n^T from the source's plane z = 1 to that of the
  // camera.
  const Rigid3 camera_from_key = camera.camera_from_map * patch.source_from_map.Inverse();
  const Eigen::Matrix3d homography = camera_from_key.rotation.toRotationMatrix() +
                                     camera_from_key.translation * patch.tangent.transpose();
  const double z = homography.row(2).dot(patch.key_plane.homogeneous());
  if (z <= 1e-9) {
    return false;
  }
  const Eigen::Matrix2d plane_slope =
      (homography.topLeftCorner<2, 2>() - plane * homography.bottomLeftCorner<1, 2>()) / z;
  const Eigen::Matrix2d pixel_from_key = pixel_slope * plane_slope * patch.plane_from_key_pixel;
  const double area = pixel_from_key.determinant();
  if (!(area > 0.05 && area < 8.0)) {
    return false;  // The patch is shown from behind, edge-on, or much too large.
  }
  view.key_from_pixel = pixel_from_key.inverse();
  const double shutter = camera.motion != nullptr ? camera.motion->shutter : 0.0;
  view.velocity = shutter * speed;
  view.acceleration = shutter * shutter * acceleration;
  return true;
}

bool PatchSource::Sample(const ExposedCamera& camera,
                         const SourcePatch& patch,
                         int level,
                         PatchView& view,
                         PatchTemplate& sampled) const {
  if (!View(camera, patch, view)) {
    return false;
  }
  const ImagePyramid& pyramid = ImageOf(patch);
  // The source's level whose pixels have about the same size.
  const double size = std::sqrt(view.key_from_pixel.determinant()) * (1 << level);
  const int key_level =
      std::clamp(static_cast<int>(std::lround(std::log2(size))), 0, pyramid.levels() - 1);
  const double shrink = 1.0 / (1 << key_level);
  PatchWarp warp;
  warp.centre = LevelFromPixel(patch.key_pixel, key_level).cast<float>();
  warp.source_from_patch = (shrink * (1 << level) * view.key_from_pixel).cast<float>();
  warp.motion.velocity = (shrink * view.key_from_pixel * view.velocity).cast<float>();
  warp.motion.acceleration = (shrink * view.key_from_pixel * view.acceleration).cast<float>();
  return sampled.Sample(pyramid.level(key_level), warp);
}

}  // namespace lararium::vision
