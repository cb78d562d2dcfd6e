#include "player/kiosk/kiosk_state.h"

#include <array>
#include <optional>
#include <system_error>

#include "shared/core/file.h"
#include "shared/core/json.h"

namespace lararium::player {
namespace {

constexpr int64_t kSchema = 1;
constexpr size_t kMaxText = 1000;
constexpr uint64_t kMaxBytes = 1 << 16;
constexpr double kMaxSeconds = 1e6;

std::filesystem::path StateFile(const std::filesystem::path& folder) {
  return folder / "state.json";
}

// Reads a choice by its name.
template <typename Choice, size_t n>
Status ReadChoice(const JsonView& view,
                  const char* key,
                  const std::array<std::string_view, n>& names,
                  Choice& choice) {
  LARARIUM_ASSIGN_OR_RETURN(const std::string name, view.Text(key, kMaxText));
  const std::optional<Choice> found = render::ChoiceOf<Choice>(names, name);
  if (!found) {
    return view.Problem(std::string(key) + " cannot be \"" + name + "\"", "remove it");
  }
  choice = *found;
  return Status();
}

Status ReadSwitch(const JsonView& view, const char* key, bool& on) {
  LARARIUM_ASSIGN_OR_RETURN(const JsonView field, view.Field(key));
  LARARIUM_ASSIGN_OR_RETURN(on, field.Boolean());
  return Status();
}

Status ReadChoices(const JsonView& view, Choices& choices) {
  LARARIUM_ASSIGN_OR_RETURN(choices.language, view.Text("language", kMaxText));
  LARARIUM_ASSIGN_OR_RETURN(choices.captions, view.Text("captions", kMaxText));
  LARARIUM_ASSIGN_OR_RETURN(choices.volume, view.Number("volume", 0.0, 1.0));
  render::CaptionStyle& style = choices.caption_style;
  LARARIUM_RETURN_IF_ERROR(ReadChoice(view, "caption_size", render::kCaptionSizes, style.size));
  LARARIUM_RETURN_IF_ERROR(
      ReadChoice(view, "caption_contrast", render::kCaptionContrasts, style.contrast));
  LARARIUM_RETURN_IF_ERROR(ReadSwitch(view, "descriptions", choices.descriptions));
  return ReadSwitch(view, "reduced_motion", choices.reduced_motion);
}

Json ToJson(const Choices& choices) {
  const render::CaptionStyle& style = choices.caption_style;
  return {{"language", choices.language},
          {"captions", choices.captions},
          {"caption_size", NameOf(render::kCaptionSizes, style.size)},
          {"caption_contrast", NameOf(render::kCaptionContrasts, style.contrast)},
          {"descriptions", choices.descriptions},
          {"reduced_motion", choices.reduced_motion},
          {"volume", choices.volume}};
}

}  // namespace

Result<KioskState> LoadKioskState(const std::filesystem::path& folder) {
  const std::filesystem::path path = StateFile(folder);
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) {
    return KioskState();
  }
  LARARIUM_ASSIGN_OR_RETURN(const std::string text, ReadText(path, kMaxBytes));
  return ParseKioskState(text, path.string());
}

Result<KioskState> ParseKioskState(std::string_view text, const std::string& where) {
  KioskState state;
  LARARIUM_ASSIGN_OR_RETURN(const Json json, ParseJson(text, where));
  const JsonView view(json, where);
  LARARIUM_ASSIGN_OR_RETURN(const int64_t schema, view.Integer("schema", 1, 1'000'000));
  if (schema != kSchema) {
    return view.Problem("was written by a newer player", "remove it");
  }
  LARARIUM_ASSIGN_OR_RETURN(state.title, view.Text("title", kMaxText));
  LARARIUM_ASSIGN_OR_RETURN(state.seconds, view.Number("seconds", 0.0, kMaxSeconds));
  LARARIUM_RETURN_IF_ERROR(ReadChoices(view, state.choices));
  LARARIUM_ASSIGN_OR_RETURN(const JsonView house, view.Field("house"));
  LARARIUM_RETURN_IF_ERROR(ReadChoices(house, state.house));
  return state;
}

Status SaveKioskState(const std::filesystem::path& folder, const KioskState& state) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    return Status::Error(folder.string(), "cannot be created: " + error.message(),
                         "name another folder with --state");
  }
  Json json = ToJson(state.choices);
  json["schema"] = kSchema;
  json["title"] = state.title;
  json["seconds"] = state.seconds;
  json["house"] = ToJson(state.house);
  return SaveJson(StateFile(folder), json);
}

}  // namespace lararium::player
