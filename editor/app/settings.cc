#include "editor/app/settings.h"

#include <algorithm>
#include <string>

#include "editor/app/document_fields.h"
#include "editor/app/user_folders.h"
#include "shared/core/file.h"
#include "shared/core/json.h"

namespace lararium::app {

namespace {

constexpr int kSchema = 1;
constexpr size_t kMaxFileBytes = size_t{1} << 16;

Result<Settings> Parse(const std::string& text, const std::string& place) {
  LARARIUM_ASSIGN_OR_RETURN(const Json json, ParseJson(text, place));
  const JsonView view(json, place);
  LARARIUM_RETURN_IF_ERROR(CheckFields(view, {"schema", "theme", "scale", "language"}));
  LARARIUM_RETURN_IF_ERROR(view.Integer("schema", kSchema, kSchema).status());
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
  if (view.Has("language")) {  // those of older versions have none
    LARARIUM_ASSIGN_OR_RETURN(settings.language, view.Text("language"));
    if (std::find(kLanguages.begin(), kLanguages.end(), settings.language) == kLanguages.end()) {
      return view.Problem("\"language\" must be \"\", \"en\" or \"it\"");
    }
  }
  return settings;
}

}  // namespace

Result<Settings> LoadSettings(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) {
    return Settings();
  }
  const Result<std::string> text = ReadText(file, kMaxFileBytes);
  Result<Settings> settings = text.ok() ? Parse(*text, file.string()) : text.status();
  if (!settings.ok()) {
    return SetAside(file, settings.status(), "choose the look again in the menu View");
  }
  return settings;
}

Status SaveSettings(const std::filesystem::path& file, const Settings& settings) {
  std::error_code error;
  std::filesystem::create_directories(file.parent_path(), error);
  return SaveJson(file, {{"schema", kSchema},
                         {"theme", settings.theme == Theme::kLight ? "light" : "dark"},
                         {"scale", settings.scale},
                         {"language", settings.language}});
}

}  // namespace lararium::app
