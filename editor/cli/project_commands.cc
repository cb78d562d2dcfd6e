#include "editor/cli/project_commands.h"

#include <algorithm>
#include <filesystem>
#include <tuple>
#include <utility>
#include <vector>

#include "editor/cli/command_arguments.h"
#include "editor/document/missing_files.h"
#include "editor/document/named_entries.h"
#include "editor/document/place_edits.h"
#include "editor/jobs/sounds.h"
#include "editor/jobs/staging.h"
#include "editor/text/text.h"
#include "shared/core/file.h"
#include "shared/stage/caption_file.h"

namespace lararium::editor {

namespace {

namespace fs = std::filesystem;

// Parses "la,it"; an empty text means the languages of the lines.
Result<std::vector<std::string>> ParseLanguages(const std::string& option,
                                                const std::string& text) {
  std::vector<std::string> languages;
  for (size_t begin = 0; !text.empty() && begin <= text.size();) {
    const size_t end = std::min(text.find(',', begin), text.size());
    const std::string language = text.substr(begin, end - begin);
    if (!stage::IsLanguageTag(language) ||
        std::find(languages.begin(), languages.end(), language) != languages.end()) {
      return Status::Error(option,
                           "'" + language + "' is not a valid language tag, or occurs twice",
                           "use one such as la, it or en");
    }
    languages.push_back(language);
    begin = end + 1;
  }
  return languages;
}

CommandResult Described(const ProjectDocument& document) {
  CommandResult result;
  result.text =
      document.title + "\n" +
      Text("%zu places, %zu people, %zu objects, %zu check points\n", document.places.size(),
           document.cast.size(), document.objects.size(), document.check_points.size()) +
      "spoken: " + JoinNames(document.speech.spoken) +
      "\ncaptions: " + JoinNames(document.speech.captions) + "\n";
  if (!document.credits.empty()) {
    result.text += document.credits + "\n";
  }
  result.json = FormatProject(document);
  return result;
}

std::string DescribeSource(const SourceDocument& source) {
  return source.empty() ? "no recording" : source.path;
}

Result<std::vector<MissingFile>> AllMissing(const ProjectPaths& paths,
                                            const ProjectDocument& document) {
  LARARIUM_ASSIGN_OR_RETURN(const std::string script, ReadText(paths.Drama()));
  return MissingFiles(paths, document, FindMissingSounds(paths, document, script));
}

// Copies sounds; updates the paths of files that the document names.
Status Take(const Relocation& move,
            const std::vector<MissingFile>& missing,
            const ProjectPaths& paths,
            ProjectDocument& document) {
  const bool sound = std::any_of(missing.begin(), missing.end(), [&](const MissingFile& file) {
    return file.kind == FileKind::kSound && file.path == move.from;
  });
  if (sound) {
    return BringInSound(paths, std::filesystem::path(move.from).filename().string(),
                        paths.Resolve(move.to));
  }
  Relocate(move, document);
  return Status();
}

Status Locate(const LocateOptions& options, const ProjectPaths& paths, ProjectDocument& document) {
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<MissingFile> missing, AllMissing(paths, document));
  const bool known = std::any_of(missing.begin(), missing.end(), [&](const MissingFile& file) {
    return file.path == options.from;
  });
  if (!known) {
    return Status::Error("--from " + options.from, "is not missing",
                         "`locate` without options lists the missing files");
  }
  const Relocation located{options.from, paths.Shorten(options.to)};
  std::vector<Relocation> moves = {located};
  if (!options.alone) {
    const std::vector<Relocation> along = SameMove(paths, missing, located);
    moves.insert(moves.end(), along.begin(), along.end());
  }
  for (const Relocation& move : moves) {
    LARARIUM_RETURN_IF_ERROR(Take(move, missing, paths, document));
  }
  return Status();
}

class PlaceWorker {
 public:
  PlaceWorker(ProjectPaths paths, ProjectDocument document, const PlaceOptions& options)
      : paths_(std::move(paths)), document_(std::move(document)), options_(options) {}

  Result<CommandResult> Run() {
    LARARIUM_RETURN_IF_ERROR(Work());
    CommandResult result;
    result.json = Json::array();
    for (const PlaceDocument& place : document_.places) {
      LARARIUM_RETURN_IF_ERROR(List(place, result));
    }
    if (document_.places.empty()) {
      result.text = "no places; add one with `train`\n";
    }
    return result;
  }

 private:
  Result<PlaceDocument*> Find(const std::string& name) {
    return FindTitled(document_.places, name, paths_.Project().string(), "has no place");
  }

  // Performs the edit and saves; does not list.
  Status Work() {
    if (!options_.rename.empty()) {
      return Rename();
    }
    if (options_.add.empty() && options_.set.empty() && options_.first.empty() &&
        options_.remove.empty()) {
      return Status();
    }
    if (!options_.add.empty()) {
      PlaceDocument added;
      LARARIUM_RETURN_IF_ERROR(NameEntry(document_.places, "--add", options_.add, "place", added));
      document_.places.push_back(std::move(added));
    }
    LARARIUM_ASSIGN_OR_RETURN(PlaceDocument * place,
                              Find(options_.add + options_.set + options_.first + options_.remove));
    if (!options_.first.empty()) {
      PutPlaceFirst(std::string(place->name), document_);
    } else if (!options_.remove.empty()) {
      document_.places.erase(document_.places.begin() + (place - document_.places.data()));
    } else {
      LARARIUM_RETURN_IF_ERROR(Change(*place));
    }
    return SaveProject(paths_, document_);
  }

