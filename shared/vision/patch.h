#pragma once

// Small square templates and where an image shows them, to a fraction of a pixel.
// Inverse-compositional alignment (Baker & Matthews, "Lucas-Kanade 20 years on",
// IJCV 2004) with gain and offset of the brightness eliminated.

#include <Eigen/Core>
#include <array>
#include <opencv2/core/mat.hpp>

namespace lararium::vision {

inline constexpr int kPatchSize = 8;  // pixels along each side
inline constexpr int kPatchArea = kPatchSize * kPatchSize;
inline constexpr float kPatchHalf = 0.5f * (kPatchSize - 1);  // from its centre to its outer pixels

// How what is seen moves during the exposure: it is at velocity * t +
// acceleration * t^2 / 2 pixels from its place in the middle, t in -1/2..1/2.
struct PatchMotion {
  Eigen::Vector2f velocity = Eigen::Vector2f::Zero();
  Eigen::Vector2f acceleration = Eigen::Vector2f::Zero();
};

// How patch pixels lie in a source image: offset o from the patch's centre is
// sampled at centre + source_from_patch * o. The source is sharp; motion, in its
// pixels, blurs the patch.
struct PatchWarp {
  Eigen::Vector2f centre = Eigen::Vector2f::Zero();
  Eigen::Matrix2f source_from_patch = Eigen::Matrix2f::Identity();
  PatchMotion motion = {};
};

// What is looked for. Rows of kPatchSize values.
struct PatchTemplate {
  std::array<float, kPatchArea> values;  // less their mean
  // Derivatives along x and y, less what a change of gain or offset explains.
  std::array<float, kPatchArea> dx;
  std::array<float, kPatchArea> dy;
  float energy = 0.0f;                                  // sum of squared values
  Eigen::Matrix2f gradients = Eigen::Matrix2f::Zero();  // sums of products of dx and dy
  Eigen::Matrix2f step = Eigen::Matrix2f::Zero();       // its damped inverse

  // Samples the source; false where the patch and a border of one pixel are not
  // inside it, or show nothing but flat brightness.
  bool Sample(const cv::Mat& source, const PatchWarp& warp);
};

// Where a template was found.
struct PatchFit {
  Eigen::Vector2f centre = Eigen::Vector2f::Zero();
  float gain = 0.0f;         // of the image over the template, grey over grey
  float correlation = 0.0f;  // normalised, -1..1
  float noise2 = 0.0f;       // variance of what gain and offset leave, grey levels^2
  // Inverse of the centre's covariance, were the noise independent from pixel to
  // pixel.
  Eigen::Matrix2f information = Eigen::Matrix2f::Zero();
};

struct PatchSearch {
  int iterations = 10;
  float largest_shift = 3.0f;  // pixels from the start
  float converged = 0.01f;     // pixels of the last step
};

// Finds the template in image from start. false: left the image, wandered off, or
// shows an inverted contrast.
bool AlignPatch(const cv::Mat& image,
                const PatchTemplate& patch,
                const Eigen::Vector2f& start,
                const PatchSearch& search,
                PatchFit& fit);

// Normalised correlation with the image around centre; -1 outside it.
float CorrelatePatch(const cv::Mat& image,
                     const PatchTemplate& patch,
                     const Eigen::Vector2f& centre);

}  // namespace lararium::vision
