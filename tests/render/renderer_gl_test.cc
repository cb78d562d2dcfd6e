#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "shared/core/random.h"
#include "shared/core/srgb.h"
#include "shared/core/units.h"
#include "shared/geometry/glm_convert.h"
#include "shared/human/skinning.h"
#include "shared/render/clip_space.h"
#include "shared/render/renderer.h"
#include "tests/golden/compare_images.h"
#include "tests/render/gl_fixture.h"
#include "tests/render/test_people.h"

namespace lararium::render {
namespace {

using ::testing::HasSubstr;

geometry::CameraModel Pinhole(int width, int height, double focal) {
  return {.width = width,
          .height = height,
          .fx = focal,
          .fy = focal,
          .cx = 0.5 * (width - 1),
          .cy = 0.5 * (height - 1)};
}

cv::Mat NoiseImage(int width, int height, uint64_t seed) {
  cv::Mat image(height, width, CV_8UC3);
  Random random(seed);
  for (int i = 0; i < 3 * width * height; ++i) {
    image.data[i] = static_cast<uint8_t>(random.Below(256));
  }
  return image;
}

cv::Mat SmoothImage(int width, int height, uint64_t seed) {
  cv::Mat image;
  cv::GaussianBlur(NoiseImage(width, height, seed), image, cv::Size(), 4.0);
  cv::normalize(image, image, 0, 255, cv::NORM_MINMAX);
  return image;
}

// A wall at depth z in front of the camera, from x = left to right.
geometry::TriangleMesh Wall(float left, float right, float z) {
  return {.positions = {{left, -9.0f, z}, {right, -9.0f, z}, {right, 9.0f, z}, {left, 9.0f, z}},
          .normals = {},
          .indices = {0, 1, 2, 0, 2, 3}};
}

// A uniform light. If highlights are clipped, irradiance kPiF makes a white surface white.
light::ShRgb UniformLight(float irradiance) {
  light::ShRgb light = {};
  light[0] = glm::vec3(irradiance / kPiF / 0.28209479f);
  return light;
}

class RendererTest : public GlTest {
 protected:
  void SetUp() override {
    GlTest::SetUp();
    Recreate({});
  }
  void Recreate(const Quality& quality) {
    auto renderer = Renderer::Create(quality);
    ASSERT_TRUE(renderer.ok()) << renderer.message();
    renderer_ = std::move(renderer).value();
  }
  cv::Mat Draw(const RenderScene& scene, int width, int height) {
    const RenderTarget target = MakeTarget(width, height);
    const Status drawn = renderer_->Draw(scene, target);
    EXPECT_TRUE(drawn.ok()) << drawn.message();
    return Read(target);
  }

