#include "editor/train/chessboard_calibration.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

namespace lararium::train {
namespace {

using Corners = std::vector<Eigen::Vector2d>;
using LensKind = CalibrationAdvice::Kind;

constexpr int kEnoughViews = 20;  // Fewer fitted views lead to the advice to film more.
constexpr int kHoldOutEvery = 5;  // Every fifth view is held out.
constexpr int64_t kImagesOfRecording = 240;
constexpr int kSearchWidth = 800;          // Longer side of the image that is searched, pixels.
constexpr double kImpossibleFocal = 0.05;  // Relative standard deviation of the focal length.
constexpr double kFrontalTilt = 0.17;      // A smaller maximum tilt cannot be calibrated, radians.
constexpr double kPoorFocal = 0.02;
constexpr double kGoodFocal = 0.005;
constexpr double kGoodCover = 0.6;
constexpr double kPoorCover = 0.3;

cv::Size SizeOf(const Board& board) { return {board.columns, board.rows}; }

std::vector<cv::Point2f> ToCv(std::span<const Eigen::Vector2d> corners) {
  std::vector<cv::Point2f> points;
  for (const Eigen::Vector2d& corner : corners) {
    points.emplace_back(static_cast<float>(corner.x()), static_cast<float>(corner.y()));
  }
  return points;
}

// The shortest distance between neighbouring corners.
double Spacing(std::span<const cv::Point2f> corners, const Board& board) {
  double shortest = std::numeric_limits<double>::max();
  const auto columns = static_cast<size_t>(board.columns);
  for (size_t i = 0; i < corners.size(); ++i) {
    if ((i + 1) % columns != 0) {
      shortest = std::min(shortest, cv::norm(corners[i + 1] - corners[i]));
    }
    if (i + columns < corners.size()) {
      shortest = std::min(shortest, cv::norm(corners[i + columns] - corners[i]));
    }
  }
  return shortest;
}

// Converts positions from an image that was reduced by scale to the original image.
void Enlarge(std::vector<cv::Point2f>& corners, double scale) {
  for (cv::Point2f& corner : corners) {
    corner.x = static_cast<float>((corner.x + 0.5) / scale - 0.5);
    corner.y = static_cast<float>((corner.y + 0.5) / scale - 0.5);
  }
}

cv::Mat Reduced(const cv::Mat& grey, double& scale) {
  scale = std::min(1.0, static_cast<double>(kSearchWidth) / std::max(grey.cols, grey.rows));
  if (scale == 1.0) {
    return grey;
  }
  cv::Mat reduced;
  cv::resize(grey, reduced, cv::Size(), scale, scale, cv::INTER_AREA);
  scale = static_cast<double>(reduced.cols) / grey.cols;
  return reduced;
}

// Finds the board by OpenCV's sector-based detector, which is robust to noise and blur, and refines
// the corners by the surrounding gradients. Together they have half the error of either one alone.
std::optional<std::vector<cv::Point2f>> SearchBoard(const cv::Mat& grey, const Board& board) {
  // Half the refinement window as a share of the spacing; no other corner lies within.
  constexpr double kWindow = 0.42;
  constexpr double kNearest = 5.0;  // Minimum spacing of the corners, pixels.
  double scale = 1.0;
  const cv::Mat reduced = Reduced(grey, scale);
  std::vector<cv::Point2f> corners;
  if (!cv::findChessboardCornersSB(reduced, SizeOf(board), corners, cv::CALIB_CB_NORMALIZE_IMAGE) ||
      corners.size() != board.corners()) {
    return std::nullopt;
  }
  Enlarge(corners, scale);
  const double spacing = Spacing(corners, board);
  if (spacing < kNearest) {
    return std::nullopt;
  }
  cv::Mat smooth;
  cv::GaussianBlur(grey, smooth, cv::Size(), 1.0);
  const int half = std::max(2, static_cast<int>(kWindow * spacing));
  cv::cornerSubPix(smooth, corners, cv::Size(half, half), cv::Size(-1, -1),
                   cv::TermCriteria(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 40, 1e-3));
  return corners;
}

// Width of the edges between squares, in the less sharp of the board's two directions, pixels.
double BlurOf(const cv::Mat& grey, const Board& board, std::span<const Eigen::Vector2d> corners) {
  constexpr float kRise = 0.8f;
  const std::vector<cv::Point2f> points = ToCv(corners);
  double blur = 0.0;
  for (const bool vertical : {false, true}) {
    blur = std::max(
        blur, cv::estimateChessboardSharpness(grey, SizeOf(board), points, kRise, vertical)[0]);
  }
  return blur;
}

double Square(double value) { return value * value; }

}  // namespace

Status Board::Validate() const {
  for (const int side : {columns, rows}) {
    if (side < kFewest || side > kMost) {
      return Status::Error(Text(),
                           "a side must have " + std::to_string(kFewest) + " to " +
                               std::to_string(kMost) + " inner corners",
                           "count where four squares meet: a board of 10 x 7 squares has 9x6");
    }
  }
  if (!std::isfinite(square) || square < 0.0 || square > 10.0) {
    return Status::Error(Text(), "squares must be at most 10 m wide",
                         "give the width in metres, for example 0.025");
  }
  return Status();
}

std::string Board::Text() const {
  return "board " + std::to_string(columns) + "x" + std::to_string(rows);
}

std::optional<Corners> FindBoard(const cv::Mat& grey, const Board& board) {
  try {
    const auto found = SearchBoard(grey, board);
    if (!found) {
      return std::nullopt;
    }
    Corners corners;
    for (const cv::Point2f& corner : *found) {
      corners.emplace_back(corner.x, corner.y);
    }
    return corners;
  } catch (const cv::Exception&) {
    return std::nullopt;  // The image is too small for this board.
  }
}

void CornerGrid::Add(std::span<const Eigen::Vector2d> corners, int width, int height) {
  for (const Eigen::Vector2d& corner : corners) {
    const int column = static_cast<int>((corner.x() + 0.5) * kColumns / width);
    const int row = static_cast<int>((corner.y() + 0.5) * kRows / height);
    ++counts[static_cast<size_t>(std::clamp(row, 0, kRows - 1))]
            [static_cast<size_t>(std::clamp(column, 0, kColumns - 1))];
  }
}

double CornerGrid::Covered() const {
  int seen = 0;
  for (const auto& row : counts) {
    seen += static_cast<int>(std::count_if(row.begin(), row.end(), [](int n) { return n > 0; }));
  }
  return static_cast<double>(seen) / (kColumns * kRows);
}

BoardCollector::BoardCollector(const Board& board, int width, int height)
    : board_(board), width_(width), height_(height) {}

// Lengths are shares of the image size. The weights make a distance of kSpacing a visible
// difference.
BoardCollector::Pose BoardCollector::PoseOf(std::span<const Eigen::Vector2d> corners) const {
  constexpr double kOfSize = 0.5;  // Weight of a doubling of the size.
  constexpr double kOfTilt =
      4.0;  // Weight of the relative difference in distance across the board.
  constexpr double kOfRoll = 0.15;
  std::vector<cv::Point2f> on_board;
  for (int row = 0; row < board_.rows; ++row) {
    for (int column = 0; column < board_.columns; ++column) {
      on_board.emplace_back(
          2.0f * static_cast<float>(column) / static_cast<float>(board_.columns - 1) - 1.0f,
          2.0f * static_cast<float>(row) / static_cast<float>(board_.rows - 1) - 1.0f);
    }
  }
  const cv::Mat h = cv::findHomography(on_board, ToCv(corners));
  Pose pose = Pose::Zero();
  if (h.empty()) {
    return pose;
  }
  const auto at = [&](int i, int j) { return h.at<double>(i, j); };
  const Eigen::Vector2d middle(at(0, 2), at(1, 2));
  const Eigen::Vector2d foreshortening(at(2, 0), at(2, 1));
  const Eigen::Vector2d along(at(0, 0) - middle.x() * at(2, 0), at(1, 0) - middle.y() * at(2, 0));
  const Eigen::Vector2d down(at(0, 1) - middle.x() * at(2, 1), at(1, 1) - middle.y() * at(2, 1));
  const Eigen::Vector2d tilt =
      foreshortening.x() * along.normalized() + foreshortening.y() * down.normalized();
  const double area = std::abs(along.x() * down.y() - along.y() * down.x());
  const double roll = std::atan2(along.y(), along.x());
  pose << middle.x() / width_, middle.y() / height_,
      kOfSize * 0.5 * std::log2(std::max(area, 1.0) / (width_ * height_)), kOfTilt * tilt,
      kOfRoll * std::sin(2.0 * roll);
  return pose;
}

// Largest blur of a sharp view, relative to the sharpest quarter of all views.
double BoardCollector::SharpLimit() const {
  constexpr size_t kEnough = 8;
  constexpr double kSharpPx = 3.0;
  constexpr double kOver = 1.5;
  if (blurs_.size() < kEnough) {
    return std::numeric_limits<double>::max();
  }
  std::vector<double> sorted = blurs_;
  const auto quarter = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 4);
  std::nth_element(sorted.begin(), quarter, sorted.end());
  return std::max(kSharpPx, kOver * *quarter);
}

