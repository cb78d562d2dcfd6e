#include "editor/panels/dialogs/look.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <string>

#include "editor/panels/widgets/palette.h"
#include "editor/panels/widgets/text.h"
#include "editor/panels/widgets/theme.h"
#include "editor/panels/widgets/widgets.h"

namespace lararium::panels {

namespace {

constexpr std::array<Theme, 2> kThemes = {Theme::kDark, Theme::kLight};

const char* ThemeName(Theme theme) {
  return theme == Theme::kLight ? TrIn("colours", "Light") : TrIn("colours", "Dark");
}

std::string ScaleName(double scale) {
  return Text("%d %%", static_cast<int>(std::lround(100.0 * scale)));
}

// Each language has its own name, so that users who do not read the present one find theirs.
const char* LanguageName(const std::string& language) {
  return language == "it" ? "Italiano" : language == "en" ? "English" : Tr("As the system");
}

}  // namespace

void DrawLook(editor::Settings& settings) {
  DimText(Tr("Colours"));
  const char* const themes[] = {ThemeName(kThemes[0]), ThemeName(kThemes[1])};
  int theme = settings.theme == kThemes[1] ? 1 : 0;
  if (Segmented("theme", themes, theme)) {
    settings.theme = kThemes[static_cast<size_t>(theme)];
  }
  ImGui::Dummy(ImVec2(0, Px(4)));
  DimText(Tr("Size"));
  std::array<std::string, editor::kScales.size()> names;
  std::array<const char*, editor::kScales.size()> labels = {};
  for (size_t i = 0; i < names.size(); ++i) {
    names[i] = ScaleName(editor::kScales[i]);
    labels[i] = names[i].c_str();
  }
  const auto known = std::find(editor::kScales.begin(), editor::kScales.end(), settings.scale);
  int scale = static_cast<int>(known - editor::kScales.begin());
  if (Segmented("scale", labels, scale)) {
    settings.scale = editor::kScales[static_cast<size_t>(scale)];
  }
  ImGui::Dummy(ImVec2(0, Px(4)));
  DimText(Tr("Language"));
  ImGui::SetNextItemWidth(-FLT_MIN);
  if (ImGui::BeginCombo("##language", LanguageName(settings.language))) {
    for (const char* language : editor::kLanguages) {
      if (ImGui::Selectable(LanguageName(language), settings.language == language)) {
        settings.language = language;
      }
    }
    ImGui::EndCombo();
  }
}

void LookMenu(editor::Settings& settings) {
  if (ImGui::BeginMenu(Label(Tr("Colours"), "colours").c_str())) {
    for (const Theme theme : kThemes) {
      if (ImGui::MenuItem(ThemeName(theme), nullptr, settings.theme == theme)) {
        settings.theme = theme;
      }
    }
    ImGui::EndMenu();
  }
  if (ImGui::BeginMenu(Label(Tr("Size"), "size").c_str())) {
    for (const double scale : editor::kScales) {
      if (ImGui::MenuItem(ScaleName(scale).c_str(), nullptr, settings.scale == scale)) {
        settings.scale = scale;
      }
    }
    ImGui::EndMenu();
  }
  if (ImGui::BeginMenu(Label(Tr("Language"), "language").c_str())) {
    for (const char* language : editor::kLanguages) {
      if (ImGui::MenuItem(LanguageName(language), nullptr, settings.language == language)) {
        settings.language = language;
      }
    }
    ImGui::EndMenu();
  }
}

}  // namespace lararium::panels
