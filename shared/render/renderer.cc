#include "shared/render/renderer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <utility>

#include "shared/render/detail.h"
#include "shared/render/gl/linear_target.h"
#include "shared/render/gl/shader_program.h"
#include "shared/render/gl/texture.h"
#include "shared/render/renderer_state.h"
#include "shared/vision/rolling_shutter.h"

namespace lararium::render {
namespace {

constexpr GLuint kForegroundUnit = LookPass::kUnit + 1;
// If the camera's resolution divided by the target's is above this, the picture is composed at the
// size of the target, because a smaller one would hardly save time.
constexpr double kLeastEnlarged = 0.9;
// A layer that is warped to other poses extends beyond each edge of the picture by kMargin of its
// width. If its corners move by more than kFurthestCarried of the width, too much would be missing
// at an edge and the layer is not used.
constexpr float kLayerMargin = 1.0f / 32.0f;
constexpr float kFurthestCarried = 0.1f;

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

ImageSize Scaled(const ImageSize& size, float scale) {
  const auto scaled = [scale](int side) {
    return std::max(static_cast<int>(std::lround(scale * static_cast<float>(side))), 1);
  };
  return {scaled(size.width), scaled(size.height)};
}

// Resolution of the camera's image divided by that of a picture, along each side.
double ImageScale(const RenderScene& scene, const ImageSize& picture) {
  const geometry::CameraModel camera =
      scene.camera.Resized(scene.background.cols, scene.background.rows);
  return camera.Focal() / scene.display.Resized(picture.width, picture.height).Focal();
}

// Returns the parts of a picture outside bounds; all of it if they are empty.
std::array<PixelBounds, 4> Around(const PixelBounds& b, const ImageSize& size) {
  if (b.empty()) {
    return {PixelBounds{0, 0, size.width, size.height}};
  }
  return {PixelBounds{0, 0, size.width, b.bottom}, PixelBounds{0, b.top, size.width, size.height},
          PixelBounds{0, b.bottom, b.left, b.top},
          PixelBounds{b.right, b.bottom, size.width, b.top}};
}

void FillBounds(const PixelBounds& bounds) {
  if (!bounds.empty()) {
    glScissor(bounds.left, bounds.bottom, bounds.width(), bounds.height());
    glDrawArrays(GL_TRIANGLES, 0, 3);
  }
}

// Converts bounds in the layer to bounds in the target, whose rows are counted from the top.
PixelBounds InPicture(const PixelBounds& b, float scale, const RenderTarget& target) {
  if (b.empty()) {
    return {};
  }
  const auto first = [scale](int at) {
    return static_cast<int>(std::floor(static_cast<float>(at) / scale));
  };
  const auto last = [scale](int at) {
    return static_cast<int>(std::ceil(static_cast<float>(at) / scale));
  };
  return {std::max(first(b.left), 0), std::max(target.height() - last(b.top), 0),
          std::min(last(b.right), target.width()),
          std::min(target.height() - first(b.bottom), target.height())};
}

// Depth of a model's root joint along the view, metres.
float RootDepth(const ModelDraw& draw, const PictureView& view) {
  return (view.clip_from_stage * draw.stage_from_model * draw.skin[0][3]).w;
}

// Homography from pixels of a picture to pixels of the layer. The scene must have a pose.
glm::mat3 LayerFromPicture(const CompositeLayer& layer,
                           const RenderScene& scene,
                           const RenderTarget& picture) {
  return ViewFromPicture(layer.view, *layer.camera_from_stage, layer.depth,
                         scene.display.Resized(picture.width(), picture.height()),
                         *scene.camera_from_stage);
}

// The time at which a pixel of the picture is exposed, counted from the corner of the top row; see
// shaders/pass/composite.frag. The lens hardly bends it.
glm::vec3 ExposureTime(const RenderScene& scene, const RenderTarget& picture) {
  const geometry::CameraModel display =
      scene.background_display.value_or(scene.display).Resized(picture.width(), picture.height());
  const auto time = [&](double x, double y) {
    const Eigen::Vector2d plane = display.PlaneFromPixel({x, y});
    return scene.shutter->readout.dot(
        vision::ReadoutOrder(scene.camera, scene.camera.PixelFromPlane(plane)));
  };
  const double x = 0.5 * (display.width - 1);
  const double y = 0.5 * (display.height - 1);
  const double by_x = (time(1.5 * x, y) - time(0.5 * x, y)) / x;
  const double by_y = (time(x, 1.5 * y) - time(x, 0.5 * y)) / y;
  return {by_x, by_y, time(x, y) - by_x * (x + 0.5) - by_y * (y + 0.5)};
}

geometry::CameraModel BackgroundCamera(const RenderScene& scene) {
  return scene.camera.Resized(scene.background.cols, scene.background.rows);
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
  for (GLuint unit = 0; unit <= kForegroundUnit; ++unit) {
    glBindSampler(unit, 0);
  }
}

}  // namespace

Renderer::Renderer(std::unique_ptr<State> state) : state_(std::move(state)) {}
Renderer::~Renderer() = default;

Result<std::unique_ptr<Renderer>> Renderer::Create(const Quality& quality) {
  auto state = std::make_unique<State>(Clamped(quality));
  LARARIUM_ASSIGN_OR_RETURN(state->occluder_pass,
                            ShaderProgram::Create("occluder.vert", "occluder.frag"));
  LARARIUM_ASSIGN_OR_RETURN(state->model_pass, ModelPass::Create());
  LARARIUM_ASSIGN_OR_RETURN(state->catcher_pass, CatcherPass::Create());
  LARARIUM_ASSIGN_OR_RETURN(state->sun_pass, SunPass::Create());
  LARARIUM_ASSIGN_OR_RETURN(state->sun_mask, SunMask::Create());
  LARARIUM_ASSIGN_OR_RETURN(state->upscaler, Upscaler::Create());
  state->no_vertices = GlVertexArray::Generate();
  return std::unique_ptr<Renderer>(new Renderer(std::move(state)));
}

Status Renderer::PrepareCaughtShadows() { return state_->catcher_pass.Compile(); }
MeshHandle Renderer::AddMesh(const geometry::TriangleMesh& mesh) {
  return state_->meshes.Add(GpuMesh::Create(mesh));
}
Result<ModelHandle> Renderer::AddHuman(const std::shared_ptr<const human::Human>& human) {
  return state_->AddModel(GpuModel::Create(human, state_->textures));
}
Result<ModelHandle> Renderer::AddProp(const std::shared_ptr<const stage::Prop>& prop) {
  return state_->AddModel(GpuModel::Create(prop, state_->textures));
}
void Renderer::RemoveMesh(MeshHandle mesh) { state_->meshes.Remove(mesh); }
void Renderer::RemoveModel(ModelHandle model) {
  state_->models.Remove(model);
  state_->sun_pass.ForgetModels();
}
void Renderer::SetQuality(const Quality& quality) {
  state_->quality = Clamped(quality);
  state_->textures.Refine(state_->quality.texture_halvings);
  state_->layer = {};  // the size of the layer may have changed
}

Status Renderer::State::Validate(const RenderScene& scene) const {
  constexpr std::string_view kPlace = "picture";
  if (scene.display.width <= 0 || scene.display.height <= 0 ||
      !(scene.display.fx > 0.0 && scene.display.fy > 0.0)) {
    return Status::Error(kPlace, "the display's camera is not set");
  }
  if (scene.see_through && !scene.background.empty()) {
    return Status::Error(kPlace, "a see-through picture must not have a background");
  }
  if (!scene.foreground.empty() && scene.foreground.type() != CV_32FC4) {
    return Status::Error(kPlace, "the foreground must have four channels of floats");
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
      return Status::Error(kPlace, "a prop needs one value in `shown` for each of its parts");
    }
    if (!prop.irradiance.empty() &&
        prop.irradiance.size() != models.Find(prop.prop)->vertex_count()) {
      return Status::Error(kPlace, "a prop needs one value of irradiance for each vertex");
    }
  }
  for (const SceneHuman& human : scene.humans) {
    LARARIUM_RETURN_IF_ERROR(check(human.human, human.skin.size(), "a person"));
    const std::vector<GpuModel::Part>& parts = models.Find(human.human)->parts;
    if (!human.irradiance.empty() &&
        human.irradiance.size() != models.Find(human.human)->vertex_count()) {
      return Status::Error(kPlace, "a person needs one value of irradiance for each vertex");
    }
    for (const SceneVertices& moved : human.vertices) {
      if (moved.mesh >= parts.size() || moved.positions.size() != parts[moved.mesh].vertex_count ||
          moved.normals.size() != parts[moved.mesh].vertex_count) {
        return Status::Error(kPlace, "a person's moving vertices do not match a mesh");
      }
    }
  }
  return Status();
}

