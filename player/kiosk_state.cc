#include "player/kiosk_state.h"

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

Status ReadChoices(const JsonView& view, Choices& choices) {
  LARARIUM_ASSIGN_OR_RETURN(choices.language, view.Text("language", kMaxText));
  LARARIUM_ASSIGN_OR_RETURN(choices.captions, view.Text("captions", kMaxText));
  LARARIUM_ASSIGN_OR_RETURN(choices.volume, view.Number("volume", 0.0, 1.0));
  return Status();
}

Json ToJson(const Choices& choices) {
  return {
      {"language", choices.language}, {"captions", choices.captions}, {"volume", choices.volume}};
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

Result<KioskState> ParseKioskState(std::string_view text, const std::string& place) {
  KioskState state;
  LARARIUM_ASSIGN_OR_RETURN(const Json json, ParseJson(text, place));
  const JsonView view(json, place);
  LARARIUM_ASSIGN_OR_RETURN(const int64_t schema, view.Integer("schema", 1, 1'000'000));
  if (schema != kSchema) {
    return view.Problem("was written by a newer player", "remove it");
  }
  LARARIUM_ASSIGN_OR_RETURN(state.title, view.Text("title", kMaxText));
  LARARIUM_ASSIGN_OR_RETURN(state.seconds, view.Number("seconds", 0.0, kMaxSeconds));
  LARARIUM_RETURN_IF_ERROR(ReadChoices(view, state.choices));
  if (view.Has("house")) {
    LARARIUM_ASSIGN_OR_RETURN(const JsonView house, view.Field("house"));
    LARARIUM_RETURN_IF_ERROR(ReadChoices(house, state.house));
  }
  return state;
}

Status SaveKioskState(const std::filesystem::path& folder, const KioskState& state) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    return Status::Error(folder.string(), "cannot be made: " + error.message(),
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
