#pragma once

// Shadows of people and props, and light of lamps, on real surfaces: the factor by which they
// change the light of each surface. Private to render.
//
// The nearest real surfaces are drawn with normal and depth. The ratio of the sky's light is
// computed on a coarse grid of pixels and upsampled to all pixels; each pixel uses grid values
// from its own plane.

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "shared/core/id.h"
#include "shared/core/status.h"
#include "shared/render/gl/gl_object.h"
#include "shared/render/gl/gpu_mesh.h"
#include "shared/render/gl/shader_program.h"
#include "shared/render/passes/blocker_clusters.h"
#include "shared/render/passes/lamp_uniforms.h"
#include "shared/render/passes/lamp_wall_texture.h"
#include "shared/render/passes/screen_bounds.h"
#include "shared/render/passes/sun_pass.h"
#include "shared/render/picture_view.h"
#include "shared/render/quality.h"
#include "shared/render/render_scene.h"

namespace lararium::render {

class CatcherPass {
 public:
  static Result<CatcherPass> Create();
  // Compiles the shaders, unless that is done. Otherwise the first picture with a visible surface
  // compiles them.
  Status Compile();

  // Sets the blockers of the picture. Call this before the other functions that draw it.
  void SetBlockers(std::span<const glm::vec4> blockers) { clusters_.Build(blockers); }
  // Box in stage axes that contains everything the blockers darken.
  const Box& reach() const { return clusters_.reach(); }

  // Draws the visible surfaces, and the ratio of the sky's and the lamps' light on them. Does not
  // touch the image of DrawCaught().
  Status DrawKept(const RenderScene& scene,
                  const Quality& quality,
                  const SlotMap<GpuMesh>& meshes,
                  const SunPass& sun,
                  const PictureView& view);

  // The layer of people, which hides surfaces behind it.
  struct Hiding {
    uint32_t people = 0;  // texture, valid within bounds
    PixelBounds bounds;
    // Pixels inside the edge of people through which surfaces may still be visible.
    int margin = 0;
  };
  // Computes the image of caught shadows from the last DrawKept(), for the same sun and view. The
  // image is valid within bounds(), which are empty if no shadow can be visible.
  void DrawCaught(const SunPass& sun, const PictureView& view, const Hiding& hiding);
  void Skip() { kept_bounds_ = bounds_ = {}; }

  const PixelBounds& bounds() const { return bounds_; }
  // Binds the image of caught shadows for the composite shader, which must be in use.
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
  // light: radiance that lights people; picture: radiance at the time of the camera's image.
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
  GlTexture sky_;             // radiance averaged over cones, indexed by direction
  GlTexture sky_irradiance_;  // indexed by normal
  GlTexture picture_irradiance_;
  bool sky_is_there_ = false;
  ImageSize size_;
  int cell_ = 4;  // Quality::shadow_cell
  int step_ = 1;  // width and height, in pixels of the layer, of one pixel of caught_
  GlTexture normal_;
  GlTexture depth_;
  GlFramebuffer surface_framebuffer_;
  GlTexture ratio_;
  GlFramebuffer ratio_framebuffer_;
  GlTexture caught_;
  GlFramebuffer caught_framebuffer_;
  PixelBounds kept_bounds_;  // valid part of the surface images and of ratio_
  PixelBounds bounds_;       // valid part of caught_
  LampUniforms lamps_;
  LampWallTexture lamp_walls_;
  float least_lamp_ = 0.0f;  // irradiance below which a lamp is not visible on surfaces
  BlockerClusters clusters_;
  light::ShRgb uploaded_light_ = {};
  light::ShRgb uploaded_picture_ = {};
  std::vector<glm::vec4> sky_map_;
};

}  // namespace lararium::render