  std::unique_ptr<Renderer> renderer_;
};

// camera_from_stage of a camera at the origin that looks along -Z.
geometry::Rigid3 LookAlongMinusZ() {
  return LookAt(Eigen::Vector3d::Zero(), -Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitY());
}

TEST_F(RendererTest, BackgroundPassesThroughUnchanged) {
  for (const int samples : {1, 4}) {
    Recreate({.samples = samples});
    RenderScene scene;
    scene.background = NoiseImage(320, 200, 1);
    scene.camera = scene.display = Pinhole(320, 200, 300.0);
    EXPECT_TRUE(
        test::ImagesAgree(Draw(scene, 320, 200), scene.background, {.max = 1.0, .mean = 0.01}))
        << samples << " samples";
  }
}

// A person that is nearly invisible forces the composite to convert every pixel.
TEST_F(RendererTest, EverySrgbValueSurvivesTheRoundTrip) {
  const glm::mat4 skin(1.0f);
  SceneHuman human = {
      .human = renderer_->AddHuman(Shared(MakeHuman(Sphere(glm::vec3(0.5f)), 1))).value(),
      .skin = {&skin, 1}};
  human.stage_from_actor = glm::scale(glm::mat4(1.0f), glm::vec3(50.0f));
  human.stage_from_actor[3] = glm::vec4(0.0f, 0.0f, -55.0f, 1.0f);
  RenderScene scene;
  scene.background.create(16, 256, CV_8UC3);
  for (int x = 0; x < 256; ++x) {
    scene.background.col(x).setTo(cv::Scalar(x, 255 - x, (x * 7) % 256));
  }
  scene.camera = scene.display = Pinhole(256, 16, 300.0);
  scene.camera_from_stage = LookAlongMinusZ();
  scene.light = UniformLight(kPiF);
  scene.humans = {&human, 1};
  scene.people_opacity = 1e-5f;
  EXPECT_TRUE(test::ImagesAgree(Draw(scene, 256, 16), scene.background, {.max = 0, .mean = 0}));
  scene.people_opacity = 1.0f;
  EXPECT_FALSE(test::ImagesAgree(Draw(scene, 256, 16), scene.background, {.max = 50, .mean = 5}))
      << "nobody is there";
}

TEST_F(RendererTest, DistortedBackgroundEqualsUndistortedReference) {
  geometry::CameraModel camera = Pinhole(320, 240, 260.0);
  camera.fy = 262.0;
  camera.cx = 163.7;
  camera.cy = 117.2;
  camera.k1 = -0.21;
  camera.k2 = 0.05;
  camera.p1 = 0.002;
  camera.p2 = -0.003;
  ASSERT_TRUE(camera.Validate().ok());
  RenderScene scene;
  scene.background = SmoothImage(320, 240, 2);
  scene.camera = camera;
  scene.display = camera.DisplayPinhole();

  // cv::undistort interpolates encoded values; here linear light is interpolated.
  cv::Mat linear(240, 320, CV_32FC3);
  for (int i = 0; i < 3 * 320 * 240; ++i) {
    linear.ptr<float>()[i] = static_cast<float>(LinearFromSrgb(scene.background.data[i] / 255.0));
  }
  const auto matrix = [](const geometry::CameraModel& c) {
    return cv::Matx33d(c.fx, 0, c.cx, 0, c.fy, c.cy, 0, 0, 1);
  };
  cv::Mat undistorted;
  cv::undistort(linear, undistorted, matrix(camera),
                cv::Vec4d(camera.k1, camera.k2, camera.p1, camera.p2), matrix(scene.display));
  cv::Mat expected(240, 320, CV_8UC3);
  for (int i = 0; i < 3 * 320 * 240; ++i) {
    expected.data[i] =
        cv::saturate_cast<uint8_t>(255.0 * SrgbFromLinear(undistorted.ptr<float>()[i]));
  }
  // cv::undistort rounds coordinates to 1/32 pixel and leaves the border black.
  const cv::Rect inner(2, 2, 316, 236);
  for (const bool by_shaders : {true, false}) {
    renderer_->SetQuality({.camera_look = by_shaders});
    EXPECT_TRUE(test::ImagesAgree(Draw(scene, 320, 240)(inner).clone(), expected(inner).clone(),
                                  {.max = 4.0, .mean = 0.3}))
        << (by_shaders ? "by shaders" : "by the processor");
  }
}

TEST_F(RendererTest, BackgroundScalesToATargetOfAnotherSize) {
  RenderScene scene;
  scene.background = SmoothImage(320, 240, 3);
  scene.camera = scene.display = Pinhole(320, 240, 300.0);
  cv::Mat expected;
  cv::resize(scene.background, expected, cv::Size(640, 480), 0, 0, cv::INTER_LINEAR);
  EXPECT_TRUE(test::ImagesAgree(Draw(scene, 640, 480), expected, {.max = 4.0, .mean = 0.5}));
}

TEST_F(RendererTest, PointsLandOnThePixelThatTheCameraModelSays) {
  Recreate({.samples = 1});
  const geometry::CameraModel display = {
      .width = 200, .height = 150, .fx = 180.0, .fy = 175.0, .cx = 93.4, .cy = 81.7};
  const geometry::Rigid3 camera_from_stage = LookAt(
      Eigen::Vector3d(0.4, 1.7, 2.5), Eigen::Vector3d(0.1, 1.0, -1.0), Eigen::Vector3d::UnitY());
  const ModelHandle ball =
      renderer_->AddHuman(Shared(MakeHuman(Sphere(glm::vec3(1.0f)), 1))).value();
  const glm::mat4 skin(1.0f);
  Random random(5);
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector3d point{random.Uniform(-0.8, 0.8), random.Uniform(0.5, 1.8),
                                random.Uniform(-2.0, 0.5)};
    const Eigen::Vector3d in_camera = camera_from_stage * point;
    const Eigen::Vector2d pixel = *display.Project(in_camera);
    if (!display.Contains(pixel + Eigen::Vector2d::Constant(4)) ||
        !display.Contains(pixel - Eigen::Vector2d::Constant(4))) {
      continue;
    }
    // The centroid of a ball with a radius of three pixels is the pixel of the point.
    const double radius = 3.0 * in_camera.z() / display.Focal();
    SceneHuman human;
    human.human = ball;
    human.skin = {&skin, 1};
    human.stage_from_actor =
        geometry::ToGlm(geometry::Similarity3{radius, Eigen::Quaterniond::Identity(), point});
    RenderScene scene;
    scene.display = display;
    scene.camera_from_stage = camera_from_stage;
    scene.humans = {&human, 1};
    scene.light = UniformLight(kPiF);
    scene.knee = 1.0f;
    cv::Mat grey;
    cv::cvtColor(Draw(scene, display.width, display.height), grey, cv::COLOR_BGR2GRAY);
    const cv::Moments moments = cv::moments(grey, true);
    ASSERT_GT(moments.m00, 10.0) << "seed 5, point " << i;
    EXPECT_NEAR(moments.m10 / moments.m00, pixel.x(), 0.3) << "seed 5, point " << i;
    EXPECT_NEAR(moments.m01 / moments.m00, pixel.y(), 0.3) << "seed 5, point " << i;
  }
}

TEST_F(RendererTest, OccludersHideWhatIsBehindAndShowTheBackground) {
  const ModelHandle ball =
      renderer_->AddHuman(Shared(MakeHuman(Sphere(glm::vec3(1.0f)), 1))).value();
  const MeshHandle wall = renderer_->AddMesh(Wall(0.0f, 9.0f, -3.0f));
  const glm::mat4 skin(1.0f);
  RenderScene scene;
  scene.background = cv::Mat(200, 200, CV_8UC3, cv::Scalar(40, 90, 20));
  scene.camera = scene.display = Pinhole(200, 200, 200.0);
  scene.camera_from_stage = LookAlongMinusZ();
  scene.light = UniformLight(kPiF);
  scene.knee = 1.0f;
  const SceneOccluder occluder = {.mesh = wall};
  scene.occluders = {&occluder, 1};
  SceneHuman human = {.human = ball, .skin = {&skin, 1}};
  scene.humans = {&human, 1};

  human.stage_from_actor[3] = glm::vec4(0.0f, 0.0f, -5.0f, 1.0f);  // behind the wall
  cv::Mat picture = Draw(scene, 200, 200);
  EXPECT_EQ(picture.at<cv::Vec3b>(100, 80), cv::Vec3b(255, 255, 255));
  EXPECT_EQ(picture.at<cv::Vec3b>(100, 120), cv::Vec3b(40, 90, 20));
  human.stage_from_actor[3] = glm::vec4(0.0f, 0.0f, -1.9f, 1.0f);  // before the wall
  picture = Draw(scene, 200, 200);
  EXPECT_EQ(picture.at<cv::Vec3b>(100, 80), cv::Vec3b(255, 255, 255));
  EXPECT_EQ(picture.at<cv::Vec3b>(100, 120), cv::Vec3b(255, 255, 255));
}

TEST_F(RendererTest, WithoutAPoseOnlyTheBackgroundIsDrawn) {
  const ModelHandle ball =
      renderer_->AddHuman(Shared(MakeHuman(Sphere(glm::vec3(1.0f)), 1))).value();
  const glm::mat4 skin(1.0f);
  RenderScene scene;
  scene.background = NoiseImage(120, 90, 6);
  scene.camera = scene.display = Pinhole(120, 90, 100.0);
  scene.light = UniformLight(kPiF);
  scene.knee = 1.0f;
  SceneHuman human = {.human = ball, .skin = {&skin, 1}};
  human.stage_from_actor[3] = glm::vec4(0.0f, 0.0f, -3.0f, 1.0f);
  scene.humans = {&human, 1};
  scene.camera_from_stage = LookAlongMinusZ();
  EXPECT_FALSE(test::ImagesAgree(Draw(scene, 120, 90), scene.background, {.max = 1, .mean = 0.01}));
  scene.camera_from_stage.reset();
  EXPECT_TRUE(test::ImagesAgree(Draw(scene, 120, 90), scene.background, {.max = 1, .mean = 0.01}));
}

TEST_F(RendererTest, SkinningEqualsTheCpu) {
  human::Human bent = MakeHuman(BendingBox(glm::vec3(0.7f, 0.5f, 0.3f)), 3);
  const float angle = 0.9f;
  const geometry::Similarity3 turned = {1.0, geometry::RotationFromVector({0.0, 0.2, angle}),
                                        Eigen::Vector3d(0.3, -0.1, 0.1)};
  const geometry::Similarity3 moved = {1.2, geometry::RotationFromVector({0.1, 0.0, 0.3}),
                                       Eigen::Vector3d(-0.1, 0.2, 0.0)};
  const std::array<glm::mat4, 3> skin = {glm::mat4(1.0f), geometry::ToGlm(turned),
                                         geometry::ToGlm(moved)};
  human::Human still = bent;
  human::SkinMesh(bent.meshes[0], skin, still.meshes[0].positions, still.meshes[0].normals);
  const std::array<glm::mat4, 3> rest = {glm::mat4(1.0f), glm::mat4(1.0f), glm::mat4(1.0f)};

  RenderScene scene;
  scene.display = Pinhole(200, 200, 180.0);
  scene.camera_from_stage = LookAt(Eigen::Vector3d(1.0, 1.4, 3.0), Eigen::Vector3d(0.0, 1.0, 0.0),
                                   Eigen::Vector3d::UnitY());
  scene.light = UniformLight(2.0f);
  scene.light[1] = glm::vec3(0.4f, 0.2f, 0.1f);
  scene.light[3] = glm::vec3(0.1f, 0.3f, 0.4f);
  SceneHuman human = {.human = renderer_->AddHuman(Shared(bent)).value(), .skin = skin};
  scene.humans = {&human, 1};
  const cv::Mat on_gpu = Draw(scene, 200, 200);
  human = {.human = renderer_->AddHuman(Shared(still)).value(), .skin = rest};
  const cv::Mat on_cpu = Draw(scene, 200, 200);
  EXPECT_GT(cv::countNonZero(on_cpu.reshape(1)), 3000);
  EXPECT_TRUE(test::ImagesAgree(on_gpu, on_cpu, {.max = 2.0, .mean = 0.01}));
}

TEST_F(RendererTest, SphereIsLitByTheAnalyticIrradiance) {
  const glm::vec3 albedo(0.8f, 0.5f, 0.3f);
  const ModelHandle ball = renderer_->AddHuman(Shared(MakeHuman(Sphere(albedo), 1))).value();
  const glm::mat4 skin(1.0f);
  RenderScene scene;
  scene.display = Pinhole(240, 240, 400.0);
  scene.camera_from_stage = LookAlongMinusZ();
  Random random(9);
  scene.light = UniformLight(1.5f);
  for (int i = 1; i < light::kPlainShCount; ++i) {
    scene.light[i] =
        glm::vec3{random.Uniform(-0.3, 0.3), random.Uniform(-0.3, 0.3), random.Uniform(-0.3, 0.3)};
  }
  scene.exposure = 2.0f;
  scene.gain = glm::vec3(1.5f, 0.9f, 1.0f);
  // The actor is rotated, but light must stay in the stage's axes.
  SceneHuman human = {.human = ball, .skin = {&skin, 1}};
  const Eigen::Vector3d centre(0.0, 0.0, -4.0);
  human.stage_from_actor =
      geometry::ToGlm(geometry::Rigid3{geometry::RotationFromVector({0.3, 1.0, -0.4}), centre});
  scene.humans = {&human, 1};
  const cv::Mat picture = Draw(scene, 240, 240);

  int compared = 0;
  int beyond_knee = 0;
  for (int y = 30; y < 210; y += 7) {
    for (int x = 30; x < 210; x += 7) {
      // The sphere's near point on the pixel's ray, camera axes turned to the stage's.
      const Eigen::Vector2d plane = scene.display.PlaneFromPixel({x, y});
      const Eigen::Vector3d ray = Eigen::Vector3d(plane.x(), -plane.y(), -1.0).normalized();
      const double along = ray.dot(centre);
      const double square = along * along - centre.squaredNorm() + 1.0;
      if (square < 0.1) {
        continue;
      }
      const Eigen::Vector3d normal = ray * (along - std::sqrt(square)) - centre;
      const glm::vec3 irradiance =
          light::EvaluateIrradiance(scene.light, geometry::ToGlm(normal.normalized()));
      for (int c = 0; c < 3; ++c) {
        double radiance = albedo[c] / kPiF * irradiance[c] * scene.exposure * scene.gain[c];
        if (radiance > scene.knee) {
          const double range = 1.0 - scene.knee;
          radiance = scene.knee + range * (1.0 - std::exp(-(radiance - scene.knee) / range));
          ++beyond_knee;
        }
        EXPECT_NEAR(picture.at<cv::Vec3b>(y, x)[2 - c],
                    255.0 * SrgbFromLinear(std::min(radiance, 1.0)), 1.2)
            << "seed 9, pixel " << x << ", " << y;
      }
      ++compared;
    }
  }
  EXPECT_GT(compared, 300);
  EXPECT_GT(beyond_knee, 20);
}

TEST_F(RendererTest, LinearPictureHoldsRadianceWithoutTheCamerasResponse) {
  const glm::vec3 albedo(0.8f, 0.5f, 0.3f);
  const ModelHandle ball = renderer_->AddHuman(Shared(MakeHuman(Sphere(albedo), 1))).value();
  const glm::mat4 skin(1.0f);
  RenderScene scene;
  scene.display = Pinhole(160, 120, 200.0);
  scene.camera_from_stage = LookAlongMinusZ();
  scene.light = UniformLight(20.0f);
  scene.exposure = 0.1f;
  scene.gain = glm::vec3(3.0f);
  SceneHuman human = {.human = ball, .skin = {&skin, 1}};
  human.stage_from_actor[3] = glm::vec4(-1.0f, 0.5f, -4.0f, 1.0f);
  scene.humans = {&human, 1};
  cv::Mat rgba;
  const Status drawn = renderer_->DrawLinear(scene, rgba);
  ASSERT_TRUE(drawn.ok()) << drawn.message();
  ASSERT_EQ(rgba.size(), cv::Size(160, 120));
  ASSERT_EQ(rgba.type(), CV_32FC4);
  // The centre of the ball is to the left of the middle and above it.
  const auto middle = rgba.at<cv::Vec4f>(60 - 25, 80 - 50);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(middle[c], albedo[c] / kPiF * 20.0f, 0.01f);
  }
  EXPECT_EQ(middle[3], 1.0f);
  EXPECT_EQ(rgba.at<cv::Vec4f>(60, 120), cv::Vec4f::all(0.0f));
  EXPECT_EQ(rgba.at<cv::Vec4f>(60 + 40, 80 - 50), cv::Vec4f::all(0.0f));
  // Edges average the samples, so their colour is proportional to coverage.
  int partly = 0;
  for (int x = 0; x < 160; ++x) {
    const auto pixel = rgba.at<cv::Vec4f>(70, x);
    partly += pixel[3] > 0.0f && pixel[3] < 1.0f ? 1 : 0;
    EXPECT_NEAR(pixel[0], pixel[3] * albedo[0] / kPiF * 20.0f, 0.02f) << x;
  }
  EXPECT_GE(partly, 1);
  human.stage_from_actor[3] = glm::vec4(0.0f, 0.0f, 9.0f, 1.0f);
  EXPECT_TRUE(renderer_->DrawLinear(scene, rgba).ok());
  EXPECT_EQ(cv::countNonZero(rgba.reshape(1)), 0) << "nobody is in view";
  scene.camera_from_stage.reset();
  EXPECT_THAT(renderer_->DrawLinear(scene, rgba).message(), HasSubstr("pose"));
}

