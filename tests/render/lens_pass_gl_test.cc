#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "shared/render/passes/lens_pass.h"
#include "tests/geometry/lens_oracle.h"
#include "tests/render/gl_fixture.h"

namespace lararium::render {
namespace {

using geometry::LensModel;

constexpr int kPictureSize = 400;
constexpr double kPictureFocal = 200.0;

// A picture whose middle is straight ahead. It covers 45 degrees to each side.
Eigen::Matrix3d PictureFromEye() {
  Eigen::Matrix3d picture_from_eye = Eigen::Matrix3d::Identity();
  picture_from_eye(0, 0) = picture_from_eye(1, 1) = kPictureFocal;
  picture_from_eye(0, 2) = picture_from_eye(1, 2) = 0.5 * (kPictureSize - 1);
  return picture_from_eye;
}

LensModel Left() {
  LensModel lens{300, 320, 230.0, 230.0, 162.0, 155.0};
  lens.radial.fill({0.25, 0.08, 0.02});
  return lens;
}

class LensPassTest : public GlTest {
 protected:
  void SetUp() override {
    GlTest::SetUp();
    auto pass = LensPass::Create();
    ASSERT_TRUE(pass.ok()) << pass.message();
    pass_.emplace(std::move(pass).value());
  }

  static RenderTarget TargetOf(const cv::Mat& bgr) {
    RenderTarget target = MakeTarget(bgr.cols, bgr.rows);
    cv::Mat rgba;
    cv::cvtColor(bgr, rgba, cv::COLOR_BGR2RGBA);
    glBindTexture(GL_TEXTURE_2D, target.texture());
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, bgr.cols, bgr.rows, GL_RGBA, GL_UNSIGNED_BYTE,
                    rgba.data);
    return target;
  }

  // Both eyes of a panel that shows one picture.
  cv::Mat Panel(const cv::Mat& picture, const LensModel& left, const LensModel& right) {
    const RenderTarget drawn = TargetOf(picture);
    const RenderTarget panel = MakeTarget(left.width + right.width, left.height);
    pass_->Draw(drawn, {left, PictureFromEye()}, 0, panel);
    pass_->Draw(drawn, {right, PictureFromEye()}, left.width, panel);
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    return Read(panel);
  }

  std::optional<LensPass> pass_;
};

cv::Mat Black() { return cv::Mat::zeros(kPictureSize, kPictureSize, CV_8UC3); }

// The centre of bright pixels in a part of the panel, relative to that part.
Eigen::Vector2d MiddleOf(const cv::Mat& part, int channel) {
  cv::Mat values;
  cv::extractChannel(part, values, channel);
  const cv::Moments moments = cv::moments(values);
  return {moments.m10 / moments.m00, moments.m01 / moments.m00};
}

TEST_F(LensPassTest, PutsStraightAheadAtTheMiddleOfEachLens) {
  cv::Mat picture = Black();
  picture(cv::Rect(198, 198, 4, 4)).setTo(cv::Scalar::all(255));
  const LensModel left = Left();
  const LensModel right = left.Mirrored();
  const cv::Mat panel = Panel(picture, left, right);
  const Eigen::Vector2d a = MiddleOf(panel.colRange(0, 300), 1);
  EXPECT_NEAR(a.x(), left.cx, 0.05);
  EXPECT_NEAR(a.y(), left.cy, 0.05);
  const Eigen::Vector2d b = MiddleOf(panel.colRange(300, 600), 1);
  EXPECT_NEAR(b.x(), right.cx, 0.05);
  EXPECT_NEAR(b.y(), right.cy, 0.05);
}

TEST_F(LensPassTest, AStraightLineIsSeenStraightThroughTheLens) {
  cv::Mat picture = Black();
  picture.row(80).setTo(cv::Scalar::all(255));  // well above the middle
  picture.row(81).setTo(cv::Scalar::all(255));
  const LensModel lens = Left();
  const cv::Mat panel = Panel(picture, lens, lens);
  const double y = (80.5 - 199.5) / kPictureFocal;
  double highest = 1e9;
  double lowest = -1e9;
  for (double x = -0.6; x <= 0.6; x += 0.05) {
    const Eigen::Vector2d pixel = test::PixelThrough(lens, {x, y});
    highest = std::min(highest, pixel.y());
    lowest = std::max(lowest, pixel.y());
    // The brightest pixel of its column lies there.
    const cv::Mat column = panel.col(static_cast<int>(std::lround(pixel.x()))).rowRange(0, 150);
    const Eigen::Vector2d bright = MiddleOf(column, 1);
    EXPECT_NEAR(bright.y(), pixel.y(), 0.5) << x;
  }
  EXPECT_GT(lowest - highest, 4.0);  // the line is bent on the panel
}

TEST_F(LensPassTest, ColoursThatTheLensPartsMeetBehindIt) {
  cv::Mat picture = Black();
  picture(cv::Rect(318, 198, 4, 4)).setTo(cv::Scalar::all(255));
  LensModel lens = Left();
  lens.radial[LensModel::kRed] = {0.22, 0.08, 0.02};
  lens.radial[LensModel::kBlue] = {0.30, 0.08, 0.02};
  const cv::Mat panel = Panel(picture, lens, lens).colRange(0, 300);
  const double x = (319.5 - 199.5) / kPictureFocal;
  const Eigen::Vector2d red = MiddleOf(panel, 2);
  const Eigen::Vector2d blue = MiddleOf(panel, 0);
  EXPECT_NEAR(red.x(), test::PixelThrough(lens, {x, 0.0}, LensModel::kRed).x(), 0.1);
  EXPECT_NEAR(blue.x(), test::PixelThrough(lens, {x, 0.0}, LensModel::kBlue).x(), 0.1);
  EXPECT_GT(red.x() - blue.x(), 1.0);
}

TEST_F(LensPassTest, IsBlackWhereThePictureEnds) {
  const cv::Mat white(kPictureSize, kPictureSize, CV_8UC3, cv::Scalar::all(255));
  LensModel lens = Left();
  lens.fx = lens.fy = 100.0;  // the lens sees more than 45 degrees
  lens.radial.fill({});
  const cv::Mat panel = Panel(white, lens, lens).colRange(0, 300);
  EXPECT_EQ(panel.at<cv::Vec3b>(155, 162), cv::Vec3b(255, 255, 255));
  EXPECT_EQ(panel.at<cv::Vec3b>(155, 162 - 98), cv::Vec3b(255, 255, 255));
  EXPECT_EQ(panel.at<cv::Vec3b>(155, 162 - 102), cv::Vec3b(0, 0, 0));
  EXPECT_EQ(panel.at<cv::Vec3b>(155 + 102, 162), cv::Vec3b(0, 0, 0));
}

TEST_F(LensPassTest, LeavesTheOtherEyesPartAlone) {
  const cv::Mat white(kPictureSize, kPictureSize, CV_8UC3, cv::Scalar::all(255));
  const RenderTarget drawn = TargetOf(white);
  const RenderTarget panel = TargetOf(cv::Mat(320, 600, CV_8UC3, cv::Scalar(1, 2, 3)));
  pass_->Draw(drawn, {Left(), PictureFromEye()}, 300, panel);
  const cv::Mat read = Read(panel);
  EXPECT_EQ(read.at<cv::Vec3b>(100, 299), cv::Vec3b(1, 2, 3));
  EXPECT_EQ(read.at<cv::Vec3b>(155, 300 + 162), cv::Vec3b(255, 255, 255));
}

}  // namespace
}  // namespace lararium::render
