#include "editor/app/reference.h"

#include <algorithm>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <memory>
#include <opencv2/core/mat.hpp>
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
#include "shared/human/human.h"
#include "shared/human/skinning.h"
#include "shared/render/graphics_context.h"
#include "shared/render/key_light.h"
#include "shared/render/renderer.h"
#include "shared/show/stage_light.h"
#include "shared/vision/poses_file.h"

namespace lararium::app {
namespace {

constexpr float kGroundHalf = 2.0f;  // metres

// Where the picture is taken from.
struct View {
  geometry::CameraModel pinhole;
  geometry::Rigid3 camera_from_stage;
};

Result<View> LoadView(const ReferenceOptions& options) {
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<vision::PoseRecord> records,
                            vision::LoadPoses(options.camera));
  const auto index = static_cast<size_t>(options.frame);
  if (index >= records.size() || !records[index].camera_from_world) {
    return Status::Error(options.camera.string(),
                         "has no pose of frame " + std::to_string(options.frame),
                         "it has " + std::to_string(records.size()) + " frames");
  }
  if (records[index].camera.HasDistortion()) {
    return Status::Error(options.camera.string(), "the camera has distortion",
                         "give a pinhole: K alone");
  }
  return View{records[index].camera, *records[index].camera_from_world};
}

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
                                       const View& view,
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

// Irradiance of every vertex by the light transfer that the person has, or that is baked
// now where it has none for so many reflections.
Result<std::vector<glm::vec3>> TransferIrradiance(const ReferenceOptions& options,
                                                  const std::shared_ptr<human::Human>& human,
                                                  std::span<const glm::mat4> skin,
                                                  const light::ShRgb& light,
                                                  Progress& progress) {
  bake::TransferOptions baking;
  baking.bounces = std::min(options.bounces, baking.bounces);
  if (human->light.empty() || human->light.bounces != baking.bounces) {
    LARARIUM_ASSIGN_OR_RETURN(human->light, bake::BakeTransfer(*human, baking, progress));
  }
  const std::shared_ptr<const human::Human> lit = human;
  show::StageLight stage({&lit, 1});
  std::vector<glm::vec3> irradiance(stage.vertex_count(0));
  const show::LitActor actor = {0, &light, skin, glm::mat4(1.0f), irradiance};
  stage.Light({}, {}, {&actor, 1});
  return irradiance;
}

// What AR-Life compared with: an even ambient light and one lamp, without shadows.
std::vector<glm::vec3> PhongIrradiance(const human::Human& human,
                                       std::span<const glm::mat4> skin,
                                       const light::ShRgb& light) {
  const render::KeyLight key = render::EstimateKeyLight(light);
  // The mean irradiance over all normals, less the lamp's share of it (a quarter).
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

// As the player draws it, but for what is not Lambert's reflection.
Result<bake::RadianceImage> DrawImage(const ReferenceOptions& options,
                                      const std::shared_ptr<human::Human>& human,
                                      const View& view,
                                      Progress& progress) {
  LARARIUM_ASSIGN_OR_RETURN(const bake::ProbeImage probe, bake::ReadProbeImage(options.probe));
  const light::ProbeLight light = bake::ProjectProbeLight(probe, Placement(options));
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<glm::mat4> skin, PoseSkin(*human, options));
  std::vector<glm::vec3> irradiance;
  if (options.method == "prt") {
    LARARIUM_ASSIGN_OR_RETURN(irradiance,
                              TransferIrradiance(options, human, skin, light.sky, progress));
  } else if (options.method == "phong") {
    irradiance = PhongIrradiance(*human, skin, light.Whole());
  }
  LARARIUM_ASSIGN_OR_RETURN(const auto context, render::CreateOffscreenContext());
  LARARIUM_ASSIGN_OR_RETURN(const auto renderer, render::Renderer::Create());
  render::SceneHuman person;
  LARARIUM_ASSIGN_OR_RETURN(person.human, renderer->AddHuman(*human));
  person.skin = skin;
  person.irradiance = irradiance;
  render::RenderScene scene;
  scene.display = view.pinhole;
  scene.camera_from_stage = view.camera_from_stage;
  scene.humans = {&person, 1};
  const bool shadowed = options.method == "prt";
  scene.light = shadowed ? light.sky : light.Whole();
  scene.sun = shadowed ? light.sun : std::nullopt;
  scene.matte = true;
  cv::Mat rgba;
  LARARIUM_RETURN_IF_ERROR(renderer->DrawLinear(scene, rgba));
  bake::RadianceImage image{rgba.cols, rgba.rows, {}};
  image.pixels.reserve(rgba.total());
  for (int row = 0; row < rgba.rows; ++row) {
    for (int column = 0; column < rgba.cols; ++column) {
      const cv::Vec4f& pixel = rgba.at<cv::Vec4f>(row, column);
      image.pixels.emplace_back(pixel[0], pixel[1], pixel[2], pixel[3]);
    }
  }
  return image;
}

}  // namespace

Result<CommandResult> RunReference(const ReferenceOptions& options, Progress& progress) {
  LARARIUM_ASSIGN_OR_RETURN(human::Human loaded, human::LoadHuman(options.human));
  const auto human = std::make_shared<human::Human>(std::move(loaded));
  LARARIUM_ASSIGN_OR_RETURN(const View view, LoadView(options));
  LARARIUM_ASSIGN_OR_RETURN(const bake::RadianceImage image,
                            options.method == "path" ? TraceImage(options, *human, view, progress)
                                                     : DrawImage(options, human, view, progress));
  LARARIUM_RETURN_IF_ERROR(bake::WriteExr(options.out, image.width, image.height, image.pixels));
  CommandResult result;
  result.text = "wrote " + options.out.string();
  result.json = {{"out", options.out.string()}, {"width", image.width}, {"height", image.height}};
  return result;
}

}  // namespace lararium::app
