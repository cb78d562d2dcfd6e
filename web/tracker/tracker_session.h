#pragma once

// The tracker as a page's workers use it: maps and images in, numbers out.

#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>
#include <vector>

#include "shared/core/status.h"
#include "shared/vision/occluders.h"
#include "shared/vision/relocalizer.h"
#include "shared/vision/tracker.h"
#include "web/tracker/posted_search.h"

namespace lararium::web {

class TrackerSession {
 public:
  // posted_search: frames are located in the background by another worker, which gets question()
  // and calls Find(). Otherwise Track() does that work itself every two seconds.
  explicit TrackerSession(bool posted_search) : posted_(posted_search) {}

  // Adds a map, the content of a .larscene file. All maps are added before the first image.
  Status AddMap(std::span<const std::byte> larscene);
  // Sets the intrinsics of the images, see CameraModel::FromNumbers. Without them the tracker
  // estimates the lens, beginning with the one of the first map that fits, as the player does.
  Status SetIntrinsics(std::span<const double> numbers, int width, int height);

  // Adds a real object that hides points of a map, between two images. Fails if it is none of the
  // maps' or if the triangles are not those of its positions.
  Status AddOccluder(size_t map, vision::OccluderMesh mesh);

  // Prepares the maps and locates some of their images, so that the browser compiles the program
  // for speed before an image comes from the camera. Call it after all maps were added; poses do
  // not depend on it.
  Status WarmUp();

  // The pixels to be filled in for the next Track() or Find(): luminance, row by row.
  uint8_t* NewImage(int width, int height);
  // Tracks the image. seconds: time of capture.
  Status Track(double seconds);
  // The numbers of the last tracked image, in the order in which Tracker.track() of
  // lararium-tracker.js takes them.
  // They are valid until the next call.
  std::span<const double> tracked() const { return numbers_; }
  // The map points that support its pose: for each one its index in the map and its pixel (x, y).
  std::span<const double> seen();
  // Makes the next image be located without a prior.
  void Relocalize();

  // The search that waits to be posted, or nullptr.
  PostedSearch* search() { return search_; }
  // Answers the question of another worker's session about the image.
  Status Find(std::span<const double> question);
  std::span<const double> found() const { return numbers_; }

 private:
  Status Start();
  // Prepares the maps where that has not been done.
  void Prepare();

  const bool posted_;
  std::vector<std::shared_ptr<const vision::SceneDatabase>> maps_;
  std::vector<std::shared_ptr<const vision::TrackedMap>> prepared_;  // [maps_], or empty.
  std::vector<std::vector<vision::OccluderMesh>> occluders_;         // [maps_]
  std::optional<geometry::CameraModel> camera_;
  cv::Mat grey_;
  int64_t index_ = 0;
  std::unique_ptr<vision::PoseSource> poses_;
  PostedSearch* search_ = nullptr;  // Owned by poses_.
  std::unique_ptr<vision::Relocalizer> relocalizer_;
  std::vector<double> numbers_;
  std::vector<vision::SeenPoint> seen_;
};

}  // namespace lararium::web
