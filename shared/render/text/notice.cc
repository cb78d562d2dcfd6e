#include "shared/render/text/notice.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec4.hpp>

namespace lararium::render {
namespace {

constexpr float kNoticeLetterShare = 0.05f;  // share of the picture's height
constexpr float kNoticeSmallestPx = 15.0f;
constexpr float kNoticeWidest = 0.86f;   // share of the picture's width
constexpr float kNoticeTallest = 0.94f;  // share of the picture's height
constexpr float kNoticeEdge = 0.08f;     // em, edge in high contrast
constexpr float kPictureShare = 0.38f;   // maximum, share of the picture's height
constexpr float kNoticeRowStep = 1.32f;  // em
constexpr float kNoticePadding = 0.8f;   // em
constexpr float kAscent = 0.78f;         // em
constexpr float kNoticeGroundOpacity = 0.7f;
constexpr float kNoticeRadius = 0.02f;  // share of the picture's height
constexpr float kStatusShare = 0.026f;  // letters, share of the picture's height
constexpr float kSmallestStatusPx = 11.0f;

}  // namespace

NoticeLayout LayOut(const CaptionFont& font, const Notice& notice, int width, int height) {
  NoticeLayout layout;
  const glm::vec2 size(width, height);
  float widest = 0.0f;
  float rows = 0.0f;
  ForEachRow(notice.text, [&](std::string_view row) {
    widest = std::max(widest, TextWidth(font, row));
    rows += 1.0f;
  });
  const float usual = std::max(kNoticeLetterShare * size.y, kNoticeSmallestPx);
  // The picture always takes its share of the height; the words have the rest.
  const float room = (kNoticeTallest - (notice.picture.empty() ? 0.0f : kPictureShare)) * size.y;
  layout.em = std::min({usual * ScaleOf(notice.style.size),
                        kNoticeWidest * size.x / std::max(widest + 2.0f * kNoticePadding, 1.0f),
                        std::max(room / (kNoticeRowStep * rows + 2.7f * kNoticePadding), 1.0f)});
  const float padding = kNoticePadding * layout.em;
  glm::vec2 picture(0.0f);
  if (!notice.picture.empty()) {
    const glm::vec2 texels(notice.picture.cols, notice.picture.rows);
    picture = texels * std::min(kPictureShare * size.y / texels.y,
                                (kNoticeWidest * size.x - 2.0f * padding) / texels.x);
  }
  const bool both = picture.y > 0.0f && rows > 0.0f;
  const float letters = rows > 0.0f ? layout.em * (kNoticeRowStep * (rows - 1.0f) + 1.0f) : 0.0f;
  const glm::vec2 inner(std::max(picture.x, widest * layout.em),
                        picture.y + letters + (both ? 0.7f * padding : 0.0f));
  layout.from = glm::round(0.5f * (size - inner) - padding);
  layout.to = layout.from + inner + 2.0f * padding;
  const float middle = 0.5f * (layout.from.x + layout.to.x);
  layout.picture_from = {middle - 0.5f * picture.x, layout.from.y + padding};
  layout.picture_to = layout.picture_from + picture;
  layout.first_baseline =
      layout.picture_to.y + (both ? 0.7f * padding : 0.0f) + kAscent * layout.em;
  return layout;
}

void DrawNotice(FlatPainter& painter, const Notice& notice, const RenderTarget& target) {
  if (notice.opacity <= 0.0f || (notice.text.empty() && notice.picture.empty())) {
    return;
  }
  const NoticeLayout layout = LayOut(painter.font(), notice, target.width(), target.height());
  const glm::vec4 white(1.0f, 1.0f, 1.0f, notice.opacity);
  painter.Begin(target);
  DrawGround(painter,
             {layout.from, layout.to, kNoticeRadius * static_cast<float>(target.height()),
              kNoticeEdge * layout.em},
             kNoticeGroundOpacity, notice.style, notice.opacity);
  if (!notice.picture.empty()) {
    painter.Picture(notice.picture, notice.picture_number, layout.picture_from, layout.picture_to,
                    notice.opacity);
  }
  float baseline = layout.first_baseline;
  ForEachRow(notice.text, [&](std::string_view row) {
    const float wide = TextWidth(painter.font(), row) * layout.em;
    painter.Text(row, {std::round(0.5f * (layout.from.x + layout.to.x - wide)), baseline},
                 layout.em, white, BolderOf(notice.style));
    baseline += kNoticeRowStep * layout.em;
  });
  painter.End();
}

void DrawStatus(FlatPainter& painter,
                glm::vec3 colour,
                std::string_view text,
                const RenderTarget& target) {
  const auto height = static_cast<float>(target.height());
  const float em = std::max(kStatusShare * height, kSmallestStatusPx);
  const glm::vec2 from(em, em);
  const float wide = em * (TextWidth(painter.font(), text) + 2.4f);
  painter.Begin(target);
  painter.Rectangle(from, from + glm::vec2(wide, 1.8f * em), 0.5f * em,
                    glm::vec4(0.0f, 0.0f, 0.0f, kNoticeGroundOpacity));
  const glm::vec2 dot = from + glm::vec2(0.5f * em, 0.5f * em);
  painter.Rectangle(dot, dot + glm::vec2(0.8f * em), 0.4f * em, glm::vec4(colour, 1.0f));
  painter.Text(text, {from.x + 1.8f * em, from.y + 1.2f * em}, em, glm::vec4(1.0f));
  painter.End();
}

}  // namespace lararium::render
