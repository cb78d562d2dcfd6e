#pragma once

// The recordings that a place's map is built from, and the picks in their images.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "editor/document/project.h"
#include "shared/core/json.h"
#include "shared/core/status.h"

namespace lararium::editor {

struct PlaceRecordings {
  SourceDocument training;
  std::optional<geometry::CameraModel> intrinsics;  // Not set: training estimated them.
  std::vector<SessionDocument> added;
};

PlaceRecordings RecordingsOf(const PlaceDocument& place);
// Sets the place's recordings, and removes the picks in added sessions beyond them.
void SetRecordings(const PlaceRecordings& recordings, PlaceDocument& place);

// Reads the fields "training", "intrinsics" and "added" of an object, which may have other fields.
Result<PlaceRecordings> ParseRecordings(const JsonView& view);
Json FormatRecordings(const PlaceRecordings& recordings);
// {"video": PATH} or {"images": PATH}.
Result<SourceDocument> ParseSource(const JsonView& view);
Json FormatSource(const SourceDocument& source);

// Calls visit for every anchor of a place. Place may be const.
template <typename Place, typename Visit>
void ForEachAnchor(Place& place, const Visit& visit) {
  for (auto* anchor : {&place.picks.origin, &place.picks.forward, &place.picks.floor,
                       &place.picks.length_from, &place.picks.length_to}) {
    visit(*anchor);
  }
  for (auto& occluder : place.occluders) {
    std::for_each(occluder.corners.begin(), occluder.corners.end(), visit);
    for (auto& pair : occluder.model_pairs) {
      visit(pair.anchor);
    }
  }
  std::for_each(place.check_picks.begin(), place.check_picks.end(), visit);
}

// The number of picks of a place in images of this session of its map or of a later one.
size_t PicksInSessionsFrom(const PlaceDocument& place, uint32_t session);

}  // namespace lararium::editor
