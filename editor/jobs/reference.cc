#include "editor/jobs/reference.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <memory>
#include <numbers>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "editor/bake/environment.h"
#include "editor/bake/exr_image.h"
#include "editor/bake/path_tracer.h"
#include "editor/bake/posed_surface.h"
#include "editor/bake/probe.h"
#include "editor/bake/sun_split.h"
#include "editor/bake/transfer.h"
#include "editor/jobs/scene_reference.h"
#include "shared/geometry/glm_convert.h"
#include "shared/human/human.h"
#include "shared/human/skinning.h"
#include "shared/render/gl/graphics_context.h"
#include "shared/render/gl/render_target.h"
#include "shared/render/passes/key_light.h"
#include "shared/render/renderer.h"
#include "shared/show/stage_light.h"
#include "shared/vision/photometry.h"

namespace lararium::editor {
namespace {

constexpr float kGroundHalf = 2.0f;  // metres

// The rays of a pinhole camera's pixels.
class Lens {
 public:
  explicit Lens(const ReferenceView& view)
      : pinhole_(view.pinhole),
        eye_(geometry::ToGlm(view.camera_from_stage.Center())),
        stage_from_camera_(glm::conjugate(geometry::ToGlm(view.camera_from_stage.rotation))) {}

  // The intersection of the ray through a pixel's centre with y = 0.
  std::optional<glm::vec3> OnFloor(int column, int row) const {
    const glm::dvec3 in_camera((column - pinhole_.cx) / pinhole_.fx,
                               (row - pinhole_.cy) / pinhole_.fy, 1.0);
    const glm::vec3 direction = stage_from_camera_ * glm::vec3(in_camera);
    const float distance = -eye_.y / direction.y;
    if (!std::isfinite(distance) || distance <= 0.0f) {
      return std::nullopt;
    }
    return eye_ + distance * direction;
  }

