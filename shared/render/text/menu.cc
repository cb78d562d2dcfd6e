#include "shared/render/text/menu.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

namespace lararium::render {
namespace {

constexpr float kMenuLetterShare = 0.42f;  // share of a cell's height
constexpr float kMenuPadding = 0.25f;      // beside a text, share of a cell's height
constexpr float kMenuRadius = 0.25f;       // share of a cell's height
constexpr float kCapitals = 0.72f;         // em
constexpr float kReticleShare = 0.008f;    // share of the picture's height
constexpr float kMenuEdge = 0.035f;        // edge in high contrast, share of a cell's height

struct Colours {
  glm::vec4 ground;
  glm::vec4 selected;
  glm::vec4 progress;
};
// Nearly opaque, so that captions behind cells do not disturb.
const Colours kNormal = {
    {0.05f, 0.05f, 0.06f, 0.9f}, {0.22f, 0.22f, 0.25f, 0.93f}, {0.72f, 0.48f, 0.12f, 0.93f}};
// White letters have a contrast of at least 7:1 on all of them (WCAG 2.1, 1.4.6).
const Colours kHigh = {
    {0.0f, 0.0f, 0.0f, 1.0f}, {0.0f, 0.1f, 0.45f, 1.0f}, {0.0f, 0.3f, 0.6f, 1.0f}};
const glm::vec4 kLetters(1.0f);

// The largest size of letters, in pixels, with which every text fits its cell.
float EmOf(const CaptionFont& font, const Menu& menu) {
  float em = std::numeric_limits<float>::max();
  for (const MenuCell& cell : menu.cells) {
    const glm::vec2 size = cell.to - cell.from;
    const float room = size.x - 2.0f * kMenuPadding * size.y;
    em = std::min(
        {em, kMenuLetterShare * size.y, room / std::max(TextWidth(font, cell.text), 1e-3f)});
  }
  return em;
}

void DrawCell(FlatPainter& painter, const MenuCell& cell, const Menu& menu, float em) {
  const glm::vec2 size = cell.to - cell.from;
  const float radius = kMenuRadius * size.y;
  const Colours& colours = menu.style.is_high() ? kHigh : kNormal;
  if (menu.style.is_high()) {
    const float edge = kMenuEdge * size.y;
    painter.Rectangle(cell.from - edge, cell.to + edge, radius + edge, kLetters);
  }
  const glm::vec4 ground = cell.selected ? colours.selected : colours.ground;
  const float faded = menu.fades ? cell.progress : 0.0f;
  painter.Rectangle(cell.from, cell.to, radius, glm::mix(ground, colours.progress, faded));
  if (cell.progress > 0.0f && !menu.fades) {
    const float wide = std::max(cell.progress * size.x, 2.0f * radius);
    painter.Rectangle(cell.from, {cell.from.x + wide, cell.to.y}, radius, colours.progress);
  }
  const float width = TextWidth(painter.font(), cell.text);
  painter.Text(cell.text,
               {std::round(0.5f * (cell.from.x + cell.to.x - em * width)),
                std::round(0.5f * (cell.from.y + cell.to.y + kCapitals * em))},
               em, kLetters, BolderOf(menu.style));
}

}  // namespace

void DrawMenu(FlatPainter& painter, const Menu& menu, const RenderTarget& target) {
  const float em = EmOf(painter.font(), menu);
  painter.Begin(target);
  for (const MenuCell& cell : menu.cells) {
    DrawCell(painter, cell, menu, em);
  }
  const float radius = std::max(kReticleShare * static_cast<float>(target.height()), 3.0f);
  const glm::vec2 half(radius);
  painter.Rectangle(menu.gaze - 1.5f * half, menu.gaze + 1.5f * half, 1.5f * radius,
                    {0.0f, 0.0f, 0.0f, 0.6f});
  painter.Rectangle(menu.gaze - half, menu.gaze + half, radius, kLetters);
  painter.End();
}

}  // namespace lararium::render
