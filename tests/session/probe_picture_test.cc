#include "editor/session/probe_picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "shared/core/units.h"

namespace lararium::editor {
namespace {
const glm::quat kNoTurn(1.0f, 0.0f, 0.0f, 0.0f);
// A camera that looks along the stage's -Z.
const glm::quat kAhead(0.0f, 1.0f, 0.0f, 0.0f);

// A dark image with one bright texel; the harmonics are uniform light of radiance 1.
ProbePicture OneLight(int column, int row) {
  ProbePicture picture;
  picture.width = 64;
  picture.height = 32;
  picture.radiance.assign(64 * 32, glm::vec3(0.0f));
  picture.radiance[static_cast<size_t>(row) * 64 + column] = glm::vec3(1.0f);
  picture.light.sky[0] = glm::vec3(std::sqrt(4.0f * kPiF));
  return picture;
}

cv::Point Brightest(const cv::Mat& bgr) {
  cv::Point best;
  for (int y = 0; y < bgr.rows; ++y) {
    for (int x = 0; x < bgr.cols; ++x) {
      best = bgr.at<cv::Vec3b>(y, x)[1] > bgr.at<cv::Vec3b>(best)[1] ? cv::Point(x, y) : best;
    }
  }
  return best;
}

TEST(DrawPanorama, ShowsAnUnturnedProbeAsItIs) {
  const cv::Mat shown = DrawPanorama(OneLight(40, 10), {.knee = 1.0f}, 64);
  ASSERT_EQ(shown.size(), cv::Size(64, 32));
  EXPECT_EQ(Brightest(shown), cv::Point(40, 10));
  EXPECT_EQ(shown.at<cv::Vec3b>(10, 40), cv::Vec3b(255, 255, 255));
}

TEST(DrawPanorama, AQuarterTurnMovesTheImageByAQuarter) {
  // A rotation by +90 degrees about +Y maps -Z to -X: a quarter of the width to the left.
  const glm::quat turn = glm::angleAxis(0.5f * kPiF, glm::vec3(0.0f, 1.0f, 0.0f));
  const cv::Mat shown = DrawPanorama(OneLight(40, 10), {.stage_from_probe = turn}, 64);
  EXPECT_EQ(Brightest(shown), cv::Point(24, 10));
}

TEST(MirroredDirection, TheMiddleShowsTheCameraAndTheRimWhatIsBehind) {
  EXPECT_LT(glm::distance(MirroredDirection(kAhead, 0.0f, 0.0f), glm::vec3(0.0f, 0.0f, 1.0f)),
            1e-5f);
  EXPECT_LT(glm::distance(MirroredDirection(kAhead, 1.0f, 0.0f), glm::vec3(0.0f, 0.0f, -1.0f)),
            1e-5f);
  // Where the ball's surface is inclined by 45 degrees, it reflects straight up and to the right.
  const float half = std::sqrt(0.5f);
  EXPECT_LT(glm::distance(MirroredDirection(kAhead, 0.0f, -half), glm::vec3(0.0f, 1.0f, 0.0f)),
            1e-5f);
  EXPECT_LT(glm::distance(MirroredDirection(kAhead, half, 0.0f), glm::vec3(1.0f, 0.0f, 0.0f)),
            1e-5f);
}

TEST(DrawBall, TheMirrorShowsALightWhereItsDirectionSays) {
  const ProbePicture picture = OneLight(40, 10);  // The light is to the right, above, and ahead.
  const cv::Mat ball = DrawBall(picture, {}, kAhead, BallSurface::kMirror, 1.0f, 200);
  const cv::Point at = Brightest(ball);
  const glm::vec3 seen =
      MirroredDirection(kAhead, (at.x + 0.5f) / 100.0f - 1.0f, (at.y + 0.5f) / 100.0f - 1.0f);
  const float azimuth = 2.0f * kPiF * (40.5f / 64.0f - 0.5f);
  const float elevation = kPiF * (0.5f - 10.5f / 32.0f);
  const glm::vec3 light(std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                        -std::cos(elevation) * std::cos(azimuth));
  EXPECT_GT(glm::dot(seen, light), std::cos(0.1f));
}

TEST(DrawBall, GreyInEvenLightIsItsAlbedoAllOver) {
  const cv::Mat ball = DrawBall(OneLight(0, 0), {.knee = 1.0f}, kNoTurn, BallSurface::kGrey,
                                0.2140411f, 32);  // The value 127.5 in sRGB.
  for (const cv::Point at : {cv::Point(16, 16), cv::Point(2, 16), cv::Point(20, 28)}) {
    EXPECT_NEAR(ball.at<cv::Vec3b>(at)[1], 128, 1);
  }
}

TEST(LoadProbePicture, NamesAFileThatIsNotThere) {
  const auto picture = LoadProbePicture("/nowhere/probe.exr");
  ASSERT_FALSE(picture.ok());
  EXPECT_NE(picture.message().find("/nowhere/probe.exr"), std::string::npos);
}

}  // namespace
}  // namespace lararium::editor
