#pragma once

// Onion skin, as in animation programs: people and objects at other moments of the drama,
// translucent below those of the present moment.

#include <glm/vec3.hpp>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "shared/show/show.h"

namespace lararium::editor {

struct OnionSkin {
  static constexpr int kMost = 5;  // The most skins on each side.
  static constexpr double kShortest = 0.1;
  static constexpr double kLongest = 5.0;

  int before = 1;
  int after = 1;
  double spacing = 0.5;                 // Seconds between two skins.
  glm::vec3 colour_before = {0, 0, 1};  // sRGB.
  glm::vec3 colour_after = {1, 1, 0};

  friend bool operator==(const OnionSkin&, const OnionSkin&) = default;
};

struct OnionMoment {
  double offset = 0.0;  // Seconds from the present moment.
  glm::vec3 colour = {};
  float opacity = 0.0f;
};

// In drawing order: skins that are farther in time come first and are fainter. Leaves out moments
// before the beginning of the drama.
std::vector<OnionMoment> OnionMoments(const OnionSkin& skin, double time);

// Removes from other the people and objects that have not moved (by more than a centimetre) since
// now: they need no skins.
void RemoveUnmoved(const show::StagedFrame& now, show::StagedFrame& other);

// Blends an overlay (ShowRenderer::DrawOverlays) over a picture, CV_8UC3, except where present
// people and objects cover it. The coverages are CV_8UC1 and have the size of the picture.
void BlendOverlay(const cv::Mat& overlay,
                  const cv::Mat& overlay_coverage,
                  const cv::Mat& coverage_now,
                  float opacity,
                  cv::Mat& picture);

}  // namespace lararium::editor