TEST_F(RendererTest, SamplesSmoothTheEdgesOfPeople) {
  const glm::mat4 skin(1.0f);
  const auto count_between = [&](int samples) {
    Recreate({.samples = samples});
    SceneHuman human = {
        .human = renderer_->AddHuman(Shared(MakeHuman(Sphere(glm::vec3(1.0f)), 1))).value(),
        .skin = {&skin, 1}};
    human.stage_from_actor[3] = glm::vec4(0.0f, 0.0f, -4.0f, 1.0f);
    RenderScene scene;
    scene.display = Pinhole(120, 120, 150.0);
    scene.camera_from_stage = LookAlongMinusZ();
    scene.light = UniformLight(kPiF);
    scene.knee = 1.0f;
    scene.humans = {&human, 1};
    cv::Mat between;
    cv::inRange(Draw(scene, 120, 120), cv::Scalar::all(10), cv::Scalar::all(245), between);
    return cv::countNonZero(between);
  };
  EXPECT_EQ(count_between(1), 0);
  EXPECT_GT(count_between(4), 100);
}

TEST_F(RendererTest, APictureThatIsMadeLargerShowsTheSame) {
  const glm::mat4 skin(1.0f);
  SceneHuman human = {
      .human = renderer_->AddHuman(Shared(MakeHuman(Sphere(glm::vec3(0.5f)), 1))).value(),
      .skin = {&skin, 1}};
  human.stage_from_actor[3] = glm::vec4(0.3f, 0.2f, -4.0f, 1.0f);
  RenderScene scene;
  scene.background = SmoothImage(320, 240, 5);
  scene.camera = scene.display = Pinhole(320, 240, 300.0);
  scene.camera.k1 = -0.1;
  scene.camera_from_stage = LookAlongMinusZ();
  scene.light = UniformLight(kPiF);
  scene.humans = {&human, 1};
  const cv::Mat large = Draw(scene, 960, 720);
  const cv::Mat small = Draw(scene, 320, 240);
  renderer_->SetQuality({.full_size = false});
  // Both agree except at edges, which are as soft as the camera's image.
  EXPECT_TRUE(test::ImagesAgree(Draw(scene, 960, 720), large, {.max = 160.0, .mean = 1.0}));
  cv::Mat enlarged;
  cv::resize(small, enlarged, cv::Size(960, 720), 0, 0, cv::INTER_LINEAR);
  EXPECT_TRUE(test::ImagesAgree(Draw(scene, 960, 720), enlarged, {.max = 2.0, .mean = 0.5}));
  EXPECT_TRUE(test::ImagesAgree(Draw(scene, 320, 240), small, {.max = 0.0, .mean = 0.0}))
      << "as fine as the image already";
}

