#pragma once

// Chooses the picture that guides a visitor whose tracking is lost: of the keyframes that are easy
// to find and that no other part of the place looks like, the one nearest to the last pose.

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "shared/geometry/transform.h"
#include "shared/vision/scene_database.h"
#include "shared/vision/tracked_frame.h"

namespace lararium::show {

// The guide in a frame.
struct StagedGuide {
  enum class Says {
    kLookThere,
    kDark,      // The image is too dark; a picture would not help.
    kFarewell,  // The visit is over.
  };

  float opacity = 0.0f;  // 0: nothing is drawn.
  Says says = Says::kLookThere;
  cv::Mat picture;              // CV_8UC1, small; empty: the map has no images.
  uint64_t picture_number = 0;  // Changes with the picture.
};

// Returns the keyframe to show; nullopt if the map has no images. Without a last pose it is the
// keyframe that observes most points without look-alikes.
std::optional<size_t> ChooseGuideView(const vision::SceneDatabase& map,
                                      const std::optional<geometry::Rigid3>& last_camera_from_map);

class LostGuide {
 public:
  // opacity: of the guide in this frame. map: the map of the last pose; nullptr: none.
  void Update(float opacity,
              const vision::TrackedFrame& tracked,
              const vision::SceneDatabase* map,
              StagedGuide& guide);

 private:
  std::optional<geometry::Rigid3> last_camera_from_map_;
  const vision::SceneDatabase* last_map_ = nullptr;
  StagedGuide shown_;
};

}  // namespace lararium::show
