// Draws a composite off screen. Budget: 16 ms at 1280x720 on a GPU; with software rendering (Mesa's
// llvmpipe) there is no budget.

#include <benchmark/benchmark.h>
#include <epoxy/gl.h>

#include <array>

#include "shared/core/random.h"
#include "shared/render/clip_space.h"
#include "shared/render/gl/graphics_context.h"
#include "shared/render/overlay.h"
#include "shared/render/renderer.h"
#include "tests/render/test_people.h"

namespace lararium::render {
namespace {

geometry::CameraModel Pinhole(int width, int height) {
  return {.width = width,
          .height = height,
          .fx = 0.9 * width,
          .fy = 0.9 * width,
          .cx = 0.5 * (width - 1),
          .cy = 0.5 * (height - 1)};
}

// A background with lens distortion, one occluder, one person of 8000 vertices and 64 joints that
// fills a fifth of the height. Arguments: width, height, samples.
void BenchRendererDraw(benchmark::State& state) {
  const int width = static_cast<int>(state.range(0));
  const int height = static_cast<int>(state.range(1));
  const auto context = CreateOffscreenContext();
  if (!context.ok()) {
    state.SkipWithError(context.message().c_str());
    return;
  }
  auto renderer = Renderer::Create({.samples = static_cast<int>(state.range(2))}).value();
  const RenderTarget target = RenderTarget::Create(width, height).value();
  const ModelHandle ball =
      renderer->AddHuman(Shared(MakeHuman(Sphere(glm::vec3(0.5f)), 64))).value();
  const MeshHandle wall =
      renderer->AddMesh({.positions = {{0, -1, -5}, {2, -1, -5}, {2, 1, -5}, {0, 1, -5}},
                         .normals = {},
                         .indices = {0, 1, 2, 0, 2, 3}});
  const std::vector<glm::mat4> skin(64, glm::mat4(1.0f));
  const SceneOccluder occluder = {.mesh = wall};
  SceneHuman human = {.human = ball, .skin = skin};
  human.stage_from_actor[3] = glm::vec4(0.0f, 0.0f, -9.0f, 1.0f);

  RenderScene scene;
  scene.background = cv::Mat(height, width, CV_8UC3, cv::Scalar(60, 90, 120));
  scene.camera = Pinhole(width, height);
  scene.camera.k1 = -0.1;
  scene.display = scene.camera.DisplayPinhole();
  scene.camera_from_stage =
      LookAt(Eigen::Vector3d::Zero(), -Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitY());
  scene.occluders = {&occluder, 1};
  scene.humans = {&human, 1};
  scene.light[0] = glm::vec3(1.0f);
  for (auto _ : state) {
    if (const Status drawn = renderer->Draw(scene, target); !drawn.ok()) {
      state.SkipWithError(drawn.message().c_str());
      return;
    }
    glFinish();
  }
  state.SetLabel(GraphicsDeviceName());
}
BENCHMARK(BenchRendererDraw)
    ->Args({640, 480, 1})
    ->Args({640, 480, 4})
    ->Args({1280, 720, 1})
    ->Args({1280, 720, 4})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

void BenchReadPixels(benchmark::State& state) {
  const auto context = CreateOffscreenContext();
  if (!context.ok()) {
    state.SkipWithError(context.message().c_str());
    return;
  }
  const RenderTarget target =
      RenderTarget::Create(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)))
          .value();
  cv::Mat bgr;
  for (auto _ : state) {
    target.ReadPixels(bgr);
  }
}
BENCHMARK(BenchReadPixels)->Args({640, 480})->Args({1280, 720})->Unit(benchmark::kMillisecond);

// The editor's point cloud. Argument: number of points.
void BenchOverlayPoints(benchmark::State& state) {
  const auto context = CreateOffscreenContext();
  if (!context.ok()) {
    state.SkipWithError(context.message().c_str());
    return;
  }
  const auto overlay = Overlay::Create().value();
  const RenderTarget target =
      RenderTarget::Create(1280, 720, RenderTarget::Depth::kForOverlay).value();
  std::vector<OverlayPoint> points(static_cast<size_t>(state.range(0)));
  Random random(1);
  for (OverlayPoint& point : points) {
    point.position =
        glm::vec3{random.Uniform(-2, 2), random.Uniform(-1, 1), random.Uniform(-9, -3)};
  }
  OverlayView view;
  view.display = Pinhole(1280, 720);
  view.camera_from_stage =
      LookAt(Eigen::Vector3d::Zero(), -Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitY());
  view.clear = glm::vec3(0.1f);
  const PointsHandle uploaded = overlay->AddPoints(points);
  for (auto _ : state) {
    overlay->Begin(view, target);
    if (!overlay->DrawPoints(uploaded, points.size(), 3.0f).ok()) {
      state.SkipWithError("the points cannot be drawn");
      return;
    }
    overlay->End();
    glFinish();
  }
}
BENCHMARK(BenchOverlayPoints)->Arg(100'000)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lararium::render
