#include "editor/app/place_edits.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <system_error>

#include "editor/app/missing_files.h"
#include "editor/app/occluder_alignment.h"

namespace lararium::app {

namespace {

constexpr std::array<stage::Anchor stage::StagePicks::*, 5> kAnchors = {
    &stage::StagePicks::origin, &stage::StagePicks::forward, &stage::StagePicks::floor,
    &stage::StagePicks::length_from, &stage::StagePicks::length_to};

}  // namespace

void SetPick(stage::Anchor& anchor, const stage::Pick& pick) {
  std::erase_if(anchor.picks, [&](const stage::Pick& known) {
    return known.session == pick.session && known.frame_index == pick.frame_index &&
           (known.frame.empty() || known.frame == pick.frame);
  });
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
  std::error_code error;
  if (std::filesystem::exists(paths.Place(to), error)) {
    return Status::Error(paths.Place(to).string(), "is there already, of a place that was removed",
                         "move it away, or choose another name");
  }
  if (std::filesystem::exists(paths.Place(from), error)) {
    std::filesystem::rename(paths.Place(from), paths.Place(to), error);
    if (error) {
      return Status::Error(paths.Place(from).string(), "cannot be renamed: " + error.message(),
                           "look who may write there");
    }
  }
  document.FindPlace(from)->name = to;
  const std::string before = paths.Shorten(paths.Place(from)) + "/";
  const std::string after = paths.Shorten(paths.Place(to)) + "/";
  for (const MissingFile& file : MissingFiles(paths, document)) {
    if (file.path.starts_with(before)) {
      Relocate({file.path, after + file.path.substr(before.size())}, document);
    }
  }
  return Status();
}

}  // namespace lararium::app
