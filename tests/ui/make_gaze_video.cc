// make_gaze_video SHOW VIDEO POSES FILE: writes a video in which the camera rests, turns towards
// the menu item for captions (if the menu was opened before), and rests there; for tests of the
// player's window. Its images are two frames of VIDEO, whose poses are in POSES.

#include <cstdio>
#include <optional>
#include <vector>

#include "player/app/visitor_menu.h"
#include "shared/bundle/bundle.h"
#include "shared/capture/frame_source.h"
#include "shared/capture/video_writer.h"
#include "shared/show/show_content.h"
#include "shared/vision/poses_file.h"

namespace {

using namespace lararium;  // NOLINT: the program itself

constexpr int kRate = 30;          // Frames per second.
constexpr int kAheadFrames = 120;  // Frames before the camera turns.
constexpr int kAtItemFrames = 90;  // Longer than the dwell time that chooses an item.
constexpr size_t kStep = 4;        // Step between the frames that are tried.

struct Turn {
  size_t ahead = 0;
  size_t at_item = 0;
};

// Distance of the view's middle from the item's middle after this turn; nullopt: not at the item.
std::optional<double> MissOf(const std::vector<player::MenuItem>& items,
                             const geometry::Rigid3& ahead,
                             const geometry::Rigid3& turned) {
  player::GazeMenu menu;
  menu.Open(items, 0.0);
  menu.Look(0.0, ahead);
  menu.Look(0.1, turned);
  double miss = 0.0;
  for (const player::GazeMenu::Cell& cell : menu.Cells()) {
    miss = cell.selected ? cell.box.center().norm() : miss;
  }
  const std::optional<player::Action> chosen = menu.Look(0.2 + player::GazeMenu::kDwell, turned);
  return chosen == player::Action::kCaptions ? std::optional(miss) : std::nullopt;
}

std::optional<Turn> FindTurn(const std::vector<player::MenuItem>& items,
                             const std::vector<vision::PoseRecord>& poses) {
  std::optional<Turn> best;
  double least = 0.0;
  for (size_t i = 0; i < poses.size(); i += kStep) {
    for (size_t j = 0; j < poses.size(); j += kStep) {
      if (!poses[i].tracked || !poses[j].tracked) {
        continue;
      }
      const auto miss = MissOf(items, *poses[i].camera_from_world, *poses[j].camera_from_world);
      if (miss && (!best || *miss < least)) {
        best = {i, j};
        least = *miss;
      }
    }
  }
  return best;
}

Status WriteStill(capture::FrameSource& source,
                  size_t frame,
                  int times,
                  capture::VideoWriter& writer) {
  LARARIUM_RETURN_IF_ERROR(source.Seek(static_cast<int64_t>(frame)));
  LARARIUM_ASSIGN_OR_RETURN(const std::optional<geometry::Frame> image, source.Next());
  if (!image) {
    return Status::Error("the video", "is shorter than its poses");
  }
  for (int i = 0; i < times; ++i) {
    LARARIUM_RETURN_IF_ERROR(writer.Write(image->bgr));
  }
  return Status();
}

Status WriteGaze(const char* show_file,
                 const char* video,
                 const char* poses_file,
                 const char* out) {
  LARARIUM_ASSIGN_OR_RETURN(const bundle::Bundle bundle, bundle::Bundle::Open(show_file));
  LARARIUM_ASSIGN_OR_RETURN(const show::ShowContent content, show::LoadShowContent(bundle));
  LARARIUM_ASSIGN_OR_RETURN(const auto poses, vision::LoadPoses(poses_file));
  const std::optional<Turn> turn = FindTurn(player::ItemsOf(content, {}), poses);
  if (!turn) {
    return Status::Error(video,
                         "has no two images between which the camera turns to the menu item");
  }
  std::printf("from frame %zu to %zu\n", turn->ahead, turn->at_item);
  LARARIUM_ASSIGN_OR_RETURN(const auto source, capture::OpenVideo(video));
  LARARIUM_ASSIGN_OR_RETURN(const auto writer, capture::VideoWriter::Create(
                                                   out, source->width(), source->height(), kRate));
  LARARIUM_RETURN_IF_ERROR(WriteStill(*source, turn->ahead, kAheadFrames, *writer));
  LARARIUM_RETURN_IF_ERROR(WriteStill(*source, turn->at_item, kAtItemFrames, *writer));
  return writer->Finish();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) {
    std::fprintf(stderr, "usage: make_gaze_video SHOW VIDEO POSES FILE\n");
    return 2;
  }
  const Status status = WriteGaze(argv[1], argv[2], argv[3], argv[4]);
  if (!status.ok()) {
    std::fprintf(stderr, "%s\n", status.message().c_str());
    return 1;
  }
  return 0;
}
