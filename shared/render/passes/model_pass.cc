#include "shared/render/passes/model_pass.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <string>

#include "shared/core/units.h"
#include "shared/human/skinning.h"
#include "shared/light/glossy_map.h"
#include "shared/light/lamp.h"
#include "shared/render/detail.h"
#include "shared/render/gl/surface_texture.h"
#include "shared/render/passes/sun_mask.h"
#include "shared/render/passes/sun_pass.h"

namespace lararium::render {
namespace {

constexpr uint32_t kSkinBinding = 0;
// Bytes for each model in the buffer of matrices: the whole uniform block, which is also a multiple
// of the offset alignment of every driver.
constexpr size_t kSkinStride = human::Skeleton::kMaxJoints * sizeof(glm::mat4);

// Allowed error of shadow casters, metres: less than a texel of the sun's map.
constexpr float kCasterDetail = 0.0025f;
// Parts of people must be at least this long to cast shadows; eyes, teeth, brows and lashes do not.
constexpr float kLeastCaster = 0.15f;  // metres

// Coverage from which a pixel belongs to the core, which hides what is behind it. kCoreAlone is
// used if no fringe is drawn.
constexpr float kCore = 0.85f;
constexpr float kCoreAlone = 0.5f;

// Lamps are skipped if their irradiance stays below light::kLeastLampIrradiance within kModelReach
// metres of a model's root.
constexpr float kModelReach = 1.5f;

// Not a unit of the composite: it binds a different kind of texture there.
constexpr uint32_t kGlossyUnit = SunMask::kUnit + 1;
constexpr uint32_t kResponseUnit = kGlossyUnit + 1;

constexpr std::array<const char*, human::kSurfaceCount> kSurfaceNames = {"PLAIN", "SKIN", "HAIR",
                                                                         "CLOTH", "EYE",  "METAL"};

constexpr std::array<const char*, GpuModel::kSkins> kSkinNames = {"LINEAR", "DUAL_QUATERNION",
                                                                  "RIGID"};

std::string SkinDefine(GpuModel::Skin skin) {
  return std::string("#define SKIN_") + kSkinNames[static_cast<size_t>(skin)] + "\n";
}

using PlainIrradiance = std::array<glm::vec3, light::kPlainShCount>;

// Converts radiance to irradiance, multiplied by the constants of the basis as
// shaders/include/spherical_harmonics.glsl needs it.
PlainIrradiance IrradianceCoefficients(const light::ShRgb& radiance) {
  const double first = std::sqrt(3.0 / (4.0 * kPi));
  const double second = std::sqrt(15.0 / (4.0 * kPi));
  const double basis[] = {std::sqrt(1.0 / (4.0 * kPi)),  first,  first,       first, second, second,
                          std::sqrt(5.0 / (16.0 * kPi)), second, 0.5 * second};
  PlainIrradiance coefficients;
  for (int i = 0; i < light::kPlainShCount; ++i) {
    const float convolution = light::ClampedCosineFactor(light::ShBandOf(i));
    coefficients[i] = radiance[i] * (convolution * static_cast<float>(basis[i]));
  }
  return coefficients;
}

// Subsurface scattering: light leaves skin at some distance from where it entered, red furthest. On
// a ball this weakens band l by exp(-l (l + 1) variance / (2 radius^2)). The variances are those of
// the sum of Gaussians of d'Eon & Luebke, "Advanced Techniques for Realistic Real-Time Skin
// Rendering", GPU Gems 3, 2007; the radius is that of a nose or a finger.
void ScatterInSkin(PlainIrradiance& irradiance) {
  const glm::vec3 variance(1.38f, 0.068f, 0.025f);  // mm^2
  constexpr float kRadius = 5.0f;                   // mm
  for (int i = 1; i < light::kPlainShCount; ++i) {
    const float degrees = i < 4 ? 2.0f : 6.0f;
    irradiance[i] *= glm::exp(-degrees * variance / (2.0f * kRadius * kRadius));
  }
}

void PackDualQuaternions(std::span<const glm::mat4> skin, std::span<glm::mat4> packed) {
  std::transform(skin.begin(), skin.end(), packed.begin(), [](const glm::mat4& matrix) {
    const human::DualQuaternion q = human::ToDualQuaternion(matrix);
    return glm::mat4(glm::vec4(q.real.x, q.real.y, q.real.z, q.real.w),
                     glm::vec4(q.dual.x, q.dual.y, q.dual.z, q.dual.w),
                     glm::vec4(q.scale, 0.0f, 0.0f, 0.0f), glm::vec4(0.0f));
  });
}

const SceneVertices* FindVertices(const ModelDraw& draw, size_t part) {
  for (const SceneVertices& vertices : draw.vertices) {
    if (vertices.mesh == part) {
      return &vertices;
    }
  }
  return nullptr;
}

GlTexture CreateGlossyTexture() {
  constexpr GLsizei kSize = light::GlossyMap::kSize;
  GlTexture texture = GlTexture::Generate();
  glBindTexture(GL_TEXTURE_3D, texture.id());
  glTexImage3D(GL_TEXTURE_3D, 0, GL_R11F_G11F_B10F, kSize, kSize, light::GlossyMap::kLayers, 0,
               GL_RGB, GL_UNSIGNED_INT_10F_11F_11F_REV, nullptr);
  for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER}) {
    glTexParameteri(GL_TEXTURE_3D, filter, GL_LINEAR);
  }
  for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R}) {
    glTexParameteri(GL_TEXTURE_3D, wrap, GL_CLAMP_TO_EDGE);
  }
  return texture;
}

