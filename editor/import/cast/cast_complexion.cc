#include "editor/import/cast/cast_complexion.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <initializer_list>

#include "editor/import/cast/joint_lookup.h"

namespace lararium::import {
namespace {

// The share of a vertex that these joints and their descendants move.
class Moved {
 public:
  Moved(const human::Skeleton& skeleton, std::initializer_list<const char*> names)
      : by_(skeleton.size(), false) {
    for (const char* name : names) {
      by_[IndexOfJoint(skeleton, name)] = true;
    }
    for (size_t joint = 0; joint < by_.size(); ++joint) {
      const int16_t parent = skeleton.parents[joint];
      by_[joint] = by_[joint] || (parent >= 0 && by_[static_cast<size_t>(parent)]);
    }
  }
  float Share(const human::SkinnedMesh& mesh, size_t v) const {
    float share = 0.0f;
    for (int k = 0; k < 4; ++k) {
      share += by_[mesh.joints[v][static_cast<size_t>(k)]] ? mesh.weights[v][k] : 0.0f;
    }
    return share;
  }

 private:
  std::vector<bool> by_;
};

// A bell curve over the front of the face. Positions and widths are in distances between the
// eyes, from the middle between them.
struct Bell {
  glm::vec2 middle;
  glm::vec2 width;
};

std::vector<float> OnFace(const FittedBody& body,
                          const CastPiece& skin,
                          std::initializer_list<Bell> bells) {
  const glm::vec3 left = RestPosition(body.skeleton, "l_eyeball_joint");
  const glm::vec3 right = RestPosition(body.skeleton, "r_eyeball_joint");
  const float eyes = glm::distance(left, right);
  const Moved head(body.skeleton, {"skullbase"});
  std::vector<float> amounts(skin.mesh.positions.size(), 0.0f);
  for (size_t v = 0; v < amounts.size(); ++v) {
    const glm::vec3 p = (skin.mesh.positions[v] - 0.5f * (left + right)) / eyes;
    if (p.z > 0.2f || head.Share(skin.mesh, v) < 0.5f) {
      continue;
    }
    for (const Bell& bell : bells) {
      const glm::vec2 off = (glm::vec2(p) - bell.middle) / bell.width;
      amounts[v] = std::max(amounts[v], std::exp(-0.5f * glm::dot(off, off)));
    }
  }
  return amounts;
}

}  // namespace

std::vector<float> WhereFrecklesAre(const FittedBody& body, const CastPiece& skin, float amount) {
  std::vector<float> amounts = OnFace(body, skin, {{{0.0f, -0.45f}, {0.95f, 0.42f}}});
  for (float& here : amounts) {
    here *= amount;
  }
  return amounts;
}

std::vector<float> WhereLidsAre(const FittedBody& body, const CastPiece& skin) {
  const glm::vec2 width(0.30f, 0.22f);
  return OnFace(body, skin, {{{-0.5f, 0.04f}, width}, {{0.5f, 0.04f}, width}});
}

std::vector<float> WhereCheeksAre(const FittedBody& body, const CastPiece& skin) {
  const glm::vec2 width(0.16f, 0.14f);
  return OnFace(body, skin, {{{-0.62f, -0.62f}, width}, {{0.62f, -0.62f}, width}});
}

std::vector<float> WhereTheSunBurns(const FittedBody& body, const CastPiece& skin, float amount) {
  const Moved bare(body.skeleton, {"vc7", "l_elbow", "r_elbow"});
  std::vector<float> amounts(skin.mesh.positions.size(), 0.0f);
  for (size_t v = 0; v < amounts.size(); ++v) {
    // The sun is high, and people look down at their work.
    const glm::vec3 sun = glm::normalize(glm::vec3(0.0f, 1.0f, -0.55f));
    const float facing = glm::smoothstep(0.1f, 0.9f, glm::dot(skin.mesh.normals[v], sun));
    amounts[v] = amount * bare.Share(skin.mesh, v) * facing;
  }
  return amounts;
}

}  // namespace lararium::import
