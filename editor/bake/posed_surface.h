#pragma once

// What light falls on: a person at a pose, or another model, as plain triangles.

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <opencv2/core/mat.hpp>
#include <span>
#include <string>
#include <vector>

#include "editor/bake/ray_scene.h"
#include "shared/core/status.h"
#include "shared/human/human.h"

namespace lararium::bake {

// Arrays are parallel over the vertices. Metres.
struct SurfaceMesh {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;  // unit
  std::vector<glm::vec3> albedo;   // linear, texture left out
  std::vector<glm::vec2> uvs;      // of the texture, or empty
  std::vector<uint32_t> indices;
  cv::Mat texture;   // CV_32FC3, linear RGB; empty: none
  cv::Mat coverage;  // CV_8UC1; empty: solid

  RayMesh ray_mesh() const { return {positions, indices, uvs, coverage}; }
  // Albedo with texture between the corners of a triangle, and at a vertex.
  glm::vec3 AlbedoAt(uint32_t triangle, const glm::vec3& barycentric) const;
  glm::vec3 AlbedoAt(uint32_t vertex) const;
  glm::vec3 NormalAt(uint32_t triangle, const glm::vec3& barycentric) const;
};

// What rays meet of these meshes; RayHit::mesh is the index.
Result<RayScene> RaysAt(std::span<const SurfaceMesh> meshes);

// Textures are decoded once and shared by the poses of a person.
class PosableSurface {
 public:
  // The person must be valid and outlive this. Fails where a texture cannot be decoded.
  static Result<PosableSurface> Create(const human::Human& human);

  // Parallel to Human::meshes. Normals are those of the posed triangles, weighted by
  // angle (Thurmer & Wuthrich, "Computing Vertex Normals from Polygonal Facets", 1998)
  // and shared across seams that are smooth in the bind pose.
  std::vector<SurfaceMesh> Pose(std::span<const glm::mat4> skin) const;

 private:
  explicit PosableSurface(const human::Human& human) : human_(&human) {}

  const human::Human* human_;
  std::vector<cv::Mat> textures_;             // of each mesh, or empty
  std::vector<cv::Mat> coverages_;            // likewise
  std::vector<std::vector<uint32_t>> seams_;  // of each mesh: the first vertex that is the same
};

}  // namespace lararium::bake
