#include "shared/vision/background/joined_search.h"

namespace lararium::vision {

void JoinedSearch::Begin(const cv::Mat& grey, const CameraGuess& guess) {
  grey_ = grey;
  guess_ = guess;
}

std::optional<Located> JoinedSearch::Take(bool /*wait*/) {
  Located located = relocalizer_.Find(grey_, guess_);
  map_ = located.map;
  grey_.release();
  return located;
}

}  // namespace lararium::vision
