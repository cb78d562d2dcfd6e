#include "shared/render/overlay.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cstddef>
#include <glm/gtc/matrix_transform.hpp>
#include <optional>
#include <utility>

#include "shared/core/check.h"
#include "shared/geometry/glm_convert.h"
#include "shared/render/clip_space.h"
#include "shared/render/gl/gl_object.h"
#include "shared/render/gl/gpu_mesh.h"
#include "shared/render/gl/shader_program.h"

namespace lararium::render {
namespace {

static_assert(sizeof(OverlayPoint) == 16 && sizeof(OverlayLine) == 28);

// A buffer of vertices that may change from frame to frame.
struct Stream {
  GlVertexArray vertex_array = GlVertexArray::Generate();
  GlBuffer buffer = GlBuffer::Generate();

  void Bind() const {
    glBindVertexArray(vertex_array.id());
    glBindBuffer(GL_ARRAY_BUFFER, buffer.id());
  }
  template <typename T>
  void Upload(std::span<const T> items, GLenum usage = GL_STREAM_DRAW) const {
    Bind();
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(items.size_bytes()), items.data(), usage);
  }
};

void DefineAttribute(GLuint location, int count, GLenum type, size_t stride, size_t offset) {
  glVertexAttribPointer(location, count, type, type == GL_FLOAT ? GL_FALSE : GL_TRUE,
                        static_cast<GLsizei>(stride), reinterpret_cast<const void*>(offset));
  glEnableVertexAttribArray(location);
}

Stream PointStream() {
  Stream stream;
  stream.Bind();
  DefineAttribute(0, 3, GL_FLOAT, sizeof(OverlayPoint), offsetof(OverlayPoint, position));
  DefineAttribute(1, 4, GL_UNSIGNED_BYTE, sizeof(OverlayPoint), offsetof(OverlayPoint, colour));
  return stream;
}

Stream LineStream() {
  Stream stream;
  stream.Bind();
  DefineAttribute(0, 3, GL_FLOAT, sizeof(OverlayLine), offsetof(OverlayLine, from));
  DefineAttribute(1, 3, GL_FLOAT, sizeof(OverlayLine), offsetof(OverlayLine, to));
  DefineAttribute(2, 4, GL_UNSIGNED_BYTE, sizeof(OverlayLine), offsetof(OverlayLine, colour));
  for (GLuint location = 0; location < 3; ++location) {
    glVertexAttribDivisor(location, 1);
  }
  return stream;
}

void SetDepth(OverlayDepth depth, bool write) {
  if (depth == OverlayDepth::kOnTop) {
    glDisable(GL_DEPTH_TEST);
  } else {
    glEnable(GL_DEPTH_TEST);
  }
  glDepthMask(write ? GL_TRUE : GL_FALSE);
}

}  // namespace

struct OverlayPoints {
  std::optional<Stream> vertices;
  size_t count = 0;
};

struct Overlay::State {
  SlotMap<GpuMesh> meshes;
  SlotMap<OverlayPoints> point_sets;
  ShaderProgram point_pass;
  ShaderProgram line_pass;
  ShaderProgram mesh_pass;
  Stream lines = LineStream();

  bool drawing = false;
  glm::mat4 camera_from_stage = glm::mat4(1.0f);
  glm::mat4 clip_from_stage = glm::mat4(1.0f);
  glm::vec2 viewport_px = glm::vec2(1.0f);
};

Overlay::Overlay(std::unique_ptr<State> state) : state_(std::move(state)) {}
Overlay::~Overlay() = default;

Result<std::unique_ptr<Overlay>> Overlay::Create() {
  auto state = std::make_unique<State>();
  LARARIUM_ASSIGN_OR_RETURN(state->point_pass,
                            ShaderProgram::Create("overlay_point.vert", "overlay_point.frag"));
  LARARIUM_ASSIGN_OR_RETURN(state->line_pass,
                            ShaderProgram::Create("overlay_line.vert", "overlay_line.frag"));
  LARARIUM_ASSIGN_OR_RETURN(state->mesh_pass,
                            ShaderProgram::Create("overlay_mesh.vert", "overlay_mesh.frag"));
  return std::unique_ptr<Overlay>(new Overlay(std::move(state)));
}

