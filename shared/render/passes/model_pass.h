#pragma once

// Draws people and props. Private to render.
//
// Order: opaque parts; then the dense core of partly covered parts (hair, lashes), which writes
// depth; then, with lighting per pixel, their thin fringe, which is blended and writes no depth
// (after Scheuermann, "Practical Real-Time Hair Rendering and Shading", SIGGRAPH 2004 sketches).
// Colours are stored multiplied by coverage.

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "shared/core/status.h"
#include "shared/light/camera_response.h"
#include "shared/render/gl/gl_object.h"
#include "shared/render/gl/gpu_model.h"
#include "shared/render/gl/shader_program.h"
#include "shared/render/passes/key_light.h"
#include "shared/render/passes/lamp_uniforms.h"
#include "shared/render/quality.h"
#include "shared/render/render_scene.h"

namespace lararium::render {

class SunMask;
class SunPass;

// One model in the picture.
struct ModelDraw {
  GpuModel* model = nullptr;
  glm::mat4 stage_from_model = glm::mat4(1.0f);
  std::span<const glm::mat4> skin;  // one for each joint, model frame
  std::span<const SceneVertices> vertices;
  std::span<const glm::vec3> irradiance;     // one for each vertex of all parts; may be empty
  float detail = 0.0f;                       // allowed error, metres
  std::span<const uint8_t> shown;            // one for each part of a prop; empty: all shown
  const light::ProbeLight* light = nullptr;  // nullptr: the scene's light
  float glow = 1.0f;                         // factor on emission
  SceneMark mark;

  bool Shows(size_t prop_part) const { return shown.empty() || shown[prop_part] != 0; }
};

class ModelPass {
 public:
  static Result<ModelPass> Create();

  // Call this first for each picture: models may have moved.
  void BeginPicture() { ++picture_; }

  // Draws into the bound target, and tests and writes its depth. Light and camera come from scene.
  // A shader program is compiled when it is first needed: each takes memory, and one session uses
  // few of them.
  Status Draw(const RenderScene& scene,
              const Quality& quality,
              const glm::mat4& clip_from_stage,
              std::span<const ModelDraw> draws,
              const SunPass& sun,
              const SunMask& sun_mask);
  // Compiles the programs of DrawDepth and DrawCasters. Call it once for each model before these.
  Status PrepareCasters(const GpuModel& model);
  // Draws only depth, of everything with a coverage of at least one half.
  void DrawDepth(const glm::mat4& clip_from_stage, std::span<const ModelDraw> draws);
  // Draws only depth, of both sides, at the level of detail that suits the sun's shadow maps.
  void DrawCasters(const glm::mat4& clip_from_stage, std::span<const ModelDraw> draws);

 private:
  enum class Phase { kOpaque, kCore, kFringe, kDepth, kCaster };
  struct Program {
    ShaderProgram shaders;
    bool ready = false;
    // The draw whose light and lamps the uniforms hold in this picture.
    const ModelDraw* lit_for = nullptr;
  };
  // Lighting per vertex, per pixel, or per pixel with reflections (RenderScene::glossy).
  enum class Shading { kVertices, kPixels, kReflections };
  static constexpr size_t kShadings = 3;
  // Each variant has a program of its own, because branches per vertex or pixel are slow in a
  // software renderer.
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
  Shading shading_ = Shading::kPixels;                          // shading of this picture
  std::array<std::optional<ShaderProgram>, kCasters> casters_;  // compiled on first use
  uint64_t picture_ = 0;
  GlBuffer skin_;  // matrices or dual quaternions of all models in the picture
  GlTexture white_;
  light::ProbeLight scene_light_;
  LampUniforms lamps_;
  std::span<const light::Lamp> scene_lamps_;
  GlTexture glossy_;
  uint64_t glossy_number_ = 0;  // RenderScene::glossy_number of the content of glossy_; 0: none
  GlTexture response_texture_;
  std::optional<light::CameraResponse> response_;  // the content of response_texture_
  // The content of skin_: kMaxJoints matrices for each model. It never shrinks.
  std::vector<glm::mat4> packed_;
};

}  // namespace lararium::render
