#include "editor/jobs/exporting.h"

#include <algorithm>
#include <ctime>
#include <optional>
#include <system_error>
#include <utility>

#include "editor/bake/caption_font.h"
#include "editor/export/export.h"
#include "editor/jobs/baking.h"
#include "editor/jobs/caption_glyphs.h"
#include "editor/jobs/credits.h"
#include "editor/jobs/lines.h"
#include "editor/jobs/paradata.h"
#include "editor/jobs/sounds.h"
#include "editor/jobs/staging.h"
#include "editor/train/budget.h"
#include "shared/bundle/publishing.h"
#include "shared/bundle/signature.h"
#include "shared/core/file.h"
#include "shared/core/free_space.h"
#include "shared/core/program.h"
#include "shared/vision/scene_database.h"

namespace lararium::editor {

namespace {

Result<exporter::PlaceContent> PackPlace(const ProjectPaths& paths,
                                         const PlaceDocument& place,
                                         const MapBudget& budget) {
  exporter::PlaceContent content;
  LARARIUM_ASSIGN_OR_RETURN(const StagedMap map, LoadStagedMap(paths, place));
  LARARIUM_RETURN_IF_ERROR(map.picks.problem);
  vision::SceneDatabase packed =
      train::Prune(*map.database, {.max_points = budget.max_points,
                                   .max_descriptors_per_point = budget.max_descriptors_per_point,
                                   .image_coverage = budget.image_coverage,
                                   .pictured_observations = budget.pictured_observations});
  packed.descriptor_sessions.clear();  // Only needed to remove sessions, which players never do.
  content.scene = vision::SerializeSceneDatabase(packed);
  LARARIUM_ASSIGN_OR_RETURN(content.place,
                            StagePlace(paths, place, *map.database, map.picks.map_from_picked));
  LARARIUM_ASSIGN_OR_RETURN(content.glossy, LoadBakedReflections(paths, place));
  return content;
}

// Packs the lines, and the texts of the paradata.
Status PackTexts(const ProjectPaths& paths,
                 const ProjectDocument& document,
                 exporter::ExportContent& content) {
  LARARIUM_ASSIGN_OR_RETURN(const ProjectLines lines, LoadProjectLines(paths, document));
  LARARIUM_ASSIGN_OR_RETURN(const auto spoken_lines, SpokenLines(paths, document, lines));
  for (const SpokenLine& spoken : spoken_lines) {
    exporter::SpokenContent packed;
    packed.line = spoken.line->id;
    packed.speaker = spoken.line->speaker;
    packed.language = spoken.language;
    LARARIUM_ASSIGN_OR_RETURN(packed.visemes, ReadText(spoken.visemes));
    LARARIUM_ASSIGN_OR_RETURN(packed.sound, ReadBytes(spoken.sound));
    content.lines.push_back(std::move(packed));
  }
  for (const std::string& language : lines.spoken) {
    LARARIUM_ASSIGN_OR_RETURN(const stage::CaptionBook book,
                              MakeCaptions(document, lines, spoken_lines, language));
    content.spoken.push_back({language, stage::FormatCaptions(book)});
  }
  for (const std::string& language : lines.captions) {
    LARARIUM_ASSIGN_OR_RETURN(const stage::CaptionBook book,
                              MakeDescriptions(spoken_lines, language));
    if (!book.lines.empty()) {
      content.descriptions.push_back({language, stage::FormatCaptions(book)});
    }
  }
  content.captions = lines.captions;
  LARARIUM_ASSIGN_OR_RETURN(const stage::Paradata paradata, LoadParadata(paths));
  if (!paradata.empty()) {
    content.paradata = stage::FormatParadata(paradata);
  }
  if (!lines.captions.empty() || !paradata.empty()) {
    std::vector<Sentence> ignored;  // The check of the project reports these.
    LARARIUM_ASSIGN_OR_RETURN(const render::CaptionFont font,
                              MakeCaptionFont(lines, spoken_lines, paradata, ignored));
    LARARIUM_ASSIGN_OR_RETURN(bake::CaptionFontFiles files, bake::FormatCaptionFont(font));
    content.caption_metrics = std::move(files.metrics);
    content.caption_atlas = std::move(files.atlas);
  }
  return Status();
}

// Bakes stale products, and collects all that a bundle has.
Result<exporter::ExportContent> CollectContent(const ProjectPaths& paths,
                                               const ProjectDocument& document,
                                               const ExportRequest& request,
                                               Progress& progress) {
  LARARIUM_RETURN_IF_ERROR(RequireSpace(request.out.parent_path()));
  LARARIUM_RETURN_IF_ERROR(Bake(paths, document, progress).status());
  exporter::ExportContent content;
  content.title = document.title;
  LARARIUM_ASSIGN_OR_RETURN(const Credits credits, MakeCredits(paths, document));
  content.credits = credits.text;
  LARARIUM_ASSIGN_OR_RETURN(content.drama, ReadText(paths.Drama()));
  for (const PlaceDocument& place : document.places) {
    progress.Report("packing", static_cast<double>(content.places.size()) /
                                   static_cast<double>(document.places.size()));
    if (progress.Cancelled()) {
      return Status::Error("export", "cancelled");
    }
    LARARIUM_ASSIGN_OR_RETURN(exporter::PlaceContent packed,
                              PackPlace(paths, place, request.budget));
    content.places.push_back(std::move(packed));
  }
  for (const CastDocument& member : document.cast) {
    LARARIUM_ASSIGN_OR_RETURN(std::vector<std::byte> human,
                              ReadBytes(BakedHumanFile(paths, member)));
    content.cast.push_back({member.name, std::move(human)});
  }
  for (const ObjectDocument& object : document.objects) {
    LARARIUM_ASSIGN_OR_RETURN(std::vector<std::byte> prop, ReadBytes(paths.Prop(object.name)));
    content.objects.push_back({object.name, std::move(prop), StageFromObject(object)});
  }
  LARARIUM_RETURN_IF_ERROR(PackTexts(paths, document, content));
  LARARIUM_ASSIGN_OR_RETURN(content.sounds, LoadSounds(paths));
  return content;
}

}  // namespace

MapBudget ForBrowsers(MapBudget budget) {
  budget.max_points = std::min(budget.max_points, 4000);
  budget.max_descriptors_per_point = std::min(budget.max_descriptors_per_point, 2);
  budget.image_coverage = std::min(budget.image_coverage, 0.95);
  budget.pictured_observations = true;
  return budget;
}

Status ExportProject(const ProjectPaths& paths,
                     const ProjectDocument& document,
                     const ExportRequest& request,
                     Progress& progress) {
  std::optional<bundle::SecretKey> key;
  if (!request.key.empty()) {
    LARARIUM_ASSIGN_OR_RETURN(key, bundle::LoadSecretKey(request.key));
  }
  LARARIUM_ASSIGN_OR_RETURN(const exporter::ExportContent content,
                            CollectContent(paths, document, request, progress));
  return exporter::ExportBundle(content, request.out, progress, key ? &*key : nullptr);
}

Result<bundle::WebFolderReport> ExportProjectForWeb(const ProjectPaths& paths,
                                                    const ProjectDocument& document,
                                                    const ExportRequest& request,
                                                    Progress& progress) {
  if (request.key.empty()) {
    return Status::Error(request.out.string(), "a folder for browsers has to be signed",
                         "name a secret key with --sign, which lararium-editor key makes");
  }
  LARARIUM_ASSIGN_OR_RETURN(const bundle::SecretKey key, bundle::LoadSecretKey(request.key));
  const exporter::WebExport web{
      .folder = request.out,
      .page = request.page.empty() ? ShippedData("lararium/web", "build/web/page") : request.page,
      .address = request.address,
      .fleet = request.fleet};
  LARARIUM_RETURN_IF_ERROR(exporter::CheckWebExport(web));
  ExportRequest smaller = request;
  smaller.budget = ForBrowsers(request.budget);
  LARARIUM_ASSIGN_OR_RETURN(exporter::ExportContent content,
                            CollectContent(paths, document, smaller, progress));
  return exporter::ExportWebFolder(std::move(content), web, key, progress);
}

Result<bundle::Publication> PublishProject(const ProjectPaths& paths,
                                           const ProjectDocument& document,
                                           const ExportRequest& request,
                                           Progress& progress) {
  LARARIUM_ASSIGN_OR_RETURN(const bundle::SecretKey key, bundle::LoadSecretKey(request.key));
  LARARIUM_RETURN_IF_ERROR(bundle::CheckPublishing(request.out, key.public_key()));
  LARARIUM_ASSIGN_OR_RETURN(const exporter::ExportContent content,
                            CollectContent(paths, document, request, progress));
  std::error_code error;
  std::filesystem::create_directories(request.out, error);
  // The bundle is written to the same disk, so that it can be moved.
  const std::filesystem::path unpublished = request.out / ".unpublished.larshow";
  LARARIUM_RETURN_IF_ERROR(exporter::ExportBundle(content, unpublished, progress, &key));
  auto published = bundle::Publish(unpublished, request.out, key, std::time(nullptr));
  // If publishing failed, the bundle is still there.
  std::filesystem::remove(unpublished, error);
  return published;
}

}  // namespace lararium::editor
