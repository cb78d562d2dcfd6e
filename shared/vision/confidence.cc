#include "shared/vision/confidence.h"

#include <Eigen/Eigenvalues>
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

// The mean of J' J over the image and the depths, in square pixels, where J is the derivative of a
// point's projection by (w, v) and the camera's parameters.
template <int N>
JointMatrix<N> MeanSquareOfMotion(const CameraModel& model, const std::array<double, 3>& depths) {
  constexpr int kColumns = 5;
  constexpr int kRows = 4;
  JointMatrix<N> sum = JointMatrix<N>::Zero();
  const CameraEstimate camera = ExactCamera(model);
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const Eigen::Vector2d pixel((column + 0.5) * model.width / kColumns - 0.5,
                                  (row + 0.5) * model.height / kRows - 0.5);
      const Eigen::Vector2d plane = model.PlaneFromPixel(pixel);
      for (const double depth : depths) {
        Eigen::Vector2d residual;
        Eigen::Matrix<double, 2, N> jacobian;
        if (PixelResidual<N>(camera, depth * plane.homogeneous(), nullptr, pixel, residual,
                             &jacobian)) {
          sum.noalias() += jacobian.transpose() * jacobian;
        }
      }
    }
  }
  return sum / (kColumns * kRows * static_cast<double>(depths.size()));
}

// The squared error is d' M d, where d has the covariance. In axes in which the covariance becomes
// the identity and M is diagonal, it is a sum of squares.
template <int N>
RegistrationVariance VarianceOf(const CameraModel& camera, const PoseEvidence& evidence) {
  const Eigen::SelfAdjointEigenSolver<BoundedMatrix> covariance(
      evidence.covariance.topLeftCorner<N, N>());
  const JointMatrix<N> root =
      covariance.eigenvectors() *
      covariance.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal().toDenseMatrix();
  const JointMatrix<N> turned =
      root.transpose() * MeanSquareOfMotion<N>(camera, evidence.depths) * root;
  const Eigen::SelfAdjointEigenSolver<BoundedMatrix> parts(turned, Eigen::EigenvaluesOnly);
  RegistrationVariance variance;
  for (int i = 0; i < N; ++i) {
    variance.parts[i] = std::max(parts.eigenvalues()[N - 1 - i], 0.0);
  }
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

double RegistrationVariance::Sum() const {
  double sum = 0.0;
  for (const double part : parts) {
    sum += part;
  }
  return sum;
}

RegistrationVariance ComputeRegistrationVariance(const CameraModel& camera,
                                                 const PoseEvidence& evidence) {
  // A readout time does not move the middle of the image, to which the pose belongs.
  return evidence.covariance(6 + kFocal, 6 + kFocal) == 0.0
             ? VarianceOf<6>(camera, evidence)
             : VarianceOf<kMostJoint>(camera, evidence);
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
  const double sum = variance.Sum();
  if (!(sum > 0.0)) {
    return 1.0;
  }
  double squares = 0.0;
  for (const double part : variance.parts) {
    squares += part * part;
  }
  const double h = sum * sum / squares;
  const double freedom = 2.0 * evidence.inliers - 6.0;
  const double f = limit_px * limit_px / sum;
  return RegularisedBeta(0.5 * h, 0.5 * freedom, h * f / (h * f + freedom));
}

}  // namespace lararium::vision
