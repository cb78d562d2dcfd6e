#include "shared/render/clip_space.h"

#include <gtest/gtest.h>

#include "shared/core/random.h"
#include "shared/geometry/glm_convert.h"

namespace lararium::render {
namespace {

const geometry::CameraModel kDisplay = {
    .width = 640, .height = 360, .fx = 512.0, .fy = 498.0, .cx = 301.3, .cy = 188.9};

TEST(ClipSpace, PutsPointsOnThePixelsOfTheCameraModel) {
  const glm::mat4 clip_from_camera = ClipFromCamera(kDisplay, 0.1f, 50.0f);
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d point{random.Uniform(-3, 3), random.Uniform(-2, 2),
                                random.Uniform(0.2, 40)};
    const Eigen::Vector2d pixel = *kDisplay.Project(point);
    const glm::vec4 clip = clip_from_camera * glm::vec4(geometry::ToGlm(point), 1.0f);
    // OpenGL's window coordinates: sample centres at halves, y up.
    const double x = (clip.x / clip.w + 1.0) * 0.5 * kDisplay.width;
    const double y = (clip.y / clip.w + 1.0) * 0.5 * kDisplay.height;
    EXPECT_NEAR(x - 0.5, pixel.x(), 2e-4 * (1.0 + std::abs(pixel.x()))) << "seed 3";
    EXPECT_NEAR(kDisplay.height - y - 0.5, pixel.y(), 2e-4 * (1.0 + std::abs(pixel.y())));
  }
}

TEST(ClipSpace, NearAndFarAreTheEndsOfDepth) {
  const glm::mat4 clip_from_camera = ClipFromCamera(kDisplay, 0.1f, 50.0f);
  const glm::vec4 near = clip_from_camera * glm::vec4(0.3f, -0.2f, 0.1f, 1.0f);
  const glm::vec4 far = clip_from_camera * glm::vec4(0.3f, -0.2f, 50.0f, 1.0f);
  EXPECT_NEAR(near.z / near.w, -1.0f, 1e-5f);
  EXPECT_NEAR(far.z / far.w, 1.0f, 1e-5f);
}

TEST(LookAt, PutsTheTargetInFrontAndUpAbove) {
  const Eigen::Vector3d eye(1.0, 2.0, 3.0);
  const Eigen::Vector3d target(0.5, 1.0, -2.0);
  const geometry::Rigid3 camera_from_stage = LookAt(eye, target, Eigen::Vector3d::UnitY());
  EXPECT_LT((camera_from_stage.Center() - eye).norm(), 1e-12);
  const Eigen::Vector3d seen = camera_from_stage * target;
  EXPECT_NEAR(seen.x(), 0.0, 1e-12);
  EXPECT_NEAR(seen.y(), 0.0, 1e-12);
  EXPECT_NEAR(seen.z(), (target - eye).norm(), 1e-12);
  EXPECT_LT((camera_from_stage * (target + Eigen::Vector3d::UnitY())).y(), 0.0);
}

TEST(LookAt, LooksStraightDownToo) {
  const Eigen::Vector3d eye(0.0, 5.0, 0.0);
  const geometry::Rigid3 camera_from_stage =
      LookAt(eye, Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitY());
  EXPECT_LT((camera_from_stage * Eigen::Vector3d::Zero() - Eigen::Vector3d(0, 0, 5)).norm(), 1e-12);
}

}  // namespace
}  // namespace lararium::render
