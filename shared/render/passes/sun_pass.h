#pragma once

// Shadow maps of the sun. Private to render.
//
// There are two maps: one of people and props, fitted to them; and one of occluders, over
// everything that people may darken. The camera's image contains the shadows of real objects
// already. Where it has one, people's shadows must not darken it again and people must not be lit.

#include <array>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "shared/core/id.h"
#include "shared/core/status.h"
#include "shared/light/sun.h"
#include "shared/render/gl/gl_object.h"
#include "shared/render/gl/gpu_mesh.h"
#include "shared/render/gl/shader_program.h"
#include "shared/render/passes/model_pass.h"
#include "shared/render/passes/screen_bounds.h"
#include "shared/render/passes/still_draws.h"
#include "shared/render/picture_view.h"
#include "shared/render/quality.h"
#include "shared/render/render_scene.h"

namespace lararium::render {

class SunPass {
 public:
  static Result<SunPass> Create();

  // Draws the maps. casters: all people and props, visible or not. around: a box in stage axes that
  // the map of occluders must cover in addition. Memory for the maps is allocated with the first
  // sun.
  Status Draw(const RenderScene& scene,
              const Quality& quality,
              const PictureView& view,
              const SlotMap<GpuMesh>& meshes,
              ModelPass& models,
              std::span<const ModelDraw> casters,
              const Box& around);
  // Call this instead of Draw if the scene has no sun.
  void Skip();
  // Call this when models were removed.
  void ForgetModels() { casters_.Forget(); }

  bool shines() const { return shines_; }
  // Box in stage axes that contains all relevant shadows of people; empty without a sun.
  const Box& shadows() const { return shadows_; }
  // Sets the uniforms of shaders/include/sun.glsl. Uses the kUnits texture units from kFirstUnit.
  void BindFor(const ShaderProgram& shaders) const;
  static constexpr uint32_t kFirstUnit = 6;
  static constexpr uint32_t kUnits = 4;

 private:
  // A depth image.
  struct Image {
    int size = 0;
    GlTexture depth;
    GlFramebuffer framebuffer;
  };
  struct Map {
    std::array<Image, 2> images;                 // the larger first
    size_t chosen = 0;                           // index into images
    glm::mat4 map_from_stage = glm::mat4(1.0f);  // map coordinates are 0..1
    glm::vec3 size = glm::vec3(1.0f);            // metres

    const Image& image() const { return images[chosen]; }
  };

  static Status Allocate(int size, Image& image);
  // Allocates the image at index in people_, occluders_ and still_images_.
  Status AllocateAll(size_t index, int size);
  // Clears an image and makes it the target of the following draws. Returns clip_from_stage of map.
  static glm::mat4 Begin(const Map& map, const Image& image);
  // Skips people who are outside the picture together with their shadows.
  void ChooseCasters(std::span<const ModelDraw> all, const PictureView& view, float lowest);
  // Draws casters into people_. Still props are drawn once and copied in later pictures.
  void DrawCasters(ModelPass& models, std::span<const ModelDraw> casters);
  // Makes map cover box, which is in the target axes of sun_from_stage.
  static void Fit(const Box& box, const glm::mat4& sun_from_stage, Map& map);
  // covered: box in the target axes of sun_from_stage. Nothing is drawn if the map is up to date.
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
  std::array<Image, 2> still_images_;  // still props only, in the sizes of people_.images
  size_t still_chosen_ = 0;            // index of the still image that is valid
  glm::mat4 still_map_from_stage_ = glm::mat4(0.0f);
  Map occluders_;
  // The content of the map of occluders.
  struct Kept {
    std::vector<SceneOccluder> occluders;
    glm::mat4 sun_from_stage = glm::mat4(0.0f);
    Box covered;
    size_t chosen = 0;
  };
  Kept kept_;
  GlSampler plain_depth_;  // reads depth without comparison
  ShaderProgram occluder_shaders_;
  bool shines_ = false;
  int taps_ = 0;
  light::Sun sun_;
  Box shadows_;
};

}  // namespace lararium::render
