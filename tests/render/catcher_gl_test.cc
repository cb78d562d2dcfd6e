// Tests shadows of people on real surfaces against formulas and quadrature.

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "shared/core/random.h"
#include "shared/core/srgb.h"
#include "shared/geometry/glm_convert.h"
#include "shared/light/lamp.h"
#include "shared/render/clip_space.h"
#include "shared/render/renderer.h"
#include "tests/light/sh_test_support.h"
#include "tests/render/gl_fixture.h"
#include "tests/render/test_people.h"

namespace lararium::render {
namespace {

constexpr int kWidth = 320;
constexpr int kHeight = 240;

geometry::TriangleMesh Floor() {
  return Quad({-6.0f, 0.0f, 6.0f}, {12.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -12.0f});
}

light::ShRgb EvenSky() {
  light::ShRgb light = {};
  light[0] = glm::vec3(3.0f);
  return light;
}

// A floor seen from above, slantwise, in a grey picture.
class CatcherTest : public GlTest {
 protected:
  void SetUp() override {
    GlTest::SetUp();
    auto renderer = Renderer::Create({.samples = 1});
    ASSERT_TRUE(renderer.ok()) << renderer.message();
    renderer_ = std::move(renderer).value();
    scene_.background = cv::Mat(kHeight, kWidth, CV_8UC3, cv::Scalar::all(kGrey));
    scene_.camera = scene_.display = {.width = kWidth,
                                      .height = kHeight,
                                      .fx = 300.0,
                                      .fy = 310.0,
                                      .cx = 0.5 * (kWidth - 1) + 7.0,
                                      .cy = 0.5 * (kHeight - 1) - 5.0};
    scene_.camera_from_stage =
        LookAt(Eigen::Vector3d(0.7, 2.4, 3.0), Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitY());
    occluders_ = {{.mesh = renderer_->AddMesh(Floor())}};
    scene_.occluders = occluders_;
    scene_.light = EvenSky();
  }

  cv::Mat Draw() {
    const RenderTarget target = MakeTarget(kWidth, kHeight);
    const Status drawn = renderer_->Draw(scene_, target);
    EXPECT_TRUE(drawn.ok()) << drawn.message();
    return Read(target);
  }
  // A person that is a ball, 0.3 m in radius.
  void AddBallOnTheFloor() {
    human_.human = renderer_->AddHuman(Shared(MakeHuman(Sphere(glm::vec3(0.5f)), 1))).value();
    human_.skin = {&skin_, 1};
    human_.stage_from_actor = glm::mat4(glm::mat3(0.3f));
    human_.stage_from_actor[3] = glm::vec4(0.0f, 0.3f, 0.0f, 1.0f);
    scene_.humans = {&human_, 1};
  }
  // The share of its light that a pixel kept.
  static double Kept(const cv::Mat& picture, const cv::Point& pixel, int channel = 1) {
    return LinearFromSrgb(picture.at<cv::Vec3b>(pixel)[channel] / 255.0) /
           LinearFromSrgb(kGrey / 255.0);
  }
  cv::Point PixelOf(const Eigen::Vector3d& point) const {
    const Eigen::Vector2d pixel = *scene_.display.Project(*scene_.camera_from_stage * point);
    return {static_cast<int>(std::lround(pixel.x())), static_cast<int>(std::lround(pixel.y()))};
  }
  // The point of the floor that is visible in a pixel.
  glm::vec3 FloorAt(const cv::Point& pixel) const {
    const geometry::Rigid3 stage_from_camera = scene_.camera_from_stage->Inverse();
    const Eigen::Vector2d plane = scene_.display.PlaneFromPixel({pixel.x, pixel.y});
    const Eigen::Vector3d ray =
        stage_from_camera.rotation * Eigen::Vector3d(plane.x(), plane.y(), 1.0);
    const Eigen::Vector3d& eye = stage_from_camera.translation;
    return geometry::ToGlm(Eigen::Vector3d(eye - ray * (eye.y() / ray.y())));
  }

