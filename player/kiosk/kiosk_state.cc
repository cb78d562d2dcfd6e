#include "player/kiosk/kiosk_state.h"

#include <system_error>

#include "shared/core/file.h"
#include "shared/core/json.h"
#include "shared/core/json_fields.h"

namespace lararium::player {
namespace {

constexpr int64_t kSchema = 1;
constexpr size_t kMaxText = 1000;
constexpr uint64_t kMaxBytes = 1 << 16;
constexpr double kMaxSeconds = 1e6;

std::filesystem::path StateFile(const std::filesystem::path& folder) {
  return folder / "state.json";
}

void DescribeChoices(Fields& fields, Choices& choices) {
  fields.Text("language", choices.language, kMaxText);
  fields.Text("captions", choices.captions, kMaxText);
  fields.Text(Optional("read"), choices.read, kMaxText);
  fields.Number("volume", choices.volume, 0.0, 1.0);
  render::CaptionStyle& style = choices.caption_style;
  fields.Choice("caption_size", style.size, render::kCaptionSizes, "caption_size cannot be \"{}\"",
                "remove it");
  fields.Choice("caption_contrast", style.contrast, render::kCaptionContrasts,
                "caption_contrast cannot be \"{}\"", "remove it");
  fields.Flag("descriptions", choices.descriptions);
  fields.Flag("reduced_motion", choices.reduced_motion);
}

void DescribeState(Fields& fields, KioskState& state) {
  fields.Schema(kSchema, "was written by a newer player", "remove it");
  fields.Text("title", state.title, kMaxText);
  fields.Number("seconds", state.seconds, 0.0, kMaxSeconds);
  DescribeChoices(fields, state.choices);
  fields.Object("house", state.house, DescribeChoices);
}

}  // namespace

Result<KioskState> LoadKioskState(const std::filesystem::path& folder) {
  const std::filesystem::path path = StateFile(folder);
  if (!FileExists(path)) {
    return KioskState();
  }
  LARARIUM_ASSIGN_OR_RETURN(const std::string text, ReadText(path, kMaxBytes));
  return ParseKioskState(text, path.string());
}

Result<KioskState> ParseKioskState(std::string_view text, const std::string& where) {
  return ParseFields<KioskState>(text, where, DescribeState, UnknownFields::kIgnore);
}

Status SaveKioskState(const std::filesystem::path& folder, const KioskState& state) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    return Status::Error(folder.string(), "cannot be created: " + error.message(),
                         "name another folder with --state");
  }
  return SaveJson(StateFile(folder), FormatFields(state, DescribeState));
}

}  // namespace lararium::player
