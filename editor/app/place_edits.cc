#include "editor/app/place_edits.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <system_error>
#include <utility>

#include "editor/app/missing_files.h"
#include "editor/app/occluder_alignment.h"
#include "editor/app/picked_images.h"

namespace lararium::app {

namespace {

namespace fs = std::filesystem;

constexpr std::array<stage::Anchor stage::StagePicks::*, 5> kAnchors = {
    &stage::StagePicks::origin, &stage::StagePicks::forward, &stage::StagePicks::floor,
    &stage::StagePicks::length_from, &stage::StagePicks::length_to};

// The files of a folder in another one as well: the same ones where the disk has them under two
// names, else copies. All of them, or an error and none.
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
  return Status::Error(folder.string(), "cannot be renamed: " + why, "look who may write there");
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

Status RenamePlace(const ProjectPaths& paths,
                   const std::string& from,
                   const std::string& to,
                   ProjectDocument& document) {
  const fs::path before = paths.Place(from);
  const fs::path after = paths.Place(to);
  std::error_code error;
  if (fs::exists(after, error)) {
    return Status::Error(after.string(), "is there already, of a place that was removed",
                         "move it away, or choose another name");
  }
  const bool has_folder = fs::exists(before, error);
  if (has_folder) {
    LARARIUM_RETURN_IF_ERROR(GiveOtherName(before, after));
  }
  ProjectDocument renamed = document;
  renamed.FindPlace(from)->name = to;
  RelocateFolder(paths.Shorten(before), paths.Shorten(after), renamed);
  const Status saved = SaveProject(paths, renamed);
  if (saved.ok()) {
    document = std::move(renamed);
  }
  if (has_folder) {
    fs::remove_all(saved.ok() ? before : after, error);
  }
  return saved;
}

}  // namespace lararium::app
