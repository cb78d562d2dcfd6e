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
#include "shared/stage/prop.h"

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
  // Its back can be seen: a sheet. The back of a closed surface never is.
  bool two_sided = false;
  glm::vec3 emission = glm::vec3(0.0f);  // radiance that it gives off by itself

  RayMesh ray_mesh() const { return {positions, indices, uvs, coverage}; }
  // Albedo with texture between the corners of a triangle, and at a vertex.
  glm::vec3 AlbedoAt(uint32_t triangle, const glm::vec3& barycentric) const;
  glm::vec3 AlbedoAt(uint32_t vertex) const;
  glm::vec3 NormalAt(uint32_t triangle, const glm::vec3& barycentric) const;
};

// What rays meet of these meshes; RayHit::mesh is the index.
Result<RayScene> RaysAt(std::span<const SurfaceMesh> meshes);

// A copy moved by a rigid transform.
SurfaceMesh Moved(const glm::mat4& target_from_mesh, const SurfaceMesh& mesh);

// What a material makes of a mesh.
struct SurfaceLook {
  cv::Mat texture;  // as SurfaceMesh has them
  cv::Mat coverage;
  bool two_sided = false;
  glm::vec3 colour = glm::vec3(1.0f);  // multiplies the albedo of vertices
};

// The images of a model's materials, decoded once.
class MaterialImages {
 public:
  // materials must be valid and outlive this. Fails where a texture cannot be decoded.
  static Result<MaterialImages> Create(
      std::span<const std::shared_ptr<const human::Texture>> textures,
      std::span<const human::Material> materials,
      const std::string& place);

  SurfaceLook LookOf(int16_t material,
                     bool has_uvs,
                     std::span<const glm::vec3> positions,
                     std::span<const uint32_t> indices) const;

 private:
  std::span<const human::Material> materials_;
  std::vector<cv::Mat> colours_;  // of each texture
  std::vector<cv::Mat> alphas_;   // likewise
};

// The meshes of all parts of a prop in a row, each in its part's frame. The prop must be valid.
Result<std::vector<SurfaceMesh>> SurfacesOf(const stage::Prop& prop);

// Textures are decoded once and shared by the poses of a person.
class PosableSurface {
 public:
  // The person must be valid and outlive this. Fails where a texture cannot be decoded.
  static Result<PosableSurface> Create(const human::Human& human);

  // Parallel to Human::meshes. Normals are those of the posed triangles, weighted by
  // angle (Thurmer & Wuthrich, "Computing Vertex Normals from Polygonal Facets", 1998)
  // and shared across seams that are smooth in the bind pose.
  std::vector<SurfaceMesh> Pose(std::span<const glm::mat4> skin) const;
  // One mesh where its vertices are these, actor frame.
  SurfaceMesh PoseMesh(size_t mesh,
                       std::span<const glm::vec3> positions,
                       std::span<const glm::vec3> normals) const;

 private:
  explicit PosableSurface(const human::Human& human) : human_(&human) {}

  SurfaceMesh Dressed(size_t mesh) const;

  const human::Human* human_;
  std::vector<SurfaceLook> looks_;            // of each mesh
  std::vector<std::vector<uint32_t>> seams_;  // of each mesh: the first vertex that is the same
};

}  // namespace lararium::bake
