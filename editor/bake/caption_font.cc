#include "editor/bake/caption_font.h"

#include <ft2build.h>
#include <unicode/uchar.h>

#include "shared/core/utf8.h"
#include "shared/image/encode.h"
#include FT_FREETYPE_H
#include FT_MODULE_H
#include FT_SFNT_NAMES_H
#include FT_TRUETYPE_IDS_H

#include <algorithm>
#include <iterator>
#include <opencv2/core.hpp>
#include <utility>

namespace lararium::bake {
namespace {

constexpr int kEmPx = 48;  // captions are drawn at 20 to 100 pixels
constexpr int kRimPx = 6;  // Range of the distances, in pixels.
constexpr int kAtlasWidth = 1024;
constexpr int kApart = 1;  // Pixels between letters.

class Face {
 public:
  static Result<Face> Open(const std::filesystem::path& file) {
    Face face;
    if (FT_Init_FreeType(&face.library_) != 0) {
      return Status::Error("FreeType", "cannot be started");
    }
    FT_UInt spread = kRimPx;
    for (const char* module : {"sdf", "bsdf"}) {
      FT_Property_Set(face.library_, module, "spread", &spread);
    }
    if (FT_New_Face(face.library_, file.c_str(), 0, &face.face_) != 0) {
      return Status::Error(file.string(), "cannot be opened as a font", "install fonts-inter");
    }
    FT_Set_Pixel_Sizes(face.face_, 0, kEmPx);
    return face;
  }
  Face(Face&& other) noexcept
      : library_(std::exchange(other.library_, nullptr)),
        face_(std::exchange(other.face_, nullptr)) {}
  Face(const Face&) = delete;
  Face& operator=(const Face&) = delete;
  ~Face() {
    if (face_ != nullptr) {
      FT_Done_Face(face_);
    }
    if (library_ != nullptr) {
      FT_Done_FreeType(library_);
    }
  }

  FT_Face get() const { return face_; }

 private:
  Face() = default;

  FT_Library library_ = nullptr;
  FT_Face face_ = nullptr;
};

// Packs pictures in rows, the tallest first.
class Shelves {
 public:
  cv::Point Place(const cv::Size& size) {
    if (x_ + size.width > kAtlasWidth) {
      x_ = 0;
      y_ += row_height_ + kApart;
      row_height_ = 0;
    }
    const cv::Point place(x_, y_);
    x_ += size.width + kApart;
    row_height_ = std::max(row_height_, size.height);
    return place;
  }
  int height() const { return y_ + row_height_; }

