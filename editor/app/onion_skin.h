#pragma once

// Onion skin, as animators call it: people and things at other moments of the drama, translucent
// below those of the moment that is shown.

#include <glm/vec3.hpp>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "shared/show/show.h"

namespace lararium::app {

struct OnionSkin {
  static constexpr int kMost = 5;  // to either side
  static constexpr double kShortest = 0.1;
  static constexpr double kLongest = 5.0;

  int before = 1;
  int after = 1;
  double spacing = 0.5;                 // seconds between two of them
  glm::vec3 colour_before = {0, 0, 1};  // sRGB
  glm::vec3 colour_after = {1, 1, 0};

  friend bool operator==(const OnionSkin&, const OnionSkin&) = default;
};

struct OnionMoment {
  double offset = 0.0;  // seconds from the moment that is shown
  glm::vec3 colour = {};
  float opacity = 0.0f;
};

// In the order in which they are drawn: the farther in time, the earlier and the fainter. Without
// those before the drama's beginning.
std::vector<OnionMoment> OnionMoments(const OnionSkin& skin, double time);

// Takes out of other who and what is where they are now, but for what nobody would call a move
// (a centimetre): whoever stands still has no skins.
void RemoveUnmoved(const show::StagedFrame& now, show::StagedFrame& other);

// Lays a ghost (ShowRenderer::DrawGhosts) over a picture, CV_8UC3, but not over those who are
// there now. Coverages: CV_8UC1, of the picture's size.
void BlendGhost(const cv::Mat& ghost,
                const cv::Mat& ghost_coverage,
                const cv::Mat& coverage_now,
                float opacity,
                cv::Mat& picture);

}  // namespace lararium::app
