#pragma once

// Shadows of people and props on real surfaces and the light of lamps: how much light those
// keep where somebody stands before it, and gain. Private to render.
//
// The nearest real surfaces are drawn with normal and depth; the ratio of the sky's light
// is worked out for one pixel in every few in both directions, and brought to all pixels, each
// from neighbours on its own plane.

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "shared/core/id.h"
#include "shared/core/status.h"
#include "shared/render/blocker_clusters.h"
#include "shared/render/gl_object.h"
#include "shared/render/gpu_mesh.h"
#include "shared/render/lamp_uniforms.h"
#include "shared/render/lamp_wall_texture.h"
#include "shared/render/picture_view.h"
#include "shared/render/quality.h"
#include "shared/render/render_scene.h"
#include "shared/render/screen_bounds.h"
#include "shared/render/shader_program.h"
#include "shared/render/sun_pass.h"

namespace lararium::render {

class CatcherPass {
 public:
  static Result<CatcherPass> Create();
  // The shaders, where they are not there yet; otherwise drawing does it when the first surface is
  // seen.
  Status Compile();

  // The picture's blockers; first.
  void SetBlockers(std::span<const glm::vec4> blockers) { clusters_.Build(blockers); }
  // A box of the stage that holds all that the blockers darken.
  const Box& reach() const { return clusters_.reach(); }

  // The surfaces in view, and how much of the sky's and the lamps' light they keep. What
  // DrawCaught() drew before stays as it is.
  Status DrawKept(const RenderScene& scene,
                  const Quality& quality,
                  const SlotMap<GpuMesh>& meshes,
                  const SunPass& sun,
                  const PictureView& view);

  // What people hide of it: their layer, and how many pixels within their edges are seen through
  // them.
  struct Hiding {
    uint32_t people = 0;  // texture; valid within bounds
    PixelBounds bounds;
    int margin = 0;
  };
  // Of what was drawn last by DrawKept(), for the same sun and view: fills the image within
  // bounds(), which are empty where no shadow can be seen.
  void DrawCaught(const SunPass& sun, const PictureView& view, const Hiding& hiding);
  void Skip() { kept_bounds_ = bounds_ = {}; }

  const PixelBounds& bounds() const { return bounds_; }
  // For the composite.
  void BindFor(const ShaderProgram& shaders, uint32_t unit) const;

 private:
  Status Prepare(const ImageSize& size);
  PixelBounds FindBounds(const RenderScene& scene,
                         const SlotMap<GpuMesh>& meshes,
                         const SunPass& sun,
                         const PictureView& view) const;
  void DrawSurfaces(const RenderScene& scene,
                    const SlotMap<GpuMesh>& meshes,
                    const PictureView& view) const;
  void DrawRatio(const PictureView& view) const;
  void ChooseLamps(const RenderScene& scene);
  Box ReachOfLamps(const RenderScene& scene) const;
  // light: of the people; picture: of the camera's image.
  void UploadSky(const light::ShRgb& light, const light::ShRgb& picture);
  void UploadBlockers();
  void BindSurfaces(const ShaderProgram& shaders,
                    const PictureView& view,
                    uint32_t first_unit) const;

  bool compiled_ = false;
  ShaderProgram surface_shaders_;
  ShaderProgram ratio_shaders_;
  ShaderProgram caught_shaders_;
  GlVertexArray no_vertices_;
  GlBuffer blockers_;
  GlTexture sky_;             // radiance of cones
  GlTexture sky_irradiance_;  // by normal
  GlTexture picture_irradiance_;
  bool sky_is_there_ = false;
  ImageSize size_;
  int cell_ = 4;  // Quality::shadow_cell
  int step_ = 1;  // pixels of the layer for one of caught_, along each side
  GlTexture normal_;
  GlTexture depth_;
  GlFramebuffer surface_framebuffer_;
  GlTexture ratio_;
  GlFramebuffer ratio_framebuffer_;
  GlTexture caught_;
  GlFramebuffer caught_framebuffer_;
  PixelBounds kept_bounds_;  // of surfaces and ratio
  PixelBounds bounds_;       // of caught_
  LampUniforms lamps_;
  LampWallTexture lamp_walls_;
  float least_lamp_ = 0.0f;  // irradiance that would not be seen
  BlockerClusters clusters_;
  light::ShRgb uploaded_light_ = {};
  light::ShRgb uploaded_picture_ = {};
  std::vector<glm::vec4> sky_map_;
};

}  // namespace lararium::render
