#pragma once

// Bakes the letters of captions for shared/render: signed distances to the outlines of Inter.

#include <cstddef>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/status.h"
#include "shared/render/text/caption_font.h"

namespace lararium::bake {

// The file of Inter SemiBold that Debian's fonts-inter installs.
std::filesystem::path CaptionFontFile();

// The name and rights that a font file states. ReadFontCredits fails if the file is unreadable.
struct FontCredits {
  std::string name;       // "Inter SemiBold"
  std::string copyright;  // May be empty, like the licence.
  std::string licence;
};
Result<FontCredits> ReadFontCredits(const std::filesystem::path& file);

// AddCharacters adds the characters of a text. CommonCharacters are those that every show can
// write: ASCII, arrows, quotes, dashes, the ellipsis.
void AddCharacters(std::string_view text, std::set<uint32_t>& characters);
std::set<uint32_t> CommonCharacters();

// Characters that the font lacks. Renders nothing.
Result<std::vector<uint32_t>> MissingCharacters(const std::filesystem::path& file,
                                                const std::set<uint32_t>& characters);

struct CaptionFontBake {
  render::CaptionFont font;
  std::vector<uint32_t> missing;  // Characters that the font lacks.
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
