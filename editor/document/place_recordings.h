#pragma once

// The recordings that a place's map is built from, and the picks in their images.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "editor/document/project.h"
#include "shared/core/json_fields.h"

namespace lararium::editor {

struct PlaceRecordings {
  SourceDocument training;
  std::optional<geometry::CameraModel> intrinsics;  // Not set: training estimated them.
  std::vector<SessionDocument> added;
};

PlaceRecordings RecordingsOf(const PlaceDocument& place);
// Sets the place's recordings, and removes the picks in added sessions beyond them.
void SetRecordings(const PlaceRecordings& recordings, PlaceDocument& place);

void DescribeFields(Fields& fields, PlaceRecordings& recordings);
// An object {"video": PATH} or {"images": PATH}, which is missing if the source is empty.
void DescribeSource(Fields& fields, std::string_view name, SourceDocument& source);

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