// A white ball over the camera's image, drawn in halves.
class HalfRateTest : public RendererTest {
 protected:
  static constexpr int kWidth = 320, kHeight = 240;

  void SetUp() override {
    RendererTest::SetUp();
    Recreate({.samples = 1, .half_rate = true});
    human_ = {.human = renderer_->AddHuman(Shared(MakeHuman(Sphere(glm::vec3(0.5f)), 1))).value(),
              .skin = {&skin_, 1}};
    human_.stage_from_actor[3] = glm::vec4(0.3f, 0.2f, -6.0f, 1.0f);
    target_.emplace(MakeTarget(kWidth, kHeight));
  }
  RenderScene SceneFrom(const geometry::Rigid3& pose) const {
    RenderScene scene;
    scene.background = background_;
    scene.camera = scene.display = Pinhole(kWidth, kHeight, 300.0);
    scene.camera_from_stage = pose;
    scene.light = UniformLight(kPiF);
    scene.humans = {&human_, 1};
    return scene;
  }
  cv::Mat DrawHalf(Renderer::Half half, const RenderScene& people, const RenderScene& picture) {
    const Status drawn = renderer_->DrawHalf(half, people, picture, *target_);
    EXPECT_TRUE(drawn.ok()) << drawn.message();
    return Read(*target_);
  }
  static geometry::Rigid3 Turned(double radians,
                                 const Eigen::Vector3d& moved = Eigen::Vector3d::Zero()) {
    const geometry::Rigid3 turn = {
        .rotation = Eigen::Quaterniond(Eigen::AngleAxisd(radians, Eigen::Vector3d::UnitY())),
        .translation = moved};
    return turn * LookAlongMinusZ();
  }

