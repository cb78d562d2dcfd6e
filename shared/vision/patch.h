#pragma once

// Aligns small square templates with an image to sub-pixel accuracy, by inverse-compositional
// alignment (Baker & Matthews, "Lucas-Kanade 20 years on", IJCV 2004) with gain and offset of the
// brightness eliminated.

#include <Eigen/Core>
#include <array>
#include <opencv2/core/mat.hpp>

namespace lararium::vision {

inline constexpr int kPatchSize = 8;  // pixels along each side
inline constexpr int kPatchArea = kPatchSize * kPatchSize;
// Distance from the patch's centre to its outer pixels.
inline constexpr float kPatchHalf = 0.5f * (kPatchSize - 1);

// Motion of a patch in the image during the exposure. At time t in -1/2..1/2 the patch is displaced
// by velocity * t + acceleration * t^2 / 2 pixels from its position in the middle of the exposure.
struct PatchMotion {
  Eigen::Vector2f velocity = Eigen::Vector2f::Zero();
  Eigen::Vector2f acceleration = Eigen::Vector2f::Zero();
};

// Maps patch pixels into a source image: the pixel at offset o from the patch's centre is sampled
// at centre + source_from_patch * o. The source is sharp; `motion`, in source pixels, blurs the
// patch.
struct PatchWarp {
  Eigen::Vector2f centre = Eigen::Vector2f::Zero();
  Eigen::Matrix2f source_from_patch = Eigen::Matrix2f::Identity();
  PatchMotion motion = {};
};

// The template that is searched for. Arrays are kPatchSize rows of kPatchSize values.
struct PatchTemplate {
  std::array<float, kPatchArea> values;  // Grey levels minus their mean.
  // Derivatives along x and y, with the components removed that a change of gain or offset
  // explains.
  std::array<float, kPatchArea> dx;
  std::array<float, kPatchArea> dy;
  float energy = 0.0f;                                  // Sum of the squared values.
  Eigen::Matrix2f gradients = Eigen::Matrix2f::Zero();  // Sums of the products of dx and dy.
  Eigen::Matrix2f step = Eigen::Matrix2f::Zero();       // Damped inverse of `gradients`.

  // Samples the source. Returns false if the patch with a border of one pixel is not inside the
  // source, or if it has hardly any contrast.
  bool Sample(const cv::Mat& source, const PatchWarp& warp);
};

// The position at which a template was found.
struct PatchFit {
  Eigen::Vector2f centre = Eigen::Vector2f::Zero();
  float gain = 0.0f;         // Brightness of the image over the template, in encoded grey levels.
  float correlation = 0.0f;  // Normalised correlation, -1..1.
  float noise2 = 0.0f;       // Residual variance after gain and offset, grey levels^2.
  // Inverse of the centre's covariance, assuming independent pixel noise.
  Eigen::Matrix2f information = Eigen::Matrix2f::Zero();
};

struct PatchSearch {
  int iterations = 10;
  float largest_shift = 3.0f;  // Maximum distance from the start, pixels.
  float converged = 0.01f;     // Alignment stops after a step shorter than this, pixels.
};

// Finds the template in image near start. Returns false if the search leaves the image, moves
// farther than search.largest_shift, or meets an inverted contrast.
bool AlignPatch(const cv::Mat& image,
                const PatchTemplate& patch,
                const Eigen::Vector2f& start,
                const PatchSearch& search,
                PatchFit& fit);

// Normalised correlation of the template with the image around centre; -1 outside the image.
float CorrelatePatch(const cv::Mat& image,
                     const PatchTemplate& patch,
                     const Eigen::Vector2f& centre);

}  // namespace lararium::vision
