#include "editor/bake/mirror_ball.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <optional>

#include "shared/core/random.h"
#include "shared/core/units.h"
#include "tests/bake/probe_images.h"

namespace lararium::bake {
namespace {

// Smooth and not symmetric, from 0.2 to 2.
glm::vec3 Around(const glm::vec3& d) {
  return {1.1f + 0.9f * std::sin(3.0f * d.x + d.y), 1.1f + 0.9f * std::sin(2.0f * d.y - d.z),
          1.1f + 0.9f * std::sin(4.0f * d.z + 2.0f * d.x)};
}

// Ray-traces a photograph of the ball: it has radius 1 about the origin, and the camera looks
// along -Z from (0, 0, distance). Beside the ball, its background is visible.
cv::Mat Photograph(const BallView& view, int width, int height) {
  cv::Mat image(height, width, CV_32FC3);
  constexpr int kGrid = 2;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      glm::dvec3 sum(0.0);
      for (int i = 0; i < kGrid * kGrid; ++i) {
        const double px =
            (x + (i % kGrid + 0.5) / kGrid - 0.5 - view.circle.x) / view.circle.radius;
        const double py =
            -(y + (i / kGrid + 0.5) / kGrid - 0.5 - view.circle.y) / view.circle.radius;
        // In the plane at distance 1, the outline is at tan(asin(1 / D)).
        const bool far = view.distance == 0.0;
        const double plane = far ? 0.0 : 1.0 / std::sqrt(view.distance * view.distance - 1.0);
        const glm::dvec3 origin = far ? glm::dvec3(px, py, 10.0) : glm::dvec3(0, 0, view.distance);
        const glm::dvec3 ray =
            far ? glm::dvec3(0, 0, -1) : glm::normalize(glm::dvec3(px * plane, py * plane, -1.0));
        const double b = glm::dot(origin, ray);
        const double root = b * b - glm::dot(origin, origin) + 1.0;
        glm::dvec3 seen = ray;
        if (root > 0.0) {
          const glm::dvec3 normal = origin + ray * (-b - std::sqrt(root));
          seen = glm::reflect(ray, normal);
        }
        const glm::dvec3 colour = root > 0.0
                                      ? glm::dvec3(view.reflectance) * glm::dvec3(Around(seen))
                                      : glm::dvec3(0.1, 0.1, 0.1);
        sum += colour / double{kGrid * kGrid};
      }
      image.at<cv::Vec3f>(y, x) = cv::Vec3f(static_cast<float>(sum.r), static_cast<float>(sum.g),
                                            static_cast<float>(sum.b));
    }
  }
  return image;
}

cv::Mat Encoded(const cv::Mat& linear) {
  cv::Mat bytes(linear.size(), CV_8UC3);
  for (int y = 0; y < linear.rows; ++y) {
    for (int x = 0; x < linear.cols; ++x) {
      for (int c = 0; c < 3; ++c) {
        bytes.at<cv::Vec3b>(y, x)[c] = cv::saturate_cast<uchar>(
            255.0 * std::pow(0.45 * linear.at<cv::Vec3f>(y, x)[2 - c], 1.0 / 2.2));
      }
    }
  }
  return bytes;
}

class MirrorBall : public ::testing::TestWithParam<double> {};

TEST_P(MirrorBall, UnwrapsToWhatIsAroundIt) {
  const BallView view = {{161.3, 158.6, 140.0, 0.0}, GetParam(), {0.6f, 0.65f, 0.7f}};
  const auto probe = UnwrapBall(Photograph(view, 320, 320), view, 128);
  ASSERT_TRUE(probe.ok()) << probe.message();
  ASSERT_EQ(probe->height, 64);
  double worst = 0.0;
  double squares = 0.0;
  int count = 0;
  for (int row = 0; row < 64; ++row) {
    for (int column = 0; column < 128; ++column) {
      const glm::vec3 d = test::ProbeDirection(column + 0.5, row + 0.5, 128, 64);
      if (std::acos(-d.z) < 42.0 * kPi / 180.0) {
        continue;  // Hidden by the ball, or at its rim.
      }
      const float off = glm::distance(probe->pixels[row * 128 + column], Around(d));
      worst = std::max(worst, double{off});
      squares += off * off;
      ++count;
    }
  }
  EXPECT_LT(std::sqrt(squares / count), 0.02);
  EXPECT_LT(worst, 0.12);
}

