#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "shared/render/clip_space.h"
#include "shared/render/overlay.h"
#include "shared/render/renderer.h"
#include "tests/render/gl_fixture.h"

namespace lararium::render {
namespace {

class OverlayTest : public GlTest {
 protected:
  void SetUp() override {
    GlTest::SetUp();
    auto overlay = Overlay::Create();
    ASSERT_TRUE(overlay.ok()) << overlay.message();
    overlay_ = std::move(overlay).value();
    target_.emplace(RenderTarget::Create(160, 120, RenderTarget::Depth::kForOverlay).value());
    view_.display = {.width = 160, .height = 120, .fx = 150, .fy = 150, .cx = 79.5, .cy = 59.5};
    view_.camera_from_stage =
        LookAt(Eigen::Vector3d(0.0, 0.0, 3.0), Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitY());
    view_.clear = glm::vec3(0.0f);
  }
  cv::Mat ReadTarget() const { return Read(*target_); }
  cv::Point2d Pixel(const glm::vec3& point) const {
    const Eigen::Vector2d pixel = *view_.display.Project(
        view_.camera_from_stage * Eigen::Vector3d(point.x, point.y, point.z));
    return {pixel.x(), pixel.y()};
  }

  void DrawPoint(const OverlayPoint& point,
                 float size_px,
                 OverlayDepth depth = OverlayDepth::kTest) {
    ASSERT_TRUE(overlay_->DrawPoints(overlay_->AddPoints({&point, 1}), 1, size_px, depth).ok());
  }

