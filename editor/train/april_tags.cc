#include "editor/train/april_tags.h"

#include <apriltag/apriltag.h>
#include <apriltag/tag16h5.h>
#include <apriltag/tag25h9.h>
#include <apriltag/tag36h11.h>
#include <apriltag/tagCircle21h7.h>
#include <apriltag/tagCircle49h12.h>
#include <apriltag/tagCustom48h12.h>
#include <apriltag/tagStandard41h12.h>
#include <apriltag/tagStandard52h13.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <optional>

#include "shared/core/parallel.h"
#include "shared/core/units.h"
#include "shared/geometry/triangulation.h"

namespace lararium::train {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using geometry::Rigid3;
using vision::Keyframe;
using vision::SceneDatabase;
constexpr double kMinAngle =
    2.0 * kRadiansPerDegree;            // Minimum of the widest angle between two views.
constexpr double kInlierPixels = 2.0;   // Largest RMS error of the corners in an agreeing view.
constexpr double kCornerPixels = 0.05;  // Smallest assumed standard deviation of a corner.
constexpr float kMinDecisionMargin =
    20.0f;                                 // Mean grey-level difference between bits and threshold.
constexpr size_t kMaxPairs = 300;          // Maximum number of view pairs tried as hypotheses.
constexpr size_t kDetectors = 16;          // Number of keyframes searched in parallel.
constexpr double kMaxDisagreement = 0.05;  // Relative deviation of a tag's scale from the median.

// A family's constructor and destructor, and the number of wrong bits that may be corrected: none
// if the codes are close to each other or if the table of corrected codes would be huge.
struct FamilyEntry {
  std::string_view name;
  apriltag_family_t* (*create)();
  void (*destroy)(apriltag_family_t*);
  int mended_bits;
};
constexpr std::array<FamilyEntry, 8> kFamilies = {{
    {"tag36h11", tag36h11_create, tag36h11_destroy, 1},
    {"tag25h9", tag25h9_create, tag25h9_destroy, 1},
    {"tag16h5", tag16h5_create, tag16h5_destroy, 0},
    {"tagStandard41h12", tagStandard41h12_create, tagStandard41h12_destroy, 1},
    {"tagStandard52h13", tagStandard52h13_create, tagStandard52h13_destroy, 0},
    {"tagCircle21h7", tagCircle21h7_create, tagCircle21h7_destroy, 0},
    {"tagCircle49h12", tagCircle49h12_create, tagCircle49h12_destroy, 0},
    {"tagCustom48h12", tagCustom48h12_create, tagCustom48h12_destroy, 0},
}};
constexpr std::array<std::string_view, kFamilies.size()> kFamilyNames = [] {
  std::array<std::string_view, kFamilies.size()> names;
  for (size_t i = 0; i < names.size(); ++i) {
    names[i] = kFamilies[i].name;
  }
  return names;
}();

const FamilyEntry* FindFamily(std::string_view name) {
  const auto found = std::find_if(kFamilies.begin(), kFamilies.end(),
                                  [&](const FamilyEntry& entry) { return entry.name == name; });
  return found == kFamilies.end() ? nullptr : &*found;
}

Status Problem(std::string_view problem, std::string_view remedy) {
  return Status::Error("scale from tags", problem, remedy);
}

// ------------------------------------------------------------ detection

// A tag in one keyframe. Corners are in raw pixels and in the same order in every view.
struct TagView {
  int id = 0;
  uint32_t keyframe = 0;
  std::string family;
  std::array<Vector2d, 4> pixels;
};

// The library's detectors share the families, because their code tables may be large and are only
// read during detection.
class TagDetector {
 public:
  explicit TagDetector(std::span<const FamilyEntry> entries) {
    for (const FamilyEntry& entry : entries) {
      families_.emplace_back(entry.create(), entry.destroy);
    }
    for (size_t i = 0; i < kDetectors; ++i) {
      detectors_.emplace_back(apriltag_detector_create(), apriltag_detector_destroy);
      apriltag_detector_t& detector = *detectors_.back();
      detector.nthreads = 1;  // Whole keyframes are distributed over threads instead.
      detector.quad_decimate = 1.0f;
      detector.refine_edges = true;
      for (size_t f = 0; f < entries.size(); ++f) {
        apriltag_detector_add_family_bits(&detector, families_[f].get(), entries[f].mended_bits);
      }
    }
  }

  // Detects tags in every step-th keyframe. Ordered by keyframe, then by id.
  std::vector<TagView> Detect(const SceneDatabase& database, size_t step = 1) const {
    std::vector<std::vector<TagView>> found((database.keyframes.size() + step - 1) / step);
    ParallelFor(kDetectors, [&](size_t d) {
      for (size_t i = d; i < found.size(); i += kDetectors) {
        const size_t k = i * step;
        found[i] = DetectIn(*detectors_[d], database.keyframes[k].grey, static_cast<uint32_t>(k));
      }
    });
    std::vector<TagView> views;
    for (const std::vector<TagView>& here : found) {
      views.insert(views.end(), here.begin(), here.end());
    }
    return views;
  }

