#pragma once

// Rectangles, letters and small pictures over a finished picture. Places are pixels of the target
// from its top-left corner, colours are sRGB-encoded.

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <string_view>

#include "shared/core/status.h"
#include "shared/render/caption_font.h"
#include "shared/render/caption_style.h"
#include "shared/render/render_target.h"

namespace lararium::render {

class FlatPainter {
 public:
  // Over a rectangle, lighter than it.
  struct Stripes {
    int directions = 0;    // 0: none, 1: stripes that rise, 2: crossed ones
    float step_px = 1.0f;  // from one to the next
    bool operator==(const Stripes&) const = default;
  };

  // Uploads the font's atlas; needs the context that it draws with. A font without an atlas
  // writes nothing.
  static Result<std::unique_ptr<FlatPainter>> Create(CaptionFont font);
  ~FlatPainter();
  FlatPainter(const FlatPainter&) = delete;
  FlatPainter& operator=(const FlatPainter&) = delete;

  const CaptionFont& font() const;

  // What follows is drawn over what the target holds, until End().
  void Begin(const RenderTarget& target);
  // With round corners.
  void Rectangle(
      glm::vec2 from, glm::vec2 to, float radius_px, glm::vec4 colour, Stripes stripes = {0, 1.0f});
  // A row from the left end of its baseline; says where it ends. bolder: em by which outlines are
  // moved outwards.
  float Text(
      std::string_view text, glm::vec2 baseline, float em, glm::vec4 colour, float bolder = 0.0f);
  // picture: CV_8UC1. It is uploaded when its number is another than the last picture's.
  void Picture(
      const cv::Mat& picture, uint64_t number, glm::vec2 from, glm::vec2 to, float opacity);
  void End();

 private:
  struct State;
  explicit FlatPainter(std::unique_ptr<State> state);

  std::unique_ptr<State> state_;
};

// What words stand on: dark and translucent; in high contrast black, within a white edge.
struct Ground {
  glm::vec2 from;
  glm::vec2 to;
  float radius_px = 0.0f;
  float edge_px = 0.0f;  // of high contrast
};
// opacity: of normal contrast, 0..1; shown: of all of it, likewise.
void DrawGround(FlatPainter& painter,
                const Ground& ground,
                float opacity,
                const CaptionStyle& style,
                float shown = 1.0f);

// For FlatPainter::Text.
float BolderOf(const CaptionStyle& style);

}  // namespace lararium::render
