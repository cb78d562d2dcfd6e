#include "shared/render/passes/catcher_pass.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>

#include "shared/geometry/glm_convert.h"
#include "shared/render/gl/gl_object.h"
#include "shared/render/passes/sky_cones.h"

namespace lararium::render {
namespace {

constexpr int kLeastCell = 4;    // minimum of Quality::shadow_cell
constexpr int kHalvingCell = 8;  // minimum for shadows with half the layer's resolution
constexpr uint32_t kBlockerBinding = 1;

// A lamp that adds less than this share of the sky's light is not visible on real surfaces.
constexpr float kLeastLampShare = 0.02f;

void AllocateImage(
    GlTexture& texture, GLint internal, const ImageSize& size, GLenum format, GLenum type) {
  texture = GlTexture::Generate();
  glBindTexture(GL_TEXTURE_2D, texture.id());
  glTexImage2D(GL_TEXTURE_2D, 0, internal, size.width, size.height, 0, format, type, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

const light::ShRgb& PictureLight(const RenderScene& scene) {
  return scene.picture_light ? *scene.picture_light : scene.light;
}

Status AllocateColour(GlTexture& texture,
                      GlFramebuffer& framebuffer,
                      const ImageSize& size,
                      GLint filter) {
  AllocateImage(texture, GL_RGBA16F, size, GL_RGBA, GL_HALF_FLOAT);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
  framebuffer = GlFramebuffer::Generate();
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture.id(), 0);
  return CheckFramebuffer("shadows into images");
}

ImageSize Coarse(const ImageSize& size, int cell) {
  return {(size.width + cell - 1) / cell, (size.height + cell - 1) / cell};
}

PixelBounds Coarse(const PixelBounds& b, int cell) {
  return {b.left / cell, b.bottom / cell, (b.right + cell - 1) / cell, (b.top + cell - 1) / cell};
}

void Limit(const PixelBounds& bounds) {
  glEnable(GL_SCISSOR_TEST);
  glScissor(bounds.left, bounds.bottom, bounds.width(), bounds.height());
}

void AllocateSky(GlTexture& texture) {
  AllocateImage(texture, GL_RGBA16F, {kSkyMapSize, kSkyMapSize}, GL_RGBA, GL_FLOAT);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
}

// Sets the cones, four in one vec4.
void SetCones(const ShaderProgram& shaders) {
  const char* const names[] = {"cones_x", "cones_y", "cones_z", "cones_cosine"};
  for (int part = 0; part < 4; ++part) {
    std::array<glm::vec4, kSkyConeCount / 4> lanes;
    for (int i = 0; i < kSkyConeCount; ++i) {
      lanes[static_cast<size_t>(i / 4)][i % 4] = SkyCones()[static_cast<size_t>(i)][part];
    }
    shaders.Set(names[part], lanes);
  }
}

}  // namespace

Result<CatcherPass> CatcherPass::Create() {
  CatcherPass pass;
  pass.no_vertices_ = GlVertexArray::Generate();
  pass.blockers_ = GlBuffer::Generate();
  glBindBuffer(GL_UNIFORM_BUFFER, pass.blockers_.id());
  glBufferData(GL_UNIFORM_BUFFER, sizeof(BlockerBlock), nullptr, GL_STREAM_DRAW);
  AllocateSky(pass.sky_);
  AllocateSky(pass.sky_irradiance_);
  AllocateSky(pass.picture_irradiance_);
  pass.lamp_walls_.Create();
  pass.UploadSky({}, {});
  return pass;
}

Status CatcherPass::Compile() {
  if (compiled_) {
    return Status();
  }
  LARARIUM_ASSIGN_OR_RETURN(surface_shaders_,
                            ShaderProgram::Create("catcher_surface.vert", "catcher_surface.frag"));
  LARARIUM_ASSIGN_OR_RETURN(ratio_shaders_,
                            ShaderProgram::Create("full_screen.vert", "sky_ratio.frag"));
  ratio_shaders_.BindUniformBlock("Blockers", kBlockerBinding);
  ratio_shaders_.Use();
  SetCones(ratio_shaders_);
  ratio_shaders_.Set("cone_axis", SkyConeAxis());
  ratio_shaders_.Set("least_share", kLeastBlockedShare);
  LARARIUM_ASSIGN_OR_RETURN(caught_shaders_,
                            ShaderProgram::Create("full_screen.vert", "caught.frag"));
  compiled_ = true;
  return Status();
}

Status CatcherPass::Prepare(const ImageSize& size) {
  if (size == size_) {
    return Status();
  }
  size_ = size;
  AllocateImage(normal_, GL_RGB10_A2, size, GL_RGBA, GL_UNSIGNED_INT_2_10_10_10_REV);
  AllocateImage(depth_, GL_DEPTH_COMPONENT24, size, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT);
  surface_framebuffer_ = GlFramebuffer::Generate();
  glBindFramebuffer(GL_FRAMEBUFFER, surface_framebuffer_.id());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, normal_.id(), 0);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_.id(), 0);
  LARARIUM_RETURN_IF_ERROR(CheckFramebuffer("shadows into images"));
  LARARIUM_RETURN_IF_ERROR(
      AllocateColour(ratio_, ratio_framebuffer_, Coarse(size, kLeastCell), GL_NEAREST));
  return AllocateColour(caught_, caught_framebuffer_, size, GL_LINEAR);
}

