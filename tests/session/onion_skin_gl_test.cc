#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "editor/session/onion_skin.h"
#include "shared/show/show_renderer.h"
#include "tests/golden/compare_images.h"
#include "tests/render/gl_fixture.h"
#include "tests/render/test_people.h"

namespace lararium::editor {
namespace {

constexpr geometry::CameraModel kCamera{160, 120, 150.0, 150.0, 79.5, 59.5};

// A ball 5 m in front of the camera that moves 2 m to the right after a second.
class OnionSkinTest : public render::GlTest {
 protected:
  void Create() {
    show::ShowContent content;
    content.cast = {{"ball", std::make_shared<const human::Human>(
                                 render::MakeHuman(render::Sphere(glm::vec3(0.5f)), 1))}};
    stage::Place place;
    place.probes.emplace_back().light.sky[0] =
        glm::vec3(1.6f * std::sqrt(std::numbers::pi_v<float>));
    content.places = {{place, nullptr}};
    content.drama_file = "drama.lua";
    content.drama = R"(
      function main()
        actor("ball"):place{x = -1, y = 0, z = -5}
        wait(1)
        actor("ball"):place{x = 1, y = 0, z = -5}
      end
    )";
    drama::DramaOptions options;
    options.past = drama::Past::kRepeated;
    show_ = show::Show::Create(std::move(content), options, *log_).value();
    renderer_ = show::ShowRenderer::Create(show_->content()).value();
    target_.emplace(MakeTarget(kCamera.width, kCamera.height));
  }

  cv::Mat Draw(double time) {
    vision::TrackedFrame tracked;
    tracked.camera = kCamera;
    tracked.frame.bgr = cv::Mat(kCamera.height, kCamera.width, CV_8UC3, cv::Scalar(60, 90, 120));
    tracked.camera_from_map = geometry::Rigid3{{0.0, 1.0, 0.0, 0.0}, Eigen::Vector3d::Zero()};
    tracked.state = vision::TrackState::kTracking;
    show_->StageFrame(tracked, time, now_);
    EXPECT_TRUE(renderer_->Draw(now_, *target_).ok());
    renderer_->ReadCoverage(coverage_);
    return Read(*target_).clone();
  }

  std::shared_ptr<Log> log_ = MakeSilentLog();
  std::unique_ptr<show::Show> show_;
  std::unique_ptr<show::ShowRenderer> renderer_;
  std::optional<render::RenderTarget> target_;
  show::StagedFrame now_;
  cv::Mat coverage_;
};

TEST_F(OnionSkinTest, ChangesThePictureWherePeopleAreThenAndNowhereElseAndNoPictureAfterIt) {
  Create();
  const cv::Mat then = Draw(1.5);
  const cv::Mat then_covered = coverage_.clone();
  const cv::Mat before = Draw(0.5);
  ASSERT_TRUE(show_->drama().errors().empty()) << show_->drama().errors().front().message;
  const cv::Mat covered = coverage_.clone();
  ASSERT_GT(cv::countNonZero(then_covered), 500);

  show::StagedFrame other;
  ASSERT_TRUE(show_->StageAtTime(1.5, now_, other).ok());
  RemoveUnmoved(now_, other);
  ASSERT_EQ(other.people.actors.size(), 1u);
  render::SceneMark mark;
  mark.colour = {0.1f, 0.4f, 0.9f};
  mark.share = 0.7f;
  ASSERT_TRUE(renderer_->DrawOverlays(other, mark, *target_).ok());
  const cv::Mat overlay = Read(*target_).clone();
  cv::Mat ghost_covered;
  renderer_->ReadCoverage(ghost_covered);
  cv::Mat onion = before.clone();
  BlendOverlay(overlay, ghost_covered, covered, 0.6f, onion);

  for (int y = 0; y < onion.rows; ++y) {
    for (int x = 0; x < onion.cols; ++x) {
      const bool differs = onion.at<cv::Vec3b>(y, x) != before.at<cv::Vec3b>(y, x);
      const uint8_t was = then_covered.at<uint8_t>(y, x);
      if (was == 0 || covered.at<uint8_t>(y, x) == 255) {
        ASSERT_FALSE(differs) << x << " " << y;
      } else if (was == 255 && covered.at<uint8_t>(y, x) == 0) {
        ASSERT_TRUE(differs) << x << " " << y;
      }
    }
  }
  EXPECT_TRUE(test::ImagesAgree(Draw(0.5), before, {.max = 0.0, .mean = 0.0}));
  EXPECT_TRUE(test::ImagesAgree(Draw(1.5), then, {.max = 0.0, .mean = 0.0}));
}

TEST_F(OnionSkinTest, WhoStandsStillHasNoSkins) {
  Create();
  Draw(0.5);
  show::StagedFrame other;
  ASSERT_TRUE(show_->StageAtTime(0.25, now_, other).ok());
  ASSERT_EQ(other.people.actors.size(), 1u);
  RemoveUnmoved(now_, other);
  EXPECT_TRUE(other.people.actors.empty());
}

}  // namespace
}  // namespace lararium::editor
