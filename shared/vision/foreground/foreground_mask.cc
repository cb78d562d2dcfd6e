#include "shared/vision/foreground/foreground_mask.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "shared/vision/rolling_shutter.h"
#include "shared/vision/wrapped_poses.h"

namespace lararium::vision {
namespace {

constexpr double kSmallPixels = 4800.0;  // Number of pixels of a small image.
constexpr int kCell = 2;                 // Side of a cell of depths, small pixels.
constexpr float kFarthestPoint = 3.0f;   // Distance from which a point tells a depth, cells.
constexpr float kNoise = 4.0f;           // Standard deviation of a grey value.
constexpr float kRegistration = 0.35f;   // Standard deviation of a warp, small pixels.
constexpr float kRelativeNoise = 0.05f;  // Standard deviation of a grey value, as its share.
constexpr float kWhite = 240.0f;         // Brighter grey values may be clipped.
constexpr float kUnseen = 1e6f;          // Difference where no view shows the surface.
constexpr float kDoubt = 2.0f;           // Log odds of background where there is no difference.
constexpr float kLeastUnit = 0.6f;       // Lowest standard deviation of differences.
// The mask is not trusted below these numbers of seen points and shares of compared pixels, nor
// above this median difference at seen points and this share of foreground.
constexpr size_t kLeastSeen = 30;
constexpr double kLeastCompared = 0.3;
constexpr float kMostUnit = 2.0f;
constexpr double kMostForeground = 0.8;

cv::Size SmallSize(int width, int height) {
  const double scale =
      std::min(1.0, std::sqrt(kSmallPixels / (static_cast<double>(width) * height)));
  return {std::max(16, static_cast<int>(std::lround(scale * width))),
          std::max(16, static_cast<int>(std::lround(scale * height)))};
}

}  // namespace

ForegroundMask::ForegroundMask(std::shared_ptr<const SceneDatabase> map) : map_(std::move(map)) {
  const geometry::CameraModel& camera = map_->camera;
  const cv::Size size = SmallSize(camera.width, camera.height);
  view_camera_ = camera.Resized(size.width, size.height);
  view_camera_.k1 = view_camera_.k2 = view_camera_.p1 = view_camera_.p2 = 0.0;
  const std::span<const Observation> observations = map_->observations;
  size_t begin = 0;
  for (uint32_t k = 0; k < map_->keyframes.size(); ++k) {
    size_t end = begin;
    while (end < observations.size() && observations[end].keyframe == k) {
      ++end;
    }
    if (!map_->keyframes[k].grey.empty() && end > begin) {
      AddView(map_->keyframes[k], observations.subspan(begin, end - begin));
    }
    begin = end;
  }
  ranking_.resize(views_.size());
}

void ForegroundMask::AddView(const Keyframe& keyframe, std::span<const Observation> observations) {
  const cv::Size size(view_camera_.width, view_camera_.height);
  cv::Mat small, grey, along_x, along_y, gradient;
  cv::resize(keyframe.grey, small, size, 0.0, 0.0, cv::INTER_AREA);
  small.convertTo(grey, CV_32F);
  const geometry::CameraModel raw = map_->camera.Resized(size.width, size.height);
  if (raw.HasDistortion()) {
    cv::Mat where(size, CV_32FC2), straight;
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x) {
        const Eigen::Vector2d pixel = raw.PixelFromPlane(view_camera_.PlaneFromPixel({x, y}));
        where.at<cv::Vec2f>(y, x) = {static_cast<float>(pixel.x()), static_cast<float>(pixel.y())};
      }
    }
    cv::remap(grey, straight, where, {}, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
    grey = straight;
  }
  cv::Sobel(grey, along_x, CV_32F, 1, 0, 3, 0.125, 0.0, cv::BORDER_REPLICATE);
  cv::Sobel(grey, along_y, CV_32F, 0, 1, 3, 0.125, 0.0, cv::BORDER_REPLICATE);
  cv::magnitude(along_x, along_y, gradient);
  View& view = views_.emplace_back();
  view.camera_from_map = keyframe.camera_from_map;
  view.centre = keyframe.camera_from_map.Inverse().translation;
  cv::merge(std::array{grey, gradient}, view.image);
  view.observations = observations;
  std::vector<double> depths;
  for (const Observation& seen : observations) {
    depths.push_back((keyframe.camera_from_map * map_->points[seen.point].cast<double>()).z());
  }
  const auto middle = depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2);
  std::nth_element(depths.begin(), middle, depths.end());
  view.depth = std::max(*middle, 1e-9);
}

