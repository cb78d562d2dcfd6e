#pragma once

// Metres from markers of known size: AprilTags (Wang & Olson, "AprilTag 2:
// Efficient and robust fiducial detection", IROS 2016) seen in the keyframes.

#include <Eigen/Core>
#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/status.h"
#include "shared/vision/scene_database.h"

namespace lararium::train {

// The families that can be looked for, and the sentence that lists them.
std::span<const std::string_view> TagFamilies();
std::string TagFamilyRemedy();

struct TagOptions {
  std::string family = "tag36h11";
  // Side of the square where the border's black meets white, metres: of tag36h11
  // and its like the outline of the black square.
  double size_m = 0.0;

  Status Validate() const;
};

// One tag, triangulated from all keyframes that agree on it.
struct TagReport {
  int id = 0;
  int views = 0;                 // keyframes that it was measured in
  double error_px = 0.0;         // root mean square reprojection error of its corners
  double metres_per_unit = 0.0;  // as this tag alone says
  double deviation = 0.0;        // relative standard deviation of that
  std::array<Eigen::Vector3d, 4> corners = {};  // in the map, around the square
};

struct TagScale {
  double metres_per_unit = 0.0;  // metres for each unit of the map
  // Relative standard deviation: what the corners' scatter in the images leads to,
  // more where the tags disagree by more than that.
  double deviation = 0.0;
  // Root mean square of how far the sides and diagonals of all tags are from what
  // they should be, relative to that.
  double spread = 0.0;
  std::vector<TagReport> tags;        // by id
  std::vector<std::string> left_out;  // tags that were seen and not used, and why
};

// Looks for tags in every keyframe that has an image, on all cores. The same
// database gives the same result. Errors say why there is no scale: no tag at
// all, tags of another family, a tag in too few keyframes or too far away.
Result<TagScale> MeasureTagScale(const vision::SceneDatabase& database, const TagOptions& options);

}  // namespace lararium::train
