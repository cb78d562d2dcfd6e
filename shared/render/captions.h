#pragma once

// Captions over a finished picture: who speaks and what, on a dark ground, in the middle of
// the lower edge; and a legend in the upper left corner.

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "shared/core/status.h"
#include "shared/render/caption_font.h"
#include "shared/render/caption_style.h"
#include "shared/render/flat_painter.h"
#include "shared/render/render_target.h"

namespace lararium::render {

enum class CaptionSide { kHere, kLeft, kRight };

struct Caption {
  std::string_view speaker;               // UTF-8; may be empty
  glm::vec3 colour = glm::vec3(1.0f);     // of the speaker's name, sRGB-encoded
  CaptionSide side = CaptionSide::kHere;  // where to look for a speaker who is out of view
  std::string_view text;                  // rows apart by '\n'
};

// What a colour and its stripes stand for (SceneMark).
struct LegendEntry {
  glm::vec3 colour = glm::vec3(1.0f);  // sRGB-encoded
  int stripes = 0;
  std::string_view text;
};

struct Legend {
  std::span<const LegendEntry> entries;
  // Of what is looked at, below the entries; may be empty.
  std::string_view title;
  glm::vec3 title_colour = glm::vec3(1.0f);  // sRGB-encoded
  std::string_view text;                     // broken into rows as it is laid out
};

// Where the rows of captions come to lie; pixels of the target from its top-left corner.
// Letters are 4.6 % of the height, at least 14 px, and smaller where a row would leave the
// middle nine tenths of the width. Larger ones (CaptionStyle) are in more rows instead, which may
// go on over breaks of the text, and only as large as two such captions fit the height. The first
// caption is lowest.
struct CaptionLayout {
  struct Row {
    std::string_view text;
    glm::vec2 baseline;  // its left end
    float em = 0.0f;     // pixels
    glm::vec3 colour;
    CaptionSide side = CaptionSide::kHere;  // of a name: which arrow stands beside it
  };
  struct Ground {
    glm::vec2 from;
    glm::vec2 to;
    float edge_px = 0.0f;  // in high contrast
  };
  struct Swatch {
    Ground place;
    glm::vec3 colour;
    int stripes = 0;
    float stripe_px = 0.0f;
  };
  std::vector<Row> rows;
  std::vector<Ground> grounds;
  std::vector<Swatch> swatches;
};
// Allocates nothing once the layout has held as many.
void LayOut(const CaptionFont& font,
            std::span<const Caption> captions,
            const CaptionStyle& style,
            int width,
            int height,
            CaptionLayout& layout);

// Adds a legend. Its letters are 3.1 % of the height, at least 12 px; its text takes at most
// the left half of the picture and eight rows.
void LayOutLegend(
    const CaptionFont& font, const Legend& legend, int width, int height, CaptionLayout& layout);

class CaptionPainter {
 public:
  // Uploads the font's atlas; needs the context that it draws with.
  static Result<std::unique_ptr<CaptionPainter>> Create(CaptionFont font);
  ~CaptionPainter();
  CaptionPainter(const CaptionPainter&) = delete;
  CaptionPainter& operator=(const CaptionPainter&) = delete;

  // Over what the target holds. legend: nullptr where there is none.
  void Draw(std::span<const Caption> captions,
            const Legend* legend,
            const CaptionStyle& style,
            const RenderTarget& target);

  // For what else is written in the same letters.
  FlatPainter& flat() { return *flat_; }

 private:
  explicit CaptionPainter(std::unique_ptr<FlatPainter> flat);

  std::unique_ptr<FlatPainter> flat_;
  CaptionLayout layout_;
};

}  // namespace lararium::render
