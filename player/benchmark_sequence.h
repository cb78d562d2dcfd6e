#pragma once

// Image sequences whose true poses are known, as the benchmark finds them on
// disk: a folder with ground_truth.json and video.mp4 or the images that it names.

#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "shared/capture/frame_source.h"
#include "shared/core/status.h"
#include "shared/geometry/camera_model.h"
#include "shared/geometry/transform.h"

namespace lararium::player {

// One element of "images" in ground_truth.json.
struct TrueImage {
  std::string file;  // base name, as FrameSource::FrameName
  geometry::CameraModel camera;
  std::optional<geometry::Rigid3> camera_from_world;  // none: not known
  double visible_fraction = 1.0;                      // of the image, not hidden by passers-by
  std::optional<double> gain_ev;                      // of the camera, in stops
};

struct BenchmarkSequence {
  std::string name;  // of its folder
  std::filesystem::path folder;
  std::vector<TrueImage> images;
  // Of the same world as the poses: where registration is measured.
  std::vector<Eigen::Vector3d> points;

  // The true image of that base name; nullptr where there is none.
  const TrueImage* Find(const std::string& file) const;
  bool HasPoses() const;
  // All true poses are one and the same.
  bool IsStill() const;
};

// The sequences at directory: itself, or the folders in it, in order of their
// names. Points are taken from points.json or points.txt in the sequence's
// folder, else beside it; a sequence without them is an error.
Result<std::vector<BenchmarkSequence>> LoadBenchmarkSequences(
    const std::filesystem::path& directory);

Result<std::unique_ptr<capture::FrameSource>> OpenSequence(const BenchmarkSequence& sequence);

// Images of another place: a video, a folder of images, or a folder that holds
// images/ or video.mp4.
Result<std::unique_ptr<capture::FrameSource>> OpenForeign(const std::filesystem::path& path);

}  // namespace lararium::player
