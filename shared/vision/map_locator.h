#pragma once

// Locates one image in one of several maps, for example the rooms of a house. A cheap search tells
// which map the image shows; the full localisation runs in that map.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "shared/geometry/camera_model.h"
#include "shared/vision/descriptor_forest.h"
#include "shared/vision/features.h"
#include "shared/vision/localizer.h"
#include "shared/vision/scene_database.h"

namespace lararium::vision {

struct Located {
  uint32_t map = 0;   // Index of the map that `location` refers to.
  Location location;  // If there is no pose, the result in the likeliest map.
};

class MapLocator {
 public:
  // Takes at least one map and shares ownership.
  MapLocator(std::span<const std::shared_ptr<const SceneDatabase>> maps,
             const LocalizerOptions& options);

  // Deterministic: the same features give the same result, independent of earlier calls and of the
  // number of threads. With a single map this is Localizer::Locate.
  Located Locate(const Features& features, const CameraGuess& guess);
  // Localizer::points of the last location. map must be the map of that location.
  std::span<const LocatedPoint> points(uint32_t map) const {
    return maps_[map].localizer->points();
  }

 private:
  struct Map {
    std::shared_ptr<const SceneDatabase> database;
    std::unique_ptr<Localizer> localizer;
    std::vector<ForestSearcher> searchers;  // One per job.
  };
  // Squared descriptor distances from a probe to the nearest point of a map and to the nearest
  // other point.
  struct Nearest {
    uint32_t first = UINT32_MAX;
    uint32_t other = UINT32_MAX;
  };

  void ChooseProbes(const Features& features);
  void SearchProbes(const Features& features);
  void CountVotes();

  std::vector<Map> maps_;
  double ratio2_;

  // Working memory.
  std::vector<uint32_t> probes_;   // Indices of features.
  std::vector<Nearest> nearest_;   // [probes][maps]
  std::vector<int> votes_;         // [maps]
  std::vector<uint32_t> ranking_;  // Indices of maps, most votes first.
};

}  // namespace lararium::vision
