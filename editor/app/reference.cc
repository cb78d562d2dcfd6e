#include "editor/app/reference.h"

#include <algorithm>
#include <cstdio>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <utility>
#include <vector>

#include "editor/bake/environment.h"
#include "editor/bake/exr_image.h"
#include "editor/bake/path_tracer.h"
#include "editor/bake/posed_surface.h"
#include "editor/bake/probe.h"
#include "shared/human/human.h"
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
  std::vector<glm::mat4> actor_from_joint(human.skeleton.size());
  std::vector<glm::mat4> skin(human.skeleton.size());
  human::ComputeActorFromJoint(human.skeleton, pose, actor_from_joint);
  human::ComputeSkinMatrices(human.skeleton, actor_from_joint, skin);
  return skin;
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

Result<bake::RadianceImage> TraceImage(const ReferenceOptions& options,
                                       const human::Human& human,
                                       const View& view,
                                       Progress& progress) {
  const bake::ProbePlacement placement = {
      glm::angleAxis(glm::radians(static_cast<float>(options.probe_turn)),
                     glm::vec3(0.0f, 1.0f, 0.0f)),
      static_cast<float>(options.probe_scale)};
  LARARIUM_ASSIGN_OR_RETURN(bake::ProbeImage probe, bake::ReadProbeImage(options.probe));
  const bake::Environment environment(std::move(probe), placement);
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

}  // namespace

Result<CommandResult> RunReference(const ReferenceOptions& options, Progress& progress) {
  LARARIUM_ASSIGN_OR_RETURN(const human::Human human, human::LoadHuman(options.human));
  LARARIUM_ASSIGN_OR_RETURN(const View view, LoadView(options));
  LARARIUM_ASSIGN_OR_RETURN(const bake::RadianceImage image,
                            TraceImage(options, human, view, progress));
  LARARIUM_RETURN_IF_ERROR(bake::WriteExr(options.out, image.width, image.height, image.pixels));
  CommandResult result;
  result.text = "wrote " + options.out.string();
  result.json = {{"out", options.out.string()}, {"width", image.width}, {"height", image.height}};
  return result;
}

}  // namespace lararium::app