GlTexture CreateResponseTexture() {
  GlTexture texture = GlTexture::Generate();
  glBindTexture(GL_TEXTURE_2D, texture.id());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB16F, light::kSeenSteps, 1, 0, GL_RGB, GL_FLOAT, nullptr);
  for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER}) {
    glTexParameteri(GL_TEXTURE_2D, filter, GL_LINEAR);
  }
  for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T}) {
    glTexParameteri(GL_TEXTURE_2D, wrap, GL_CLAMP_TO_EDGE);
  }
  return texture;
}

}  // namespace

Result<ModelPass> ModelPass::Create() {
  ModelPass pass;
  pass.skin_ = GlBuffer::Generate();
  pass.white_ = CreateWhiteTexture();
  pass.glossy_ = CreateGlossyTexture();
  pass.response_texture_ = CreateResponseTexture();
  return pass;
}

Status ModelPass::PrepareCasters(const GpuModel& model) {
  for (const GpuModel::Part& part : model.parts) {
    std::optional<ShaderProgram>& caster = casters_[CasterIndex(model.skin, part.covered())];
    if (!caster) {
      const std::string covered = part.covered() ? "#define COVERED\n" : "";
      LARARIUM_ASSIGN_OR_RETURN(caster, ShaderProgram::Create("model.vert", "caster.frag",
                                                              covered + SkinDefine(model.skin)));
      caster->BindUniformBlock("Skin", kSkinBinding);
      caster->Use();
      caster->Set("colour_texture", 0);
    }
  }
  return Status();
}

size_t ModelPass::Variant::index() const {
  const size_t of_surface =
      GpuModel::kSkins * static_cast<size_t>(surface) + static_cast<size_t>(skin);
  return kShadings * (2 * of_surface + (covered ? 1 : 0)) + static_cast<size_t>(shading);
}

Result<ShaderProgram> ModelPass::Variant::Compile() const {
  std::string defines =
      SkinDefine(skin) + "#define SURFACE_" + kSurfaceNames[static_cast<size_t>(surface)] + "\n";
  if (covered) {
    defines += "#define COVERED\n";
  }
  if (shading == Shading::kReflections) {
    defines += "#define REFLECTIONS\n";
  }
  if (shading == Shading::kVertices) {
    defines += "#define LIT_AT_VERTICES\n";
  }
  LARARIUM_ASSIGN_OR_RETURN(ShaderProgram shaders,
                            ShaderProgram::Create("model.vert", "model.frag", defines));
  shaders.BindUniformBlock("Skin", kSkinBinding);
  return shaders;
}