  const glm::mat4 skin_ = glm::mat4(1.0f);
  const cv::Mat background_ = SmoothImage(kWidth, kHeight, 5);
  SceneHuman human_;
  std::optional<RenderTarget> target_;
};

TEST_F(HalfRateTest, TwoHalvesAreTheWhole) {
  const RenderScene before = SceneFrom(LookAlongMinusZ());
  SceneHuman moved = human_;
  moved.stage_from_actor[3].x += 1.0f;
  RenderScene later = before;
  later.humans = {&moved, 1};
  const cv::Mat expected = Draw(later, kWidth, kHeight);
  const cv::Mat first = Draw(before, kWidth, kHeight);
  ASSERT_FALSE(test::ImagesAgree(first, expected, {.max = 255.0, .mean = 1.0}));
  EXPECT_TRUE(test::ImagesAgree(DrawHalf(Renderer::Half::kShadows, later, later), first,
                                {.max = 0.0, .mean = 0.0}))
      << "people of before, until the new ones are ready";
  EXPECT_TRUE(test::ImagesAgree(DrawHalf(Renderer::Half::kPeople, later, later), expected,
                                {.max = 0.0, .mean = 0.0}));
}

// A warped layer agrees with a newly drawn picture, except at edges.
TEST_F(HalfRateTest, PeopleAreWhereTheCameraSeesThemNow) {
  const RenderScene before = SceneFrom(LookAlongMinusZ());
  for (const RenderScene& now :
       {SceneFrom(Turned(0.04)), SceneFrom(Turned(-0.03, {0.05, -0.03, 0.1}))}) {
    const cv::Mat anew = Draw(now, kWidth, kHeight);
    Draw(before, kWidth, kHeight);
    ASSERT_TRUE(renderer_->CanCarryLayer(now, *target_));
    const cv::Mat carried = DrawHalf(Renderer::Half::kShadows, before, now);
    const cv::Mat left_behind = Draw(before, kWidth, kHeight);
    EXPECT_FALSE(test::ImagesAgree(left_behind, anew, {.max = 255.0, .mean = 0.6}));
    EXPECT_TRUE(test::ImagesAgree(carried, anew, {.max = 160.0, .mean = 0.15}));
  }
}

