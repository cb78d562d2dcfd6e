// OpenGL ES 3.0 draws the same pictures as OpenGL 3.3.

#include <gtest/gtest.h>

#include <numbers>
#include <utility>
#include <vector>

#include "shared/render/quality.h"
#include "shared/show/show_renderer.h"
#include "tests/golden/compare_images.h"
#include "tests/render/gl_fixture.h"
#include "tests/render/test_people.h"

namespace lararium::show {
namespace {

constexpr geometry::CameraModel kCamera{320, 240, 300.0, 300.0, 159.5, 119.5, -0.08, 0.02};

geometry::TriangleMesh Square(const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v) {
  return {.positions = {corner, corner + u, corner + u + v, corner + v},
          .normals = {},
          .indices = {0, 1, 2, 0, 2, 3}};
}

// A place with a noisy, soft camera: floor and wall receive shadows, and a pillar occludes.
stage::Place Yard() {
  stage::Place yard;
  yard.occluders = {
      {"floor", Square({-9.0f, -1.5f, 0.0f}, {18.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -12.0f}), {}},
      {"wall", Square({-9.0f, -1.5f, -7.0f}, {18.0f, 0.0f, 0.0f}, {0.0f, 9.0f, 0.0f}), {}},
      {"pillar", Square({0.6f, -1.5f, -3.0f}, {0.3f, 0.0f, 0.0f}, {0.0f, 9.0f, 0.0f}), {}}};
  yard.camera = light::CameraTraits{
      .width = kCamera.width, .noise_floor = 0.01f, .noise_slope = 0.0004f, .blur_px = 0.7f};
  return yard;
}

// Two balls lit by sun, sky and a lamp.
StagedFrame Noon(const std::shared_ptr<const human::Human>& ball) {
  StagedFrame staged;
  light::ProbeLight light;
  light.sky[0] = glm::vec3(0.5f, 0.6f, 0.8f) * 2.0f * std::sqrt(std::numbers::pi_v<float>);
  light.sky[1] = glm::vec3(0.2f);
  light.sun = light::Sun{glm::normalize(glm::vec3(0.4f, 1.0f, 0.3f)), glm::vec3(2.0f, 1.8f, 1.5f)};
  staged.light.surfaces = light;
  staged.things.lamps = {{{1.5f, 0.5f, -4.0f}, glm::vec3(0.9f, 0.6f, 0.3f)}};
  staged.people.actors.resize(2);
  for (StagedActor& actor : staged.people.actors) {
    actor.figure = ball;
    actor.skin_count = 1;
    actor.light = light;
  }
  staged.people.actors[0].stage_from_actor[3] = glm::vec4(-1.0f, -0.5f, -5.0f, 1.0f);
  staged.people.actors[1].stage_from_actor[3] = glm::vec4(1.1f, -0.3f, -4.5f, 1.0f);
  staged.light.blockers = {{-1.0f, -0.5f, -5.0f, 1.0f}, {1.1f, -0.3f, -4.5f, 1.0f}};
  staged.people.skin = {glm::mat4(1.0f)};
  staged.camera.camera_from_stage = geometry::Rigid3{{0.0, 1.0, 0.0, 0.0}, Eigen::Vector3d::Zero()};
  staged.tracked.camera = kCamera;
  cv::Mat& image = staged.tracked.frame.bgr;
  image.create(kCamera.height, kCamera.width, CV_8UC3);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      image.at<cv::Vec3b>(y, x) =
          cv::Vec3b(static_cast<uint8_t>(90 + x / 4), static_cast<uint8_t>(120 + y / 4),
                    static_cast<uint8_t>((x / 16 + y / 16) % 2 * 60 + 100));
    }
  }
  return staged;
}

class GraphicsApisTest : public render::GlTest {
 protected:
  // Draws the same moment at every level of quality, slightly larger than the camera's image.
  std::vector<cv::Mat> DrawWith(render::GraphicsApi api) {
    Open(api);
    const auto ball = render::Shared(render::MakeHuman(render::Sphere(glm::vec3(0.6f)), 1));
    ShowContent content;
    content.cast = {{"ball", ball}};
    content.places.push_back({Yard(), nullptr});
    auto renderer = ShowRenderer::Create(content);
    EXPECT_TRUE(renderer.ok()) << renderer.message();
    const render::RenderTarget target = MakeTarget(400, 300);
    const StagedFrame staged = Noon(ball);
    std::vector<cv::Mat> pictures;
    for (const render::Quality& quality : render::QualityLadder()) {
      (*renderer)->SetQuality(quality);
      const Status drawn = (*renderer)->Draw(staged, target);
      EXPECT_TRUE(drawn.ok()) << drawn.message();
      pictures.push_back(Read(target));
    }
    return pictures;
  }
};

TEST_F(GraphicsApisTest, DrawTheSamePictureAtEveryLevelOfQuality) {
  const std::vector<cv::Mat> desktop = DrawWith(render::GraphicsApi::kOpenGl33);
  const std::vector<cv::Mat> embedded = DrawWith(render::GraphicsApi::kOpenGlEs30);
  ASSERT_EQ(desktop.size(), embedded.size());
  for (size_t level = 0; level < desktop.size(); ++level) {
    cv::Scalar mean, deviation;
    cv::meanStdDev(desktop[level], mean, deviation);
    EXPECT_GT(deviation[0], 20.0) << "there is something to compare";
    // Mesa's software renderer (22.3.6) draws both identically; other compilers may differ.
    EXPECT_TRUE(test::ImagesAgree(embedded[level], desktop[level], {.max = 4.0, .mean = 0.05}))
        << level;
  }
}

}  // namespace
}  // namespace lararium::show
