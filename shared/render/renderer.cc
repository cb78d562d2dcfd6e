#include "shared/render/renderer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <numbers>

#include "shared/geometry/glm_convert.h"
#include "shared/render/clip_space.h"
#include "shared/render/gpu_human.h"
#include "shared/render/linear_target.h"
#include "shared/render/renderer_state.h"
#include "shared/render/shader_program.h"
#include "shared/render/texture.h"

namespace lararium::render {
namespace {

constexpr uint32_t kSkinBinding = 0;
// Of each person in the buffer of matrices: the whole uniform block, which is
// also a multiple of every driver's offset alignment.
constexpr size_t kSkinStride = human::Skeleton::kMaxJoints * sizeof(glm::mat4);

glm::vec4 Intrinsics(const geometry::CameraModel& camera) {
  return {static_cast<float>(camera.fx), static_cast<float>(camera.fy),
          static_cast<float>(camera.cx), static_cast<float>(camera.cy)};
}

glm::vec4 Distortion(const geometry::CameraModel& camera) {
  return {static_cast<float>(camera.k1), static_cast<float>(camera.k2),
          static_cast<float>(camera.p1), static_cast<float>(camera.p2)};
}

// Radiance to irradiance, with the constants of the basis: what
// shaders/include/spherical_harmonics.glsl takes.
std::array<glm::vec3, light::kShCount> IrradianceCoefficients(const light::ShRgb& radiance) {
  constexpr double kPi = std::numbers::pi;
  constexpr double kConvolution[] = {kPi, 2.0 * kPi / 3.0, kPi / 4.0};
  constexpr int kDegree[] = {0, 1, 1, 1, 2, 2, 2, 2, 2};
  const double first = std::sqrt(3.0 / (4.0 * kPi));
  const double second = std::sqrt(15.0 / (4.0 * kPi));
  const double basis[] = {std::sqrt(1.0 / (4.0 * kPi)),  first,  first,       first, second, second,
                          std::sqrt(5.0 / (16.0 * kPi)), second, 0.5 * second};
  std::array<glm::vec3, light::kShCount> coefficients;
  for (int i = 0; i < light::kShCount; ++i) {
    coefficients[i] = radiance[i] * static_cast<float>(kConvolution[kDegree[i]] * basis[i]);
  }
  return coefficients;
}

void ResetState() {
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_STENCIL_TEST);
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  glFrontFace(GL_CCW);
  glCullFace(GL_BACK);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_LESS);
  for (GLuint unit = 0; unit < 2; ++unit) {
    glBindSampler(unit, 0);
  }
}

}  // namespace

Renderer::Renderer(std::unique_ptr<State> state) : state_(std::move(state)) {}
Renderer::~Renderer() = default;

Result<std::unique_ptr<Renderer>> Renderer::Create(const RendererOptions& options) {
  auto state = std::make_unique<State>();
  state->samples = options.samples;
  LARARIUM_ASSIGN_OR_RETURN(state->occluder_pass,
                            ShaderProgram::Create("occluder.vert", "occluder.frag"));
  LARARIUM_ASSIGN_OR_RETURN(state->human_pass, ShaderProgram::Create("human.vert", "human.frag"));
  LARARIUM_ASSIGN_OR_RETURN(state->composite_pass,
                            ShaderProgram::Create("full_screen.vert", "composite.frag"));
  state->human_pass.BindUniformBlock("Skin", kSkinBinding);
  state->no_vertices = GlVertexArray::Generate();
  state->skin = GlBuffer::Generate();
  return std::unique_ptr<Renderer>(new Renderer(std::move(state)));
}

MeshHandle Renderer::AddMesh(const geometry::TriangleMesh& mesh) {
  return state_->meshes.Add(GpuMesh::Create(mesh));
}
HumanHandle Renderer::AddHuman(const human::Human& human) {
  return state_->humans.Add(GpuHuman::Create(human));
}
void Renderer::RemoveMesh(MeshHandle mesh) { state_->meshes.Remove(mesh); }
void Renderer::RemoveHuman(HumanHandle human) { state_->humans.Remove(human); }

Status Renderer::State::Validate(const RenderScene& scene) const {
  constexpr std::string_view kPlace = "picture";
  if (scene.display.width <= 0 || scene.display.height <= 0 ||
      !(scene.display.fx > 0.0 && scene.display.fy > 0.0)) {
    return Status::Error(kPlace, "the display's camera is not set");
  }
  if (!scene.background.empty() && scene.background.type() != CV_8UC3) {
    return Status::Error(kPlace, "the background must be 8-bit BGR");
  }
  if (!scene.background.empty() && (scene.camera.width <= 0 || scene.camera.height <= 0)) {
    return Status::Error(kPlace, "the background's camera is not set");
  }
  if (!(scene.near > 0.0f && scene.far > scene.near)) {
    return Status::Error(kPlace, "near and far must be 0 < near < far");
  }
  for (const SceneOccluder& occluder : scene.occluders) {
    if (meshes.Find(occluder.mesh) == nullptr) {
      return Status::Error(kPlace, "an occluder's mesh was removed");
    }
  }
  for (const SceneHuman& human : scene.humans) {
    const GpuHuman* gpu = humans.Find(human.human);
    if (gpu == nullptr) {
      return Status::Error(kPlace, "a person's mesh was removed");
    }
    if (human.skin.size() != gpu->joint_count() ||
        gpu->joint_count() > human::Skeleton::kMaxJoints) {
      return Status::Error(kPlace, "a person has " + std::to_string(human.skin.size()) +
                                       " skin matrices for " + std::to_string(gpu->joint_count()) +
                                       " joints");
    }
  }
  return Status();
}

