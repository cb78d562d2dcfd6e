// make_board_video FILE [SECONDS]: writes a video of a chessboard of 9x6 inner corners that moves
// through the image, for tests of the window.

#include <cstdio>
#include <cstdlib>
#include <opencv2/imgproc.hpp>

#include "shared/capture/video_writer.h"
#include "tests/support/synthetic_board.h"

namespace {

using namespace lararium;  // NOLINT: the program itself

constexpr double kRate = 10.0;

Status WriteBoard(const char* file, int frames) {
  const geometry::CameraModel camera{640, 480, 560, 562, 325, 236, -0.28, 0.09, 0.0008, -0.0005};
  const test::SyntheticBoard board;
  const std::vector<test::BoardPicture> stops =
      test::VariedBoardPictures(board, camera, frames / 2 + 2, 1);
  std::vector<test::BoardPicture> pictures;
  for (int i = 0; i < frames; ++i) {
    // The board is still at each stop, then moves to the next one with motion blur.
    test::BoardPicture picture = stops[static_cast<size_t>(i / 2)];
    if (i % 2 == 1) {
      const geometry::Rigid3& next = stops[static_cast<size_t>(i / 2 + 1)].camera_from_board;
      geometry::Rigid3& pose = picture.camera_from_board;
      pose = {pose.rotation.slerp(0.4, next.rotation),
              pose.translation + 0.4 * (next.translation - pose.translation)};
      picture.smear_px = 6.0;
    }
    pictures.push_back(picture);
  }
  const test::BoardRecording recording(board, camera, pictures);
  LARARIUM_ASSIGN_OR_RETURN(const auto writer,
                            capture::VideoWriter::Create(file, camera.width, camera.height, kRate));
  for (size_t i = 0; i < pictures.size(); ++i) {
    cv::Mat bgr;
    cv::cvtColor(recording.Render(i), bgr, cv::COLOR_GRAY2BGR);
    LARARIUM_RETURN_IF_ERROR(writer->Write(bgr));
  }
  return writer->Finish();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: make_board_video FILE [SECONDS]\n");
    return 2;
  }
  const double seconds = argc > 2 ? std::atof(argv[2]) : 10.0;
  const Status status = WriteBoard(argv[1], static_cast<int>(seconds * kRate));
  if (!status.ok()) {
    std::fprintf(stderr, "%s\n", status.message().c_str());
    return 1;
  }
  return 0;
}