 private:
  static std::vector<TagView> DetectIn(apriltag_detector_t& detector,
                                       const cv::Mat& grey,
                                       uint32_t keyframe) {
    std::vector<TagView> views;
    if (grey.empty()) {
      return views;
    }
    image_u8_t image = {grey.cols, grey.rows, static_cast<int32_t>(grey.step), grey.data};
    const std::unique_ptr<zarray_t, void (*)(zarray_t*)> detections(
        apriltag_detector_detect(&detector, &image), apriltag_detections_destroy);
    for (int i = 0; i < zarray_size(detections.get()); ++i) {
      apriltag_detection_t* detection = nullptr;
      zarray_get(detections.get(), i, &detection);
      if (detection->decision_margin < kMinDecisionMargin) {
        continue;
      }
      TagView view{detection->id, keyframe, detection->family->name, {}};
      for (size_t c = 0; c < 4; ++c) {
        // In the library, (0, 0) is the corner of the first pixel and not its centre.
        view.pixels[c] = {detection->p[c][0] - 0.5, detection->p[c][1] - 0.5};
      }
      views.push_back(view);
    }
    std::sort(views.begin(), views.end(), [](const TagView& a, const TagView& b) {
      return a.id != b.id ? a.id < b.id : a.pixels[0].x() < b.pixels[0].x();
    });
    return views;
  }

