#pragma once

// The letters of captions: signed distances to Inter's outlines, for shared/render.

#include <cstddef>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/status.h"
#include "shared/render/caption_font.h"

namespace lararium::bake {

// Inter SemiBold where Debian's fonts-inter puts it.
std::filesystem::path CaptionFontFile();

// What a font says of itself. Fails where it cannot be read.
struct FontCredits {
  std::string name;       // "Inter SemiBold"
  std::string copyright;  // may be empty, as may the licence
  std::string licence;
};
Result<FontCredits> ReadFontCredits(const std::filesystem::path& file);

// What every show can write (ASCII, arrows, quotes, dashes, ellipsis), and the characters of
// texts.
void AddCharacters(std::string_view text, std::set<uint32_t>& characters);
std::set<uint32_t> CommonCharacters();

// Characters that a font has not; draws nothing.
Result<std::vector<uint32_t>> MissingCharacters(const std::filesystem::path& file,
                                                const std::set<uint32_t>& characters);

struct CaptionFontBake {
  render::CaptionFont font;
  std::vector<uint32_t> missing;  // characters that the font has not
};
Result<CaptionFontBake> BakeCaptionFont(const std::filesystem::path& file,
                                        const std::set<uint32_t>& characters);

// The font as the two files that render::ParseCaptionFont reads.
struct CaptionFontFiles {
  std::string metrics;
  std::vector<std::byte> atlas;  // PNG
};
Result<CaptionFontFiles> FormatCaptionFont(const render::CaptionFont& font);

}  // namespace lararium::bake
