#include "shared/show/guide_texts.h"

#include "shared/core/check.h"
#include "shared/core/json.h"
#include "shared/core/utf8.h"
#include "shared/show/visitor_texts.h"

namespace lararium::show {
namespace {

GuideTexts GuideOf(const Json& texts) {
  GuideTexts guide;
  texts.at("guide").at("look").get_to(guide.look);
  texts.at("guide").at("dark").get_to(guide.dark);
  texts.at("guide").at("farewell").get_to(guide.farewell);
  return guide;
}

}  // namespace

bool CanWrite(const render::CaptionFont& font, std::string_view text) {
  for (size_t at = 0; at < text.size();) {
    const uint32_t character = NextCharacter(text, at);
    if (character != '\n' && font.Find(character) == nullptr) {
      return false;
    }
  }
  return true;
}

GuideTexts BuiltInGuide(std::string_view language, const render::CaptionFont* font) {
  const EmbeddedText& file = VisitorTexts().front();
  const Result<Json> all = ParseJson(file.text, file.name);
  CHECK(all.ok());
  const auto known = all->find(language.substr(0, language.find('-')));
  const GuideTexts guide = GuideOf(known != all->end() ? *known : all->at("en"));
  const bool writable =
      font == nullptr || (CanWrite(*font, guide.look) && CanWrite(*font, guide.dark) &&
                          CanWrite(*font, guide.farewell));
  return writable ? guide : GuideOf(all->at("en"));
}

}  // namespace lararium::show