void Renderer::State::DrawOccluders(std::span<const SceneOccluder> occluders,
                                    const glm::mat4& clip_from_stage) const {
  glEnable(GL_DEPTH_TEST);
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  occluder_pass.Use();
  for (const SceneOccluder& occluder : occluders) {
    occluder_pass.Set("clip_from_mesh", clip_from_stage * occluder.stage_from_mesh);
    meshes.Find(occluder.mesh)->Draw();
  }
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

void Renderer::State::UploadSkins(std::span<const SceneHuman> scene_humans) {
  glBindBuffer(GL_UNIFORM_BUFFER, skin.id());
  glBufferData(GL_UNIFORM_BUFFER, static_cast<GLsizeiptr>(scene_humans.size() * kSkinStride),
               nullptr, GL_STREAM_DRAW);
  for (size_t i = 0; i < scene_humans.size(); ++i) {
    glBufferSubData(GL_UNIFORM_BUFFER, static_cast<GLintptr>(i * kSkinStride),
                    static_cast<GLsizeiptr>(scene_humans[i].skin.size_bytes()),
                    scene_humans[i].skin.data());
  }
}

void Renderer::State::DrawHumans(const RenderScene& scene, const glm::mat4& clip_from_stage) {
  glEnable(GL_DEPTH_TEST);
  UploadSkins(scene.humans);
  human_pass.Use();
  human_pass.Set("irradiance", IrradianceCoefficients(scene.light));
  human_pass.Set("gain", scene.exposure * scene.gain);
  human_pass.Set("knee", std::clamp(scene.knee, 0.0f, 1.0f));
  for (size_t i = 0; i < scene.humans.size(); ++i) {
    const SceneHuman& human = scene.humans[i];
    human_pass.Set("stage_from_actor", human.stage_from_actor);
    human_pass.Set("clip_from_actor", clip_from_stage * human.stage_from_actor);
    glBindBufferRange(GL_UNIFORM_BUFFER, kSkinBinding, skin.id(),
                      static_cast<GLintptr>(i * kSkinStride), kSkinStride);
    humans.Find(human.human)->Draw();
  }
}

PixelBounds Renderer::State::PeopleBounds(std::span<const SceneHuman> scene_humans,
                                          const glm::mat4& clip_from_stage,
                                          const RenderTarget& target) const {
  ScreenBounds bounds;
  for (const SceneHuman& human : scene_humans) {
    const GpuHuman& gpu = *humans.Find(human.human);
    const glm::mat4 clip_from_actor = clip_from_stage * human.stage_from_actor;
    for (size_t joint = 0; joint < gpu.joint_count(); ++joint) {
      bounds.Extend(gpu.joint_boxes[joint], clip_from_actor * human.skin[joint]);
    }
  }
  return bounds.Pixels(target.width(), target.height());
}

Status Renderer::State::DrawPeople(const RenderScene& scene,
                                   const glm::mat4& clip_from_stage,
                                   const PixelBounds& bounds,
                                   const RenderTarget& target) {
  LARARIUM_RETURN_IF_ERROR(people.Prepare(target.width(), target.height(), samples));
  if (bounds.empty()) {
    return Status();
  }
  people.BindAndClear(bounds);
  DrawOccluders(scene.occluders, clip_from_stage);
  DrawHumans(scene, clip_from_stage);
  people.Resolve(bounds);
  return Status();
}

void Renderer::State::Composite(const RenderScene& scene,
                                const geometry::CameraModel& display,
                                const PixelBounds& people_bounds,
                                const RenderTarget& target) {
  glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer());
  glViewport(0, 0, target.width(), target.height());
  glDisable(GL_DEPTH_TEST);
  composite_pass.Use();
  composite_pass.Set("has_image", scene.background.empty() ? 0 : 1);
  composite_pass.Set("display_intrinsics", Intrinsics(display));
  glActiveTexture(GL_TEXTURE0);
  if (!scene.background.empty()) {
    const cv::Mat& image = scene.background;
    const geometry::CameraModel camera = scene.camera.Resized(image.cols, image.rows);
    background_image.Upload(image);
    composite_pass.Set("camera_intrinsics", Intrinsics(camera));
    composite_pass.Set("camera_distortion", Distortion(camera));
  }
  glBindTexture(GL_TEXTURE_2D, background_image.id());
  composite_pass.Set("image", 0);
  glActiveTexture(GL_TEXTURE1);
  glBindTexture(GL_TEXTURE_2D, people.texture());
  composite_pass.Set("people", 1);
  composite_pass.Set("people_bounds", glm::vec4(people_bounds.left, people_bounds.bottom,
                                                people_bounds.right, people_bounds.top));
  glBindVertexArray(no_vertices.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glBindVertexArray(0);
  glActiveTexture(GL_TEXTURE0);
}

Status Renderer::Draw(const RenderScene& scene, const RenderTarget& target) {
  State& state = *state_;
  LARARIUM_RETURN_IF_ERROR(state.Validate(scene));
  ResetState();
  const geometry::CameraModel display = scene.display.Resized(target.width(), target.height());
  PixelBounds people_bounds;
  if (scene.camera_from_stage) {
    const glm::mat4 clip_from_stage =
        ClipFromCamera(display, scene.near, scene.far) * geometry::ToGlm(*scene.camera_from_stage);
    people_bounds = state.PeopleBounds(scene.humans, clip_from_stage, target);
    LARARIUM_RETURN_IF_ERROR(state.DrawPeople(scene, clip_from_stage, people_bounds, target));
  }
  state.Composite(scene, display, people_bounds, target);
  if (glGetError() != GL_NO_ERROR) {
    return Status::Error("graphics", "the driver reports an error, probably out of memory",
                         "try a smaller picture");
  }
  return Status();
}

}  // namespace lararium::render
