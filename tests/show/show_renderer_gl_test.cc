#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "shared/core/srgb.h"
#include "shared/show/show_renderer.h"
#include "tests/golden/compare_images.h"
#include "tests/render/gl_fixture.h"
#include "tests/render/test_people.h"

namespace lararium::show {
namespace {

constexpr geometry::CameraModel kShowCamera{160, 120, 200.0, 200.0, 79.5, 59.5};
const float kKnee = render::RenderScene().knee;  // Knee of the camera's response.

uint8_t ByteFromLinear(double linear) {
  return static_cast<uint8_t>(std::lround(255.0 * SrgbFromLinear(std::clamp(linear, 0.0, 1.0))));
}

// Light that gives a white matte surface this radiance, for any orientation.
light::ProbeLight UniformLight(const glm::vec3& radiance) {
  light::ProbeLight light;
  light.sky[0] = radiance * 2.0f * std::sqrt(std::numbers::pi_v<float>);
  return light;
}

geometry::TriangleMesh Wall(float left, float right, float z) {
  return {.positions = {{left, -9.0f, z}, {right, -9.0f, z}, {right, 9.0f, z}, {left, 9.0f, z}},
          .normals = {},
          .indices = {0, 1, 2, 0, 2, 3}};
}

// A ball of radius 1, 4 m in front of a camera that looks along the stage's -Z.
class ShowRendererTest : public render::GlTest {
 protected:
  void Create(const glm::vec3& albedo, std::vector<stage::Place> places) {
    ShowContent content;
    content.cast = {{"ball", std::make_shared<const human::Human>(
                                 render::MakeHuman(render::Sphere(albedo), 1))}};
    for (stage::Place& place : places) {
      content.places.push_back({std::move(place), nullptr});
    }
    auto renderer = ShowRenderer::Create(content);
    ASSERT_TRUE(renderer.ok()) << renderer.message();
    renderer_ = std::move(renderer).value();
    target_.emplace(MakeTarget(kShowCamera.width, kShowCamera.height));
    staged_.people.actors.resize(1);
    staged_.people.actors[0].figure = content.cast[0].human;
    staged_.people.actors[0].skin_count = 1;
    staged_.people.actors[0].stage_from_actor[3] = glm::vec4(0.0f, 0.0f, -4.0f, 1.0f);
    staged_.people.skin = {glm::mat4(1.0f)};
    staged_.camera.camera_from_stage =
        geometry::Rigid3{{0.0, 1.0, 0.0, 0.0}, Eigen::Vector3d::Zero()};
    staged_.tracked.camera = kShowCamera;
  }

  void SetLight(const glm::vec3& radiance) {
    staged_.light.surfaces = staged_.people.actors[0].light = UniformLight(radiance);
  }

  // Draws over a uniform camera image: linear colour, below the knee.
  cv::Mat Draw(const glm::vec3& background = glm::vec3(0.0f)) {
    staged_.tracked.frame.bgr =
        cv::Mat(kShowCamera.height, kShowCamera.width, CV_8UC3,
                cv::Scalar(ByteFromLinear(background.b), ByteFromLinear(background.g),
                           ByteFromLinear(background.r)));
    const Status drawn = renderer_->Draw(staged_, *target_);
    EXPECT_TRUE(drawn.ok()) << drawn.message();
    return Read(*target_);
  }

  static glm::dvec3 LinearAt(const cv::Mat& picture, int x, int y) {
    const cv::Vec3b pixel = picture.at<cv::Vec3b>(y, x);
    return {LinearFromSrgb(pixel[2] / 255.0), LinearFromSrgb(pixel[1] / 255.0),
            LinearFromSrgb(pixel[0] / 255.0)};
  }