TEST_P(MirrorBall, IsFoundInItsPhotograph) {
  for (const BallCircle& circle :
       {BallCircle{161.3, 118.6, 90.0, 0.0}, BallCircle{240.0, 150.5, 61.5, 0.0}}) {
    const BallView view = {circle, GetParam(), glm::vec3(0.9f)};
    const auto found = FindBall(Encoded(Photograph(view, 400, 260)));
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->x, circle.x, 0.7);
    EXPECT_NEAR(found->y, circle.y, 0.7);
    EXPECT_NEAR(found->radius, circle.radius, 0.8);
    EXPECT_LT(found->residual_px, 1.0);
  }
}

INSTANTIATE_TEST_SUITE_P(FarAndNear, MirrorBall, ::testing::Values(0.0, 12.0, 3.0));

TEST(MirrorBallDistance, MattersNearTheCamera) {
  // A ball at a distance of three radii is unwrapped wrongly if it is assumed to be far away.
  BallView view = {{160, 160, 140.0, 0.0}, 3.0, glm::vec3(1.0f)};
  const cv::Mat photograph = Photograph(view, 320, 320);
  view.distance = 0.0;
  const auto probe = UnwrapBall(photograph, view, 64);
  ASSERT_TRUE(probe.ok());
  const glm::vec3 d = test::ProbeDirection(16.5, 16.5, 64, 32);
  EXPECT_GT(glm::distance(probe->pixels[16 * 64 + 16], Around(d)), 0.1f);
}

TEST(FindBall, FindsNoneWhereThereIsNone) {
  cv::Mat noise(200, 300, CV_8UC3);
  cv::RNG rng(5);
  rng.fill(noise, cv::RNG::UNIFORM, 0, 255);
  EXPECT_FALSE(FindBall(noise));
  EXPECT_FALSE(FindBall(cv::Mat(200, 300, CV_8UC3, cv::Scalar(90, 90, 90))));
  EXPECT_FALSE(FindBall(cv::Mat()));
}

TEST(UnwrapBall, RefusesWhatCannotBe) {
  const cv::Mat image(100, 100, CV_32FC3, cv::Scalar(1, 1, 1));
  const BallCircle circle{50, 50, 40, 0};
  EXPECT_TRUE(UnwrapBall(image, {circle, 0.0, glm::vec3(1.0f)}, 32).ok());
  EXPECT_FALSE(UnwrapBall(image, {{50, 50, 70, 0}, 0.0, glm::vec3(1.0f)}, 32).ok());
  EXPECT_FALSE(UnwrapBall(image, {{50, NAN, 40, 0}, 0.0, glm::vec3(1.0f)}, 32).ok());
  EXPECT_FALSE(UnwrapBall(image, {circle, 0.5, glm::vec3(1.0f)}, 32).ok());
  EXPECT_FALSE(UnwrapBall(image, {circle, NAN, glm::vec3(1.0f)}, 32).ok());
  EXPECT_FALSE(UnwrapBall(image, {circle, 0.0, glm::vec3(0.0f)}, 32).ok());
  EXPECT_FALSE(UnwrapBall(image, {circle, 0.0, glm::vec3(1.0f)}, 33).ok());
  EXPECT_FALSE(UnwrapBall(cv::Mat(9, 9, CV_8UC3), {circle, 0.0, glm::vec3(1.0f)}, 32).ok());
}

}  // namespace
}  // namespace lararium::bake
