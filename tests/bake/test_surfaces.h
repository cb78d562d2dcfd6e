#pragma once

// Surfaces and skies whose light is known in closed form.

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <string>
#include <utility>
#include <vector>

#include "editor/bake/posed_surface.h"
#include "editor/bake/probe.h"
#include "shared/core/units.h"
#include "shared/human/human.h"

namespace lararium::bake {

// Adds a triangle whose front is on the side of `towards`.
inline void AddTriangle(
    uint32_t a, uint32_t b, uint32_t c, const glm::vec3& towards, SurfaceMesh& mesh) {
  const auto& p = mesh.positions;
  const bool front = glm::dot(glm::cross(p[b] - p[a], p[c] - p[a]), towards) > 0.0f;
  mesh.indices.insert(mesh.indices.end(), {a, front ? b : c, front ? c : b});
}

inline void AddVertex(const glm::vec3& position,
                      const glm::vec3& normal,
                      const glm::vec3& albedo,
                      SurfaceMesh& mesh) {
  mesh.positions.push_back(position);
  mesh.normals.push_back(normal);
  mesh.albedo.push_back(albedo);
}

// The part of a sphere up to a polar angle from its lowest point: pi / 2 is a bowl, pi the
// complete sphere. `inside` turns its front towards the centre.
inline SurfaceMesh MakeCap(const glm::vec3& centre,
                           float radius,
                           float angle,
                           bool inside,
                           const glm::vec3& albedo,
                           int rings = 24,
                           int segments = 48) {
  SurfaceMesh mesh;
  const float side = inside ? -1.0f : 1.0f;
  const bool closed = angle > 0.999f * kPiF;
  const auto add = [&](float polar, float azimuth) {
    const glm::vec3 out(std::sin(polar) * std::cos(azimuth), -std::cos(polar),
                        std::sin(polar) * std::sin(azimuth));
    AddVertex(centre + radius * out, side * out, albedo, mesh);
  };
  add(0.0f, 0.0f);
  const int last = closed ? rings - 1 : rings;
  for (int ring = 1; ring <= last; ++ring) {
    for (int i = 0; i < segments; ++i) {
      add(angle * static_cast<float>(ring) / static_cast<float>(rings),
          2.0f * kPiF * static_cast<float>(i) / static_cast<float>(segments));
    }
  }
  if (closed) {
    add(kPiF, 0.0f);
  }
  const auto index = [&](int ring, int i) {
    // Each pole is one vertex.
    const int vertex = ring == 0          ? 0
                       : ring == last + 1 ? 1 + last * segments
                                          : 1 + (ring - 1) * segments + i % segments;
    return static_cast<uint32_t>(vertex);
  };
  for (int ring = 0; ring < rings; ++ring) {
    for (int i = 0; i < segments; ++i) {
      const uint32_t corners[4] = {index(ring, i), index(ring, i + 1), index(ring + 1, i + 1),
                                   index(ring + 1, i)};
      const glm::vec3 towards =
          side * (mesh.positions[corners[1]] - centre + mesh.positions[corners[3]] - centre);
      if (ring > 0) {
        AddTriangle(corners[0], corners[1], corners[2], towards, mesh);
      }
      if (!closed || ring + 1 < rings) {
        AddTriangle(corners[0], corners[2], corners[3], towards, mesh);
      }
    }
  }
  return mesh;
}

inline SurfaceMesh MakeSphere(const glm::vec3& centre, float radius, const glm::vec3& albedo) {
  return MakeCap(centre, radius, kPiF, false, albedo);
}

// A disc whose front is on the side of `normal`.
inline SurfaceMesh MakeDisc(const glm::vec3& centre,
                            const glm::vec3& normal,
                            float radius,
                            const glm::vec3& albedo) {
  constexpr int kSegments = 96;
  SurfaceMesh mesh;
  const glm::vec3 other = std::abs(normal.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
  const glm::vec3 x = glm::normalize(glm::cross(other, normal));
  const glm::vec3 y = glm::cross(normal, x);
  AddVertex(centre, normal, albedo, mesh);
  for (int i = 0; i < kSegments; ++i) {
    const float angle = 2.0f * kPiF * static_cast<float>(i) / kSegments;
    AddVertex(centre + radius * (std::cos(angle) * x + std::sin(angle) * y), normal, albedo, mesh);
  }
  for (uint32_t i = 0; i < kSegments; ++i) {
    AddTriangle(0, 1 + i, 1 + (i + 1) % kSegments, normal, mesh);
  }
  return mesh;
}

// A box with split corners, because each side has its own normals.
inline SurfaceMesh MakeBox(const glm::vec3& low, const glm::vec3& high, const glm::vec3& albedo) {
  SurfaceMesh mesh;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float sign : {-1.0f, 1.0f}) {
      glm::vec3 normal(0.0f);
      normal[axis] = sign;
      const auto first = static_cast<uint32_t>(mesh.positions.size());
      for (int corner = 0; corner < 4; ++corner) {
        glm::vec3 at;
        at[axis] = sign < 0.0f ? low[axis] : high[axis];
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        at[u] = (corner & 1) != 0 ? high[u] : low[u];
        at[v] = (corner & 2) != 0 ? high[v] : low[v];
        AddVertex(at, normal, albedo, mesh);
      }
      AddTriangle(first, first + 1, first + 3, normal, mesh);
      AddTriangle(first, first + 3, first + 2, normal, mesh);
    }
  }
  return mesh;
}

