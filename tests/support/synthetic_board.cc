#include "tests/support/synthetic_board.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <utility>

namespace lararium::test {
namespace {

constexpr int kFine = 3;  // Samples across a pixel.
constexpr double kWhite = 210.0;
constexpr double kBlack = 35.0;
constexpr double kBehind = 120.0;

// Outer rectangle of the border, in squares from the first corner.
struct Extent {
  double left = -2.0;
  double top = -2.0;
  double right = 0.0;
  double bottom = 0.0;
};

Extent ExtentOf(const SyntheticBoard& board) {
  return {-2.0, -2.0, board.columns + 1.0, board.rows + 1.0};
}

double Brightness(const SyntheticBoard& board, double x, double y) {
  const Extent extent = ExtentOf(board);
  if (x < extent.left || y < extent.top || x > extent.right || y > extent.bottom) {
    return kBehind;
  }
  if (x < -1.0 || y < -1.0 || x > board.columns || y > board.rows) {
    return kWhite;
  }
  const auto square = static_cast<int>(std::floor(x) + std::floor(y));
  return square % 2 == 0 ? kBlack : kWhite;
}

}  // namespace

geometry::Rigid3 AimedBoardPose(const SyntheticBoard& board,
                                const geometry::CameraModel& camera,
                                const Eigen::Vector2d& pixel,
                                double distance,
                                double tilt,
                                double tilt_axis,
                                double roll) {
  const Eigen::Vector3d axis(std::cos(tilt_axis), std::sin(tilt_axis), 0.0);
  const Eigen::Quaterniond rotation(Eigen::AngleAxisd(tilt, axis) *
                                    Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitZ()));
  const Eigen::Vector3d middle(0.5 * (board.columns - 1) * board.square,
                               0.5 * (board.rows - 1) * board.square, 0.0);
  const Eigen::Vector3d at = distance * camera.PlaneFromPixel(pixel).homogeneous();
  return {rotation, at - rotation * middle};
}

bool BoardInside(const SyntheticBoard& board,
                 const geometry::CameraModel& camera,
                 const geometry::Rigid3& camera_from_board) {
  const Extent extent = ExtentOf(board);
  for (const double x : {extent.left, extent.right}) {
    for (const double y : {extent.top, extent.bottom}) {
      const auto pixel = camera.Project(camera_from_board *
                                        Eigen::Vector3d(x * board.square, y * board.square, 0));
      if (!pixel || !camera.Contains(*pixel)) {
        return false;
      }
    }
  }
  return true;
}

std::vector<BoardPicture> VariedBoardPictures(const SyntheticBoard& board,
                                              const geometry::CameraModel& camera,
                                              int count,
                                              uint64_t seed) {
  Random random(seed);
  std::vector<BoardPicture> pictures;
  const double width = (board.columns + 3) * board.square;
  // At this distance the board fills the width.
  const double fills = width * camera.fx / camera.width;
  while (static_cast<int>(pictures.size()) < count) {
    const Eigen::Vector2d pixel{random.Uniform(0.1, 0.9) * camera.width,
                                random.Uniform(0.1, 0.9) * camera.height};
    BoardPicture picture;
    const double distance = fills * random.Uniform(1.1, 2.6);
    const double tilt = random.Uniform(0.0, 0.7);
    const double tilt_axis = random.Uniform(0.0, 2.0 * std::numbers::pi);
    picture.camera_from_board =
        AimedBoardPose(board, camera, pixel, distance, tilt, tilt_axis, random.Uniform(-0.4, 0.4));
    if (BoardInside(board, camera, picture.camera_from_board)) {
      pictures.push_back(picture);
    }
  }
  return pictures;
}

BoardRecording::BoardRecording(const SyntheticBoard& board,
                               const geometry::CameraModel& camera,
                               std::vector<BoardPicture> pictures)
    : board_(board), camera_(camera), pictures_(std::move(pictures)) {
  for (int y = 0; y < kFine * camera.height; ++y) {
    for (int x = 0; x < kFine * camera.width; ++x) {
      const Eigen::Vector2d ray =
          camera.PlaneFromPixel({(x + 0.5) / kFine - 0.5, (y + 0.5) / kFine - 0.5});
      rays_.emplace_back(static_cast<float>(ray.x()), static_cast<float>(ray.y()));
    }
  }
}

cv::Mat BoardRecording::Render(size_t index) const {
  const BoardPicture& picture = pictures_[index];
  // Board coordinates of a ray: the inverse of [r1 r2 t], in squares.
  Eigen::Matrix3d plane;
  const Eigen::Matrix3d rotation = picture.camera_from_board.rotation.toRotationMatrix();
  plane << rotation.col(0), rotation.col(1), picture.camera_from_board.translation / board_.square;
  const Eigen::Matrix3d from_ray = plane.inverse();
  cv::Mat image(camera_.height, camera_.width, CV_32F);
  const int stride = kFine * camera_.width;
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      double sum = 0.0;
      for (int i = 0; i < kFine * kFine; ++i) {
        const cv::Vec2f& ray =
            rays_[static_cast<size_t>((kFine * y + i / kFine) * stride + kFine * x + i % kFine)];
        const Eigen::Vector3d at = from_ray * Eigen::Vector3d(ray[0], ray[1], 1.0);
        sum += picture.board ? Brightness(board_, at.x() / at.z(), at.y() / at.z()) : kBehind;
      }
      // The light falls off to the right.
      const double light = 1.0 - 0.25 * x / image.cols;
      image.at<float>(y, x) = static_cast<float>(light * sum / (kFine * kFine));
    }
  }
  cv::GaussianBlur(image, image, cv::Size(), picture.blur_px);
  if (picture.smear_px > 1.0) {
    cv::blur(image, image, cv::Size(static_cast<int>(picture.smear_px), 1));
  }
  cv::RNG noise(index + 1);
  cv::Mat grain(image.size(), CV_32F);
  noise.fill(grain, cv::RNG::NORMAL, 0.0, picture.noise);
  image += grain;
  cv::Mat grey;
  image.convertTo(grey, CV_8U);
  return grey;
}

Result<std::optional<geometry::Frame>> BoardRecording::Next() {
  if (next_ == pictures_.size()) {
    return std::optional<geometry::Frame>();
  }
  geometry::Frame frame;
  frame.index = static_cast<int64_t>(next_);
  frame.capture_time = static_cast<double>(next_) / frames_per_second();
  frame.grey = Render(next_);
  cv::cvtColor(frame.grey, frame.bgr, cv::COLOR_GRAY2BGR);
  ++next_;
  return std::optional<geometry::Frame>(std::move(frame));
}

Status BoardRecording::Seek(int64_t index) {
  next_ = static_cast<size_t>(std::clamp<int64_t>(index, 0, *frame_count()));
  return Status();
}

}  // namespace lararium::test
