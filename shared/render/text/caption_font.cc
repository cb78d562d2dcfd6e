#include "shared/render/text/caption_font.h"

#include <algorithm>
#include <opencv2/core.hpp>

#include "shared/core/json.h"
#include "shared/render/gl/texture_image.h"

namespace lararium::render {
namespace {

constexpr size_t kMaxGlyphs = 20'000;
constexpr double kMaxEm = 10.0;  // limit on sizes of letters, em
constexpr size_t kMaxMetrics = size_t{8} << 20;

Result<glm::vec2> ReadPair(const JsonView& view, std::string_view key, double least, double most) {
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<double> numbers, view.Numbers(key, 2));
  for (const double number : numbers) {
    if (!(number >= least && number <= most)) {
      return view.Problem("\"" + std::string(key) + "\" lies outside");
    }
  }
  return glm::vec2(numbers[0], numbers[1]);
}

Result<CaptionGlyph> ReadGlyph(const JsonView& view, const cv::Size& atlas) {
  CaptionGlyph glyph;
  const double side = std::max(atlas.width, atlas.height);
  LARARIUM_ASSIGN_OR_RETURN(const int64_t character, view.Integer("character", 1, 0x10FFFF));
  LARARIUM_ASSIGN_OR_RETURN(const double advance, view.Number("advance", 0.0, kMaxEm));
  glyph.character = static_cast<uint32_t>(character);
  glyph.advance = static_cast<float>(advance);
  LARARIUM_ASSIGN_OR_RETURN(glyph.from, ReadPair(view, "from", -kMaxEm, kMaxEm));
  LARARIUM_ASSIGN_OR_RETURN(glyph.to, ReadPair(view, "to", -kMaxEm, kMaxEm));
  LARARIUM_ASSIGN_OR_RETURN(glyph.atlas_from, ReadPair(view, "atlas_from", 0.0, side));
  LARARIUM_ASSIGN_OR_RETURN(glyph.atlas_to, ReadPair(view, "atlas_to", 0.0, side));
  const bool inside = glyph.atlas_from.x <= glyph.atlas_to.x &&
                      glyph.atlas_from.y <= glyph.atlas_to.y &&
                      glyph.atlas_to.x <= static_cast<float>(atlas.width) &&
                      glyph.atlas_to.y <= static_cast<float>(atlas.height) &&
                      glyph.from.x <= glyph.to.x && glyph.from.y <= glyph.to.y;
  if (!inside) {
    return view.Problem("its rectangle does not lie in the atlas");
  }
  return glyph;
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
  LARARIUM_ASSIGN_OR_RETURN(const Json json, ParseJson(metrics, where));
  const JsonView root(json, where);
  LARARIUM_RETURN_IF_ERROR(root.Integer("schema", 1, 1).status());
  CaptionFont font;
  LARARIUM_ASSIGN_OR_RETURN(const double em, root.Number("em_px", 4.0, 1000.0));
  LARARIUM_ASSIGN_OR_RETURN(const double rim, root.Number("rim_px", 1.0, 100.0));
  LARARIUM_ASSIGN_OR_RETURN(const double ascent, root.Number("ascent", 0.0, kMaxEm));
  LARARIUM_ASSIGN_OR_RETURN(const double descent, root.Number("descent", 0.0, kMaxEm));
  font.em_px = static_cast<float>(em);
  font.rim_px = static_cast<float>(rim);
  font.ascent = static_cast<float>(ascent);
  font.descent = static_cast<float>(descent);
  LARARIUM_ASSIGN_OR_RETURN(const cv::Mat bgra, DecodeTexture(atlas, where + ": atlas"));
  cv::extractChannel(bgra, font.atlas, 0);
  LARARIUM_ASSIGN_OR_RETURN(const JsonView glyphs, root.Field("glyphs"));
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<JsonView> list, glyphs.Array(kMaxGlyphs));
  for (const JsonView& item : list) {
    LARARIUM_ASSIGN_OR_RETURN(const CaptionGlyph glyph, ReadGlyph(item, font.atlas.size()));
    if (!font.glyphs.empty() && glyph.character <= font.glyphs.back().character) {
      return item.Problem("the characters do not ascend");
    }
    font.glyphs.push_back(glyph);
  }
  return font;
}

std::string FormatCaptionMetrics(const CaptionFont& font) {
  const auto pair = [](const glm::vec2& v) { return Json::array({v.x, v.y}); };
  Json json = {{"schema", 1},           {"em_px", font.em_px},     {"rim_px", font.rim_px},
               {"ascent", font.ascent}, {"descent", font.descent}, {"glyphs", Json::array()}};
  for (const CaptionGlyph& glyph : font.glyphs) {
    json["glyphs"].push_back({{"character", glyph.character},
                              {"advance", glyph.advance},
                              {"from", pair(glyph.from)},
                              {"to", pair(glyph.to)},
                              {"atlas_from", pair(glyph.atlas_from)},
                              {"atlas_to", pair(glyph.atlas_to)}});
  }
  return json.dump() + "\n";
}

uint32_t NextCharacter(std::string_view text, size_t& at) {
  constexpr uint32_t kBad = 0xFFFD;
  const auto lead = static_cast<unsigned char>(text[at++]);
  if (lead < 0x80) {
    return lead;
  }
  const int more = lead >= 0xF0 && lead < 0xF5 ? 3 : lead >= 0xE0 ? 2 : lead >= 0xC2 ? 1 : 0;
  if (more == 0 || lead >= 0xF5) {
    return kBad;
  }
  uint32_t character = lead & (0x3Fu >> more);
  for (int i = 0; i < more; ++i) {
    if (at >= text.size() || (static_cast<unsigned char>(text[at]) & 0xC0) != 0x80) {
      return kBad;
    }
    character = (character << 6) | (static_cast<unsigned char>(text[at++]) & 0x3F);
  }
  return character;
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
