#pragma once

// What a place's map is made of, and what was picked in its images.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "editor/app/project.h"
#include "shared/core/json.h"
#include "shared/core/status.h"

namespace lararium::app {

struct PlaceRecordings {
  SourceDocument training;
  std::optional<geometry::CameraModel> intrinsics;  // none: training estimated them
  std::vector<SessionDocument> added;
};

PlaceRecordings RecordingsOf(const PlaceDocument& place);
// The place names these, and forgets what was picked in added ones beyond them.
void SetRecordings(const PlaceRecordings& recordings, PlaceDocument& place);

// Fields of an object, which may have others: "training", "intrinsics", "added".
Result<PlaceRecordings> ParseRecordings(const JsonView& view);
Json FormatRecordings(const PlaceRecordings& recordings);
// {"video": PATH} or {"images": PATH}.
Result<SourceDocument> ParseSource(const JsonView& view);
Json FormatSource(const SourceDocument& source);

// All that is picked in the images of a place. Place: const or not.
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

// How many picks of a place lie in images of this session of its map or a later one.
size_t PicksInSessionsFrom(const PlaceDocument& place, uint32_t session);

}  // namespace lararium::app
