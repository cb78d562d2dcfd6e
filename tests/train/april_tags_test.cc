#include "editor/train/april_tags.h"

#include <apriltag/apriltag.h>
#include <apriltag/tag16h5.h>
#include <apriltag/tag36h11.h>
#include <gmock/gmock.h>

#include <cmath>
#include <memory>
#include <opencv2/imgproc.hpp>

#include "shared/core/random.h"

namespace lararium::train {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using geometry::Rigid3;
using geometry::Similarity3;
using ::testing::HasSubstr;

using Family = std::unique_ptr<apriltag_family_t, void (*)(apriltag_family_t*)>;

// A tag as it is printed, with its white margin, on a plane of the world.
class PrintedTag {
 public:
  PrintedTag(apriltag_family_t& family, int id, double size_m, const Rigid3& world_from_tag)
      : world_from_tag_(world_from_tag), cell_(size_m / family.width_at_border) {
    image_u8_t* image = apriltag_to_image(&family, static_cast<uint32_t>(id));
    cells_ = cv::Mat(image->height, image->width, CV_8UC1, image->buf,
                     static_cast<size_t>(image->stride))
                 .clone();
    image_u8_destroy(image);
  }

  // The grey level at which a ray meets the tag; nullopt beside the tag.
  std::optional<double> Shade(const Vector3d& center, const Vector3d& ray) const {
    const Vector3d normal = world_from_tag_.rotation * Vector3d::UnitZ();
    const double depth = normal.dot(world_from_tag_.translation - center) / normal.dot(ray);
    const Vector3d at = world_from_tag_.Inverse() * (center + depth * ray);
    const int column = static_cast<int>(std::floor(at.x() / cell_ + 0.5 * cells_.cols));
    const int row = static_cast<int>(std::floor(at.y() / cell_ + 0.5 * cells_.rows));
    if (depth <= 0.0 || column < 0 || row < 0 || column >= cells_.cols || row >= cells_.rows) {
      return std::nullopt;
    }
    return cells_.at<uint8_t>(row, column) == 0 ? 30.0 : 220.0;
  }

 private:
  Rigid3 world_from_tag_;
  double cell_;
  cv::Mat cells_;
};

Rigid3 LookAtTag(const Vector3d& center, const Vector3d& target) {
  const Vector3d forward = (target - center).normalized();
  const Vector3d right = forward.cross(Vector3d::UnitZ()).normalized();
  Eigen::Matrix3d camera_from_world;
  camera_from_world << right.transpose(), forward.cross(right).transpose(), forward.transpose();
  return Rigid3::FromMatrix(camera_from_world, -camera_from_world * center);
}

// Renders tags in front of a grey wall. A pixel whose corners differ is the mean of 5 x 5 rays. The
// image is blurred and noisy like a photograph.
cv::Mat Photograph(const geometry::CameraModel& camera,
                   const Rigid3& camera_from_world,
                   std::span<const PrintedTag> tags,
                   Random& random) {
  constexpr int kRays = 5;
  const Rigid3 world_from_camera = camera_from_world.Inverse();
  const auto shade = [&](const Vector2d& plane) {
    const Vector3d direction = world_from_camera.rotation * plane.homogeneous();
    double value = 120.0;
    for (const PrintedTag& tag : tags) {
      value = tag.Shade(world_from_camera.translation, direction).value_or(value);
    }
    return value;
  };
  cv::Mat image(camera.height, camera.width, CV_32FC1);
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const Vector2d middle = camera.PlaneFromPixel(Vector2d(x, y));
      const Vector2d half(0.5 / camera.fx,
                          0.5 / camera.fy);  // Distortion is constant within a pixel.
      double value = shade(middle - half);
      if (value != shade(middle + half) || value != shade(middle + Vector2d(-half.x(), half.y())) ||
          value != shade(middle + Vector2d(half.x(), -half.y()))) {
        value = 0.0;
        for (int ray = 0; ray < kRays * kRays; ++ray) {
          const Vector2d within(2 * (ray % kRays) + 1 - kRays, 2 * (ray / kRays) + 1 - kRays);
          value += shade(middle + half.cwiseProduct(within) / kRays) / (kRays * kRays);
        }
      }
      image.at<float>(y, x) = static_cast<float>(value + 1.5 * random.Normal());
    }
  }
  cv::GaussianBlur(image, image, cv::Size(), 0.6);
  cv::Mat grey;
  image.convertTo(grey, CV_8UC1);
  return grey;
}

// Tags around the origin, seen by cameras on an arc in front of them. The map has another scale and
// orientation than the world.
struct Setting {
  geometry::CameraModel camera = {320, 240, 330.0, 330.0, 160.0, 118.0, -0.05, 0.01, 0.0, 0.0};
  Similarity3 map_from_world = {
      0.41, Eigen::Quaterniond(0.3, -0.5, 0.7, 0.4).normalized(), {5.0, -2.0, 1.0}};
  int cameras = 8;