  std::vector<std::unique_ptr<apriltag_family_t, void (*)(apriltag_family_t*)>> families_;
  std::vector<std::unique_ptr<apriltag_detector_t, void (*)(apriltag_detector_t*)>> detectors_;
};

// ------------------------------------------------------------ triangulation

using TagCorners = std::array<Vector3d, 4>;

std::optional<TagCorners> Triangulate(std::span<const TagView> views,
                                      const SceneDatabase& database) {
  std::vector<Rigid3> cameras;
  for (const TagView& view : views) {
    cameras.push_back(database.keyframes[view.keyframe].camera_from_map);
  }
  TagCorners corners;
  std::vector<Vector2d> plane(views.size());
  for (size_t c = 0; c < 4; ++c) {
    for (size_t v = 0; v < views.size(); ++v) {
      plane[v] = database.camera.PlaneFromPixel(views[v].pixels[c]);
    }
    const std::optional<Vector3d> point = geometry::TriangulatePoint(cameras, plane);
    if (!point) {
      return std::nullopt;
    }
    corners[c] = *point;
  }
  return corners;
}

// Sum of the squared reprojection errors of the four corners, pixels^2; infinite behind the camera.
double SquaredError(const TagView& view, const TagCorners& corners, const SceneDatabase& database) {
  const Rigid3& camera_from_map = database.keyframes[view.keyframe].camera_from_map;
  double sum = 0.0;
  for (size_t c = 0; c < 4; ++c) {
    const auto pixel = database.camera.Project(camera_from_map * corners[c]);
    sum +=
        pixel ? (*pixel - view.pixels[c]).squaredNorm() : std::numeric_limits<double>::infinity();
  }
  return sum;
}

std::vector<TagView> Agreeing(std::span<const TagView> views,
                              const TagCorners& corners,
                              const SceneDatabase& database) {
  std::vector<TagView> agreeing;
  for (const TagView& view : views) {
    if (SquaredError(view, corners, database) <= 4.0 * kInlierPixels * kInlierPixels) {
      agreeing.push_back(view);
    }
  }
  return agreeing;
}

// The largest set of views that agree with the tag as triangulated from two of them. This excludes
// wrong detections and a second tag with the same id.
std::vector<TagView> FindConsensus(std::span<const TagView> views, const SceneDatabase& database) {
  std::vector<TagView> best;
  const size_t pairs = views.size() * (views.size() - 1) / 2;
  const size_t step = pairs / kMaxPairs + 1;
  size_t pair = 0;
  for (size_t a = 0; a < views.size(); ++a) {
    for (size_t b = a + 1; b < views.size(); ++b, ++pair) {
      if (pair % step != 0) {
        continue;
      }
      const std::array<TagView, 2> both = {views[a], views[b]};
      if (const std::optional<TagCorners> corners = Triangulate(both, database)) {
        std::vector<TagView> agreeing = Agreeing(views, *corners, database);
        if (agreeing.size() > best.size()) {
          best = std::move(agreeing);
        }
      }
    }
  }
  return best;
}

// ------------------------------------------------------------ lengths

// Covariance of a triangulated point whose pixels have the standard deviation deviation_px.
Eigen::Matrix3d PointCovariance(const Vector3d& point,
                                std::span<const TagView> views,
                                const SceneDatabase& database,
                                double deviation_px) {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  for (const TagView& view : views) {
    const Rigid3& camera_from_map = database.keyframes[view.keyframe].camera_from_map;
    const Eigen::Matrix3d rotation = camera_from_map.rotation.toRotationMatrix();
    const Vector3d in_camera = camera_from_map * point;
    Eigen::Matrix<double, 2, 3> jacobian;
    jacobian.row(0) = rotation.row(0) - in_camera.x() / in_camera.z() * rotation.row(2);
    jacobian.row(1) = rotation.row(1) - in_camera.y() / in_camera.z() * rotation.row(2);
    jacobian *= database.camera.Focal() / (in_camera.z() * deviation_px);
    information += jacobian.transpose() * jacobian;
  }
  return information.ldlt().solve(Eigen::Matrix3d::Identity());
}

// A side or a diagonal of the square: indices of its corners, and its length in sides.
struct Segment {
  size_t from;
  size_t to;
  double sides;
};
constexpr std::array<Segment, 6> kSegments = {{{0, 1, 1.0},
                                               {1, 2, 1.0},
                                               {2, 3, 1.0},
                                               {3, 0, 1.0},
                                               {0, 2, std::numbers::sqrt2},
                                               {1, 3, std::numbers::sqrt2}}};

// The side of the square in map units, and its standard deviation, by least squares over the six
// segments, weighted by their variances.
std::pair<double, double> SideLength(const TagCorners& corners,
                                     const std::array<Eigen::Matrix3d, 4>& covariance) {
  double information = 0.0;
  double side = 0.0;
  std::array<Vector3d, 4> gradient;
  gradient.fill(Vector3d::Zero());
  for (const auto& [from, to, sides] : kSegments) {
    const Vector3d across = corners[to] - corners[from];
    const Vector3d direction = across.normalized();
    const double variance = direction.dot((covariance[from] + covariance[to]) * direction);
    const double weight = sides / variance;
    information += weight * sides;
    side += weight * across.norm();
    gradient[to] += weight * direction;
    gradient[from] -= weight * direction;
  }
  double variance = 0.0;
  for (size_t c = 0; c < 4; ++c) {
    variance += gradient[c].dot(covariance[c] * gradient[c]);
  }
  return {side / information, std::sqrt(variance) / information};
}

// Measures a tag; the error says why it is left out.
Result<TagReport> MeasureTag(std::span<const TagView> all,
                             const SceneDatabase& database,
                             double size_m) {
  const std::string name = "tag " + std::to_string(all.front().id);
  if (all.size() < 2) {
    return Problem(name + " is seen in one keyframe only", "film it from several places");
  }
  std::vector<TagView> views = FindConsensus(all, database);
  std::optional<TagCorners> corners;
  if (views.size() >= 2) {
    corners = Triangulate(views, database);
  }
  if (!corners) {
    return Problem(name + " does not lie in one place in the " + std::to_string(all.size()) +
                       " keyframes that show it",
                   "show every id once, and let it lie still");
  }
  std::vector<Vector3d> centers;
  for (const TagView& view : views) {
    centers.push_back(database.keyframes[view.keyframe].camera_from_map.Center());
  }
  if (geometry::WidestAngle(centers, (*corners)[0]) < kMinAngle) {
    return Problem(name + " is seen from almost the same direction only",
                   "film it from places farther apart");
  }
  TagReport report;
  report.id = views.front().id;
  report.views = static_cast<int>(views.size());
  report.corners = *corners;
  double sum = 0.0;
  for (const TagView& view : views) {
    sum += SquaredError(view, *corners, database);
  }
  const double count = static_cast<double>(views.size());
  report.error_px = std::sqrt(sum / (4.0 * count));
  // The views give eight coordinates each; twelve degrees of freedom are used by the corners.
  const double deviation_px = std::max(std::sqrt(sum / (8.0 * count - 12.0)), kCornerPixels);
  std::array<Eigen::Matrix3d, 4> covariance;
  for (size_t c = 0; c < 4; ++c) {
    covariance[c] = PointCovariance((*corners)[c], views, database, deviation_px);
  }
  const auto [side, deviation] = SideLength(*corners, covariance);
  report.metres_per_unit = size_m / side;
  report.deviation = deviation / side;
  return report;
}

// ------------------------------------------------------------ all tags together

// Moves tags whose size differs from most others to scale.left_out.
void LeaveOutStrangers(TagScale& scale) {
  if (scale.tags.size() < 3) {
    return;
  }
  std::vector<double> values;
  for (const TagReport& tag : scale.tags) {
    values.push_back(tag.metres_per_unit);
  }
  const auto middle = values.begin() + static_cast<ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  const double median = *middle;
  std::erase_if(scale.tags, [&](const TagReport& tag) {
    const double off = std::abs(tag.metres_per_unit / median - 1.0);
    const bool strange = off > std::max(kMaxDisagreement, 5.0 * tag.deviation);
    if (strange) {
      scale.left_out.push_back("tag " + std::to_string(tag.id) +
                               " differs in size from most other tags");
    }
    return strange;
  });
}

// The mean weighted by the inverse variances. If the tags disagree by more than their deviations,
// the deviation of the result grows in proportion (Birge, "The Calculation of Errors by the Method
// of Least Squares", Physical Review 1932).
void Combine(double size_m, TagScale& scale) {
  double information = 0.0;
  double sum = 0.0;
  for (const TagReport& tag : scale.tags) {
    const double weight = 1.0 / (tag.deviation * tag.deviation);
    information += weight;
    sum += weight * tag.metres_per_unit;
  }
  scale.metres_per_unit = sum / information;
  double chi = 0.0;
  double squares = 0.0;
  for (const TagReport& tag : scale.tags) {
    const double off = tag.metres_per_unit / scale.metres_per_unit - 1.0;
    chi += off * off / (tag.deviation * tag.deviation);
    for (const auto& [from, to, sides] : kSegments) {
      const double length = (tag.corners[to] - tag.corners[from]).norm() * scale.metres_per_unit;
      squares += std::pow(length / (sides * size_m) - 1.0, 2);
    }
  }
  const double count = static_cast<double>(scale.tags.size());
  const double birge = count > 1.0 ? std::max(1.0, std::sqrt(chi / (count - 1.0))) : 1.0;
  scale.deviation = birge / std::sqrt(information);
  scale.spread = std::sqrt(squares / (count * static_cast<double>(kSegments.size())));
}

// The error if no tag of the family was found; it says whether there are tags of other families.
Status NothingFound(const SceneDatabase& database, const TagOptions& options) {
  const bool any_image =
      std::any_of(database.keyframes.begin(), database.keyframes.end(),
                  [](const Keyframe& keyframe) { return !keyframe.grey.empty(); });
  if (!any_image) {
    return Problem("the map holds no images of its keyframes", "train the place again");
  }
  constexpr size_t kSamples = 16;  // Number of keyframes searched for other families.
  std::vector<FamilyEntry> others(kFamilies.begin(), kFamilies.end());
  std::erase_if(others, [&](const FamilyEntry& entry) { return entry.name == options.family; });
  const std::vector<TagView> strangers =
      TagDetector(others).Detect(database, database.keyframes.size() / kSamples + 1);
  if (!strangers.empty()) {
    return Problem("no tag of the family " + options.family + " is seen, but there are some of " +
                       strangers.front().family,
                   "choose that family");
  }
  return Problem("no tag of the family " + options.family + " is seen in any keyframe",
                 "film one flat, with its white margin, larger than 30 pixels");
}

}  // namespace

