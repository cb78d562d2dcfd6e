#pragma once

// Measures the scale of a map from markers of known size in the keyframes: AprilTags (Wang & Olson,
// "AprilTag 2: Efficient and robust fiducial detection", IROS 2016).

#include <Eigen/Core>
#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/status.h"
#include "shared/vision/scene_database.h"

namespace lararium::train {

// The supported tag families, and the remedy of an error that lists them.
std::span<const std::string_view> TagFamilies();
std::string TagFamilyRemedy();

struct TagOptions {
  std::string family = "tag36h11";
  // Side of the square at which the border changes from black to white, metres. For tag36h11 and
  // similar families this is the outline of the black square.
  double size_m = 0.0;

  Status Validate() const;
};

// One tag, triangulated from all keyframes that agree on its position.
struct TagReport {
  int id = 0;
  int views = 0;                 // Number of keyframes used.
  double error_px = 0.0;         // Root mean square reprojection error of the corners.
  double metres_per_unit = 0.0;  // Scale of the map according to this tag alone.
  double deviation = 0.0;        // Relative standard deviation of metres_per_unit.
  std::array<Eigen::Vector3d, 4> corners = {};  // Map frame, in order around the square.
};

struct TagScale {
  double metres_per_unit = 0.0;  // Metres per map unit.
  // Relative standard deviation of metres_per_unit, from the scatter of the corners in the images;
  // larger if the tags disagree by more than that.
  double deviation = 0.0;
  // Root mean square of the relative errors of the sides and diagonals of all tags.
  double spread = 0.0;
  std::vector<TagReport> tags;        // Sorted by id.
  std::vector<std::string> left_out;  // Tags that were seen but not used, and why.
};

// Searches every keyframe that has an image for tags, on all cores. The same database gives the
// same result. Errors say why there is no scale: no tag at all, only tags of another family, or a
// tag in too few keyframes or too far away.
Result<TagScale> MeasureTagScale(const vision::SceneDatabase& database, const TagOptions& options);

}  // namespace lararium::train
