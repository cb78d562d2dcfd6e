#pragma once

// The surfaces that receive light, as plain triangles: a posed person or another model.

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
  std::vector<glm::vec3> albedo;   // Linear, without the texture.
  std::vector<glm::vec2> uvs;      // Texture coordinates, or empty.
  std::vector<uint32_t> indices;
  cv::Mat texture;   // CV_32FC3, linear RGB; empty if there is none.
  cv::Mat coverage;  // CV_8UC1; empty if the mesh is solid.
  // The mesh is a sheet whose back can be visible; the back of a closed surface never is.
  bool two_sided = false;
  glm::vec3 emission = glm::vec3(0.0f);  // Radiance that the surface emits.

  RayMesh ray_mesh() const { return {positions, indices, uvs, coverage}; }
  // Albedo with texture, between the corners of a triangle or at a vertex.
  glm::vec3 AlbedoAt(uint32_t triangle, const glm::vec3& barycentric) const;
  glm::vec3 AlbedoAt(uint32_t vertex) const;
  glm::vec3 NormalAt(uint32_t triangle, const glm::vec3& barycentric) const;
};

// The ray scene of these meshes; `RayHit::mesh` is the index into `meshes`.
Result<RayScene> RaysAt(std::span<const SurfaceMesh> meshes);

// A copy of the mesh after a rigid transform.
SurfaceMesh Moved(const glm::mat4& target_from_mesh, const SurfaceMesh& mesh);

// How a material changes the appearance of a mesh.
struct SurfaceLook {
  cv::Mat texture;  // The images have the formats of SurfaceMesh.
  cv::Mat coverage;
  bool two_sided = false;
  glm::vec3 colour = glm::vec3(1.0f);  // Multiplies the albedo of the vertices.
};

// The decoded images of the materials of a model.
class MaterialImages {
 public:
  // `materials` must be valid and outlive the object. Fails if a texture cannot be decoded.
  static Result<MaterialImages> Create(
      std::span<const std::shared_ptr<const human::Texture>> textures,
      std::span<const human::Material> materials,
      const std::string& where);

  SurfaceLook LookOf(int16_t material,
                     bool has_uvs,
                     std::span<const glm::vec3> positions,
                     std::span<const uint32_t> indices) const;

 private:
  std::span<const human::Material> materials_;
  std::vector<cv::Mat> colours_;  // Indexed by texture.
  std::vector<cv::Mat> alphas_;   // Indexed by texture.
};

// All meshes of all parts of a prop in one list, each in the frame of its part. The prop must
// be valid.
Result<std::vector<SurfaceMesh>> SurfacesOf(const stage::Prop& prop);

// The surface of a person at any pose. Textures are decoded once.
class PosableSurface {
 public:
  // The person must be valid and outlive the object. Fails if a texture cannot be decoded.
  static Result<PosableSurface> Create(const human::Human& human);

  // The result is parallel to `Human::meshes`. Normals are those of the posed triangles,
  // weighted by angle (Thurmer & Wuthrich, "Computing Vertex Normals from Polygonal Facets",
  // 1998) and shared across seams that are smooth in the bind pose.
  std::vector<SurfaceMesh> Pose(std::span<const glm::mat4> skin) const;
  // One mesh with the given vertices in the actor frame.
  SurfaceMesh PoseMesh(size_t mesh,
                       std::span<const glm::vec3> positions,
                       std::span<const glm::vec3> normals) const;

 private:
  explicit PosableSurface(const human::Human& human) : human_(&human) {}

  SurfaceMesh Dressed(size_t mesh) const;

  const human::Human* human_;
  std::vector<SurfaceLook> looks_;            // Indexed by mesh.
  std::vector<std::vector<uint32_t>> seams_;  // First equal vertex of each vertex.
};

}  // namespace lararium::bake
