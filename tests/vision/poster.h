#pragma once

// A textured poster in the plane z = 0, photographs of it, and its map.

#include <memory>
#include <opencv2/core/mat.hpp>

#include "shared/geometry/camera_model.h"
#include "shared/geometry/frame.h"
#include "shared/geometry/transform.h"
#include "shared/vision/scene_database.h"

namespace lararium::test {

inline const geometry::CameraModel kPosterCamera = {
    .width = 480, .height = 360, .fx = 420.0, .fy = 420.0, .cx = 239.5, .cy = 179.5};

cv::Mat MakePoster();  // CV_8UC1

// A poster that repeats itself to the right except for a few marks; `marks` selects which ones.
inline constexpr double kWallPeriod = 0.25;  // metres
cv::Mat MakePeriodicWall(int marks = 0);     // CV_8UC1

// Renders the poster as a camera sees it, with four rays per pixel.
geometry::Frame PhotographPoster(const cv::Mat& poster,
                                 const geometry::Rigid3& camera_from_map,
                                 int64_t index);

// The pose of a camera at this position that looks at the middle of the poster; z is the distance.
geometry::Rigid3 PosterPose(double x, double y, double z);

// A map of the poster from one photograph with a known pose.
std::shared_ptr<const vision::SceneDatabase> MapOfPoster(const cv::Mat& poster);

// The largest difference between two poses at the corners of the poster, pixels.
double CornerError(const geometry::Rigid3& estimate, const geometry::Rigid3& truth);

}  // namespace lararium::test
