#include "player/visitor_menu.h"

#include <algorithm>
#include <string>
#include <utility>

#include "player/menu_texts.h"

namespace lararium::player {
namespace {

constexpr double kWidestShare = 0.86;  // of the picture's width
constexpr double kMenuWidth = 0.7;     // on a plane one metre before the eye

glm::vec2 PixelOf(const geometry::CameraModel& picture, const Eigen::Vector2d& plane) {
  const Eigen::Vector2d pixel = picture.PixelFromPlane(plane);
  return {static_cast<float>(pixel.x() + 0.5), static_cast<float>(pixel.y() + 0.5)};
}

}  // namespace

std::vector<MenuItem> ItemsOf(const show::ShowContent& content, const Choices& choices) {
  std::vector<MenuItem> items;
  if (!content.caption_font) {
    return items;
  }
  const render::CaptionFont& font = *content.caption_font;
  const MenuTexts texts = TextsOfMenu(content.language, font);
  const auto chosen = [](const std::string& choice, const std::vector<std::string>& all) {
    return choice.empty() ? all.front() : choice;
  };
  items.push_back({Action::kLouder, texts.louder, true});
  items.push_back({Action::kQuieter, texts.quieter, true});
  if (content.spoken_languages.size() > 1) {
    const std::string language = chosen(choices.language, content.spoken_languages);
    items.push_back({Action::kLanguage, texts.language + ": " + NameOfLanguage(language, font)});
  }
  if (!content.caption_languages.empty()) {
    const std::string language = chosen(choices.captions, content.caption_languages);
    const std::string name =
        language == show::kNoCaptions ? texts.off : NameOfLanguage(language, font);
    items.push_back({Action::kCaptions, texts.captions + ": " + name});
  }
  items.push_back({Action::kRestart, texts.restart, false, true});
  items.push_back({Action::kFindAnew, texts.find_anew, false, true});
  items.push_back({std::nullopt, texts.close, false, true});
  return items;
}

double ScaleFor(const geometry::CameraModel& picture) {
  return std::min(1.0, kWidestShare * picture.width / picture.fx / kMenuWidth);
}

render::Menu PictureOf(const GazeMenu& menu, const geometry::CameraModel& picture) {
  render::Menu drawn;
  drawn.gaze = PixelOf(picture, Eigen::Vector2d::Zero());
  for (const GazeMenu::Cell& cell : menu.Cells()) {
    drawn.cells.push_back({PixelOf(picture, cell.box.min()), PixelOf(picture, cell.box.max()),
                           *cell.text, cell.selected, cell.progress});
  }
  return drawn;
}

}  // namespace lararium::player
