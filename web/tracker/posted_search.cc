#include "web/tracker/posted_search.h"

#include <algorithm>

#include "shared/core/check.h"

namespace lararium::web {

void PostedSearch::Begin(const cv::Mat& grey, const vision::CameraGuess& guess) {
  busy_ = true;
  grey_ = grey;
  question_ = Numbers(SearchQuestion{++number_, guess});
}

std::optional<vision::Located> PostedSearch::Take(bool wait) {
  CHECK(!wait);
  if (!answer_) {
    return std::nullopt;
  }
  taken_ = std::move(*answer_);
  Drop();
  return taken_.located;
}

void PostedSearch::Drop() {
  busy_ = false;
  answer_.reset();
  Posted();
}

void PostedSearch::Posted() {
  question_.clear();
  grey_.release();
}

Status PostedSearch::Answer(std::span<const double> numbers) {
  LARARIUM_ASSIGN_OR_RETURN(SearchAnswer answer, ParseAnswer(numbers));
  const uint32_t map = answer.located.map;
  const auto exists = [&](const vision::LocatedPoint& p) { return p.point < map_points_[map]; };
  if (map >= map_points_.size() ||
      !std::all_of(answer.points.begin(), answer.points.end(), exists)) {
    return Status::Error("answer of the search", "names a point or a map that does not exist",
                         "open the same maps in both workers");
  }
  if (busy_ && answer.number == number_) {
    answer_ = std::move(answer);
  }
  return Status();
}

}  // namespace lararium::web
