#include "shared/vision/confidence.h"

#include <algorithm>
#include <cmath>

namespace lararium::vision {
namespace {

using geometry::CameraModel;

// The continued fraction of the incomplete beta function (Abramowitz & Stegun, "Handbook of
// Mathematical Functions", 26.5.8), evaluated by Lentz's method. Converges fast for
// x < (a + 1) / (a + b + 2).
double BetaFraction(double a, double b, double x) {
  constexpr double kTiny = 1e-300;
  constexpr int kMostTerms = 500;
  const auto away_from_zero = [](double v) { return std::abs(v) < kTiny ? kTiny : v; };
  double c = 1.0;
  double d = 1.0 / away_from_zero(1.0 - (a + b) * x / (a + 1.0));
  double fraction = d;
  for (int m = 1; m <= kMostTerms; ++m) {
    const double even = m * (b - m) * x / ((a + 2 * m - 1.0) * (a + 2 * m));
    d = 1.0 / away_from_zero(1.0 + even * d);
    c = away_from_zero(1.0 + even / c);
    fraction *= d * c;
    const double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1.0));
    d = 1.0 / away_from_zero(1.0 + odd * d);
    c = away_from_zero(1.0 + odd / c);
    fraction *= d * c;
    if (std::abs(d * c - 1.0) < 1e-14) {
      break;
    }
  }
  return fraction;
}

// The means of J' J over the image and the depths, in square pixels.
template <int N>
struct MeanSquares {
  // J: the derivative of a point's projection by (w, v) and the camera's parameters.
  JointMatrix<N> by_parameters = JointMatrix<N>::Zero();
  // J: the derivative by how the turning changes, beyond its part that moves all of the image.
  Eigen::Matrix3d by_turning_change = Eigen::Matrix3d::Zero();
};

template <int N>
MeanSquares<N> ComputeMeanSquares(const CameraModel& model, const PoseEvidence& evidence) {
  constexpr int kColumns = 5;
  constexpr int kRows = 4;
  MeanSquares<N> sum;
  CameraEstimate camera = ExactCamera(model);
  camera.readout = evidence.shutter.readout;
  const double mean_square_time = camera.readout.squaredNorm() / 12.0;
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const Eigen::Vector2d pixel((column + 0.5) * model.width / kColumns - 0.5,
                                  (row + 0.5) * model.height / kRows - 0.5);
      const Eigen::Vector2d plane = model.PlaneFromPixel(pixel);
      for (const double depth : evidence.depths) {
        Eigen::Vector2d residual;
        Eigen::Matrix<double, 2, N> jacobian;
        if (PixelResidual<N>(camera, depth * plane.homogeneous(), &evidence.shutter.motion, pixel,
                             residual, &jacobian)) {
          sum.by_parameters.noalias() += jacobian.transpose() * jacobian;
          const double time = camera.TimeOf(pixel);
          const Eigen::Matrix<double, 2, 3> by_change =
              0.5 * (time * time - mean_square_time) * jacobian.template leftCols<3>();
          sum.by_turning_change.noalias() += by_change.transpose() * by_change;
        }
      }
    }
  }
  const double count = kColumns * kRows * static_cast<double>(evidence.depths.size());
  return {sum.by_parameters / count, sum.by_turning_change / count};
}

// Adds what the quadratic form d' M d contributes, where d has the covariance C: its mean is the
// trace of CM, and half its variance that of CMCM.
template <int N>
void AddQuadraticForm(const JointMatrix<N>& covariance,
                      const JointMatrix<N>& mean_squares,
                      RegistrationVariance& variance) {
  const JointMatrix<N> product = covariance.lazyProduct(mean_squares);
  variance.sum += product.trace();
  variance.sum_of_squares += product.cwiseProduct(product.transpose()).sum();
}

template <int N>
RegistrationVariance VarianceOf(const CameraModel& camera, const PoseEvidence& evidence) {
  const MeanSquares<N> squares = ComputeMeanSquares<N>(camera, evidence);
  RegistrationVariance variance;
  AddQuadraticForm<N>(evidence.covariance.topLeftCorner<N, N>(), squares.by_parameters, variance);
  AddQuadraticForm<3>(evidence.turning_change, squares.by_turning_change, variance);
  return variance;
}

}  // namespace

double RegularisedBeta(double a, double b, double x) {
  if (x <= 0.0) {
    return 0.0;
  }
  if (x >= 1.0) {
    return 1.0;
  }
  const double front = std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) +
                                a * std::log(x) + b * std::log1p(-x));
  return x < (a + 1.0) / (a + b + 2.0) ? front * BetaFraction(a, b, x) / a
                                       : 1.0 - front * BetaFraction(b, a, 1.0 - x) / b;
}

RegistrationVariance ComputeRegistrationVariance(const CameraModel& camera,
                                                 const PoseEvidence& evidence) {
  if (evidence.covariance(6 + kFocal, 6 + kFocal) != 0.0) {
    return VarianceOf<kMostJoint>(camera, evidence);
  }
  // Without a motion, it does not matter how long the image was read.
  return evidence.shutter.motion.isZero(0.0) ? VarianceOf<6>(camera, evidence)
                                             : VarianceOf<6 + kShutterParameters>(camera, evidence);
}

// The sum of squares is approximated by a multiple of a chi-square distribution with h degrees of
// freedom and the same mean and variance (Satterthwaite, "An approximate distribution of estimates
// of variance components", Biometrics 1946). The covariance is itself an estimate, with fewer
// degrees of freedom the fewer inliers there are, so the quotient follows Fisher's F distribution.
double PoseConfidence(const CameraModel& camera, const PoseEvidence& evidence, double limit_px) {
  if (evidence.inliers < 4 || !evidence.covariance.allFinite()) {
    return 0.0;
  }
  const RegistrationVariance variance = ComputeRegistrationVariance(camera, evidence);
  const double sum = variance.sum;
  if (!(sum > 0.0)) {
    return 1.0;
  }
  const double h = sum * sum / variance.sum_of_squares;
  const double freedom = 2.0 * evidence.inliers - 6.0;
  const double f = limit_px * limit_px / sum;
  return RegularisedBeta(0.5 * h, 0.5 * freedom, h * f / (h * f + freedom));
}

}  // namespace lararium::vision