Result<ModelHandle> Renderer::State::AddModel(Result<GpuModel> model) {
  LARARIUM_RETURN_IF_ERROR(model.status());
  LARARIUM_RETURN_IF_ERROR(model_pass.PrepareCasters(*model));
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

// The error in metres that is as large as Quality::detail_px at the distance of the prop.
float Renderer::State::PropDetail(const RenderScene& scene, const SceneProp& prop) const {
  if (prop.stage_from_part.empty()) {
    return 0.0f;
  }
  const geometry::CameraModel display =
      scene.display.Resized(picture_size.width, picture_size.height);
  return quality.detail_px / PixelsPerMetre(display, *scene.camera_from_stage,
                                            glm::vec3(prop.stage_from_part.front()[3]));
}

PixelBounds Renderer::State::CollectDraws(const RenderScene& scene, const PictureView& view) {
  model_pass.BeginPicture();
  draws.clear();
  all_draws.clear();
  ScreenBounds bounds;
  for (const SceneProp& prop : scene.props) {
    CollectDraw({models.Find(prop.prop),
                 glm::mat4(1.0f),
                 prop.stage_from_part,
                 {},
                 prop.irradiance,
                 PropDetail(scene, prop),
                 prop.shown,
                 prop.light,
                 prop.glow,
                 prop.mark},
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
                 human.light,
                 1.0f,
                 human.mark},
                view, bounds);
  }
  std::stable_sort(draws.begin(), draws.end(), [&](const ModelDraw& a, const ModelDraw& b) {
    return RootDepth(a, view) < RootDepth(b, view);
  });
  return bounds.Pixels(view.size.width, view.size.height);
}

