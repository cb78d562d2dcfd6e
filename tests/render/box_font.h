#pragma once

#include <string_view>

#include "shared/render/text/caption_font.h"

namespace lararium::test {

// A font in which each of the given letters (in ascending order) is a box of half an em. It has no
// other characters.
inline render::CaptionFont BoxFont(std::string_view letters) {
  render::CaptionFont font;
  font.em_px = 32.0f;
  font.rim_px = 4.0f;
  font.ascent = 0.8f;
  font.descent = 0.2f;
  font.atlas = cv::Mat(32, 16, CV_8UC1, cv::Scalar(255));
  for (const char letter : letters) {
    font.glyphs.push_back({static_cast<uint32_t>(letter),
                           0.5f,
                           {0.0f, -0.5f},
                           {0.5f, 0.0f},
                           {0.0f, 0.0f},
                           {16.0f, 32.0f}});
  }
  return font;
}

}  // namespace lararium::test