void CatcherPass::UploadSky(const light::ShRgb& light, const light::ShRgb& picture) {
  if (sky_is_there_ && light == uploaded_light_ && picture == uploaded_picture_) {
    return;
  }
  const auto upload = [this](const GlTexture& texture) {
    glBindTexture(GL_TEXTURE_2D, texture.id());
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, kSkyMapSize, kSkyMapSize, GL_RGBA, GL_FLOAT,
                    sky_map_.data());
  };
  FillSkyMap(light, sky_map_);
  upload(sky_);
  FillIrradianceMap(light, sky_map_);
  upload(sky_irradiance_);
  FillIrradianceMap(picture, sky_map_);
  upload(picture_irradiance_);
  uploaded_light_ = light;
  uploaded_picture_ = picture;
  sky_is_there_ = true;
}

void CatcherPass::UploadBlockers() {
  glBindBuffer(GL_UNIFORM_BUFFER, blockers_.id());
  glBufferSubData(GL_UNIFORM_BUFFER, 0, sizeof(BlockerBlock), &clusters_.block());
}

void CatcherPass::ChooseLamps(const RenderScene& scene) {
  const glm::vec3 sky = light::EvaluateIrradiance(PictureLight(scene), glm::vec3(0.0f, 1.0f, 0.0f));
  least_lamp_ = std::max(kLeastLampShare * std::max({sky.r, sky.g, sky.b}), 1e-4f);
  const glm::vec3 eye = geometry::ToGlm(scene.camera_from_stage->Center());
  lamps_.Choose(scene.lamps, eye, scene.far, least_lamp_);
  lamp_walls_.Upload(lamps_.walls());
}

Box CatcherPass::ReachOfLamps(const RenderScene& scene) const {
  Box reach;
  for (const light::Lamp& lamp : scene.lamps) {
    const glm::vec3 far(light::ReachOf(lamp, least_lamp_));
    reach.Extend(lamp.position - far);
    reach.Extend(lamp.position + far);
  }
  return reach;
}

PixelBounds CatcherPass::FindBounds(const RenderScene& scene,
                                    const SlotMap<GpuMesh>& meshes,
                                    const SunPass& sun,
                                    const PictureView& view) const {
  ScreenBounds bounds;
  const Box lamp_reach = ReachOfLamps(scene);
  for (const SceneOccluder& occluder : scene.occluders) {
    if (occluder.receives_shadow) {
      const Box box = Transformed(meshes.Find(occluder.mesh)->box, occluder.stage_from_mesh);
      bounds.Extend(Intersection(box, clusters_.reach()), view.clip_from_stage);
      bounds.Extend(Intersection(box, sun.shadows()), view.clip_from_stage);
      bounds.Extend(Intersection(box, lamp_reach), view.clip_from_stage);
    }
  }
  return bounds.Pixels(view.size.width, view.size.height);
}

void CatcherPass::DrawSurfaces(const RenderScene& scene,
                               const SlotMap<GpuMesh>& meshes,
                               const PictureView& view) const {
  glBindFramebuffer(GL_FRAMEBUFFER, surface_framebuffer_.id());
  glViewport(0, 0, view.size.width, view.size.height);
  Limit(kept_bounds_);
  glClearColor(0.5f, 0.5f, 0.5f, 0.0f);
  glClearDepthf(1.0f);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glEnable(GL_DEPTH_TEST);
  surface_shaders_.Use();
  surface_shaders_.Set("clip_from_stage", view.clip_from_stage);
  surface_shaders_.Set("eye_in_stage", view.eye_in_stage);
  for (const SceneOccluder& occluder : scene.occluders) {
    surface_shaders_.Set("stage_from_mesh", occluder.stage_from_mesh);
    surface_shaders_.Set("receives", occluder.receives_shadow ? 1.0f : 0.0f);
    meshes.Find(occluder.mesh)->Draw();
  }
  glDisable(GL_DEPTH_TEST);
}

