#include "editor/jobs/wardrobe.h"

#include <cmath>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "editor/import/cast/cast_builder.h"
#include "editor/import/cast/cast_presets.h"
#include "editor/import/wardrobe/garment.h"
#include "editor/jobs/cast_library_fetch.h"
#include "editor/jobs/portrait.h"
#include "editor/jobs/studio.h"
#include "shared/core/json.h"
#include "shared/core/number_text.h"
#include "shared/core/units.h"
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

std::string Percent(float share) {
  return FormatNumber(std::round(1000.0 * static_cast<double>(share)) / 10.0) + " %";
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

Result<import::CastLibrary> OpenCastLibrary() {
  const std::optional<std::filesystem::path> folder = FindCastLibrary();
  if (!folder) {
    return Status::Error("the cast library", "is not installed",
                         "fetch it with lararium-editor fetch-cast-library");
  }
  return import::CastLibrary::Open(*folder);
}

Result<CommandResult> CheckGarment(const WardrobeOptions& options, Progress& progress) {
  LARARIUM_ASSIGN_OR_RETURN(const import::GarmentDesign design, import::ReadGarment(options.check));
  CommandResult result{Line(design), Summary(design)};
  if (options.on.empty()) {
    return result;
  }
  LARARIUM_ASSIGN_OR_RETURN(const import::CastLibrary library, OpenCastLibrary());
  LARARIUM_ASSIGN_OR_RETURN(const import::CastRecipe recipe, import::LoadCastPreset(options.on));
  LARARIUM_ASSIGN_OR_RETURN(const import::FittedBody body, import::FitBody(library, recipe));
  LARARIUM_ASSIGN_OR_RETURN(
      const std::vector<import::PieceFit> fits,
      import::TryOn(import::UsualPattern(std::make_shared<const import::GarmentDesign>(design)),
                    body, progress));
  for (const import::PieceFit& fit : fits) {
    result.text += fit.piece + " on " + options.on + ": threads at " + Percent(fit.stretch) +
                   " of the length that was cut, 99 in 100 below " + Percent(fit.stretch_99) +
                   ", one at " + Percent(fit.stretch_most) + " (" + fit.stretched_at + "); area " +
                   Percent(fit.area) + "; more than 1 cm in the body " + Percent(fit.inside) +
                   (fit.inside_at.empty() ? "" : " (" + fit.inside_at + ")") + "; lost " +
                   std::to_string(fit.lost) + " points\n";
    result.json["fit"].push_back({{"piece", fit.piece},
                                  {"stretch", fit.stretch},
                                  {"stretch_99", fit.stretch_99},
                                  {"stretch_most", fit.stretch_most},
                                  {"stretched_at", fit.stretched_at},
                                  {"area", fit.area},
                                  {"inside", fit.inside},
                                  {"inside_at", fit.inside_at},
                                  {"lost", fit.lost}});
  }
  if (const Status status = import::CheckFit(fits, design); !status.ok()) {
    result.text += status.message() + "\n";
    result.json["problem"] = status.message();
    result.failed = true;
  }
  return result;
}

// Pictures the person of the preset with nothing else on, from the front, the side and behind.
Result<CommandResult> PictureGarment(const WardrobeOptions& options, Progress& progress) {
  LARARIUM_ASSIGN_OR_RETURN(const import::CastLibrary library, OpenCastLibrary());
  LARARIUM_ASSIGN_OR_RETURN(import::CastRecipe recipe,
                            import::LoadCastPreset(options.on.empty() ? "server" : options.on));
  recipe.garments.clear();
  for (const std::string& name : options.picture) {
    recipe.garments.push_back({{"name", name}});
  }
  LARARIUM_ASSIGN_OR_RETURN(human::Human human, import::BuildCast(library, recipe, progress));
  const StudioPose pose = CalmPose(human);
  LARARIUM_ASSIGN_OR_RETURN(const std::unique_ptr<Studio> studio, Studio::Create());
  LARARIUM_RETURN_IF_ERROR(
      studio->Seat(std::make_shared<const human::Human>(std::move(human)), pose));
  const PortraitOptions portrait;
  std::vector<cv::Mat> shots;
  for (const float azimuth : {0.0f, 0.5f * kPiF, kPiF}) {
    LARARIUM_ASSIGN_OR_RETURN(
        const StudioShot shot,
        studio->Shoot({.azimuth = azimuth}, cv::Size(portrait.width, portrait.height)));
    shots.push_back(shot.picture);
  }
  cv::Mat picture;
  cv::hconcat(shots, picture);
  LARARIUM_RETURN_IF_ERROR(image::WriteImage(options.out, picture));
  return CommandResult{"wrote " + options.out.string() + "\n", {{"out", options.out.string()}}};
}

}  // namespace

Result<CommandResult> RunWardrobe(const WardrobeOptions& options, Progress& progress) {
  if (!options.check.empty()) {
    return CheckGarment(options, progress);
  }
  return options.picture.empty() ? ListWardrobe() : PictureGarment(options, progress);
}

}  // namespace lararium::editor