// Compiles the programs that draws need for the shading of this picture.
Status ModelPass::Prepare(std::span<const ModelDraw> draws) {
  for (const ModelDraw& draw : draws) {
    for (const GpuModel::Part& part : draw.model->parts) {
      const Variant variant = {part.surface, draw.model->skin, part.covered(), shading_};
      Program& program = programs_[variant.index()];
      if (!program.ready) {
        LARARIUM_ASSIGN_OR_RETURN(program.shaders, variant.Compile());
        program.ready = true;
      }
    }
  }
  return Status();
}

void ModelPass::UploadSkins(std::span<const ModelDraw> draws) {
  constexpr size_t kJoints = human::Skeleton::kMaxJoints;
  packed_.resize(std::max(packed_.size(), draws.size() * kJoints));
  for (size_t i = 0; i < draws.size(); ++i) {
    const std::span<glm::mat4> packed = std::span(packed_).subspan(i * kJoints, kJoints);
    if (draws[i].model->skin == GpuModel::Skin::kDualQuaternion) {
      PackDualQuaternions(draws[i].skin, packed);
    } else {
      std::copy(draws[i].skin.begin(), draws[i].skin.end(), packed.begin());
    }
  }
  glBindBuffer(GL_UNIFORM_BUFFER, skin_.id());
  glBufferData(GL_UNIFORM_BUFFER, static_cast<GLsizeiptr>(packed_.size() * sizeof(glm::mat4)),
               packed_.data(), GL_STREAM_DRAW);
}

void ModelPass::BeginFrame(const RenderScene& scene, const SunPass& sun, const SunMask& sun_mask) {
  const Eigen::Vector3d eye = scene.camera_from_stage->Inverse().translation;
  scene_light_ = {scene.light, scene.sun};
  scene_lamps_ = scene.lamps;
  UploadGlossy(scene);
  if (scene.response != nullptr) {
    UploadResponse(*scene.response);
  }
  for (size_t i = 0; i < programs_.size(); ++i) {
    Program& program = programs_[i];
    if (!program.ready || i % kShadings != static_cast<size_t>(shading_)) {
      continue;
    }
    const ShaderProgram& shaders = program.shaders;
    program.lit_for = nullptr;
    shaders.Use();
    shaders.Set("matte_only", scene.matte ? 1 : 0);
    shaders.Set("eye_in_stage", glm::vec3(eye.x(), eye.y(), eye.z()));
    shaders.Set("gain", scene.exposure * scene.gain);
    shaders.Set("knee", std::max(scene.knee, 0.0f));
    shaders.Set("response_is_measured", scene.response != nullptr ? 1 : 0);
    shaders.Set("response", static_cast<int>(kResponseUnit));
    shaders.Set("core_coverage", shading_ == Shading::kVertices ? kCoreAlone : kCore);
    shaders.Set("colour_texture", 0);
    shaders.Set("normal_texture", 1);
    shaders.Set("glossy", static_cast<int>(kGlossyUnit));
    sun.BindFor(shaders);
    sun_mask.BindFor(shaders);
  }
}

KeyLight ModelPass::KeyLightOf(const light::ProbeLight& light) const {
  if (!scene_light_.sun) {
    return EstimateKeyLight(light.sky);
  }
  return {scene_light_.sun->direction, light.sun ? light.sun->irradiance : glm::vec3(0.0f)};
}

void ModelPass::UploadGlossy(const RenderScene& scene) {
  glActiveTexture(GL_TEXTURE0 + kGlossyUnit);
  glBindTexture(GL_TEXTURE_3D, glossy_.id());
  if (!scene.glossy.empty() && scene.glossy_number != glossy_number_) {
    constexpr GLsizei kSize = light::GlossyMap::kSize;
    glTexSubImage3D(GL_TEXTURE_3D, 0, 0, 0, 0, kSize, kSize, light::GlossyMap::kLayers, GL_RGB,
                    GL_UNSIGNED_INT_10F_11F_11F_REV, scene.glossy.data());
    glossy_number_ = scene.glossy_number;
  }
  glActiveTexture(GL_TEXTURE0);
}

