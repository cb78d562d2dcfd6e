#include "shared/vision/camera_filter.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>

namespace lararium::vision {
namespace {

using geometry::CameraModel;

constexpr size_t kMostLenses = 4;

// Standard deviations of a camera that nothing is known of. Lengths in pixels are shares of the
// longer side of the image.
constexpr double kUnknownReadout = 0.5;
constexpr double kUnknownFocal = 0.7;
constexpr double kUnknownCentre = 0.01;
constexpr double kUnknownRadial = 0.1;

// Standard deviations of what changes in one frame time.
constexpr double kReadoutStep = 0.001;
constexpr double kFocalStep = 0.003;
constexpr double kCentreStep = 0.00005;
constexpr double kRadialStep = 0.0005;

// By how much a lens may differ when it is used again: autofocus has moved it since.
constexpr double kFocalAgain = 0.025;
constexpr double kCentreAgain = 0.002;
constexpr double kRadialAgain = 0.01;
// By how much it differs in a camera whose focus does not move.
constexpr double kFocalSame = 0.002;
constexpr double kCentreSame = 0.002;
constexpr double kRadialSame = 0.01;

// Whether the readout time is known well enough to take it for none.
bool ShutterIsGlobal(const CameraEstimate& camera) {
  constexpr double kLongest = 0.03;  // Frame times.
  constexpr double kUncertain = 0.015;
  return camera.readout.cwiseAbs().maxCoeff() < kLongest &&
         camera.covariance.diagonal().head<2>().maxCoeff() < kUncertain * kUncertain;
}

double LongerSide(const CameraModel& model) { return std::max(model.width, model.height); }

CameraMatrix Squares(double readout, double focal, double centre, double radial) {
  CameraVector deviations;
  deviations << readout, readout, 0.0, 0.0, 0.0, focal, centre, centre, radial, radial;
  return deviations.cwiseAbs2().asDiagonal();
}

// The covariance of what autofocus may have changed since a lens was in use.
CameraMatrix LensAgain(const CameraModel& model) {
  return Squares(0.0, kFocalAgain, kCentreAgain * LongerSide(model), kRadialAgain);
}

// The same where nothing has moved the lens.
CameraMatrix LensOfSame(const CameraModel& model) {
  return Squares(0.0, kFocalSame, kCentreSame * LongerSide(model), kRadialSame);
}

// The square of the difference of the five parameters of two lenses over its deviation, and its
// 99.9 % quantile for the same lens. since: the covariance of what may have changed.
constexpr double kSameLens = 20.5;
double LensDistance(const CameraEstimate& known,
                    const CameraMatrix& since,
                    const CameraEstimate& found) {
  constexpr int kLens = kCameraParameters - kShutterParameters;
  const Eigen::Matrix<double, kLens, 1> off = Difference(known, found).tail<kLens>();
  const Eigen::Matrix<double, kLens, kLens> covariance =
      (known.covariance + since + found.covariance).bottomRightCorner<kLens, kLens>();
  return off.dot(covariance.inverse() * off);
}

// The covariance after a change, which is at most that of what nothing is known of.
CameraMatrix Sum(const CameraMatrix& covariance,
                 const CameraMatrix& change,
                 const CameraMatrix& most) {
  CameraMatrix sum = covariance + change;
  for (int i = 0; i < kCameraParameters; ++i) {
    if (sum(i, i) > most(i, i)) {
      const double factor = most(i, i) > 0.0 ? std::sqrt(most(i, i) / sum(i, i)) : 0.0;
      sum.row(i) *= factor;
      sum.col(i) *= factor;
    }
  }
  return sum;
}

}  // namespace

CameraFilter::CameraFilter(const CameraModel& camera, bool known)
    : similar_(camera), told_(known), held_(known), now_(known ? Similar() : Unknown()) {}

CameraEstimate CameraFilter::Similar() const {
  CameraEstimate camera = ExactCamera(similar_);
  camera.covariance = Squares(kUnknownReadout, 0.0, 0.0, 0.0);
  return camera;
}

CameraEstimate CameraFilter::Unknown() const {
  CameraEstimate camera = ExactCamera(similar_);
  CameraModel& model = camera.model;
  model.fx = model.fy = similar_.Focal();
  model.cx = 0.5 * (model.width - 1);
  model.cy = 0.5 * (model.height - 1);
  model.k1 = model.k2 = model.p1 = model.p2 = 0.0;
  camera.covariance =
      Squares(kUnknownReadout, kUnknownFocal, kUnknownCentre * LongerSide(model), kUnknownRadial);
  return camera;
}

void CameraFilter::SetSize(int width, int height) {
  if (width == now_.model.width && height == now_.model.height) {
    return;
  }
  if (told_ && held_) {
    similar_ = similar_.Resized(width, height);
    now_.model = now_.model.Resized(width, height);
    return;
  }
  similar_ = similar_.GuessForImages(width, height);
  held_ = false;
  now_ = Unknown();
  lenses_.clear();
}

CameraEstimate CameraFilter::Predict(double frames) const {
  CameraEstimate predicted = now_;
  const CameraMatrix change =
      frames * (held_ ? Squares(kReadoutStep, 0.0, 0.0, 0.0)
                      : Squares(kReadoutStep, kFocalStep, kCentreStep * LongerSide(now_.model),
                                kRadialStep));
  const bool global =
      now_.covariance.topLeftCorner<kShutterParameters, kShutterParameters>().isZero(0.0);
  predicted.covariance = Sum(now_.covariance, change, (held_ ? Similar() : Unknown()).covariance);
  if (global) {
    predicted.covariance.topRows<kShutterParameters>().setZero();
    predicted.covariance.leftCols<kShutterParameters>().setZero();
  }
  return predicted;
}

CameraGuess CameraFilter::Guess() const {
  if (!MaySwitch()) {
    return {now_};
  }
  CameraGuess guess{Unknown()};
  guess.prior.readout = now_.readout;
  for (auto lens = lenses_.rbegin(); lens != lenses_.rend(); ++lens) {
    guess.candidates.push_back(lens->model);
  }
  guess.candidates.push_back(similar_);
  return guess;
}

CameraGuess CameraFilter::PresentGuess() const {
  return held_ ? CameraGuess{now_} : CameraGuess{Predict(1.0), {now_.model}};
}

void CameraFilter::Update(const CameraEstimate& estimate) {
  constexpr double kMostDeviations = 4.0;
  const CameraEstimate before = now_;
  now_ = estimate;
  now_.turning.setZero();
  now_.covariance.middleRows<3>(kTurnX).setZero();
  now_.covariance.middleCols<3>(kTurnX).setZero();
  const CameraVector off = Difference(before, estimate);
  for (const int i : {kReadoutX, kReadoutY}) {
    if (off[i] * off[i] > kMostDeviations * kMostDeviations * before.covariance(i, i)) {
      now_.readout[i] = before.readout[i];
      now_.covariance.row(i).setZero();
      now_.covariance.col(i).setZero();
      now_.covariance(i, i) = before.covariance(i, i);
    }
  }
  if (ShutterIsGlobal(now_)) {
    now_.readout.setZero();
    now_.covariance.topRows<kShutterParameters>().setZero();
    now_.covariance.leftCols<kShutterParameters>().setZero();
  }
  if (!lenses_.empty()) {
    lenses_.back() = now_;
  }
}

CameraEstimate CameraFilter::Doubted() const {
  CameraEstimate doubted = now_;
  doubted.covariance += LensAgain(now_.model);
  return doubted;
}

void CameraFilter::Contradict(const CameraEstimate& estimate) {
  constexpr int kEnough = 3;
  constexpr double kDeviations = 5.0;
  constexpr double kLeast = 0.003;  // Relative change of the focal length.
  const double off = std::abs(Difference(now_, estimate)[kFocal]);
  const bool contradicts =
      off > kLeast && off > kDeviations * std::sqrt(estimate.covariance(kFocal, kFocal));
  contradictions_ = contradicts ? contradictions_ + 1 : 0;
  if (contradictions_ == kEnough) {
    held_ = false;
    refuted_ = true;
    lenses_ = {now_};
    Update(estimate);
  }
}

void CameraFilter::Found(const CameraEstimate& found) {
  if (!MaySwitch()) {
    return;  // A single image does not show the readout time.
  }
  if (!refuted_ && LensDistance(Similar(), LensOfSame(similar_), found) < kSameLens) {
    const CameraEstimate before = now_;
    now_ = Similar();
    if (held_) {
      now_.readout = before.readout;
      now_.covariance = before.covariance;
    }
    held_ = true;
    contradictions_ = 0;
    return;
  }
  held_ = false;
  std::optional<size_t> same;
  double least = kSameLens;
  const CameraMatrix since = LensAgain(found.model);
  for (size_t i = 0; i < lenses_.size(); ++i) {
    const double square = LensDistance(lenses_[i], since, found);
    if (square < least) {
      least = square;
      same = i;
    }
  }
  CameraEstimate lens = found;
  // A single image tells nothing of the shutter, and another lens may have another sensor.
  CameraEstimate shutter = Unknown();
  shutter.readout = now_.readout;
  if (same) {
    // The two estimates are joined, each weighed by its information.
    shutter = lenses_[*same];
    CameraEstimate known = shutter;
    known.covariance += since;
    const CameraMatrix of_known = Information(known);
    const CameraMatrix of_found = Information(found);
    lens.covariance = (of_known + of_found).inverse();
    const CameraVector off = lens.covariance * (of_found * Difference(known, found));
    lens.model = Changed(known, off).model;
    lenses_.erase(lenses_.begin() + static_cast<std::ptrdiff_t>(*same));
  } else if (lenses_.size() == kMostLenses) {
    lenses_.erase(lenses_.begin());
  }
  lens.readout = shutter.readout;
  lens.covariance.topRows<kShutterParameters>().setZero();
  lens.covariance.leftCols<kShutterParameters>().setZero();
  lens.covariance.topLeftCorner<kShutterParameters, kShutterParameters>() =
      shutter.covariance.topLeftCorner<kShutterParameters, kShutterParameters>();
  lenses_.push_back(lens);
  now_ = lens;
}

}  // namespace lararium::vision