void BoardCollector::LookForOthers(const cv::Mat& grey) {
  constexpr int kEvery = 10;  // images
  if (!blurs_.empty() || other_ || images_ % kEvery != 1) {
    return;
  }
  double scale = 1.0;
  const cv::Mat reduced = Reduced(grey, scale);
  for (const auto& [columns, rows] : {std::pair{-1, -1}, std::pair{1, 1}, std::pair{-1, 0},
                                      std::pair{0, -1}, std::pair{1, 0}, std::pair{0, 1}}) {
    const Board other{board_.columns + columns, board_.rows + rows, board_.square};
    if (other.Validate().ok() && FindBoard(reduced, other)) {
      other_ = other;
      return;
    }
  }
}

// Removes the less sharp one of the two most similar views.
void BoardCollector::MakeRoom() {
  size_t gone = 0;
  double nearest = std::numeric_limits<double>::max();
  for (size_t i = 0; i < views_.size(); ++i) {
    for (size_t j = i + 1; j < views_.size(); ++j) {
      const double distance = (views_[i].pose - views_[j].pose).norm();
      if (distance < nearest) {
        nearest = distance;
        gone = views_[i].view.blur_px > views_[j].view.blur_px ? i : j;
      }
    }
  }
  views_.erase(views_.begin() + static_cast<std::ptrdiff_t>(gone));
}