  static constexpr int kGrey = 190;
  std::unique_ptr<Renderer> renderer_;
  std::vector<SceneOccluder> occluders_;
  glm::mat4 skin_ = glm::mat4(1.0f);
  SceneHuman human_;
  RenderScene scene_;
};

TEST_F(CatcherTest, NothingDarkensWithoutBallsNorFarFromThem) {
  EXPECT_EQ(cv::norm(Draw(), scene_.background, cv::NORM_INF), 0.0);
  const glm::vec4 behind(0.0f, 1.0f, 40.0f, 0.3f);
  scene_.blockers = {&behind, 1};
  EXPECT_EQ(cv::norm(Draw(), scene_.background, cv::NORM_INF), 0.0);
  const std::vector<glm::vec4> broken = {{NAN, 0.0f, 0.0f, 1.0f}, {0.0f, 0.5f, 0.0f, 0.0f}};
  scene_.blockers = broken;
  EXPECT_EQ(cv::norm(Draw(), scene_.background, cv::NORM_INF), 0.0);
}

TEST_F(CatcherTest, InHalvesShadowsChangeWithThePeopleWhoCastThem) {
  renderer_->SetQuality({.samples = 1, .half_rate = true});
  AddBallOnTheFloor();
  const glm::vec4 here(0.0f, 0.3f, 0.0f, 0.3f);
  scene_.blockers = {&here, 1};
  RenderScene later = scene_;
  SceneHuman moved = human_;
  moved.stage_from_actor[3].x = 0.8f;
  later.humans = {&moved, 1};
  const glm::vec4 there(0.8f, 0.3f, 0.0f, 0.3f);
  for (const std::span<const glm::vec4> blockers :
       {std::span<const glm::vec4>(&there, 1), std::span<const glm::vec4>()}) {
    later.blockers = blockers;
    const RenderTarget target = MakeTarget(kWidth, kHeight);
    ASSERT_TRUE(renderer_->Draw(later, target).ok());
    const cv::Mat expected = Read(target);
    ASSERT_TRUE(renderer_->Draw(scene_, target).ok());
    const cv::Mat before = Read(target);
    ASSERT_GT(cv::norm(before, expected, cv::NORM_INF), 20.0);
    ASSERT_TRUE(renderer_->DrawHalf(Renderer::Half::kShadows, later, later, target).ok());
    EXPECT_EQ(cv::norm(Read(target), before, cv::NORM_INF), 0.0);
    ASSERT_TRUE(renderer_->DrawHalf(Renderer::Half::kPeople, later, later, target).ok());
    EXPECT_EQ(cv::norm(Read(target), expected, cv::NORM_INF), 0.0);
  }
}

// A ball above a floor under an even sky hides sin^2(a) cos(t), with a its angular radius
// and t the angle from the normal to its centre (Howell, "A Catalog of Radiation Heat
// Transfer Configuration Factors", B-43).
TEST_F(CatcherTest, OfABallUnderAnEvenSkyTheFloorKeepsWhatTheFormFactorSays) {
  const glm::vec4 ball(0.1f, 0.7f, -0.2f, 0.3f);
  scene_.blockers = {&ball, 1};
  const cv::Mat picture = Draw();
  double squared = 0.0;
  double least = 1.0;
  int count = 0;
  for (int y = 3; y < kHeight; y += 7) {
    for (int x = 3; x < kWidth; x += 7) {
      const glm::vec3 d = glm::vec3(ball) - FloorAt({x, y});
      const double sine = ball.w / glm::length(d);
      const double expected = 1.0 - sine * sine * glm::normalize(d).y;
      const double kept = Kept(picture, {x, y});
      EXPECT_NEAR(kept, expected, 0.035) << x << ", " << y;
      squared += (kept - expected) * (kept - expected);
      least = std::min(least, kept);
      ++count;
    }
  }
  std::printf("  rms %.4f of the analytic ratio, least %.3f\n", std::sqrt(squared / count), least);
  EXPECT_LT(std::sqrt(squared / count), 0.012);
  EXPECT_NEAR(least, 1.0 - 0.09 / 0.49, 0.03);
}

// Differential rendering adds the ratio of a lamp's irradiance to the sky's.
TEST_F(CatcherTest, ALampBrightensTheFloorByItsIrradianceOverTheSkys) {
  const light::Lamp lamp = {{0.1f, 0.7f, -0.2f}, {0.5f, 0.3f, 0.1f}, 0.05f};
  scene_.lamps = {&lamp, 1};
  const glm::vec3 sky = light::EvaluateIrradiance(scene_.light, {0, 1, 0});
  const cv::Mat picture = Draw();
  for (int y = 3; y < kHeight; y += 14) {
    for (int x = 3; x < kWidth; x += 14) {
      const light::Sun seen = light::SeenFrom(lamp, FloorAt({x, y}));
      for (int channel = 0; channel < 3; ++channel) {
        const float gain = seen.irradiance[channel] * seen.direction.y / sky[channel];
        // Everywhere, the renderer subtracts 2 % of the sky's light from that of a lamp.
        EXPECT_NEAR(Kept(picture, {x, y}, 2 - channel), 1.0 + std::max(gain - 0.02f, 0.0f), 0.025)
            << x << ", " << y;
      }
    }
  }
}

// If the drama is set at dusk but the image was taken at noon, a lamp is as faint as at noon.
TEST_F(CatcherTest, ALampBrightensTheFloorByTheLightThatTheImageWasTakenIn) {
  const light::Lamp lamp = {{0.1f, 0.7f, -0.2f}, {0.5f, 0.3f, 0.1f}, 0.05f};
  scene_.lamps = {&lamp, 1};
  const cv::Mat noon = Draw();
  scene_.picture_light = scene_.light;
  for (glm::vec3& coefficient : scene_.light) {
    coefficient *= 0.1f;
  }
  const cv::Mat dusk = Draw();
  scene_.picture_light.reset();
  const cv::Mat both = Draw();
  const cv::Point under = PixelOf({0.1, 0.0, -0.2});
  EXPECT_NEAR(Kept(dusk, under), Kept(noon, under), 0.01);
  EXPECT_GT(Kept(both, under), Kept(noon, under) + 0.2);
}

TEST_F(CatcherTest, ABallHidesALampFromTheFloorBehindIt) {
  const light::Lamp lamp = {{0.0f, 0.7f, 0.0f}, glm::vec3(0.6f), 0.05f};
  scene_.lamps = {&lamp, 1};
  const cv::Point behind = PixelOf({0.6, 0.0, 0.0});
  const cv::Point beside = PixelOf({-0.6, 0.0, 0.0});
  const double lit = Kept(Draw(), beside);
  EXPECT_NEAR(Kept(Draw(), behind), lit, 0.02);
  const glm::vec4 ball(0.3f, 0.35f, 0.0f, 0.1f);
  scene_.blockers = {&ball, 1};
  const cv::Mat shaded = Draw();
  EXPECT_NEAR(Kept(shaded, beside), lit, 0.03);
  EXPECT_LT(Kept(shaded, behind), 1.0);
  EXPECT_GT(lit, 1.1);
  // A ball that touches the lamp is its holder and does not hide it.
  const glm::vec4 holder(0.0f, 0.6f, 0.0f, 0.1f);
  scene_.blockers = {&holder, 1};
  EXPECT_GT(Kept(Draw(), beside), 1.08);
}

// A wall at x = 0.3. Points behind it lie in its shadow; the foot of the wall does not.
TEST_F(CatcherTest, AWallHidesALampFromTheFloorBehindIt) {
  light::Lamp lamp = {{0.0f, 0.7f, 0.0f}, glm::vec3(0.6f), 0.05f};
  const cv::Point behind = PixelOf({0.6, 0.0, 0.0});
  const cv::Point before = PixelOf({0.2, 0.0, 0.1});
  const cv::Point beside = PixelOf({-0.6, 0.0, 0.0});
  scene_.lamps = {&lamp, 1};
  const cv::Mat open = Draw();
  auto walls = std::make_shared<light::LampWalls>();
  for (int row = 0; row < light::LampWalls::kSize; ++row) {
    for (int column = 0; column < light::LampWalls::kSize; ++column) {
      if (light::LampWalls::Direction(column, row).x > 1e-4f) {
        walls->planes[static_cast<size_t>(row * light::LampWalls::kSize + column)] = {1, 0, 0, 0.3};
      }
    }
  }
  lamp.walls = walls;
  const cv::Mat walled = Draw();
  EXPECT_GT(Kept(open, behind), 1.1);
  EXPECT_NEAR(Kept(walled, behind), 1.0, 0.01);
  EXPECT_NEAR(Kept(walled, before), Kept(open, before), 0.01);
  EXPECT_NEAR(Kept(walled, beside), Kept(open, beside), 0.01);
}

// Many balls under coloured, directional light, compared with a sum over directions.
TEST_F(CatcherTest, OfManyBallsInColouredLightTheFloorKeepsWhatQuadratureSays) {
  Random random(31);
  light::ShRgb light = {};
  for (size_t k = 1; k < 16; ++k) {
    light[k] = 0.12f * glm::vec3{random.Normal(), random.Normal(), random.Normal()};
  }
  light[0] = glm::vec3(3.0f, 2.5f, 2.0f);
  scene_.light = light;
  std::vector<glm::vec4> balls;  // a column and an arm
  for (int i = 0; i < 12; ++i) {
    balls.emplace_back(0.0f, 0.1f + 0.13f * static_cast<float>(i), 0.0f, 0.11f);
    balls.emplace_back(0.1f * static_cast<float>(i), 1.3f, 0.0f, 0.06f);
  }
  scene_.blockers = balls;
  const cv::Mat picture = Draw();
  glm::dvec3 squared(0.0);
  int count = 0;
  for (int y = 30; y < kHeight; y += 21) {
    for (int x = 10; x < kWidth; x += 21) {
      const glm::vec3 point = FloorAt({x, y});
      glm::dvec3 left(0.0), all(0.0);
      for (const glm::vec3& d : light::EvenDirections(4000)) {
        const glm::dvec3 falls(std::max(0.0f, d.y) *
                               glm::max(light::EvaluateRadiance(light, d), glm::vec3(0.0f)));
        bool visible = true;
        for (const glm::vec4& ball : balls) {
          const glm::vec3 to = glm::vec3(ball) - point;
          const float along = glm::dot(to, d);
          visible =
              visible && !(along > 0.0f && glm::dot(to, to) - along * along < ball.w * ball.w);
        }
        all += falls;
        left += visible ? falls : glm::dvec3(0.0);
      }
      for (int channel = 0; channel < 3; ++channel) {
        const double off = Kept(picture, {x, y}, 2 - channel) - left[channel] / all[channel];
        squared[channel] += off * off;
      }
      ++count;
    }
  }
  for (int channel = 0; channel < 3; ++channel) {
    const double rms = std::sqrt(squared[channel] / count);
    std::printf("  channel %d: rms %.4f of the quadrature's ratio\n", channel, rms);
    EXPECT_LT(rms, 0.03);
  }
}

TEST_F(CatcherTest, ContactIsDarkAndDoesNotFloat) {
  // A foot on the floor. Its shadow must begin at the point of contact.
  const glm::vec4 foot(0.0f, 0.12f, 0.0f, 0.124f);
  scene_.blockers = {&foot, 1};
  const cv::Mat picture = Draw();
  EXPECT_LT(Kept(picture, PixelOf({0.0, 0.0, 0.0})), 0.2);
  EXPECT_LT(Kept(picture, PixelOf({0.1, 0.0, 0.0})), 0.6);
  EXPECT_GT(Kept(picture, PixelOf({0.6, 0.0, 0.0})), 0.97);
}

TEST_F(CatcherTest, SurfacesThatDoNotReceiveStayAsTheyAreAndHideWhatDoes) {
  // A board that covers two thirds of the floor.
  occluders_.push_back({.mesh = renderer_->AddMesh(
                            Quad({-6.0f, 0.02f, 6.0f}, {5.9f, 0.0f, 0.0f}, {0.0f, 0.0f, -12.0f})),
                        .receives_shadow = false});
  scene_.occluders = occluders_;
  const glm::vec4 ball(0.0f, 0.5f, 0.0f, 0.4f);
  scene_.blockers = {&ball, 1};
  const cv::Mat picture = Draw();
  EXPECT_EQ(Kept(picture, PixelOf({-0.3, 0.02, 0.0})), 1.0);
  EXPECT_LT(Kept(picture, PixelOf({0.2, 0.0, 0.0})), 0.6);
}

// A wall stands on the floor; its shadow, and the floor's, stop at the edge between them.
TEST_F(CatcherTest, ShadowsDoNotBleedOverEdges) {
  // The wall's top edge lies in front of the floor far behind it.
  occluders_.push_back({.mesh = renderer_->AddMesh(
                            Quad({-2.0f, 0.0f, 0.0f}, {4.0f, 0.0f, 0.0f}, {0.0f, 0.6f, 0.0f}))});
  scene_.occluders = occluders_;
  // The ball is close in front of the wall, which becomes dark; the floor behind it does not.
  const glm::vec4 ball(0.0f, 0.45f, 0.22f, 0.2f);
  scene_.blockers = {&ball, 1};
  const cv::Mat picture = Draw();
  const cv::Point edge = PixelOf({0.0, 0.6, 0.0});
  EXPECT_LT(Kept(picture, edge + cv::Point(0, 2)), 0.75);
  EXPECT_GT(Kept(picture, edge - cv::Point(0, 2)), 0.93);
}

TEST_F(CatcherTest, PeopleOverAShadowStayAsTheyAre) {
  AddBallOnTheFloor();
  const cv::Mat without = Draw();
  const glm::vec4 blocker(0.0f, 0.3f, 0.0f, 0.3f);
  scene_.blockers = {&blocker, 1};
  const cv::Mat with = Draw();
  EXPECT_EQ(with.at<cv::Vec3b>(PixelOf({0.0, 0.35, 0.0})),
            without.at<cv::Vec3b>(PixelOf({0.0, 0.35, 0.0})));
  EXPECT_NE(with.at<cv::Vec3b>(PixelOf({0.4, 0.0, 0.1})),
            without.at<cv::Vec3b>(PixelOf({0.4, 0.0, 0.1})));
}

// Reads a target including alpha, top row first.
cv::Mat ReadRgba(const RenderTarget& target) {
  cv::Mat rgba(target.height(), target.width(), CV_8UC4);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, target.framebuffer());
  glReadPixels(0, 0, rgba.cols, rgba.rows, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data);
  return rgba;
}

TEST_F(CatcherTest, SeenThroughOverWhatIsRealItIsThePictureThatHasBoth) {
  AddBallOnTheFloor();
  const glm::vec4 blocker(0.0f, 0.3f, 0.0f, 0.3f);
  scene_.blockers = {&blocker, 1};
  for (const float opacity : {1.0f, 0.4f}) {
    scene_.people_opacity = opacity;
    scene_.see_through = false;
    scene_.background = cv::Mat(kHeight, kWidth, CV_8UC3, cv::Scalar::all(kGrey));
    const cv::Mat both = Draw();
    scene_.see_through = true;
    scene_.background.release();
    const RenderTarget target = MakeTarget(kWidth, kHeight);
    ASSERT_TRUE(renderer_->Draw(scene_, target).ok());
    const cv::Mat alone = ReadRgba(target);
    EXPECT_EQ(alone.at<cv::Vec4b>(2, 2), cv::Vec4b(0, 0, 0, 0)) << "nobody is there";
    int hidden = 0;
    int darkened = 0;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const cv::Vec4b seen = alone.at<cv::Vec4b>(y, x);
        const double over = LinearFromSrgb(seen[1] / 255.0) +
                            (1.0 - seen[3] / 255.0) * LinearFromSrgb(kGrey / 255.0);
        ASSERT_NEAR(over, LinearFromSrgb(both.at<cv::Vec3b>(y, x)[1] / 255.0), 0.008)
            << x << " " << y;
        hidden += seen[3] > 250 * opacity && seen[1] > 0 ? 1 : 0;
        darkened += seen[3] > 3 && seen[1] == 0 ? 1 : 0;
      }
    }
    EXPECT_GT(hidden, 500) << "the ball";
    EXPECT_GT(darkened, 500) << "its shadow";
  }
}