void ModelPass::UploadResponse(const light::CameraResponse& response) {
  glActiveTexture(GL_TEXTURE0 + kResponseUnit);
  glBindTexture(GL_TEXTURE_2D, response_texture_.id());
  if (response_ != response) {
    const std::array table = light::SeenTable(response);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, light::kSeenSteps, 1, GL_RGB, GL_FLOAT, table.data());
    response_ = response;
  }
  glActiveTexture(GL_TEXTURE0);
}

// program must be in use.
void ModelPass::SetLight(const ModelDraw& draw, Program& program, bool skin) {
  if (program.lit_for == &draw) {
    return;
  }
  program.lit_for = &draw;
  const light::ProbeLight& light = draw.light != nullptr ? *draw.light : scene_light_;
  const ShaderProgram& shaders = program.shaders;
  const std::array irradiance = IrradianceCoefficients(light.sky);
  std::array scattered = irradiance;
  ScatterInSkin(scattered);
  const KeyLight key = KeyLightOf(light);
  shaders.Set("irradiance", skin ? scattered : irradiance);
  shaders.Set("unscattered", irradiance);
  shaders.Set("key_direction", key.direction);
  shaders.Set("key_irradiance", key.irradiance);
  shaders.Set("glossy_scale",
              glm::max(light.sky[0], 0.0f) / glm::max(scene_light_.sky[0], glm::vec3(1e-4f)));
  const glm::vec3 middle(draw.stage_from_model * draw.skin[0][3]);
  lamps_.Choose(scene_lamps_, middle, kModelReach, light::kLeastLampIrradiance);
  lamps_.Set(shaders);
}

void ModelPass::BindTextures(const GpuModel& model, const GpuModel::Part& part) const {
  const auto texture = [&](int index) {
    return index == GpuModel::kNoTexture ? white_.id()
                                         : model.textures[static_cast<size_t>(index)]->id();
  };
  glActiveTexture(GL_TEXTURE1);
  glBindTexture(GL_TEXTURE_2D, texture(part.normal_texture));
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, texture(part.colour_texture));
}

// For depth alone, faces need no more detail than other surfaces. The shadow of a still prop is
// reused for other viewpoints, so its detail must not depend on the distance.
float ModelPass::DetailOf(const ModelDraw& draw, const GpuModel::Part& part, Phase phase) {
  if (phase != Phase::kDepth && phase != Phase::kCaster) {
    return draw.detail;
  }
  const float least = phase == Phase::kCaster ? kCasterDetail : 0.0f;
  const bool kept = phase == Phase::kCaster && draw.model->skin == GpuModel::Skin::kRigid;
  const float allowed = kept ? least : std::max(draw.detail, least);
  return allowed * human::ErrorShare(part.surface) / human::ErrorShare(human::Surface::kPlain);
}

void ModelPass::DrawPart(const ModelDraw& draw,
                         size_t index,
                         Phase phase,
                         const glm::mat4& clip_from_stage) {
  const GpuModel::Part& part = draw.model->parts[index];
  const SceneVertices* vertices = FindVertices(draw, index);
  if (vertices != nullptr) {
    draw.model->Stream(index, picture_, vertices->positions, vertices->normals);
  }
  const bool only_depth = phase == Phase::kDepth || phase == Phase::kCaster;
  if (!draw.irradiance.empty() && !only_depth) {
    const size_t used = LevelAllowed(part.levels, draw.detail).vertices;
    draw.model->StreamIrradiance(index, picture_, draw.irradiance.subspan(part.first_vertex, used));
  }
  const GpuModel::Skin skin = draw.model->skin;
  Program& program = programs_[Variant{part.surface, skin, part.covered(), shading_}.index()];
  const ShaderProgram& shaders =
      only_depth ? *casters_[CasterIndex(skin, part.covered())] : program.shaders;
  shaders.Use();
  if (!only_depth) {
    SetLight(draw, program, part.surface == human::Surface::kSkin);
  }
  shaders.Set("has_transfer", draw.irradiance.empty() ? 0 : 1);
  shaders.Set("stage_from_model", draw.stage_from_model);
  shaders.Set("clip_from_model", clip_from_stage * draw.stage_from_model);
  shaders.Set("posed", vertices != nullptr && vertices->posed ? 1 : 0);
  shaders.Set("colour_factor", part.colour);
  shaders.Set("emission", draw.glow * part.emission);
  shaders.Set("mark", glm::vec4(draw.mark.colour, draw.mark.share));
  shaders.Set("mark_stripes", draw.mark.stripes);
  shaders.Set("mark_stripe_px", draw.mark.stripe_px);
  shaders.Set("roughness", part.roughness);
  shaders.Set("two_sided", part.culls_back_faces ? 0 : 1);
  shaders.Set("alpha_cutoff", part.alpha_cutoff);
  shaders.Set("has_normal_texture", part.normal_texture == GpuModel::kNoTexture ? 0 : 1);
  shaders.Set("fringe", phase == Phase::kFringe ? 1 : 0);
  BindTextures(*draw.model, part);
  if (part.culls_back_faces && phase != Phase::kCaster) {
    glEnable(GL_CULL_FACE);
  } else {
    glDisable(GL_CULL_FACE);
  }
  draw.model->Draw(index, DetailOf(draw, part, phase), vertices != nullptr);
}

