#pragma once

// What a visitor is told in the middle of the picture, with a small picture or without, and what
// staff is told in its corner.

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <opencv2/core/mat.hpp>
#include <string_view>

#include "shared/render/flat_painter.h"

namespace lararium::render {

struct Notice {
  std::string_view text;        // rows apart by '\n'; may be empty
  cv::Mat picture;              // CV_8UC1; may be empty
  uint64_t picture_number = 0;  // another one for another picture
  float opacity = 1.0f;
  CaptionStyle style;
};

// Where a notice comes to lie; pixels of the target from its top-left corner.
struct NoticeLayout {
  glm::vec2 from = glm::vec2(0.0f);  // of its ground
  glm::vec2 to = glm::vec2(0.0f);
  glm::vec2 picture_from = glm::vec2(0.0f);
  glm::vec2 picture_to = glm::vec2(0.0f);  // equal: there is none
  float em = 0.0f;
  float first_baseline = 0.0f;
};
// Letters are smaller than their style where they would leave the picture.
NoticeLayout LayOut(const CaptionFont& font, const Notice& notice, int width, int height);

void DrawNotice(FlatPainter& painter, const Notice& notice, const RenderTarget& target);

// A dot of a colour (sRGB) with a row of small letters beside it, in the upper left corner.
void DrawStatus(FlatPainter& painter,
                glm::vec3 colour,
                std::string_view text,
                const RenderTarget& target);

}  // namespace lararium::render