TEST_F(CatcherTest, WhatIsSeenThroughHasNoBackground) {
  scene_.see_through = true;
  EXPECT_FALSE(renderer_->Draw(scene_, MakeTarget(kWidth, kHeight)).ok());
}

// Balls that are merged, because there are too many, must darken surfaces like their parts.
TEST_F(CatcherTest, MoreBallsThanFitDarkenAlike) {
  Random random(8);
  std::vector<glm::vec4> balls;
  for (int i = 0; i < 512; ++i) {
    balls.push_back({random.Uniform(-0.3, 0.3), random.Uniform(0.1, 1.7), random.Uniform(-0.2, 0.2),
                     random.Uniform(0.015, 0.025)});
  }
  scene_.blockers = balls;
  const cv::Mat as_many = Draw();
  for (size_t i = 0; i < 512; ++i) {  // replaces each ball by two with the same total area
    balls[i].w *= std::sqrt(0.5f);
    balls.push_back(balls[i] + glm::vec4(0.001f, 0.0f, 0.0f, 0.0f));
  }
  scene_.blockers = balls;
  const cv::Mat merged = Draw();
  EXPECT_GT(cv::norm(as_many, scene_.background, cv::NORM_INF), 20.0);
  EXPECT_LT(cv::norm(as_many, merged, cv::NORM_INF), 12.0);
}

}  // namespace
}  // namespace lararium::render