cv::Mat ForegroundMask::Estimate(const TrackedFrame& tracked, std::span<const SeenPoint> seen) {
  if (!tracked.camera_from_map || seen.size() < kLeastSeen || views_.empty()) {
    return {};
  }
  SetCamera(tracked.camera);
  const cv::Size size(camera_.width, camera_.height);
  cv::resize(tracked.frame.bgr, bgr_, size, 0.0, 0.0, cv::INTER_AREA);
  cv::resize(tracked.frame.grey, bytes_, size, 0.0, 0.0, cv::INTER_AREA);
  bytes_.convertTo(grey_, CV_32F);
  mean_.Apply(grey_, 3, mean_grey_);
  seen_.clear();
  const float scale_x = static_cast<float>(size.width) / static_cast<float>(tracked.camera.width);
  const float scale_y = static_cast<float>(size.height) / static_cast<float>(tracked.camera.height);
  for (const SeenPoint& point : seen) {
    const int x =
        std::clamp(static_cast<int>((point.pixel.x() + 0.5f) * scale_x), 0, size.width - 1);
    const int y =
        std::clamp(static_cast<int>((point.pixel.y() + 0.5f) * scale_y), 0, size.height - 1);
    seen_.push_back(y * size.width + x);
  }
  std::sort(seen_.begin(), seen_.end());
  seen_.erase(std::unique(seen_.begin(), seen_.end()), seen_.end());

  ChooseViews(*tracked.camera_from_map);
  EstimateDepths(tracked);
  PlaceSurfaces(tracked);
  difference_.create(size, CV_32FC1);
  difference_.setTo(kUnseen);
  for (size_t i = 0; i < std::min(kViews, ranking_.size()); ++i) {
    Compare(views_[ranking_[i].second], i == 0);
  }
  if (!Judge()) {
    return {};
  }
  cv::Mat guide = results_.Take(size.height, size.width, CV_32FC4);
  labels_.Label(bgr_, grey_, expected_, log_odds_, seen_, guide);
  if (labels_.share() == 0.0 || labels_.share() > kMostForeground) {
    return {};
  }
  return guide;
}

void ForegroundMask::ChooseViews(const geometry::Rigid3& camera_from_map) {
  const geometry::Rigid3 map_from_camera = camera_from_map.Inverse();
  const Eigen::Vector3d axis = map_from_camera.rotation * Eigen::Vector3d::UnitZ();
  for (uint32_t i = 0; i < views_.size(); ++i) {
    const View& view = views_[i];
    const Eigen::Vector3d other =
        view.camera_from_map.rotation.inverse() * Eigen::Vector3d::UnitZ();
    const double angle = std::acos(std::clamp(axis.dot(other), -1.0, 1.0));
    ranking_[i] = {(view.centre - map_from_camera.translation).norm() / view.depth + angle, i};
  }
  const auto last =
      ranking_.begin() + static_cast<std::ptrdiff_t>(std::min(kViews, ranking_.size()));
  std::partial_sort(ranking_.begin(), last, ranking_.end());
}

void ForegroundMask::SetCamera(const geometry::CameraModel& camera) {
  const cv::Size size = SmallSize(camera.width, camera.height);
  const geometry::CameraModel small = camera.Resized(size.width, size.height);
  if (small == camera_) {
    return;
  }
  camera_ = small;
  rays_.resize(static_cast<size_t>(size.area()));
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      rays_[static_cast<size_t>(y * size.width + x)] = small.PlaneFromPixel({x, y}).cast<float>();
    }
  }
}

