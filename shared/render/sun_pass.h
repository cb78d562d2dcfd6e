#pragma once

// What the sun sees of people and of real things, so that others know whether they stand
// in their shadow. Private to render.
//
// Two maps: people and props, fitted to them; and occluders, over all that people may
// darken. Real things cast their shadows in the camera's image already: there people's
// shadows must not fall again, and people must not be lit.

#include <array>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "shared/core/id.h"
#include "shared/core/status.h"
#include "shared/light/sun.h"
#include "shared/render/gl_object.h"
#include "shared/render/gpu_mesh.h"
#include "shared/render/model_pass.h"
#include "shared/render/picture_view.h"
#include "shared/render/quality.h"
#include "shared/render/render_scene.h"
#include "shared/render/screen_bounds.h"
#include "shared/render/shader_program.h"
#include "shared/render/still_draws.h"

namespace lararium::render {

class SunPass {
 public:
  static Result<SunPass> Create();

  // casters: all people and props, whether seen or not. around: a box of the stage in
  // which the sun past occluders will be asked for as well.
  // With the first sun memory is taken for the maps.
  Status Draw(const RenderScene& scene,
              const Quality& quality,
              const PictureView& view,
              const SlotMap<GpuMesh>& meshes,
              ModelPass& models,
              std::span<const ModelDraw> casters,
              const Box& around);
  // There is no sun.
  void Skip();
  // Models were removed.
  void ForgetModels() { casters_.Forget(); }

  bool shines() const { return shines_; }
  // A box of the stage that holds all shadows of people as far as they matter; empty
  // without a sun.
  const Box& shadows() const { return shadows_; }
  // For shaders/include/sun.glsl: the units from kFirstUnit on.
  void BindFor(const ShaderProgram& shaders) const;
  static constexpr uint32_t kFirstUnit = 6;
  static constexpr uint32_t kUnits = 4;

 private:
  // An image of depths.
  struct Image {
    int size = 0;
    GlTexture depth;
    GlFramebuffer framebuffer;
  };
  struct Map {
    std::array<Image, 2> images;                 // the finer first
    size_t chosen = 0;                           // of images
    glm::mat4 map_from_stage = glm::mat4(1.0f);  // to 0..1
    glm::vec3 size = glm::vec3(1.0f);            // metres

    const Image& image() const { return images[chosen]; }
  };

  static Status Allocate(int size, Image& image);
  // One image of each map.
  Status AllocateAll(size_t index, int size);
  // Draws go into an image of a map from now on, which is empty at first. Says clip_from_stage.
  static glm::mat4 Begin(const Map& map, const Image& image);
  // Leaves people out who cannot be seen in the picture, and whose shadows cannot.
  void ChooseCasters(std::span<const ModelDraw> all, const PictureView& view, float lowest);
  // What stands still is drawn once, and copied from then on.
  void DrawCasters(ModelPass& models, std::span<const ModelDraw> casters);
  // box: in the axes of sun_from_stage.
  static void Fit(const Box& box, const glm::mat4& sun_from_stage, Map& map);
  // covered: in the axes of sun_from_stage. What has not changed is not drawn again.
  void DrawOccluders(const RenderScene& scene,
                     const SlotMap<GpuMesh>& meshes,
                     const glm::mat4& sun_from_stage,
                     const Box& covered);
  bool KeepsOccluders(const RenderScene& scene,
                      const glm::mat4& sun_from_stage,
                      const Box& covered) const;

  Map people_;
  std::vector<ModelDraw> chosen_;
  StillDraws casters_;
  std::array<Image, 2> still_images_;  // as those of people_: what stands still of them
  size_t still_chosen_ = 0;            // of these: the one that holds something
  glm::mat4 still_map_from_stage_ = glm::mat4(0.0f);
  Map occluders_;
  // What the map of occluders holds.
  struct Kept {
    std::vector<SceneOccluder> occluders;
    glm::mat4 sun_from_stage = glm::mat4(0.0f);
    Box covered;
    size_t chosen = 0;
  };
  Kept kept_;
  GlSampler plain_depth_;  // without comparison
  ShaderProgram occluder_shaders_;
  bool shines_ = false;
  int taps_ = 0;
  light::Sun sun_;
  Box shadows_;
};

}  // namespace lararium::render