Status Renderer::State::DrawPeople(const RenderScene& scene,
                                   const PictureView& view,
                                   const PixelBounds& bounds,
                                   int clear) {
  LARARIUM_RETURN_IF_ERROR(people.Prepare(view.size, quality.samples));
  if (bounds.empty()) {
    return Status();
  }
  const PixelBounds cleared = Widened(bounds, clear, view.size);
  people.BindAndClear(cleared);
  DrawOccluders(scene.occluders, view.clip_from_stage);
  LARARIUM_RETURN_IF_ERROR(
      model_pass.Draw(scene, quality, view.clip_from_stage, draws, sun_pass, sun_mask));
  people.Resolve(cleared);
  return Status();
}

float Renderer::State::PeopleDepth(const PictureView& view) const {
  float sum = 0.0f;
  for (const ModelDraw& draw : draws) {
    sum += RootDepth(draw, view);
  }
  return draws.empty() ? view.far : std::max(sum / static_cast<float>(draws.size()), view.near);
}

Status Renderer::State::DrawSunShadows(const RenderScene& scene,
                                       const PictureView& view,
                                       const PixelBounds& bounds) {
  catcher_pass.SetBlockers(scene.blockers);
  LARARIUM_RETURN_IF_ERROR(
      sun_pass.Draw(scene, quality, view, meshes, model_pass, all_draws, catcher_pass.reach()));
  return bounds.empty() ? Status() : sun_mask.Draw(view, bounds, draws, sun_pass, model_pass);
}

Status Renderer::State::DrawShadows(const RenderScene& scene,
                                    const PictureView& view,
                                    const PixelBounds& bounds) {
  LARARIUM_RETURN_IF_ERROR(DrawSunShadows(scene, view, bounds));
  return catcher_pass.DrawKept(scene, quality, meshes, sun_pass, view);
}