void CatcherPass::BindSurfaces(const ShaderProgram& shaders,
                               const PictureView& view,
                               uint32_t first_unit) const {
  glActiveTexture(GL_TEXTURE0 + first_unit);
  glBindTexture(GL_TEXTURE_2D, normal_.id());
  glActiveTexture(GL_TEXTURE0 + first_unit + 1);
  glBindTexture(GL_TEXTURE_2D, depth_.id());
  shaders.Set("surface_normal", static_cast<int>(first_unit));
  shaders.Set("surface_depth", static_cast<int>(first_unit + 1));
  shaders.Set("catcher_bounds", Corners(kept_bounds_));
  shaders.Set("eye_in_stage", view.eye_in_stage);
  shaders.Set("ray_at_corner", view.ray_at_corner);
  shaders.Set("ray_per_column", view.ray_per_column);
  shaders.Set("ray_per_row", view.ray_per_row);
  shaders.Set("near_far", glm::vec2(view.near, view.far));
  shaders.Set("shadow_cell", cell_);
}

void CatcherPass::DrawRatio(const PictureView& view) const {
  const ImageSize coarse = Coarse(view.size, cell_);
  glBindFramebuffer(GL_FRAMEBUFFER, ratio_framebuffer_.id());
  glViewport(0, 0, coarse.width, coarse.height);
  Limit(Coarse(kept_bounds_, cell_));
  ratio_shaders_.Use();
  BindSurfaces(ratio_shaders_, view, 0);
  glActiveTexture(GL_TEXTURE2);
  glBindTexture(GL_TEXTURE_2D, sky_.id());
  ratio_shaders_.Set("sky", 2);
  glActiveTexture(GL_TEXTURE3);
  glBindTexture(GL_TEXTURE_2D, picture_irradiance_.id());
  ratio_shaders_.Set("picture_irradiance", 3);
  lamps_.Set(ratio_shaders_);
  lamp_walls_.Bind(ratio_shaders_, 4);
  ratio_shaders_.Set("least_lamp", least_lamp_);
  ratio_shaders_.Set("cluster_count", clusters_.cluster_count());
  glBindBufferBase(GL_UNIFORM_BUFFER, kBlockerBinding, blockers_.id());
  glBindVertexArray(no_vertices_.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glBindVertexArray(0);
  glDisable(GL_SCISSOR_TEST);
}

Status CatcherPass::DrawKept(const RenderScene& scene,
                             const Quality& quality,
                             const SlotMap<GpuMesh>& meshes,
                             const SunPass& sun,
                             const PictureView& view) {
  ChooseLamps(scene);
  kept_bounds_ = FindBounds(scene, meshes, sun, view);
  if (kept_bounds_.empty()) {
    return Status();
  }
  cell_ = quality.shadow_cell;
  step_ = cell_ < kHalvingCell ? 1 : 2;
  LARARIUM_RETURN_IF_ERROR(Compile());
  LARARIUM_RETURN_IF_ERROR(Prepare(view.size));
  UploadSky(scene.light, PictureLight(scene));
  UploadBlockers();
  DrawSurfaces(scene, meshes, view);
  DrawRatio(view);
  return Status();
}

void CatcherPass::DrawCaught(const SunPass& sun, const PictureView& view, const Hiding& hiding) {
  bounds_ = kept_bounds_;
  if (bounds_.empty()) {
    return;
  }
  const ImageSize size = Coarse(view.size, step_);
  glBindFramebuffer(GL_FRAMEBUFFER, caught_framebuffer_.id());
  glViewport(0, 0, size.width, size.height);
  Limit(Coarse(bounds_, step_));
  caught_shaders_.Use();
  BindSurfaces(caught_shaders_, view, 0);
  const auto bind = [&](GLuint texture, int unit, const char* name) {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    glBindTexture(GL_TEXTURE_2D, texture);
    caught_shaders_.Set(name, unit);
  };
  bind(ratio_.id(), 2, "sky_ratio");
  bind(sky_irradiance_.id(), 3, "sky_irradiance");
  bind(hiding.people, 4, "people");
  caught_shaders_.Set("people_bounds", Corners(hiding.bounds));
  caught_shaders_.Set("hidden_margin", hiding.margin + (step_ > 1 ? step_ : 0));
  caught_shaders_.Set("caught_step", step_);
  sun.BindFor(caught_shaders_);
  glBindVertexArray(no_vertices_.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glBindVertexArray(0);
  glDisable(GL_SCISSOR_TEST);
}

void CatcherPass::BindFor(const ShaderProgram& shaders, uint32_t unit) const {
  glActiveTexture(GL_TEXTURE0 + unit);
  glBindTexture(GL_TEXTURE_2D, caught_.id());
  shaders.Set("caught", static_cast<int>(unit));
  shaders.Set("caught_step", static_cast<float>(step_));
  shaders.Set("catcher_bounds", Corners(bounds_));
}

}  // namespace lararium::render
