#include "editor/jobs/wardrobe.h"

#include <memory>
#include <optional>
#include <utility>

#include "editor/import/cast/cast_builder.h"
#include "editor/import/cast/cast_presets.h"
#include "editor/import/wardrobe/garment_design.h"
#include "editor/jobs/cast_library_fetch.h"
#include "editor/jobs/portrait.h"
#include "editor/jobs/studio.h"
#include "shared/core/json.h"
#include "shared/human/human.h"
#include "shared/image/encode.h"

namespace lararium::editor {
namespace {

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
  LARARIUM_ASSIGN_OR_RETURN(human::Human human, import::BuildCast(library, recipe, progress));
  const StudioPose pose = CalmPose(human);
  LARARIUM_ASSIGN_OR_RETURN(const std::unique_ptr<Studio> studio, Studio::Create());
  LARARIUM_RETURN_IF_ERROR(
      studio->Seat(std::make_shared<const human::Human>(std::move(human)), pose));
  const PortraitOptions portrait;
  LARARIUM_ASSIGN_OR_RETURN(const StudioShot shot,
                            studio->Shoot({}, cv::Size(portrait.width, portrait.height)));
  LARARIUM_RETURN_IF_ERROR(image::WriteImage(options.out, shot.picture));
  return CommandResult{"wrote " + options.out.string() + "\n", {{"out", options.out.string()}}};
}

}  // namespace

Result<CommandResult> RunWardrobe(const WardrobeOptions& options, Progress& progress) {
  if (!options.check.empty()) {
    LARARIUM_ASSIGN_OR_RETURN(const import::GarmentDesign design,
                              import::ReadGarment(options.check));
    return CommandResult{Line(design), Summary(design)};
  }
  return options.picture.empty() ? ListWardrobe() : PictureGarment(options, progress);
}

}  // namespace lararium::editor
