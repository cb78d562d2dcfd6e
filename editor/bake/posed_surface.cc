#include "editor/bake/posed_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <opencv2/imgproc.hpp>
#include <unordered_map>

#include "shared/core/srgb.h"
#include "shared/human/skinning.h"
#include "shared/render/gl/texture_image.h"
#include "shared/render/passes/closed_surface.h"

namespace lararium::bake {
namespace {

// Largest side of a texture for coverage and colour; light needs no finer detail.
constexpr int kTextureSide = 512;
// A seam is smooth if the cosine of the angle between its normals is at least this.
constexpr float kSmooth = 0.5f;

cv::Mat Shrink(const cv::Mat& image) {
  const int side = std::max(image.cols, image.rows);
  cv::Mat small = image;
  if (side > kTextureSide) {
    const double scale = static_cast<double>(kTextureSide) / side;
    cv::resize(image, small, cv::Size(), scale, scale, cv::INTER_AREA);
  }
  return small;
}

cv::Mat LinearColour(const cv::Mat& bgra) {
  std::array<float, 256> linear;
  for (size_t i = 0; i < linear.size(); ++i) {
    linear[i] = LinearFromSrgb(static_cast<float>(i) / 255.0f);
  }
  cv::Mat colour(bgra.size(), CV_32FC3);
  for (int y = 0; y < bgra.rows; ++y) {
    for (int x = 0; x < bgra.cols; ++x) {
      const cv::Vec4b& texel = bgra.at<cv::Vec4b>(y, x);
      colour.at<cv::Vec3f>(y, x) = {linear[texel[2]], linear[texel[1]], linear[texel[0]]};
    }
  }
  return colour;
}

glm::vec3 Lookup(const cv::Mat& texture, const glm::vec2& uv) {
  const cv::Vec3f& c = texture.at<cv::Vec3f>(WrappedTexel(uv, texture.size()));
  return {c[0], c[1], c[2]};
}

struct PositionHash {
  size_t operator()(const glm::vec3& p) const {
    std::array<uint32_t, 3> bits;
    std::memcpy(bits.data(), &p, sizeof(bits));
    return (bits[0] * 73856093u) ^ (bits[1] * 19349663u) ^ (bits[2] * 83492791u);
  }
};

// For each vertex, the first one at its position with nearly the same normal.
std::vector<uint32_t> FindSeams(const human::SkinnedMesh& mesh) {
  std::unordered_multimap<glm::vec3, uint32_t, PositionHash> firsts;
  std::vector<uint32_t> first(mesh.positions.size());
  for (uint32_t v = 0; v < mesh.positions.size(); ++v) {
    first[v] = v;
    const auto [begin, end] = firsts.equal_range(mesh.positions[v]);
    const auto same = std::find_if(begin, end, [&](const auto& other) {
      return glm::dot(mesh.normals[v], mesh.normals[other.second]) > kSmooth;
    });
    if (same != end) {
      first[v] = same->second;
    } else {
      firsts.emplace(mesh.positions[v], v);
    }
  }
  return first;
}

float AngleBetween(const glm::vec3& a, const glm::vec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

// Replaces normals wherever the triangles define one.
void RecomputeNormals(const std::vector<uint32_t>& seams, SurfaceMesh& mesh) {
  std::vector<glm::vec3> sums(mesh.positions.size(), glm::vec3(0.0f));
  for (size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
    const glm::vec3 corners[3] = {mesh.positions[mesh.indices[t]],
                                  mesh.positions[mesh.indices[t + 1]],
                                  mesh.positions[mesh.indices[t + 2]]};
    const glm::vec3 face = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const float size = glm::length(face);
    for (int c = 0; c < 3 && size > 0.0f; ++c) {
      const float angle =
          AngleBetween(corners[(c + 1) % 3] - corners[c], corners[(c + 2) % 3] - corners[c]);
      sums[seams[mesh.indices[t + c]]] += face / size * angle;
    }
  }
  for (size_t v = 0; v < sums.size(); ++v) {
    const glm::vec3& sum = sums[seams[v]];
    const float length = glm::length(sum);
    if (length > 1e-6f) {
      mesh.normals[v] = sum / length;
    }
  }
}

}  // namespace

glm::vec3 SurfaceMesh::AlbedoAt(uint32_t triangle, const glm::vec3& barycentric) const {
  glm::vec3 result(0.0f);
  glm::vec2 uv(0.0f);
  for (int c = 0; c < 3; ++c) {
    const uint32_t vertex = indices[3 * triangle + c];
    result += barycentric[c] * albedo[vertex];
    if (!uvs.empty()) {
      uv += barycentric[c] * uvs[vertex];
    }
  }
  return texture.empty() ? result : result * Lookup(texture, uv);
}

glm::vec3 SurfaceMesh::AlbedoAt(uint32_t vertex) const {
  return texture.empty() ? albedo[vertex] : albedo[vertex] * Lookup(texture, uvs[vertex]);
}

glm::vec3 SurfaceMesh::NormalAt(uint32_t triangle, const glm::vec3& barycentric) const {
  glm::vec3 sum(0.0f);
  for (int c = 0; c < 3; ++c) {
    sum += barycentric[c] * normals[indices[3 * triangle + c]];
  }
  const float length = glm::length(sum);
  return length > 1e-6f ? sum / length : normals[indices[3 * triangle]];
}

Result<RayScene> RaysAt(std::span<const SurfaceMesh> meshes) {
  std::vector<RayMesh> ray_meshes;
  for (const SurfaceMesh& mesh : meshes) {
    ray_meshes.push_back(mesh.ray_mesh());
  }
  return RayScene::Create(ray_meshes);
}

SurfaceMesh Moved(const glm::mat4& target_from_mesh, const SurfaceMesh& mesh) {
  SurfaceMesh moved = mesh;
  for (glm::vec3& position : moved.positions) {
    position = target_from_mesh * glm::vec4(position, 1.0f);
  }
  for (glm::vec3& normal : moved.normals) {
    normal = glm::normalize(glm::mat3(target_from_mesh) * normal);
  }
  return moved;
}

Result<MaterialImages> MaterialImages::Create(
    std::span<const std::shared_ptr<const human::Texture>> textures,
    std::span<const human::Material> materials,
    const std::string& where) {
  MaterialImages images;
  images.materials_ = materials;
  for (const std::shared_ptr<const human::Texture>& texture : textures) {
    LARARIUM_ASSIGN_OR_RETURN(
        const cv::Mat decoded,
        render::DecodeTexture(texture->encoded, where + ": " + texture->name));
    const cv::Mat small = Shrink(decoded);
    images.colours_.push_back(LinearColour(small));
    cv::extractChannel(small, images.alphas_.emplace_back(), 3);
  }
  return images;
}

SurfaceLook MaterialImages::LookOf(int16_t material,
                                   bool has_uvs,
                                   std::span<const glm::vec3> positions,
                                   std::span<const uint32_t> indices) const {
  SurfaceLook look;
  look.two_sided = true;
  if (material != human::Material::kNone) {
    const human::Material& of = materials_[static_cast<size_t>(material)];
    look.two_sided = of.two_sided;
    look.colour = of.colour;
    if (of.colour_texture >= 0 && has_uvs) {
      const auto texture = static_cast<size_t>(of.colour_texture);
      look.texture = colours_[texture];
      look.coverage = of.alpha_cutoff > 0.0f ? alphas_[texture] : cv::Mat();
    }
  }
  if (look.two_sided && look.coverage.empty()) {
    look.two_sided = !render::IsClosedSurface(positions, indices);
  }
  return look;
}

Result<std::vector<SurfaceMesh>> SurfacesOf(const stage::Prop& prop) {
  LARARIUM_ASSIGN_OR_RETURN(const MaterialImages images,
                            MaterialImages::Create(prop.textures, prop.materials, prop.name));
  std::vector<SurfaceMesh> surfaces;
  for (const stage::PropPart& part : prop.parts) {
    for (const stage::PropMesh& mesh : part.meshes) {
      const SurfaceLook look =
          images.LookOf(mesh.material, !mesh.uvs.empty(), mesh.positions, mesh.indices);
      SurfaceMesh& surface = surfaces.emplace_back(
          SurfaceMesh{mesh.positions, mesh.normals, mesh.albedo, mesh.uvs, mesh.indices,
                      look.texture, look.coverage, look.two_sided});
      for (glm::vec3& albedo : surface.albedo) {
        albedo *= look.colour;
      }
      surface.emission = mesh.emission;
    }
  }
  return surfaces;
}

Result<PosableSurface> PosableSurface::Create(const human::Human& human) {
  PosableSurface surface(human);
  LARARIUM_ASSIGN_OR_RETURN(const MaterialImages images,
                            MaterialImages::Create(human.textures, human.materials, human.name));
  for (const human::SkinnedMesh& mesh : human.meshes) {
    surface.looks_.push_back(
        images.LookOf(mesh.material, !mesh.uvs.empty(), mesh.positions, mesh.indices));
    surface.seams_.push_back(FindSeams(mesh));
  }
  return surface;
}

// The mesh without positions and normals.
SurfaceMesh PosableSurface::Dressed(size_t index) const {
  const human::SkinnedMesh& source = human_->meshes[index];
  const SurfaceLook& look = looks_[index];
  SurfaceMesh mesh{{},
                   {},
                   source.albedo,
                   source.uvs,
                   source.indices,
                   look.texture,
                   look.coverage,
                   look.two_sided};
  for (glm::vec3& albedo : mesh.albedo) {
    albedo *= look.colour;
  }
  return mesh;
}

SurfaceMesh PosableSurface::PoseMesh(size_t index,
                                     std::span<const glm::vec3> positions,
                                     std::span<const glm::vec3> normals) const {
  SurfaceMesh mesh = Dressed(index);
  mesh.positions.assign(positions.begin(), positions.end());
  mesh.normals.assign(normals.begin(), normals.end());
  RecomputeNormals(seams_[index], mesh);
  return mesh;
}

std::vector<SurfaceMesh> PosableSurface::Pose(std::span<const glm::mat4> skin) const {
  std::vector<SurfaceMesh> meshes;
  for (size_t i = 0; i < human_->meshes.size(); ++i) {
    const human::SkinnedMesh& source = human_->meshes[i];
    std::vector<glm::vec3> positions(source.positions.size());
    std::vector<glm::vec3> normals(source.positions.size());
    human::SkinMesh(source, skin, positions, normals, human_->skinning);
    meshes.push_back(PoseMesh(i, positions, normals));
  }
  return meshes;
}

}  // namespace lararium::bake