BoardObservation BoardCollector::Add(const geometry::Frame& frame, const std::string& name) {
  std::optional<Corners> corners = FindBoard(frame.grey, board_);
  if (!corners) {
    ++images_;
    corners_.clear();
    LookForOthers(frame.grey);
    return BoardObservation::kNone;
  }
  const double blur = BlurOf(frame.grey, board_, *corners);
  return AddView({name, frame.index, blur, *std::move(corners)});
}

BoardObservation BoardCollector::AddView(BoardView view) {
  constexpr double kSpacing = 0.12;
  ++images_;
  corners_ = view.corners;
  blurs_.push_back(view.blur_px);
  if (view.blur_px > SharpLimit()) {
    return BoardObservation::kBlurred;
  }
  Entry entry{std::move(view), PoseOf(corners_)};
  const auto distance = [&](const Entry& other) { return (other.pose - entry.pose).norm(); };
  const auto alike =
      std::min_element(views_.begin(), views_.end(),
                       [&](const Entry& a, const Entry& b) { return distance(a) < distance(b); });
  if (alike != views_.end() && distance(*alike) < kSpacing) {
    if (entry.view.blur_px < alike->view.blur_px) {
      *alike = std::move(entry);
    }
    return BoardObservation::kAlike;
  }
  grid_.Add(corners_, width_, height_);
  views_.push_back(std::move(entry));
  if (views_.size() > 2 * kMostViews) {
    MakeRoom();
  }
  return BoardObservation::kKept;
}

BoardCounts BoardCollector::counts() const {
  const double limit = SharpLimit();
  return {images_, static_cast<int>(blurs_.size()),
          static_cast<int>(std::count_if(blurs_.begin(), blurs_.end(),
                                         [&](double blur) { return blur > limit; }))};
}

std::vector<BoardView> BoardCollector::Chosen() const {
  BoardCollector few = *this;
  const double limit = SharpLimit();
  std::erase_if(few.views_, [&](const Entry& entry) { return entry.view.blur_px > limit; });
  while (few.views_.size() > kMostViews) {
    few.MakeRoom();
  }
  std::vector<BoardView> views;
  for (Entry& entry : few.views_) {
    views.push_back(std::move(entry.view));
  }
  std::sort(views.begin(), views.end(),
            [](const BoardView& a, const BoardView& b) { return a.frame < b.frame; });
  return views;
}