Status Renderer::State::DrawLit(const RenderScene& scene,
                                const PictureView& view,
                                const PixelBounds& bounds) {
  layer = {};
  layer.view = view;
  layer.depth = PeopleDepth(view);
  layer.camera_from_stage = scene.camera_from_stage;
  layer.people = bounds;
  if (quality.camera_look) {
    layer.motion_blur = MotionBlurOf(scene, view, bounds, layer.depth);
  }
  // A blurred pixel may lie `reach` outside bounds and reads pixels up to `reach` away from it.
  // Upscaling the layer reads one more pixel.
  const int reach = layer.motion_blur.reach;
  LARARIUM_RETURN_IF_ERROR(DrawPeople(scene, view, bounds, 2 * reach + 2));
  const bool enlarged = view.size != view.most;
  catcher_pass.DrawCaught(sun_pass, view, {people.texture(), bounds, reach + (enlarged ? 1 : 0)});
  return Status();
}

PictureView Renderer::State::LayerView(const RenderScene& scene,
                                       const RenderTarget& picture) const {
  const ImageSize size = Scaled({picture.width(), picture.height()}, quality.layer_scale);
  const float margin = quality.half_rate ? kLayerMargin * static_cast<float>(size.width) : 0.0f;
  return ViewOf(scene, size, picture_size, static_cast<int>(std::ceil(margin)));
}

// shaders must be the program in use.
void Renderer::State::SetBackground(const ShaderProgram& shaders,
                                    const RenderScene& scene,
                                    const geometry::CameraModel& display) const {
  if (!Rectifies(scene)) {
    shaders.Set("has_image", scene.background.empty() ? 0 : 1);
    shaders.Set("display_intrinsics", Intrinsics(display));
    if (!scene.background.empty()) {
      const geometry::CameraModel camera = BackgroundCamera(scene);
      shaders.Set("camera_intrinsics", Intrinsics(camera));
      shaders.Set("camera_distortion", Distortion(camera));
    }
  }
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, background_image.id());
  shaders.Set("image", 0);
}

bool Renderer::State::Rectifies(const RenderScene& scene) const {
  return !quality.camera_look && !scene.background.empty();
}

void Renderer::State::UploadBackground(const RenderScene& scene,
                                       const geometry::CameraModel& display) {
  if (Rectifies(scene)) {
    background_image.Upload(rectifier.Rectify(scene.background, BackgroundCamera(scene), display));
  } else if (!scene.background.empty()) {
    background_image.Upload(scene.background);
  }
}

void Renderer::State::SetForeground(const ShaderProgram& composite,
                                    const RenderScene& scene,
                                    const geometry::CameraModel& display) {
  composite.Set("foreground_is_on", scene.foreground.empty() ? 0 : 1);
  composite.Set("picture_size", glm::vec2(display.width, display.height));
  composite.Set("foreground", static_cast<int>(kForegroundUnit));
  glActiveTexture(GL_TEXTURE0 + kForegroundUnit);
  if (!scene.foreground.empty()) {
    const int width = scene.foreground.cols;
    const int height = scene.foreground.rows;
    foreground_image.Upload(foreground_rectifier.Rectify(
        scene.foreground, scene.camera.Resized(width, height), display.Resized(width, height)));
  }
  glBindTexture(GL_TEXTURE_2D, foreground_image.id());
}

Result<const RenderTarget*> Renderer::State::ChoosePicture(const RenderScene& scene,
                                                           const RenderTarget& target) {
  if (quality.full_size || scene.background.empty()) {
    return &target;
  }
  const ImageSize size = {target.width(), target.height()};
  const double scale = ImageScale(scene, size);
  if (scale > kLeastEnlarged) {
    return &target;
  }
  const ImageSize smaller = Scaled(size, static_cast<float>(scale));
  if (!small_picture || small_picture->width() != smaller.width ||
      small_picture->height() != smaller.height) {
    LARARIUM_ASSIGN_OR_RETURN(small_picture, RenderTarget::Create(smaller.width, smaller.height));
  }
  return &*small_picture;
}

PixelBounds Renderer::State::ChangedBy(const RenderScene& scene, const RenderTarget& target) const {
  if (!layer.camera_from_stage || !scene.camera_from_stage) {
    return {};
  }
  if (*layer.camera_from_stage != *scene.camera_from_stage || layer.view.margin > 0 ||
      scene.shutter) {
    return {0, 0, target.width(), target.height()};
  }
  const PixelBounds seen = Widened(layer.people, layer.motion_blur.reach, layer.view.size);
  const float scale =
      static_cast<float>(layer.view.size.width) / static_cast<float>(target.width());
  return InPicture(Union(seen, catcher_pass.bounds()), scale, target);
}