void ForegroundMask::EstimateDepths(const TrackedFrame& tracked) {
  const cv::Size size((camera_.width + kCell - 1) / kCell, (camera_.height + kCell - 1) / kCell);
  auto& [mean, farthest, nearest] = cell_depths_;
  is_point_.create(size, CV_8UC1);
  is_point_.setTo(255);
  for (cv::Mat& cells : cell_depths_) {
    cells.create(size, CV_32FC1);
    cells.setTo(0.0f);
  }
  distance_.create(size, CV_32FC1);
  distance_.setTo(0.0f);  // Number of points in a cell, until distances replace them.
  for (size_t i = 0; i < std::min(kViews, ranking_.size()); ++i) {
    for (const Observation& seen : views_[ranking_[i].second].observations) {
      const Eigen::Vector3d point =
          *tracked.camera_from_map * map_->points[seen.point].cast<double>();
      const std::optional<Eigen::Vector2d> pixel = camera_.Project(point);
      if (!pixel || !camera_.Contains(*pixel)) {
        continue;
      }
      const int x = static_cast<int>(pixel->x() + 0.5) / kCell;
      const int y = static_cast<int>(pixel->y() + 0.5) / kCell;
      const auto inverse = static_cast<float>(1.0 / point.z());
      const bool first = is_point_.at<uint8_t>(y, x) != 0;
      is_point_.at<uint8_t>(y, x) = 0;
      distance_.at<float>(y, x) += 1.0f;
      mean.at<float>(y, x) += inverse;
      float& low = farthest.at<float>(y, x);
      float& high = nearest.at<float>(y, x);
      low = first ? inverse : std::min(low, inverse);
      high = std::max(high, inverse);
    }
  }
  if (cv::countNonZero(is_point_) == size.area()) {
    mean.setTo(1.0 / views_[ranking_.front().second].depth);
    is_point_.setTo(0);
    distance_.setTo(1.0f);
  }
  cv::max(distance_, 1.0f, filtered_);
  cv::divide(mean, filtered_, mean);
  // Cells without points take the depths of the nearest cell with points.
  cv::distanceTransform(is_point_, distance_, cells_of_, cv::DIST_L2, 3, cv::DIST_LABEL_PIXEL);
  sample_.assign(static_cast<size_t>(size.area()) + 1, 0.0f);
  for (cv::Mat& cells : cell_depths_) {
    const auto* label = cells_of_.ptr<int>();
    auto* depth = cells.ptr<float>();
    for (int i = 0; i < size.area(); ++i) {
      if (is_point_.ptr<uint8_t>()[i] == 0) {
        sample_[static_cast<size_t>(label[i])] = depth[i];
      }
    }
    for (int i = 0; i < size.area(); ++i) {
      depth[i] = sample_[static_cast<size_t>(label[i])];
    }
  }
  mean_.Apply(mean, 3, filtered_);
  std::swap(mean, filtered_);
  LeastAround(farthest, filtered_);
  std::swap(farthest, filtered_);
  GreatestAround(nearest, filtered_);
  std::swap(nearest, filtered_);
}

void ForegroundMask::PlaceSurfaces(const TrackedFrame& tracked) {
  const cv::Size size(camera_.width, camera_.height);
  for (size_t d = 0; d < kDepths; ++d) {
    cv::resize(cell_depths_[d], depths_[d], size, 0.0, 0.0, cv::INTER_LINEAR);
    for (cv::Mat& axis : surfaces_[d]) {
      axis.create(size, CV_32FC1);
    }
  }
  const bool rolls = tracked.rolling_shutter && !tracked.rolling_shutter->readout.isZero();
  for (int y = 0; y < size.height; ++y) {
    geometry::Rigid3 pose = *tracked.camera_from_map;
    // The readout along rows is exact; along columns, the middle of each row stands for it.
    if (rolls && tracked.rolling_shutter->readout.y() != 0.0) {
      pose = PoseAfter(
          pose, tracked.rolling_shutter->motion,
          tracked.rolling_shutter->readout.dot(ReadoutOrder(camera_, {0.5 * (size.width - 1), y})));
    }
    const geometry::Rigid3 map_from_camera = pose.Inverse();
    const Eigen::Matrix3f rotation = map_from_camera.rotation.toRotationMatrix().cast<float>();
    const Eigen::Vector3f centre = map_from_camera.translation.cast<float>();
    for (size_t d = 0; d < kDepths; ++d) {
      const auto* inverse = depths_[d].ptr<float>(y);
      auto* out_x = surfaces_[d][0].ptr<float>(y);
      auto* out_y = surfaces_[d][1].ptr<float>(y);
      auto* out_z = surfaces_[d][2].ptr<float>(y);
      const Eigen::Vector2f* ray = rays_.data() + static_cast<std::ptrdiff_t>(y) * size.width;
      for (int x = 0; x < size.width; ++x) {
        const Eigen::Vector3f point =
            centre + rotation * Eigen::Vector3f(ray[x].x(), ray[x].y(), 1.0f) / inverse[x];
        out_x[x] = point.x();
        out_y[x] = point.y();
        out_z[x] = point.z();
      }
    }
  }
}

