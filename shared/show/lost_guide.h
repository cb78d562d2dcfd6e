#pragma once

// Which picture a visitor who has lost the place is shown: the keyframe that is nearest to where
// they were seen last, among those that are found well.

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "shared/geometry/transform.h"
#include "shared/vision/scene_database.h"
#include "shared/vision/tracked_frame.h"

namespace lararium::show {

// Of a frame.
struct StagedGuide {
  enum class Says {
    kLookThere,
    kDark,      // the camera sees nothing: a picture would not help
    kFarewell,  // the visit is over
  };

  float opacity = 0.0f;  // 0: there is nothing to be drawn
  Says says = Says::kLookThere;
  cv::Mat picture;              // CV_8UC1, small; empty: the map keeps none
  uint64_t picture_number = 0;  // another one for another picture
};

// The keyframe to look for; none where the map keeps no images. Without a last pose the one
// that sees most of the map.
std::optional<size_t> ChooseGuideView(const vision::SceneDatabase& map,
                                      const std::optional<geometry::Rigid3>& last_camera_from_map);

class LostGuide {
 public:
  // opacity: of the guide in this frame. map: in which the last pose lay; nullptr: there is none.
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
