#include "editor/import/cast/cast_hair.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/vector_relational.hpp>

#include "editor/import/cast/joint_lookup.h"

namespace lararium::import {
namespace {

constexpr float kOfTheWhole = 0.5f;  // Weight of the rounded shape in shading normals.
constexpr float kDeepest = 0.03f;    // Metres; hair further inside is so by intention.

// The vertices of head and neck that hair can cover.
std::vector<uint32_t> HeadVertices(const FittedBody& body) {
  const float lowest = RestPosition(body.skeleton, "vc7").y - 0.05f;
  std::vector<uint32_t> vertices;
  for (size_t v = 0; v < body.skin.positions.size(); ++v) {
    if (body.skin.positions[v].y > lowest) {
      vertices.push_back(static_cast<uint32_t>(v));
    }
  }
  return vertices;
}

uint32_t NearestStrand(const human::SkinnedMesh& skin,
                       const std::vector<uint32_t>& vertices,
                       const glm::vec3& p) {
  uint32_t nearest = vertices[0];
  float least = 1e9f;
  for (const uint32_t v : vertices) {
    const glm::vec3 offset = skin.positions[v] - p;
    const float squared = glm::dot(offset, offset);
    if (squared < least) {
      least = squared;
      nearest = v;
    }
  }
  return nearest;
}

glm::vec3 Laid(const glm::vec3& p,
               const glm::vec3& ground,
               const glm::vec3& normal,
               const HairFit& fit) {
  const glm::vec3 laid = ground + fit.volume * (p - ground);
  const float height = glm::dot(laid - ground, normal);
  if (height < fit.clearance && height > -kDeepest) {
    return laid + (fit.clearance - height) * normal;
  }
  return laid;
}

// Direction away from the middle of the skull, or below it from its vertical axis.
glm::vec3 Outward(const glm::vec3& p, const glm::vec3& middle) {
  const glm::vec3 from(middle.x, std::min(p.y, middle.y), middle.z);
  const glm::vec3 offset = p - from;
  const float length = glm::length(offset);
  return length > 1e-4f ? offset / length : glm::vec3(0.0f, 1.0f, 0.0f);
}

// Intersection of a ray with a triangle: the distance, and the weights of its corners b and c.
struct Hit {
  float distance = -1.0f;  // Negative if there is none.
  float b = 0.0f;
  float c = 0.0f;
};

// Moeller & Trumbore, Journal of Graphics Tools 2(1), 1997. Counts both sides of the triangle.
Hit Meet(const glm::vec3& from,
         const glm::vec3& direction,
         const glm::vec3& a,
         const glm::vec3& b,
         const glm::vec3& c) {
  const glm::vec3 ab = b - a;
  const glm::vec3 ac = c - a;
  const glm::vec3 p = glm::cross(direction, ac);
  const float determinant = glm::dot(ab, p);
  if (std::abs(determinant) < 1e-12f) {
    return {};
  }
  const glm::vec3 offset = from - a;
  const float u = glm::dot(offset, p) / determinant;
  const glm::vec3 q = glm::cross(offset, ab);
  const float v = glm::dot(direction, q) / determinant;
  if (u < 0.0f || v < 0.0f || u + v > 1.0f) {
    return {};
  }
  return {glm::dot(ac, q) / determinant, u, v};
}

}  // namespace

float CoverOver(const glm::vec3& place,
                const glm::vec3& normal,
                const human::SkinnedMesh& hair,
                const Coverage& picture) {
  constexpr float kClose = 0.02f;  // metres
  constexpr float kSunk = 0.005f;  // Metres that hair may be below the skin.
  const glm::vec3 from = place - kSunk * normal;
  float most = 0.0f;
  for (size_t i = 0; i + 2 < hair.indices.size() && most < 1.0f; i += 3) {
    const uint32_t* corners = &hair.indices[i];
    const glm::vec3& a = hair.positions[corners[0]];
    const glm::vec3& b = hair.positions[corners[1]];
    const glm::vec3& c = hair.positions[corners[2]];
    const glm::vec3 low = glm::min(a, glm::min(b, c)) - kClose;
    const glm::vec3 high = glm::max(a, glm::max(b, c)) + kClose;
    if (glm::any(glm::lessThan(place, low)) || glm::any(glm::greaterThan(place, high))) {
      continue;
    }
    const Hit hit = Meet(from, normal, a, b, c);
    if (hit.distance >= 0.0f && hit.distance < kClose + kSunk) {
      const glm::vec2 uv = (1.0f - hit.b - hit.c) * hair.uvs[corners[0]] +
                           hit.b * hair.uvs[corners[1]] + hit.c * hair.uvs[corners[2]];
      most = std::max(most, picture.At(uv));
    }
  }
  return most;
}

void LayHair(CastPiece& hair, const FittedBody& body, const HairFit& fit) {
  const std::vector<uint32_t> head = HeadVertices(body);
  const glm::vec3 eyes = 0.5f * (RestPosition(body.skeleton, "l_eyeball_joint") +
                                 RestPosition(body.skeleton, "r_eyeball_joint"));
  const glm::vec3 middle(0.0f, eyes.y,
                         0.5f * (eyes.z + RestPosition(body.skeleton, "skullbase").z));
  const glm::quat forward = glm::angleAxis(-fit.tilt, glm::vec3(1.0f, 0.0f, 0.0f));
  for (glm::vec3& p : hair.mesh.positions) {
    p = middle + forward * (p - middle);
    const uint32_t v = NearestStrand(body.skin, head, p);
    p = Laid(p, body.skin.positions[v], body.skin.normals[v], fit);
  }
  hair.mesh.normals = SmoothNormals(hair.mesh.positions, hair.source, hair.mesh.indices);
  for (size_t v = 0; v < hair.mesh.positions.size(); ++v) {
    const glm::vec3 outward = Outward(hair.mesh.positions[v], middle);
    glm::vec3 card = hair.mesh.normals[v];
    card = glm::dot(card, outward) < 0.0f ? -card : card;
    hair.mesh.normals[v] = glm::normalize(glm::mix(card, outward, kOfTheWhole));
  }
}

}  // namespace lararium::import
