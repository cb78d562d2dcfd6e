#include "shared/render/passes/sun_pass.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

namespace lararium::render {
namespace {

constexpr std::array<int, 2> kMapSizes = {1024, 512};
// The map of occluders is reused while it covers the required box and is at most kMostKept times
// as large.
constexpr float kRoom = 0.3f;  // metres
constexpr float kMostKept = 2.0f;
// The edges of the map of people are rounded to steps of at most this share of its size, so that
// it covers the same box for several pictures.
constexpr float kStepShare = 1.0f / 32.0f;
// Limit on the length of shadows when the sun is low.
constexpr float kLongestShadow = 15.0f;  // metres

// Turns the stage so that Z points away from the sun.
glm::mat4 SunFromStage(const glm::vec3& direction) {
  const glm::vec3 away = -glm::normalize(direction);
  const glm::vec3 aside =
      std::abs(away.y) < 0.9f ? glm::vec3(0.0f, 1.0f, 0.0f) : glm::vec3(1.0f, 0.0f, 0.0f);
  const glm::vec3 x = glm::normalize(glm::cross(aside, away));
  return glm::mat4(glm::transpose(glm::mat3(x, glm::cross(away, x), away)));
}

void ExtendBy(const ModelDraw& draw, const glm::mat4& target_from_stage, Box& box) {
  const glm::mat4 target_from_model = target_from_stage * draw.stage_from_model;
  for (size_t joint = 0; joint < draw.model->joint_count(); ++joint) {
    if (draw.Shows(joint)) {
      box = Union(
          box, Transformed(draw.model->joint_boxes[joint], target_from_model * draw.skin[joint]));
    }
  }
  for (const SceneVertices& moved : draw.vertices) {
    if (moved.posed) {
      Box own;
      for (const glm::vec3& position : moved.positions) {
        own.Extend(position);
      }
      box = Union(box, Transformed(own, target_from_model));
    }
  }
}

Box BoxOf(std::span<const ModelDraw> draws, const glm::mat4& target_from_stage) {
  Box box;
  for (const ModelDraw& draw : draws) {
    ExtendBy(draw, target_from_stage, box);
  }
  return box;
}

Box BoxOf(const RenderScene& scene,
          const SlotMap<GpuMesh>& meshes,
          const glm::mat4& target_from_stage) {
  Box box;
  for (const SceneOccluder& occluder : scene.occluders) {
    box = Union(box, Transformed(meshes.Find(occluder.mesh)->box,
                                 target_from_stage * occluder.stage_from_mesh));
  }
  return box;
}

// The box that the shadows of a box's content pass through, down to the height `lowest`.
Box Swept(const Box& box, const glm::vec3& towards_sun, float lowest) {
  const float depth = std::max(box.high.y - lowest, 0.0f);
  const float length = std::min(depth / std::max(towards_sun.y, 1e-3f), kLongestShadow);
  return Union(box, {box.low - length * towards_sun, box.high - length * towards_sun});
}

Box Widened(const Box& box, float metres) { return {box.low - metres, box.high + metres}; }

// The box of a box's shadows, including their penumbras.
Box ShadowOf(const Box& box, const light::Sun& sun, float lowest) {
  return Widened(Swept(box, sun.direction, lowest), kLongestShadow * std::tan(sun.angular_radius));
}

// Grows a box to a grid whose step is a power of two, in metres.
Box Snapped(const Box& box) {
  const glm::vec3 size = box.high - box.low;
  const float share = kStepShare * std::max({size.x, size.y, size.z});
  const float step = std::exp2(std::floor(std::log2(share)));
  return {step * glm::floor(box.low / step), step * glm::ceil(box.high / step)};
}

void CopyDepth(GLuint from, GLuint to, int size) {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, from);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, to);
  glBlitFramebuffer(0, 0, size, size, 0, 0, size, size, GL_DEPTH_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_FRAMEBUFFER, to);
}

}  // namespace