  vision::SceneDatabase Film(std::span<const PrintedTag> tags) const {
    Random random(7);
    vision::SceneDatabase database;
    database.camera = camera;
    for (int i = 0; i < cameras; ++i) {
      const double angle = -0.7 + 1.4 * i / std::max(cameras - 1, 1);
      const Vector3d center(1.1 * std::sin(angle), -1.1 * std::cos(angle), 0.35 - 0.08 * i);
      const Rigid3 camera_from_world = LookAtTag(center, Vector3d(0.02 * i, 0.0, 0.0));
      vision::Keyframe keyframe;
      keyframe.frame_index = i;
      keyframe.camera_from_map = geometry::CameraFromB(camera_from_world, map_from_world.Inverse());
      keyframe.grey = Photograph(camera, camera_from_world, tags, random);
      database.keyframes.push_back(std::move(keyframe));
    }
    return database;
  }
};

constexpr double kSize = 0.20;

// The pose of a tag that faces the cameras: x right, y down, z away from them.
Rigid3 Facing(double x, double turn) {
  Eigen::Matrix3d world_from_tag;
  world_from_tag << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  return {Eigen::Quaterniond(Eigen::AngleAxisd(turn, Vector3d::UnitZ())) *
              Eigen::Quaterniond(world_from_tag),
          {x, 0.0, 0.0}};
}

Family Tag36h11() { return {tag36h11_create(), tag36h11_destroy}; }

TEST(TagScale, IsRightToAThousandth) {
  const Family family = Tag36h11();
  const Setting setting;
  const std::vector<PrintedTag> tags = {{*family, 5, kSize, Facing(-0.2, 0.2)},
                                        {*family, 17, kSize, Facing(0.2, -0.3)}};
  const auto scale = MeasureTagScale(setting.Film(tags), {"tag36h11", kSize});
  ASSERT_TRUE(scale.ok()) << scale.message();
  const double truth = 1.0 / setting.map_from_world.scale;
  EXPECT_NEAR(scale->metres_per_unit / truth, 1.0, 1e-3);
  ASSERT_EQ(scale->tags.size(), 2u);
  EXPECT_EQ(scale->tags[0].id, 5);
  EXPECT_EQ(scale->tags[1].id, 17);
  for (const TagReport& tag : scale->tags) {
    EXPECT_EQ(tag.views, setting.cameras);
    EXPECT_LT(tag.error_px, 0.3);
    EXPECT_NEAR(tag.metres_per_unit / truth, 1.0, 5.0 * tag.deviation + 5e-4);
  }
  EXPECT_LT(scale->deviation, 2e-3);
  EXPECT_LT(scale->spread, 1e-2);
}

TEST(TagScale, LeavesOutATagThatMoved) {
  const Family family = Tag36h11();
  const Setting setting;
  const std::vector<PrintedTag> tags = {{*family, 5, kSize, Facing(0.0, 0.2)}};
  const std::vector<PrintedTag> moved = {{*family, 5, kSize, Facing(0.1, 0.2)}};
  vision::SceneDatabase database = setting.Film(tags);
  const vision::SceneDatabase later = setting.Film(moved);
  for (const size_t k : {2, 5}) {
    database.keyframes[k].grey = later.keyframes[k].grey;
  }
  const auto scale = MeasureTagScale(database, {"tag36h11", kSize});
  ASSERT_TRUE(scale.ok()) << scale.message();
  EXPECT_EQ(scale->tags[0].views, setting.cameras - 2);
  EXPECT_NEAR(scale->metres_per_unit * setting.map_from_world.scale, 1.0, 2e-3);
}

TEST(TagScale, FailuresSayWhatToDo) {
  const Family family = Tag36h11();
  Setting setting;
  setting.cameras = 2;
  const std::vector<PrintedTag> tags = {{*family, 5, kSize, Facing(0.0, 0.0)}};
  const vision::SceneDatabase empty = setting.Film({});
  const vision::SceneDatabase seen = setting.Film(tags);

  EXPECT_THAT(MeasureTagScale(empty, {"tag36h11", kSize}).message(),
              HasSubstr("no tag of the family tag36h11 is seen in any keyframe"));
  EXPECT_THAT(MeasureTagScale(seen, {"tag25h9", kSize}).message(),
              HasSubstr("there are some of tag36h11"));
  EXPECT_THAT(MeasureTagScale(seen, {"tag99", kSize}).message(), HasSubstr("use one of tag36h11"));
  EXPECT_THAT(MeasureTagScale(seen, {"tag36h11", 0.0}).message(), HasSubstr("more than 0 m"));

  vision::SceneDatabase once = seen;
  once.keyframes[1].grey = empty.keyframes[1].grey;
  EXPECT_THAT(MeasureTagScale(once, {"tag36h11", kSize}).message(),
              HasSubstr("tag 5 is seen in one keyframe only"));

  vision::SceneDatabase same = seen;
  same.keyframes[1] = same.keyframes[0];
  EXPECT_FALSE(MeasureTagScale(same, {"tag36h11", kSize}).ok());

  vision::SceneDatabase pruned = seen;
  for (vision::Keyframe& keyframe : pruned.keyframes) {
    keyframe.grey = cv::Mat();
  }
  EXPECT_THAT(MeasureTagScale(pruned, {"tag36h11", kSize}).message(), HasSubstr("no images"));
}

}  // namespace
}  // namespace lararium::train