MeshHandle Overlay::AddMesh(const geometry::TriangleMesh& mesh) {
  return state_->meshes.Add(GpuMesh::Create(mesh));
}

void Overlay::RemoveMesh(MeshHandle mesh) { state_->meshes.Remove(mesh); }

PointsHandle Overlay::AddPoints(std::span<const OverlayPoint> points) {
  OverlayPoints set{PointStream(), points.size()};
  set.vertices->Upload(points, GL_STATIC_DRAW);
  return state_->point_sets.Add(std::move(set));
}

void Overlay::RemovePoints(PointsHandle points) { state_->point_sets.Remove(points); }

void Overlay::Begin(const OverlayView& view, const RenderTarget& target) {
  CHECK(!state_->drawing);
  state_->drawing = true;
  const geometry::CameraModel display = view.display.Resized(target.width(), target.height());
  // Render targets store the top row first.
  const glm::mat4 turn_over = glm::scale(glm::mat4(1.0f), glm::vec3(1.0f, -1.0f, 1.0f));
  state_->camera_from_stage = geometry::ToGlm(view.camera_from_stage);
  state_->clip_from_stage =
      turn_over * ClipFromCamera(display, view.near, view.far) * state_->camera_from_stage;
  state_->viewport_px = glm::vec2(target.width(), target.height());

  glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer());
  glViewport(0, 0, target.width(), target.height());
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_STENCIL_TEST);
  glDisable(GL_CULL_FACE);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_LEQUAL);
  glClearDepthf(1.0f);
  glClear(GL_DEPTH_BUFFER_BIT);
  if (view.clear) {
    glClearColor(view.clear->r, view.clear->g, view.clear->b, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT);
  }
  glEnable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  if (epoxy_is_desktop_gl()) {
    glEnable(GL_PROGRAM_POINT_SIZE);
  }
}

Status Overlay::DrawPoints(PointsHandle points, size_t count, float size_px, OverlayDepth depth) {
  CHECK(state_->drawing);
  const OverlayPoints* set = state_->point_sets.Find(points);
  if (set == nullptr) {
    return Status::Error("overlay", "the points were removed");
  }
  SetDepth(depth, true);
  set->vertices->Bind();
  state_->point_pass.Use();
  state_->point_pass.Set("clip_from_stage", state_->clip_from_stage);
  state_->point_pass.Set("size_px", size_px);
  glDrawArrays(GL_POINTS, 0, static_cast<GLsizei>(std::min(count, set->count)));
  return Status();
}

void Overlay::DrawLines(std::span<const OverlayLine> lines, float width_px, OverlayDepth depth) {
  CHECK(state_->drawing);
  SetDepth(depth, true);
  state_->lines.Upload(lines);
  state_->line_pass.Use();
  state_->line_pass.Set("clip_from_stage", state_->clip_from_stage);
  state_->line_pass.Set("viewport_px", state_->viewport_px);
  state_->line_pass.Set("width_px", width_px);
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(lines.size()));
}

Status Overlay::DrawMesh(MeshHandle mesh, const glm::mat4& stage_from_mesh, glm::u8vec4 colour) {
  CHECK(state_->drawing);
  const GpuMesh* gpu = state_->meshes.Find(mesh);
  if (gpu == nullptr) {
    return Status::Error("overlay", "a mesh was removed");
  }
  SetDepth(OverlayDepth::kTest, false);
  state_->mesh_pass.Use();
  state_->mesh_pass.Set("clip_from_mesh", state_->clip_from_stage * stage_from_mesh);
  state_->mesh_pass.Set("camera_from_mesh", state_->camera_from_stage * stage_from_mesh);
  state_->mesh_pass.Set("mesh_colour", glm::vec4(colour) / 255.0f);
  gpu->Draw();
  return Status();
}

void Overlay::End() {
  CHECK(state_->drawing);
  state_->drawing = false;
  glDisable(GL_BLEND);
  glDepthMask(GL_TRUE);
  glBindVertexArray(0);
}

}  // namespace lararium::render