Result<SunPass> SunPass::Create() {
  SunPass pass;
  LARARIUM_ASSIGN_OR_RETURN(pass.occluder_shaders_,
                            ShaderProgram::Create("occluder.vert", "occluder.frag"));
  // Shaders need bound maps even if there is no sun.
  for (size_t i = 0; i < kMapSizes.size(); ++i) {
    LARARIUM_RETURN_IF_ERROR(pass.AllocateAll(i, 1));
  }
  pass.plain_depth_ = GlSampler::Generate();
  glSamplerParameteri(pass.plain_depth_.id(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glSamplerParameteri(pass.plain_depth_.id(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glSamplerParameteri(pass.plain_depth_.id(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glSamplerParameteri(pass.plain_depth_.id(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glSamplerParameteri(pass.plain_depth_.id(), GL_TEXTURE_COMPARE_MODE, GL_NONE);
  return pass;
}

Status SunPass::AllocateAll(size_t index, int size) {
  for (Image* image : {&people_.images[index], &still_images_[index], &occluders_.images[index]}) {
    LARARIUM_RETURN_IF_ERROR(Allocate(size, *image));
  }
  return Status();
}

Status SunPass::Allocate(int size, Image& image) {
  image.size = size;
  image.depth = GlTexture::Generate();
  glBindTexture(GL_TEXTURE_2D, image.depth.id());
  // Maps are some metres deep, so 16 bits resolve fractions of a millimetre.
  glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT16, size, size, 0, GL_DEPTH_COMPONENT,
               GL_UNSIGNED_SHORT, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  image.framebuffer = GlFramebuffer::Generate();
  glBindFramebuffer(GL_FRAMEBUFFER, image.framebuffer.id());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, image.depth.id(), 0);
  const GLenum none = GL_NONE;
  glDrawBuffers(1, &none);
  glReadBuffer(GL_NONE);
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    return Status::Error("graphics", "the driver cannot draw maps of shadows", "update the driver");
  }
  return Status();
}

void SunPass::Fit(const Box& box, const glm::mat4& sun_from_stage, Map& map) {
  map.size = glm::max(box.high - box.low, glm::vec3(0.01f));
  glm::mat4 map_from_sun(1.0f);
  for (int axis = 0; axis < 3; ++axis) {
    map_from_sun[axis][axis] = 1.0f / map.size[axis];
    map_from_sun[3][axis] = -box.low[axis] / map.size[axis];
  }
  map.map_from_stage = map_from_sun * sun_from_stage;
}

glm::mat4 SunPass::Begin(const Map& map, const Image& image) {
  glBindFramebuffer(GL_FRAMEBUFFER, image.framebuffer.id());
  glViewport(0, 0, image.size, image.size);
  glDisable(GL_SCISSOR_TEST);
  glEnable(GL_DEPTH_TEST);
  glClearDepthf(1.0f);
  glClear(GL_DEPTH_BUFFER_BIT);
  // The offset keeps slanting surfaces from shadowing themselves within a texel.
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(2.0f, 4.0f);
  glm::mat4 clip_from_map(2.0f);
  clip_from_map[3] = glm::vec4(-1.0f, -1.0f, -1.0f, 1.0f);
  return clip_from_map * map.map_from_stage;
}

void SunPass::DrawCasters(ModelPass& models, std::span<const ModelDraw> casters) {
  casters_.Sort(casters);
  if (casters_.still().empty()) {
    models.DrawCasters(Begin(people_, people_.image()), casters);
    return;
  }
  const Image& still = still_images_[people_.chosen];
  if (!casters_.same() || still_chosen_ != people_.chosen ||
      still_map_from_stage_ != people_.map_from_stage) {
    models.DrawCasters(Begin(people_, still), casters_.still());
    still_chosen_ = people_.chosen;
    still_map_from_stage_ = people_.map_from_stage;
  }
  const glm::mat4 clip_from_stage = Begin(people_, people_.image());
  CopyDepth(still.framebuffer.id(), people_.image().framebuffer.id(), still.size);
  models.DrawCasters(clip_from_stage, casters_.moving());
}

bool SunPass::KeepsOccluders(const RenderScene& scene,
                             const glm::mat4& sun_from_stage,
                             const Box& covered) const {
  const auto same = [](const SceneOccluder& a, const SceneOccluder& b) {
    return a.mesh == b.mesh && a.stage_from_mesh == b.stage_from_mesh;
  };
  const auto holds = [&](const Box& box) {
    return glm::all(glm::greaterThanEqual(covered.low, box.low)) &&
           glm::all(glm::lessThanEqual(covered.high, box.high));
  };
  const glm::vec3 wanted = covered.high - covered.low;
  const glm::vec3 kept = kept_.covered.high - kept_.covered.low;
  return kept_.chosen == occluders_.chosen && kept_.sun_from_stage == sun_from_stage &&
         !kept_.covered.empty() && holds(kept_.covered) &&
         kept.x * kept.y < kMostKept * (wanted.x + 2.0f * kRoom) * (wanted.y + 2.0f * kRoom) &&
         std::equal(kept_.occluders.begin(), kept_.occluders.end(), scene.occluders.begin(),
                    scene.occluders.end(), same);
}

void SunPass::DrawOccluders(const RenderScene& scene,
                            const SlotMap<GpuMesh>& meshes,
                            const glm::mat4& sun_from_stage,
                            const Box& covered) {
  if (KeepsOccluders(scene, sun_from_stage, covered)) {
    return;
  }
  kept_.occluders.assign(scene.occluders.begin(), scene.occluders.end());
  kept_.sun_from_stage = sun_from_stage;
  kept_.covered = covered;
  // Leaves room at the sides for people to move.
  kept_.covered.low -= glm::vec3(kRoom, kRoom, 0.0f);
  kept_.covered.high += glm::vec3(kRoom, kRoom, 0.0f);
  kept_.chosen = occluders_.chosen;
  Fit(kept_.covered, sun_from_stage, occluders_);
  const glm::mat4 clip_from_stage = Begin(occluders_, occluders_.image());
  occluder_shaders_.Use();
  for (const SceneOccluder& occluder : scene.occluders) {
    occluder_shaders_.Set("clip_from_mesh", clip_from_stage * occluder.stage_from_mesh);
    meshes.Find(occluder.mesh)->Draw();
  }
}

// Props are always kept, so that the image of still props can be reused when the camera turns.
void SunPass::ChooseCasters(std::span<const ModelDraw> all, const PictureView& view, float lowest) {
  chosen_.clear();
  for (const ModelDraw& draw : all) {
    const Box box = BoxOf({&draw, 1}, glm::mat4(1.0f));
    ScreenBounds bounds;
    if (!box.empty()) {
      bounds.Extend(ShadowOf(box, sun_, lowest), view.clip_from_stage);
    }
    if (draw.model->skin == GpuModel::Skin::kRigid ||
        !bounds.Pixels(view.size.width, view.size.height).empty()) {
      chosen_.push_back(draw);
    }
  }
}

Status SunPass::Draw(const RenderScene& scene,
                     const Quality& quality,
                     const PictureView& view,
                     const SlotMap<GpuMesh>& meshes,
                     ModelPass& models,
                     std::span<const ModelDraw> casters,
                     const Box& around) {
  Skip();
  if (!scene.sun) {
    return Status();
  }
  sun_ = *scene.sun;
  sun_.direction = glm::normalize(sun_.direction);
  shines_ = true;
  taps_ = quality.sun_taps;
  people_.chosen = occluders_.chosen = quality.sun_map < kMapSizes[0] ? 1 : 0;
  if (people_.image().size != kMapSizes[people_.chosen]) {
    LARARIUM_RETURN_IF_ERROR(AllocateAll(people_.chosen, kMapSizes[people_.chosen]));
  }
  const glm::mat4 sun_from_stage = SunFromStage(sun_.direction);
  const Box things = BoxOf(scene, meshes, glm::mat4(1.0f));
  const Box all = BoxOf(casters, glm::mat4(1.0f));
  ChooseCasters(casters, view, std::min(things.empty() ? all.low.y : things.low.y, all.low.y));
  const Box people = BoxOf(chosen_, glm::mat4(1.0f));
  if (!people.empty() && !things.empty()) {
    shadows_ = ShadowOf(people, sun_, things.low.y);
  }
  // Penumbras and filters need a small margin.
  Box fitted = people.empty() ? Widened({glm::vec3(0.0f), glm::vec3(0.0f)}, 1.0f)
                              : BoxOf(chosen_, sun_from_stage);
  fitted = Snapped(Widened(fitted, 0.05f));
  Fit(fitted, sun_from_stage, people_);
  DrawCasters(models, chosen_);

  Box asked = Union(Union(people, shadows_), around);
  Box covered = asked.empty() ? fitted : Transformed(asked, sun_from_stage);
  const Box depths = BoxOf(scene, meshes, sun_from_stage);
  if (!depths.empty()) {
    covered.low.z = depths.low.z;
    covered.high.z = depths.high.z;
  }
  DrawOccluders(scene, meshes, sun_from_stage, Widened(covered, 0.05f));
  glDisable(GL_POLYGON_OFFSET_FILL);
  glDisable(GL_DEPTH_TEST);
  return Status();
}

void SunPass::Skip() {
  shines_ = false;
  shadows_ = {};
}

void SunPass::BindFor(const ShaderProgram& shaders) const {
  shaders.Set("has_sun", shines_ ? 1 : 0);
  shaders.Set("sun_direction", sun_.direction);
  shaders.Set("sun_irradiance", sun_.irradiance);
  shaders.Set("sun_slope", std::tan(sun_.angular_radius));
  shaders.Set("sun_taps", taps_);
  shaders.Set("sun_searches", (taps_ + 2) / 2);
  const auto bind = [&](const Map& map, uint32_t unit, const std::array<const char*, 4>& names) {
    for (const uint32_t of_map : {unit, unit + 1}) {
      glActiveTexture(GL_TEXTURE0 + of_map);
      glBindTexture(GL_TEXTURE_2D, map.image().depth.id());
    }
    glBindSampler(unit + 1, plain_depth_.id());
    shaders.Set(names[0], static_cast<int>(unit));
    shaders.Set(names[1], static_cast<int>(unit + 1));
    shaders.Set(names[2], map.map_from_stage);
    shaders.Set(names[3], map.size);
  };
  bind(people_, kFirstUnit,
       {"people_map", "people_map_depth", "people_map_from_stage", "people_map_size"});
  bind(occluders_, kFirstUnit + 2,
       {"occluder_map", "occluder_map_depth", "occluder_map_from_stage", "occluder_map_size"});
  glActiveTexture(GL_TEXTURE0);
}

}  // namespace lararium::render