TEST_F(HalfRateTest, WhoIsJustOutsideOfThePictureIsThereWhenTheCameraTurns) {
  // The ball ends a few pixels to the left of the picture; the turn brings half of it into view.
  human_.stage_from_actor[3] = glm::vec4(-4.25f, 0.0f, -6.0f, 1.0f);
  const RenderScene before = SceneFrom(LookAlongMinusZ());
  const RenderScene now = SceneFrom(Turned(0.03));
  const cv::Mat anew = Draw(now, kWidth, kHeight);
  ASSERT_GT(cv::norm(anew.col(0), background_.col(0), cv::NORM_INF), 50.0);
  Draw(before, kWidth, kHeight);
  const cv::Mat carried = DrawHalf(Renderer::Half::kShadows, before, now);
  EXPECT_TRUE(test::ImagesAgree(carried, anew, {.max = 160.0, .mean = 0.15}));
}

TEST_F(HalfRateTest, ALayerIsNotCarriedFarOrToAnotherPicture) {
  const RenderScene before = SceneFrom(LookAlongMinusZ());
  EXPECT_FALSE(renderer_->CanCarryLayer(before, *target_)) << "there is none";
  Draw(before, kWidth, kHeight);
  EXPECT_TRUE(renderer_->CanCarryLayer(before, *target_));
  EXPECT_FALSE(renderer_->CanCarryLayer(SceneFrom(Turned(0.2)), *target_));
  EXPECT_FALSE(renderer_->CanCarryLayer(SceneFrom(Turned(3.0)), *target_)) << "behind";
  EXPECT_FALSE(renderer_->CanCarryLayer(before, MakeTarget(kHeight, kHeight)));
  RenderScene other = before;
  other.camera_from_stage.reset();
  EXPECT_FALSE(renderer_->CanCarryLayer(other, *target_));
  other = before;
  other.people_opacity = 0.0f;
  EXPECT_FALSE(renderer_->CanCarryLayer(other, *target_));
  other = before;
  other.display = Pinhole(kWidth, kHeight, 310.0);
  EXPECT_FALSE(renderer_->CanCarryLayer(other, *target_));
  renderer_->SetQuality({.samples = 1, .layer_scale = 0.5f, .half_rate = true});
  EXPECT_FALSE(renderer_->CanCarryLayer(before, *target_)) << "of another size";
}

