#pragma once

// Draws captions over a finished picture: speaker and text on a dark ground, in the middle of the
// lower edge. Also draws a legend in the upper left corner.

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "shared/core/status.h"
#include "shared/render/gl/render_target.h"
#include "shared/render/passes/flat_painter.h"
#include "shared/render/text/caption_font.h"
#include "shared/render/text/caption_style.h"

namespace lararium::render {

enum class CaptionSide { kHere, kLeft, kRight };

struct Caption {
  std::string_view speaker;               // UTF-8; may be empty
  glm::vec3 colour = glm::vec3(1.0f);     // colour of the speaker's name, sRGB-encoded
  CaptionSide side = CaptionSide::kHere;  // side on which a speaker outside the view is
  std::string_view text;                  // rows are separated by '\n'
};

// Explains the colour and the stripes of a SceneMark.
struct LegendEntry {
  glm::vec3 colour = glm::vec3(1.0f);  // sRGB-encoded
  int stripes = 0;
  std::string_view text;
};

struct Legend {
  std::span<const LegendEntry> entries;
  // Name of the person or object in the middle of the view, drawn below the entries; may be empty.
  std::string_view title;
  glm::vec3 title_colour = glm::vec3(1.0f);  // sRGB-encoded
  std::string_view text;                     // LayOutLegend breaks it into rows
};

// Positions of captions and legend, pixels of the target from its top-left corner. Letters are
// 4.6 % of the height, at least 14 px; they are smaller if a row would exceed nine tenths of the
// width. Larger letters (CaptionStyle) are broken into more rows instead, ignoring the breaks of
// the text if necessary; they are limited so that two such captions fit the height. The first
// caption is the lowest.
struct CaptionLayout {
  struct Row {
    std::string_view text;
    glm::vec2 baseline;  // left end of the baseline
    float em = 0.0f;     // pixels
    glm::vec3 colour;
    CaptionSide side = CaptionSide::kHere;  // arrow beside a name; kHere: none
  };
  struct Ground {
    glm::vec2 from;
    glm::vec2 to;
    float edge_px = 0.0f;  // width of the edge in high contrast
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
// Fills layout. Reuses its memory, so that it allocates nothing once the layout was large enough.
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
  // Uploads the font's atlas. Needs a current context, the one that it will draw in.
  static Result<std::unique_ptr<CaptionPainter>> Create(CaptionFont font);
  ~CaptionPainter();
  CaptionPainter(const CaptionPainter&) = delete;
  CaptionPainter& operator=(const CaptionPainter&) = delete;

  // Draws over the content of target. legend: nullptr: none.
  void Draw(std::span<const Caption> captions,
            const Legend* legend,
            const CaptionStyle& style,
            const RenderTarget& target);

  // The painter with the same letters, for other text.
  FlatPainter& flat() { return *flat_; }

 private:
  explicit CaptionPainter(std::unique_ptr<FlatPainter> flat);

  std::unique_ptr<FlatPainter> flat_;
  CaptionLayout layout_;
};

}  // namespace lararium::render
