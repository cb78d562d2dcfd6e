#pragma once

// Draws rectangles, text and small pictures over a finished picture. Positions are pixels of the
// target, counted from its top-left corner; colours are sRGB-encoded.

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <string_view>

#include "shared/core/status.h"
#include "shared/render/gl/render_target.h"
#include "shared/render/text/caption_font.h"
#include "shared/render/text/caption_style.h"

namespace lararium::render {

class FlatPainter {
 public:
  // Stripes over a rectangle, lighter than its colour.
  struct Stripes {
    int directions = 0;    // 0: none, 1: rising stripes, 2: crossed stripes
    float step_px = 1.0f;  // distance of stripes, pixels
    bool operator==(const Stripes&) const = default;
  };

  // Uploads the font's atlas. Needs a current context, the one that it will draw in. With a font
  // that has no atlas, Text draws nothing.
  static Result<std::unique_ptr<FlatPainter>> Create(CaptionFont font);
  ~FlatPainter();
  FlatPainter(const FlatPainter&) = delete;
  FlatPainter& operator=(const FlatPainter&) = delete;

  const CaptionFont& font() const;

  // All calls until End() draw over the content of target.
  void Begin(const RenderTarget& target);
  // Draws a rectangle with round corners.
  void Rectangle(
      glm::vec2 from, glm::vec2 to, float radius_px, glm::vec4 colour, Stripes stripes = {0, 1.0f});
  // Draws a row of text from the left end of its baseline. Returns the x coordinate at its end.
  // bolder: em by which outlines are moved outwards.
  float Text(
      std::string_view text, glm::vec2 baseline, float em, glm::vec4 colour, float bolder = 0.0f);
  // picture: CV_8UC1. It is uploaded only if number differs from that of the last picture.
  void Picture(
      const cv::Mat& picture, uint64_t number, glm::vec2 from, glm::vec2 to, float opacity);
  void End();

 private:
  struct State;
  explicit FlatPainter(std::unique_ptr<State> state);

  std::unique_ptr<State> state_;
};

// The background of text: dark and translucent; in high contrast black with a white edge.
struct Ground {
  glm::vec2 from;
  glm::vec2 to;
  float radius_px = 0.0f;
  float edge_px = 0.0f;  // width of the edge in high contrast
};
// opacity: opacity in normal contrast, 0..1. shown: factor on the opacity in either contrast, 0..1.
void DrawGround(FlatPainter& painter,
                const Ground& ground,
                float opacity,
                const CaptionStyle& style,
                float shown = 1.0f);

// The value of `bolder` in FlatPainter::Text for a style.
float BolderOf(const CaptionStyle& style);

}  // namespace lararium::render