TEST_F(RendererTest, DrawsSeveralPeopleWithTheirOwnPoses) {
  const ModelHandle ball =
      renderer_->AddHuman(Shared(MakeHuman(Sphere(glm::vec3(1.0f)), 1))).value();
  std::array<glm::mat4, 2> skins = {glm::mat4(1.0f), glm::mat4(1.0f)};
  skins[0][3] = glm::vec4(-2.0f, 0.0f, 0.0f, 1.0f);
  skins[1][3] = glm::vec4(2.0f, 0.0f, 0.0f, 1.0f);
  std::array<SceneHuman, 2> people;
  for (size_t i = 0; i < 2; ++i) {
    people[i] = {.human = ball, .skin = {&skins[i], 1}};
    people[i].stage_from_actor[3] = glm::vec4(0.0f, 0.0f, -8.0f, 1.0f);
  }
  RenderScene scene;
  scene.display = Pinhole(200, 100, 150.0);
  scene.camera_from_stage = LookAlongMinusZ();
  scene.light = UniformLight(kPiF);
  scene.knee = 1.0f;
  scene.humans = people;
  const cv::Mat picture = Draw(scene, 200, 100);
  EXPECT_EQ(picture.at<cv::Vec3b>(50, 62), cv::Vec3b(255, 255, 255));
  EXPECT_EQ(picture.at<cv::Vec3b>(50, 100), cv::Vec3b(0, 0, 0));
  EXPECT_EQ(picture.at<cv::Vec3b>(50, 137), cv::Vec3b(255, 255, 255));
}

TEST_F(RendererTest, SaysWhatIsWrongWithAScene) {
  const RenderTarget target = MakeTarget(64, 48);
  RenderScene scene;
  EXPECT_THAT(renderer_->Draw(scene, target).message(), HasSubstr("display"));
  scene.display = Pinhole(64, 48, 60.0);
  EXPECT_TRUE(renderer_->Draw(scene, target).ok());
  const ModelHandle ball =
      renderer_->AddHuman(Shared(MakeHuman(Sphere(glm::vec3(1.0f)), 2))).value();
  SceneHuman human = {.human = ball};
  scene.humans = {&human, 1};
  EXPECT_THAT(renderer_->Draw(scene, target).message(), HasSubstr("0 skin matrices for 2 joints"));
  renderer_->RemoveModel(ball);
  EXPECT_THAT(renderer_->Draw(scene, target).message(), HasSubstr("removed"));
  scene.humans = {};
  const SceneOccluder occluder;
  scene.occluders = {&occluder, 1};
  EXPECT_THAT(renderer_->Draw(scene, target).message(), HasSubstr("occluder"));
}

}  // namespace
}  // namespace lararium::render
