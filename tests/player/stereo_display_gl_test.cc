#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <opencv2/imgproc.hpp>

#include "player/app/stereo_display.h"
#include "tests/geometry/lens_oracle.h"
#include "tests/render/gl_fixture.h"
#include "tests/render/test_people.h"

namespace lararium::player {
namespace {

constexpr geometry::CameraModel kCamera{320, 240, 300.0, 300.0, 159.5, 119.5};
constexpr double kBallDistance = 2.0;  // metres from the camera
constexpr double kEyeDistance = 0.064;

Headset MakeHeadset(bool stereo, double picture_distance) {
  Headset headset;
  headset.stereo = stereo;
  headset.picture_distance = picture_distance;
  headset.head_from_eye[kLeft].translation.x() = -0.5 * kEyeDistance;
  headset.head_from_eye[kRight].translation.x() = 0.5 * kEyeDistance;
  geometry::LensModel lens{400, 360, 340.0, 340.0, 210.0, 170.0};
  lens.radial.fill({0.15, 0.04, 0.0});
  headset.panel = Panel{{lens, lens.Mirrored()}};
  return headset;
}

// A small bright ball in front of a camera whose image has a dark vertical stripe in the middle.
class StereoDisplayTest : public render::GlTest {
 protected:
  void SetUp() override {
    GlTest::SetUp();
    show::ShowContent content;
    content.cast = {{"ball", std::make_shared<const human::Human>(
                                 render::MakeHuman(render::Sphere(glm::vec3(1.0f)), 1))}};
    content.places.push_back({});
    auto renderer = show::ShowRenderer::Create(content);
    ASSERT_TRUE(renderer.ok()) << renderer.message();
    renderer_ = std::move(renderer).value();
    staged_.people.actors.resize(1);
    staged_.people.actors[0].figure = content.cast[0].human;
    staged_.people.actors[0].skin_count = 1;
    staged_.people.actors[0].stage_from_actor =
        glm::mat4(glm::vec4(0.06f, 0.0f, 0.0f, 0.0f), glm::vec4(0.0f, 0.06f, 0.0f, 0.0f),
                  glm::vec4(0.0f, 0.0f, 0.06f, 0.0f), glm::vec4(0.0f, 0.0f, -2.0f, 1.0f));
    staged_.people.skin = {glm::mat4(1.0f)};
    staged_.camera.camera_from_stage =
        geometry::Rigid3{{0.0, 1.0, 0.0, 0.0}, Eigen::Vector3d::Zero()};
    staged_.light.surfaces.sky[0] = staged_.people.actors[0].light.sky[0] = glm::vec3(9.0f);
    staged_.tracked.camera = kCamera;
    staged_.tracked.frame.bgr = cv::Mat(240, 320, CV_8UC3, cv::Scalar(120, 0, 0));
    staged_.tracked.frame.bgr.colRange(156, 164).setTo(cv::Scalar(0, 0, 0));
  }

  // Returns the pictures for both eyes.
  std::array<cv::Mat, 2> Show(const Headset& headset) {
    auto display = StereoDisplay::Create(headset);
    EXPECT_TRUE(display.ok()) << display.message();
    renderer_->SetPart(headset.SeenPart());
    const render::RenderTarget picture = MakeTarget(kCamera.width, kCamera.height);
    const Status drawn = display->Draw(staged_, *renderer_, picture);
    EXPECT_TRUE(drawn.ok()) << drawn.message();
    const cv::Mat panel = Read(display->panel());
    return {panel.colRange(0, 400), panel.colRange(400, 800)};
  }

  std::unique_ptr<show::ShowRenderer> renderer_;
  show::StagedFrame staged_;
};

// The column of the centre of bright pixels in green, which only the ball has.
double BallColumn(const cv::Mat& part) {
  cv::Mat green;
  cv::extractChannel(part, green, 1);
  cv::threshold(green, green, 60.0, 255.0, cv::THRESH_BINARY);
  const cv::Moments moments = cv::moments(green, true);
  EXPECT_GT(moments.m00, 30.0);
  return moments.m10 / moments.m00;
}

// The column of the middle of the stripe in a row far above the ball.
double StripeColumn(const cv::Mat& part, int row) {
  double sum = 0.0;
  double weight = 0.0;
  for (int x = 120; x < 280; ++x) {
    const double dark = 120.0 - part.at<cv::Vec3b>(row, x)[0];
    sum += dark * x;
    weight += dark;
  }
  return sum / weight;
}

// The column in which an eye sees a point straight in front of the camera at a distance.
double ColumnOfStraightAhead(const Headset& headset, Eye eye, double distance) {
  const Eigen::Vector3d in_eye =
      headset.head_from_eye[eye].Inverse() * Eigen::Vector3d(0.0, 0.0, distance);
  return test::PixelThrough(headset.panel->lenses[eye], in_eye.hnormalized()).x();
}

TEST_F(StereoDisplayTest, OnePictureForBothEyesSeemsAsFarAsItIsSaidToBe) {
  for (const double distance : {1.0, 3.0, 1e6}) {
    const Headset headset = MakeHeadset(false, distance);
    const std::array<cv::Mat, 2> eyes = Show(headset);
    for (const Eye eye : {kLeft, kRight}) {
      const double expected = ColumnOfStraightAhead(headset, eye, distance);
      EXPECT_NEAR(StripeColumn(eyes[eye], 170 - 60), expected, 0.7) << distance;
      EXPECT_NEAR(BallColumn(eyes[eye]), expected, 0.5) << distance;
    }
  }
}

TEST_F(StereoDisplayTest, InStereoPeopleAreSeenWhereTheyAreFromEachEye) {
  const Headset headset = MakeHeadset(true, 6.0);
  const std::array<cv::Mat, 2> eyes = Show(headset);
  for (const Eye eye : {kLeft, kRight}) {
    EXPECT_NEAR(BallColumn(eyes[eye]), ColumnOfStraightAhead(headset, eye, kBallDistance), 0.5);
    EXPECT_NEAR(StripeColumn(eyes[eye], 170 - 60), ColumnOfStraightAhead(headset, eye, 6.0), 0.7);
  }
  // The ball is nearer than the picture, so its disparity is crossed and larger than any error.
  EXPECT_GT(BallColumn(eyes[kLeft]) - StripeColumn(eyes[kLeft], 110), 1.5);
  EXPECT_LT(BallColumn(eyes[kRight]) - StripeColumn(eyes[kRight], 110), -1.5);
}

TEST_F(StereoDisplayTest, InStereoPeopleAsFarAsThePictureStayWhereTheCameraSeesThem) {
  const std::array<cv::Mat, 2> one = Show(MakeHeadset(false, kBallDistance));
  const std::array<cv::Mat, 2> two = Show(MakeHeadset(true, kBallDistance));
  for (const Eye eye : {kLeft, kRight}) {
    EXPECT_NEAR(BallColumn(one[eye]), BallColumn(two[eye]), 0.1);
  }
}

}  // namespace
}  // namespace lararium::player