  std::unique_ptr<ShowRenderer> renderer_;
  std::optional<render::RenderTarget> target_;
  StagedFrame staged_;
  CameraMotion motion_;
};

TEST_F(ShowRendererTest, OneStopLessOfTheCameraIsOneStopLessOfThePeople) {
  Create(glm::vec3(0.5f), {{}});
  SetLight({1.0f, 0.9f, 0.8f});
  staged_.camera.gain = {1.0f, 1.0f, 1.0f};
  const glm::dvec3 full = LinearAt(Draw(), 80, 60);
  staged_.camera.gain = {0.5f, 0.5f, 0.5f};
  const glm::dvec3 half = LinearAt(Draw(), 80, 60);
  for (int c = 0; c < 3; ++c) {
    EXPECT_LT(full[c], kKnee);
    EXPECT_NEAR(half[c] / full[c], 0.5, 0.01) << c;
  }
}

TEST_F(ShowRendererTest, PeopleStandInThePictureLikeThePlaceAtEveryGain) {
  // A surface with the radiance of the map's reference looks like the place itself, for any
  // exposure and white balance of the camera: the ball vanishes.
  const glm::vec3 albedo(0.6f, 0.4f, 0.3f);
  const glm::vec3 light(0.8f, 0.9f, 1.0f);
  Create(albedo, {{}});
  SetLight(light);
  const glm::vec3 reference = albedo * light;
  for (const glm::vec3& gain :
       {glm::vec3(1.0f), glm::vec3(0.5f), glm::vec3(0.25f), glm::vec3(1.2f, 1.0f, 0.7f)}) {
    staged_.camera.gain = {gain.r, gain.g, gain.b};
    const glm::vec3 seen = reference * gain;
    ASSERT_LT(std::max({seen.r, seen.g, seen.b}), kKnee);
    const cv::Mat picture = Draw(seen);
    EXPECT_TRUE(test::ImagesAgree(picture, staged_.tracked.frame.bgr, {.max = 1.0, .mean = 0.5}))
        << gain.r << " " << gain.g << " " << gain.b;
  }
}

TEST_F(ShowRendererTest, EachPlaceHasItsOwnOccluders) {
  stage::Place yard;
  yard.occluders = {{"wall", Wall(0.0f, 9.0f, -2.0f), {}}};
  Create(glm::vec3(1.0f), {{}, yard});
  SetLight(glm::vec3(0.5f));
  for (const uint32_t place : {0u, 1u, 0u}) {
    staged_.camera.place = place;
    const cv::Mat picture = Draw();
    EXPECT_NEAR(LinearAt(picture, 60, 60).r, 0.5, 0.01) << place;
    EXPECT_NEAR(LinearAt(picture, 100, 60).r, place == 0 ? 0.5 : 0.0, 0.01) << place;
  }
}

TEST_F(ShowRendererTest, ShadowsFallOnOccludersThatReceiveThem) {
  stage::Place yard;
  yard.occluders = {{"wall", Wall(-9.0f, 9.0f, -5.0f), {}}};
  stage::Place glazed = yard;
  glazed.occluders[0].receives_shadow = false;
  Create(glm::vec3(1.0f), {yard, glazed});
  SetLight(glm::vec3(0.5f));
  staged_.people.actors.clear();
  staged_.light.blockers = {{0.0f, 0.0f, -4.4f, 0.5f}};
  for (const uint32_t place : {0u, 1u}) {
    staged_.camera.place = place;
    const double seen = LinearAt(Draw(glm::vec3(0.5f)), 80, 60).r;
    EXPECT_NEAR(seen, place == 0 ? 0.5 * (1.0 - 0.25 / 0.36) : 0.5, place == 0 ? 0.06 : 0.005);
  }
}

TEST_F(ShowRendererTest, EverybodyIsInTheirOwnLight) {
  Create(glm::vec3(1.0f), {{}});
  staged_.people.actors.push_back(staged_.people.actors[0]);
  staged_.people.actors[0].stage_from_actor[3].x = -1.2f;
  staged_.people.actors[1].stage_from_actor[3].x = 1.2f;
  staged_.people.actors[0].light = UniformLight({0.5f, 0.4f, 0.1f});
  staged_.people.actors[1].light = UniformLight({0.1f, 0.2f, 0.5f});
  const cv::Mat picture = Draw();
  for (const auto& [x, expected] :
       {std::pair(20, glm::dvec3(0.5, 0.4, 0.1)), std::pair(140, glm::dvec3(0.1, 0.2, 0.5))}) {
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(LinearAt(picture, x, 60)[c], expected[c], 0.01) << x;
    }
  }
}

TEST_F(ShowRendererTest, StagingOnePlaceAnewLeavesTheOthers) {
  stage::Place yard;
  yard.occluders = {{"wall", Wall(-9.0f, 9.0f, -2.0f), {}}};
  Create(glm::vec3(1.0f), {{}, {}});
  SetLight(glm::vec3(0.5f));
  renderer_->SetPlace(1, yard);
  EXPECT_NEAR(LinearAt(Draw(), 80, 60).r, 0.5, 0.01);
  staged_.camera.place = 1;
  EXPECT_NEAR(LinearAt(Draw(), 80, 60).r, 0.0, 0.01);
}

TEST_F(ShowRendererTest, GhostsAreOfOneColourWhereNothingHidesThemAndChangeNoPictureAfterThem) {
  stage::Place yard;
  yard.occluders = {{"wall", Wall(0.0f, 9.0f, -2.0f), {}}, {"floor", Wall(-9.0f, 9.0f, -6.0f), {}}};
  Create(glm::vec3(0.5f), {yard});
  SetLight(glm::vec3(0.8f));
  staged_.light.blockers = {{0.0f, 0.0f, -5.5f, 1.0f}};  // A shadow on the floor.
  const cv::Mat before = Draw(glm::vec3(0.2f));
  render::SceneMark mark;
  mark.colour = {0.1f, 0.2f, 0.9f};
  mark.share = 1.0f;
  ASSERT_TRUE(renderer_->DrawOverlays(staged_, mark, *target_).ok());
  const cv::Mat ghost = Read(*target_);
  cv::Mat coverage;
  renderer_->ReadCoverage(coverage);
  for (int y = 0; y < coverage.rows; ++y) {
    for (int x = 0; x < coverage.cols; ++x) {
      const cv::Vec3b pixel = ghost.at<cv::Vec3b>(y, x);
      if (coverage.at<uint8_t>(y, x) == 0) {
        ASSERT_EQ(pixel, cv::Vec3b(0, 0, 0)) << x << " " << y << ": neither image nor shadow";
      } else if (coverage.at<uint8_t>(y, x) == 255) {
        ASSERT_GT(pixel[0], pixel[2] + 40) << x << " " << y;
      }
    }
  }
  EXPECT_EQ(coverage.at<uint8_t>(60, 50), 255);
  EXPECT_EQ(coverage.at<uint8_t>(60, 110), 0) << "behind the wall";
  EXPECT_TRUE(test::ImagesAgree(Draw(glm::vec3(0.2f)), before, {.max = 0.0, .mean = 0.0}));
}

// Motion of the middle of the ball's ellipse: f z / (z^2 - r^2).
constexpr double kPixelsPerMetre = 200.0 * 4.0 / (16.0 - 1.0);

// Column of the ball in the picture; the camera's image is black.
double BallAt(const cv::Mat& picture) {
  cv::Mat lit;
  cv::inRange(picture, cv::Scalar::all(60), cv::Scalar::all(255), lit);
  return cv::moments(lit, true).m10 / std::max(cv::moments(lit, true).m00, 1.0);
}

TEST_F(ShowRendererTest, WhoIsStagedInAnotherDetailIsDrawnInIt) {
  Create(glm::vec3(0.5f), {{}});
  SetLight(glm::vec3(1.0f));
  const cv::Mat ball = Draw();
  human::Human half = *staged_.people.actors[0].figure;
  half.meshes[0].indices.resize(half.meshes[0].indices.size() / 6 * 3);
  const auto coarse = std::make_shared<const human::Human>(half);
  const auto fine = std::exchange(staged_.people.actors[0].figure, coarse);
  EXPECT_FALSE(test::ImagesAgree(Draw(), ball, {.max = 1.0, .mean = 0.1}));
  staged_.people.actors[0].figure = fine;
  EXPECT_TRUE(test::ImagesAgree(Draw(), ball, {.max = 0.0, .mean = 0.0}));
}

TEST_F(ShowRendererTest, AtHalfTheRatePeopleMoveInEverySecondPicture) {
  Create(glm::vec3(0.8f), {{}});
  SetLight(glm::vec3(1.0f));
  renderer_->SetQuality({.samples = 1, .half_rate = true});
  std::vector<double> seen;
  for (int frame = 0; frame < 7; ++frame) {
    staged_.tracked.frame.index = frame;
    staged_.people.actors[0].stage_from_actor[3].x = 0.1f * static_cast<float>(frame);
    seen.push_back(BallAt(Draw()));
  }
  // The first picture is drawn as a whole; each pair shows what the previous pair began.
  const std::array<double, 7> expected = {0, 0, 1, 1, 3, 3, 5};
  for (size_t frame = 0; frame < seen.size(); ++frame) {
    EXPECT_NEAR(seen[frame] - seen[0], kPixelsPerMetre * 0.1 * expected[frame], 0.3) << frame;
  }
}

TEST_F(ShowRendererTest, AtHalfTheRatePeopleStayOnTheirSpotWhileTheCameraTurns) {
  Create(glm::vec3(0.8f), {{}});
  SetLight(glm::vec3(1.0f));
  const auto turn = [&](int frame) {
    staged_.tracked.frame.index = frame;
    staged_.camera.camera_from_stage = geometry::Rigid3{
        Eigen::Quaterniond(Eigen::AngleAxisd(0.012 * frame, Eigen::Vector3d::UnitY())) *
            Eigen::Quaterniond(0.0, 1.0, 0.0, 0.0),
        Eigen::Vector3d::Zero()};
    staged_.camera.motion = frame == 0 ? std::nullopt : std::optional(motion_);
    motion_ = {*staged_.camera.camera_from_stage, 1};
  };
  std::vector<double> whole;
  for (int frame = 0; frame < 6; ++frame) {
    turn(frame);
    whole.push_back(BallAt(Draw()));
  }
  renderer_->SetQuality({.samples = 1, .half_rate = true});
  for (int frame = 0; frame < 6; ++frame) {
    turn(frame);
    EXPECT_NEAR(BallAt(Draw()), whole[static_cast<size_t>(frame)], 0.3) << frame;
  }
}

TEST_F(ShowRendererTest, AtHalfTheRateNobodyOfAnotherPlaceIsCarriedOver) {
  Create(glm::vec3(0.8f), {{}, {}});
  SetLight(glm::vec3(1.0f));
  renderer_->SetQuality({.samples = 1, .half_rate = true});
  for (int frame = 0; frame < 4; ++frame) {
    staged_.tracked.frame.index = frame;
    Draw();
  }
  staged_.camera.place = 1;
  staged_.people.actors[0].stage_from_actor[3].x = 0.5f;
  const double there = BallAt(Draw());
  EXPECT_NEAR(there, 79.5 + kPixelsPerMetre * 0.5, 0.5);
  staged_.camera.camera_from_stage.reset();
  EXPECT_EQ(cv::countNonZero(Draw().reshape(1)), 0) << "without a pose nobody is there";
}

}  // namespace
}  // namespace lararium::show
