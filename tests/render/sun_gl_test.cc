// Tests the sun's shadows: their position, the softness of their edges, and what casts them on
// what.

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <vector>

#include "shared/core/srgb.h"
#include "shared/core/units.h"
#include "shared/geometry/glm_convert.h"
#include "shared/render/clip_space.h"
#include "shared/render/renderer.h"
#include "tests/render/gl_fixture.h"
#include "tests/render/test_people.h"

namespace lararium::render {
namespace {
constexpr int kSunWidth = 640;
constexpr int kSunHeight = 480;
constexpr int kGrey = 190;
constexpr double kPixelsPerMetre = 200.0;

light::ShRgb EvenSky(float irradiance) {
  light::ShRgb light = {};
  light[0] = glm::vec3(irradiance / kPiF / 0.28209479f);
  return light;
}

// A floor viewed from straight above, with 5 mm per pixel, and a ball above it.
class SunTest : public GlTest {
 protected:
  void SetUp() override {
    GlTest::SetUp();
    auto renderer = Renderer::Create({.samples = 1});
    ASSERT_TRUE(renderer.ok()) << renderer.message();
    renderer_ = std::move(renderer).value();
    scene_.background = cv::Mat(kSunHeight, kSunWidth, CV_8UC3, cv::Scalar::all(kGrey));
    scene_.camera = scene_.display = {.width = kSunWidth,
                                      .height = kSunHeight,
                                      .fx = 8.0 * kPixelsPerMetre,
                                      .fy = 8.0 * kPixelsPerMetre,
                                      .cx = 0.5 * (kSunWidth - 1),
                                      .cy = 0.5 * (kSunHeight - 1)};
    scene_.camera_from_stage =
        LookAt(Eigen::Vector3d(0.0, 8.0, 0.0), Eigen::Vector3d::Zero(), -Eigen::Vector3d::UnitZ());
    occluders_ = {{.mesh = renderer_->AddMesh(
                       Quad({-6.0f, 0.0f, 6.0f}, {12.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -12.0f}))}};
    scene_.occluders = occluders_;
    scene_.light = EvenSky(1.0f);
    human_ = {.human = renderer_->AddHuman(Shared(MakeHuman(Sphere(glm::vec3(0.5f)), 1))).value(),
              .skin = {&skin_, 1}};
    scene_.humans = {&human_, 1};
  }

  void PlaceBall(const glm::vec3& centre, float radius) {
    human_.stage_from_actor = glm::mat4(glm::mat3(radius));
    human_.stage_from_actor[3] = glm::vec4(centre, 1.0f);
  }
  cv::Mat Draw() {
    const RenderTarget target = MakeTarget(kSunWidth, kSunHeight);
    const Status drawn = renderer_->Draw(scene_, target);
    EXPECT_TRUE(drawn.ok()) << drawn.message();
    return Read(target);
  }
  // The share of its light that the floor keeps at a point.
  static double Kept(const cv::Mat& picture, double x, double z) {
    const int column = static_cast<int>(std::lround(0.5 * (kSunWidth - 1) + kPixelsPerMetre * x));
    const int row = static_cast<int>(std::lround(0.5 * (kSunHeight - 1) + kPixelsPerMetre * z));
    return LinearFromSrgb(picture.at<cv::Vec3b>(row, column)[1] / 255.0) /
           LinearFromSrgb(kGrey / 255.0);
  }
  // The first position from x on at which the floor keeps more than a share.
  static double EdgeAt(const cv::Mat& picture, double x, double end, double share) {
    for (; x < end; x += 1.0 / kPixelsPerMetre) {
      if (Kept(picture, x, 0.0) > share) {
        return x;
      }
    }
    return end;
  }