LateProgram& Renderer::State::CompositePass(const RenderScene& scene) {
  if (scene.see_through) {
    return see_through_composite_pass;
  }
  if (quality.camera_look && IsOn(scene.look)) {
    return look_composite_pass;
  }
  return Rectifies(scene) ? rectified_composite_pass : composite_pass;
}

Status Renderer::State::Composite(const RenderScene& scene, const RenderTarget& target) {
  const ImageSize size = {target.width(), target.height()};
  const geometry::CameraModel display =
      scene.background_display.value_or(scene.display).Resized(size.width, size.height);
  const PixelBounds changed = ChangedBy(scene, target);
  glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer());
  glViewport(0, 0, size.width, size.height);
  glDisable(GL_DEPTH_TEST);
  glBindVertexArray(no_vertices.id());
  if (scene.see_through) {
    glDisable(GL_SCISSOR_TEST);
    glClearColor(0.0f, 0.0f, 0.0f, 0.0f);
    glClear(GL_COLOR_BUFFER_BIT);
    glEnable(GL_SCISSOR_TEST);
  } else {
    glEnable(GL_SCISSOR_TEST);
    UploadBackground(scene, display);
    LARARIUM_ASSIGN_OR_RETURN(
        const ShaderProgram* background,
        (Rectifies(scene) ? rectified_background_pass : background_pass).Get());
    background->Use();
    SetBackground(*background, scene, display);
    for (const PixelBounds& unchanged : Around(changed, size)) {
      FillBounds(unchanged);
    }
  }
  if (!changed.empty()) {
    LARARIUM_ASSIGN_OR_RETURN(const ShaderProgram* composite, CompositePass(scene).Get());
    composite->Use();
    if (!scene.see_through) {
      SetForeground(*composite, scene, display);
      SetBackground(*composite, scene, display);
    }
    SetLayer(*composite, scene, target);
    FillBounds(changed);
  }
  glDisable(GL_SCISSOR_TEST);
  glBindVertexArray(0);
  glActiveTexture(GL_TEXTURE0);
  return Status();
}

void Renderer::State::SetLayer(const ShaderProgram& composite,
                               const RenderScene& scene,
                               const RenderTarget& target) {
  composite.Set("layer_from_pixel", LayerFromPicture(layer, scene, target));
  composite.Set("exposure_time", scene.shutter ? ExposureTime(scene, target) : glm::vec3(0.0f));
  composite.Set("frame_ago", scene.shutter
                                 ? PreviousFromPixel(scene.shutter->previous_camera_from_stage *
                                                         scene.camera_from_stage->Inverse(),
                                                     layer.view, layer.depth)
                                 : glm::mat3(1.0f));
  composite.Set("people_opacity", std::min(scene.people_opacity, 1.0f));
  glActiveTexture(GL_TEXTURE1);
  glBindTexture(GL_TEXTURE_2D, people.texture());
  composite.Set("people", 1);
  look_pass.BindFor(composite, quality.camera_look ? scene.look : CameraLook(), layer.motion_blur,
                    Widened(layer.people, layer.motion_blur.reach, layer.view.size));
  catcher_pass.BindFor(composite, 2);
}

Status Renderer::State::PutTogether(const RenderScene& scene,
                                    const RenderTarget& picture,
                                    const RenderTarget& target) {
  LARARIUM_RETURN_IF_ERROR(Composite(scene, picture));
  if (&picture != &target) {
    upscaler.Upscale(picture, target);
  }
  return Status();
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
  state.textures.Update();
  state.picture_size = {target.width(), target.height()};
  state.layer = {};
  state.catcher_pass.Skip();
  state.sun_pass.Skip();
  LARARIUM_ASSIGN_OR_RETURN(const RenderTarget* picture, state.ChoosePicture(scene, target));
  if (scene.camera_from_stage && scene.people_opacity > 0.0f) {
    const PictureView view = state.LayerView(scene, *picture);
    const PixelBounds bounds = state.CollectDraws(scene, view);
    LARARIUM_RETURN_IF_ERROR(state.DrawShadows(scene, view, bounds));
    LARARIUM_RETURN_IF_ERROR(state.DrawLit(scene, view, bounds));
  }
  LARARIUM_RETURN_IF_ERROR(state.PutTogether(scene, *picture, target));
  return State::CheckDriver();
}

