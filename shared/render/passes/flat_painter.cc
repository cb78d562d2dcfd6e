#include "shared/render/passes/flat_painter.h"

#include <epoxy/gl.h>

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "shared/core/check.h"
#include "shared/core/utf8.h"
#include "shared/render/gl/gl_object.h"
#include "shared/render/gl/shader_program.h"

namespace lararium::render {
namespace {

struct Vertex {
  glm::vec2 place;       // pixels of the target
  glm::vec2 coordinate;  // letters: position in the atlas, 0..1; rectangles: pixels from the middle
  glm::vec4 colour;
  glm::vec2 extent;  // half the size of a rectangle, pixels
};

// Uploads a CV_8UC1 image. Shaders read the values without conversion.
void UploadGrey(const GlTexture& texture, const cv::Mat& grey) {
  const cv::Mat texels = grey.isContinuous() ? grey : grey.clone();
  glBindTexture(GL_TEXTURE_2D, texture.id());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_R8, texels.cols, texels.rows, 0, GL_RED, GL_UNSIGNED_BYTE,
               texels.data);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER}) {
    glTexParameteri(GL_TEXTURE_2D, filter, GL_LINEAR);
  }
  for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T}) {
    glTexParameteri(GL_TEXTURE_2D, wrap, GL_CLAMP_TO_EDGE);
  }
}

}  // namespace

// Consecutive shapes with the same settings are gathered and drawn together.
struct FlatPainter::State {
  enum class Kind { kNone, kRectangle, kLetter, kPicture };

  CaptionFont font;
  ShaderProgram rectangle_pass;
  ShaderProgram letter_pass;
  ShaderProgram picture_pass;
  GlTexture atlas = GlTexture::Generate();
  GlTexture picture = GlTexture::Generate();
  std::optional<uint64_t> picture_number;
  GlVertexArray vertex_array = GlVertexArray::Generate();
  GlBuffer buffer = GlBuffer::Generate();
  std::vector<Vertex> vertices;
  Kind kind = Kind::kNone;
  float size = 0.0f;  // pixels: radius of gathered rectangles, or em of gathered letters
  Stripes stripes = {0, 1.0f};
  float bolder = 0.0f;  // em
  glm::vec2 target_size = glm::vec2(1.0f);

  void Gather(Kind wanted,
              float wanted_size,
              Stripes wanted_stripes = {0, 1.0f},
              float wanted_bolder = 0.0f) {
    if (kind != wanted || size != wanted_size || stripes != wanted_stripes ||
        bolder != wanted_bolder) {
      Flush();
      kind = wanted;
      size = wanted_size;
      stripes = wanted_stripes;
      bolder = wanted_bolder;
    }
  }

  void AddQuad(glm::vec2 from, glm::vec2 to, glm::vec2 c_from, glm::vec2 c_to, glm::vec4 colour) {
    const glm::vec2 extent = 0.5f * (c_to - c_from);
    const Vertex corners[4] = {{from, c_from, colour, extent},
                               {{to.x, from.y}, {c_to.x, c_from.y}, colour, extent},
                               {{from.x, to.y}, {c_from.x, c_to.y}, colour, extent},
                               {to, c_to, colour, extent}};
    for (const int corner : {0, 1, 2, 2, 1, 3}) {
      vertices.push_back(corners[corner]);
    }
  }

  const ShaderProgram& UsePass() const {
    glActiveTexture(GL_TEXTURE0);
    switch (kind) {
      case Kind::kRectangle:
        rectangle_pass.Use();
        rectangle_pass.Set("radius_px", size);
        rectangle_pass.Set("stripes", stripes.directions);
        rectangle_pass.Set("stripe_px", stripes.step_px);
        return rectangle_pass;
      case Kind::kLetter:
        glBindTexture(GL_TEXTURE_2D, atlas.id());
        letter_pass.Use();
        letter_pass.Set("atlas", 0);
        // Pixels of the target between the values 0 and 1 of the atlas.
        letter_pass.Set("range_px", 2.0f * font.rim_px * size / font.em_px);
        letter_pass.Set("bolder_px", bolder * size);
        return letter_pass;
      default:
        glBindTexture(GL_TEXTURE_2D, picture.id());
        picture_pass.Use();
        picture_pass.Set("picture", 0);
        return picture_pass;
    }
  }

