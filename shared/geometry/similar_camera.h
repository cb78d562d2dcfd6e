#pragma once

#include <algorithm>
#include <functional>
#include <iterator>

namespace lararium::geometry {

// Returns the first item whose CameraModel, camera_of(item), fits images of this size, else the
// first one: its CameraModel::GuessForImages() is where the estimate of an unknown camera begins.
// Requires an item.
template <typename Items, typename CameraOf>
const auto& FindSimilarCamera(const Items& items, CameraOf camera_of, int width, int height) {
  const auto fits = std::find_if(std::begin(items), std::end(items), [&](const auto& item) {
    return std::invoke(camera_of, item).ForImages(width, height).ok();
  });
  return fits == std::end(items) ? *std::begin(items) : *fits;
}

}  // namespace lararium::geometry