bool Renderer::CanCarryLayer(const RenderScene& picture, const RenderTarget& target) const {
  const State& state = *state_;
  const CompositeLayer& layer = state.layer;
  if (!layer.camera_from_stage || !picture.camera_from_stage || picture.people_opacity <= 0.0f ||
      state.picture_size != ImageSize{target.width(), target.height()}) {
    return false;
  }
  const PictureView& view = layer.view;
  const PictureView now =
      ViewOf(picture, {view.size.width - 2 * view.margin, view.size.height - 2 * view.margin},
             state.picture_size, view.margin);
  if (now.display != view.display) {
    return false;
  }
  const glm::mat3 layer_from_view = ViewFromPicture(view, *layer.camera_from_stage, layer.depth,
                                                    now.display, *picture.camera_from_stage);
  const glm::vec2 sides(view.size.width, view.size.height);
  for (const glm::vec2& corner : {glm::vec2(0.0f, 0.0f), glm::vec2(1.0f, 0.0f),
                                  glm::vec2(0.0f, 1.0f), glm::vec2(1.0f, 1.0f)}) {
    const glm::vec3 seen = layer_from_view * glm::vec3(corner * sides, 1.0f);
    const glm::vec2 before(corner.x * sides.x, (1.0f - corner.y) * sides.y);
    if (seen.z <= 0.0f ||
        glm::distance(glm::vec2(seen) / seen.z, before) > kFurthestCarried * sides.x) {
      return false;
    }
  }
  return true;
}

Status Renderer::DrawHalf(Half half,
                          const RenderScene& people,
                          const RenderScene& picture,
                          const RenderTarget& target) {
  State& state = *state_;
  LARARIUM_RETURN_IF_ERROR(state.Validate(people));
  LARARIUM_RETURN_IF_ERROR(state.Validate(picture));
  if (!people.camera_from_stage) {
    return Status::Error("picture", "people cannot be drawn without the camera's pose");
  }
  ResetState();
  state.textures.Update();
  LARARIUM_ASSIGN_OR_RETURN(const RenderTarget* smaller, state.ChoosePicture(picture, target));
  const PictureView view = state.LayerView(people, *smaller);
  const PixelBounds bounds = state.CollectDraws(people, view);
  LARARIUM_RETURN_IF_ERROR(half == Half::kShadows ? state.DrawShadows(people, view, bounds)
                                                  : state.DrawLit(people, view, bounds));
  LARARIUM_RETURN_IF_ERROR(state.PutTogether(picture, *smaller, target));
  return State::CheckDriver();
}

void Renderer::ReadCoverage(cv::Mat& coverage) const {
  const State& state = *state_;
  const cv::Size size(state.picture_size.width, state.picture_size.height);
  coverage = cv::Mat::zeros(size, CV_8UC1);
  if (state.layer.people.empty()) {
    return;
  }
  cv::Mat rgba, alpha;
  state.people.ReadPixels(state.layer.people, rgba);
  cv::extractChannel(rgba, alpha, 3);
  const int margin = state.layer.view.margin;
  alpha = alpha(cv::Rect(margin, margin, alpha.cols - 2 * margin, alpha.rows - 2 * margin));
  if (alpha.size() != size) {
    cv::resize(alpha, alpha, size);
  }
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
  linear.knee = 65504.0f;  // largest 16-bit float
  linear.response = nullptr;
  linear.blockers = {};
  const ImageSize size = {scene.display.width, scene.display.height};
  state.picture_size = size;
  const PictureView view = ViewOf(linear, size, size);
  const PixelBounds bounds = state.CollectDraws(linear, view);
  LARARIUM_RETURN_IF_ERROR(state.DrawSunShadows(linear, view, bounds));
  LARARIUM_RETURN_IF_ERROR(state.DrawPeople(linear, view, bounds, 0));
  state.people.ReadPixels(bounds, rgba);
  return State::CheckDriver();
}

}  // namespace lararium::render
