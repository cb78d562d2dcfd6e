#include "editor/colmap/colmap_repair.h"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>

namespace lararium::train {
namespace {

template <typename T>
T* Find(std::vector<T>& sorted, uint64_t id) {
  const auto found = std::lower_bound(sorted.begin(), sorted.end(), id,
                                      [](const T& item, uint64_t key) { return item.id < key; });
  return found != sorted.end() && found->id == id ? &*found : nullptr;
}

bool AnyFeatures(const ColmapModel& model) {
  return std::any_of(model.images.begin(), model.images.end(),
                     [](const ColmapImage& image) { return !image.features.empty(); });
}

bool AnyObservations(const ColmapModel& model) {
  return std::any_of(model.points.begin(), model.points.end(),
                     [](const ColmapPoint& point) { return !point.observations.empty(); });
}

// Returns whether any feature shows a point.
bool TakeObservationsFromFeatures(ColmapModel& model) {
  bool any = false;
  for (const ColmapImage& image : model.images) {
    for (size_t f = 0; f < image.features.size(); ++f) {
      if (ColmapPoint* point = Find(model.points, image.features[f].point)) {
        point->observations.push_back({image.id, static_cast<uint32_t>(f)});
        any = true;
      }
    }
  }
  return any;
}

void TakeFeaturesFromProjections(ColmapModel& model) {
  std::map<uint32_t, geometry::CameraModel> cameras;
  for (const ColmapCamera& camera : model.cameras) {
    if (camera.parameters.size() == ParameterCount(camera.model)) {
      if (const auto ours = CameraFromColmap(camera); ours.ok()) {
        cameras.emplace(camera.id, *ours);
      }
    }
  }
  for (ColmapPoint& point : model.points) {
    for (ColmapObservation& observation : point.observations) {
      ColmapImage* image = Find(model.images, observation.image);
      const auto camera = image == nullptr ? cameras.end() : cameras.find(image->camera);
      const std::optional<Eigen::Vector2d> pixel =
          camera == cameras.end() ? std::nullopt
                                  : camera->second.Project(image->camera_from_map * point.position);
      if (pixel && pixel->allFinite()) {
        observation.feature = static_cast<uint32_t>(image->features.size());
        image->features.push_back({pixel->x() + 0.5, pixel->y() + 0.5, point.id});
      } else {
        observation.feature = std::numeric_limits<uint32_t>::max();
      }
    }
  }
}

// Returns the number of dropped references.
size_t DropOneSidedReferences(ColmapModel& model) {
  size_t dropped = 0;
  std::vector<std::vector<bool>> listed;
  for (const ColmapImage& image : model.images) {
    listed.emplace_back(image.features.size(), false);
  }
  for (ColmapPoint& point : model.points) {
    dropped += std::erase_if(point.observations, [&](const ColmapObservation& observation) {
      const ColmapImage* image = Find(model.images, observation.image);
      if (image == nullptr || observation.feature >= image->features.size() ||
          image->features[observation.feature].point != point.id) {
        return true;
      }
      auto&& known = listed[static_cast<size_t>(image - model.images.data())][observation.feature];
      const bool again = known;
      known = true;
      return again;
    });
  }
  for (size_t i = 0; i < model.images.size(); ++i) {
    for (size_t f = 0; f < listed[i].size(); ++f) {
      ColmapFeature& feature = model.images[i].features[f];
      if (feature.point != ColmapFeature::kNoPoint && !listed[i][f]) {
        feature.point = ColmapFeature::kNoPoint;
        ++dropped;
      }
    }
  }
  return dropped;
}

}  // namespace

std::vector<std::string> RepairColmapModel(ColmapModel& model) {
  std::vector<std::string> notes;
  if (!AnyObservations(model)) {
    if (TakeObservationsFromFeatures(model)) {
      notes.emplace_back("its points list no observations; those of the features were taken");
    }
  } else if (!AnyFeatures(model)) {
    TakeFeaturesFromProjections(model);
    notes.emplace_back("its images list no features; the projections of the points were taken");
  }
  if (const size_t dropped = DropOneSidedReferences(model)) {
    notes.push_back(std::to_string(dropped) +
                    " observations are listed by a point or by an image only; they were left out");
  }
  return notes;
}

}  // namespace lararium::train