 private:
  int x_ = 0;
  int y_ = 0;
  int row_height_ = 0;
};

struct Letter {
  render::CaptionGlyph glyph;
  cv::Mat distances;  // Empty for a space.
};

Result<Letter> RenderLetter(FT_Face face, uint32_t character, FT_UInt index) {
  // No hinting, because letters are drawn at any size.
  if (FT_Load_Glyph(face, index, FT_LOAD_NO_HINTING | FT_LOAD_NO_BITMAP) != 0) {
    return Status::Error("caption font", "a letter cannot be read");
  }
  Letter letter;
  const FT_GlyphSlot slot = face->glyph;
  constexpr float kEm = kEmPx;
  letter.glyph.character = character;
  letter.glyph.advance = static_cast<float>(slot->linearHoriAdvance) / 65536.0f / kEm;
  if (slot->outline.n_points == 0) {
    return letter;
  }
  if (FT_Render_Glyph(slot, FT_RENDER_MODE_SDF) != 0) {
    return Status::Error("caption font", "a letter has no outline");
  }
  const FT_Bitmap& bitmap = slot->bitmap;
  const cv::Mat view(static_cast<int>(bitmap.rows), static_cast<int>(bitmap.width), CV_8UC1,
                     bitmap.buffer, static_cast<size_t>(bitmap.pitch));
  letter.distances = view.clone();
  const glm::vec2 from(slot->bitmap_left, -slot->bitmap_top);
  letter.glyph.from = from / kEm;
  letter.glyph.to = (from + glm::vec2(bitmap.width, bitmap.rows)) / kEm;
  return letter;
}

// Decodes UTF-16 (big-endian), as fonts store it; drops characters beyond 16 bits.
std::string FromUtf16(const FT_SfntName& name) {
  std::string text;
  for (FT_UInt i = 0; i + 1 < name.string_len; i += 2) {
    const auto c = static_cast<uint32_t>((name.string[i] << 8) | name.string[i + 1]);
    if (c < 0x20 || (c >= 0xD800 && c < 0xE000)) {
      continue;
    }
    if (c < 0x80) {
      text += static_cast<char>(c);
    } else if (c < 0x800) {
      text += static_cast<char>(0xC0 | (c >> 6));
      text += static_cast<char>(0x80 | (c & 0x3F));
    } else {
      text += static_cast<char>(0xE0 | (c >> 12));
      text += static_cast<char>(0x80 | ((c >> 6) & 0x3F));
      text += static_cast<char>(0x80 | (c & 0x3F));
    }
  }
  return text;
}

// An entry of the name table of the font; "" if it is absent.
std::string NameInFont(FT_Face face, FT_UShort id) {
  for (FT_UInt i = 0; i < FT_Get_Sfnt_Name_Count(face); ++i) {
    FT_SfntName name = {};
    if (FT_Get_Sfnt_Name(face, i, &name) == 0 && name.name_id == id &&
        name.platform_id == TT_PLATFORM_MICROSOFT) {
      return FromUtf16(name);
    }
  }
  return "";
}

}  // namespace

Result<FontCredits> ReadFontCredits(const std::filesystem::path& file) {
  LARARIUM_ASSIGN_OR_RETURN(const Face face, Face::Open(file));
  return FontCredits{NameInFont(face.get(), TT_NAME_ID_FULL_NAME),
                     NameInFont(face.get(), TT_NAME_ID_COPYRIGHT),
                     NameInFont(face.get(), TT_NAME_ID_LICENSE)};
}

std::filesystem::path CaptionFontFile() {
  return "/usr/share/fonts/opentype/inter/Inter-SemiBold.otf";
}

void AddCharacters(std::string_view text, std::set<uint32_t>& characters) {
  for (size_t at = 0; at < text.size();) {
    const uint32_t character = NextCharacter(text, at);
    // Marks of direction, joiners and the like have no picture.
    const bool seen = u_hasBinaryProperty(static_cast<UChar32>(character),
                                          UCHAR_DEFAULT_IGNORABLE_CODE_POINT) == 0;
    if (character >= 0x20 && seen) {
      characters.insert(character);
    }
  }
}

std::set<uint32_t> CommonCharacters() {
  std::set<uint32_t> characters;
  for (uint32_t character = 0x20; character < 0x7F; ++character) {
    characters.insert(character);
  }
  AddCharacters("←→–—‘’“”«»…¡¿", characters);
  return characters;
}

Result<std::vector<uint32_t>> MissingCharacters(const std::filesystem::path& file,
                                                const std::set<uint32_t>& characters) {
  LARARIUM_ASSIGN_OR_RETURN(const Face face, Face::Open(file));
  std::vector<uint32_t> missing;
  std::copy_if(characters.begin(), characters.end(), std::back_inserter(missing),
               [&](uint32_t character) { return FT_Get_Char_Index(face.get(), character) == 0; });
  return missing;
}

Result<CaptionFontBake> BakeCaptionFont(const std::filesystem::path& file,
                                        const std::set<uint32_t>& characters) {
  LARARIUM_ASSIGN_OR_RETURN(const Face face, Face::Open(file));
  CaptionFontBake bake;
  std::vector<Letter> letters;
  for (const uint32_t character : characters) {
    const FT_UInt index = FT_Get_Char_Index(face.get(), character);
    if (index == 0) {
      bake.missing.push_back(character);
      continue;
    }
    LARARIUM_ASSIGN_OR_RETURN(letters.emplace_back(), RenderLetter(face.get(), character, index));
  }
  std::vector<Letter*> by_height;
  for (Letter& letter : letters) {
    if (!letter.distances.empty()) {
      by_height.push_back(&letter);
    }
  }
  std::stable_sort(by_height.begin(), by_height.end(), [](const Letter* a, const Letter* b) {
    return a->distances.rows > b->distances.rows;
  });
  Shelves shelves;
  std::vector<cv::Point> places;
  for (const Letter* letter : by_height) {
    places.push_back(shelves.Place(letter->distances.size()));
  }
  render::CaptionFont& font = bake.font;
  font.em_px = kEmPx;
  font.rim_px = kRimPx;
  const auto em = static_cast<float>(face.get()->units_per_EM);
  font.ascent = static_cast<float>(face.get()->ascender) / em;
  font.descent = -static_cast<float>(face.get()->descender) / em;
  font.atlas = cv::Mat::zeros(std::max(shelves.height(), 1), kAtlasWidth, CV_8UC1);
  for (size_t i = 0; i < by_height.size(); ++i) {
    Letter& letter = *by_height[i];
    const cv::Rect place(places[i], letter.distances.size());
    letter.distances.copyTo(font.atlas(place));
    letter.glyph.atlas_from = glm::vec2(place.x, place.y);
    letter.glyph.atlas_to = glm::vec2(place.x + place.width, place.y + place.height);
  }
  for (const Letter& letter : letters) {
    font.glyphs.push_back(letter.glyph);
  }
  return bake;
}

Result<CaptionFontFiles> FormatCaptionFont(const render::CaptionFont& font) {
  CaptionFontFiles files;
  files.metrics = render::FormatCaptionMetrics(font);
  LARARIUM_ASSIGN_OR_RETURN(files.atlas, image::EncodePng(font.atlas));
  return files;
}

}  // namespace lararium::bake