namespace {

// Input and output of cv::calibrateCamera.
struct Fit {
  cv::Mat camera;
  cv::Mat distortion;
  cv::Mat deviations;
  cv::Mat view_errors;
  std::vector<cv::Mat> rotations;
  std::vector<cv::Mat> translations;
  double rms = 0.0;
};

class Calibrator {
 public:
  Calibrator(const BoardCollector& collector, Progress& progress)
      : board_(collector.board()),
        size_(collector.width(), collector.height()),
        collector_(collector),
        progress_(progress) {
    const double square = board_.square > 0.0 ? board_.square : 1.0;
    for (int row = 0; row < board_.rows; ++row) {
      for (int column = 0; column < board_.columns; ++column) {
        points_.emplace_back(static_cast<float>(column * square), static_cast<float>(row * square),
                             0.0f);
      }
    }
  }

  Result<Calibration> Run() {
    LARARIUM_RETURN_IF_ERROR(CheckViews());
    const std::vector<BoardView> chosen = collector_.Chosen();
    for (size_t i = 0; i < chosen.size(); ++i) {
      const bool out = i % kHoldOutEvery == kHoldOutEvery - 1;
      result_.views.push_back(
          {chosen[i], out ? CalibratedView::Part::kHeldOut : CalibratedView::Part::kFitted});
    }
    LARARIUM_ASSIGN_OR_RETURN(Fit fit, FitWithoutOutliers());
    TakeCamera(fit);
    LARARIUM_RETURN_IF_ERROR(TakeDeviation(fit));
    TakeViews(fit);
    LARARIUM_RETURN_IF_ERROR(CheckCamera());
    HoldOut();
    Judge();
    return std::move(result_);
  }

 private:
  using Part = CalibratedView::Part;

  Status Problem(const std::string& problem, const std::string& remedy) const {
    return Status::Error(board_.Text(), problem, remedy);
  }

  Status CheckViews() {
    result_.counts = collector_.counts();
    const BoardCounts& counts = result_.counts;
    if (counts.found == 0) {
      const std::optional<Board> other = collector_.OtherBoard();
      const std::string none = "was found in none of " + std::to_string(counts.images) + " images";
      return other ? Problem(none + ", but a " + other->Text() + " was", "give this size")
                   : Problem(none,
                             "count inner corners, where four squares meet (10 x 7 squares have "
                             "9x6), light the board evenly, and keep all of it with its white "
                             "border in the image");
    }
    const size_t differ = collector_.Chosen().size();
    if (differ >= kFewestViews) {
      return Status();
    }
    const std::string seen = "was seen in " + std::to_string(counts.found) + " of " +
                             std::to_string(counts.images) + " images";
    if (2 * counts.blurred > counts.found) {
      return Problem(seen + ", of which " + std::to_string(counts.blurred) + " are blurred",
                     "move the board more slowly and hold it still now and then, in more light");
    }
    const std::string few = differ == 1 ? ", but always in one place"
                                        : ", but in only " + std::to_string(differ) + " ways";
    return Problem(seen + few + "; " + std::to_string(kFewestViews) + " that differ are needed",
                   "hold the board in all parts of the image, near and far, and tilt it");
  }

  std::vector<size_t> Indices(Part part) const {
    std::vector<size_t> indices;
    for (size_t i = 0; i < result_.views.size(); ++i) {
      if (result_.views[i].part == part) {
        indices.push_back(i);
      }
    }
    return indices;
  }

  // start holds initial intrinsics; with nullptr they are estimated from the views.
  Result<Fit> FitViews(std::span<const size_t> indices, const Fit* start) const {
    std::vector<std::vector<cv::Point3f>> points(indices.size(), points_);
    std::vector<std::vector<cv::Point2f>> corners;
    for (const size_t i : indices) {
      corners.push_back(ToCv(result_.views[i].view.corners));
    }
    Fit fit;
    int flags = cv::CALIB_FIX_K3;
    if (start != nullptr) {
      flags |= cv::CALIB_USE_INTRINSIC_GUESS;
      fit.camera = start->camera.clone();
      fit.distortion = start->distortion.clone();
    }
    try {
      fit.rms = cv::calibrateCamera(points, corners, size_, fit.camera, fit.distortion,
                                    fit.rotations, fit.translations, fit.deviations, cv::noArray(),
                                    fit.view_errors, flags);
    } catch (const cv::Exception&) {
      return NoAngle("");
    }
    return fit;
  }

