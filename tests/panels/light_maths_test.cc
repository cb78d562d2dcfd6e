#include "editor/panels/inspector/light_maths.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace lararium::panels {
namespace {

TEST(PanoramaDirection, IsThatOfProbesAndTurnsBack) {
  EXPECT_LT(glm::distance(PanoramaDirection(0.5, 0.5), glm::vec3(0.0f, 0.0f, -1.0f)), 1e-6f);
  EXPECT_LT(glm::distance(PanoramaDirection(0.75, 0.5), glm::vec3(1.0f, 0.0f, 0.0f)), 1e-6f);
  EXPECT_LT(glm::distance(PanoramaDirection(0.3, 0.0), glm::vec3(0.0f, 1.0f, 0.0f)), 1e-6f);
  for (const Eigen::Vector2d& point : {Eigen::Vector2d(0.1, 0.2), Eigen::Vector2d(0.9, 0.7)}) {
    EXPECT_LT((PanoramaPoint(PanoramaDirection(point.x(), point.y())) - point).norm(), 1e-6);
  }
}

stage::Occluder Wall() {
  stage::Occluder wall;
  wall.mesh.positions = {{-1, 0, 0}, {1, 0, 0}, {1, 2, 0}, {-1, 2, 0}};
  wall.mesh.indices = {0, 1, 2, 0, 2, 3};
  wall.stage_from_mesh.translation = {0.0, 0.0, -3.0};
  return wall;
}

TEST(FindSurface, MeetsTheNearestOccluderWithItsNormalTowardsTheViewer) {
  const Ray ray = {Eigen::Vector3d(0.2, 1.0, 0.0), -Eigen::Vector3d::UnitZ()};
  const std::vector<stage::Occluder> walls = {Wall()};
  const auto front = FindSurface(ray, walls);
  ASSERT_TRUE(front.has_value());
  EXPECT_LT(glm::distance(front->point, glm::vec3(0.2f, 1.0f, -3.0f)), 1e-5f);
  EXPECT_LT(glm::distance(front->normal, glm::vec3(0.0f, 0.0f, 1.0f)), 1e-5f);
  const Ray behind = {Eigen::Vector3d(0.2, 1.0, -9.0), Eigen::Vector3d::UnitZ()};
  EXPECT_LT(glm::distance(FindSurface(behind, walls)->normal, glm::vec3(0.0f, 0.0f, -1.0f)), 1e-5f);
}

TEST(FindSurface, FallsBackToTheFloorAndKnowsTheSky) {
  const Eigen::Vector3d down = Eigen::Vector3d(0.0, -1.0, -1.0).normalized();
  const auto floor = FindSurface({Eigen::Vector3d(0.0, 1.5, 0.0), down}, {});
  ASSERT_TRUE(floor.has_value());
  EXPECT_LT(glm::distance(floor->point, glm::vec3(0.0f, 0.0f, -1.5f)), 1e-5f);
  EXPECT_FALSE(FindSurface({Eigen::Vector3d(0.0, 1.5, 0.0), -down}, {}).has_value());
}

TEST(CompareBrightness, CountsPeopleOnlyWhereTheyHideAll) {
  const cv::Mat plain(4, 8, CV_8UC3, cv::Scalar::all(60));
  cv::Mat composite = plain.clone();
  cv::Mat coverage(4, 8, CV_8UC1, cv::Scalar(0));
  composite(cv::Rect(0, 0, 2, 4)).setTo(cv::Scalar::all(200));
  coverage(cv::Rect(0, 0, 2, 4)).setTo(255);
  coverage.col(2).setTo(128);
  const BrightnessComparison comparison = CompareBrightness(plain, composite, coverage);
  EXPECT_EQ(comparison.real.total, 32);
  EXPECT_EQ(comparison.people.total, 8);
  EXPECT_NEAR(comparison.real.Median(), 60.0 / 256.0, 1.0 / 64.0);
  EXPECT_NEAR(comparison.people.Median(), 200.0 / 256.0, 1.0 / 64.0);
  EXPECT_EQ(CompareBrightness(plain, composite, cv::Mat()).real.total, 0);
  EXPECT_EQ(BrightnessHistogram().Median(), 0.0);
}

TEST(MeanLinear, AveragesLightNotBytes) {
  cv::Mat image(9, 9, CV_8UC3, cv::Scalar(0, 0, 0));
  image(cv::Rect(0, 0, 9, 3)).setTo(cv::Scalar(255, 255, 255));
  const auto mean = MeanLinear(image, {4.0, 4.0}, 4);
  ASSERT_TRUE(mean.has_value());
  EXPECT_NEAR(mean->g, 1.0f / 3.0f, 1e-6f);
  EXPECT_FALSE(MeanLinear(image, {-3.0, 4.0}, 4).has_value());
  EXPECT_NEAR(MeanLinear(image, {0.0, 0.0}, 1)->r, 1.0f, 1e-6f);
}

}  // namespace
}  // namespace lararium::panels
