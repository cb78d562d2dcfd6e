#pragma once

// The renderer's passes and what they draw. Private to render.

#include <optional>
#include <span>
#include <vector>

#include "shared/core/id.h"
#include "shared/geometry/camera_model.h"
#include "shared/render/catcher_pass.h"
#include "shared/render/enlarger.h"
#include "shared/render/gl_object.h"
#include "shared/render/gpu_mesh.h"
#include "shared/render/linear_target.h"
#include "shared/render/look_pass.h"
#include "shared/render/model_pass.h"
#include "shared/render/picture_view.h"
#include "shared/render/quality.h"
#include "shared/render/rectifier.h"
#include "shared/render/renderer.h"
#include "shared/render/screen_bounds.h"
#include "shared/render/shader_program.h"
#include "shared/render/sun_mask.h"
#include "shared/render/sun_pass.h"
#include "shared/render/texture.h"

namespace lararium::render {

// People and caught shadows as they are drawn before they go into a picture.
struct Layer {
  PictureView view;
  Smear smear;
  float depth = 1.0f;  // of people, along the view, metres
  // Of the camera that it was drawn for; none: nobody is in it.
  std::optional<geometry::Rigid3> camera_from_stage;
  PixelBounds people;  // what of them is valid
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
  // Of an image that is the picture's, pixel by pixel.
  LateProgram rectified_background_pass{"full_screen.vert", "background.frag",
                                        "#define RECTIFIED\n"};
  LateProgram rectified_composite_pass{"full_screen.vert", "composite.frag", "#define RECTIFIED\n"};
  // With RenderScene::look, and with RenderScene::see_through.
  LateProgram look_composite_pass{"full_screen.vert", "composite.frag", "#define LOOK\n"};
  LateProgram see_through_composite_pass{"full_screen.vert", "composite.frag",
                                         "#define SEE_THROUGH\n"};
  Enlarger enlarger;
  GlVertexArray no_vertices;  // of full-screen passes
  Texture background_image;
  Rectifier rectifier;
  std::optional<RenderTarget> small_picture;  // that is made larger
  LinearTarget people;
  Layer layer;             // drawn last
  ImageSize picture_size;  // likewise
  SlotMap<GpuMesh> meshes;
  SlotMap<GpuModel> models;
  TextureStore textures;
  std::vector<ModelDraw> draws;      // of the picture at hand: what may be seen in it
  std::vector<ModelDraw> all_draws;  // likewise: all

  Status Validate(const RenderScene& scene) const;
  Status ValidateModels(const RenderScene& scene) const;
  Result<ModelHandle> AddModel(Result<GpuModel> model);
  // Fills draws, the nearest first, and all_draws. Says where they may be seen.
  float PropDetail(const RenderScene& scene, const SceneProp& prop) const;
  PixelBounds CollectDraws(const RenderScene& scene, const PictureView& view);
  // Unless it lies outside the picture.
  void CollectDraw(const ModelDraw& draw, const PictureView& view, ScreenBounds& bounds);
  // As the sun mask has their shadows. Nothing is left of older pictures up to clear beyond the
  // bounds.
  Status DrawPeople(const RenderScene& scene,
                    const PictureView& view,
                    const PixelBounds& bounds,
                    int clear);
  void DrawOccluders(std::span<const SceneOccluder> occluders,
                     const glm::mat4& clip_from_stage) const;
  // What keeps the sun off, for draws that may be seen within the bounds.
  Status DrawSunShadows(const RenderScene& scene,
                        const PictureView& view,
                        const PixelBounds& bounds);
  // The halves of a layer, which take about as long: that, and what light real surfaces keep; then
  // people, and the shadows that are caught.
  Status DrawShadows(const RenderScene& scene, const PictureView& view, const PixelBounds& bounds);
  Status DrawLit(const RenderScene& scene, const PictureView& view, const PixelBounds& bounds);
  PictureView LayerView(const RenderScene& scene, const RenderTarget& picture) const;
  void SetBackground(const ShaderProgram& shaders,
                     const RenderScene& scene,
                     const geometry::CameraModel& display) const;
  // Of a rectified image or as it is.
  void UploadBackground(const RenderScene& scene, const geometry::CameraModel& display);
  bool Rectifies(const RenderScene& scene) const;
  // Where the picture is put together: the target, or a smaller one (Quality::full_size).
  Result<const RenderTarget*> ChoosePicture(const RenderScene& scene, const RenderTarget& target);
  // The picture of what is in the layer, made larger where the target is.
  Status PutTogether(const RenderScene& scene,
                     const RenderTarget& picture,
                     const RenderTarget& target);
  // The camera's image, and over it what is in the layer.
  Status Composite(const RenderScene& scene, const RenderTarget& target);
  // What is in the layer, over what is seen through the target.
  Status CompositeSeeThrough(const RenderScene& scene, const RenderTarget& target);
  // Where the layer changes the target: all of it where it was drawn for another pose.
  PixelBounds ChangedBy(const RenderScene& scene, const RenderTarget& target) const;
  // Of the program in use.
  void SetLayer(const ShaderProgram& composite,
                const RenderScene& scene,
                const RenderTarget& target);
  // How far away the people in the picture are on average, along the view; of those who
  // consist of a root joint and others, by the root.
  float PeopleDepth(const PictureView& view) const;
  static Status CheckDriver();
};

}  // namespace lararium::render
