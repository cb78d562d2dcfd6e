#include "editor/panels/widgets/theme.h"

#include <cmath>
#include <filesystem>
#include <vector>

#include "editor/panels/widgets/icons.h"
#include "editor/panels/widgets/wrapped_text.h"
#include "shared/core/file.h"

namespace lararium::panels {

namespace {

constexpr const char* kFontFolders[] = {
    "/usr/share/fonts/opentype/inter", "/usr/share/fonts/truetype/inter",
    "/usr/local/share/fonts/inter", "/usr/share/fonts/truetype/dejavu"};
constexpr const char* kIconFont =
    "/usr/share/fonts/truetype/materialdesignicons-webfont/materialdesignicons-webfont.ttf";

// There is only one interface; these are set with the theme.
float g_scale = 1.0f;
Theme g_theme = Theme::kDark;
Fonts g_fonts;

ImFont* LoadFont(const char* name, float size) {
  // Latin and Greek with accents, and the few other characters that labels use.
  static const ImWchar kRanges[] = {0x0020, 0x017f, 0x0370, 0x03ff, 0x1e00, 0x1fff,
                                    0x2013, 0x2014, 0x2018, 0x201d, 0x2022, 0x2022,
                                    0x2026, 0x2026, 0x2190, 0x2193, 0};
  for (const char* folder : kFontFolders) {
    const std::filesystem::path file = std::filesystem::path(folder) / name;
    if (FileExists(file)) {
      ImFontConfig config;
      // A value of 3 looks no better at these sizes, and needs half as much memory again.
      config.OversampleH = 2;
      return ImGui::GetIO().Fonts->AddFontFromFileTTF(file.c_str(), size, &config, kRanges);
    }
  }
  return nullptr;
}

// Adds the icons to a font whose line is line pixels high, centred in it.
void MergeIcons(ImFont* font, float line, float side) {
  static const std::vector<ImWchar> ranges = [] {
    std::vector<ImWchar> list;
    for (int i = 0; i < kIcons; ++i) {
      const auto letter = static_cast<ImWchar>(LetterOf(static_cast<Icon>(i)));
      list.insert(list.end(), {letter, letter});
    }
    list.push_back(0);
    return list;
  }();
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  if (FileExists(kIconFont)) {
    ImFontConfig config;
    config.MergeMode = true;
    config.DstFont = font;
    config.GlyphMinAdvanceX = side;
    config.GlyphOffset.y = std::round(0.5f * (side - line));
    atlas.AddFontFromFileTTF(kIconFont, side, &config, ranges.data());
    return;
  }
  for (size_t i = 0; i + 1 < ranges.size(); i += 2) {  // Empty, instead of a question mark.
    atlas.AddCustomRectFontGlyph(font, ranges[i], 1, 1, 0.0f);
  }
}

Fonts LoadFonts(float scale) {
  Fonts fonts;
  ImGui::GetIO().Fonts->Flags |= ImFontAtlasFlags_NoPowerOfTwoHeight;
  fonts.regular = LoadFont("Inter-Regular.otf", kTextPx * scale);
  if (fonts.regular == nullptr) {
    ImFontConfig config;
    config.SizePixels = kTextPx * scale;
    fonts.regular = ImGui::GetIO().Fonts->AddFontDefault(&config);
  }
  for (const char32_t sign : {kRowEnd, kRowBegin}) {  // Empty and of zero width.
    ImGui::GetIO().Fonts->AddCustomRectFontGlyph(fonts.regular, static_cast<ImWchar>(sign), 1, 1,
                                                 0.0f);
  }
  MergeIcons(fonts.regular, kTextPx * scale, std::round(kIconPx * scale));
  // Loaded after the interface's font, because ImGui uses the first font as its default.
  fonts.strong = LoadFont("Inter-SemiBold.otf", kTextPx * scale);
  fonts.code = LoadFont("DejaVuSansMono.ttf", kCodePx * scale);
  fonts.title = LoadFont("Inter-SemiBold.otf", kTitlePx * scale);
  if (fonts.strong == nullptr) {
    fonts.strong = fonts.regular;
    fonts.title = fonts.regular;
  }
  if (fonts.code == nullptr) {
    fonts.code = ImGui::GetIO().Fonts->AddFontDefault();
  }
  return fonts;
}

void SetColours(ImGuiStyle& style) {
  ImVec4* c = style.Colors;
  const ImVec4 clear(0, 0, 0, 0);
  const auto accent = [](float alpha) { return WithAlpha(Colours().accent, alpha); };
  c[ImGuiCol_Text] = Colours().text;
  c[ImGuiCol_TextDisabled] = Colours().dim;
  c[ImGuiCol_WindowBg] = Colours().window;
  c[ImGuiCol_ChildBg] = clear;
  c[ImGuiCol_PopupBg] = Colours().panel;
  c[ImGuiCol_MenuBarBg] = Colours().window;
  c[ImGuiCol_Border] = Colours().line;
  c[ImGuiCol_Separator] = Colours().line;
  c[ImGuiCol_SeparatorHovered] = accent(0.6f);
  c[ImGuiCol_SeparatorActive] = accent(1.0f);
  c[ImGuiCol_FrameBg] = Colours().frame;
  c[ImGuiCol_FrameBgHovered] = Colours().hover;
  c[ImGuiCol_FrameBgActive] = Colours().hover;
  c[ImGuiCol_Button] = Colours().frame;
  c[ImGuiCol_ButtonHovered] = Colours().hover;
  c[ImGuiCol_ButtonActive] = Colours().chosen;
  c[ImGuiCol_Header] = accent(kSelectedTint);
  c[ImGuiCol_HeaderHovered] = Colours().hover;
  c[ImGuiCol_HeaderActive] = accent(kPressedTint);
  c[ImGuiCol_CheckMark] = accent(1.0f);
  c[ImGuiCol_SliderGrab] = Colours().chosen;  // The number is written over it.
  c[ImGuiCol_SliderGrabActive] = Colours().chosen;
  c[ImGuiCol_PlotHistogram] = accent(1.0f);
  c[ImGuiCol_TextSelectedBg] = accent(kPressedTint);
  c[ImGuiCol_NavHighlight] = accent(0.8f);
  c[ImGuiCol_ScrollbarBg] = clear;
  c[ImGuiCol_ScrollbarGrab] = Colours().frame;
  c[ImGuiCol_ScrollbarGrabHovered] = Colours().hover;
  c[ImGuiCol_ScrollbarGrabActive] = Colours().hover;
  c[ImGuiCol_TitleBg] = Colours().panel;
  c[ImGuiCol_TitleBgActive] = Colours().panel;
  c[ImGuiCol_TableHeaderBg] = Colours().frame;
  c[ImGuiCol_TableBorderStrong] = Colours().line;
  c[ImGuiCol_TableBorderLight] = Colours().line;
  c[ImGuiCol_ModalWindowDimBg] = ImVec4(0, 0, 0, 0.45f);
}

}  // namespace

const Palette& Colours() { return PaletteOf(g_theme); }

void ApplyTheme(Theme theme, float scale) {
  g_theme = theme;
  g_scale = scale;
  ImGuiStyle& style = ImGui::GetStyle();
  style = ImGuiStyle();
  style.WindowPadding = {12, 10};
  style.FramePadding = {9, 5};
  style.ItemSpacing = {8, 7};
  style.ItemInnerSpacing = {6, 5};
  style.CellPadding = {4, 3};
  style.IndentSpacing = 16;
  style.ScrollbarSize = 11;
  style.GrabMinSize = 11;
  style.WindowRounding = 0;
  style.ChildRounding = 4;
  style.FrameRounding = 4;
  style.PopupRounding = 6;
  style.GrabRounding = 4;
  style.ScrollbarRounding = 6;
  style.WindowBorderSize = 0;
  style.ChildBorderSize = 0;
  style.PopupBorderSize = 1;
  style.ScaleAllSizes(scale);
  SetColours(style);
  ImGui::GetIO().Fonts->Clear();
  g_fonts = LoadFonts(scale);
}

const Fonts& ThemeFonts() { return g_fonts; }

float Px(float logical) { return logical * g_scale; }

}  // namespace lararium::panels