  std::unique_ptr<Overlay> overlay_;
  std::optional<RenderTarget> target_;
  OverlayView view_;
};

cv::Point2d Centroid(const cv::Mat& bgr) {
  cv::Mat grey;
  cv::cvtColor(bgr, grey, cv::COLOR_BGR2GRAY);
  const cv::Moments moments = cv::moments(grey);
  return {moments.m10 / moments.m00, moments.m01 / moments.m00};
}

TEST_F(OverlayTest, PointsAreRoundAndLieWhereTheyProject) {
  const OverlayPoint point = {{0.31f, 0.22f, 0.4f}, {255, 255, 255, 255}};
  overlay_->Begin(view_, *target_);
  DrawPoint(point, 8.0f);
  overlay_->End();
  const cv::Mat picture = ReadTarget();
  const cv::Point2d centroid = Centroid(picture);
  EXPECT_NEAR(centroid.x, Pixel(point.position).x, 0.1);
  EXPECT_NEAR(centroid.y, Pixel(point.position).y, 0.1);
  EXPECT_NEAR(cv::sum(picture)[0] / 255.0, CV_PI * 16.0, 2.5);
}

TEST_F(OverlayTest, KeptPointsAreDrawnAsOthersAreAndAsManyAsAskedFor) {
  const OverlayPoint points[] = {{{0.31f, 0.22f, 0.4f}, {255, 255, 255, 255}},
                                 {{-0.3f, 0.1f, 0.0f}, {255, 255, 255, 255}}};
  const PointsHandle kept = overlay_->AddPoints(points);
  overlay_->Begin(view_, *target_);
  ASSERT_TRUE(overlay_->DrawPoints(kept, 1, 8.0f).ok());
  overlay_->End();
  const cv::Mat picture = ReadTarget();
  EXPECT_NEAR(Centroid(picture).x, Pixel(points[0].position).x, 0.1);
  EXPECT_NEAR(cv::sum(picture)[0] / 255.0, CV_PI * 16.0, 2.5);
  overlay_->RemovePoints(kept);
  overlay_->Begin(view_, *target_);
  EXPECT_FALSE(overlay_->DrawPoints(kept, 1, 8.0f).ok());
  overlay_->End();
}

TEST_F(OverlayTest, LinesHaveTheirWidthAndColour) {
  const OverlayLine line = {{-0.5f, 0.1f, 0.0f}, {0.5f, 0.1f, 0.0f}, {255, 128, 0, 255}};
  overlay_->Begin(view_, *target_);
  overlay_->DrawLines({&line, 1}, 4.0f);
  overlay_->End();
  const cv::Mat picture = ReadTarget();
  const cv::Scalar column = cv::sum(picture.col(80));
  EXPECT_NEAR(column[2] / 255.0, 4.0, 0.1);
  EXPECT_NEAR(column[1] / 128.0, 4.0, 0.1);
  EXPECT_EQ(column[0], 0.0);
  EXPECT_NEAR(Centroid(picture).y, Pixel(line.from).y, 0.1);
}

TEST_F(OverlayTest, LinesThatComeFromBehindTheViewerAreCut) {
  const std::array<OverlayLine, 2> lines = {
      OverlayLine{{0.0f, -0.3f, 0.0f}, {0.0f, -0.3f, 9.0f}, {255, 255, 255, 255}},
      OverlayLine{{0.0f, 0.3f, 5.0f}, {0.0f, 0.3f, 9.0f}, {255, 255, 255, 255}}};
  overlay_->Begin(view_, *target_);
  overlay_->DrawLines(lines, 2.0f);
  overlay_->End();
  const cv::Mat picture = ReadTarget();
  EXPECT_GT(cv::sum(picture.rowRange(76, 120))[0], 255.0 * 60);  // downwards to the border
  EXPECT_EQ(cv::sum(picture.rowRange(0, 70))[0], 0.0);
}

TEST_F(OverlayTest, MeshesAreTranslucentAndHiddenByNearerThings) {
  const MeshHandle square =
      overlay_->AddMesh({.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}},
                         .normals = {},
                         .indices = {0, 1, 2, 0, 2, 3}});
  const OverlayPoint near = {{0.0f, 0.0f, 1.0f}, {255, 0, 0, 255}};
  view_.clear = glm::vec3(0.0f, 0.0f, 1.0f);
  overlay_->Begin(view_, *target_);
  DrawPoint(near, 10.0f);
  ASSERT_TRUE(overlay_->DrawMesh(square, glm::mat4(1.0f), {0, 255, 0, 128}).ok());
  overlay_->End();
  const cv::Mat picture = ReadTarget();
  EXPECT_EQ(picture.at<cv::Vec3b>(60, 80), cv::Vec3b(0, 0, 255));
  const cv::Vec3b ghost = picture.at<cv::Vec3b>(60, 110);
  EXPECT_NEAR(ghost[0], 127, 2);  // the blue behind it
  EXPECT_NEAR(ghost[1], 126, 6);  // green of the mesh, which faces the lamp
  EXPECT_EQ(picture.at<cv::Vec3b>(5, 5), cv::Vec3b(255, 0, 0));
  overlay_->RemoveMesh(square);
  overlay_->Begin(view_, *target_);
  EXPECT_FALSE(overlay_->DrawMesh(square, glm::mat4(1.0f), {0, 255, 0, 128}).ok());
  overlay_->End();
}

TEST_F(OverlayTest, DrawsOverThePictureThatIsThere) {
  RenderScene scene;
  scene.background = cv::Mat(120, 160, CV_8UC3, cv::Scalar(10, 20, 30));
  scene.camera = scene.display = view_.display;
  const auto renderer = Renderer::Create();
  ASSERT_TRUE(renderer.ok() && (*renderer)->Draw(scene, *target_).ok());
  view_.clear.reset();
  const OverlayPoint point = {{0.0f, 0.0f, 0.0f}, {255, 255, 255, 255}};
  overlay_->Begin(view_, *target_);
  DrawPoint(point, 6.0f, OverlayDepth::kOnTop);
  overlay_->End();
  const cv::Mat picture = ReadTarget();
  EXPECT_EQ(picture.at<cv::Vec3b>(60, 80), cv::Vec3b(255, 255, 255));
  EXPECT_EQ(picture.at<cv::Vec3b>(10, 10), cv::Vec3b(10, 20, 30));
}

}  // namespace
}  // namespace lararium::render
