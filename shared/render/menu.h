#pragma once

// What a visitor chooses from, over a finished picture, and the point that they look at.

#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "shared/render/flat_painter.h"

namespace lararium::render {

// Pixels of the target from its top-left corner.
struct MenuCell {
  glm::vec2 from = glm::vec2(0.0f);
  glm::vec2 to = glm::vec2(0.0f);
  std::string text;
  bool selected = false;
  float progress = 0.0f;  // 0..1: how much of it is filled, from the left
};

struct Menu {
  std::vector<MenuCell> cells;
  glm::vec2 gaze = glm::vec2(0.0f);
  bool fades = false;  // cells change their colour evenly in place of being filled
  CaptionStyle style;  // its contrast; letters are as large as the cells let them be
};

// Letters are alike in all cells, and made smaller where a text would not fit its own.
void DrawMenu(FlatPainter& painter, const Menu& menu, const RenderTarget& target);

}  // namespace lararium::render
