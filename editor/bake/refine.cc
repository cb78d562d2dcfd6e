#include "editor/bake/refine.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <map>
#include <utility>
#include <vector>

namespace lararium::bake {
namespace {

using Triangle = std::array<uint32_t, 3>;

class Refiner {
 public:
  Refiner(float longest_edge, stage::PropMesh& mesh) : longest_(longest_edge), mesh_(mesh) {}

  // False if more vertices would be needed.
  bool Run(size_t most_vertices) {
    std::vector<Triangle> left;
    for (size_t t = 0; t + 2 < mesh_.indices.size(); t += 3) {
      left.push_back({mesh_.indices[t], mesh_.indices[t + 1], mesh_.indices[t + 2]});
    }
    mesh_.indices.clear();
    while (!left.empty() && mesh_.positions.size() <= most_vertices) {
      const Triangle triangle = left.back();
      left.pop_back();
      Split(triangle, left);
    }
    return left.empty();
  }

 private:
  float LengthOf(const Triangle& t, size_t edge) const {
    return glm::distance(mesh_.positions[t[edge]], mesh_.positions[t[(edge + 1) % 3]]);
  }

  // Halves the longest edge of a triangle, which preserves its shape (Rivara, "Mesh Refinement
  // Processes Based on the Generalized Bisection of Simplices", 1984). At the end each edge
  // that was too long is halved in all of its triangles.
  void Split(const Triangle& t, std::vector<Triangle>& left) {
    size_t edge = 0;
    for (size_t other = 1; other < 3; ++other) {
      edge = LengthOf(t, other) > LengthOf(t, edge) ? other : edge;
    }
    if (LengthOf(t, edge) <= longest_) {
      mesh_.indices.insert(mesh_.indices.end(), t.begin(), t.end());
      return;
    }
    const uint32_t a = t[edge];
    const uint32_t b = t[(edge + 1) % 3];
    const uint32_t c = t[(edge + 2) % 3];
    const uint32_t middle = MiddleOf(a, b);
    left.push_back({a, middle, c});
    left.push_back({middle, b, c});
  }

  uint32_t MiddleOf(uint32_t a, uint32_t b) {
    const auto next = static_cast<uint32_t>(mesh_.positions.size());
    const auto [found, is_new] = middles_.try_emplace(std::minmax(a, b), next);
    if (is_new) {
      const auto add = [a, b](auto& values) {
        const auto mean = 0.5f * (values[a] + values[b]);
        values.push_back(mean);
      };
      add(mesh_.positions);
      add(mesh_.normals);
      glm::vec3& normal = mesh_.normals.back();
      const float length = glm::length(normal);
      normal = length > 1e-3f ? normal / length : mesh_.normals[a];
      add(mesh_.albedo);
      if (!mesh_.uvs.empty()) {
        add(mesh_.uvs);
      }
    }
    return found->second;
  }

  float longest_;
  stage::PropMesh& mesh_;
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles_;
};

}  // namespace

void RefineMesh(float longest_edge, size_t most_vertices, stage::PropMesh& mesh) {
  stage::PropMesh refined = mesh;
  if (Refiner(longest_edge, refined).Run(most_vertices)) {
    mesh = std::move(refined);
  }
}

}  // namespace lararium::bake
