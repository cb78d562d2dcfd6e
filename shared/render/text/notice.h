#pragma once

// Draws a notice for the visitor in the middle of the picture, with or without a small picture,
// and a status line for the staff in its corner.

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <opencv2/core/mat.hpp>
#include <string_view>

#include "shared/render/passes/flat_painter.h"

namespace lararium::render {

struct Notice {
  std::string_view text;        // rows are separated by '\n'; may be empty
  cv::Mat picture;              // CV_8UC1; may be empty
  uint64_t picture_number = 0;  // changes whenever picture does
  float opacity = 1.0f;
  CaptionStyle style;
};

// Positions of a notice, pixels of the target from its top-left corner.
struct NoticeLayout {
  glm::vec2 from = glm::vec2(0.0f);  // top left corner of the ground
  glm::vec2 to = glm::vec2(0.0f);
  glm::vec2 picture_from = glm::vec2(0.0f);
  glm::vec2 picture_to = glm::vec2(0.0f);  // equal to picture_from: no picture
  float em = 0.0f;
  float first_baseline = 0.0f;
};
// Letters are smaller than the style asks for if they would not fit into the picture.
NoticeLayout LayOut(const CaptionFont& font, const Notice& notice, int width, int height);

void DrawNotice(FlatPainter& painter, const Notice& notice, const RenderTarget& target);

// Draws a dot with a row of small letters beside it in the upper left corner. colour:
// sRGB-encoded.
void DrawStatus(FlatPainter& painter,
                glm::vec3 colour,
                std::string_view text,
                const RenderTarget& target);

}  // namespace lararium::render
