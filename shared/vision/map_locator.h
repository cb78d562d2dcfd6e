#pragma once

// The pose of one image in one of several maps (the rooms of a house): one cheap
// search tells which map the image shows, the full localisation follows there.

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
  uint32_t map = 0;   // index of the map that the location is about
  Location location;  // without a pose: of the likeliest map
};

class MapLocator {
 public:
  // At least one map; shares them.
  MapLocator(std::span<const std::shared_ptr<const SceneDatabase>> maps,
             const LocalizerOptions& options);

  // The same features give the same answer, whatever came before and however
  // many threads run. With a single map this is Localizer::Locate.
  Located Locate(const Features& features, const geometry::CameraModel& camera);
  // Localizer::points of the last answer with a pose, in its map.
  std::span<const LocatedPoint> points(uint32_t map) const {
    return maps_[map].localizer->points();
  }

 private:
  struct Map {
    std::shared_ptr<const SceneDatabase> database;
    std::unique_ptr<Localizer> localizer;
    std::vector<ForestSearcher> searchers;  // one for each job
  };
  // The nearest point of a map to a probe, and the distance of the next other one.
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
  std::vector<uint32_t> probes_;   // features
  std::vector<Nearest> nearest_;   // [probes][maps]
  std::vector<int> votes_;         // of the maps
  std::vector<uint32_t> ranking_;  // maps, most votes first
};

}  // namespace lararium::vision
