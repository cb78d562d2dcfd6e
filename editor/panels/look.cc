#include "editor/panels/look.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <string>

#include "editor/panels/palette.h"
#include "editor/panels/text.h"
#include "editor/panels/widgets.h"

namespace lararium::panels {

namespace {

constexpr std::array<Theme, 2> kThemes = {Theme::kDark, Theme::kLight};

const char* ThemeName(Theme theme) {
  return theme == Theme::kLight ? TrIn("colours", "Light") : TrIn("colours", "Dark");
}

std::string ScaleName(double scale) {
  return Text("%d %%", static_cast<int>(std::lround(100.0 * scale)));
}

// Each in its own language, for whoever does not know the one that is shown.
const char* LanguageName(const std::string& language) {
  return language == "it" ? "Italiano" : language == "en" ? "English" : Tr("As the system");
}

}  // namespace

void ShowLook(app::Settings& settings) {
  const char* const themes[] = {ThemeName(kThemes[0]), ThemeName(kThemes[1])};
  int theme = settings.theme == kThemes[1] ? 1 : 0;
  if (Segmented("theme", themes, theme)) {
    settings.theme = kThemes[static_cast<size_t>(theme)];
  }
  ImGui::Dummy(ImVec2(0, 0));
  std::array<std::string, app::kScales.size()> names;
  std::array<const char*, app::kScales.size()> labels = {};
  for (size_t i = 0; i < names.size(); ++i) {
    names[i] = ScaleName(app::kScales[i]);
    labels[i] = names[i].c_str();
  }
  const auto known = std::find(app::kScales.begin(), app::kScales.end(), settings.scale);
  int scale = static_cast<int>(known - app::kScales.begin());
  if (Segmented("scale", labels, scale)) {
    settings.scale = app::kScales[static_cast<size_t>(scale)];
  }
  ImGui::Dummy(ImVec2(0, 0));
  ImGui::SetNextItemWidth(-FLT_MIN);
  if (ImGui::BeginCombo("##language", LanguageName(settings.language))) {
    for (const char* language : app::kLanguages) {
      if (ImGui::Selectable(LanguageName(language), settings.language == language)) {
        settings.language = language;
      }
    }
    ImGui::EndCombo();
  }
}

void LookMenu(app::Settings& settings) {
  if (ImGui::BeginMenu(Label(Tr("Colours"), "colours").c_str())) {
    for (const Theme theme : kThemes) {
      if (ImGui::MenuItem(ThemeName(theme), nullptr, settings.theme == theme)) {
        settings.theme = theme;
      }
    }
    ImGui::EndMenu();
  }
  if (ImGui::BeginMenu(Label(Tr("Size"), "size").c_str())) {
    for (const double scale : app::kScales) {
      if (ImGui::MenuItem(ScaleName(scale).c_str(), nullptr, settings.scale == scale)) {
        settings.scale = scale;
      }
    }
    ImGui::EndMenu();
  }
  if (ImGui::BeginMenu(Label(Tr("Language"), "language").c_str())) {
    for (const char* language : app::kLanguages) {
      if (ImGui::MenuItem(LanguageName(language), nullptr, settings.language == language)) {
        settings.language = language;
      }
    }
    ImGui::EndMenu();
  }
}

}  // namespace lararium::panels