  Status Change(PlaceDocument& place) {
    if (options_.title) {
      LARARIUM_RETURN_IF_ERROR(CheckTitle("--title", *options_.title));
      SetTitle(*options_.title, place);
    }
    for (const auto& [file, kind] :
         {std::pair{&options_.video, SourceDocument::Kind::kVideo},
          std::pair{&options_.images_of, SourceDocument::Kind::kImages}}) {
      if (!file->empty()) {
        place.training = {kind, paths_.Shorten(*file)};
      }
    }
    if (!options_.preview.empty()) {
      place.preview = RecordingAt(paths_, fs::absolute(options_.preview));
      if (place.preview.path == place.training.path) {
        place.preview = SourceDocument();  // Plays the training recording by default.
      }
    }
    if (!options_.occluders_of.empty()) {
      LARARIUM_ASSIGN_OR_RETURN(const PlaceDocument* from, Find(options_.occluders_of));
      TakeOverOccluders(*from, place);
    }
    return Status();
  }

  Status Rename() {
    LARARIUM_ASSIGN_OR_RETURN(PlaceDocument * place, Find(options_.rename));
    const std::string from = place->name;
    PlaceDocument named;
    LARARIUM_RETURN_IF_ERROR(NameEntry(document_.places, "--to", options_.to, "place", named));
    place->title = named.title;
    return RenamePlace(paths_, from, named.name, document_);
  }

  Status List(const PlaceDocument& place, CommandResult& result) const {
    const bool trained = FileExists(paths_.Scene(place.name));
    const std::string title = place.title.empty() ? "" : " (" + place.title + ")";
    result.text += place.name + title + ": " + (trained ? "trained from " : "not trained; ") +
                   DescribeSource(place.training);
    if (!place.preview.empty()) {
      result.text += ", seen by " + place.preview.path;
    }
    result.text += Text("; %zu recordings added, %zu occluders, %zu probes\n", place.added.size(),
                        place.occluders.size(), place.probes.size());
    Json json = {{"name", place.name},
                 {"title", place.title},
                 {"trained", trained},
                 {"training", place.training.path},
                 {"preview", place.preview.path},
                 {"added", place.added.size()},
                 {"occluders", place.occluders.size()},
                 {"probes", place.probes.size()}};
    if (options_.images && trained) {
      LARARIUM_RETURN_IF_ERROR(ListImages(place.name, result.text, json["images"]));
    }
    result.json.push_back(std::move(json));
    return Status();
  }

  // Lists the images in which points can be picked.
  Status ListImages(const std::string& place, std::string& text, Json& json) const {
    LARARIUM_ASSIGN_OR_RETURN(const vision::SceneDatabase map, LoadMap(paths_, place));
    for (const vision::Keyframe& keyframe : map.keyframes) {
      text += "  " + keyframe.name +
              (keyframe.session == 0 ? "" : Text(", session %u", keyframe.session)) + "\n";
      json.push_back({{"frame", keyframe.name},
                      {"frame_index", keyframe.frame_index},
                      {"session", keyframe.session}});
    }
    return Status();
  }

  ProjectPaths paths_;
  ProjectDocument document_;
  const PlaceOptions& options_;
};

}  // namespace

Result<CommandResult> RunProject(const ProjectOptions& options) {
  const ProjectPaths paths{options.project};
  LARARIUM_ASSIGN_OR_RETURN(ProjectDocument document, LoadProject(paths));
  document.title = options.title.value_or(document.title);
  document.credits = options.credits.value_or(document.credits);
  for (const auto& [option, given, languages] :
       {std::tuple{"--spoken", &options.spoken, &document.speech.spoken},
        {"--captions", &options.captions, &document.speech.captions}}) {
    if (given->has_value()) {
      LARARIUM_ASSIGN_OR_RETURN(*languages, ParseLanguages(option, **given));
    }
  }
  if (options.title || options.credits || options.spoken || options.captions) {
    LARARIUM_RETURN_IF_ERROR(SaveProject(paths, document));
  }
  return Described(document);
}

Result<CommandResult> RunLocate(const LocateOptions& options) {
  const ProjectPaths paths{options.project};
  LARARIUM_ASSIGN_OR_RETURN(ProjectDocument document, LoadProject(paths));
  if (!options.from.empty()) {
    LARARIUM_RETURN_IF_ERROR(Locate(options, paths, document));
    LARARIUM_RETURN_IF_ERROR(SaveProject(paths, document));
  }
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<MissingFile> missing, AllMissing(paths, document));
  CommandResult result;
  result.json = Json::array();
  for (const MissingFile& file : missing) {
    result.text += file.path + ": " + file.role + "\n";
    result.json.push_back({{"path", file.path}, {"role", file.role}});
  }
  if (missing.empty()) {
    result.text = "no file is missing\n";
  }
  return result;
}

Result<CommandResult> RunPlace(const PlaceOptions& options) {
  const ProjectPaths paths{options.project};
  LARARIUM_ASSIGN_OR_RETURN(ProjectDocument document, LoadProject(paths));
  return PlaceWorker(paths, std::move(document), options).Run();
}

}  // namespace lararium::editor
