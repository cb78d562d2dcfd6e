#include "player/app/visitor_menu.h"

#include <algorithm>
#include <string>

#include "player/app/menu_texts.h"

namespace lararium::player {
namespace {

constexpr double kWidestShare = 0.86;  // limit, as a share of the picture's width and height

// Returns for example "Captions: off".
std::string Chosen(std::string_view what, std::string_view choice) {
  return std::string(what) + ": " + std::string(choice);
}

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
  const MenuTexts& texts = TextsOfMenu(content.language, font);
  const render::CaptionStyle& style = choices.caption_style;
  const auto chosen = [](const std::string& choice, const std::vector<std::string>& all) {
    return choice.empty() ? all.front() : choice;
  };
  items.push_back({Action::kLouder, texts.louder, true});
  items.push_back({Action::kQuieter, texts.quieter, true});
  if (content.spoken_languages.size() > 1) {
    const std::string language = chosen(choices.language, content.spoken_languages);
    items.push_back({Action::kLanguage, Chosen(texts.language, NameOfLanguage(language, font))});
  }
  if (!content.caption_languages.empty()) {
    const std::string language = chosen(choices.captions, content.caption_languages);
    const std::string name =
        language == show::kNoCaptions ? texts.off : NameOfLanguage(language, font);
    items.push_back({Action::kCaptions, Chosen(texts.captions, name)});
    items.push_back({Action::kCaptionSize,
                     Chosen(texts.caption_size, texts.sizes[static_cast<size_t>(style.size)])});
    items.push_back({Action::kCaptionContrast,
                     Chosen(texts.contrast, texts.contrasts[style.is_high() ? 1 : 0])});
  }
  if (content.has_descriptions) {
    const std::string_view choice = texts.switches[choices.descriptions ? 1 : 0];
    items.push_back({Action::kDescriptions, Chosen(texts.descriptions, choice)});
  }
  items.push_back({Action::kReducedMotion,
                   Chosen(texts.motion, texts.motions[choices.reduced_motion ? 1 : 0])});
  items.push_back({Action::kRestart, texts.restart, false, true});
  items.push_back({Action::kFindAnew, texts.find_anew, false, true});
  items.push_back({std::nullopt, texts.close, false, true});
  return items;
}

double ScaleFor(const geometry::CameraModel& picture, size_t items) {
  const Eigen::Vector2d size = GazeMenu::SizeOf(items);
  return std::min({1.0, kWidestShare * picture.width / picture.fx / size.x(),
                   kWidestShare * picture.height / picture.fy / size.y()});
}

render::Menu PictureOf(const GazeMenu& menu,
                       const geometry::CameraModel& picture,
                       const Choices& choices) {
  render::Menu drawn;
  drawn.style = choices.caption_style;
  drawn.fades = choices.reduced_motion;
  drawn.gaze = PixelOf(picture, Eigen::Vector2d::Zero());
  for (const GazeMenu::Cell& cell : menu.Cells()) {
    drawn.cells.push_back({PixelOf(picture, cell.box.min()), PixelOf(picture, cell.box.max()),
                           *cell.text, cell.selected, cell.progress});
  }
  return drawn;
}

}  // namespace lararium::player
