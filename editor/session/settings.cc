#include "editor/session/settings.h"

#include <algorithm>
#include <array>
#include <string>

#include "editor/document/user_folders.h"
#include "shared/core/file.h"
#include "shared/core/json.h"
#include "shared/core/json_fields.h"

namespace lararium::editor {

namespace {

constexpr int kSettingsSchema = 1;
constexpr size_t kMaxSettingsBytes = size_t{1} << 16;

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
  std::error_code error;
  if (!std::filesystem::exists(file, error)) {
    return Settings();
  }
  const Result<std::string> text = ReadText(file, kMaxSettingsBytes);
  Result<Settings> settings =
      text.ok() ? ParseFields<Settings>(*text, file.string(), DescribeSettings) : text.status();
  if (!settings.ok()) {
    return SetAside(file, settings.status(), "choose the look again in the menu View");
  }
  return settings;
}

Status SaveSettings(const std::filesystem::path& file, const Settings& settings) {
  std::error_code error;
  std::filesystem::create_directories(file.parent_path(), error);
  return SaveJson(file, FormatFields(settings, DescribeSettings));
}

}  // namespace lararium::editor
