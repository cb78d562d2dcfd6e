#include "shared/show/prop_blockers.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>

#include "shared/render/passes/screen_bounds.h"

namespace lararium::show {
namespace {

constexpr float kFilled = 0.6f;      // Filled share of a box, between a sphere's and the whole box.
constexpr float kLeastSize = 0.01f;  // Metres; thinner objects are treated as this thick.
constexpr int kMostPieces = 4;       // Pieces along one axis.

render::Box BoxOf(const stage::PropPart& part) {
  render::Box box;
  for (const stage::PropMesh& mesh : part.meshes) {
    for (const glm::vec3& position : mesh.positions) {
      box.Extend(position);
    }
  }
  return box;
}

// Chooses the piece's size by the middle one of the three extents, so that flat objects are cut
// into squares and long ones into cubes.
glm::ivec3 CountPieces(const glm::vec3& size) {
  const float middle = size.x + size.y + size.z - std::max({size.x, size.y, size.z}) -
                       std::min({size.x, size.y, size.z});
  const float longest = std::max({size.x, size.y, size.z});
  const float piece = std::max(middle / 2.0f, longest / static_cast<float>(kMostPieces));
  return glm::clamp(glm::ivec3(glm::round(size / piece)), glm::ivec3(1), glm::ivec3(kMostPieces));
}

void CutBox(const render::Box& box, uint32_t part, std::vector<PropBlocker>& blockers) {
  const glm::vec3 size = glm::max(box.high - box.low, glm::vec3(kLeastSize));
  const glm::ivec3 counts = CountPieces(size);
  const glm::vec3 piece = size / glm::vec3(counts);
  const float radius =
      std::cbrt(kFilled * piece.x * piece.y * piece.z * 3.0f / (4.0f * std::numbers::pi_v<float>));
  for (int x = 0; x < counts.x; ++x) {
    for (int y = 0; y < counts.y; ++y) {
      for (int z = 0; z < counts.z; ++z) {
        const glm::vec3 cell(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f,
                             static_cast<float>(z) + 0.5f);
        blockers.push_back({part, box.low + cell * piece, radius});
      }
    }
  }
}

}  // namespace

std::vector<PropBlocker> FindBlockers(const stage::Prop& prop) {
  std::vector<PropBlocker> blockers;
  for (uint32_t part = 0; part < prop.parts.size(); ++part) {
    const render::Box box = BoxOf(prop.parts[part]);
    if (!box.empty()) {
      CutBox(box, part, blockers);
    }
  }
  return blockers;
}

}  // namespace lararium::show
