#include "editor/document/place_edits.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <system_error>
#include <utility>

#include "editor/document/missing_files.h"
#include "editor/document/picked_images.h"
#include "shared/core/file.h"

namespace lararium::editor {

namespace {

namespace fs = std::filesystem;

constexpr std::array<stage::Anchor stage::StagePicks::*, 5> kAnchors = {
    &stage::StagePicks::origin, &stage::StagePicks::forward, &stage::StagePicks::floor,
    &stage::StagePicks::length_from, &stage::StagePicks::length_to};

// Makes the files of a folder available in a second folder: as hard links where the file system
// supports them, otherwise as copies. On an error the second folder does not exist.
Status GiveOtherName(const fs::path& folder, const fs::path& other) {
  const fs::path unfinished = other.string() + ".unfinished";
  std::error_code error;
  const auto copy = [&](fs::copy_options how) {
    fs::remove_all(unfinished, error);
    fs::copy(folder, unfinished, fs::copy_options::recursive | how, error);
    return !error;
  };
  if (copy(fs::copy_options::create_hard_links) || copy(fs::copy_options::none)) {
    fs::rename(unfinished, other, error);
  }
  if (!error) {
    return Status();
  }
  const std::string why = error.message();
  fs::remove_all(unfinished, error);
  return Status::Error(folder.string(), "cannot be renamed: " + why,
                       "check who may write to the folder");
}

Status IsOfARemovedPlace(const fs::path& folder) {
  return Status::Error(folder.string(), "already exists: it belonged to a place that was removed",
                       "move it away, or choose another name");
}

// Adds the files that the second folder lacks.
Status AddMissing(const fs::path& folder, const fs::path& other) {
  std::error_code error;
  for (auto at = fs::recursive_directory_iterator(folder, error);
       !error && at != fs::recursive_directory_iterator(); at.increment(error)) {
    const fs::path there = other / at->path().lexically_relative(folder);
    std::error_code ignored;
    if (at->is_directory(ignored)) {
      fs::create_directories(there, ignored);
    } else if (!FileExists(there)) {
      fs::create_hard_link(at->path(), there, ignored);
      if (ignored) {
        fs::copy_file(at->path(), there, error);
      }
    }
    if (error) {
      break;
    }
  }
  return error ? Status::Error(other.string(), "cannot be filled: " + error.message(),
                               "check who may write to the folder")
               : Status();
}

}  // namespace

void SetPick(stage::Anchor& anchor, const stage::Pick& pick) {
  RemovePick(anchor, pick);
  anchor.picks.push_back(pick);
}

std::vector<std::string> AnchorNames() {
  const stage::StagePicks picks = EmptyPicks();
  std::vector<std::string> names;
  for (const auto anchor : kAnchors) {
    names.push_back((picks.*anchor).name);
  }
  return names;
}

stage::Anchor* FindAnchor(stage::StagePicks& picks, std::string_view name) {
  for (const auto anchor : kAnchors) {
    if ((picks.*anchor).name == name) {
      return &(picks.*anchor);
    }
  }
  return nullptr;
}

size_t TakeOverOccluders(const PlaceDocument& from, PlaceDocument& place) {
  size_t taken = 0;
  for (const OccluderDocument& occluder : from.occluders) {
    if (!occluder.drawn() && place.FindOccluder(occluder.name) == nullptr) {
      place.occluders.push_back(WithoutPicks(occluder));
      ++taken;
    }
  }
  return taken;
}

SourceDocument RecordingAt(const ProjectPaths& paths, const std::filesystem::path& file) {
  std::error_code ignored;
  const bool folder = fs::is_directory(paths.Resolve(file.string()), ignored);
  return {folder ? SourceDocument::Kind::kImages : SourceDocument::Kind::kVideo,
          paths.Shorten(paths.Resolve(file.string()))};
}

void PutPlaceFirst(const std::string& name, ProjectDocument& document) {
  const auto begin = document.places.begin();
  const auto found = std::find_if(begin, document.places.end(),
                                  [&](const PlaceDocument& place) { return place.name == name; });
  if (found != document.places.end()) {
    std::rotate(begin, found, found + 1);
  }
}

Status GiveFolderOtherName(const ProjectPaths& paths,
                           const std::string& from,
                           const std::string& to) {
  const fs::path before = paths.Place(from);
  const fs::path after = paths.Place(to);
  std::error_code error;
  if (!fs::exists(after, error)) {
    return fs::exists(before, error) ? GiveOtherName(before, after) : Status();
  }
  const bool same_map = fs::equivalent(paths.Scene(from), paths.Scene(to), error);
  return same_map && !error ? AddMissing(before, after) : IsOfARemovedPlace(after);
}

void RenamePlaceInDocument(const ProjectPaths& paths,
                           const std::string& from,
                           const std::string& to,
                           ProjectDocument& document) {
  if (PlaceDocument* place = document.FindPlace(from)) {
    place->name = to;
    RelocateFolder(paths.Shorten(paths.Place(from)), paths.Shorten(paths.Place(to)), document);
  }
}

Status RenamePlace(const ProjectPaths& paths,
                   const std::string& from,
                   const std::string& to,
                   ProjectDocument& document) {
  const fs::path before = paths.Place(from);
  const fs::path after = paths.Place(to);
  std::error_code error;
  if (fs::exists(after, error)) {
    return IsOfARemovedPlace(after);
  }
  const bool has_folder = fs::exists(before, error);
  if (has_folder) {
    LARARIUM_RETURN_IF_ERROR(GiveOtherName(before, after));
  }
  ProjectDocument renamed = document;
  RenamePlaceInDocument(paths, from, to, renamed);
  const Status saved = SaveProject(paths, renamed);
  if (saved.ok()) {
    document = std::move(renamed);
  }
  if (has_folder) {
    fs::remove_all(saved.ok() ? before : after, error);
  }
  return saved;
}

OccluderDocument WithoutPicks(OccluderDocument occluder) {
  for (ModelPairDocument& pair : occluder.model_pairs) {
    pair.anchor.picks.clear();
  }
  return occluder;
}

}  // namespace lararium::editor
