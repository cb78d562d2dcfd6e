#pragma once

// The renderer's passes, models and images. Private to render.

#include <optional>
#include <span>
#include <vector>

#include "shared/core/id.h"
#include "shared/geometry/camera_model.h"
#include "shared/render/gl/gl_object.h"
#include "shared/render/gl/gpu_mesh.h"
#include "shared/render/gl/linear_target.h"
#include "shared/render/gl/shader_program.h"
#include "shared/render/gl/texture.h"
#include "shared/render/passes/catcher_pass.h"
#include "shared/render/passes/look_pass.h"
#include "shared/render/passes/model_pass.h"
#include "shared/render/passes/rectifier.h"
#include "shared/render/passes/screen_bounds.h"
#include "shared/render/passes/sun_mask.h"
#include "shared/render/passes/sun_pass.h"
#include "shared/render/passes/upscaler.h"
#include "shared/render/picture_view.h"
#include "shared/render/quality.h"
#include "shared/render/renderer.h"

namespace lararium::render {

// State of the layer: people and caught shadows, drawn before they are composed into a picture.
struct CompositeLayer {
  PictureView view;
  MotionBlur motion_blur;
  float depth = 1.0f;  // mean depth of people along the view, metres
  // Pose that the layer was drawn for; nullopt: the layer holds no people.
  std::optional<geometry::Rigid3> camera_from_stage;
  PixelBounds people;  // the part of State::people that is valid
};

struct Renderer::State {
  explicit State(const Quality& at_first)
      : quality(at_first), textures(at_first.texture_halvings) {}

  Quality quality;
  ShaderProgram occluder_pass;
  ModelPass model_pass;
  CatcherPass catcher_pass;
  SunPass sun_pass;
  LookPass look_pass;
  SunMask sun_mask;
  LateProgram background_pass{"full_screen.vert", "background.frag"};
  LateProgram composite_pass{"full_screen.vert", "composite.frag"};
  // The RECTIFIED programs take a background that has the picture's pixels already.
  LateProgram rectified_background_pass{"full_screen.vert", "background.frag",
                                        "#define RECTIFIED\n"};
  LateProgram rectified_composite_pass{"full_screen.vert", "composite.frag", "#define RECTIFIED\n"};
  // For RenderScene::look, and for RenderScene::see_through.
  LateProgram look_composite_pass{"full_screen.vert", "composite.frag", "#define LOOK\n"};
  LateProgram see_through_composite_pass{"full_screen.vert", "composite.frag",
                                         "#define SEE_THROUGH\n"};
  Upscaler upscaler;
  GlVertexArray no_vertices;  // bound in full-screen passes
  Texture background_image;
  Rectifier rectifier;
  Texture foreground_image;
  Rectifier foreground_rectifier;
  std::optional<RenderTarget> small_picture;  // the composed picture before upscaling
  LinearTarget people;
  CompositeLayer layer;    // the layer that was drawn last
  ImageSize picture_size;  // size of the picture that layer was drawn for
  SlotMap<GpuMesh> meshes;
  SlotMap<GpuModel> models;
  TextureStore textures;
  std::vector<ModelDraw> draws;      // models that may be visible in the current picture
  std::vector<ModelDraw> all_draws;  // all models of the current picture

  Status Validate(const RenderScene& scene) const;
  Status ValidateModels(const RenderScene& scene) const;
  Result<ModelHandle> AddModel(Result<GpuModel> model);
  // Error allowed for a prop, metres, from its size in the picture.
  float PropDetail(const RenderScene& scene, const SceneProp& prop) const;
  // Fills draws (nearest first) and all_draws. Returns the pixels that draws may cover.
  PixelBounds CollectDraws(const RenderScene& scene, const PictureView& view);
  // Appends a draw to draws, unless it lies outside the picture.
  void CollectDraw(const ModelDraw& draw, const PictureView& view, ScreenBounds& bounds);
  // Draws people and props into `people`. Clears older content up to `clear` pixels beyond bounds.
  Status DrawPeople(const RenderScene& scene,
                    const PictureView& view,
                    const PixelBounds& bounds,
                    int clear);
  void DrawOccluders(std::span<const SceneOccluder> occluders,
                     const glm::mat4& clip_from_stage) const;
  // Draws the sun's shadow maps, and the sun mask of draws within bounds.
  Status DrawSunShadows(const RenderScene& scene,
                        const PictureView& view,
                        const PixelBounds& bounds);
  // The two halves of drawing a layer, which take about the same time. DrawShadows: shadow maps,
  // and how much light reaches real surfaces. DrawLit: people, and the shadows that real surfaces
  // catch.
  Status DrawShadows(const RenderScene& scene, const PictureView& view, const PixelBounds& bounds);
  Status DrawLit(const RenderScene& scene, const PictureView& view, const PixelBounds& bounds);
  PictureView LayerView(const RenderScene& scene, const RenderTarget& picture) const;
  void SetBackground(const ShaderProgram& shaders,
                     const RenderScene& scene,
                     const geometry::CameraModel& display) const;
  // Uploads the camera's image, rectified first if Rectifies(scene).
  void UploadBackground(const RenderScene& scene, const geometry::CameraModel& display);
  bool Rectifies(const RenderScene& scene) const;
  // Uploads RenderScene::foreground with the rays of a picture, and sets it in the program in use.
  void SetForeground(const ShaderProgram& composite,
                     const RenderScene& scene,
                     const geometry::CameraModel& display);
  // Returns where the picture is composed: the target, or a smaller one (Quality::full_size).
  Result<const RenderTarget*> ChoosePicture(const RenderScene& scene, const RenderTarget& target);
  // Composes the layer into picture, and upscales it if the target is larger.
  Status PutTogether(const RenderScene& scene,
                     const RenderTarget& picture,
                     const RenderTarget& target);
  // The program that draws the layer over the scene's background.
  LateProgram& CompositePass(const RenderScene& scene);
  // Draws the camera's image and the layer over it, or for RenderScene::see_through the layer alone
  // with alpha.
  Status Composite(const RenderScene& scene, const RenderTarget& target);
  // Returns the pixels of the target that the layer changes: all if it was drawn for another pose.
  PixelBounds ChangedBy(const RenderScene& scene, const RenderTarget& target) const;
  // Sets the layer's textures and uniforms in composite, which must be the program in use.
  void SetLayer(const ShaderProgram& composite,
                const RenderScene& scene,
                const RenderTarget& target);
  // Mean depth of draws along the view, metres, measured at the root joint of each model.
  float PeopleDepth(const PictureView& view) const;
  static Status CheckDriver();
};

}  // namespace lararium::render
