#pragma once

// Simple people of known shape.

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "shared/core/units.h"
#include "shared/human/human.h"

namespace lararium::render {

// A latitude-longitude sphere of radius 1 about the origin.
inline human::SkinnedMesh Sphere(const glm::vec3& albedo) {
  constexpr int kRings = 64;
  constexpr int kSectors = 128;
  human::SkinnedMesh mesh;
  for (int ring = 0; ring <= kRings; ++ring) {
    for (int sector = 0; sector <= kSectors; ++sector) {
      const float theta = kPiF * static_cast<float>(ring) / kRings;
      const float phi = 2.0f * kPiF * static_cast<float>(sector) / kSectors;
      const glm::vec3 normal(std::sin(theta) * std::cos(phi), std::cos(theta),
                             -std::sin(theta) * std::sin(phi));
      mesh.positions.push_back(normal);
      mesh.normals.push_back(normal);
      mesh.albedo.push_back(albedo);
      mesh.joints.push_back({0, 0, 0, 0});
      mesh.weights.emplace_back(1.0f, 0.0f, 0.0f, 0.0f);
    }
  }
  for (uint32_t ring = 0; ring < kRings; ++ring) {
    for (uint32_t sector = 0; sector < kSectors; ++sector) {
      const uint32_t a = ring * (kSectors + 1) + sector;
      const uint32_t b = a + kSectors + 1;
      mesh.indices.insert(mesh.indices.end(), {a, b, a + 1, a + 1, b, b + 1});
    }
  }
  return mesh;
}

// A box whose eight corners are weighted between two joints by their height.
inline human::SkinnedMesh BendingBox(const glm::vec3& albedo) {
  human::SkinnedMesh mesh;
  for (int i = 0; i <= 8; ++i) {
    const float y = 0.25f * static_cast<float>(i);
    const float upper = std::clamp(y - 0.5f, 0.0f, 1.0f);
    for (const auto& [x, z] :
         {std::pair{-0.2f, -0.2f}, {0.2f, -0.2f}, {0.2f, 0.2f}, {-0.2f, 0.2f}}) {
      mesh.positions.emplace_back(x, y, z);
      mesh.normals.push_back(glm::normalize(glm::vec3(x, 0.0f, z)));
      mesh.albedo.push_back(albedo);
      mesh.joints.push_back({0, 1, 2, 0});
      mesh.weights.emplace_back(1.0f - upper, 0.75f * upper, 0.25f * upper, 0.0f);
    }
  }
  for (uint32_t i = 0; i < 8; ++i) {
    for (uint32_t k = 0; k < 4; ++k) {
      const uint32_t a = 4 * i + k;
      const uint32_t b = 4 * i + (k + 1) % 4;
      mesh.indices.insert(mesh.indices.end(), {a, a + 4, b, b, a + 4, b + 4});
    }
  }
  return mesh;
}

// A human with joint_count joints at the origin, so that only the skin matrices move the mesh.
inline human::Human MakeHuman(human::SkinnedMesh mesh, size_t joint_count) {
  human::Human human;
  human.name = "test";
  for (size_t i = 0; i < joint_count; ++i) {
    human.skeleton.names.push_back("joint" + std::to_string(i));
    human.skeleton.parents.push_back(i == 0 ? human::Skeleton::kNoParent : int16_t{0});
    human.skeleton.rest.emplace_back();
    human.skeleton.joint_from_actor.emplace_back(1.0f);
  }
  mesh.name = "mesh";
  human.meshes.push_back(std::move(mesh));
  return human;
}

// Copies a person or prop into the shared pointer that a renderer takes.
template <typename Model>
std::shared_ptr<const Model> Shared(Model model) {
  return std::make_shared<const Model>(std::move(model));
}

}  // namespace lararium::render