void ForegroundMask::Compare(const View& view, bool nearest) {
  const Eigen::Matrix3f r = view.camera_from_map.rotation.toRotationMatrix().cast<float>();
  const Eigen::Vector3f t = view.camera_from_map.translation.cast<float>();
  const auto fx = static_cast<float>(view_camera_.fx);
  const auto fy = static_cast<float>(view_camera_.fy);
  const auto cx = static_cast<float>(view_camera_.cx);
  const auto cy = static_cast<float>(view_camera_.cy);
  const float right = static_cast<float>(view_camera_.width) - 0.5f;
  const float bottom = static_cast<float>(view_camera_.height) - 0.5f;
  const size_t pixels = difference_.total();
  column_.create(difference_.size(), CV_32FC1);
  row_.create(difference_.size(), CV_32FC1);
  float gain = 1.0f;
  for (size_t d = 0; d < kDepths; ++d) {
    const auto* px = surfaces_[d][0].ptr<float>();
    const auto* py = surfaces_[d][1].ptr<float>();
    const auto* pz = surfaces_[d][2].ptr<float>();
    auto* column = column_.ptr<float>();
    auto* row = row_.ptr<float>();
    for (size_t i = 0; i < pixels; ++i) {
      const float z = r(2, 0) * px[i] + r(2, 1) * py[i] + r(2, 2) * pz[i] + t.z();
      const float scale = z > 0.0f ? 1.0f / z : -1e6f;  // Behind the view: far outside its image.
      column[i] = (r(0, 0) * px[i] + r(0, 1) * py[i] + r(0, 2) * pz[i] + t.x()) * scale * fx + cx;
      row[i] = (r(1, 0) * px[i] + r(1, 1) * py[i] + r(1, 2) * pz[i] + t.y()) * scale * fy + cy;
      const bool shown =
          z > 0.0f && column[i] > -0.5f && column[i] < right && row[i] > -0.5f && row[i] < bottom;
      column[i] = shown ? column[i] : -2.0f;
      row[i] = shown ? row[i] : -2.0f;
    }
    cv::remap(view.image, warped_, column_, row_, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
    if (d == 0) {
      gain = Gain(warped_);
    }
    if (d == 0 && nearest) {
      cv::extractChannel(warped_, expected_, 0);
      cv::compare(column_, -1.0, bytes_, cv::CMP_LT);
      expected_.setTo(-1.0f, bytes_);
    }
    const auto* grey = grey_.ptr<float>();
    const auto* warped = warped_.ptr<cv::Vec2f>();
    auto* difference = difference_.ptr<float>();
    for (size_t i = 0; i < pixels; ++i) {
      const float value = std::min(gain * warped[i][0], kWhite);
      const float blurred = kRegistration * gain * warped[i][1];
      const float variance =
          kNoise * kNoise + blurred * blurred + kRelativeNoise * kRelativeNoise * value * value;
      const float now = std::abs(std::min(grey[i], kWhite) - value) / std::sqrt(variance);
      difference[i] = column[i] > -1.0f ? std::min(difference[i], now) : difference[i];
    }
  }
}

float ForegroundMask::Gain(const cv::Mat& warped) {
  sample_.clear();
  const auto* column = column_.ptr<float>();
  const auto* mean = mean_grey_.ptr<float>();
  const int width = warped.cols;
  for (const int pixel : seen_) {
    const int x = pixel % width;
    const int y = pixel / width;
    if (column[pixel] <= -1.0f || x == 0 || y == 0 || x + 1 == width || y + 1 == warped.rows) {
      continue;
    }
    float sum = 0.0f;
    for (int dy = -1; dy <= 1; ++dy) {
      const auto* around = warped.ptr<cv::Vec2f>(y + dy);
      sum += around[x - 1][0] + around[x][0] + around[x + 1][0];
    }
    sample_.push_back(mean[pixel] / std::max(sum / 9.0f, 4.0f));
  }
  if (sample_.empty()) {
    return 1.0f;
  }
  const auto middle = sample_.begin() + static_cast<std::ptrdiff_t>(sample_.size() / 2);
  std::nth_element(sample_.begin(), middle, sample_.end());
  return *middle;
}

bool ForegroundMask::Judge() {
  const auto* difference = difference_.ptr<float>();
  sample_.clear();
  for (const int pixel : seen_) {
    if (difference[pixel] < kUnseen) {
      sample_.push_back(difference[pixel]);
    }
  }
  if (sample_.size() < kLeastSeen / 2) {
    return false;
  }
  const auto middle = sample_.begin() + static_cast<std::ptrdiff_t>(sample_.size() / 2);
  std::nth_element(sample_.begin(), middle, sample_.end());
  const float unit = std::max(*middle, kLeastUnit);
  if (unit > kMostUnit) {
    return false;
  }
  log_odds_.create(difference_.size(), CV_32FC1);
  auto* odds = log_odds_.ptr<float>();
  int compared = 0;
  for (int y = 0; y < difference_.rows; ++y) {
    const auto* far = distance_.ptr<float>(y / kCell);
    for (int x = 0; x < difference_.cols; ++x, ++difference, ++odds) {
      const bool known = *difference < kUnseen && far[x / kCell] <= kFarthestPoint;
      const float deviations = *difference / unit;
      *odds = known ? std::clamp(0.5f * deviations * deviations - kDoubt,
                                 ForegroundLabels::kLeastOdds, ForegroundLabels::kMostOdds)
                    : ForegroundLabels::kUnknownOdds;
      compared += known ? 1 : 0;
    }
  }
  return compared >= kLeastCompared * static_cast<double>(difference_.total());
}

cv::Mat ForegroundOpacity(const TrackedFrame& tracked) {
  const cv::Mat& bgr = tracked.frame.bgr;
  if (tracked.foreground.empty()) {
    return {};
  }
  cv::Mat guide;
  cv::resize(tracked.foreground, guide, bgr.size(), 0.0, 0.0, cv::INTER_LINEAR);
  cv::Mat opacity(bgr.size(), CV_8UC1);
  for (int y = 0; y < bgr.rows; ++y) {
    const auto* colour = bgr.ptr<cv::Vec3b>(y);
    const auto* line = guide.ptr<cv::Vec4f>(y);
    auto* out = opacity.ptr<uint8_t>(y);
    for (int x = 0; x < bgr.cols; ++x) {
      const cv::Vec4f& g = line[x];
      const cv::Vec3b& c = colour[x];
      out[x] = cv::saturate_cast<uint8_t>(g[0] * static_cast<float>(c[0]) +
                                          g[1] * static_cast<float>(c[1]) +
                                          g[2] * static_cast<float>(c[2]) + 255.0f * g[3]);
    }
  }
  return opacity;
}

namespace {

class ForegroundPoses final : public WrappedPoses {
 public:
  ForegroundPoses(std::unique_ptr<PoseSource> poses,
                  std::span<const std::shared_ptr<const SceneDatabase>> maps)
      : WrappedPoses(std::move(poses)) {
    for (const auto& map : maps) {
      masks_.emplace_back(map);
    }
  }

 private:
  void Apply(TrackedFrame& tracked) override {
    Seen(seen_);
    tracked.foreground = masks_[tracked.map].Estimate(tracked, seen_);
  }

  std::vector<ForegroundMask> masks_;  // [map]
  std::vector<SeenPoint> seen_;
};

}  // namespace

std::unique_ptr<PoseSource> WithForeground(
    std::unique_ptr<PoseSource> poses, std::span<const std::shared_ptr<const SceneDatabase>> maps) {
  return std::make_unique<ForegroundPoses>(std::move(poses), maps);
}

}  // namespace lararium::vision