  void Flush() {
    if (vertices.empty()) {
      return;
    }
    const ShaderProgram& pass = UsePass();
    glBindVertexArray(vertex_array.id());
    glBindBuffer(GL_ARRAY_BUFFER, buffer.id());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(Vertex)),
                 vertices.data(), GL_STREAM_DRAW);
    pass.Set("size_px", target_size);
    glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(vertices.size()));
    vertices.clear();
  }

  void DefineVertices() const {
    glBindVertexArray(vertex_array.id());
    glBindBuffer(GL_ARRAY_BUFFER, buffer.id());
    const std::pair<int, size_t> attributes[] = {{2, offsetof(Vertex, place)},
                                                 {2, offsetof(Vertex, coordinate)},
                                                 {4, offsetof(Vertex, colour)},
                                                 {2, offsetof(Vertex, extent)}};
    GLuint location = 0;
    for (const auto& [count, offset] : attributes) {
      glVertexAttribPointer(location, count, GL_FLOAT, GL_FALSE, sizeof(Vertex),
                            reinterpret_cast<const void*>(offset));
      glEnableVertexAttribArray(location++);
    }
    glBindVertexArray(0);
  }
};

FlatPainter::FlatPainter(std::unique_ptr<State> state) : state_(std::move(state)) {}
FlatPainter::~FlatPainter() = default;

Result<std::unique_ptr<FlatPainter>> FlatPainter::Create(CaptionFont font) {
  auto state = std::make_unique<State>();
  LARARIUM_ASSIGN_OR_RETURN(state->rectangle_pass,
                            ShaderProgram::Create("caption.vert", "caption_ground.frag"));
  LARARIUM_ASSIGN_OR_RETURN(state->letter_pass,
                            ShaderProgram::Create("caption.vert", "caption_letter.frag"));
  LARARIUM_ASSIGN_OR_RETURN(state->picture_pass,
                            ShaderProgram::Create("caption.vert", "caption_picture.frag"));
  state->font = std::move(font);
  state->DefineVertices();
  if (!state->font.atlas.empty()) {
    UploadGrey(state->atlas, state->font.atlas);
  }
  return std::unique_ptr<FlatPainter>(new FlatPainter(std::move(state)));
}

const CaptionFont& FlatPainter::font() const { return state_->font; }

void FlatPainter::Begin(const RenderTarget& target) {
  state_->target_size = {target.width(), target.height()};
  glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer());
  glViewport(0, 0, target.width(), target.height());
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glEnable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
}

void FlatPainter::Rectangle(
    glm::vec2 from, glm::vec2 to, float radius_px, glm::vec4 colour, Stripes stripes) {
  state_->Gather(State::Kind::kRectangle, radius_px, stripes);
  const glm::vec2 half = 0.5f * (to - from);
  state_->AddQuad(from, to, -half, half, colour);
}

float FlatPainter::Text(
    std::string_view text, glm::vec2 baseline, float em, glm::vec4 colour, float bolder) {
  State& state = *state_;
  state.Gather(State::Kind::kLetter, em, {0, 1.0f}, bolder);
  const glm::vec2 atlas_size(state.font.atlas.cols, state.font.atlas.rows);
  for (size_t at = 0; at < text.size();) {
    const CaptionGlyph* glyph = state.font.Find(NextCharacter(text, at));
    if (glyph == nullptr) {
      continue;
    }
    if (glyph->to.x > glyph->from.x) {
      state.AddQuad(baseline + em * glyph->from, baseline + em * glyph->to,
                    glyph->atlas_from / atlas_size, glyph->atlas_to / atlas_size, colour);
    }
    baseline.x += em * glyph->advance;
  }
  return baseline.x;
}

void FlatPainter::Picture(
    const cv::Mat& picture, uint64_t number, glm::vec2 from, glm::vec2 to, float opacity) {
  CHECK(picture.type() == CV_8UC1 && !picture.empty());
  State& state = *state_;
  state.Flush();
  if (state.picture_number != number) {
    glActiveTexture(GL_TEXTURE0);
    UploadGrey(state.picture, picture);
    state.picture_number = number;
  }
  state.Gather(State::Kind::kPicture, 0.0f);
  state.AddQuad(from, to, {0.0f, 0.0f}, {1.0f, 1.0f}, {1.0f, 1.0f, 1.0f, opacity});
}

void FlatPainter::End() {
  state_->Flush();
  glDisable(GL_BLEND);
  glBindVertexArray(0);
}

void DrawGround(FlatPainter& painter,
                const Ground& ground,
                float opacity,
                const CaptionStyle& style,
                float shown) {
  if (style.is_high()) {
    const glm::vec2 edge(ground.edge_px);
    painter.Rectangle(ground.from - edge, ground.to + edge, ground.radius_px + ground.edge_px,
                      glm::vec4(1.0f, 1.0f, 1.0f, shown));
    opacity = 1.0f;
  }
  painter.Rectangle(ground.from, ground.to, ground.radius_px,
                    glm::vec4(0.0f, 0.0f, 0.0f, opacity * shown));
}

float BolderOf(const CaptionStyle& style) { return style.is_high() ? 0.02f : 0.0f; }

}  // namespace lararium::render
