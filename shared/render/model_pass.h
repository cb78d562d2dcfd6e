#pragma once

// Draws people and props. Private to render.
//
// First what is opaque; then of what is partly covered (hair, lashes) the dense core,
// which hides what is behind it; then, where surfaces are lit at pixels, its thin fringe,
// blended over all that and hiding nothing (after Scheuermann, "Practical Real-Time Hair Rendering
// and Shading", SIGGRAPH 2004 sketches). Colour is stored times coverage.

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "shared/core/status.h"
#include "shared/light/camera_response.h"
#include "shared/render/gl_object.h"
#include "shared/render/gpu_model.h"
#include "shared/render/key_light.h"
#include "shared/render/lamp_uniforms.h"
#include "shared/render/quality.h"
#include "shared/render/render_scene.h"
#include "shared/render/shader_program.h"

namespace lararium::render {

class SunMask;
class SunPass;

// One model in the picture.
struct ModelDraw {
  GpuModel* model = nullptr;
  glm::mat4 stage_from_model = glm::mat4(1.0f);
  std::span<const glm::mat4> skin;  // one for each joint, model frame
  std::span<const SceneVertices> vertices;
  std::span<const glm::vec3> irradiance;     // of all vertices of all parts; may be empty
  float detail = 0.0f;                       // metres that may be off
  std::span<const uint8_t> shown;            // of a prop's parts; empty: all
  const light::ProbeLight* light = nullptr;  // nullptr: the scene's
  float glow = 1.0f;                         // times emission
  SceneMark mark;

  bool Shows(size_t prop_part) const { return shown.empty() || shown[prop_part] != 0; }
};

class ModelPass {
 public:
  static Result<ModelPass> Create();

  // Before all else of a picture: models may have moved.
  void BeginPicture() { ++picture_; }

  // Into the bound target, whose depth it tests and writes. Light and camera are the
  // scene's. Programs are compiled when they are wanted first: each takes memory, and few
  // qualities are drawn at.
  Status Draw(const RenderScene& scene,
              const Quality& quality,
              const glm::mat4& clip_from_stage,
              std::span<const ModelDraw> draws,
              const SunPass& sun,
              const SunMask& sun_mask);
  // For DrawDepth and DrawCasters: once for each model, before it is drawn.
  Status PrepareCasters(const GpuModel& model);
  // Depth alone, of what is at least half there, as Draw would have it.
  void DrawDepth(const glm::mat4& clip_from_stage, std::span<const ModelDraw> draws);
  // The same, only as fine as maps of the sun are, and both sides of all.
  void DrawCasters(const glm::mat4& clip_from_stage, std::span<const ModelDraw> draws);

 private:
  enum class Phase { kOpaque, kCore, kFringe, kDepth, kCaster };
  struct Program {
    ShaderProgram shaders;
    bool ready = false;
    // Whose light and lamps its uniforms hold in this picture.
    const ModelDraw* lit_for = nullptr;
  };
  // At each vertex, at each pixel, or there with reflections (RenderScene::glossy).
  enum class Shading { kVertices, kPixels, kReflections };
  static constexpr size_t kShadings = 3;
  // Of what software should not decide for each vertex or pixel there are programs.
  struct Variant {
    human::Surface surface = human::Surface::kPlain;
    GpuModel::Skin skin = GpuModel::Skin::kLinear;
    bool covered = false;
    Shading shading = Shading::kPixels;

    size_t index() const;
    Result<ShaderProgram> Compile() const;
  };
  static constexpr size_t kVariants = human::kSurfaceCount * GpuModel::kSkins * 2 * kShadings;
  static constexpr size_t kCasters = GpuModel::kSkins * 2;
  static size_t CasterIndex(GpuModel::Skin skin, bool covered) {
    return 2 * static_cast<size_t>(skin) + (covered ? 1 : 0);
  }

  Status Prepare(std::span<const ModelDraw> draws);
  void UploadSkins(std::span<const ModelDraw> draws);
  void BeginFrame(const RenderScene& scene, const SunPass& sun, const SunMask& sun_mask);
  KeyLight KeyLightOf(const light::ProbeLight& light) const;
  void SetLight(const ModelDraw& draw, Program& program, bool skin);
  void UploadGlossy(const RenderScene& scene);
  void UploadResponse(const light::CameraResponse& response);
  static bool IsOf(Phase phase, const GpuModel& model, const GpuModel::Part& part);
  void DrawPhase(Phase phase, const glm::mat4& clip_from_stage, std::span<const ModelDraw> draws);
  static float DetailOf(const ModelDraw& draw, const GpuModel::Part& part, Phase phase);
  void DrawPart(const ModelDraw& draw, size_t part, Phase phase, const glm::mat4& clip_from_stage);
  void BindTextures(const GpuModel& model, const GpuModel::Part& part) const;

  std::array<Program, kVariants> programs_;
  Shading shading_ = Shading::kPixels;                          // of this picture
  std::array<std::optional<ShaderProgram>, kCasters> casters_;  // that some model has parts for
  uint64_t picture_ = 0;
  GlBuffer skin_;  // matrices or dual quaternions of all models in the picture
  GlTexture white_;
  light::ProbeLight scene_light_;
  LampUniforms lamps_;
  std::span<const light::Lamp> scene_lamps_;
  GlTexture glossy_;
  uint64_t glossy_number_ = 0;  // of what glossy_ holds; 0: of nothing
  GlTexture response_texture_;
  std::optional<light::CameraResponse> response_;  // that it holds
  // What skin_ holds: kMaxJoints for each model; of as many as were ever drawn at once.
  std::vector<glm::mat4> packed_;
};

}  // namespace lararium::render
