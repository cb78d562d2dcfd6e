#pragma once

// The letters that captions are drawn with: an atlas of signed distances, made by the editor
// (editor/bake/caption_font.h), so that players need no font.

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
  glm::vec2 from = glm::vec2(0.0f);        // of its rectangle, which the distances' rim is part of
  glm::vec2 to = glm::vec2(0.0f);          // equal: nothing is drawn
  glm::vec2 atlas_from = glm::vec2(0.0f);  // likewise in the atlas, pixels
  glm::vec2 atlas_to = glm::vec2(0.0f);
};

struct CaptionFont {
  float em_px = 0.0f;   // pixels of the atlas
  float rim_px = 0.0f;  // distance at which the atlas is 0 or 255; 127.5 is the outline
  float ascent = 0.0f;  // of capitals with accents
  float descent = 0.0f;
  std::vector<CaptionGlyph> glyphs;  // by character
  cv::Mat atlas;                     // CV_8UC1

  // What stands for a character: nullptr where there is nothing.
  const CaptionGlyph* Find(uint32_t character) const;
};

// metrics: JSON; atlas: PNG. place: what errors call them.
Result<CaptionFont> ParseCaptionFont(std::string_view metrics,
                                     std::span<const std::byte> atlas,
                                     const std::string& place);
std::string FormatCaptionMetrics(const CaptionFont& font);

// The character at `at`, which moves behind it. What is no UTF-8 is U+FFFD.
uint32_t NextCharacter(std::string_view text, size_t& at);

// How wide a text is, em.
float TextWidth(const CaptionFont& font, std::string_view text);

// Visits the rows of a text, which are apart by '\n'.
template <typename Visit>
void ForEachRow(std::string_view text, Visit visit) {
  while (!text.empty()) {
    const size_t end = std::min(text.find('\n'), text.size());
    visit(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

}  // namespace lararium::render