  Status NoAngle(const std::string& how) const {
    return Problem(
        "the focal length cannot be determined: the board was held at nearly one angle" + how,
        "tilt it by 20 to 40 degrees to all sides, near the camera");
  }

  // Views with far larger errors than the others show another board or were blurred by motion. They
  // are removed until none is left.
  Result<Fit> FitWithoutOutliers() {
    constexpr int kRounds = 4;
    constexpr double kOver = 3.0;   // Limit of an outlier, relative to the median error.
    constexpr double kLeast = 0.3;  // Errors below this are never outliers, pixels.
    for (int round = 0;; ++round) {
      LARARIUM_RETURN_IF_ERROR(Step(0.15 * round));
      const std::vector<size_t> fitted = Indices(Part::kFitted);
      LARARIUM_ASSIGN_OR_RETURN(Fit fit, FitViews(fitted, nullptr));
      std::vector<double> errors(fit.view_errors.begin<double>(), fit.view_errors.end<double>());
      std::vector<double> sorted = errors;
      std::nth_element(sorted.begin(),
                       sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2),
                       sorted.end());
      limit_ = std::max(kLeast, kOver * sorted[sorted.size() / 2]);
      size_t worse = 0;
      for (size_t i = 0; i < fitted.size(); ++i) {
        if (errors[i] > limit_) {
          result_.views[fitted[i]].part = Part::kRejected;
          result_.views[fitted[i]].rms_px = errors[i];
          ++worse;
        }
      }
      if (worse == 0 || round == kRounds) {
        return fit;
      }
      if (fitted.size() - worse < kFewestViews - 2) {
        return Problem("the views contradict one another: " +
                           std::to_string(result_.views.size() - fitted.size() + worse) + " of " +
                           std::to_string(result_.views.size()) + " fit none of the others",
                       "lay the board on something flat and stiff, and keep focus and zoom fixed");
      }
    }
  }

  Status Step(double fraction) const {
    progress_.Report("calibrating", fraction);
    return progress_.Cancelled() ? Status::Error("calibration", "cancelled") : Status();
  }

  static geometry::CameraModel CameraOf(const Fit& fit, const cv::Size& size) {
    const auto k = [&](int i, int j) { return fit.camera.at<double>(i, j); };
    const double* d = fit.distortion.ptr<double>();
    return {size.width, size.height, k(0, 0), k(1, 1), k(0, 2), k(1, 2), d[0], d[1], d[2], d[3]};
  }

  static std::array<double, 8> NumbersOf(const geometry::CameraModel& c) {
    return {c.fx, c.fy, c.cx, c.cy, c.k1, c.k2, c.p1, c.p2};
  }

  void TakeCamera(const Fit& fit) {
    result_.camera = CameraOf(fit, size_);
    result_.rms_px = fit.rms;
  }

  // Grouped jackknife: Shao & Tu, "The Jackknife and Bootstrap", 1995.
  Status TakeDeviation(const Fit& fit) {
    const std::vector<size_t> fitted = Indices(Part::kFitted);
    constexpr size_t kGroups = 5;
    std::array<std::array<double, 8>, kGroups> parts;
    std::array<double, 8> mean = {};
    for (size_t group = 0; group < kGroups; ++group) {
      LARARIUM_RETURN_IF_ERROR(Step(0.5 + 0.1 * static_cast<double>(group)));
      std::vector<size_t> others;
      for (size_t i = 0; i < fitted.size(); ++i) {
        if (i % kGroups != group) {
          others.push_back(fitted[i]);
        }
      }
      LARARIUM_ASSIGN_OR_RETURN(const Fit part, FitViews(others, &fit));
      parts[group] = NumbersOf(CameraOf(part, size_));
      for (size_t p = 0; p < mean.size(); ++p) {
        mean[p] += parts[group][p] / kGroups;
      }
    }
    std::array<double, 8> deviation;
    for (size_t p = 0; p < mean.size(); ++p) {
      double squares = 0.0;
      for (const auto& part : parts) {
        squares += Square(part[p] - mean[p]);
      }
      deviation[p] = std::max(std::sqrt(squares * (kGroups - 1.0) / kGroups),
                              fit.deviations.at<double>(static_cast<int>(p)));
    }
    const auto& [fx, fy, cx, cy, k1, k2, p1, p2] = deviation;
    result_.deviation = {fx, fy, cx, cy, k1, k2, p1, p2};
    return Status();
  }