bool ModelPass::IsOf(Phase phase, const GpuModel& model, const GpuModel::Part& part) {
  switch (phase) {
    case Phase::kOpaque:
      return !part.covered();
    case Phase::kCore:
    case Phase::kFringe:
      return part.covered();
    case Phase::kDepth:
      return true;
    case Phase::kCaster:
      return model.skin == GpuModel::Skin::kRigid || part.length >= kLeastCaster;
  }
  return false;
}

// Draws front surfaces first, so that the depth test saves shading of hidden pixels: the nearest
// model first, and in a person the clothes, which are last in the file. Fringes are blended, so
// the furthest model comes first.
void ModelPass::DrawPhase(Phase phase,
                          const glm::mat4& clip_from_stage,
                          std::span<const ModelDraw> draws) {
  for (size_t turn = 0; turn < draws.size(); ++turn) {
    const size_t i = phase == Phase::kFringe ? draws.size() - 1 - turn : turn;
    glBindBufferRange(GL_UNIFORM_BUFFER, kSkinBinding, skin_.id(),
                      static_cast<GLintptr>(i * kSkinStride), kSkinStride);
    for (size_t part = draws[i].model->parts.size(); part-- > 0;) {
      const GpuModel::Part& drawn = draws[i].model->parts[part];
      if (IsOf(phase, *draws[i].model, drawn) && draws[i].Shows(drawn.prop_part)) {
        DrawPart(draws[i], part, phase, clip_from_stage);
      }
    }
  }
}

Status ModelPass::Draw(const RenderScene& scene,
                       const Quality& quality,
                       const glm::mat4& clip_from_stage,
                       std::span<const ModelDraw> draws,
                       const SunPass& sun,
                       const SunMask& sun_mask) {
  glEnable(GL_DEPTH_TEST);
  const bool reflects = quality.reflections && !scene.glossy.empty();
  shading_ = !quality.pixel_light ? Shading::kVertices
             : reflects           ? Shading::kReflections
                                  : Shading::kPixels;
  LARARIUM_RETURN_IF_ERROR(Prepare(draws));
  UploadSkins(draws);
  BeginFrame(scene, sun, sun_mask);
  DrawPhase(Phase::kOpaque, clip_from_stage, draws);
  DrawPhase(Phase::kCore, clip_from_stage, draws);
  if (shading_ != Shading::kVertices) {
    glDepthMask(GL_FALSE);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    DrawPhase(Phase::kFringe, clip_from_stage, draws);
    glDisable(GL_BLEND);
    glDepthMask(GL_TRUE);
  }
  glDisable(GL_CULL_FACE);
  return Status();
}

void ModelPass::DrawDepth(const glm::mat4& clip_from_stage, std::span<const ModelDraw> draws) {
  UploadSkins(draws);
  DrawPhase(Phase::kDepth, clip_from_stage, draws);
  glDisable(GL_CULL_FACE);
}

void ModelPass::DrawCasters(const glm::mat4& clip_from_stage, std::span<const ModelDraw> draws) {
  UploadSkins(draws);
  DrawPhase(Phase::kCaster, clip_from_stage, draws);
  glDisable(GL_CULL_FACE);
}

}  // namespace lararium::render
