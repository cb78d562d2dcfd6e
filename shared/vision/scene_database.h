#pragma once

// The trained map of a place, stored as a .larscene file.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "shared/core/status.h"
#include "shared/geometry/camera_model.h"
#include "shared/geometry/transform.h"
#include "shared/vision/descriptor_forest.h"
#include "shared/vision/features.h"

namespace lararium::vision {

// A training image with its pose.
struct Keyframe {
  int64_t frame_index = -1;  // Index in the video or image folder.
  std::string name;          // See FrameSource::FrameName.
  uint32_t session = 0;
  geometry::Rigid3 camera_from_map;
  // Motion during one frame time, see RollingShutter::motion. Zero if it is unknown.
  Eigen::Matrix<double, 6, 1> motion = Eigen::Matrix<double, 6, 1>::Zero();
  // CV_8UC1 of the camera's size, stored as JPEG. Empty if the map budget left the image out.
  cv::Mat grey;
  // Brightness of the image over the map's photometric reference (SceneDatabase::colours), linear
  // R, G, B; positive.
  std::array<float, 3> gain = {1.0f, 1.0f, 1.0f};
};

// One observation of a point, at a raw pixel of a keyframe.
struct Observation {
  uint32_t point = 0;
  uint32_t keyframe = 0;
  float x = 0.0f;
  float y = 0.0f;
  float scale = 0.0f;  // Scale of the keypoint, pixels.
};

struct SceneDatabase {
  geometry::CameraModel camera;                       // Camera of the training images.
  Eigen::Vector2d readout = Eigen::Vector2d::Zero();  // See RollingShutter.
  double mean_reprojection_error_px = 0.0;

  // Points, in map units; parallel arrays.
  std::vector<Eigen::Vector3f> points;
  std::vector<Eigen::Vector3f> normals;      // Unit; mean direction towards the observing cameras.
  std::vector<uint32_t> observation_counts;  // Number of observations in all training images.
  std::vector<uint32_t> session_masks;       // Bit s is set if session s observed the point.
  // The photometric reference: the value of SampleLinear (photometry.h) at the point in an image of
  // gain 1, linear R, G, B. Values above 1 would clip in such an image. A channel is negative if no
  // image shows it well. Empty in maps that were trained without colour.
  std::vector<Eigen::Vector3f> colours;
  // 1 if another part of the place has a point that looks the same, with the same surroundings.
  // Such points do not tell in which part the camera is. Empty if there are none.
  std::vector<uint8_t> lookalikes;
  std::vector<uint32_t> descriptor_begin;  // [points + 1]: Ranges of `descriptors`.
  std::vector<Descriptor> descriptors;     // Several views of each point.
  std::vector<uint32_t> descriptor_point;  // [descriptors]: Index of the point.
  // [descriptors]: Bit s is set if the point has this appearance in session s. Empty if this is
  // unknown; then every session that observed the point counts.
  std::vector<uint32_t> descriptor_sessions;

  std::vector<Keyframe> keyframes;
  std::vector<Observation> observations;  // Sorted by keyframe, then by point.

  DescriptorForest forest;  // Search structure over `descriptors`.

  // The sessions in which the point has the appearance of the descriptor, as bits.
  uint32_t SessionsOf(uint32_t descriptor) const {
    return descriptor_sessions.empty() ? session_masks[descriptor_point[descriptor]]
                                       : descriptor_sessions[descriptor];
  }

  bool HasLookalike(uint32_t point) const { return !lookalikes.empty() && lookalikes[point] != 0; }

  // The pose with which a keyframe saw a pixel.
  geometry::Rigid3 PoseAt(uint32_t keyframe, const Eigen::Vector2d& pixel) const;
  // The raw pixel at which a keyframe saw a point; nullopt if the camera cannot have seen it.
  std::optional<Eigen::Vector2d> PixelIn(uint32_t keyframe, const Eigen::Vector3d& point) const;

  // Checks the invariants above, every index and every number. The error says what is broken.
  Status Validate() const;
};

// Parses a database. Every size, index and number and the FlatBuffers structure are checked, so a
// damaged file gives an error and never a partial database. place names the data in errors.
Result<SceneDatabase> ParseSceneDatabase(std::span<const std::byte> bytes,
                                         const std::string& where);
Result<SceneDatabase> LoadSceneDatabase(const std::filesystem::path& file);
// Deterministic: the same database gives the same bytes. jpeg_quality: of keyframes' images.
std::vector<std::byte> SerializeSceneDatabase(const SceneDatabase& database, int jpeg_quality = 95);
Status SaveSceneDatabase(const std::filesystem::path& file, const SceneDatabase& database);

}  // namespace lararium::vision