 private:
  geometry::CameraModel pinhole_;
  glm::vec3 eye_;
  glm::quat stage_from_camera_;
};

Result<std::vector<glm::mat4>> PoseSkin(const human::Human& human,
                                        const ReferenceOptions& options) {
  std::vector<human::JointTransform> pose = human.skeleton.rest;
  if (!options.clip.empty()) {
    const auto clip = std::find_if(human.clips.begin(), human.clips.end(),
                                   [&](const human::Clip& c) { return c.name == options.clip; });
    if (clip == human.clips.end()) {
      return Status::Error("--clip " + options.clip, human.name + " has no such clip");
    }
    human::SampleClip(*clip, options.time, pose);
  }
  return human::SkinOfPose(human.skeleton, pose);
}

bake::SurfaceMesh Ground(float albedo) {
  bake::SurfaceMesh ground;
  ground.positions = {{-kGroundHalf, 0.0f, -kGroundHalf},
                      {-kGroundHalf, 0.0f, kGroundHalf},
                      {kGroundHalf, 0.0f, kGroundHalf},
                      {kGroundHalf, 0.0f, -kGroundHalf}};
  ground.normals.assign(4, {0.0f, 1.0f, 0.0f});
  ground.albedo.assign(4, glm::vec3(albedo));
  ground.indices = {0, 1, 2, 0, 2, 3};
  return ground;
}

bake::ProbePlacement Placement(const ReferenceOptions& options) {
  return {glm::angleAxis(glm::radians(static_cast<float>(options.probe_turn)),
                         glm::vec3(0.0f, 1.0f, 0.0f)),
          static_cast<float>(options.probe_scale)};
}

Result<bake::RadianceImage> TraceImage(const ReferenceOptions& options,
                                       const human::Human& human,
                                       const ReferenceView& view,
                                       Progress& progress) {
  LARARIUM_ASSIGN_OR_RETURN(bake::ProbeImage probe, bake::ReadProbeImage(options.probe));
  const bake::Environment environment(std::move(probe), Placement(options));
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<glm::mat4> skin, PoseSkin(human, options));
  LARARIUM_ASSIGN_OR_RETURN(const bake::PosableSurface posable,
                            bake::PosableSurface::Create(human));
  std::vector<bake::SurfaceMesh> meshes;
  if (!options.without_person) {
    meshes = posable.Pose(skin);
  }
  if (options.ground) {
    meshes.push_back(Ground(static_cast<float>(*options.ground)));
  }
  const bake::PathTracing tracing = {options.samples, options.bounces, options.seed};
  return bake::TracePaths(meshes, environment, view.pinhole, view.camera_from_stage, tracing,
                          progress);
}

// The light on a person as the show computes it.
struct Lit {
  std::vector<glm::vec3> irradiance;  // One for each vertex.
  std::vector<glm::vec4> blockers;    // RenderScene::blockers
};

// Uses the light transfer of the person, or bakes one where the person has none for this number of
// bounces.
Result<Lit> LightByTransfer(const ReferenceOptions& options,
                            const std::shared_ptr<human::Human>& human,
                            std::span<const glm::mat4> skin,
                            const light::ShRgb& light,
                            Progress& progress) {
  bake::TransferOptions baking;
  baking.bounces = std::min(options.bounces, baking.bounces);
  if (human->light.empty() || human->light.bounces != baking.bounces) {
    LARARIUM_ASSIGN_OR_RETURN(human->light, bake::BakeTransfer(*human, baking, progress));
  }
  const std::shared_ptr<const human::Human> shared = human;
  show::StageLight stage({&shared, 1});
  Lit lit;
  lit.irradiance.resize(stage.vertex_count(0));
  const show::LitActor actor = {0, &light, skin, glm::mat4(1.0f), lit.irradiance};
  stage.Pose({&actor, 1});
  stage.Light({}, {&actor, 1});
  lit.blockers.assign(stage.blockers().begin(), stage.blockers().end());
  return lit;
}

// The lighting that AR-Life used for comparison: a uniform ambient light and one lamp, without
// shadows.
std::vector<glm::vec3> PhongIrradiance(const human::Human& human,
                                       std::span<const glm::mat4> skin,
                                       const light::ShRgb& light) {
  const render::KeyLight key = render::EstimateKeyLight(light);
  // The mean irradiance over all normals, minus the lamp's share of it (a quarter).
  const glm::vec3 mean =
      light::ConvolveWithCosine(light)[0] * light::EvaluateShBasis(glm::vec3(0.0f, 1.0f, 0.0f))[0];
  const glm::vec3 ambient = glm::max(mean - 0.25f * key.irradiance, glm::vec3(0.0f));
  std::vector<glm::vec3> irradiance;
  for (const human::SkinnedMesh& mesh : human.meshes) {
    std::vector<glm::vec3> positions(mesh.positions.size());
    std::vector<glm::vec3> normals(mesh.positions.size());
    human::SkinMesh(mesh, skin, positions, normals, human.skinning);
    for (const glm::vec3& normal : normals) {
      irradiance.push_back(ambient +
                           key.irradiance * std::max(glm::dot(normal, key.direction), 0.0f));
    }
  }
  return irradiance;
}

// The factor by which the renderer darkens each pixel of the camera's image on the floor, in steps
// of 8-bit sRGB.
Result<cv::Mat> CatchShadows(render::Renderer& renderer, render::RenderScene scene) {
  const bake::SurfaceMesh floor = Ground(1.0f);
  const render::SceneOccluder occluder = {
      renderer.AddMesh({floor.positions, floor.normals, floor.indices})};
  scene.occluders = {&occluder, 1};
  scene.camera = scene.display;
  scene.background =
      cv::Mat(scene.display.height, scene.display.width, CV_8UC3, cv::Scalar::all(255));
  LARARIUM_ASSIGN_OR_RETURN(
      const auto target, render::RenderTarget::Create(scene.display.width, scene.display.height));
  LARARIUM_RETURN_IF_ERROR(renderer.Draw(scene, target));
  cv::Mat bgr;
  target.ReadPixels(bgr);
  renderer.RemoveMesh(occluder.mesh);
  return vision::LinearFromSrgb(bgr);
}

// Draws the floor behind the person. Without the person it is lit like an open plane.
void AddFloor(const cv::Mat& ratio,
              const glm::vec3& radiance,
              const ReferenceView& view,
              cv::Mat& rgba) {
  const Lens lens(view);
  for (int row = 0; row < rgba.rows; ++row) {
    for (int column = 0; column < rgba.cols; ++column) {
      const std::optional<glm::vec3> point = lens.OnFloor(column, row);
      if (!point || std::max(std::abs(point->x), std::abs(point->z)) > kGroundHalf) {
        continue;
      }
      cv::Vec4f& pixel = rgba.at<cv::Vec4f>(row, column);
      const cv::Vec3f& kept = ratio.at<cv::Vec3f>(row, column);
      const float open = 1.0f - pixel[3];
      for (int c = 0; c < 3; ++c) {
        pixel[c] += open * radiance[c] * kept[c];
      }
      pixel[3] = 1.0f;
    }
  }
}

bake::RadianceImage ToImage(const cv::Mat& rgba) {
  bake::RadianceImage image{rgba.cols, rgba.rows, {}, {}};
  image.pixels.reserve(rgba.total());
  for (int row = 0; row < rgba.rows; ++row) {
    for (int column = 0; column < rgba.cols; ++column) {
      const cv::Vec4f& pixel = rgba.at<cv::Vec4f>(row, column);
      image.pixels.emplace_back(pixel[0], pixel[1], pixel[2], pixel[3]);
    }
  }
  return image;
}

// Draws the image like the player, but with Lambert's reflection only.
Result<bake::RadianceImage> DrawImage(const ReferenceOptions& options,
                                      const std::shared_ptr<human::Human>& human,
                                      const ReferenceView& view,
                                      Progress& progress) {
  LARARIUM_ASSIGN_OR_RETURN(const bake::ProbeImage probe, bake::ReadProbeImage(options.probe));
  const light::ProbeLight light = bake::ProjectProbeLight(probe, Placement(options));
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<glm::mat4> skin, PoseSkin(*human, options));
  Lit lit;
  if (options.method == "prt") {
    LARARIUM_ASSIGN_OR_RETURN(lit, LightByTransfer(options, human, skin, light.sky, progress));
  } else if (options.method == "phong") {
    lit.irradiance = PhongIrradiance(*human, skin, light.Whole());
  }
  LARARIUM_ASSIGN_OR_RETURN(const auto context, render::CreateOffscreenContext());
  LARARIUM_ASSIGN_OR_RETURN(const auto renderer, render::Renderer::Create());
  render::SceneHuman person;
  LARARIUM_ASSIGN_OR_RETURN(person.human, renderer->AddHuman(human));
  person.skin = skin;
  person.irradiance = lit.irradiance;
  render::RenderScene scene;
  scene.display = view.pinhole;
  scene.camera_from_stage = view.camera_from_stage;
  if (!options.without_person) {
    scene.humans = {&person, 1};
    scene.blockers = lit.blockers;
  }
  const bool shadowed = options.method == "prt";
  scene.light = shadowed ? light.sky : light.Whole();
  scene.sun = shadowed ? light.sun : std::nullopt;
  scene.matte = true;
  cv::Mat rgba;
  LARARIUM_RETURN_IF_ERROR(renderer->DrawLinear(scene, rgba));
  if (options.ground) {
    LARARIUM_ASSIGN_OR_RETURN(const cv::Mat ratio, CatchShadows(*renderer, scene));
    const glm::vec3 irradiance = light.Irradiance(glm::vec3(0.0f, 1.0f, 0.0f));
    AddFloor(ratio, irradiance * static_cast<float>(*options.ground) / std::numbers::pi_v<float>,
             view, rgba);
  }
  return ToImage(rgba);
}

}  // namespace

Result<CommandResult> RunReference(const ReferenceOptions& options, Progress& progress, Log& log) {
  std::error_code ignored;
  if (std::filesystem::is_directory(options.human, ignored)) {
    return RunSceneReference(options, progress, log);
  }
  if (options.probe.empty() || options.camera.empty()) {
    return Status::Error(options.human.string(), "a person alone needs --probe and --camera");
  }
  LARARIUM_ASSIGN_OR_RETURN(human::Human loaded, human::LoadHuman(options.human));
  const auto human = std::make_shared<human::Human>(std::move(loaded));
  LARARIUM_ASSIGN_OR_RETURN(const ReferenceView view, LoadReferenceView(options));
  LARARIUM_ASSIGN_OR_RETURN(const bake::RadianceImage image,
                            options.method == "path" ? TraceImage(options, *human, view, progress)
                                                     : DrawImage(options, human, view, progress));
  LARARIUM_RETURN_IF_ERROR(bake::WriteExr(options.out, image.width, image.height, image.pixels));
  CommandResult result;
  result.text = "wrote " + options.out.string();
  result.json = {{"out", options.out.string()}, {"width", image.width}, {"height", image.height}};
  return result;
}

}  // namespace lararium::editor