  void TakeViews(const Fit& fit) {
    const std::vector<size_t> fitted = Indices(Part::kFitted);
    for (size_t i = 0; i < fitted.size(); ++i) {
      CalibratedView& view = result_.views[fitted[i]];
      view.rms_px = fit.view_errors.at<double>(static_cast<int>(i));
      SetPose(fit.rotations[i], fit.translations[i], view);
      result_.grid.Add(view.view.corners, size_.width, size_.height);
      result_.max_tilt = std::max(result_.max_tilt, view.tilt);
    }
    result_.fitted = static_cast<int>(fitted.size());
    result_.rejected = static_cast<int>(Indices(Part::kRejected).size());
    result_.covered = result_.grid.Covered();
  }

  void SetPose(const cv::Mat& rotation, const cv::Mat& translation, CalibratedView& view) const {
    cv::Matx33d turned;
    cv::Rodrigues(rotation, turned);
    const cv::Vec3d origin(translation.ptr<double>());
    const cv::Point3f& last = points_.back();
    const cv::Vec3d middle = origin + turned * cv::Vec3d(0.5 * last.x, 0.5 * last.y, 0.0);
    view.tilt = std::acos(std::min(1.0, std::abs(turned(2, 2))));
    view.distance = cv::norm(middle);
  }

  Status CheckCamera() const {
    const double deviation = result_.FocalDeviation();
    if (!std::isfinite(deviation) || deviation > kImpossibleFocal ||
        result_.max_tilt < kFrontalTilt) {
      const int percent = static_cast<int>(std::lround(100.0 * std::min(9.99, deviation)));
      return NoAngle(std::isfinite(deviation) ? " (+- " + std::to_string(percent) + " %)" : "");
    }
    if (const Status status = result_.camera.Validate(); !status.ok()) {
      return Problem("the views do not give a valid camera (" + status.message() + ")",
                     "hold the board in all parts of the image, in its corners too, and tilt it");
    }
    return Status();
  }

  // Evaluates the held-out views: the pose comes from the view itself, the intrinsics from the
  // fitted views.
  void HoldOut() {
    const geometry::CameraModel& c = result_.camera;
    const cv::Matx33d matrix(c.fx, 0.0, c.cx, 0.0, c.fy, c.cy, 0.0, 0.0, 1.0);
    const cv::Vec4d distortion(c.k1, c.k2, c.p1, c.p2);
    constexpr double kOther = 5.0;  // Beyond this multiple of limit_, the view shows another board.
    double squares = 0.0;
    for (const size_t i : Indices(Part::kHeldOut)) {
      CalibratedView& view = result_.views[i];
      const std::vector<cv::Point2f> corners = ToCv(view.view.corners);
      cv::Mat rotation;
      cv::Mat translation;
      std::vector<cv::Point2f> projected;
      try {
        cv::solvePnP(points_, corners, matrix, distortion, rotation, translation);
        cv::projectPoints(points_, rotation, translation, matrix, distortion, projected);
      } catch (const cv::Exception&) {
        view.part = Part::kRejected;
        ++result_.rejected;
        continue;
      }
      const double error =
          Square(cv::norm(corners, projected)) / static_cast<double>(corners.size());
      view.rms_px = std::sqrt(error);
      SetPose(rotation, translation, view);
      if (view.rms_px > kOther * limit_) {
        view.part = Part::kRejected;
        ++result_.rejected;
        continue;
      }
      squares += error;
      ++result_.held_out;
    }
    result_.held_out_rms_px = result_.held_out > 0 ? std::sqrt(squares / result_.held_out) : 0.0;
  }

