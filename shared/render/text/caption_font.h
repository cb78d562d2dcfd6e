#pragma once

// The letters that captions are drawn with: an atlas of signed distances. The editor makes it
// (editor/bake/caption_font.h), so players need no font.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <opencv2/core/mat.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/status.h"

namespace lararium::render {

// Lengths are in em (the font's size), y downwards from the baseline.
struct CaptionGlyph {
  uint32_t character = 0;  // Unicode
  float advance = 0.0f;
  // The glyph's rectangle, including the rim of distances. Equal corners: nothing is drawn.
  glm::vec2 from = glm::vec2(0.0f);
  glm::vec2 to = glm::vec2(0.0f);
  // The same rectangle in the atlas, pixels.
  glm::vec2 atlas_from = glm::vec2(0.0f);
  glm::vec2 atlas_to = glm::vec2(0.0f);
};

struct CaptionFont {
  float em_px = 0.0f;   // one em, pixels of the atlas
  float rim_px = 0.0f;  // distance at which the atlas is 0 or 255; 127.5 is the outline
  float ascent = 0.0f;  // height of capitals with accents
  float descent = 0.0f;
  std::vector<CaptionGlyph> glyphs;  // sorted by character
  cv::Mat atlas;                     // CV_8UC1

  // Returns the glyph to draw for a character; nullptr: there is none.
  const CaptionGlyph* Find(uint32_t character) const;
};

// metrics: JSON; atlas: PNG. where: name of both in errors.
Result<CaptionFont> ParseCaptionFont(std::string_view metrics,
                                     std::span<const std::byte> atlas,
                                     const std::string& where);
std::string FormatCaptionMetrics(const CaptionFont& font);

// The width of a text, em.
float TextWidth(const CaptionFont& font, std::string_view text);

// Visits the rows of a text, which are separated by '\n'.
template <typename Visit>
void ForEachRow(std::string_view text, Visit visit) {
  while (!text.empty()) {
    const size_t end = std::min(text.find('\n'), text.size());
    visit(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

}  // namespace lararium::render
