#pragma once

// What training knows about a place: the .larscene file.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <span>
#include <string>
#include <vector>

#include "shared/core/status.h"
#include "shared/geometry/camera_model.h"
#include "shared/geometry/transform.h"
#include "shared/vision/descriptor_forest.h"
#include "shared/vision/features.h"

namespace lararium::vision {

// A training image that was located.
struct Keyframe {
  int64_t frame_index = -1;  // in its video or folder
  std::string name;          // as FrameSource::FrameName
  uint32_t session = 0;
  geometry::Rigid3 camera_from_map;
  cv::Mat grey;  // CV_8UC1 of the full size, stored as JPEG; empty where the budget left it out
  // Linear R, G, B of its image over the map's photometric reference
  // (SceneDatabase::colours); positive.
  std::array<float, 3> gain = {1.0f, 1.0f, 1.0f};
};

// One sight of a point, at a raw pixel of a keyframe.
struct Observation {
  uint32_t point = 0;
  uint32_t keyframe = 0;
  float x = 0.0f;
  float y = 0.0f;
  float scale = 0.0f;  // of its keypoint, pixels
};

struct SceneDatabase {
  geometry::CameraModel camera;  // of the training images
  double mean_reprojection_error_px = 0.0;

  // Points, in map units; parallel arrays.
  std::vector<Eigen::Vector3f> points;
  std::vector<Eigen::Vector3f> normals;      // unit, mean direction towards its viewers
  std::vector<uint32_t> observation_counts;  // in all training images
  std::vector<uint32_t> session_masks;       // bit s: seen in session s
  // The photometric reference: what SampleLinear (photometry.h) gives at a point in
  // an image of gain 1, as linear R, G, B; beyond 1 where such an image would clip.
  // A channel is negative where no image shows it well. Empty in maps that were
  // trained without colour.
  std::vector<Eigen::Vector3f> colours;
  std::vector<uint32_t> descriptor_begin;  // [points + 1]: ranges in descriptors
  std::vector<Descriptor> descriptors;     // several views of each point
  std::vector<uint32_t> descriptor_point;  // [descriptors]: its point
  // [descriptors]: bit s: its point looks so in session s. Empty: in all sessions that saw it, as
  // far as is known.
  std::vector<uint32_t> descriptor_sessions;

  std::vector<Keyframe> keyframes;
  std::vector<Observation> observations;  // sorted by keyframe, then point

  DescriptorForest forest;  // over descriptors

  // The sessions in which a descriptor's point looks so, as bits.
  uint32_t SessionsOf(uint32_t descriptor) const {
    return descriptor_sessions.empty() ? session_masks[descriptor_point[descriptor]]
                                       : descriptor_sessions[descriptor];
  }

  // The invariants above, every index and number; says what is broken.
  Status Validate() const;
};

// Never a partial load: every size, index, number and the FlatBuffers structure
// are checked first. place: what errors call it.
Result<SceneDatabase> ParseSceneDatabase(std::span<const std::byte> bytes,
                                         const std::string& place);
Result<SceneDatabase> LoadSceneDatabase(const std::filesystem::path& file);
// The same database gives the same bytes.
std::vector<std::byte> SerializeSceneDatabase(const SceneDatabase& database);
Status SaveSceneDatabase(const std::filesystem::path& file, const SceneDatabase& database);

}  // namespace lararium::vision