  void Advise(LensKind kind, double value) { result_.advice.push_back({kind, value}); }

  // Begins with the corners of the image, where distortion is strongest.
  void AdviseOnParts() {
    constexpr int kHardly = 2;  // Number of cells up to which a part counts as not covered.
    constexpr int kWide = CornerGrid::kColumns / 3;
    constexpr int kHigh = CornerGrid::kRows / 3;
    for (const int part : {0, 2, 6, 8, 1, 3, 5, 7, 4}) {
      int seen = 0;
      for (int row = 0; row < kHigh; ++row) {
        for (int column = 0; column < kWide; ++column) {
          seen += result_.grid.counts[static_cast<size_t>(part / 3 * kHigh + row)]
                                     [static_cast<size_t>(part % 3 * kWide + column)] > 0
                      ? 1
                      : 0;
        }
      }
      if (seen <= kHardly) {
        Advise(LensKind::kPart, part);
      }
    }
  }

  void Judge() {
    // An error that is acceptable even for compressed video with motion.
    const double fine_px = std::max(0.5, size_.width / 2560.0);
    const double focal = result_.FocalDeviation();
    const bool uneven = result_.rms_px > fine_px;
    const bool held_out = result_.held_out_rms_px > 1.5 * result_.rms_px + 0.1;
    if (focal > kGoodFocal) Advise(LensKind::kTilt, focal);
    if (uneven) Advise(LensKind::kUneven, result_.rms_px);
    if (held_out) Advise(LensKind::kHeldOut, result_.held_out_rms_px);
    AdviseOnParts();
    if (result_.fitted < kEnoughViews) Advise(LensKind::kFewViews, result_.fitted);
    if (5 * result_.counts.blurred > result_.counts.found) {
      Advise(LensKind::kBlur, result_.counts.blurred);
    }
    const double aspect = result_.camera.fx / result_.camera.fy - 1.0;
    if (std::abs(aspect) > 0.02) Advise(LensKind::kAspect, aspect);
    const bool poor =
        focal > kPoorFocal || result_.rms_px > 3.0 * fine_px || result_.covered < kPoorCover;
    const bool good = focal <= kGoodFocal && !uneven && !held_out && result_.covered >= kGoodCover;
    result_.verdict = poor   ? Calibration::Verdict::kPoor
                      : good ? Calibration::Verdict::kGood
                             : Calibration::Verdict::kUsable;
  }

  Board board_;
  cv::Size size_;
  const BoardCollector& collector_;
  Progress& progress_;
  std::vector<cv::Point3f> points_;
  double limit_ = 0.0;  // RMS error beyond which a view is an outlier, pixels.
  Calibration result_;
};

}  // namespace

Result<Calibration> Calibrate(const BoardCollector& views, Progress& progress) {
  return Calibrator(views, progress).Run();
}

Result<Calibration> CalibrateFromBoard(capture::FrameSource& source,
                                       const Board& board,
                                       double seconds,
                                       Progress& progress,
                                       const std::function<bool(const BoardMoment&)>& next) {
  LARARIUM_RETURN_IF_ERROR(board.Validate());
  const int64_t frames = source.live() ? 0 : source.estimated_frame_count();
  const int64_t stride = std::max<int64_t>(1, frames / kImagesOfRecording);
  BoardCollector views(board, source.width(), source.height());
  std::optional<double> begin;
  double done = 0.0;
  while (done < 1.0 || !source.live()) {
    progress.Report("looking for the board", std::min(1.0, done));
    if (progress.Cancelled()) {
      return Status::Error("calibration", "cancelled");
    }
    LARARIUM_ASSIGN_OR_RETURN(const std::optional<geometry::Frame> frame, source.Next());
    if (!frame) {
      break;
    }
    begin = begin.value_or(frame->capture_time);
    done = source.live() ? (frame->capture_time - *begin) / seconds
                         : static_cast<double>(frame->index + 1) /
                               static_cast<double>(std::max<int64_t>(1, frames));
    if (frame->index % stride != 0 && !source.live()) {
      continue;
    }
    const BoardObservation observation = views.Add(*frame, source.FrameName(frame->index));
    if (next && !next({*frame, observation, views})) {
      break;
    }
  }
  return Calibrate(views, progress);
}

}  // namespace lararium::train