// A human of rigid surfaces that each follow one joint. The first joint is the root and the
// parent of all others; joints have no rotation.
inline human::Human MakeRigidHuman(const std::vector<glm::vec3>& joints,
                                   const std::vector<std::pair<SurfaceMesh, uint8_t>>& surfaces) {
  human::Human human;
  human.name = "rigid";
  for (size_t j = 0; j < joints.size(); ++j) {
    human.skeleton.names.push_back("joint " + std::to_string(j));
    human.skeleton.parents.push_back(j == 0 ? human::Skeleton::kNoParent : int16_t{0});
    human::JointTransform rest;
    rest.translation = j == 0 ? joints[0] : joints[j] - joints[0];
    human.skeleton.rest.push_back(rest);
    glm::mat4 joint_from_actor(1.0f);
    joint_from_actor[3] = glm::vec4(-joints[j], 1.0f);
    human.skeleton.joint_from_actor.push_back(joint_from_actor);
  }
  for (const auto& [surface, joint] : surfaces) {
    human::SkinnedMesh mesh;
    mesh.name = "part " + std::to_string(human.meshes.size());
    mesh.positions = surface.positions;
    mesh.normals = surface.normals;
    mesh.albedo = surface.albedo;
    mesh.uvs = surface.uvs;
    mesh.indices = surface.indices;
    mesh.joints.assign(mesh.positions.size(), {joint, 0, 0, 0});
    mesh.weights.assign(mesh.positions.size(), glm::vec4(1, 0, 0, 0));
    human.meshes.push_back(std::move(mesh));
  }
  return human;
}

// `radiance` is a function of a direction in the axes of the probe.
inline ProbeImage MakeProbe(int width, const std::function<glm::vec3(const glm::vec3&)>& radiance) {
  ProbeImage image;
  image.width = width;
  image.height = width / 2;
  for (int row = 0; row < image.height; ++row) {
    for (int column = 0; column < width; ++column) {
      const float a = 2.0f * kPiF * ((static_cast<float>(column) + 0.5f) / width - 0.5f);
      const float e = kPiF * (0.5f - (static_cast<float>(row) + 0.5f) / image.height);
      image.pixels.push_back(
          radiance({std::cos(e) * std::sin(a), std::sin(e), -std::cos(e) * std::cos(a)}));
    }
  }
  return image;
}

inline ProbeImage MakeUniformProbe(float radiance) {
  return MakeProbe(16, [=](const glm::vec3&) { return glm::vec3(radiance); });
}

}  // namespace lararium::bake
