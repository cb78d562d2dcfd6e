#pragma once

// Draws the visitor's menu over a finished picture, and the point that the visitor looks at.

#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "shared/render/passes/flat_painter.h"

namespace lararium::render {

// Positions are pixels of the target from its top-left corner.
struct MenuCell {
  glm::vec2 from = glm::vec2(0.0f);
  glm::vec2 to = glm::vec2(0.0f);
  std::string text;
  bool selected = false;
  float progress = 0.0f;  // 0..1: the share of the cell that is filled, from the left
};

struct Menu {
  std::vector<MenuCell> cells;
  glm::vec2 gaze = glm::vec2(0.0f);
  bool fades = false;  // true: progress blends the colour of the whole cell instead of filling it
  CaptionStyle style;  // only its contrast is used: the cells determine the size of letters
};

// Letters have the same size in all cells, small enough for every text to fit its cell.
void DrawMenu(FlatPainter& painter, const Menu& menu, const RenderTarget& target);

}  // namespace lararium::render
