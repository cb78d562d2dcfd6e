#include "shared/render/renderer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <opencv2/core.hpp>
#include <string>
#include <utility>

#include "shared/geometry/glm_convert.h"
#include "shared/render/linear_target.h"
#include "shared/render/renderer_state.h"
#include "shared/render/shader_program.h"
#include "shared/render/texture.h"

namespace lararium::render {
namespace {

glm::vec4 Intrinsics(const geometry::CameraModel& camera) {
  return {static_cast<float>(camera.fx), static_cast<float>(camera.fy),
          static_cast<float>(camera.cx), static_cast<float>(camera.cy)};
}

glm::vec4 Distortion(const geometry::CameraModel& camera) {
  return {static_cast<float>(camera.k1), static_cast<float>(camera.k2),
          static_cast<float>(camera.p1), static_cast<float>(camera.p2)};
}

bool IsOn(const CameraLook& look) {
  return look.noise_floor > 0.0f || look.noise_slope > 0.0f || look.blur_px > 0.0f ||
         (look.previous_camera_from_stage && look.shutter > 0.0f);
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
  for (GLuint unit = 0; unit <= LookPass::kUnit; ++unit) {
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
  LARARIUM_ASSIGN_OR_RETURN(state->model_pass, ModelPass::Create());
  LARARIUM_ASSIGN_OR_RETURN(state->catcher_pass, CatcherPass::Create());
  LARARIUM_ASSIGN_OR_RETURN(state->sun_pass, SunPass::Create());
  state->look_pass = LookPass::Create();
  LARARIUM_ASSIGN_OR_RETURN(state->sun_mask, SunMask::Create());
  LARARIUM_ASSIGN_OR_RETURN(
      state->look_composite_pass,
      ShaderProgram::Create("full_screen.vert", "composite.frag", "#define LOOK\n"));
  LARARIUM_ASSIGN_OR_RETURN(state->composite_pass,
                            ShaderProgram::Create("full_screen.vert", "composite.frag"));
  state->no_vertices = GlVertexArray::Generate();
  return std::unique_ptr<Renderer>(new Renderer(std::move(state)));
}

MeshHandle Renderer::AddMesh(const geometry::TriangleMesh& mesh) {
  return state_->meshes.Add(GpuMesh::Create(mesh));
}
Result<ModelHandle> Renderer::AddHuman(const human::Human& human) {
  return state_->AddModel(GpuModel::Create(human));
}
Result<ModelHandle> Renderer::AddProp(const stage::Prop& prop) {
  return state_->AddModel(GpuModel::Create(prop));
}
void Renderer::RemoveMesh(MeshHandle mesh) { state_->meshes.Remove(mesh); }
void Renderer::RemoveModel(ModelHandle model) { state_->models.Remove(model); }

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
  return ValidateModels(scene);
}

Status Renderer::State::ValidateModels(const RenderScene& scene) const {
  constexpr std::string_view kPlace = "picture";
  const auto check = [&](ModelHandle handle, size_t matrices, std::string_view what) -> Status {
    const GpuModel* model = models.Find(handle);
    if (model == nullptr) {
      return Status::Error(kPlace, std::string(what) + "'s mesh was removed");
    }
    if (matrices != model->joint_count() || matrices > human::Skeleton::kMaxJoints) {
      return Status::Error(kPlace, std::string(what) + " has " + std::to_string(matrices) +
                                       " skin matrices for " +
                                       std::to_string(model->joint_count()) + " joints");
    }
    return Status();
  };
  for (const SceneProp& prop : scene.props) {
    LARARIUM_RETURN_IF_ERROR(check(prop.prop, prop.stage_from_part.size(), "a prop"));
    if (!prop.shown.empty() && prop.shown.size() != prop.stage_from_part.size()) {
      return Status::Error(kPlace, "a prop does not say of each part whether it is shown");
    }
    if (!prop.irradiance.empty() &&
        prop.irradiance.size() != models.Find(prop.prop)->vertex_count()) {
      return Status::Error(kPlace, "a prop's irradiance is not that of its vertices");
    }
  }
  for (const SceneHuman& human : scene.humans) {
    LARARIUM_RETURN_IF_ERROR(check(human.human, human.skin.size(), "a person"));
    const std::vector<GpuModel::Part>& parts = models.Find(human.human)->parts;
    if (!human.irradiance.empty() &&
        human.irradiance.size() != models.Find(human.human)->vertex_count()) {
      return Status::Error(kPlace, "a person's irradiance is not that of its vertices");
    }
    for (const SceneVertices& moved : human.vertices) {
      if (moved.mesh >= parts.size() || moved.positions.size() != parts[moved.mesh].vertex_count ||
          moved.normals.size() != parts[moved.mesh].vertex_count) {
        return Status::Error(kPlace, "a person's moving vertices are not those of a part");
      }
    }
  }
  return Status();
}

Result<ModelHandle> Renderer::State::AddModel(Result<GpuModel> model) {
  LARARIUM_RETURN_IF_ERROR(model.status());
  LARARIUM_RETURN_IF_ERROR(model_pass.Prepare(*model));
  return models.Add(std::move(*model));
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

void Renderer::State::CollectDraw(const ModelDraw& draw,
                                  const PictureView& view,
                                  ScreenBounds& bounds) {
  all_draws.push_back(draw);
  const glm::mat4 clip_from_model = view.clip_from_stage * draw.stage_from_model;
  ScreenBounds own;
  for (size_t joint = 0; joint < draw.model->joint_count(); ++joint) {
    if (draw.Shows(joint)) {
      own.Extend(draw.model->joint_boxes[joint], clip_from_model * draw.skin[joint]);
    }
  }
  for (const SceneVertices& moved : draw.vertices) {
    if (moved.posed) {
      Box box;
      for (const glm::vec3& position : moved.positions) {
        box.Extend(position);
      }
      own.Extend(box, clip_from_model);
    }
  }
  if (!own.Pixels(view.size.width, view.size.height).empty()) {
    bounds.Extend(own);
    draws.push_back(draw);
  }
}

PixelBounds Renderer::State::CollectDraws(const RenderScene& scene, const PictureView& view) {
  draws.clear();
  all_draws.clear();
  ScreenBounds bounds;
  for (const SceneProp& prop : scene.props) {
    CollectDraw({models.Find(prop.prop),
                 glm::mat4(1.0f),
                 prop.stage_from_part,
                 {},
                 prop.irradiance,
                 0.0f,
                 prop.shown,
                 prop.light,
                 prop.glow},
                view, bounds);
  }
  for (const SceneHuman& human : scene.humans) {
    CollectDraw({models.Find(human.human),
                 human.stage_from_actor,
                 human.skin,
                 human.vertices,
                 human.irradiance,
                 human.detail,
                 {},
                 human.light},
                view, bounds);
  }
  return bounds.Pixels(view.size.width, view.size.height);
}

Status Renderer::State::DrawPeople(const RenderScene& scene,
                                   const PictureView& view,
                                   const PixelBounds& bounds,
                                   int clear) {
  LARARIUM_RETURN_IF_ERROR(people.Prepare(view.size.width, view.size.height, samples));
  if (bounds.empty()) {
    return Status();
  }
  LARARIUM_RETURN_IF_ERROR(sun_mask.Draw(view, bounds, draws, sun_pass, model_pass));
  const PixelBounds cleared = Widened(bounds, clear, view.size);
  people.BindAndClear(cleared);
  DrawOccluders(scene.occluders, view.clip_from_stage);
  model_pass.Draw(scene, view.clip_from_stage, draws, sun_pass, sun_mask);
  people.Resolve(cleared);
  return Status();
}

float Renderer::State::PeopleDepth(const PictureView& view) const {
  float sum = 0.0f;
  for (const ModelDraw& draw : draws) {
    const glm::mat4 stage_from_joint = draw.stage_from_model * draw.skin[0];
    sum += (view.clip_from_stage * stage_from_joint * glm::vec4(0.0f, 0.0f, 0.0f, 1.0f)).w;
  }
  return draws.empty() ? view.far : std::max(sum / static_cast<float>(draws.size()), view.near);
}

void Renderer::State::Composite(const RenderScene& scene,
                                const PictureView& view,
                                const Smear& smear,
                                const PixelBounds& people_bounds,
                                const RenderTarget& target) {
  glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer());
  glViewport(0, 0, target.width(), target.height());
  glDisable(GL_DEPTH_TEST);
  const ShaderProgram& composite = IsOn(scene.look) ? look_composite_pass : composite_pass;
  composite.Use();
  composite.Set("has_image", scene.background.empty() ? 0 : 1);
  composite.Set("display_intrinsics", Intrinsics(view.display));
  glActiveTexture(GL_TEXTURE0);
  if (!scene.background.empty()) {
    const cv::Mat& image = scene.background;
    const geometry::CameraModel camera = scene.camera.Resized(image.cols, image.rows);
    background_image.Upload(image);
    composite.Set("camera_intrinsics", Intrinsics(camera));
    composite.Set("camera_distortion", Distortion(camera));
  }
  glBindTexture(GL_TEXTURE_2D, background_image.id());
  composite.Set("image", 0);
  glActiveTexture(GL_TEXTURE1);
  glBindTexture(GL_TEXTURE_2D, people.texture());
  composite.Set("people", 1);
  look_pass.BindFor(composite, scene.look, smear, people_bounds);
  catcher_pass.BindFor(composite, view, 2);
  sun_pass.BindFor(composite);
  glBindVertexArray(no_vertices.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glBindVertexArray(0);
  glActiveTexture(GL_TEXTURE0);
}

Status Renderer::State::CheckDriver() {
  if (glGetError() != GL_NO_ERROR) {
    return Status::Error("graphics", "the driver reports an error, probably out of memory",
                         "try a smaller picture");
  }
  return Status();
}

Status Renderer::Draw(const RenderScene& scene, const RenderTarget& target) {
  State& state = *state_;
  LARARIUM_RETURN_IF_ERROR(state.Validate(scene));
  ResetState();
  const PictureView view = ViewOf(scene, {target.width(), target.height()});
  PixelBounds people_bounds;
  Smear smear;
  state.people_bounds = {};
  state.picture_size = view.size;
  state.catcher_pass.Skip();
  state.sun_pass.Skip();
  if (scene.camera_from_stage) {
    people_bounds = state.CollectDraws(scene, view);
    state.catcher_pass.SetBlockers(scene.blockers);
    state.sun_pass.Draw(scene, state.meshes, state.model_pass, state.all_draws,
                        state.catcher_pass.reach());
    smear = SmearOf(scene, view, people_bounds, state.PeopleDepth(view));
    state.people_bounds = people_bounds;
    // What is seen at the rim of a smear looks as far again.
    LARARIUM_RETURN_IF_ERROR(state.DrawPeople(scene, view, people_bounds, 2 * smear.reach));
    people_bounds = Widened(people_bounds, smear.reach, view.size);
    LARARIUM_RETURN_IF_ERROR(state.catcher_pass.Draw(scene, state.meshes, state.sun_pass, view));
  }
  state.Composite(scene, view, smear, people_bounds, target);
  return State::CheckDriver();
}

void Renderer::ReadCoverage(cv::Mat& coverage) const {
  const State& state = *state_;
  coverage = cv::Mat::zeros(state.picture_size.height, state.picture_size.width, CV_8UC1);
  if (state.people_bounds.empty()) {
    return;
  }
  cv::Mat rgba, alpha;
  state.people.ReadPixels(state.people_bounds, rgba);
  cv::extractChannel(rgba, alpha, 3);
  alpha.convertTo(coverage, CV_8UC1, 255.0);
}

Status Renderer::DrawLinear(const RenderScene& scene, cv::Mat& rgba) {
  State& state = *state_;
  LARARIUM_RETURN_IF_ERROR(state.Validate(scene));
  if (!scene.camera_from_stage) {
    return Status::Error("picture", "people cannot be drawn without the camera's pose");
  }
  ResetState();
  RenderScene linear = scene;
  linear.exposure = 1.0f;
  linear.gain = glm::vec3(1.0f);
  linear.knee = 65504.0f;  // the largest that the target holds
  const PictureView view = ViewOf(linear, {scene.display.width, scene.display.height});
  const PixelBounds bounds = state.CollectDraws(linear, view);
  state.sun_pass.Draw(linear, state.meshes, state.model_pass, state.all_draws, {});
  LARARIUM_RETURN_IF_ERROR(state.DrawPeople(linear, view, bounds, 0));
  state.people.ReadPixels(bounds, rgba);
  return State::CheckDriver();
}

}  // namespace lararium::render
