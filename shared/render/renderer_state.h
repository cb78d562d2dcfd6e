#pragma once

// The renderer's passes and what they draw. Private to render.

#include <span>

#include "shared/core/id.h"
#include "shared/geometry/camera_model.h"
#include "shared/render/gl_object.h"
#include "shared/render/gpu_human.h"
#include "shared/render/gpu_mesh.h"
#include "shared/render/linear_target.h"
#include "shared/render/renderer.h"
#include "shared/render/screen_bounds.h"
#include "shared/render/shader_program.h"
#include "shared/render/texture.h"

namespace lararium::render {

struct Renderer::State {
  int samples = 1;
  ShaderProgram occluder_pass;
  ShaderProgram human_pass;
  ShaderProgram composite_pass;
  GlVertexArray no_vertices;  // of the full-screen pass
  GlBuffer skin;              // matrices of all people in the picture
  Texture background_image{Texture::Encoding::kLinear};
  LinearTarget people;
  SlotMap<GpuMesh> meshes;
  SlotMap<GpuHuman> humans;

  Status Validate(const RenderScene& scene) const;
  // Where people may be seen.
  PixelBounds PeopleBounds(std::span<const SceneHuman> scene_humans,
                           const glm::mat4& clip_from_stage,
                           const RenderTarget& target) const;
  Status DrawPeople(const RenderScene& scene,
                    const glm::mat4& clip_from_stage,
                    const PixelBounds& bounds,
                    const RenderTarget& target);
  void DrawOccluders(std::span<const SceneOccluder> occluders,
                     const glm::mat4& clip_from_stage) const;
  void UploadSkins(std::span<const SceneHuman> scene_humans);
  void DrawHumans(const RenderScene& scene, const glm::mat4& clip_from_stage);
  void Composite(const RenderScene& scene,
                 const geometry::CameraModel& display,
                 const PixelBounds& people_bounds,
                 const RenderTarget& target);
};

}  // namespace lararium::render
