#include "editor/session/settings.h"

#include <algorithm>
#include <array>

#include "editor/document/user_folders.h"

namespace lararium::editor {

namespace {

constexpr int kSettingsSchema = 1;

void DescribeSettings(Fields& fields, Settings& settings) {
  constexpr std::array<std::string_view, 2> kThemes = {"dark", "light"};
  fields.Schema(kSettingsSchema);
  fields.Choice("theme", settings.theme, kThemes, "\"theme\" must be \"dark\" or \"light\"");
  fields.Number("scale", settings.scale);
  fields.Require(std::find(kScales.begin(), kScales.end(), settings.scale) != kScales.end(),
                 "\"scale\" must be 1, 1.25, 1.5 or 2");
  fields.Text("language", settings.language);
  fields.Require(
      std::find(kLanguages.begin(), kLanguages.end(), settings.language) != kLanguages.end(),
      "\"language\" must be \"\", \"en\" or \"it\"");
}

}  // namespace

Result<Settings> LoadSettings(const std::filesystem::path& file) {
  return LoadUserFile<Settings>(file, "choose the look again in the menu View", DescribeSettings);
}

Status SaveSettings(const std::filesystem::path& file, const Settings& settings) {
  return SaveUserFile(file, settings, DescribeSettings);
}

}  // namespace lararium::editor
