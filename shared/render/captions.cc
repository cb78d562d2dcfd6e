#include "shared/render/captions.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <utility>

#include "shared/render/gl_object.h"
#include "shared/render/shader_program.h"

namespace lararium::render {
namespace {

constexpr float kLetterShare = 0.046f;  // of the height
constexpr float kSmallestPx = 14.0f;
constexpr float kWidest = 0.9f;     // of the width
constexpr float kNameSize = 0.72f;  // of the text's
constexpr float kRowStep = 1.32f;   // em
constexpr float kPadding = 0.5f;    // em
constexpr float kMargin = 0.05f;    // of the height, below
constexpr float kGap = 0.35f;       // em, between captions
constexpr float kGroundOpacity = 0.66f;
constexpr float kLegendShare = 0.031f;  // of the height
constexpr float kSmallestLegendPx = 12.0f;
constexpr float kLegendWidth = 0.46f;                     // of the width: its text
constexpr float kLegendTop = 0.04f;                       // of the height, and as far from the left
constexpr int kMostLegendRows = 8;                        // of its text
constexpr float kSwatch = 0.95f;                          // em
constexpr float kSwatchGap = 0.5f;                        // em, to its text
constexpr float kSwatchStripes = 2.4f;                    // on its side
constexpr float kRadius = 0.014f;                         // of the height: of the ground's corners
constexpr std::string_view kArrowLeft = "\xE2\x86\x90 ";  // U+2190
constexpr std::string_view kArrowRight = " \xE2\x86\x92";  // U+2192

template <typename Visit>
void ForEachRow(std::string_view text, Visit visit) {
  while (!text.empty()) {
    const size_t end = std::min(text.find('\n'), text.size());
    visit(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

float NameWidth(const CaptionFont& font, const Caption& caption) {
  const float arrow = caption.side == CaptionSide::kHere   ? 0.0f
                      : caption.side == CaptionSide::kLeft ? TextWidth(font, kArrowLeft)
                                                           : TextWidth(font, kArrowRight);
  return kNameSize * (TextWidth(font, caption.speaker) + arrow);
}

// A caption from its bottom edge upwards; gives its top edge.
float LayOutOne(const CaptionFont& font,
                const Caption& caption,
                glm::vec2 size,
                float bottom,
                CaptionLayout& layout) {
  float widest = NameWidth(font, caption);
  int rows = 0;
  ForEachRow(caption.text, [&](std::string_view row) {
    widest = std::max(widest, TextWidth(font, row));
    ++rows;
  });
  const float em = std::min(std::max(kLetterShare * size.y, kSmallestPx),
                            kWidest * size.x / std::max(widest + 2.0f * kPadding, 1.0f));
  const bool named = !caption.speaker.empty();
  const float high = em * (kRowStep * (static_cast<float>(rows) + (named ? kNameSize : 0.0f)) +
                           2.0f * kPadding - (kRowStep - 1.0f));
  const float top = bottom - high;
  const float half = em * (0.5f * widest + kPadding);
  layout.grounds.push_back({{0.5f * size.x - half, top}, {0.5f * size.x + half, bottom}});
  const auto middle = [&](float width_em, float y) {
    return glm::vec2(std::round(0.5f * (size.x - em * width_em)), std::round(y));
  };
  float baseline = top + em * (kPadding + 0.78f * (named ? kNameSize : 1.0f));
  if (named) {
    layout.rows.push_back({caption.speaker, middle(NameWidth(font, caption), baseline),
                           kNameSize * em, caption.colour, caption.side});
    baseline += em * (kRowStep * kNameSize + 0.78f * (1.0f - kNameSize));
  }
  ForEachRow(caption.text, [&](std::string_view row) {
    layout.rows.push_back({row, middle(TextWidth(font, row), baseline), em, glm::vec3(1.0f)});
    baseline += em * kRowStep;
  });
  return top - kGap * em;
}

// The first row of a text that is no wider than so many em: whole words, or one that is
// wider. Takes it off the text.
std::string_view TakeRow(const CaptionFont& font, float widest, std::string_view& text) {
  size_t end = 0;
  while (end < text.size() && text[end] != '\n') {
    const size_t next = std::min(text.find_first_of(" \n", end + 1), text.size());
    if (end > 0 && TextWidth(font, text.substr(0, next)) > widest) {
      break;
    }
    end = next;
  }
  const std::string_view row = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return row;
}

struct Vertex {
  glm::vec2 place;       // pixels of the target
  glm::vec2 coordinate;  // letters: in the atlas, 0..1; grounds: pixels from the middle
  glm::vec4 colour;
  glm::vec2 extent;  // of a ground: half its size, pixels
};

}  // namespace

void LayOut(const CaptionFont& font,
            std::span<const Caption> captions,
            int width,
            int height,
            CaptionLayout& layout) {
  layout.rows.clear();
  layout.grounds.clear();
  layout.swatches.clear();
  const glm::vec2 size(width, height);
  float bottom = size.y * (1.0f - kMargin);
  for (const Caption& caption : captions) {
    if (!caption.text.empty()) {
      bottom = LayOutOne(font, caption, size, bottom, layout);
    }
  }
}

void LayOutLegend(
    const CaptionFont& font, const Legend& legend, int width, int height, CaptionLayout& layout) {
  const glm::vec2 size(width, height);
  const float em = std::max(kLegendShare * size.y, kSmallestLegendPx);
  const glm::vec2 corner(std::round(kLegendTop * size.y));
  const float left = corner.x + em * kPadding;
  float baseline = corner.y + em * (kPadding + 0.78f);
  float widest = 0.0f;  // pixels
  const auto add = [&](std::string_view text, float indent, const glm::vec3& colour) {
    layout.rows.push_back({text, glm::vec2(std::round(left + indent), std::round(baseline)), em,
                           colour, CaptionSide::kHere});
    widest = std::max(widest, indent + em * TextWidth(font, text));
    baseline += em * kRowStep;
  };
  const size_t ground = layout.grounds.size();
  layout.grounds.push_back({corner, corner});
  for (const LegendEntry& entry : legend.entries) {
    const glm::vec2 from(left, std::round(baseline - 0.83f * em));
    layout.swatches.push_back(
        {{from, from + em * kSwatch}, entry.colour, entry.stripes, em * kSwatch / kSwatchStripes});
    add(entry.text, em * (kSwatch + kSwatchGap), glm::vec3(1.0f));
  }
  if (!legend.title.empty()) {
    baseline += em * kGap;
    add(legend.title, 0.0f, legend.title_colour);
  }
  std::string_view text = legend.text;
  for (int row = 0; row < kMostLegendRows && !text.empty(); ++row) {
    add(TakeRow(font, kLegendWidth * size.x / em, text), 0.0f, glm::vec3(1.0f));
  }
  layout.grounds[ground].to = {left + widest + em * kPadding,
                               baseline - em * (kRowStep - 0.22f - kPadding)};
}

struct CaptionPainter::State {
  CaptionFont font;
  ShaderProgram ground_pass;
  ShaderProgram letter_pass;
  GlTexture atlas = GlTexture::Generate();
  GlVertexArray vertex_array = GlVertexArray::Generate();
  GlBuffer buffer = GlBuffer::Generate();
  CaptionLayout layout;
  std::vector<Vertex> vertices;

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

  void AddText(std::string_view text, float em, glm::vec4 colour, glm::vec2& pen) {
    const glm::vec2 atlas_size(font.atlas.cols, font.atlas.rows);
    for (size_t at = 0; at < text.size();) {
      const CaptionGlyph* glyph = font.Find(NextCharacter(text, at));
      if (glyph == nullptr) {
        continue;
      }
      if (glyph->to.x > glyph->from.x) {
        AddQuad(pen + em * glyph->from, pen + em * glyph->to, glyph->atlas_from / atlas_size,
                glyph->atlas_to / atlas_size, colour);
      }
      pen.x += em * glyph->advance;
    }
  }

  void AddRow(const CaptionLayout::Row& row) {
    const glm::vec4 colour(row.colour, 1.0f);
    glm::vec2 pen = row.baseline;
    if (row.side == CaptionSide::kLeft) {
      AddText(kArrowLeft, row.em, colour, pen);
    }
    AddText(row.text, row.em, colour, pen);
    if (row.side == CaptionSide::kRight) {
      AddText(kArrowRight, row.em, colour, pen);
    }
  }

  void Flush(const ShaderProgram& pass, glm::vec2 size) {
    if (vertices.empty()) {
      return;
    }
    glBindVertexArray(vertex_array.id());
    glBindBuffer(GL_ARRAY_BUFFER, buffer.id());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(Vertex)),
                 vertices.data(), GL_STREAM_DRAW);
    pass.Use();
    pass.Set("size_px", size);
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

  void UploadAtlas() const {
    const cv::Mat texels = font.atlas.isContinuous() ? font.atlas : font.atlas.clone();
    glBindTexture(GL_TEXTURE_2D, atlas.id());
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
};

CaptionPainter::CaptionPainter(std::unique_ptr<State> state) : state_(std::move(state)) {}
CaptionPainter::~CaptionPainter() = default;

Result<std::unique_ptr<CaptionPainter>> CaptionPainter::Create(CaptionFont font) {
  auto state = std::make_unique<State>();
  LARARIUM_ASSIGN_OR_RETURN(state->ground_pass,
                            ShaderProgram::Create("caption.vert", "caption_ground.frag"));
  LARARIUM_ASSIGN_OR_RETURN(state->letter_pass,
                            ShaderProgram::Create("caption.vert", "caption_letter.frag"));
  state->font = std::move(font);
  state->DefineVertices();
  state->UploadAtlas();
  return std::unique_ptr<CaptionPainter>(new CaptionPainter(std::move(state)));
}

void CaptionPainter::Draw(std::span<const Caption> captions,
                          const Legend* legend,
                          const RenderTarget& target) {
  State& state = *state_;
  LayOut(state.font, captions, target.width(), target.height(), state.layout);
  if (legend != nullptr) {
    LayOutLegend(state.font, *legend, target.width(), target.height(), state.layout);
  }
  if (state.layout.grounds.empty()) {
    return;
  }
  glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer());
  glViewport(0, 0, target.width(), target.height());
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glEnable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  const glm::vec2 size(target.width(), target.height());

  const auto add_ground = [&](const CaptionLayout::Ground& ground, const glm::vec4& colour) {
    const glm::vec2 half = 0.5f * (ground.to - ground.from);
    state.AddQuad(ground.from, ground.to, -half, half, colour);
  };
  for (const CaptionLayout::Ground& ground : state.layout.grounds) {
    add_ground(ground, glm::vec4(0.0f, 0.0f, 0.0f, kGroundOpacity));
  }
  state.ground_pass.Use();
  state.ground_pass.Set("radius_px", kRadius * size.y);
  state.ground_pass.Set("stripes", 0);
  state.ground_pass.Set("stripe_px", 1.0f);
  state.Flush(state.ground_pass, size);
  for (const CaptionLayout::Swatch& swatch : state.layout.swatches) {
    add_ground(swatch.place, glm::vec4(swatch.colour, 1.0f));
    state.ground_pass.Set("radius_px", 0.25f * kRadius * size.y);
    state.ground_pass.Set("stripes", swatch.stripes);
    state.ground_pass.Set("stripe_px", swatch.stripe_px);
    state.Flush(state.ground_pass, size);
  }

  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, state.atlas.id());
  state.letter_pass.Use();
  state.letter_pass.Set("atlas", 0);
  for (size_t i = 0; i < state.layout.rows.size(); ++i) {
    const CaptionLayout::Row& row = state.layout.rows[i];
    state.AddRow(row);
    const bool last = i + 1 == state.layout.rows.size();
    if (last || state.layout.rows[i + 1].em != row.em) {
      // How many pixels of the target the whole range of the atlas' values spans.
      state.letter_pass.Set("range_px", 2.0f * state.font.rim_px * row.em / state.font.em_px);
      state.Flush(state.letter_pass, size);
    }
  }
  glDisable(GL_BLEND);
  glBindVertexArray(0);
}

}  // namespace lararium::render
