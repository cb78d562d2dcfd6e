#include "editor/jobs/wardrobe.h"

#include <optional>
#include <system_error>
#include <utility>

#include "editor/import/cast/cast_builder.h"
#include "editor/import/cast/cast_presets.h"
#include "editor/import/wardrobe/garment_design.h"
#include "editor/jobs/cast_library_fetch.h"
#include "editor/jobs/portrait.h"
#include "shared/core/file.h"
#include "shared/core/json.h"
#include "shared/human/human.h"

namespace lararium::editor {
namespace {

constexpr uint64_t kLargestGarment = 1 << 20;  // Bytes.

Json Summary(const import::GarmentDesign& design) {
  Json parameters = Json::array();
  for (const import::GarmentParameter& parameter : design.parameters) {
    parameters.push_back(parameter.name);
  }
  return {{"name", design.name},       {"title", design.title},
          {"about", design.about},     {"certainty", stage::NameOf(design.certainty)},
          {"sources", design.sources}, {"parameters", std::move(parameters)}};
}

std::string Line(const import::GarmentDesign& design) {
  return design.name + ": " + design.title + ", " + std::string(stage::NameOf(design.certainty)) +
         ". " + design.about + "\n";
}

Result<CommandResult> ListWardrobe() {
  CommandResult result;
  result.json = Json::array();
  for (const std::string& name : import::GarmentNames()) {
    LARARIUM_ASSIGN_OR_RETURN(const import::GarmentDesign design, import::LoadGarment(name));
    result.text += Line(design);
    result.json.push_back(Summary(design));
  }
  return result;
}

// Pictures the person of the preset with nothing else on.
Result<CommandResult> PictureGarment(const WardrobeOptions& options, Progress& progress) {
  const std::optional<std::filesystem::path> folder = FindCastLibrary();
  if (!folder) {
    return Status::Error("the cast library", "is not installed",
                         "fetch it with lararium-editor fetch-cast-library");
  }
  LARARIUM_ASSIGN_OR_RETURN(const import::CastLibrary library, import::CastLibrary::Open(*folder));
  LARARIUM_ASSIGN_OR_RETURN(import::CastRecipe recipe, import::LoadCastPreset(options.on));
  recipe.garments = {{{"name", options.picture}}};
  LARARIUM_ASSIGN_OR_RETURN(const human::Human human, import::BuildCast(library, recipe, progress));
  std::filesystem::path file = options.out;
  file += ".larhuman";
  LARARIUM_RETURN_IF_ERROR(WriteFileAtomically(file, human::SerializeHuman(human)));
  PortraitOptions portrait;
  portrait.files = {file};
  portrait.out = options.out;
  Result<CommandResult> result = RunPortrait(portrait);
  std::error_code ignored;
  std::filesystem::remove(file, ignored);
  return result;
}

}  // namespace

Result<CommandResult> RunWardrobe(const WardrobeOptions& options, Progress& progress) {
  if (!options.check.empty()) {
    LARARIUM_ASSIGN_OR_RETURN(const std::string text, ReadText(options.check, kLargestGarment));
    LARARIUM_ASSIGN_OR_RETURN(const import::GarmentDesign design,
                              import::ParseGarment(text, options.check));
    return CommandResult{Line(design), Summary(design)};
  }
  return options.picture.empty() ? ListWardrobe() : PictureGarment(options, progress);
}

}  // namespace lararium::editor
