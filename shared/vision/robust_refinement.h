#pragma once

// The robust minimisation that refines a pose, with or without the camera's intrinsics. Private to
// vision.
//
// A Problem has a State; kSize, the number of its degrees of freedom; Moved(state, step);
// Residual(), the residual of a match in pixels over its sigma_px; and a quadratic prior:
// PriorCost(state) and AddPrior(state, weight, matrix, right).

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "shared/vision/pose_refinement.h"

namespace lararium::vision {

template <typename Problem>
class RobustRefinement {
 public:
  static constexpr int kSize = Problem::kSize;
  using State = typename Problem::State;
  using Vector = Eigen::Matrix<double, kSize, 1>;
  using Matrix = Eigen::Matrix<double, kSize, kSize>;

  // squares is working memory.
  RobustRefinement(const Problem& problem,
                   std::span<const PoseMatch> matches,
                   double inlier_threshold_px,
                   std::vector<double>& squares)
      : problem_(problem),
        matches_(matches),
        threshold_px_(inlier_threshold_px),
        squares_(squares) {}

  // Moves the state to the minimum. information: the inverse covariance of the state by the matches
  // alone, for a noise of one pixel. With fewer than least_inliers inliers, noise_px and
  // information are zero.
  void Run(size_t least_inliers,
           State& state,
           std::vector<uint32_t>& inliers,
           double& noise_px,
           Matrix& information) {
    // The first state carries the noise of only a few matches, so the threshold starts wide and
    // then narrows.
    constexpr std::array<double, 3> kWidening = {4.0, 1.5, 1.0};
    constexpr double kLeastNoise = 1e-9;    // Pixels; avoids zero for exact input.
    constexpr double kCauchyScale = 2.385;  // 95 % efficiency for normal noise.
    double scale = threshold_px_;
    noise_px = 0.0;
    information.setZero();
    for (const double widening : kWidening) {
      SelectInliers(state, widening * threshold_px_, inliers);
      if (inliers.size() < least_inliers) {
        break;
      }
      Minimise(inliers, scale, std::pow(scale / kCauchyScale, 2), state);
      noise_px = std::max(NoiseOf(state, inliers), kLeastNoise);
      scale = std::min(kCauchyScale * noise_px, threshold_px_);
    }
    SelectInliers(state, threshold_px_, inliers);
    if (inliers.size() < least_inliers) {
      noise_px = 0.0;
      return;
    }
    Vector ignored;
    Linearise(state, inliers, scale * scale, 0.0, information, ignored);
  }

 private:
  // Cauchy's loss with scale c of a square s: c^2 / 2 log(1 + s / c^2), and twice its derivative by
  // s.
  static double Loss(double square, double c2) { return 0.5 * c2 * std::log1p(square / c2); }
  static double Weight(double square, double c2) { return 1.0 / (1.0 + square / c2); }

  // Squared residual over sigma_px; infinite behind the camera.
  double Square(const State& state, uint32_t i) const {
    Eigen::Vector2d residual;
    return problem_.Residual(state, matches_[i], residual, nullptr)
               ? residual.squaredNorm()
               : std::numeric_limits<double>::infinity();
  }

  double TotalLoss(const State& state,
                   std::span<const uint32_t> chosen,
                   double c2,
                   double prior) const {
    double sum = prior * problem_.PriorCost(state);
    for (const uint32_t i : chosen) {
      sum += Loss(Square(state, i), c2);
    }
    return sum;
  }

  void Linearise(const State& state,
                 std::span<const uint32_t> chosen,
                 double c2,
                 double prior,
                 Matrix& matrix,
                 Vector& right) const {
    matrix.setZero();
    right.setZero();
    for (const uint32_t i : chosen) {
      Eigen::Vector2d residual;
      Eigen::Matrix<double, 2, kSize> jacobian;
      if (!problem_.Residual(state, matches_[i], residual, &jacobian)) {
        continue;
      }
      const double weight = Weight(residual.squaredNorm(), c2);
      matrix.noalias() += weight * jacobian.transpose() * jacobian;
      right.noalias() -= weight * jacobian.transpose() * residual;
    }
    problem_.AddPrior(state, prior, matrix, right);
  }

  // Minimises the loss by the Levenberg-Marquardt method.
  void Minimise(std::span<const uint32_t> chosen, double scale, double prior, State& state) const {
    constexpr int kMaxIterations = 20;
    const double c2 = scale * scale;
    double damping = 1e-4;
    double loss = TotalLoss(state, chosen, c2, prior);
    for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
      Matrix matrix;
      Vector right;
      Linearise(state, chosen, c2, prior, matrix, right);
      matrix.diagonal() *= 1.0 + damping;
      const Vector step = matrix.ldlt().solve(right);
      if (!step.allFinite()) {
        break;
      }
      const State moved = problem_.Moved(state, step);
      const double moved_loss = TotalLoss(moved, chosen, c2, prior);
      if (moved_loss < loss) {
        const bool converged = loss - moved_loss < 1e-9 * loss;
        state = moved;
        loss = moved_loss;
        damping = std::max(damping * 0.1, 1e-9);
        if (converged) {
          break;
        }
      } else {
        damping *= 10.0;
        if (damping > 1e6) {
          break;
        }
      }
    }
  }

  // Selects the matches whose residual is below threshold_px * min(sigma_px, kMostSigma), so that
  // uncertain matches get no more than kMostSigma times the threshold.
  void SelectInliers(const State& state,
                     double threshold_px,
                     std::vector<uint32_t>& inliers) const {
    constexpr double kMostSigma = 2.0;
    inliers.clear();
    for (uint32_t i = 0; i < matches_.size(); ++i) {
      const double limit = threshold_px * std::min(1.0, kMostSigma / matches_[i].sigma_px);
      if (Square(state, i) < limit * limit) {
        inliers.push_back(i);
      }
    }
  }

  // Standard deviation along one axis from the median distance, which is 1.1774 sigma for a
  // two-dimensional normal distribution.
  double NoiseOf(const State& state, std::span<const uint32_t> chosen) const {
    squares_.clear();
    for (const uint32_t i : chosen) {
      squares_.push_back(Square(state, i));
    }
    const auto middle = squares_.begin() + static_cast<std::ptrdiff_t>(squares_.size() / 2);
    std::nth_element(squares_.begin(), middle, squares_.end());
    return std::sqrt(*middle) / 1.1774;
  }

  const Problem& problem_;
  std::span<const PoseMatch> matches_;
  double threshold_px_;
  std::vector<double>& squares_;
};

}  // namespace lararium::vision
