#include "editor/import/cast/cast_presets.h"

namespace lararium::import {
namespace {

std::string_view NameOf(const EmbeddedText& text) {
  return std::string_view(text.name).substr(0, std::string_view(text.name).rfind('.'));
}

}  // namespace

std::vector<std::string> CastPresetNames() {
  std::vector<std::string> names;
  for (const EmbeddedText& text : CastPresetTexts()) {
    names.emplace_back(NameOf(text));
  }
  return names;
}

Result<CastRecipe> LoadCastPreset(std::string_view name) {
  std::string known;
  for (const EmbeddedText& text : CastPresetTexts()) {
    if (NameOf(text) == name) {
      const std::string place = "preset " + std::string(name);
      LARARIUM_ASSIGN_OR_RETURN(const Json json, ParseJson(text.text, place));
      return ParseFields<CastRecipe>(JsonView(json, place));
    }
    known += (known.empty() ? "" : ", ") + std::string(NameOf(text));
  }
  return Status::Error("preset \"" + std::string(name) + "\"", "does not exist",
                       "choose one of " + known);
}

}  // namespace lararium::import
