#pragma once

// Image sequences with known poses for the benchmark. A sequence is a folder with
// ground_truth.json, and with video.mp4 or the images that ground_truth.json names.

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
  std::string file;  // base name, equal to FrameSource::FrameName
  geometry::CameraModel camera;
  std::optional<geometry::Rigid3> camera_from_world;  // nullopt: not known
  double visible_fraction = 1.0;                      // part of the image not hidden by passers-by
  std::optional<double> gain_ev;                      // gain of the camera, stops
};

struct BenchmarkSequence {
  std::string name;  // name of its folder
  std::filesystem::path folder;
  std::vector<TrueImage> images;
  // Points in the world's frame at which registration is measured.
  std::vector<Eigen::Vector3d> points;

  // The true image with a base name; nullptr: there is none.
  const TrueImage* Find(const std::string& file) const;
  bool HasPoses() const;
  // True if all true poses are equal.
  bool IsStill() const;
};

// Loads the sequence in a directory, or the sequences in its subfolders in the order of their
// names. Points come from points.json or points.txt in the folder of the sequence or in its parent.
// A sequence without points is an error.
Result<std::vector<BenchmarkSequence>> LoadBenchmarkSequences(
    const std::filesystem::path& directory);

Result<std::unique_ptr<capture::FrameSource>> OpenSequence(const BenchmarkSequence& sequence);

// Opens images of another place: a video, a folder of images, or a folder that contains images/ or
// video.mp4.
Result<std::unique_ptr<capture::FrameSource>> OpenForeign(const std::filesystem::path& path);

}  // namespace lararium::player