  const glm::mat4 skin_ = glm::mat4(1.0f);
  std::unique_ptr<Renderer> renderer_;
  std::vector<SceneOccluder> occluders_;
  SceneHuman human_;
  RenderScene scene_;
};

TEST_F(SunTest, ShadowFallsWhereTheSunSaysAndLeavesTheSky) {
  // The sun stands at 45 degrees towards -x. A ball at a height of one metre casts its shadow one
  // metre towards +x.
  scene_.sun = light::Sun{glm::normalize(glm::vec3(-1.0f, 1.0f, 0.0f)),
                          glm::vec3(3.0f * std::sqrt(2.0f)), 0.0005f};
  PlaceBall({-0.1f, 1.0f, 0.0f}, 0.2f);
  const cv::Mat picture = Draw();
  // The sky's irradiance is 1 and the sun's is 3, so three quarters are lost.
  EXPECT_NEAR(Kept(picture, 0.9, 0.0), 0.25, 0.02);
  EXPECT_EQ(Kept(picture, 0.4, 0.0), 1.0);
  EXPECT_EQ(Kept(picture, 1.4, 0.0), 1.0);
  // The shadow is an ellipse, longer along the light by the square root of two.
  const double far_edge = EdgeAt(picture, 0.9, 1.5, 0.6);
  EXPECT_NEAR(far_edge, 0.9 + 0.2 * std::sqrt(2.0), 0.01);
  EXPECT_NEAR(Kept(picture, 0.9, 0.18), 0.25, 0.03);
  EXPECT_EQ(Kept(picture, 0.9, 0.22), 1.0);
}

TEST_F(SunTest, WhoIsOutsideOfThePictureThrowsShadowsIntoIt) {
  scene_.sun = light::Sun{glm::normalize(glm::vec3(-1.0f, 1.0f, 0.0f)),
                          glm::vec3(3.0f * std::sqrt(2.0f)), 0.0005f};
  PlaceBall({-2.6f, 3.0f, 0.0f}, 0.2f);
  EXPECT_NEAR(Kept(Draw(), 0.4, 0.0), 0.25, 0.02);
  PlaceBall({-5.0f, 3.0f, 0.0f}, 0.2f);
  EXPECT_EQ(Kept(Draw(), 0.4, 0.0), 1.0) << "the shadow is outside, too";
}

// Pictures of lower quality show the same shadow, and no picture leaves traces in the next.
TEST_F(SunTest, TheShadowIsThereAtEveryQuality) {
  scene_.sun = light::Sun{glm::normalize(glm::vec3(-1.0f, 1.0f, 0.0f)),
                          glm::vec3(3.0f * std::sqrt(2.0f)), 0.0005f};
  PlaceBall({-0.1f, 1.0f, 0.0f}, 0.2f);
  const Quality best = {.samples = 1};
  renderer_->SetQuality(best);
  const cv::Mat first = Draw();
  for (const Quality& quality : QualityLadder()) {
    renderer_->SetQuality(quality);
    const cv::Mat picture = Draw();
    EXPECT_NEAR(Kept(picture, 0.9, 0.0), 0.25, 0.03) << quality.layer_scale;
    EXPECT_NEAR(Kept(picture, 0.4, 0.0), 1.0, 0.01) << quality.layer_scale;
    EXPECT_NEAR(Kept(picture, 1.4, 0.0), 1.0, 0.01) << quality.layer_scale;
    EXPECT_NEAR(EdgeAt(picture, 0.9, 1.5, 0.6), 0.9 + 0.2 * std::sqrt(2.0), 0.04)
        << quality.layer_scale;
  }
  renderer_->SetQuality(best);
  EXPECT_EQ(cv::norm(Draw(), first, cv::NORM_INF), 0.0);
}

// The map of real objects is reused as long as it covers the required box.
TEST_F(SunTest, RealThingsShadeWhereverPeopleGoAndWhereverTheyAreMoved) {
  scene_.sun = light::Sun{glm::normalize(glm::vec3(-1.0f, 1.0f, 0.0f)), glm::vec3(4.0f), 0.0005f};
  occluders_.push_back({.mesh = renderer_->AddMesh(
                            Quad({0.3f, 0.0f, -2.0f}, {0.0f, 1.5f, 0.0f}, {0.0f, 0.0f, 4.0f}))});
  scene_.occluders = occluders_;
  for (const float x : {-1.2f, -1.19f, -1.18f}) {
    PlaceBall({x, 0.3f, 0.0f}, 0.15f);
    EXPECT_LT(Kept(Draw(), x + 0.3f, 0.0), 0.5) << x;
  }
  // The floor behind the wall is in its shadow already.
  PlaceBall({0.8f, 0.3f, 0.0f}, 0.15f);
  EXPECT_NEAR(Kept(Draw(), 1.1, 0.0), 1.0, 0.02);
  occluders_[1].stage_from_mesh[3].z = 10.0f;
  EXPECT_LT(Kept(Draw(), 1.1, 0.0), 0.5);
}

// The shadows of still props are reused. Each picture must equal one that was drawn without reuse.
TEST_F(SunTest, ThingsCastTheSameShadowsWhetherTheyStandOrMove) {
  scene_.sun = light::Sun{glm::normalize(glm::vec3(-1.0f, 1.0f, 0.0f)), glm::vec3(3.0f), 0.003f};
  PlaceBall({-0.8f, 1.0f, 0.4f}, 0.2f);
  human::SkinnedMesh ball = Sphere(glm::vec3(0.5f));
  stage::Prop prop;
  prop.name = "ball";
  prop.parts.emplace_back().name = "ball";
  stage::PropMesh& mesh = prop.parts[0].meshes.emplace_back();
  mesh.positions = ball.positions;
  mesh.normals = ball.normals;
  mesh.albedo = ball.albedo;
  mesh.indices = ball.indices;
  const ModelHandle model = renderer_->AddProp(Shared(prop)).value();
  std::array<glm::mat4, 2> stage_from_prop;
  const std::array<SceneProp, 2> props = {
      SceneProp{.prop = model, .stage_from_part = {&stage_from_prop[0], 1}},
      SceneProp{.prop = model, .stage_from_part = {&stage_from_prop[1], 1}}};
  const auto place = [&](size_t index, const glm::vec3& at) {
    stage_from_prop[index] = glm::mat4(glm::mat3(0.15f));
    stage_from_prop[index][3] = glm::vec4(at, 1.0f);
  };
  scene_.props = props;
  place(0, {0.0f, 0.8f, -0.4f});
  place(1, {0.3f, 0.6f, 0.5f});
  const auto expect_as_alone = [&](const std::string& when) {
    const cv::Mat picture = Draw();
    // Removing a model discards everything that is kept.
    renderer_->RemoveModel(renderer_->AddProp(Shared(prop)).value());
    EXPECT_EQ(cv::norm(Draw(), picture, cv::NORM_INF), 0.0) << when;
  };
  const cv::Mat first = Draw();
  EXPECT_EQ(cv::norm(Draw(), first, cv::NORM_INF), 0.0) << "all stand";
  EXPECT_EQ(cv::norm(Draw(), first, cv::NORM_INF), 0.0) << "as kept";
  PlaceBall({-0.7f, 1.0f, 0.3f}, 0.2f);
  expect_as_alone("the person has moved");
  Draw();
  place(0, {0.1f, 0.8f, -0.3f});
  expect_as_alone("one thing has moved");
  Draw();
  Draw();
  scene_.props = std::span(props).first(1);
  expect_as_alone("the other is gone");
}

// A sun of angular radius a gives a penumbra of width 2 d tan(a) behind an edge at distance d.
TEST_F(SunTest, PenumbraGrowsWithDistanceByTheAngularRadius) {
  for (const double height : {0.5, 1.5}) {
    const float angular_radius = 0.03f;
    scene_.sun = light::Sun{glm::vec3(0.0f, 1.0f, 0.0f), glm::vec3(3.0f), angular_radius};
    // The edge that casts the shadow is half a metre from the middle of the ball. The camera looks
    // from the side, because from above the ball would hide its shadow.
    PlaceBall({0.0f, static_cast<float>(height), 0.0f}, 0.5f);
    scene_.camera_from_stage = LookAt(Eigen::Vector3d(6.0, 5.0, 0.0),
                                      Eigen::Vector3d(0.6, 0.0, 0.0), Eigen::Vector3d::UnitY());
    const cv::Mat picture = Draw();
    const auto edge = [&](double share) {
      for (double x = 0.2; x < 1.2; x += 0.001) {
        const Eigen::Vector2d pixel =
            *scene_.display.Project(*scene_.camera_from_stage * Eigen::Vector3d(x, 0.0, 0.0));
        const cv::Vec3b colour = picture.at<cv::Vec3b>(static_cast<int>(std::lround(pixel.y())),
                                                       static_cast<int>(std::lround(pixel.x())));
        const double kept = LinearFromSrgb(colour[1] / 255.0) / LinearFromSrgb(kGrey / 255.0);
        if (colour[0] == colour[2] && kept > 0.25 + 0.75 * share && kept <= 1.0) {
          return x;
        }
      }
      return 0.0;
    };
    // A straight edge in front of a disc leaves a tenth of it visible at -0.687 of the radius, and
    // nine tenths at 0.687.
    const double width = edge(0.9) - edge(0.1);
    EXPECT_NEAR(edge(0.5), 0.5, 0.03) << height;
    EXPECT_NEAR(width, 2.0 * 0.687 * height * std::tan(angular_radius), 0.3 * height * 0.03)
        << height;
  }
}

TEST_F(SunTest, WhereRealThingsShadeAlreadyPeopleDoNotAgain) {
  scene_.sun = light::Sun{glm::normalize(glm::vec3(-1.0f, 1.0f, 0.0f)),
                          glm::vec3(3.0f * std::sqrt(2.0f)), 0.0005f};
  PlaceBall({-0.1f, 1.0f, 0.0f}, 0.2f);
  // A roof outside the picture, towards the sun, over half of the floor.
  occluders_.push_back({.mesh = renderer_->AddMesh(
                            Quad({-6.0f, 4.0f, -2.0f}, {4.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 4.0f}))});
  scene_.occluders = occluders_;
  const cv::Mat picture = Draw();
  // The roof's shadow ends at x = 2 and covers the whole picture.
  EXPECT_EQ(Kept(picture, 0.9, 0.0), 1.0);
}

TEST_F(SunTest, PeopleAreLitByTheSunAndNotInTheShadowOfThings) {
  scene_.light = EvenSky(0.5f);
  scene_.sun = light::Sun{glm::vec3(0.0f, 1.0f, 0.0f), glm::vec3(1.0f), 0.005f};
  PlaceBall({0.0f, 1.0f, 0.0f}, 0.3f);
  scene_.matte = true;
  cv::Mat rgba;
  ASSERT_TRUE(renderer_->DrawLinear(scene_, rgba).ok());
  // The top of the ball: white 0.5 under sky and sun.
  EXPECT_NEAR(rgba.at<cv::Vec4f>(kSunHeight / 2, kSunWidth / 2)[0], 0.5f / kPiF * 1.5f, 0.003f);
  occluders_.push_back({.mesh = renderer_->AddMesh(
                            Quad({-2.0f, 9.0f, -2.0f}, {4.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 4.0f}))});
  scene_.occluders = occluders_;
  ASSERT_TRUE(renderer_->DrawLinear(scene_, rgba).ok());
  EXPECT_NEAR(rgba.at<cv::Vec4f>(kSunHeight / 2, kSunWidth / 2)[0], 0.5f / kPiF * 0.5f, 0.003f);
}

TEST_F(SunTest, PeopleShadeEachOther) {
  scene_.sun = light::Sun{glm::vec3(0.0f, 1.0f, 0.0f), glm::vec3(1.0f), 0.002f};
  scene_.light = EvenSky(0.5f);
  scene_.matte = true;
  std::vector<SceneHuman> two = {human_, human_};
  two[0].stage_from_actor = glm::mat4(glm::mat3(0.4f));
  two[0].stage_from_actor[3] = glm::vec4(0.0f, 0.5f, 0.0f, 1.0f);
  two[1].stage_from_actor = glm::mat4(glm::mat3(0.2f));
  // The second person is above the camera, so that it hides nothing.
  two[1].stage_from_actor[3] = glm::vec4(0.0f, 9.0f, 0.0f, 1.0f);
  scene_.humans = two;
  cv::Mat rgba;
  ASSERT_TRUE(renderer_->DrawLinear(scene_, rgba).ok());
  EXPECT_NEAR(rgba.at<cv::Vec4f>(kSunHeight / 2, kSunWidth / 2)[0], 0.5f / kPiF * 0.5f, 0.003f);
  // The sun is visible beside that shadow.
  const float sine = 0.3f / 0.4f;
  const float cosine = std::sqrt(1.0f - sine * sine);
  const int aside = static_cast<int>(0.3 * 8.0 * kPixelsPerMetre /
                                     (8.0 - 0.5 - 0.4 * static_cast<double>(cosine)));
  EXPECT_NEAR(rgba.at<cv::Vec4f>(kSunHeight / 2, kSunWidth / 2 + aside)[0],
              0.5f / kPiF * (0.5f + cosine), 0.01f);
}

}  // namespace
}  // namespace lararium::render
