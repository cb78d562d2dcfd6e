// libFuzzer harness: reading any text as captions of any kind or as a caption font terminates, and
// accepted cues are unchanged after writing and reading them.

#include <string_view>

#include "editor/bake/caption_file.h"
#include "editor/bake/caption_layout.h"
#include "shared/core/check.h"
#include "shared/core/utf8.h"
#include "shared/render/text/caption_font.h"
#include "shared/stage/caption_file.h"

using namespace lararium;  // NOLINT(google-build-using-namespace)

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto cues = bake::ParseCaptionFile(text, "fuzz.srt");
  if (cues.ok()) {
    CHECK(stage::CheckCues(bake::ShownCues(cues->cues), "shown").ok());
    const auto again = bake::ParseCaptionFile(bake::FormatVtt(cues->cues), "again.vtt");
    CHECK(again.ok() && again->cues.size() == cues->cues.size());
    for (const bake::FileCue& cue : cues->cues) {
      CHECK(cue.end > cue.begin && IsUtf8(cue.text));
      human::VisemeTrack track;
      track.duration = 1.0f;
      const auto laid_out = bake::LayOutCaptions(cue.text, track);
      CHECK(stage::CheckCues(laid_out, "cues").ok());
    }
  }
  const auto book = stage::ParseCaptions(text, "captions.json");
  if (book.ok()) {
    const auto again = stage::ParseCaptions(stage::FormatCaptions(*book), "again.json");
    CHECK(again.ok());
  }
  const std::span<const std::byte> no_atlas;
  (void)render::ParseCaptionFont(text, no_atlas, "font.json").ok();
  for (size_t at = 0; at < text.size();) {
    const size_t before = at;
    (void)NextCharacter(text, at);
    CHECK(at > before && at <= text.size());
  }
  return 0;
}
