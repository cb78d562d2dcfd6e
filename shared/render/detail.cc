#include "shared/render/detail.h"

#include <algorithm>
#include <cmath>

namespace lararium::render {
namespace {

constexpr double kNearest = 0.5;  // metres
constexpr float kPressureStep = 1.25f;
constexpr float kMostPressure = 64.0f;
// The pressure is lowered only if the picture then uses at most this share of the budget.
constexpr float kRelief = 0.9f;

Eigen::Vector3d InCamera(const geometry::Rigid3& camera_from_stage, const glm::vec3& point) {
  return camera_from_stage * Eigen::Vector3d(point.x, point.y, point.z);
}

size_t TrianglesAt(const DetailRequest& request, float error) {
  size_t triangles = request.levels.empty() ? 0 : request.levels.front().triangles;
  for (const DetailLevel& level : request.levels) {
    if (level.error <= error) {
      triangles = level.triangles;
    }
  }
  return triangles;
}

}  // namespace

float PixelsPerMetre(const geometry::CameraModel& display,
                     const geometry::Rigid3& camera_from_stage,
                     const glm::vec3& point_in_stage) {
  const double distance = InCamera(camera_from_stage, point_in_stage).norm();
  return static_cast<float>(display.Focal() / std::max(distance, kNearest));
}

bool MaySee(const geometry::CameraModel& display,
            const geometry::Rigid3& camera_from_stage,
            const glm::vec3& centre_in_stage,
            float radius) {
  const Eigen::Vector3d centre = InCamera(camera_from_stage, centre_in_stage);
  // True unless the ball lies entirely outside the plane through the eye and one side of the
  // picture.
  const auto inside = [&](double across, double focal, double edge) {
    const double slope = edge / focal;
    return slope * centre.z() - across > -radius * std::hypot(1.0, slope);
  };
  return centre.z() > -radius && inside(centre.x(), display.fx, display.width - 0.5 - display.cx) &&
         inside(-centre.x(), display.fx, display.cx + 0.5) &&
         inside(centre.y(), display.fy, display.height - 0.5 - display.cy) &&
         inside(-centre.y(), display.fy, display.cy + 0.5);
}

std::vector<MeshLevel> FindMeshLevels(const human::Human& human, size_t index) {
  const human::SkinnedMesh& mesh = human.meshes[index];
  const float share = human::ErrorShare(mesh.SurfaceIn(human.materials));
  const auto level = [](const std::vector<uint32_t>& indices, float error) {
    const auto last = std::max_element(indices.begin(), indices.end());
    return MeshLevel{error, indices.size() / 3, last == indices.end() ? 0 : size_t{*last} + 1};
  };
  std::vector<MeshLevel> levels = {level(mesh.indices, share * mesh.error)};
  for (const human::LevelOfDetail& coarser : mesh.coarser) {
    levels.push_back(level(coarser.indices, share * coarser.error));
  }
  for (size_t i = levels.size() - 1; i > 0; --i) {
    levels[i - 1].vertices = std::max(levels[i - 1].vertices, levels[i].vertices);
  }
  return levels;
}

std::vector<DetailLevel> FindDetailLevels(const human::Human& human) {
  std::vector<std::vector<MeshLevel>> meshes;
  std::vector<float> errors = {0.0f};
  for (size_t i = 0; i < human.meshes.size(); ++i) {
    for (const MeshLevel& level : meshes.emplace_back(FindMeshLevels(human, i))) {
      errors.push_back(level.error);
    }
  }
  std::sort(errors.begin(), errors.end());
  errors.erase(std::unique(errors.begin(), errors.end()), errors.end());
  std::vector<DetailLevel> levels;
  for (const float error : errors) {
    DetailLevel level{error, 0};
    for (const std::vector<MeshLevel>& mesh : meshes) {
      level.triangles += LevelAllowed(mesh, error).triangles;
    }
    levels.push_back(level);
  }
  return levels;
}

void DetailChooser::Choose(std::span<DetailRequest> requests) {
  for (DetailRequest& request : requests) {
    if (request.pixels_per_metre <= 0.0f) {
      request.allowed_error = 0.0f;
      continue;
    }
    const float wanted = options_.tolerance_px / request.pixels_per_metre;
    const bool stays = request.allowed_error > 0.0f &&
                       wanted < request.allowed_error * (1.0f + options_.slack) &&
                       wanted > request.allowed_error / (1.0f + options_.slack);
    request.allowed_error = stays ? request.allowed_error : wanted;
  }
  const auto triangles = [&](float pressure) {
    size_t sum = 0;
    for (const DetailRequest& request : requests) {
      sum += request.pixels_per_metre > 0.0f
                 ? TrianglesAt(request, request.allowed_error * pressure)
                 : 0;
    }
    return static_cast<float>(sum);
  };
  const auto budget = static_cast<float>(options_.triangle_budget);
  while (pressure_ < kMostPressure && triangles(pressure_) > budget) {
    pressure_ *= kPressureStep;
  }
  while (pressure_ > 1.0f && triangles(pressure_ / kPressureStep) <= kRelief * budget) {
    pressure_ = std::max(pressure_ / kPressureStep, 1.0f);
  }
  for (DetailRequest& request : requests) {
    request.detail = request.allowed_error * pressure_;
  }
}

}  // namespace lararium::render
