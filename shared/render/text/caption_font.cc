#include "shared/render/text/caption_font.h"

#include <algorithm>
#include <opencv2/core.hpp>

#include "shared/core/json.h"
#include "shared/core/json_fields.h"
#include "shared/core/utf8.h"
#include "shared/render/gl/texture_image.h"

namespace lararium::render {
namespace {

constexpr size_t kMaxGlyphs = 20'000;
constexpr double kMaxEm = 10.0;  // limit on sizes of letters, em
constexpr size_t kMaxMetrics = size_t{8} << 20;

void DescribePair(Fields& fields, std::string_view name, glm::vec2& pair, double min, double max) {
  fields.Numbers(name, std::span(&pair.x, 2));
  const auto [least, most] = std::minmax(pair.x, pair.y);
  fields.Require(least >= min && most <= max, "\"" + std::string(name) + "\" lies outside");
}

void DescribeGlyph(Fields& fields, const cv::Size& atlas, CaptionGlyph& glyph) {
  const double side = std::max(atlas.width, atlas.height);
  fields.Integer("character", glyph.character, 1, 0x10FFFF);
  fields.Number("advance", glyph.advance, 0.0, kMaxEm);
  DescribePair(fields, "from", glyph.from, -kMaxEm, kMaxEm);
  DescribePair(fields, "to", glyph.to, -kMaxEm, kMaxEm);
  DescribePair(fields, "atlas_from", glyph.atlas_from, 0.0, side);
  DescribePair(fields, "atlas_to", glyph.atlas_to, 0.0, side);
  const bool inside = glyph.atlas_from.x <= glyph.atlas_to.x &&
                      glyph.atlas_from.y <= glyph.atlas_to.y &&
                      glyph.atlas_to.x <= static_cast<float>(atlas.width) &&
                      glyph.atlas_to.y <= static_cast<float>(atlas.height) &&
                      glyph.from.x <= glyph.to.x && glyph.from.y <= glyph.to.y;
  fields.Require(inside, "its rectangle does not lie in the atlas");
}

// The glyphs lie in the font's atlas.
void DescribeMetrics(Fields& fields, CaptionFont& font) {
  fields.Schema(1);
  fields.Number("em_px", font.em_px, 4.0, 1000.0);
  fields.Number("rim_px", font.rim_px, 1.0, 100.0);
  fields.Number("ascent", font.ascent, 0.0, kMaxEm);
  fields.Number("descent", font.descent, 0.0, kMaxEm);
  uint32_t before = 0;
  fields.List("glyphs", font.glyphs, kMaxGlyphs, [&](Fields& entry, CaptionGlyph& glyph) {
    DescribeGlyph(entry, font.atlas.size(), glyph);
    entry.Require(glyph.character > before, "the characters do not ascend");
    before = glyph.character;
  });
}

}  // namespace

const CaptionGlyph* CaptionFont::Find(uint32_t character) const {
  const auto found = std::lower_bound(
      glyphs.begin(), glyphs.end(), character,
      [](const CaptionGlyph& glyph, uint32_t wanted) { return glyph.character < wanted; });
  return found == glyphs.end() || found->character != character ? nullptr : &*found;
}

Result<CaptionFont> ParseCaptionFont(std::string_view metrics,
                                     std::span<const std::byte> atlas,
                                     const std::string& where) {
  if (metrics.size() > kMaxMetrics) {
    return Status::Error(where, "is longer than 8 MiB");
  }
  CaptionFont font;
  LARARIUM_ASSIGN_OR_RETURN(const cv::Mat bgra, DecodeTexture(atlas, where + ": atlas"));
  cv::extractChannel(bgra, font.atlas, 0);
  LARARIUM_RETURN_IF_ERROR(ReadFields(
      metrics, where, [&](Fields& fields) { DescribeMetrics(fields, font); },
      UnknownFields::kIgnore));
  return font;
}

std::string FormatCaptionMetrics(const CaptionFont& font) {
  return FormatFields(font, DescribeMetrics).dump() + "\n";
}

float TextWidth(const CaptionFont& font, std::string_view text) {
  float width = 0.0f;
  for (size_t at = 0; at < text.size();) {
    if (const CaptionGlyph* glyph = font.Find(NextCharacter(text, at))) {
      width += glyph->advance;
    }
  }
  return width;
}

}  // namespace lararium::render
