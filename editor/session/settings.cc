#include "editor/session/settings.h"

#include <algorithm>
#include <string>

#include "editor/document/user_folders.h"
#include "shared/core/file.h"
#include "shared/core/json.h"

namespace lararium::editor {

namespace {

constexpr int kSettingsSchema = 1;
constexpr size_t kMaxSettingsBytes = size_t{1} << 16;

Result<Settings> Parse(const std::string& text, const std::string& place) {
  LARARIUM_ASSIGN_OR_RETURN(const Json json, ParseJson(text, place));
  const JsonView view(json, place);
  LARARIUM_RETURN_IF_ERROR(view.CheckFields({"schema", "theme", "scale", "language"}));
  LARARIUM_RETURN_IF_ERROR(view.Integer("schema", kSettingsSchema, kSettingsSchema).status());
  Settings settings;
  LARARIUM_ASSIGN_OR_RETURN(const std::string theme, view.Text("theme"));
  if (theme != "dark" && theme != "light") {
    return view.Problem("\"theme\" must be \"dark\" or \"light\"");
  }
  settings.theme = theme == "light" ? Theme::kLight : Theme::kDark;
  LARARIUM_ASSIGN_OR_RETURN(settings.scale, view.Number("scale"));
  if (std::find(kScales.begin(), kScales.end(), settings.scale) == kScales.end()) {
    return view.Problem("\"scale\" must be 1, 1.25, 1.5 or 2");
  }
  LARARIUM_ASSIGN_OR_RETURN(settings.language, view.Text("language"));
  if (std::find(kLanguages.begin(), kLanguages.end(), settings.language) == kLanguages.end()) {
    return view.Problem("\"language\" must be \"\", \"en\" or \"it\"");
  }
  return settings;
}

}  // namespace

Result<Settings> LoadSettings(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) {
    return Settings();
  }
  const Result<std::string> text = ReadText(file, kMaxSettingsBytes);
  Result<Settings> settings = text.ok() ? Parse(*text, file.string()) : text.status();
  if (!settings.ok()) {
    return SetAside(file, settings.status(), "choose the look again in the menu View");
  }
  return settings;
}

Status SaveSettings(const std::filesystem::path& file, const Settings& settings) {
  std::error_code error;
  std::filesystem::create_directories(file.parent_path(), error);
  return SaveJson(file, {{"schema", kSettingsSchema},
                         {"theme", settings.theme == Theme::kLight ? "light" : "dark"},
                         {"scale", settings.scale},
                         {"language", settings.language}});
}

}  // namespace lararium::editor