std::span<const std::string_view> TagFamilies() { return kFamilyNames; }

std::string TagFamilyRemedy() {
  std::string text = "use one of";
  for (const std::string_view name : kFamilyNames) {
    text += " " + std::string(name);
  }
  return text;
}

Status TagOptions::Validate() const {
  if (FindFamily(family) == nullptr) {
    return Problem("there is no tag family \"" + family + "\"", TagFamilyRemedy());
  }
  if (!(size_m > 0.0) || !std::isfinite(size_m)) {
    return Problem("the size of the tags must be more than 0 m", "give it in metres");
  }
  return Status();
}

Result<TagScale> MeasureTagScale(const SceneDatabase& database, const TagOptions& options) {
  LARARIUM_RETURN_IF_ERROR(options.Validate());
  std::map<int, std::vector<TagView>> views_of;
  for (const TagView& view : TagDetector({FindFamily(options.family), 1}).Detect(database)) {
    views_of[view.id].push_back(view);
  }
  if (views_of.empty()) {
    return NothingFound(database, options);
  }
  TagScale scale;
  Status first_problem;
  for (const auto& [id, views] : views_of) {
    const Result<TagReport> tag = MeasureTag(views, database, options.size_m);
    if (tag.ok()) {
      scale.tags.push_back(*tag);
    } else {
      scale.left_out.push_back(tag.message());
      first_problem = first_problem.ok() ? tag.status() : first_problem;
    }
  }
  if (scale.tags.empty()) {
    return first_problem;
  }
  LeaveOutStrangers(scale);
  Combine(options.size_m, scale);
  return scale;
}

}  // namespace lararium::train
